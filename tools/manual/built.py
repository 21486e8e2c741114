"""``python -m tools.manual.built``: whether the manual was built from its pages as they are.

`make docs` writes a hash of what the manual is made of into `docs/.built`, which is committed.
Where it is still that of the files, `make test` builds nothing; with ``--write`` it is renewed.
"""

import hashlib
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
RECORD = ROOT / "docs" / ".built"
SOURCES = ("docs", "examples", "tools/manual", "constraints.txt")
WRITTEN = ("docs/.built", "docs/benchmarks.md", "docs/images/architecture.png")
"""Files that tools write; nothing in them can fail to build."""


def pages_hash() -> str:
    """Return the hash of the files that git tracks or would add, by name and content."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", *SOURCES],
        cwd=ROOT,
        capture_output=True,
        check=True,
    )
    digest = hashlib.sha256()
    for name in sorted(set(listed.stdout.decode().split("\0")) - {"", *WRITTEN}):
        if (ROOT / name).is_file():
            digest.update(
                f"{name}\0{hashlib.sha256((ROOT / name).read_bytes()).hexdigest()}\n".encode()
            )
    return digest.hexdigest()


def main(arguments: list[str]) -> int:
    """Return 0 where the record is that of the files, and 1 where they are to be built."""
    try:
        now = pages_hash()
    except (OSError, subprocess.CalledProcessError):  # no checkout
        return 1
    if arguments == ["--write"]:
        RECORD.write_text(f"{now}\n", encoding="ascii")
        return 0
    if not RECORD.is_file() or RECORD.read_text(encoding="ascii").strip() != now:
        return 1
    print("the manual was built from these pages: `make docs` builds it again")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
