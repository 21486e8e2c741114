"""Floors against an independent integrator, the closed form at resonance, and the rigid limit."""

import itertools
import math
import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from rocksteady import (
    BaseMotion,
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    Pulse,
    Record,
    Still,
    floor_motion,
    read_record,
    run_ensemble,
    simulate,
    simulate_many,
)
from rocksteady.arrays import Floats
from rocksteady.dynamics.history.base_motion import base_acceleration
from rocksteady.errors import InputError, ModelError
from rocksteady.measures import compute_response_spectrum
from rocksteady.model.linear_tables import segment_table
from rocksteady.motions import Floor, FourierSeries, Impulses, Segment, cut, make_synthetic_suite
from rocksteady.records import Cleaning, resample
from rocksteady.risk import Levels
from tests.records import ABSENT, FOLDER, recording, synthetic

BLOCK = Block.rectangle(width=0.6, height=2.0)
TWO: dict[str, Any] = {
    "frequencies_hz": [1.5, 4.0],
    "damping": [0.05, 0.02],
    "shapes": [1.25, -0.4],
}


def integrated(floor: Floor, ground: Any, times: Floats, breaks: Floats) -> Floats:
    """Return the acceleration of a floor by DOP853, begun again where the ground has corners."""
    hertz, damping, shapes = np.array(floor.modes).T
    w = 2.0 * math.pi * hertz

    def rate(t: float, y: Floats) -> Floats:
        x, v = y.reshape(2, -1)
        return np.concatenate([v, -2.0 * damping * w * v - w * w * x - ground(t)])

    y, found = np.zeros(2 * len(w)), np.empty(len(times))
    for start, end in itertools.pairwise(breaks):
        of = (times >= start) & (times < end)
        middle = np.clip(times[of], start + 1e-12, end - 1e-12)
        ends = solve_ivp(
            rate, (start, end), y, method="DOP853", t_eval=[*middle, end], rtol=1e-11, atol=1e-13
        ).y
        x, v = ends[: len(w), :-1], ends[len(w) :, :-1]
        here = np.array([ground(t) for t in middle])
        total = -(shapes * 2.0 * damping * w) @ v - (shapes * w * w) @ x
        found[of] = (1.0 - shapes.sum()) * here + total
        y = ends[:, -1]
    return found


def of_record(record: Record, times: Floats) -> Floats:
    """Return the acceleration of a record between its samples, and 0 after the last."""
    at = record.dt_s * np.arange(len(record.acceleration_m_s2))
    return np.interp(times, at, record.acceleration_m_s2, right=0.0)


@given(
    samples=st.lists(st.floats(-4.0, 4.0), min_size=3, max_size=12),
    dt=st.floats(0.01, 0.3),
    hertz=st.lists(st.floats(0.3, 15.0), min_size=1, max_size=3),
    damping=st.floats(0.01, 0.6),
    tolerance=st.sampled_from([1e-2, 1e-3, 1e-4]),
)
@settings(max_examples=25, deadline=None)
def test_the_floor_of_a_record_is_that_of_an_integrator(
    samples: list[float], dt: float, hertz: list[float], damping: float, tolerance: float
) -> None:
    if max(map(abs, samples[:-1])) < 0.1:
        samples[1] = 1.0
    samples[-1] = 0.0  # else the floor falls to its free swing within one step
    ground = Record(acceleration_m_s2=np.array(samples), dt_s=dt)
    floor = Floor(frequencies_hz=hertz, damping=damping, shapes=[1.3 / len(hertz)] * len(hertz))
    found = floor.motion(ground, tolerance=tolerance)
    last = ground.duration_s
    times = np.linspace(0.0, last + 0.5, 301)[:-1]
    breaks = np.append(dt * np.arange(len(samples)), last + 0.5)
    expected = integrated(floor, lambda t: of_record(ground, np.array(t)), times, breaks)
    error = np.abs(of_record(found, times) - expected).max()
    assert error <= tolerance * ground.peak_acceleration_m_s2 * (1.0 + 1e-6)
    assert found.ground == ground
    # The whole interval of the ground's samples is kept, so that both have their corners together.
    assert round(ground.dt_s / found.dt_s) * found.dt_s == pytest.approx(ground.dt_s, rel=1e-12)


