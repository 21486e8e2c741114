"""What `simulate` prints of runs of every kind: values, summary and rows."""

import math

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Pulse,
    Record,
    State,
    Still,
    Trajectory,
    simulate,
)
from rocksteady.cli.present.simulate_values import (
    csv_header,
    csv_rows,
    print_summary,
    time_text,
    trajectory_values,
)
from rocksteady.model.equations import Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.segments import Motion
from tests.cli.motion_files import samples
from tests.cli.present.printed import as_json, fits, printed

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
EVEN = Block.rectangle(width=0.4, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)
UNLIKE = DimensionlessBlock(restitution=0.8, negative_restitution=0.9, alpha_ratio=1.3)
GROUND = Record(acceleration_m_s2=9.80665 * samples(), dt_s=0.02, name="hut")
UP = Record(acceleration_m_s2=2.0 * samples(9), dt_s=0.02, name="up")
RUNS: dict[
    str, tuple[Block | DimensionlessBlock, Motion | Record | BaseMotion, dict[str, object]]
] = {
    "harmonic": (BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "fall": (BARE, Harmonic(amplitude=6.0, frequency_ratio=1.0), {}),
    "unlike": (UNLIKE, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "block": (EVEN, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "leaning": (LEANING, Harmonic(amplitude=2.0, frequency_ratio=4.0), {"cycles": 5}),
    "leaning fall": (LEANING, Harmonic(amplitude=9.0, frequency_ratio=1.0), {"model": Nonlinear()}),
    "pulse": (EVEN, Pulse(shape="ricker", amplitude=2.0, frequency_ratio=3.0), {}),
    "bare pulse": (BARE, Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0), {}),
    "record": (EVEN, GROUND, {}),
    "vertical": (EVEN, BaseMotion(GROUND, UP), {}),
    "free": (LEANING, Still(), {"start": State(angle=0.5, velocity=0.0)}),
    # 1.4 of the slenderness of the other side, and less than 1 of its own.
    "free right": (LEANING, Still(), {"start": State(angle=-1.4, velocity=0.0)}),
}
runs = pytest.mark.parametrize("name", RUNS)


def run_of(name: str) -> tuple[Trajectory, Block | DimensionlessBlock]:
    block, motion, more = RUNS[name]
    return simulate(block, motion, **more), block  # type: ignore[arg-type]


@runs
def test_the_values_keep_the_contract(name: str) -> None:
    run, block = run_of(name)
    values = as_json(trajectory_values(run, block))
    assert (values["status"], values["impacts"]) == (run.status.label, len(run.impacts))
    assert (values["peak"], values["model"]) == (run.peak, run.model.name)
    sized = isinstance(block, Block)
    assert ("overturn_time_s" in values) == ("block" in values) == ("peak_rad" in values) == sized
    assert ("overturn_time_tau" in values) == ("overturn_time_pt" in values) == (not sized)
    assert ("side_peaks" in values) == (not block.symmetric)
    assert ("phase" in values) == isinstance(run.motion, Harmonic)
    assert ("pga_g" in values) == isinstance(run.motion, Record)
    fell = [name for name in ("overturn_time_s", "overturn_time_pt") if values.get(name)]
    assert bool(fell) == (values["status"] == "overturned")
    if isinstance(block, Block):
        # The largest angle of the motion itself, sampled finely.
        until = run.shown_to_pt if run.overturn_time_pt is None else run.overturn_time_pt
        angles = run(np.linspace(0.0, until, 20_001)).angle * block.alpha
        assert values["peak_rad"] == pytest.approx(np.abs(angles).max(), rel=1e-4)


def test_a_pulse_lasts_as_long_in_seconds_as_in_pivot_time() -> None:
    run, _ = run_of("pulse")
    values = trajectory_values(run, EVEN)
    assert values["pulse"] == "ricker"
    assert values["duration_s"] * EVEN.p == pytest.approx(values["duration_pt"])
    assert "duration_s" not in trajectory_values(*run_of("bare pulse"))


def test_vertical_motion_is_named_with_its_peak() -> None:
    values = trajectory_values(*run_of("vertical"))
    assert (values["record"], values["vertical"]) == ("hut", "up")
    assert values["vertical_pga_g"] == pytest.approx(np.abs(UP.acceleration_m_s2).max() / 9.80665)


@runs
def test_the_summary_says_how_it_ended(name: str) -> None:
    run, block = run_of(name)
    values = trajectory_values(run, block) | {"record_processing": ["mean, -1.5 m/s^2, taken off"]}
    text, advice = printed(print_summary, values, run)[:-1].rsplit("\n", 1)
    assert fits(text)
    assert advice == run.status.advice
    assert run.status.label in text
    assert ("overturns at" in text) == (run.overturn_time_pt is not None)
    assert ("at rest from" in text) == (run.rest_time_pt is not None)
    assert ("left edge" in text) == ("right edge" in text) == (not block.symmetric)
    assert "mean, -1.5 m/s^2, taken off" in text


def test_a_time_is_told_in_every_unit_of_the_run() -> None:
    bare, _ = run_of("harmonic")
    assert time_text(bare, math.pi) == "pt = 3.1415927, tau = 12.566371 (2.0000 periods)"
    free, _ = run_of("free")
    assert time_text(free, LEANING.p) == f"pt = {LEANING.p:.8g}, 1 s"


@runs
def test_every_row_has_the_columns_of_the_header(name: str) -> None:
    run, block = run_of(name)
    header = csv_header(run)
    table = np.array(list(csv_rows(run, 20)))
    assert table.shape[1] == len(header) == len(set(header))
    column = dict(zip(header, table.T, strict=True))
    motion = run(column["pivot_time"])
    np.testing.assert_array_equal(column["angle_per_alpha"], motion.angle)
    if "tau" in column:
        np.testing.assert_allclose(column["tau"], run.frequency_ratio * column["pivot_time"])
    if isinstance(block, Block):
        np.testing.assert_allclose(column["time_s"] * block.p, column["pivot_time"])
        np.testing.assert_allclose(column["angle_rad"], block.alpha * motion.angle)
        np.testing.assert_allclose(
            column["base_acceleration_m_s2"],
            block.uplift_acceleration * column["base_acceleration_per_alpha_g"],
        )
    if name == "vertical":
        at = 0.02 * np.arange(len(UP.acceleration_m_s2))
        shaken = column["time_s"] < at[-1] - 1e-9
        expected = np.interp(column["time_s"][shaken], at, UP.acceleration_m_s2)
        found = column["vertical_acceleration_m_s2"]
        np.testing.assert_allclose(found[shaken], expected, atol=1e-9)
    assert ("vertical_acceleration_m_s2" in column) == (name == "vertical")
