"""Words of orbits with rest: rows of files, SI units, branches and points."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic
from rocksteady.branches import find_resting_branches
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.results.numbers import number
from rocksteady.words import resting
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.from_p(alpha=0.25, p=2.0, restitution=0.8)
MOTION = Harmonic(amplitude=1.05, frequency_ratio=2.0)


@cache
def branch_of(block: Block | DimensionlessBlock) -> RestingBranch:
    found = find_resting_branches(
        block, MOTION, "amplitude", (0.99, 1.08), resolution=0.01, model="linear"
    )
    return found.branches[0]


@every("block", [BARE, SIZED])
def test_rows_of_a_point_have_its_peaks_and_place_in_si_too(
    block: Block | DimensionlessBlock,
) -> None:
    branch = branch_of(block)
    point = branch.points[len(branch.points) // 2]
    first, second = point.excursions
    row: dict[str, Any] = resting.resting_row(3, point)
    beside: dict[str, Any] = resting.diagram_row(3, point)
    for each in (row, beside):
        assert (each["branch"], each["amplitude"]) == (3, point.amplitude)
        assert (each["frequency_ratio"], each["restitution"], each["period"]) == (2.0, 0.8, 1)
        assert each["stable"] is each["symmetric"] is True
        assert (each["highest"], each["lowest"]) == (point.highest, point.lowest)
        assert each["highest"] == -each["lowest"] > 0.0
        si = {key: value for key, value in each.items() if key.endswith(("_g", "_hz"))}
        if block is BARE:
            assert not si
            assert not {"highest_rad", "lowest_rad"} & set(each)
        else:
            assert si["accel_g"] == pytest.approx(0.25 * point.amplitude)
            assert si["freq_hz"] == pytest.approx(2.0 * 2.0 / (2.0 * math.pi))
            assert (each["highest_rad"], each["lowest_rad"]) == (
                pytest.approx(0.25 * point.highest),
                pytest.approx(0.25 * point.lowest),
            )
    assert row["shortest_rest_rad"] == min(first.rest, second.rest)
    assert row["impacts_followed"] == len(first.impact_phases) + len(second.impact_phases)
    assert (row["side"], row["rest_phases"]) == (first.side, 2)
    # It lifts off where the shaking comes to 1, and with no speed.
    assert row["uplift_phase_rad"] == pytest.approx(math.asin(1.0 / point.amplitude))
    assert row["chatter_end_rad"] == first.chatter_end > row["uplift_phase_rad"]
    for index in (1, 2):
        assert beside[f"multiplier_{index}_re"] == beside[f"multiplier_{index}_im"] == 0.0
    assert beside["impacts"] is None
    assert beside["admissible"] is True
    assert math.isnan(beside["arclength"])


@every(
    ("block", "case"),
    [(BARE, "restitution 0.8"), (SIZED, "restitution 0.8, alpha 14.3°, p 2 rad/s")],
)
def test_a_branch_and_its_ends_are_described_in_words(
    block: Block | DimensionlessBlock, case: str
) -> None:
    branch = branch_of(block)
    told, point = branch.describe(), branch.end.describe()
    low, high = branch.within
    assert (low, high) == (branch.begin.amplitude, branch.end.amplitude)
    assert told.headline == (
        f"Branch with rest, symmetric, 1 period: A from {low:.8g} to {high:.8g}, "
        f"Ω = 2, {case}, linear model"
    )
    assert point.headline == (
        f"Orbit with rest, rest end point: A = {high:.8g}, Ω = 2, {case}, linear model"
    )
    words = {fact.label: fact.words for fact in told.facts if fact.label}
    assert (words["from"], words["to"], words["grazes"]) == ("uplift", "rest end", "0")
    assert words["points"] == str(len(branch.points))
    values = {fact.key: fact.value for fact in told.facts}
    assert (values["amplitude"], values["frequency_ratio"]) == (None, 2.0)
    assert values["restitution"] == 0.8
    assert values["highest"] == float(np.nanmax(np.abs(branch.peaks)))
    assert values["begin"] == {"type": "uplift", "amplitude": low}
    assert values["end"] == {"type": "end-of-rest", "amplitude": high}
    words = {fact.label: fact.words for fact in point.facts if fact.label}
    rests = ", ".join(number(each) for each in branch.end.rests.tolist())
    assert (words["A"], words["rests for"]) == (f"{high:.10g}", f"{rests} rad")
    assert words["comes to rest"] == "2 times in a period"
    assert (words["multipliers"], words["stable"]) == ("0, 0", "yes")
    peaks = ", ".join(number(each) for each in (branch.end.highest, branch.end.lowest))
    assert words["highest, lowest"] == f"{peaks} alpha"


def test_tables_list_branches_and_their_events_from_one_on() -> None:
    branch = branch_of(BARE)
    table = resting.resting_table([branch, branch])
    rows = [[column.words(row) for column in table.columns] for row in table.rows]
    low, high = branch.within
    highest = float(np.nanmax(np.abs(branch.peaks)))
    expected = ["1", "2", "symmetric", f"{low:.8f}", f"{high:.8f}", "uplift", "rest end"]
    assert rows == [[str(place), *expected, f"{highest:.4f}"] for place in (1, 2)]
    assert table.title == "orbits that come to rest, all stable"
    lefts = [column.heading for column in table.columns if column.left]
    assert lefts == ["kind", "begin", "end"]
    assert resting.resting_table([branch]).columns[4].heading == "from A"
    events = resting.events_table([branch, branch], key="events")
    assert [column.heading for column in events.columns if column.left] == ["event"]
    assert [row["branch"] for row in events.rows] == [1] * len(branch.events) + [2] * len(
        branch.events
    )
    (*_, last) = ([column.words(row) for column in events.columns] for row in events.rows)
    end = branch.events[-1]
    assert last == [
        "2",
        resting.ENDS[end.type.value],
        f"{end.amplitude:.10f}",
        f"{end.highest:.5g}",
        f"{end.lowest:.5g}",
        f"{min(end.rests):.4g} rad",
    ]
    for empty in (resting.resting_table([]), resting.events_table([], key="events")):
        assert (list(empty.rows), empty.title) == ([], "")