@pytest.mark.parametrize(
    "motion",
    [
        Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0),
        Pulse(shape="triangle", amplitude=2.0, frequency_ratio=3.0),
        cut(Harmonic(amplitude=1.0, frequency_ratio=5.0, phase=0.4), 2.0),
        Piecewise(
            pieces=(
                Segment(duration=0.7, constant=1.0, slope=-0.5),
                Segment(
                    duration=1.1,
                    amplitude=0.8,
                    frequency=2.0,
                    harmonics=((1, 1.0, 0.2), (3, -0.4, 1.0)),
                ),
            )
        ),
    ],
)
def test_the_floor_of_any_other_motion_is_that_of_an_integrator(motion: Any) -> None:
    pieces, table = motion.segments(), segment_table(motion)
    breaks = np.cumsum([0.0, *(piece.duration for piece in pieces), 4.0])
    breaks = breaks[np.isfinite(breaks)]
    times = np.linspace(0.0, breaks[-1], 901)[1:-1]
    times = times[np.abs(times[:, None] - breaks).min(axis=1) > 1e-6]
    largest = np.abs(base_acceleration(table, times)).max()

    def ground(s: float) -> Floats:
        value: Floats = base_acceleration(table, np.array([s]))[0]
        return value

    for modes in (TWO, {**TWO, "damping": 0.6, "shapes": [0.3, 0.2]}):
        lowered = segment_table(Floor(**modes).motion(motion, BLOCK, tolerance=1e-4))
        hertz = [f / BLOCK.p for f in modes["frequencies_hz"]]
        expected = integrated(Floor(**{**modes, "frequencies_hz": hertz}), ground, times, breaks)
        error = np.abs(np.asarray(base_acceleration(lowered, times)) - expected).max()
        assert error <= 1e-4 * 1.02 * largest  # sinusoids count with the sum of their sizes


def test_resonance_is_the_closed_form() -> None:
    for zeta in (0.02, 0.05, 0.3):
        closed = math.sqrt(1.0 + 4.0 * zeta * zeta) / (2.0 * zeta)
        floor = Floor(frequencies_hz=1.7, damping=zeta)
        assert floor.amplification(1.7) == pytest.approx(closed, rel=1e-12)
        shaking = Harmonic(amplitude=0.5, frequency_ratio=1.7 * 2.0 * math.pi / BLOCK.p)
        found = floor.motion(shaking, BLOCK)
        assert isinstance(found, Harmonic)
        assert found.amplitude == pytest.approx(0.5 * closed, rel=1e-12)
    assert Floor(frequencies_hz=1.0, damping=0.05).amplification(1.0) == pytest.approx(10.049876)
    for beyond in (0.0, 1e308, math.nan):
        with pytest.raises(InputError, match="frequency_hz"):
            Floor(frequencies_hz=1.0).amplification(beyond)


def test_a_floor_that_never_comes_to_rest_is_refused() -> None:
    ground = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0]), dt_s=0.1)
    with pytest.raises(InputError, match=r"tolerance = 0.001 .* inf samples"):
        floor_motion(ground, frequencies_hz=1.0, damping=5e-324)


@pytest.mark.slow
def test_lasting_shaking_is_what_is_left_of_shaking_from_rest() -> None:
    motion = FourierSeries(
        amplitude=0.8, frequency_ratio=2.0, phase=0.3, harmonics=((1, 1.0, 0.2), (3, 0.5, -1.0))
    )
    floor = Floor(**TWO)
    lasting = floor.motion(motion, BLOCK)
    assert isinstance(lasting, FourierSeries)
    begun = floor.motion(Piecewise(pieces=motion.segments()), BLOCK, tolerance=1e-6)
    pieces = begun.segments()
    assert pieces[-1].duration == math.inf
    start = sum(piece.duration for piece in pieces[:-1])
    times = start + np.linspace(0.01, 6.0, 200)
    both = [np.asarray(base_acceleration(segment_table(each), times)) for each in (begun, lasting)]
    assert both[0] == pytest.approx(both[1], abs=1e-5)
    assert not any(piece.jump for piece in pieces)


