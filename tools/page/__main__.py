"""Check the page's modules with TypeScript: ``python -m tools.page``.

It finds wrong types, undefined and unused names, and statements that are never reached.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from tools.aot.web.program import bundler

PROJECT = Path(__file__).parent
NOT_RUN = PROJECT.parents[1] / "build" / "not-run" / "types"
"""Where `make` reads what a check could not run."""
OLDEST = (5, 5)
"""First version of TypeScript that reads ``@import`` in comments."""
TYPESCRIPT = "typescript@5.9.3"
"""What bun runs, and downloads the first time, where there is no tsc."""


def main() -> int:
    """Run tsc on the page, or say why not; return its exit status."""
    tsc = shutil.which(os.environ.get("TSC", "tsc"))
    bun = bundler()
    command = [tsc] if tsc else [*bun, "x", "--package", TYPESCRIPT, "tsc"] if bun else []
    if not command:
        return _left_out("there is neither tsc nor bun: npm install -g typescript")
    asked = subprocess.run([*command, "--version"], capture_output=True, text=True, check=False)
    version = re.search(r"Version (\d+)\.(\d+)", asked.stdout)
    if version is None:
        return _left_out(f"bun cannot download {TYPESCRIPT}")
    if tuple(map(int, version.groups())) < OLDEST:
        oldest = ".".join(map(str, OLDEST))
        return _left_out(f"{asked.stdout.strip()} of tsc is older than {oldest}")
    return subprocess.run([*command, "--project", str(PROJECT)], check=False).returncode


def _left_out(why: str) -> int:
    line = f"the page's types ({why})"
    print(f"Not run: {line}")
    NOT_RUN.parent.mkdir(parents=True, exist_ok=True)
    NOT_RUN.write_text(f"{line}\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
