"""Build the wheels or check them: ``python -m tools.wheels build|check``; `make wheels` does both.

Exit codes: 0 done, 1 where a library does not fit its platform or a check has failed.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from tools.wheels.building import build, build_programs
from tools.wheels.first_start import check
from tools.wheels.platforms import PLATFORMS


def main(arguments: list[str]) -> int:
    """Run one of the two."""
    parser = argparse.ArgumentParser(prog="python -m tools.wheels", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    building = commands.add_parser("build", help="one wheel for each platform, one for GPUs")
    building.add_argument("--libraries", type=Path, required=True, help="what tools.aot has built")
    building.add_argument("--out", type=Path, required=True, help="folder for the wheels")
    checking = commands.add_parser("check", help="the wheel of this machine, as a new user")
    checking.add_argument("--wheels", type=Path, required=True, help="folder of the wheels")
    asked = parser.parse_args(arguments)
    if asked.command == "build":
        for platform in PLATFORMS:
            print(f"wrote {build(platform, asked.libraries, asked.out)}")
        print(f"wrote {build_programs(asked.libraries, asked.out)}")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        rows = check(sorted(asked.wheels.glob("*.whl")), Path(folder, "environment"))
    print(f"{'checked':62}{'found':32}at most")
    for what, found, goal, good in rows:
        print(f"{what:62}{found:32}{goal}{'' if good else '   FAILED'}")
    return 0 if all(row.good for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
