"""What a study reports: what is done, and what it runs on."""

import platform
from collections.abc import Callable

from rocksteady.installation.check import check_installation

Done = Callable[[str], None]
"""Called with the name of each thing that has been computed or written."""


def nothing(_: str) -> None:
    """Ignore what has been done."""


def environment() -> str:
    """Return what a study runs on, in one line."""
    from importlib.metadata import version

    here = check_installation(repeat_calls=False)
    kernels = f"kernels compiled for {here.target}" if here.target else "kernels not compiled"
    return ", ".join(
        (
            f"Python {platform.python_version()}",
            f"numpy {version('numpy')}",
            kernels,
            f"matplotlib {version('matplotlib')}",
            f"{platform.system()} on {platform.machine()}",
        )
    )
