"""Figs 8 to 13: parameters, multipliers, both sides, runs against an integrator, the drawing."""

import math
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady import DimensionlessBlock, Harmonic, Status, Steady, simulate
from rocksteady.histories import Trajectory
from rocksteady.show.style import palette
from rocksteady.studies.tso_wong_1989.figures.cases import CASES, KICK, KICKS
from rocksteady.studies.tso_wong_1989.figures.fates import Kind
from rocksteady.studies.tso_wong_1989.figures.histories import History, counted, histories
from tests.dynamics.formulae import printed, printed_trace
from tests.dynamics.integrator import integrate
from tests.every import every
from tests.studies.tso_wong_1989.whole import HISTORIES, STABLE, UNSTABLE, evidence

pytestmark = pytest.mark.usefixtures("computed")

# figure: A, Omega, order, branch, end of the time axis as far as it is legible
PAPER: dict[str, tuple[float, float, int, int, int | None]] = {
    "8a": (1.0, 1.0, 1, 2, 10), "8b": (1.0, 2.0, 1, 2, 24), "8c": (1.0, 8.0, 1, 2, 20),
    "9a": (2.0, 3.5, 3, 2, 20), "9b": (2.0, 4.0, 3, 2, 40), "9c": (2.0, 5.0, 3, 2, 40),
    "10": (6.0, 4.0, 1, 1, 10), "11a": (4.0, 6.0, 3, 1, 32), "11b": (2.0, 6.0, 3, 1, 28),
    "12a": (2.0, 2.0, 1, 1, None), "12b": (2.0, 1.9, 1, 1, 40), "12c": (2.0, 1.8, 1, 1, 32),
    "12d": (2.0, 1.7, 1, 1, None), "13a": (2.0, 4.4, 3, 1, 40), "13b": (2.0, 4.2, 3, 1, 80),
    "13c": (2.0, 3.6, 3, 1, 32), "13d": (2.0, 3.0, 3, 1, None),
}  # fmt: skip


def shaking_of(run: Trajectory) -> Harmonic:
    assert isinstance(run.motion, Harmonic)
    return run.motion


def history(name: str) -> History:
    return evidence().histories[name]


def test_every_time_history_of_the_paper_is_there_with_its_parameters() -> None:
    assert tuple(histories()) == HISTORIES == tuple(PAPER)
    for case in CASES:
        *parameters, periods = PAPER[case.id]
        assert [case.amplitude, case.frequency_ratio, case.order, case.branch] == parameters
        if periods is None:
            assert any("not legible" in words for words in case.chosen)
        else:
            assert case.periods == periods
        assert any("not printed" in words for words in case.chosen) == case.id.startswith("13")


@every("name", HISTORIES)
def test_stability_is_that_of_the_printed_trace(name: str) -> None:
    a, w, n, branch, _ = PAPER[name]
    solution = printed(a, w, 0.8, n, branch)
    trace = printed_trace(a, w, 0.8, n, solution.sine, solution.velocity)
    roots = np.roots([1.0, -trace, 0.64])
    largest = roots[np.argmax(np.abs(roots))]
    assert abs(history(name).multiplier) == pytest.approx(abs(largest), rel=1e-8)
    assert history(name).multiplier.real == pytest.approx(largest.real, rel=1e-8)
    assert history(name).stable == (abs(trace) < 1.64) == (name in STABLE)


@every(
    ("name", "multiplier"),
    [
        ("8a", 25.658), ("8b", 10.2467), ("8c", 7.2251),
        ("9a", 19.557), ("9b", 12.419), ("9c", 6.8005), ("11a", -1.182),
    ],
)  # fmt: skip
def test_multipliers_are_the_reference_ones(name: str, multiplier: float) -> None:
    found = history(name).multiplier
    assert found.imag == 0.0
    assert found.real == pytest.approx(multiplier, rel=5e-5 if name != "11a" else 5e-4)


@every("name", HISTORIES)
def test_unstable_states_are_left_on_both_sides_and_stable_ones_are_not_left(name: str) -> None:
    case = history(name)
    sides = (1, -1) if name in UNSTABLE else (1,)
    assert case.sides == sides
    assert set(case.runs) == set(case.fates) == set(sides)
    assert set(case.fates_over_kicks) == (set(sides) if name in UNSTABLE else set())
    text = case.panel().computed
    for sign in ("+", "−"):
        assert (f"Left on the {sign} side: " in text) == (name in UNSTABLE)


