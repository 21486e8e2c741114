"""Check the types of the page's modules with tsc: ``python -m tools.page``."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).parent
OLDEST = (5, 5)
"""First version of TypeScript that reads ``@import`` in comments."""


def main() -> int:
    """Run tsc on the page, or say why not; return its exit status."""
    program = shutil.which(os.environ.get("TSC", "tsc"))
    if program is None:
        print("The page's types are not checked: there is no tsc (npm install -g typescript).")
        return 0
    ran = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    version = tuple(int(part) for part in re.findall(r"\d+", ran.stdout)[:2])
    if version < OLDEST:
        oldest = ".".join(map(str, OLDEST))
        print(f"The page's types are not checked: {ran.stdout.strip()} is older than {oldest}.")
        return 0
    return subprocess.run([program, "--project", str(PROJECT)], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