def test_a_rigid_building_is_its_ground_and_a_soft_one_stands_still() -> None:
    (ground,) = make_synthetic_suite(1)
    rigid = floor_motion(ground, frequencies_hz=900.0, tolerance=1e-2)
    times = np.linspace(0.0, ground.duration_s, 4001)
    error = np.abs(of_record(rigid, times) - of_record(ground, times)).max()
    assert error <= 0.02 * ground.peak_acceleration_m_s2
    soft = floor_motion(ground, frequencies_hz=0.01, damping=0.01)
    assert soft.peak_acceleration_m_s2 < 0.02 * ground.peak_acceleration_m_s2


def test_a_floor_without_participation_is_the_ground() -> None:
    pulse = Pulse(shape="one-cosine", amplitude=2.0, frequency_ratio=3.0)
    none = floor_motion(pulse, frequencies_hz=2.0, shapes=0.0, block=BLOCK, tolerance=1e-5)
    on_ground, on_floor = (simulate(BLOCK, motion) for motion in (pulse, none))
    assert on_floor.peak == pytest.approx(on_ground.peak, rel=1e-3)


def test_an_impulse_of_the_ground_sets_the_modes_swinging() -> None:
    kick = Impulses(velocities=(0.7,), times=(0.4,))
    floor = Floor(frequencies_hz=1.5, damping=0.05, shapes=0.75)
    moved = floor.motion(kick, BLOCK, tolerance=1e-5)
    found = moved.segments()
    w, zeta = 2.0 * math.pi * 1.5 / BLOCK.p, 0.05
    wd = w * math.sqrt(1.0 - zeta * zeta)
    jumps = [piece.jump for piece in found if piece.jump]
    assert jumps == [pytest.approx(0.25 * 0.7, rel=1e-12)]
    s = np.linspace(0.01, 3.0, 50)
    fade = np.exp(-zeta * w * s)
    x = -0.7 * fade * np.sin(wd * s) / wd
    v = -0.7 * fade * (np.cos(wd * s) - zeta * w / wd * np.sin(wd * s))
    expected = -0.75 * (2.0 * zeta * w * v + w * w * x)
    values = np.asarray(base_acceleration(segment_table(moved), 0.4 + s))
    assert values == pytest.approx(expected, abs=1e-5 * 0.7 * w * 1.001)


def test_the_vertical_component_stays_that_of_the_ground() -> None:
    across, up = make_synthetic_suite(2)
    both = floor_motion(BaseMotion(across, up), frequencies_hz=2.0)
    assert both.vertical is up
    assert both.horizontal == floor_motion(across, frequencies_hz=2.0)


def test_levels_of_an_ensemble_are_those_of_the_ground() -> None:
    suite = make_synthetic_suite(3)
    floors = [floor_motion(each, frequencies_hz=1.0, shapes=1.3) for each in suite]
    levels = Levels("pga_g", [0.2, 0.3])
    on_ground, on_floor = (
        run_ensemble([BLOCK], [*motions], levels=levels) for motions in (suite, floors)
    )
    assert (on_floor["scale"].values == on_ground["scale"].values).all()
    assert on_floor["peak_angle"].values.sum() > on_ground["peak_angle"].values.sum()
    scaled = floors[0].scaled(-2.0)
    assert scaled.reference.peak_acceleration_m_s2 == 2.0 * suite[0].peak_acceleration_m_s2
    assert scaled.reversed() == floors[0].scaled(2.0)
    assert floors[0] != floor_motion(suite[1], frequencies_hz=1.0, shapes=1.3)


