"""Answers of time histories: their verdict, their time, and the scale at which none falls."""

from typing import Any

import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Pulse,
    State,
    Still,
    check_neighbours,
    simulate,
)
from rocksteady.dynamics.history.neighbours import Neighbours
from rocksteady.dynamics.history.trajectory import Trajectory
from tests.cli.program import rocksteady

BLOCK = Block.rectangle(width=0.4, height=0.8)


def shaken(accel_g: float, hz: float = 1.0) -> Trajectory:
    """Return a block in a pulse."""
    pulse = Pulse.from_si(
        BLOCK, shape="one-sine", acceleration_m_s2=9.80665 * accel_g, frequency_hz=hz
    )
    return simulate(BLOCK, pulse)


def first_line(run: Trajectory) -> str:
    """Return the sentence of a run."""
    answer = run.describe().answer
    assert answer is not None
    return answer.sentence


def test_the_sentence_says_when_it_falls_or_rests() -> None:
    falls, rests = shaken(0.9), shaken(0.55)
    assert falls.status == "overturned"
    assert first_line(falls) == f"It falls {falls.overturn_time_s:.3g} s into the pulse."
    assert rests.status == "at-rest"
    assert first_line(rests) == f"It rests {rests.rest_time_s:.3g} s into the pulse."
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
    assert first_line(free) == f"It rests {free.rest_time_s:.3g} s after it is let go."


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


@pytest.mark.parametrize(("angle", "start"), [(0.99, "rests"), (1.01, "falls"), (0.3, "rests")])
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


@pytest.mark.parametrize("accel_g", [0.75, 0.9, 1.5])
def test_no_neighbour_falls_where_it_is_said_to_stand_and_one_falls_just_above(
    accel_g: float,
) -> None:
    found = check_neighbours(shaken(accel_g))
    scale = found.stands_at
    assert (scale is None) == (found.agree and not found.fall)
    if scale is None:
        return
    for factor, stands in ((scale, True), (scale + 0.02, False)):
        case = shaken(factor * accel_g)
        fall = check_neighbours(case).fall + (case.status == "overturned")
        assert (fall == 0) == stands
    assert f"{scale:.2f} x this motion ({scale * accel_g:.3g} g)" in found.summary()


class SearchedError(Exception):
    """The scale at which no neighbour falls was searched."""


def refused(_: Neighbours) -> float:
    raise SearchedError


def test_the_scale_is_searched_where_the_screen_is_printed_and_nowhere_else(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It takes up to 1,300 runs."""
    monkeypatch.setattr(Neighbours, "stands_at", property(refused))
    found = check_neighbours(shaken(0.9))
    assert f"{found.fall} of {found.runs} neighbours" in repr(found)
    assert "neighbours" in found._repr_html_()
    assert found.to_dict()["status"] == "overturned"
    assert len(found.to_dataframe()) == found.runs
    line = "simulate --width-m 0.4 --height-m 0.8 --pulse one-sine --accel-g 0.9 --freq-hz 1"
    assert '"overturned"' in rocksteady(line, "--json").out
    assert rocksteady(line, "--quiet").out.startswith("It falls ")
    with pytest.raises(SearchedError):
        found.summary()
    assert "SearchedError" in rocksteady(line).err


def test_the_sentence_counts_the_neighbours_that_end_otherwise() -> None:
    found = check_neighbours(shaken(0.9))
    assert 0 < found.fall < found.runs
    assert f"but {found.runs - found.fall} of {found.runs} neighbours stand." in found.summary()
    assert "all 26 neighbours stand" in check_neighbours(shaken(0.4)).summary()
