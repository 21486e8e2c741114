"""``python -m tools.aot.device``: PTX of the kernels, for the executor "gpu".

It is written into the folder in which the package looks for it, or into another one; what is
current there stays.
"""

import argparse
import subprocess
import sys
from pathlib import Path

from rocksteady.kernels.machine_code.sources import libraries_folder
from tools.aot.build import ChangedError
from tools.aot.device.build import build
from tools.aot.device.program import VERSIONS, ProgramError


def main(arguments: list[str] | None = None) -> int:
    """Build what is not current; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot.device", description=__doc__)
    parser.add_argument("--out", type=Path, help="folder to write into; the package's by default")
    parser.add_argument("--architectures", nargs="+", choices=VERSIONS, default=list(VERSIONS))
    given = parser.parse_args(arguments)
    folder = given.out or libraries_folder()
    try:
        build(folder, given.architectures)
    except (ChangedError, ProgramError, OSError, subprocess.CalledProcessError) as error:
        print(f"python -m tools.aot.device: {error}", file=sys.stderr)
        return 1
    print(f"PTX of the kernels: {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