@pytest.mark.parametrize(
    ("modes", "name", "words"),
    [
        ({"frequencies_hz": 0.0}, "frequencies_hz", "[0.001, 10000]"),
        ({"frequencies_hz": []}, "frequencies_hz", "1 to 50"),
        ({"frequencies_hz": 1.0, "damping": 1.0}, "damping", "(0, 1)"),
        ({"frequencies_hz": 1.0, "damping": 0.0}, "damping", "(0, 1)"),
        ({"frequencies_hz": [1.0, 2.0], "shapes": 1.0}, "shapes", "each of 2 modes"),
        ({"frequencies_hz": [1.0, 2.0], "shapes": [1.3, -1.4]}, "shapes", "add up to -0.1"),
        ({"frequencies_hz": [1.0, 2.0], "shapes": [1.6, 1.4]}, "shapes", "add up to 3"),
        ({"frequencies_hz": 1.0, "shapes": math.nan}, "shapes", "[-5, 5]"),
        ({"frequencies_hz": "1"}, "frequencies_hz", "'1'"),
    ],
)
def test_modes_that_are_none_are_refused(modes: dict[str, Any], name: str, words: str) -> None:
    with pytest.raises(InputError, match=name) as error:
        Floor(**modes)
    assert words in str(error.value)


def test_motions_in_the_measures_of_a_block_need_the_block() -> None:
    pulse = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0)
    for block in (None, DimensionlessBlock(restitution=0.9)):
        with pytest.raises((ModelError, InputError), match="block"):
            floor_motion(pulse, frequencies_hz=2.0, block=block)  # type: ignore[arg-type]
    assert floor_motion(Still(), frequencies_hz=2.0, block=BLOCK).segments() == ()


def test_a_swing_that_hardly_decays_is_refused() -> None:
    ground = Record(acceleration_m_s2=np.array([0.0, 2.0, -2.0, 0.0]), dt_s=0.01)
    with pytest.raises(InputError, match="tolerance"):
        floor_motion(ground, frequencies_hz=50.0, damping=1e-7, tolerance=1e-6)
    pulse = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0)
    with pytest.raises(InputError, match="tolerance"):
        floor_motion(pulse, frequencies_hz=50.0, damping=1e-7, block=BLOCK, tolerance=1e-6)


def test_the_spectrum_of_a_floor_is_that_of_an_oscillator_on_an_oscillator() -> None:
    ground = Record(
        acceleration_m_s2=synthetic(np.random.default_rng(5), 120, 0.02, 3.0), dt_s=0.02
    )
    floor, period = Floor(frequencies_hz=2.0, damping=0.05, shapes=1.3), 0.4
    moved = floor.motion(ground, tolerance=1e-5)
    w, wc, zeta = 4.0 * math.pi, 2.0 * math.pi / period, 0.05
    at = ground.dt_s * np.arange(120)

    def rate(t: float, y: Floats) -> list[float]:
        a = float(np.interp(t, at, ground.acceleration_m_s2, right=0.0))
        building = -2.0 * zeta * w * y[1] - w * w * y[0] - a
        return [
            y[1],
            building,
            y[3],
            -2.0 * zeta * wc * y[3] - wc * wc * y[2] - (a + 1.3 * building),
        ]

    end = moved.duration_s
    times = np.linspace(0.0, end, 20_001)
    x, v = solve_ivp(
        rate, (0.0, end), np.zeros(4), "DOP853", times, rtol=1e-9, atol=1e-12, max_step=0.02
    ).y[2:]
    total = np.abs(2.0 * zeta * wc * v + wc * wc * x).max()
    found = compute_response_spectrum(moved, [period], damping=zeta).acceleration_m_s2[0]
    assert found == pytest.approx(total, rel=1e-4)


PERIODS = (0.0, 0.15, 0.3, 0.6, 1.2)


