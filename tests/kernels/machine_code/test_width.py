"""One lane, as a device has, gives the bits of many."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rocksteady.kernels.lanes._fields import LANES
from rocksteady.kernels.machine_code import width
from rocksteady.kernels.nonlinear_lanes import _layout
from tests.kernels.queued import CASES, bits

# Empty lanes divide by zero, of which kernels warn where nothing compiles them.
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")

ROOT = Path(__file__).parents[3]
IN_LANES = ("lane_fates", "nonlinear_lane_fates", "lane_attractors", "nonlinear_lane_attractors")


def test_a_processor_follows_many_cells_at_a_time_and_a_device_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert width.side_by_side(48) == LANES == 48
    assert width.side_by_side(32) == _layout.LANES == 32
    monkeypatch.setattr(width, "ON_DEVICE", True)
    assert width.side_by_side(48) == 1


@pytest.mark.slow
def test_one_lane_gives_the_bits_of_many() -> None:
    script = "from rocksteady.kernels.machine_code import width; width.ON_DEVICE = True; "
    done = subprocess.run(
        [sys.executable, "-c", script + f"from {__name__} import print_bits; print_bits()"],
        env={**os.environ, "PYTHONPATH": str(ROOT), "ROCKSTEADY_KERNELS": "python"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found.pop("lanes") == [1, 1]
    for name in IN_LANES:
        kernel, make = CASES[name]
        arguments = make()
        kernel(*arguments)
        assert found[name] == [each.hex() for each in bits(arguments)], name


def print_bits() -> None:
    """Print the bits of the kernels with lanes."""
    found: dict[str, object] = {"lanes": [LANES, _layout.LANES]}
    for name in IN_LANES:
        kernel, make = CASES[name]
        arguments = make()
        with np.errstate(all="ignore"):
            kernel(*arguments)
        found[name] = [each.hex() for each in bits(arguments)]
    json.dump(found, sys.stdout)
