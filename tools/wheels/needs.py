"""What a shared library needs of the system that loads it, against what the tag promises.

``python -m tools.wheels.needs TAG KERNELS FILE...`` prints why a system to which the tag belongs
could not load each library.  It is a process of its own because lief reports leaks when it ends.
"""

import json
import re
import sys
from collections.abc import Sequence
from pathlib import Path

import lief

TAG = re.compile(r"(?P<system>manylinux|macosx|win)(?P<version>(_\d+)*)_(?P<processor>\w+)")
PROCESSORS = {
    "x86_64": lief.Header.ARCHITECTURES.X86_64,
    "amd64": lief.Header.ARCHITECTURES.X86_64,
    "aarch64": lief.Header.ARCHITECTURES.ARM64,
    "arm64": lief.Header.ARCHITECTURES.ARM64,
}
KINDS = {"manylinux": lief.ELF.Binary, "macosx": lief.MachO.Binary, "win": lief.PE.Binary}
PRESENT = {
    "manylinux": r"lib[cm]\.so\.6",
    "macosx": r"/usr/lib/libSystem\.B\.dylib",
    "win": r"(?i)(kernel32|ntdll|ucrtbase|api-ms-win-crt-[a-z0-9-]+)\.dll",
}
"""Names of the libraries that every such system has."""
GLIBC = re.compile(r"GLIBC_(\d+(?:\.\d+)*)")

lief.logging.disable()  # of files that it cannot read it returns None, too


def faults(library: Path, tag: str, kernels: Sequence[str] = ()) -> list[str]:
    """Return why a system to which a tag belongs could not load a library; nothing if it can.

    Parameters
    ----------
    library
        File of the library.
    tag
        Platform tag of the wheel, as ``manylinux_2_28_x86_64``.
    kernels
        Names of the kernels that it must show.
    """
    said = TAG.fullmatch(tag)
    if said is None:
        return [f"{tag} is no platform tag of a kind that is known"]
    system = said["system"]
    found = lief.parse(str(library))
    if not isinstance(found, KINDS[system]):
        return [f"it is no shared library of {system}"]
    wrong = []
    processor = found.abstract.header.architecture
    if processor != PROCESSORS.get(said["processor"]):
        wrong.append(f"it is made for {processor.name}")
    wrong += [
        f"it needs the library {name}"
        for name in _needed(found)
        if not re.fullmatch(PRESENT[system], name)
    ]
    shown = {str(each.name).removeprefix("_") for each in found.exported_functions}
    if absent := [name for name in kernels if f"rs_{name}" not in shown]:
        wrong.append(f"it lacks the kernels {', '.join(absent)}")
    promised = _numbers(said["version"])
    if isinstance(found, lief.ELF.Binary):
        wrong += [
            f"it needs {symbols}"
            for symbols in sorted(_symbols(found))
            if not (version := GLIBC.fullmatch(symbols)) or _numbers(version[1]) > promised
        ]
        if not found.has_nx:  # newer systems refuse such a library
            wrong.append("it asks for a stack that can be executed")
    if isinstance(found, lief.MachO.Binary):
        oldest = found.build_version.minos if found.build_version else []
        if not oldest or tuple(oldest) > (*promised, 0):
            wrong.append(f"it needs macOS {'.'.join(map(str, oldest)) or 'of unknown version'}")
        if not found.has_code_signature:  # which the processor's systems ask for
            wrong.append("it is not signed")
    return wrong


def _needed(found: lief.Binary) -> list[str]:
    """Return the names of the libraries that a library needs."""
    if isinstance(found, lief.MachO.Binary):  # among them is its own
        own = lief.MachO.LoadCommand.TYPE.ID_DYLIB
        return [str(each.name) for each in found.libraries if each.command != own]
    return [str(name) for name in found.abstract.libraries]


def _symbols(found: lief.ELF.Binary) -> set[str]:
    """Return the versions of symbols that a library of Linux needs, as ``GLIBC_2.17``."""
    return {
        str(auxiliary.name)
        for requirement in found.symbols_version_requirement
        for auxiliary in requirement.get_auxiliary_symbols()
    }


def _numbers(version: str) -> tuple[int, ...]:
    """Return the numbers of a version, as 2 and 28 of ``2.28`` and of ``_2_28``."""
    return tuple(map(int, re.findall(r"\d+", version)))


if __name__ == "__main__":
    _, given_tag, given_kernels, *files = sys.argv
    found = [faults(Path(file), given_tag, given_kernels.split()) for file in files]
    sys.stdout.write(json.dumps(found))
