"""Finding the programs of GPUs: kernels in PTX, which a driver compiles for its GPU."""

import inspect
import re
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path

from rocksteady.errors import InputError
from rocksteady.kernels.machine_code.device import Form
from rocksteady.kernels.machine_code.sources import libraries_folder, sources_hash

Capability = tuple[int, int]
"""Compute capability of a GPU, as (9, 0)."""
LEAST: Capability = (8, 0)
"""Lowest compute capability for which there are programs."""
BROUGHT = "rocksteady_gpu"
"""Folder, beside the package, of the programs that the wheel rocksteady-gpu brings."""


def program(kernel: str, capability: Capability) -> Path:
    """Return the file of a kernel's program for a GPU: of the newest architecture that it runs.

    Parameters
    ----------
    kernel
        Name of the queued kernel.
    capability
        Of the GPU, at least `LEAST`.

    Raises
    ------
    InputError
        If this installation has no such program, or one of other sources.
    """
    for folder in (*brought_folders(), libraries_folder()):
        for path in _candidates(folder, kernel, capability):
            if sources_of(path) == sources_hash():
                return path
    raise InputError(
        "executor",
        "gpu",
        f"the GPU program of {kernel} is not in this installation, or it is of other sources",
        "install 'rocksteady[gpu]', or run 'make gpu' in a checkout; leave the executor out for "
        "threads",
    )


def check_programs(forms: Iterable[Form], capability: Capability) -> None:
    """Refuse an installation without the programs of some forms.

    Raises
    ------
    InputError
        If one is missing, or of other sources.
    """
    for form in forms:
        program(inspect.unwrap(form.queued).__name__, capability)


def brought_folders() -> list[Path]:
    """Return the folder of the programs that the wheel rocksteady-gpu brings; none without it."""
    spec = find_spec(BROUGHT)
    return [Path(place) for place in (spec and spec.submodule_search_locations) or ()]


def file_name(capability: Capability, kernel: str) -> str:
    """Return the file name of a kernel's program for an architecture."""
    return f"rocksteady-sm_{capability[0]}{capability[1]}-{kernel}.ptx"


def sources_of(path: Path) -> str:
    """Return the hash of the sources that a program was made of, which its first line names."""
    try:
        with path.open(encoding="ascii", errors="replace") as lines:
            return lines.readline().removeprefix("// rocksteady kernels ").strip()
    except OSError:
        return ""


def _candidates(folder: Path, kernel: str, capability: Capability) -> Iterator[Path]:
    """Yield the programs of a kernel in a folder that a GPU runs, the newest first."""
    # The last digit is the minor version: sm_90 is 9.0, sm_120 is 12.0.
    pattern = re.compile(rf"rocksteady-sm_(\d+)(\d)-{re.escape(kernel)}\.ptx")
    matches = (
        pattern.fullmatch(path.name) for path in folder.glob(f"rocksteady-sm_*-{kernel}.ptx")
    )
    listed = {(int(match[1]), int(match[2])): match[0] for match in matches if match}
    for architecture in sorted(listed, reverse=True):
        if LEAST <= architecture <= capability:
            yield folder / listed[architecture]


def refuse_capability(name: str, capability: Capability) -> None:
    """Refuse a GPU that cannot run the programs.

    Raises
    ------
    InputError
        If its compute capability is too low.
    """
    if capability < LEAST:
        given, least = (".".join(map(str, numbers)) for numbers in (capability, LEAST))
        raise InputError(
            "executor",
            "gpu",
            f"{name} has compute capability {given}, and the kernels are compiled for {least} or "
            "higher, with double precision in hardware",
            "leave the executor out for threads",
        )
