"""Record every answer of the package, or compare the answers with the records.

``python -m tools.freeze record`` writes the records, ``python -m tools.freeze compare`` prints
what has moved since and ends with 1 where anything has. Each takes ``--all`` for the large set,
which holds the quick one, and names of parts for these alone.
"""

import argparse
import os
import sys
import time
from pathlib import Path

SCRATCH = Path("build", "frozen").absolute()
"""Folder for what has moved, whole."""
ENVIRONMENT = {
    "COLUMNS": "80",
    "LC_ALL": "C.UTF-8",
    "MPLBACKEND": "agg",
    "MPLCONFIGDIR": str(SCRATCH / "matplotlib"),
    # Instructions that every processor has: last bits of NumPy and BLAS are those of any machine.
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL AVX512_SPR",
    "OPENBLAS_CORETYPE": "Haswell",
    "SOURCE_DATE_EPOCH": "0",
    "TZ": "UTC",
}
"""Variables that answers may not depend on; they are the same in each process."""


def main(words: list[str]) -> int:
    """Record or compare; return 1 where anything has moved."""
    from tools.freeze import records, run
    from tools.freeze.parts import LARGE, PARTS

    parser = argparse.ArgumentParser(prog="python -m tools.freeze", description=__doc__)
    parser.add_argument("task", choices=("record", "compare"))
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(PARTS))
    parser.add_argument("--all", action="store_true", help="the large set too")
    parser.add_argument("--workers", type=int, default=2, help="processes; default 2")
    given = parser.parse_args(words)
    names = given.parts or [name for name in PARTS if given.all or name not in LARGE]
    began, count = time.perf_counter(), 0
    for part in run.frozen(names, given.workers):
        file = records.FOLDER / f"{part.part}.txt"
        before = records.loaded(file.read_text(encoding="utf-8")) if file.exists() else {}
        # What cannot be computed here stays as it is recorded.
        left = tuple(f"{unit}: " for unit in part.missing)
        kept = {name: text for name, text in before.items() if name.startswith(left)}
        now = records.short(part.items) | kept
        print(f"{part.part:<14} {len(now):5d} items {part.seconds:6.1f} s", flush=True)
        for unit, why in part.missing.items():
            print(f"{unit} is not compared: {why}")
        if given.task == "record":
            file.parent.mkdir(exist_ok=True)
            file.write_text(records.dumped(now), encoding="utf-8")
            continue
        found = records.moved(before, records.loaded(records.dumped(now)))
        print("".join(f"{text}\n" for text in found.values()), end="", flush=True)
        SCRATCH.mkdir(parents=True, exist_ok=True)
        whole = records.dumped({name: part.items[name] for name in found if name in part.items})
        (SCRATCH / f"{part.part}.txt").write_text(whole, encoding="utf-8")
        count += len(found)
    if count:
        print(f"{count} items have moved; {SCRATCH} has what they are now, whole")
    print(f"{time.perf_counter() - began:.0f} s")
    return int(count > 0)


if __name__ == "__main__":
    os.environ.update(ENVIRONMENT)
    sys.exit(main(sys.argv[1:]))
