"""Check the types of the page's modules with tsc: ``python -m tools.page``."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).parent
NOT_RUN = PROJECT.parents[1] / "build" / "not-run" / "types"
"""Where `make` reads what a check could not run."""
OLDEST = (5, 5)
"""First version of TypeScript that reads ``@import`` in comments."""


def main() -> int:
    """Run tsc on the page, or say why not; return its exit status."""
    program = shutil.which(os.environ.get("TSC", "tsc"))
    if program is None:
        return _left_out("there is no tsc: npm install -g typescript")
    ran = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    version = tuple(int(part) for part in re.findall(r"\d+", ran.stdout)[:2])
    if version < OLDEST:
        oldest = ".".join(map(str, OLDEST))
        return _left_out(f"{ran.stdout.strip()} of tsc is older than {oldest}")
    return subprocess.run([program, "--project", str(PROJECT)], check=False).returncode


def _left_out(why: str) -> int:
    line = f"the page's types ({why})"
    print(f"Not run: {line}")
    NOT_RUN.parent.mkdir(parents=True, exist_ok=True)
    NOT_RUN.write_text(f"{line}\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