def real_suite() -> list[Record]:
    """Return every second real record at .25 g; the test is skipped without them."""
    files = sorted((FOLDER / "suite_at2").glob("*.AT2"))[::2]
    if len(files) < 28:
        pytest.skip(ABSENT)
    records = [read_record(file) for file in files[:28]]
    return [each.scaled(0.25 * 9.80665 / each.peak_acceleration_m_s2) for each in records]


@pytest.mark.slow
def test_the_longer_the_period_of_the_building_the_more_statues_fall() -> None:
    suite, statue = real_suite(), Block.rectangle(width=0.6, height=2.0)
    counts = []
    for period in PERIODS:
        floor = Floor(frequencies_hz=1.0 / period, shapes=1.3) if period else None
        moved = [each if floor is None else floor.motion(each) for each in suite]
        fell = [simulate(statue, each).status.label == "overturned" for each in moved]
        counts.append(sum(fell))
    assert counts == sorted(counts)
    assert counts[0] == 0
    assert counts[-1] >= 15  # 20 of the 28 records of the reference


def test_a_reversed_ground_reverses_its_floor_and_modes_have_no_order() -> None:
    (ground,) = make_synthetic_suite(1)
    floor = Floor(**TWO)
    other = Floor(**{name: values[::-1] for name, values in TWO.items()})
    moved = floor.motion(ground)
    assert floor.motion(ground.reversed()) == moved.reversed()
    again = other.motion(ground)
    assert again.dt_s == moved.dt_s
    assert again.acceleration_m_s2 == pytest.approx(moved.acceleration_m_s2, abs=1e-9)
    assert pickle.loads(pickle.dumps(moved)) == moved
    arrays: dict[str, Any] = {name: np.array(values) for name, values in TWO.items()}
    assert Floor(**arrays) == floor


def test_what_is_made_of_a_floor_keeps_its_ground() -> None:
    (ground,) = make_synthetic_suite(1)
    moved = floor_motion(ground, frequencies_hz=1.0, shapes=1.3)
    given = recording(moved.acceleration_m_s2, moved.dt_s)
    given = replace(given, record=moved)
    for processed in (resample(given, moved.dt_s / 2.0), Cleaning(baseline="linear").apply(given)):
        assert processed.record.reference == ground
    upstairs = floor_motion(moved, frequencies_hz=3.0)
    assert upstairs.reference == ground
    found = simulate_many(BLOCK, moved, pga_g=[0.3])
    level = 0.3 * 9.80665 / ground.peak_acceleration_m_s2
    alone = simulate_many(BLOCK, moved, scales=[level])
    assert found["peak_angle"].values == pytest.approx(alone["peak_angle"].values, rel=1e-12)


@pytest.mark.parametrize(
    "frequencies", [np.ma.array([1.0, 2.0], mask=[False, True]), {1.0}, None, True, [[1.0]], 1j]
)
def test_what_is_no_frequency_is_refused(frequencies: Any) -> None:
    with pytest.raises(InputError, match="frequencies_hz"):
        Floor(frequencies_hz=frequencies, shapes=1.0)


def test_a_floor_without_participation_keeps_its_record_sample_by_sample() -> None:
    cases: list[dict[str, Any]] = [
        {"frequencies_hz": 2.0, "shapes": 0.0},
        {"frequencies_hz": [1, 2], "shapes": [0, 0]},
    ]
    ground = Record(acceleration_m_s2=np.array([0.5, 2.0, -2.0, 0.25]), dt_s=0.1, name="a")
    for modes in cases:
        moved = Floor(**modes).motion(ground)
        assert moved.acceleration_m_s2.tolist() == [0.5, 2.0, -2.0, 0.25]
        assert moved.dt_s == 0.1
        assert moved.name == f"a (floor {min(Floor(**modes).modes)[0]:.3g} Hz)"
    assert Floor(frequencies_hz=2.0).motion(replace(ground, name=None)).name is None


