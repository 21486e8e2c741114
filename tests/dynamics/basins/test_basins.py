"""Basins: each state as alone, symmetries to the bit, a still base in closed form, shares."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady import (
    DimensionlessBlock,
    Execution,
    Harmonic,
    Rest,
    State,
    Status,
    Still,
    compute_basins,
    find_attractor,
    simulate,
)
from rocksteady.basins import BasinAttractor, Basins
from rocksteady.dynamics.basins.window import centred, reach
from rocksteady.errors import InputError, ModelError
from rocksteady.orbits import Orbit
from rocksteady.outcomes import AttractorKind
from tests.dynamics.kicks import apart
from tests.every import every

Floats = NDArray[np.float64]

# Amplitude, frequency ratio, restitution: two mirrored orbits, a subharmonic one beside the
# harmonic, rest beside an orbit, and motions that do not repeat.
POINTS = [(2.0, 1.9, 0.8), (1.5, 4.0, 0.9), (0.5, 2.0, 0.8), (0.5, 2.0, 0.95), (6.0, 6.0, 0.25)]
MOTION = Harmonic(amplitude=0.5, frequency_ratio=2.0)
FEW: dict[str, Any] = {"angles": [-0.9, -0.3, 0.3, 0.9], "velocities": [-0.4, 0.0, 0.4]}


def window(half_width: float, count: int) -> Floats:
    from_middle = np.arange(count, dtype=np.float64) - 0.5 * (count - 1)
    middles: Floats = from_middle * (2.0 * half_width / count)
    return middles


def at(
    amplitude: float,
    frequency: float,
    restitution: float,
    phase: float = 0.4,
    count: int = 24,
    **more: Any,
) -> Basins:
    axes = {"angles": window(1.2, count), "velocities": window(1.2, count)}
    return compute_basins(
        DimensionlessBlock(restitution=restitution),
        Harmonic(amplitude=amplitude, frequency_ratio=frequency, phase=phase),
        **{**axes, **more},
    )


def same_orbit(one: Orbit | None, other: Orbit | None) -> bool:
    """Whether two orbits have their states in common."""
    if one is None or other is None:
        return one is other
    nearest = min(apart(one.states[0], state) for state in other.states)
    return one.period == other.period and len(one.states) == len(other.states) and nearest < 1e-6


@every("point", POINTS)
@every("seed", [None, 5])
def test_each_state_goes_where_it_goes_alone(
    point: tuple[float, float, float], seed: int | None
) -> None:
    found = at(*point, count=14, max_cycles=400, seed=seed)
    for row, column in np.ndindex(found.label.shape):
        state = State(
            angle=float(found.start_angle[row, column]),
            velocity=float(found.start_velocity[row, column]),
        )
        alone = find_attractor(found.block, found.motion, start=state, max_cycles=400)
        here = found.attractors[found.label[row, column]]
        assert here.kind is alone.kind
        assert same_orbit(here.orbit, alone.orbit)


def mirrored(one: BasinAttractor, among: tuple[BasinAttractor, ...]) -> int:
    """Return the label of a mirror image."""
    if one.orbit is None:
        return next(other.label for other in among if other.kind is one.kind)
    image = one.orbit.mirrored
    return next(other.label for other in among if same_orbit(image, other.orbit))


@pytest.mark.slow
@every("point", POINTS)
@every("phase", [0.0, 0.3, 2.0, 4.5])
def test_the_mirrored_window_half_a_period_later_has_the_mirrored_basins(
    point: tuple[float, float, float], phase: float
) -> None:
    here = at(*point, phase=phase, max_cycles=200)
    there = at(*point, phase=phase + math.pi, max_cycles=200)
    assert np.array_equal(here.angle, -here.angle[::-1])
    image = np.array([mirrored(one, there.attractors) for one in here.attractors])
    assert sorted(image.tolist()) == list(range(len(there.attractors)))
    assert np.array_equal(image[here.label], there.label[::-1, ::-1])


@given(
    point=st.sampled_from(POINTS),
    phase=st.floats(0.0, 6.28).map(lambda phase: round(phase, 6)),
    turns=st.integers(-3, 3),
)
@settings(max_examples=25)
def test_whole_periods_later_nothing_has_changed(
    point: tuple[float, float, float], phase: float, turns: int
) -> None:
    here = at(*point, phase=phase, max_cycles=100, count=12)
    there = at(*point, phase=phase + turns * 2.0 * math.pi, max_cycles=100, count=12)
    assert np.array_equal(here.label, there.label)
    assert here.fractions() == there.fractions()
    assert here.motion == there.motion


def test_two_mirror_images_attract_each_for_itself() -> None:
    found = at(2.0, 1.9, 0.8)
    names = [one.name for one in found.attractors]
    assert names == ["overturned", "unsymmetric-1a", "unsymmetric-1b"]
    first, second = (one.orbit for one in found.attractors[1:])
    assert first is not None
    assert second is not None
    assert first.highest > -first.lowest  # the one that leans to the positive side comes first
    assert same_orbit(first.mirrored, second)
    assert not same_orbit(first, second)
    assert [one.period for one in found.attractors] == [None, 1, 1]


def test_a_subharmonic_orbit_is_one_attractor_whatever_its_shift_in_time() -> None:
    found = at(1.5, 4.0, 0.9, count=60)
    (three,) = (one for one in found.attractors if one.period == 3)
    assert three.orbit is not None
    run = three.orbit.trajectory()
    since = (found.motion.phase - three.orbit.motion.phase) % (2.0 * math.pi)
    points = []
    for turn in range(3):
        here = run((since + 2.0 * math.pi * turn) / 4.0 % run.end_time_pt)
        angle, velocity = float(here.angle), float(here.velocity)
        points.append((angle, velocity))
        near = np.array([-1e-6, 1e-6])
        around = at(1.5, 4.0, 0.9, angles=angle + near, velocities=velocity + near)
        (only,) = around.attractors
        assert same_orbit(only.orbit, three.orbit)
    assert np.ptp([angle for angle, _ in points]) > 0.01  # three points and not one


def test_labels_do_not_depend_on_the_grid() -> None:
    one = at(0.5, 2.0, 0.95, count=40)
    other = at(0.5, 2.0, 0.95, count=61, seed=1, run=Execution(executor="serial"))
    assert [a.name for a in one.attractors] == [a.name for a in other.attractors]
    assert len(one.attractors) == 4
    for first, second in zip(one.attractors, other.attractors, strict=True):
        assert first.label == second.label
        if first.orbit is not None:
            assert second.orbit is not None
            assert first.orbit.states[0].phase == min(s.phase for s in first.orbit.states)
            assert apart(first.orbit.states[0], second.orbit.states[0]) < 1e-9


@given(restitution=st.floats(0.3, 0.99), phase=st.floats(0.0, 6.0))
@settings(max_examples=20)
def test_on_a_still_base_every_state_is_known_in_closed_form(
    restitution: float, phase: float
) -> None:
    found = at(0.0, 1.5, restitution, phase=phase, count=30)
    u, v = found.start_angle, found.start_velocity
    side = np.where(u != 0.0, np.sign(u), np.sign(v))
    y, w = side * u, side * v
    # Upwards past the balance it falls at once; else it lands with a speed that its energy gives,
    # and falls on the other side if what an impact leaves of it is above 1.
    growing = y + w - 1.0
    landing = np.sqrt(np.maximum(w**2 - (y - 1.0) ** 2 + 1.0, 0.0))
    other = restitution * landing - 1.0
    falls = (growing > 0.0) | (other > 0.0)
    clear = (np.abs(growing) > 1e-9) & (np.abs(other) > 1e-9)
    kinds = np.array([one.kind.value for one in found.attractors])[found.label]
    assert set(kinds.ravel()) == {"overturned", "rest"}
    assert np.array_equal((kinds == "overturned")[clear], falls[clear])


def test_by_default_the_window_is_that_of_the_page() -> None:
    block = DimensionlessBlock(restitution=0.8)
    found = compute_basins(block, Harmonic(amplitude=1.0, frequency_ratio=2.0), max_cycles=20)
    assert found.label.shape == (108, 144)
    for axis, end in ((found.angle, 1.2), (found.velocity, 1.5)):
        assert np.array_equal(axis, -axis[::-1])
        assert axis[-1] + 0.5 * (axis[1] - axis[0]) == pytest.approx(end)


def test_beyond_its_reach_no_state_stands() -> None:
    block = DimensionlessBlock(restitution=0.8)
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0, phase=1.0)
    bound = reach(1.0, 2.0)
    assert bound == pytest.approx(1.0 + 1.0 / math.sqrt(5.0))
    axis = centred(bound)
    found = compute_basins(block, motion, angles=axis, velocities=axis)
    kinds = np.array([one.kind.value for one in found.attractors])[found.label]
    u, v = np.meshgrid(found.angle, found.velocity)
    beyond = (np.sign(u) == np.sign(v)) & (np.abs(u + v) > bound)
    assert (kinds[beyond] == "overturned").all()
    assert (kinds[~beyond] != "overturned").any()


def test_shares_add_up_and_their_interval_is_wilsons() -> None:
    found = at(0.5, 2.0, 0.8)
    parts = found.fractions()
    assert sum(part.states for part in parts) == found.label.size == 24 * 24
    assert sum(part.share for part in parts) == pytest.approx(1.0, abs=1e-15)
    for confidence, z in ((0.95, 1.959963984540054), (0.99, 2.5758293035489004)):
        for part in found.fractions(confidence):
            n, p = found.label.size, part.share
            middle = (p + z * z / (2 * n)) / (1 + z * z / n)
            half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
            assert part.low == pytest.approx(middle - half, abs=1e-12)
            assert part.high == pytest.approx(middle + half, abs=1e-12)
            assert part.states == (found.label == part.label).sum()


def test_a_seed_draws_one_state_in_each_cell_and_does_not_depend_on_how_they_are_dealt() -> None:
    one = at(0.5, 2.0, 0.8, seed=7)
    other = at(0.5, 2.0, 0.8, seed=7, run=Execution(executor="serial"))
    assert np.array_equal(one.label, other.label)
    assert np.array_equal(one.start_angle, other.start_angle)
    step = one.angle[1] - one.angle[0]
    part = (one.start_angle - one.angle) / step
    assert part.min() >= -0.5 - 1e-9
    assert part.max() < 0.5 + 1e-9
    # 576 numbers: mean and variance of a uniform one, within four standard errors.
    assert abs(part.mean()) < 4.0 * math.sqrt(1.0 / 12.0 / 576.0)
    assert abs(part.var() - 1.0 / 12.0) < 4.0 * math.sqrt(1.0 / 180.0 / 576.0)
    assert not np.array_equal(one.start_angle, at(0.5, 2.0, 0.8, seed=8).start_angle)


def test_without_loss_nothing_settles() -> None:
    found = at(0.3, 2.0, 1.0, count=8, max_cycles=100)
    assert {one.kind for one in found.attractors} == {
        AttractorKind.OVERTURNED,
        AttractorKind.UNDECIDED,
    }


def test_a_dataset_holds_it_all() -> None:
    found = at(2.0, 1.9, 0.8, seed=3)
    data = found.to_dataset()
    assert data.label.dims == ("velocity", "angle")
    assert data.label.attrs["flag_meanings"] == "overturned unsymmetric-1a unsymmetric-1b"
    assert np.array_equal(data.label.values, found.label)
    assert data.share.sel(attractor="overturned") == found.fractions()[0].share
    assert data.impacts.values.tolist() == [0, 2, 2]
    assert data.attrs["seed"] == "3"
    assert data.attrs["phase"] == 0.4


def test_a_notebook_sees_a_table() -> None:
    text = at(2.0, 1.9, 0.8)._repr_html_()
    assert "3 basins at phase 0" in text
    assert text.count("unsymmetric-1") == 2


@every(
    ("arguments", "valid"),
    [
        ({"angles": [1.0]}, "evenly spaced"),
        ({"angles": [0.0, 1.0, 3.0]}, "evenly spaced"),
        ({"velocities": [1.0, 0.0]}, "evenly spaced"),
        ({"velocities": [0.0, math.nan]}, "finite"),
        ({"angles": [0.0, 1e60]}, "must lie in"),
        ({"max_cycles": 0}, "whole number"),
        ({"seed": -1}, "whole number"),
        ({"seed": 1.5}, "whole number"),
    ],
)
def test_what_makes_no_window_is_refused(arguments: dict[str, Any], valid: str) -> None:
    with pytest.raises(InputError, match=valid):
        at(1.0, 2.0, 0.8, **arguments)
    with pytest.raises(InputError, match="confidence"):
        at(1.0, 2.0, 0.8, count=2).fractions(1.0)


def test_only_periodic_shaking_has_basins() -> None:
    with pytest.raises(ModelError, match="orbits and attractors are those of periodic shaking"):
        compute_basins(DimensionlessBlock(restitution=0.8), Still())  # type: ignore[arg-type]


def test_there_is_a_row_a_state_with_the_name_of_its_attractor() -> None:
    found = compute_basins(DimensionlessBlock(restitution=0.8), MOTION, **FEW, max_cycles=200)
    rows = list(found.to_dataframe().itertuples(index=False, name=None))
    assert len(rows) == 12
    names = {one.label: one.name for one in found.attractors}
    assert all(name == names[label] for _, _, label, name in rows)
    assert {angle for angle, *_ in rows} == set(FEW["angles"])


def test_an_attractor_and_a_cell_are_starts() -> None:
    block = DimensionlessBlock(restitution=0.95)
    found = compute_basins(block, MOTION, **FEW)
    kinds = set()
    for attractor in found.attractors:
        kinds.add(attractor.kind.value)
        if attractor.orbit is not None:
            period = attractor.orbit.period
            run = simulate(block, found.motion, start=attractor.start, cycles=3 * period)
            back = run([0.0, *(np.arange(1, 3) * period * np.pi)])  # 2 pi/Omega is pi
            np.testing.assert_allclose(back.angle, back.angle[0], atol=1e-8)
            np.testing.assert_allclose(
                run.peak, max(attractor.orbit.highest, -attractor.orbit.lowest), rtol=1e-6
            )
        elif attractor.kind.value == "rest":
            assert attractor.start == Rest()
        else:
            with pytest.raises(ModelError, match="only an orbit and the rest"):
                _ = attractor.start
    assert {"overturned", "symmetric"} <= kinds
    falls = next(one.label for one in found.attractors if one.kind.value == "overturned")
    for row, column in np.ndindex(found.label.shape):
        run = simulate(block, found.motion, start=found.state(row, column), cycles=200)
        assert (run.status is Status.OVERTURNED) == (found.label[row, column] == falls)
