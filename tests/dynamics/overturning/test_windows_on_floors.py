"""Windows of pulses on floors: both sides of every end against one simulation each."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Linear,
    Nonlinear,
    Pulse,
    Record,
    Status,
    find_overturning_scales,
    find_overturning_windows,
    floor_motion,
    simulate,
)
from rocksteady.dynamics.overturning.windows import lowest_of
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import Model
from rocksteady.motions import Floor
from rocksteady.overturning import OverturningWindows

BLOCK = Block.rectangle(width=0.5, height=2.0)
MODES: dict[str, Any] = {"frequencies_hz": [1.7, 5.2], "damping": 0.05, "shapes": [1.3, -0.4]}
FLOOR = Floor(**MODES)
CLOSE = 1e-7
"""Distance from an end at which a block is simulated, as a part of it."""


def ratio_of(hertz: float, block: Block = BLOCK) -> float:
    return 2.0 * math.pi * hertz / block.p


def falls(found: OverturningWindows, index: int, amplitude: float) -> bool:
    """Return whether the block falls in one simulation of the floor's motion."""
    block = found.block
    assert isinstance(block, Block)
    ratio = float(found.frequency_ratio[index])
    pulse = replace(found.pulse, amplitude=amplitude, frequency_ratio=ratio)
    moved = floor_motion(pulse, block=block, **MODES)
    return simulate(block, moved, model=found.model).status is Status.OVERTURNED


RICKER = Pulse(shape="ricker", amplitude=1, frequency_ratio=1, tolerance=1e-3)
REVERSED = Pulse(shape="one-sine", amplitude=1, frequency_ratio=1, reverse=True)


@pytest.mark.parametrize(
    ("model", "pulse", "one_sided"),
    [
        (Linear(), REVERSED, True),
        pytest.param(Linear(), "one-sine", False, marks=pytest.mark.slow),
        pytest.param(Nonlinear(), RICKER, False, marks=pytest.mark.slow),
        pytest.param(Nonlinear(), "one-sine", False, marks=pytest.mark.slow),
        pytest.param(Linear(), RICKER, False, marks=pytest.mark.slow),
        pytest.param(Nonlinear(), REVERSED, True, marks=pytest.mark.slow),
    ],
)
def test_each_end_parts_falls_from_stands(
    model: Model, pulse: Pulse | str, one_sided: bool
) -> None:
    block = BLOCK.against_wall(0.8) if one_sided else BLOCK
    ratios = [ratio_of(0.8), ratio_of(1.7)]
    found = find_overturning_windows(
        block, pulse, ratios, within=(0.05, 2.5), model=model, floor=FLOOR
    )
    assert not found.undecided.any()
    tried = 0
    for index in range(len(ratios)):
        for low, high in found.intervals(index):
            if high - low < 1e3 * CLOSE:
                continue
            assert falls(found, index, low * (1.0 + CLOSE))
            if low > found.within[0]:
                assert not falls(found, index, low * (1.0 - CLOSE))
            if high < found.within[1]:
                assert falls(found, index, high * (1.0 - CLOSE))
                assert not falls(found, index, high * (1.0 + CLOSE))
            tried += 1
    assert tried >= 2


@pytest.mark.slow
def test_windows_are_those_of_a_record_of_the_floor() -> None:
    times, hertz = 2000, 0.8
    dt = 1.0 / (hertz * times)
    samples = [math.sin(2.0 * math.pi * k / times) for k in range(times)] + [0.0, 0.0]
    ground = Record(acceleration_m_s2=np.array(samples), dt_s=dt)
    moved = floor_motion(ground, tolerance=1e-5, **MODES)
    scales = find_overturning_scales(BLOCK, moved, within=(0.5, 8.0))
    found = find_overturning_windows(BLOCK, "one-sine", [ratio_of(hertz)], floor=FLOOR)
    unit = BLOCK.uplift_acceleration
    assert float(found.first[0]) * unit == pytest.approx(float(scales.first[0]), rel=2e-3)


def test_a_stiff_building_is_the_ground() -> None:
    ratios = [2.0, 4.0]
    stiff = Floor(frequencies_hz=2000.0)
    on_floor = find_overturning_windows(BLOCK, "one-sine", ratios, within=(1.0, 12.0), floor=stiff)
    ground = find_overturning_windows(BLOCK, "one-sine", ratios, within=(1.0, 12.0))
    for index in range(2):
        assert on_floor.intervals(index)[0] == pytest.approx(ground.intervals(index)[0], rel=5e-3)


def test_words_and_data_have_the_floor() -> None:
    found = find_overturning_windows(
        BLOCK, "one-sine", [3.0], model=Linear(), within=(0.1, 6.0), floor=FLOOR
    )
    text = str(found.describe())
    assert FLOOR.label in text
    values = found.to_dict()
    assert values["floor"] == FLOOR.label
    assert values["windows"][0]["closed_form"] is None
    assert found.to_dataset().attrs["floor"] == FLOOR.label


@pytest.mark.parametrize(
    ("pulse", "damping", "share"), [("one-sine", 0.05, 0.4), ("type-c8", 0.01, 0.048)]
)
def test_the_search_begins_where_the_block_lifts(pulse: str, damping: float, share: float) -> None:
    # A long pulse at a floor of little damping lifts a block below a twentieth of its uplift.
    floor = Floor(frequencies_hz=1.7, damping=damping, shapes=1.3)
    ratios = [ratio_of(1.5), ratio_of(1.7)]
    unit = Pulse(shape=pulse, amplitude=1.0, frequency_ratio=1.0)
    low = lowest_of(BLOCK, unit, ratios, model=None, floor=floor)
    assert low < share
    highest = []
    for amplitude in (low * (1.0 - 1e-9), low * (1.0 + 1e-6)):
        shaken = [replace(unit, amplitude=amplitude, frequency_ratio=ratio) for ratio in ratios]
        highest.append(max(simulate(BLOCK, floor.motion(each, BLOCK)).peak for each in shaken))
    assert highest[0] == 0.0 < highest[1]


def test_the_usual_range_begins_where_the_block_lifts() -> None:
    found = find_overturning_windows(BLOCK, "one-sine", [3.0], model=Linear(), floor=FLOOR)
    low = lowest_of(BLOCK, found.pulse, [3.0], model=Linear(), floor=FLOOR)
    assert found.within == (low, 20.0)
    assert 0.0 < low < float(found.first[0])


def test_a_floor_needs_a_block_with_a_size() -> None:
    with pytest.raises(ModelError, match="floor"):
        find_overturning_windows(DimensionlessBlock(restitution=0.9), "one-sine", 2.0, floor=FLOOR)
    with pytest.raises(InputError, match="floor"):
        find_overturning_windows(BLOCK, "one-sine", 2.0, floor=1.7)  # type: ignore[arg-type]
