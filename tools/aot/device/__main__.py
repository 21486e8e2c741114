"""``python -m tools.aot.device``: PTX of the kernels, for the executor "gpu".

``build`` writes it into the folder in which the package looks for it, or into another one; what is
current there stays.  ``check`` has ptxas assemble it, and shows what each kernel takes of a GPU.
"""

import argparse
import subprocess
import sys
from pathlib import Path

from rocksteady.kernels.machine_code.gpu import BLOCK
from rocksteady.kernels.machine_code.sources import libraries_folder
from tools.aot.build import ChangedError
from tools.aot.device.build import build
from tools.aot.device.program import VERSIONS, ProgramError
from tools.aot.device.resources import ToolError, table, tool


def main(arguments: list[str] | None = None) -> int:
    """Run a command; return its exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot.device", description=__doc__)
    parser.add_argument("command", choices=("build", "check"))
    parser.add_argument("--out", type=Path, help="folder to write into; the package's by default")
    parser.add_argument("--architectures", nargs="+", choices=VERSIONS, default=list(VERSIONS))
    given = parser.parse_args(arguments)
    folder, reason = given.out or libraries_folder(), None
    try:
        if reason is None:
            files = build(folder, given.architectures)
            print(f"PTX of the kernels: {folder}", flush=True)
            if given.command == "check" and tool("ptxas") is None:
                print("ptxas is not installed: not assembled; `make ptx` installs it")
            elif given.command == "check":
                print(table(files, BLOCK))
    except (
        ChangedError,
        ProgramError,
        ToolError,
        OSError,
        subprocess.CalledProcessError,
    ) as error:
        reason = str(error)
    if reason is not None:
        print(f"python -m tools.aot.device: {reason}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
