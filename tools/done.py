"""``python -m tools.done CHECK``: whether a long check was done for the files as they are.

Each writes a hash of what it checks into a file that is committed, with ``--write``.  Where that is
still the hash of the files, `make test` leaves the check out, and `make test-all` does it all the
same.
"""

import argparse
import hashlib
import platform
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
RECORDS = {
    "manual": ("docs/.built", "docs", "examples", "tools/manual", "constraints.txt"),
    "ptx": ("tools/aot/device/.assembled", "src/rocksteady/kernels", "tools/aot"),
    "uncompiled": (
        *("tests/kernels/.passed", "src/rocksteady/kernels", "src/rocksteady/outcomes.py"),
        *("src/rocksteady/installation", "tests/kernels", ":(glob)tests/*.py", "constraints.txt"),
    ),
}
"""By check: its record, and what it checks, as git names files."""
HERE = {"uncompiled": f"{platform.system()} {platform.machine()} {sys.version_info[:2]}"}
"""Where a check was done, of one that another system or Python may fail."""
WRITTEN = {"docs/benchmarks.md", "docs/images/architecture.png"}
"""Files that other tools write; nothing in them can fail."""


def hash_of(here: str, record: str, *patterns: str) -> str:
    """Return the hash of a place and of files that git tracks or would add, by name and content."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", *patterns],
        cwd=ROOT,
        capture_output=True,
        check=True,
    )
    digest = hashlib.sha256(here.encode())
    for name in sorted(set(listed.stdout.decode().split("\0")) - {"", record, *WRITTEN}):
        if (ROOT / name).is_file():
            content = hashlib.sha256((ROOT / name).read_bytes()).hexdigest()
            digest.update(f"{name}\0{content}\n".encode())
    return digest.hexdigest()


def main(arguments: list[str]) -> int:
    """Return 0 where the record is that of the files, and 1 where the check is to be done."""
    parser = argparse.ArgumentParser(prog="python -m tools.done", description=__doc__)
    parser.add_argument("check", choices=RECORDS)
    parser.add_argument("--write", action="store_true", help="record that it was done")
    given = parser.parse_args(arguments)
    record, *patterns = RECORDS[given.check]
    try:
        now = hash_of(HERE.get(given.check, ""), record, *patterns)
    except (OSError, subprocess.CalledProcessError):  # no checkout
        return 1
    if given.write:
        (ROOT / record).write_text(f"{now}\n", encoding="ascii")
        return 0
    if not (ROOT / record).is_file() or (ROOT / record).read_text(encoding="ascii").strip() != now:
        return 1
    print(f"{record} holds the hash of these files: nothing to do")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