@every("name", UNSTABLE)
def test_a_run_starts_off_its_orbit_by_the_distance_said(name: str) -> None:
    case = history(name)
    branch = case.case.branch - 1
    phase = float(case.states.phase[branch])
    velocity = float(case.states.velocity[branch])
    shifts = []
    for side, run in case.runs.items():
        first = run.flights
        shift = (
            shaking_of(run).phase - phase,
            float(first.velocity[0]) / velocity - 1.0,
        )
        assert math.hypot(*shift) == pytest.approx(KICK, rel=1e-6)
        assert math.copysign(1.0, shift[1]) == side
        shifts.append(shift)
    np.testing.assert_allclose(shifts[0], np.negative(shifts[1]), rtol=1e-6, atol=1e-14)


@every("name", HISTORIES)
def test_a_distance_grows_by_the_multiplier_each_half_cycle(name: str) -> None:
    case = history(name)
    order = case.case.order
    assert case.growth == pytest.approx(
        abs(case.multiplier) ** (2.0 * case.case.periods / order), rel=1e-12
    )
    if name not in UNSTABLE:
        return
    # The difference of the two sides: what is of second order in the distance cancels.
    one, other = (
        np.abs(
            simulate(
                DimensionlessBlock(restitution=0.8),
                case.shaking,
                start=Steady(branch=case.case.branch, order=order, kick=1e-8, side=side),
                cycles=case.case.periods,
            ).impacts.velocity_after
        )
        for side in (1, -1)
    )
    both = min(len(one), len(other))
    apart = np.abs(one[:both] - other[:both])
    near = int(np.argmax(apart > 1e-4)) if (apart > 1e-4).any() else both
    assert near >= 2
    ratios = apart[1:near] / apart[: near - 1]
    np.testing.assert_allclose(ratios, abs(case.multiplier), rtol=0.01)


@every(("name", "side"), [("8b", 1), ("9c", -1), ("12b", -1), ("13d", 1)])
def test_the_drawn_runs_are_those_of_an_integrator(name: str, side: int) -> None:
    case = history(name)
    run = case.runs[side]
    a, w = case.case.amplitude, case.case.frequency_ratio
    phase = shaking_of(run).phase
    unit = 2.0 * math.pi / w
    until = min(9.0 * unit, run.end_time_pt)
    other = integrate(
        lambda s: a * math.sin(w * s + phase),
        until,
        alpha=1.0,
        p=1.0,
        restitution=0.8,
        angle=0.0,
        velocity=float(run.flights.velocity[0]),
        longest_step=0.05 * unit,
    )
    inside = other.times <= run.end_time_pt
    np.testing.assert_allclose(
        run(other.times[inside]).angle, other.angles[inside], rtol=0.0, atol=1e-4
    )
    count = len(other.impacts)
    assert count >= 5
    np.testing.assert_allclose(run.impacts.pt[:count], other.impacts, atol=1e-4)


def test_the_fates_of_the_drawn_runs_are_the_papers_on_one_side_at_least() -> None:
    expected = {
        "8a": (Kind.OVERTURNED, 0), "8b": (Kind.SYMMETRIC, 1), "8c": (Kind.SYMMETRIC, 1),
        "9a": (Kind.OVERTURNED, 0), "9b": (Kind.SYMMETRIC, 1), "9c": (Kind.SUBHARMONIC, 3),
        "10": (Kind.SYMMETRIC, 1), "11a": (Kind.SUBHARMONIC, 3), "11b": (Kind.SUBHARMONIC, 3),
        "12a": (Kind.SYMMETRIC, 1), "12b": (Kind.UNSYMMETRIC, 1), "12c": (Kind.UNSYMMETRIC, 1),
        "12d": (Kind.OVERTURNED, 0), "13a": (Kind.SUBHARMONIC, 3), "13b": (Kind.SUBHARMONIC, 3),
        "13c": (Kind.SYMMETRIC, 1), "13d": (Kind.OVERTURNED, 0),
    }  # fmt: skip
    assert set(expected) == set(HISTORIES)
    for name, fate in expected.items():
        found = {(fate.kind, fate.period) for fate in history(name).fates.values()}
        assert fate in found, name


def test_mirrored_fates_where_the_multiplier_is_negative() -> None:
    # Half a cycle later one side is the mirror image of the other, at a distance |multiplier|
    # times as large: where the fate does not depend on distance it is mirrored.
    for name in ("11a", "12b", "13b"):
        fates = history(name).fates_over_kicks
        assert {fate.bias for fate in fates[1]} == {-1}
        assert {fate.bias for fate in fates[-1]} == {1}
    for name in ("12d", "13c"):
        kinds = [{fate.kind for fate in fates} for fates in history(name).fates_over_kicks.values()]
        assert kinds[0] == kinds[1]
        assert len(kinds[0]) == 1


