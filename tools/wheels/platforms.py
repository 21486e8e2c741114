"""The platforms that have a wheel, and what is in each."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Platform:
    """A platform that has a wheel.

    Parameters
    ----------
    tag
        Platform tag of its wheel; the oldest system that installs it is in the tag.
    targets
        Targets of `tools.aot` whose libraries are inside, from the oldest processor to the newest.
    suffix
        Of their files.
    """

    tag: str
    targets: tuple[str, ...] = ()
    suffix: str = ""

    def libraries(self, folder: Path) -> list[Path]:
        """Return the files of its libraries, from the folder that `tools.aot` writes to."""
        return [folder / f"rocksteady-{target}{self.suffix}" for target in self.targets]


PURE = Platform("any")
"""Without a library: for systems that have no other wheel, in plain Python.  The explorer's
module is inside as in every wheel: browsers run it on any system."""
PLATFORMS = (
    Platform(
        "manylinux_2_28_x86_64",
        ("linux-x86-64-v2", "linux-x86-64-v3", "linux-x86-64-v4"),
        ".so",
    ),
    Platform("manylinux_2_28_aarch64", ("linux-aarch64",), ".so"),
    Platform("macosx_11_0_arm64", ("macos-arm64",), ".dylib"),
    Platform("win_amd64", ("windows-x86-64-v2", "windows-x86-64-v3", "windows-x86-64-v4"), ".dll"),
    PURE,
)