def test_a_floor_rings_on_until_it_is_quiet_and_not_much_longer() -> None:
    ground = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0]), dt_s=0.2)
    for hertz, damping, tolerance in ((1.5, 0.05, 1e-2), (4.0, 0.2, 1e-3), (0.7, 0.5, 1e-4)):
        floor = Floor(frequencies_hz=hertz, damping=damping)
        moved = floor.motion(ground, tolerance=tolerance)
        longer = floor.motion(ground, tolerance=tolerance * 1e-2)
        times = np.linspace(moved.duration_s, longer.duration_s, 2000)
        left = np.abs(of_record(longer, times)).max()
        assert left <= tolerance * 1.05
        assert left >= tolerance * math.exp(-2.0 * math.pi * hertz * damping * (1.0 / hertz + 0.2))


def test_the_free_swing_of_several_modes_is_within_the_tolerance() -> None:
    """The corners of the ground, half a period apart, add up: it swings most after the last."""
    ground = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0]), dt_s=1.25)
    times, corners = np.linspace(2.5, 4.0, 4001)[1:-1], np.array([0.0, 1.25, 2.5, 4.0])
    whole, parts = (
        Floor(frequencies_hz=[2.0] * count, damping=0.005, shapes=[1.0 / count] * count)
        for count in (1, 4)
    )
    moved, split = whole.motion(ground), parts.motion(ground)
    expected = integrated(whole, lambda t: of_record(ground, np.array(t)), times, corners)
    assert np.abs(of_record(moved, times) - expected).max() <= 1e-3
    np.testing.assert_allclose(split.acceleration_m_s2, moved.acceleration_m_s2, atol=1e-12)
    # Of a pulse as well: the last line ends where the swing is a share of its peak.
    pulse = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0)
    lines, again = (each.motion(pulse, BLOCK).segments() for each in (whole, parts))
    assert len(lines) == len(again)
    assert max(abs(each.constant) for each in lines[-9:-1]) <= 1.1 * 2.0e-3


def test_the_label_of_a_floor_has_its_modes_in_words() -> None:
    assert Floor(frequencies_hz=1.5, damping=0.05, shapes=1.3).label == (
        "floor of 1.5 Hz, damping 5 %, shape 1.3"
    )
    assert Floor(frequencies_hz=[1.5, 4.0], damping=0.05, shapes=[1.25, -0.4]).label == (
        "floor of 1.5, 4 Hz, damping 5 %, shape 1.25, -0.4"
    )
    assert Floor(**TWO).label == "floor of 1.5, 4 Hz, damping 5, 2 %, shape 1.25, -0.4"
    assert Floor(**TWO).modes == ((1.5, 0.05, 1.25), (4.0, 0.02, -0.4))


def test_the_floor_leads_and_follows_as_the_equation_of_its_modes_has_it() -> None:
    floor = Floor(**TWO)
    hertz = np.array([[0.1, 1.0, 1.5], [2.0, 4.0, 30.0]])
    w = 2.0 * math.pi * hertz
    ratio = np.ones(hertz.shape, dtype=complex)
    for frequency, damping, shape in floor.modes:
        of = 2.0 * math.pi * frequency
        ratio += shape * w * w / (of * of - w * w + 2j * damping * of * w)
    np.testing.assert_allclose(floor.amplification(hertz), np.abs(ratio), rtol=1e-12)
    np.testing.assert_allclose(floor.phase_lead(hertz), np.angle(ratio), rtol=1e-9, atol=1e-12)
    shaking = Harmonic(amplitude=0.5, frequency_ratio=3.0, phase=0.7)
    moved = floor.motion(shaking, BLOCK)
    at = 3.0 * BLOCK.p / (2.0 * math.pi)
    assert moved.amplitude == pytest.approx(0.5 * float(floor.amplification(at)), rel=1e-12)
    lead = math.remainder(moved.phase - 0.7 - float(floor.phase_lead(at)), 2.0 * math.pi)
    assert abs(lead) < 1e-12
    assert abs(moved.phase) <= math.pi