@pytest.mark.parametrize("name", ["12c", "13d"])
def test_a_fate_at_a_distance_is_the_mirrored_one_at_its_multiple(name: str) -> None:
    # Distances are 40 a decade; |multiplier|^2 a whole number of steps would be luck, so that the
    # neighbours of the place decide: where all of them agree, so must the mirrored fate.
    case = history(name)
    step = math.log(float(KICKS[1] / KICKS[0]))
    jump = math.log(abs(case.multiplier)) / step
    compared = 0
    for side in (1, -1):
        here, there = case.fates_over_kicks[side], case.fates_over_kicks[-side]
        for index in range(2, len(KICKS) // 2):
            low = math.floor(index + jump) - 1
            around = {(fate.kind, fate.bias) for fate in there[low : low + 4]}
            beside = {(fate.kind, fate.bias) for fate in here[index - 2 : index + 3]}
            if len(around) == len(beside) == 1:
                ((kind, bias),), ((mine, leaning),) = around, beside
                assert (mine, leaning) == (kind, -bias)
                compared += 1
    assert compared > 10


def test_distances_cover_four_decades_on_both_sides() -> None:
    assert KICKS[0] == pytest.approx(1e-6)
    assert KICKS[-1] == pytest.approx(1e-2)
    assert np.ptp(np.diff(np.log(KICKS))) < 1e-9
    assert len(KICKS) >= 100
    assert np.abs(np.log(KICKS / KICK)).min() < 1e-9, "the drawn run is one of them"
    drawn = int(np.argmin(np.abs(np.log(KICKS / KICK))))
    for name in UNSTABLE:
        for side, fate in history(name).fates.items():
            other = history(name).fates_over_kicks[side][drawn]
            assert (fate.kind, fate.period) == (other.kind, other.period)


def test_fates_are_counted_the_most_frequent_first() -> None:
    fates = history("8b").fates_over_kicks[-1]
    text = counted(fates)
    numbers = [int(part.split()[0]) for part in text.split(", ")]
    assert sum(numbers) == len(fates)
    assert numbers == sorted(numbers, reverse=True)
    overturned = sum(fate.kind is Kind.OVERTURNED for fate in fates)
    assert f"{overturned} overturned" in text


# ------------------------------------------------------------------------------- tables, drawing


@every("name", ["8a", "10", "12b"])
def test_the_table_is_the_run(name: str) -> None:
    case = history(name)
    panel = case.panel()
    columns = {column: place for place, column in enumerate(panel.header)}
    rows: Any = np.array(panel.rows, dtype=float)
    assert set(rows[:, columns["side"]]) == set(case.sides)
    for side, run in case.runs.items():
        mine = rows[rows[:, columns["side"]] == side]
        s = mine[:, columns["pivot_time"]]
        w = case.case.frequency_ratio
        np.testing.assert_array_equal(mine[:, columns["angle_per_alpha"]], run(s).angle)
        np.testing.assert_allclose(mine[:, columns["tau"]], w * s, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(
            mine[:, columns["excitation_periods"]], w * s / (2.0 * math.pi), rtol=1e-9, atol=1e-9
        )
        assert (np.diff(s) >= 0.0).all()
        for impact in run.impacts.pt:
            assert np.abs(s - impact).min() < 1e-9
        if run.status is Status.ROCKING:
            assert mine[-1, columns["excitation_periods"]] == pytest.approx(case.case.periods)
    if name in UNSTABLE:
        header, table = panel.more_tables["fates"]
        assert list(header[:3]) == ["side", "kick", "fate"]
        assert len(table) == 2 * len(KICKS)
    else:
        assert not panel.more_tables


def motions(figure: Figure) -> list[Any]:
    """The axes that hold a time history over forcing periods."""
    return [
        axes
        for axes in figure.axes
        if axes.get_title(loc="left").startswith(("stable", "unstable"))
    ]


@every("name", ["8a", "10", "13b"])
def test_the_figure_shows_every_side_over_the_papers_axis(name: str) -> None:
    case = history(name)
    figure = case.panel().draw()
    rows = motions(figure)
    assert len(rows) == len(case.sides)
    for axes, (side, run) in zip(rows, case.runs.items(), strict=True):
        assert axes.get_xlim() == pytest.approx((0.0, case.case.periods), rel=1e-12)
        assert axes.get_ylabel() == palette.LABELS["angle"]
        longest = max(axes.lines, key=lambda line: len(np.asarray(line.get_xdata())))
        np.testing.assert_allclose(
            np.asarray(longest.get_ydata(), dtype=float), run(run.times()).angle
        )
        if name in UNSTABLE:
            assert f"left on the {'+' if side > 0 else '−'} side" in axes.get_title(loc="left")
    assert rows[-1].get_xlabel() == palette.LABELS["periods"]
    assert len({axes.get_ylim() for axes in rows}) == 1
    assert f"Fig. {name} " in figure._suptitle.get_text()  # type: ignore[attr-defined]
    strips = [axes for axes in figure.axes if axes.get_xlabel() == palette.LABELS["kick"]]
    assert len(strips) == (1 if name in UNSTABLE else 0)
