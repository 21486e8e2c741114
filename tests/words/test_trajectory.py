"""Words of time histories: verdict and time, text, JSON and columns."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    BaseMotion,
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Pulse,
    Record,
    State,
    Steady,
    Still,
    simulate,
)
from rocksteady.histories import Trajectory
from rocksteady.model.motions.segments import Motion
from tests.cli.program import rocksteady
from tests.descriptions import as_json, fits
from tests.dynamics.history.test_trajectory_quantities import GROUND, LIFT
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
BLOCK = Block.rectangle(width=0.4, height=0.8)


def shaken(accel_g: float, hz: float = 1.0) -> Trajectory:
    """Return a block in a pulse."""
    pulse = Pulse.from_si(
        BLOCK, shape="one-sine", acceleration_m_s2=9.80665 * accel_g, frequency_hz=hz
    )
    return simulate(BLOCK, pulse)


def first_line(run: Trajectory) -> str:
    """Return the sentence of a run."""
    answer = run.describe()
    return answer.sentence


def test_the_sentence_says_when_it_falls_or_rests() -> None:
    falls, rests = shaken(0.9), shaken(0.55)
    assert falls.status == "overturned"
    assert first_line(falls) == f"It falls {falls.overturn_time_s:.3g} s into the pulse."
    assert rests.status == "at-rest"
    assert first_line(rests) == f"It comes to rest {rests.rest_time_s:.3g} s into the pulse."
    assert "never lifts" in first_line(shaken(0.4))


def test_a_dimensionless_block_counts_periods_and_a_free_one_seconds() -> None:
    steady = simulate(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.9),
        cycles=40,
        start=State(angle=0.5, velocity=0.0),
    )
    assert " periods into the motion" in first_line(steady)
    free = simulate(BLOCK, Still(), start=State(angle=0.5, velocity=0.0))
    assert first_line(free) == f"It comes to rest {free.rest_time_s:.3g} s after it is let go."


LEANING = Block.asymmetric(left=0.1, right=0.3, height=1.2)
RATIO = LEANING.negative.alpha / LEANING.alpha


@pytest.mark.parametrize(
    ("block", "angle", "velocity", "model"),
    [
        *((BLOCK, angle, 0.0, model) for angle in (1.0, -1.0) for model in ("linear", "nonlinear")),
        (LEANING, 1.0, 0.0, "nonlinear"),
        (LEANING, -RATIO, 0.0, "nonlinear"),
        (BLOCK.against_wall(), 1.0, 0.0, "nonlinear"),
        (BLOCK.with_restitution(1.0), 1.0, 0.0, "nonlinear"),
        (DimensionlessBlock(restitution=0.8), -1.0, 0.0, "linear"),
        (BLOCK, 0.5, 0.5, "linear"),  # u = 1 - exp(-s)/2 never comes back
        (DimensionlessBlock(restitution=0.8), 0.0, 1.0, "linear"),
    ],
)
def test_a_block_that_ends_at_its_balance_says_so(
    block: Block | DimensionlessBlock, angle: float, velocity: float, model: Any
) -> None:
    """There x'' = 0 on a still base: it neither falls nor comes back, and time means nothing."""
    start = State(angle=angle, velocity=velocity)
    for motion in (Still(), Harmonic(amplitude=0.0, frequency_ratio=2.0)):
        run = simulate(block, motion, start=start, model=model)
        assert run.balanced
        assert first_line(run) == "It stands balanced: any disturbance decides."
        words = run.describe()
        assert words.headline.startswith("balanced: ")
        assert not any("longer run" in note for note in words.notes)


@pytest.mark.parametrize(
    ("angle", "start"), [(0.99, "comes to rest"), (1.01, "falls"), (0.3, "comes to rest")]
)
def test_a_block_beside_its_balance_falls_or_rests(angle: float, start: str) -> None:
    run = simulate(BLOCK, Still(), start=State(angle=angle, velocity=0.0))
    assert first_line(run).startswith(f"It {start} ")
    free = simulate(
        BLOCK.with_restitution(1.0), Still(), start=State(angle=angle - 0.1, velocity=0.0)
    )
    assert first_line(free).startswith("It still rocks ")


def test_the_command_says_that_a_block_stands_balanced() -> None:
    asked = "simulate --width-m 0.4 --height-m 1.2 --start 1,0 --quiet"
    assert rocksteady(asked).out.strip() == "It stands balanced: any disturbance decides."


ASYMMETRIC = Block.asymmetric(left=0.15, right=0.25, height=1.2)
EVEN = Block.rectangle(width=0.4, height=1.2)
UNLIKE = DimensionlessBlock(restitution=0.8, negative_restitution=0.9, alpha_ratio=1.3)
RUNS: dict[
    str, tuple[Block | DimensionlessBlock, Motion | Record | BaseMotion, dict[str, object]]
] = {
    "harmonic": (BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "fall": (BARE, Harmonic(amplitude=6.0, frequency_ratio=1.0), {}),
    "unlike": (UNLIKE, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "block": (EVEN, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "leaning": (ASYMMETRIC, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "leaning fall": (
        ASYMMETRIC,
        Harmonic(amplitude=9.0, frequency_ratio=1.0),
        {"model": Nonlinear()},
    ),
    "pulse": (EVEN, Pulse(shape="ricker", amplitude=2.0, frequency_ratio=3.0), {}),
    "bare pulse": (BARE, Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0), {}),
    "record": (EVEN, GROUND, {}),
    "vertical": (EVEN, BaseMotion(GROUND, LIFT), {}),
    "free": (ASYMMETRIC, Still(), {"start": State(angle=0.5, velocity=0.0)}),
    # 1.4 of the slenderness of the other side, and less than 1 of its own.
    "free right": (ASYMMETRIC, Still(), {"start": State(angle=-1.4, velocity=0.0)}),
}
runs = every("name", RUNS)


def run_of(name: str) -> Trajectory:
    block, motion, more = RUNS[name]
    return simulate(block, motion, **more)  # type: ignore[arg-type]


@runs
def test_the_values_keep_the_contract(name: str) -> None:
    run = run_of(name)
    values, block = as_json(run.to_dict()), run.block
    assert block is RUNS[name][0]
    assert (values["status"], values["impacts"]) == (run.status.label, len(run.impacts))
    assert (values["peak"], values["model"]) == (run.peak, run.model.name)
    assert (values["restitution"], values["growth"]) == (block.restitution, run.growth)
    sized = isinstance(block, Block)
    assert ("overturn_time_s" in values) == ("block" in values) == ("peak_rad" in values) == sized
    assert ("overturn_time_tau" in values) == ("overturn_time_pt" in values) == (not sized)
    assert ("side_peaks" in values) == (not block.symmetric)
    assert ("phase" in values) == isinstance(run.motion, Harmonic)
    assert ("npts" in values) == isinstance(run.motion, Record)
    fell = [name for name in ("overturn_time_s", "overturn_time_pt") if values.get(name)]
    assert bool(fell) == (values["status"] == "overturned")
    if isinstance(block, Block):
        # The largest angle of the motion itself, sampled finely.
        until = run.shown_to_pt if run.overturn_time_pt is None else run.overturn_time_pt
        angles = run(np.linspace(0.0, until, 20_001)).angle * block.alpha
        assert values["peak_rad"] == pytest.approx(np.abs(angles).max(), rel=1e-4)


def test_a_pulse_lasts_as_long_in_seconds_as_in_pivot_time() -> None:
    values = run_of("pulse").to_dict()
    assert values["pulse"] == "ricker"
    assert values["duration_s"] * EVEN.p == pytest.approx(values["duration_pt"])
    assert "duration_s" not in run_of("bare pulse").to_dict()


def test_vertical_motion_is_named_with_its_peak() -> None:
    values = run_of("vertical").to_dict()
    assert (values["record"], values["vertical"]) == ("hut", "up")
    assert values["vertical_pga_g"] == pytest.approx(np.abs(LIFT.acceleration_m_s2).max() / 9.80665)


@runs
def test_the_summary_says_how_it_ended(name: str) -> None:
    run = run_of(name)
    text = run.summary(more=True)
    assert fits(text)
    headline, words = run.describe().headline, " ".join(text.split())
    assert words.startswith(" ".join(run.summary().split()) + " " + headline)
    assert words.endswith(run.status.advice)
    assert f"{run.model.name} model" in headline
    assert headline in repr(run)
    assert ("overturns at" in text) == (run.overturn_time_pt is not None)
    assert ("at rest from" in text) == (run.rest_time_pt is not None)
    assert ("left edge" in text) == ("right edge" in text) == (not run.block.symmetric)


def test_a_peak_is_in_degrees_first_and_times_are_in_seconds() -> None:
    run = simulate(ASYMMETRIC, Still(), start=State(angle=0.5, velocity=0.0), model=Linear())
    degrees = math.degrees(0.5 * ASYMMETRIC.alpha)
    assert f"peak, left edge {degrees:.3g}° = 0.5 alpha" in " ".join(run.summary(more=True).split())
    assert f"{run.rest_time_s:.3g} s (pt {run.rest_time_pt:.3g})" in run.summary(more=True)
    bare = simulate(BARE, Harmonic(amplitude=6.0, frequency_ratio=1.0))
    periods = bare.overturn_time_pt / (2.0 * math.pi) if bare.overturn_time_pt else 0.0
    assert f"pt {bare.overturn_time_pt:.3g} ({periods:.3g} periods)" in bare.summary(more=True)
    assert "°" not in bare.summary(more=True)


def test_a_growth_beyond_rounding_is_noted() -> None:
    point = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    few, many = (simulate(BARE, point, start=Steady(branch=2), cycles=n) for n in (2, 400))
    for run in (few, many):
        assert ("rounding decides" in run.summary(more=True)) == (run.growth > 1e12)


@runs
def test_every_row_has_the_columns_of_the_table(name: str) -> None:
    run = run_of(name)
    block, column = run.block, run.to_columns(20)
    assert len({len(values) for values in column.values()}) == 1
    motion = run(column["pt"])
    assert np.isin(run.impacts.pt[run.impacts.pt <= column["pt"][-1]], column["pt"]).all()
    np.testing.assert_array_equal(column["angle_per_alpha"], motion.angle)
    if "tau" in column:
        np.testing.assert_allclose(column["tau"], run.frequency_ratio * column["pt"])
    if isinstance(block, Block):
        np.testing.assert_allclose(column["time_s"] * block.p, column["pt"])
        np.testing.assert_allclose(column["angle_deg"], np.degrees(block.alpha * motion.angle))
        np.testing.assert_allclose(
            9.80665 * column["base_acceleration_g"],
            block.uplift_acceleration * column["base_acceleration_per_alpha_g"],
        )
    if name == "vertical":
        at = 0.02 * np.arange(len(LIFT.acceleration_m_s2))
        shaken = column["time_s"] < at[-1] - 1e-9
        expected = np.interp(column["time_s"][shaken], at, LIFT.acceleration_m_s2)
        found = 9.80665 * column["vertical_acceleration_g"]
        np.testing.assert_allclose(found[shaken], expected, atol=1e-9)
    assert ("vertical_acceleration_g" in column) == (name == "vertical")
    dataset = run.to_dataset(20)
    assert [str(each) for each in dataset.variables if each != "pt"] == [
        name for name in column if name != "pt"
    ]
    np.testing.assert_array_equal(dataset["energy"], column["energy"])
    assert dataset.attrs["model"] == run.model.name
