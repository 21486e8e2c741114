"""Maps on floors: cells against the motion of the floor, one at a time."""

import math
from itertools import product

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Nonlinear,
    Rest,
    State,
    find_attractor,
    floor_motion,
    map_attractors,
    map_fates,
    simulate,
)
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.dynamics.orbits.attractor import ROUNDED
from rocksteady.errors import InputError, ModelError
from rocksteady.motions import Floor, FourierSeries

BLOCK = Block.rectangle(width=0.5, height=2.0)
FLOOR = Floor(frequencies_hz=[1.7, 5.2], damping=[0.05, 0.03], shapes=[1.3, -0.4])
AXES = {"acceleration_m_s2": [0.3, 0.8, 1.5, 3.0], "frequency_hz": [1.0, 1.6, 1.7, 2.5]}


def moved(acceleration: float, hertz: float, phase: float = 0.0) -> Harmonic:
    """Return the lasting shaking of the floor."""
    ground = Harmonic.from_si(
        BLOCK, acceleration_m_s2=acceleration, frequency_hz=hertz, phase=phase
    )
    return FLOOR.motion(ground, BLOCK)


def test_a_floor_lags_by_the_closed_form_at_resonance() -> None:
    zeta = 0.05
    one = Floor(frequencies_hz=2.0, damping=zeta)
    assert one.amplification(2.0) == pytest.approx(math.sqrt(1.0 + 4.0 * zeta**2) / (2.0 * zeta))
    assert one.phase_lead(2.0) == pytest.approx(-math.atan(1.0 / (2.0 * zeta)))
    assert one.phase_lead([1e-3, 1e4]) == pytest.approx([0.0, -0.5 * math.pi], abs=1e-2)
    with pytest.raises(InputError, match="frequency_hz"):
        one.phase_lead(0.0)


@pytest.mark.parametrize("phase", [0.0, 2.0])
def test_each_cell_settles_to_what_the_floor_alone_leads_to(phase: float) -> None:
    cells = map_attractors(BLOCK, FLOOR, axes={**AXES, "phase": phase})
    assert cells.attrs["floor"] == FLOOR.label
    for place, (acceleration, hertz) in enumerate(product(*AXES.values())):
        alone = find_attractor(BLOCK, moved(acceleration, hertz, phase))
        if alone.growth > ROUNDED:  # it may have been chosen by rounding
            continue
        kind = cells.kind.values.flat[place]
        assert (
            cells.kind.attrs["flag_meanings"]
            .split()[list(cells.kind.attrs["flag_values"]).index(kind)]
            .startswith(alone.kind.label)
        )
        if alone.peaks is not None and alone.kind.label != "overturned":
            assert cells.highest.values.flat[place] == pytest.approx(max(alone.peaks), rel=1e-9)
    ground = map_attractors(BLOCK, axes={**AXES, "phase": phase})
    assert (ground.kind != cells.kind).any()


@pytest.mark.parametrize("nonlinear", [False, True])
def test_each_fate_is_that_of_one_simulation(nonlinear: bool) -> None:
    model = Nonlinear() if nonlinear else None
    start = State(angle=0.2, velocity=-0.1)
    cells = map_fates(BLOCK, FLOOR, axes=AXES, start=start, cycles=6, model=model)
    labels = cells.fate.attrs["flag_meanings"].split()
    for place, (acceleration, hertz) in enumerate(product(*AXES.values())):
        motion = moved(acceleration, hertz)
        alone = simulate(BLOCK, motion, start=start, cycles=6, model=model)
        fate = list(cells.fate.attrs["flag_values"]).index(cells.fate.values.flat[place])
        assert labels[fate] == alone.status.label


def test_sizes_move_under_one_floor() -> None:
    ground = {"acceleration_m_s2": 1.0, "frequency_hz": 1.6}
    widths = [0.4, 0.6, 0.9]
    cells = map_attractors(BLOCK, FLOOR, axes={"width": widths, **ground})
    for place, width in enumerate(widths):
        block = Block.rectangle(width=width, height=2.0, restitution=BLOCK.restitution)
        motion = FLOOR.motion(Harmonic.from_si(block, **ground), block)
        alone = find_attractor(block, motion)
        assert cells.highest.values[place] == pytest.approx(
            math.nan if alone.peaks is None else max(alone.peaks), rel=1e-9, nan_ok=True
        )


def test_arrays_of_cells_are_the_nouns_to_the_last_bit() -> None:
    case = Scenario(axes=("width", "phase", *AXES), block=BLOCK, start=Rest(), floor=FLOOR)
    values = [[0.4, 0.7], [0.0, 3.0], *AXES.values()]
    rows = np.array(list(product(*values)))
    cells = case.cells(dict(zip(case.axes, rows.T.copy(), strict=True)))
    for place, row in enumerate(rows.tolist()):
        block, shaking, _ = case.at(dict(zip(case.axes, row, strict=True)))
        assert isinstance(block, Block)
        assert cells.amplitude[place] == shaking.amplitude
        assert cells.phase[place] == shaking.phase
        ground = Harmonic.from_si(
            block, acceleration_m_s2=row[2], frequency_hz=row[3], phase=row[1]
        )
        expected = FLOOR.motion(ground, block)
        assert shaking.amplitude == pytest.approx(expected.amplitude, rel=1e-12)
        assert math.cos(shaking.phase - expected.phase) == pytest.approx(1.0)


def test_a_floor_has_hertz_and_a_ground() -> None:
    axes = {"amplitude": [1.0, 2.0]}
    with pytest.raises(InputError, match="motion"):
        map_attractors(BLOCK, FLOOR, axes=axes)
    with pytest.raises(ModelError, match="no hertz"):
        map_fates(DimensionlessBlock(restitution=0.9), FLOOR, axes={**axes, "frequency_ratio": 2.0})


def test_a_series_of_one_sinusoid_keeps_the_amplitude_of_the_ground() -> None:
    ground = Harmonic.from_si(BLOCK, acceleration_m_s2=0.5, frequency_hz=2.0)
    series = FourierSeries(
        amplitude=ground.amplitude,
        frequency_ratio=ground.frequency_ratio,
        harmonics=((1, 1.0, 0.0),),
    )
    on_floor = floor_motion(series, frequencies_hz=1.7, block=BLOCK)
    factors = [0.5, 1.0, 1.5]
    sizes = [factor * ground.amplitude for factor in factors]
    cells = map_attractors(BLOCK, on_floor, axes={"amplitude": sizes})
    ratio = ground.frequency_ratio
    direct = map_attractors(
        BLOCK,
        Floor(frequencies_hz=1.7),
        axes={"amplitude": sizes, "frequency_ratio": ratio},
    )
    assert (cells.kind == direct.kind).all()
    assert cells.highest.values == pytest.approx(direct.highest.values, rel=1e-9, nan_ok=True)
