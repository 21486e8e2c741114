"""``python -m tools.aot.replay --built FOLDER``: repeat recorded calls on every target that runs.

FOLDER holds what ``python -m tools.aot build --out FOLDER`` has built. Without ``--large`` the
calls are those that the package ships; with it calls of up to 1e5 cells, recorded here and now.
"""

import argparse
import sys
import time
from pathlib import Path

from rocksteady.installation._recorded import loaded
from rocksteady.installation.check import RECORDED
from rocksteady.kernels.entries import ENTRIES
from tools.aot.calls.__main__ import large_calls
from tools.aot.replay.everywhere import RUNS
from tools.aot.replay.outcome import MissingProgramError, Repeated


def main() -> int:
    """Repeat the calls; return 1 where a value differs."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot.replay", description=__doc__)
    parser.add_argument("--built", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--large", action="store_true", help="calls of up to 1e5 cells")
    parser.add_argument("--part", type=float, default=1.0, help="share of the cells; default 1")
    parser.add_argument("--on", nargs="+", choices=RUNS, default=list(RUNS), metavar="TARGET")
    given = parser.parse_args()
    calls = loaded(RECORDED.read_bytes())
    if given.large:
        calls = large_calls(ENTRIES, given.part)
    wrong = False
    for name in given.on:
        began = time.perf_counter()
        found: list[Repeated] = []
        try:
            for call in [[call] for call in calls] if given.large else [calls]:
                found += RUNS[name](given.built, call)
        except MissingProgramError as error:
            print(f"{name:<16} not run: {error}")
            continue
        differing = sum(call.differing for call in found)
        values = sum(call.values for call in found)
        took = time.perf_counter() - began
        print(f"{name:<16} {len(found)} calls, {values:,} values, {took:.1f} s: ", end="")
        print(f"{differing:,} differ" if differing else "equal", flush=True)
        for entry in sorted({call.entry for call in found if call.differing}):
            print(f"  {entry}: {sum(c.differing for c in found if c.entry == entry):,}")
        wrong |= differing > 0
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
