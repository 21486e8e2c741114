"""The PTX itself, executed by the lanes of a warp: the same bits as the library, and no hazard."""

import numpy as np
import pytest
from filelock import FileLock

from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.devices import FORMS, Form
from rocksteady.kernels.machine_code.library import targets
from rocksteady.kernels.machine_code.sources import libraries_folder, sources_hash
from tests.strategies import PLAIN
from tests.tools.aot.device.test_emulate import RARE, bits, calls_of, code, results_of
from tools.aot.build import LOWERED
from tools.aot.device.build import file_of, is_current, ptx
from tools.aot.device.execute import Executed
from tools.aot.device.program import OLDEST
from tools.aot.device.ptx.hazards import facts
from tools.aot.device.ptx.text import parsed
from tools.aot.device.ptx_to_c import HAZARDS
from tools.aot.link import compilers
from tools.aot.targets import TARGETS

pytestmark = pytest.mark.skipif(PLAIN, reason="no kernel is compiled")

OF_A_DEVICE = 0x7FF8000000000123
"""Bits of a NaN that no processor makes: a device makes another one than this processor."""
STACK = 8 * 1024
"""Most bytes of stack that a kernel declares."""


NAMES = ("lane_fates", "settle_cells", "nonlinear_record_fates")
"""Forms that are executed: with votes, with room for a history, and with what all cells share."""


@pytest.fixture(params=NAMES)
def run(request: pytest.FixtureRequest) -> tuple[Form, Executed, str]:
    """A form, the device that executes it, and its PTX."""
    if not targets() or not compilers(TARGETS[targets()[0]]):
        pytest.skip("no C compiler is in reach: gcc, clang or the package ziglang")
    form = FORMS[request.param]
    name = form.queued.py_func.__name__
    folder = LOWERED / f"{sources_hash()}-executed"
    folder.mkdir(parents=True, exist_ok=True)
    with FileLock(folder / f"{name}.lock"):
        file = file_of(libraries_folder(), OLDEST, name)  # what a GPU is given
        if not is_current(file):
            file = folder / f"{name}.ptx"
            file.write_text(ptx(name), "ascii")
        device = Executed([file], folder, checked=True, nan=OF_A_DEVICE)
    return form, device, file.read_text("ascii")


@pytest.mark.slow
def test_every_bit_is_that_of_the_library(run: tuple[Form, Executed, str]) -> None:
    form, device, text = run
    (program,) = device.programs.values()
    for call in calls_of(form):
        computed = results_of(form, device.run, call)
        expected = [np.asarray(each) for each in call.after[-len(computed) :]]
        done, known = code(computed) != LEFT_OVER, code(expected) != LEFT_OVER
        for mine, theirs in zip(computed, expected, strict=True):
            assert np.array_equal(bits(mine[done & known]), bits(theirs[done & known]))
        assert not (done & ~known).any()
        assert (known & ~done).mean() < RARE
        # Coefficients that a step leaves unfilled are copied along, and do not count: here, as all
        # stack memory at first, they are NaN.
        assert {each.kind for each in program.hazards()} <= {HAZARDS[3]}
    votes = program.votes()
    assert (votes.parted, votes.partial) == (0, 0)
    found = facts(parsed(text))
    assert found.stack < STACK
    assert found.endless == ()
    assert bool(found.votes) == (votes.taken > 0)
