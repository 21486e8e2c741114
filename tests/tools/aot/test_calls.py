"""Recording of calls: the same ones each time, and many cells where a kernel takes many."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rocksteady.installation._recorded import dumped, loaded
from rocksteady.installation.check import RECORDED, replay
from rocksteady.kernels.entries import ENTRIES
from rocksteady.outcomes import Status
from tests.every import every
from tests.strategies import PLAIN
from tools.aot.calls.__main__ import large_calls, small_calls
from tools.aot.calls.drawn import MOTIONS, Drawn
from tools.aot.calls.recorder import Recorder

LANES = {
    "lane_attractors",
    "nonlinear_lane_attractors",
    "lane_fates",
    "nonlinear_lane_fates",
}
CELLS = LANES | {"fates_of_sides", "settle_cells", "pulse_fates", "record_fates"}
POINTS = {"fill_steady", "fill_curves"}

pytestmark = pytest.mark.skipif(PLAIN, reason="takes minutes uncompiled")


def test_the_shipped_calls_are_those_that_are_recorded_now() -> None:
    content = dumped(small_calls(ENTRIES))
    assert content == dumped(loaded(RECORDED.read_bytes())), "run `python -m tools.aot.calls`"
    assert dumped(small_calls(ENTRIES)) == content


def test_recorded_calls_do_not_depend_on_the_processor() -> None:
    """NumPy's own exponential differs between processors with and without AVX2 or AVX-512."""
    code = (
        "import hashlib; from rocksteady.installation._recorded import dumped\n"
        "from rocksteady.kernels.entries import ENTRIES\n"
        "from tools.aot.calls.__main__ import small_calls\n"
        "print(hashlib.sha256(dumped(small_calls(ENTRIES))).hexdigest())"
    )
    ran = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4"},
        cwd=Path(__file__).parents[3],
        capture_output=True,
        text=True,
        check=True,
    )
    assert ran.stdout.split()[-1] == hashlib.sha256(dumped(small_calls(ENTRIES))).hexdigest()


def test_large_calls_are_of_every_kernel_of_cells_in_both_models() -> None:
    calls = large_calls(ENTRIES, part=0.01)
    sizes: dict[str, list[int]] = {}
    for call in calls:
        largest = max(np.asarray(leaf).shape[0] for leaf in call.after if np.ndim(leaf))
        sizes.setdefault(call.entry, []).append(largest)
    assert set(sizes) >= CELLS | POINTS
    for name in CELLS - LANES - {"record_fates"}:
        assert sorted(sizes[name]) == [50, 1000], name
    assert all(check.equal for check in replay(calls, ENTRIES))
    (fates, _) = (call for call in calls if call.entry == "fates_of_sides")
    ends = np.unique(np.asarray(fates.after[8]), return_counts=True)
    counts = dict(zip(ends[0].tolist(), ends[1].tolist(), strict=True))
    assert counts[int(Status.ROCKING)] > 100
    assert counts[int(Status.OVERTURNED)] > 100


@every("kind", MOTIONS)
def test_a_name_decides_what_is_drawn(kind: str) -> None:
    for nonlinear in (False, True):
        first, again, other = (
            Drawn.by_name(name).segments(kind, nonlinear=nonlinear) for name in ("a", "a", "b")
        )
        np.testing.assert_array_equal(first, again)
        assert first.shape != other.shape or (first != other).any()
        assert first.shape[1] == (12 if nonlinear else 9)
        assert first[-1, 0] == np.inf
        assert np.isfinite(first[:-1, 0]).all()


def test_blocks_are_drawn_with_like_sides_and_unlike_ones() -> None:
    sides = Drawn.by_name("blocks").sides(1000, nonlinear=True, alike=0.25)
    alike = (sides[:, 0] == sides[:, 1]).all(axis=1)
    assert 150 < alike.sum() < 350
    assert (sides[:, :, 0] < 1.0).all()
    # The slenderness of either side over that of the first is its lean.
    np.testing.assert_allclose(sides[:, 1, 3], sides[:, 0, 3] * sides[:, 1, 1])


def test_the_recorder_calls_kernels_and_keeps_what_it_is_asked_to() -> None:
    call = Recorder(ENTRIES)
    assert call("side_of", 3) == call.quietly("side_of", 3) == -1
    assert [(record.entry, record.before, record.results) for record in call.calls] == [
        ("side_of", (3,), (-1,))
    ]
