"""Words of branches: points, ranges and cascades."""

import math
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Linear, Nonlinear
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.model.facts import AnyBlock
from rocksteady.results.description import Table
from rocksteady.words import branches, diagrams
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
UNLIKE = DimensionlessBlock(restitution=0.8, alpha_ratio=1.2, p_ratio=0.9)
SIZED = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
SIDES = Block.asymmetric(left=0.15, right=0.2, height=1.2, restitution=(0.85, 0.8))
LINEAR, NONLINEAR = Linear(), Nonlinear()


def cells(table: Table) -> list[list[str]]:
    return [[column.words(row) for column in table.columns] for row in table.rows]


@every(
    ("block", "restitution", "harmonics", "text"),
    [
        (BARE, 0.8, (), "restitution 0.8, linear model"),
        (BARE, 0.7, (), "restitution 0.7, linear model"),
        (SIDES, 0.85, (), "restitution 0.85/0.8, linear model"),
        (UNLIKE, 0.8, (), "restitution 0.8, linear model"),
        (BARE, 0.8, ((3, 0.2, 0.0),), "restitution 0.8, orders 3, linear model"),
    ],
)
def test_a_point_has_both_restitutions_where_its_impacts_differ(
    block: AnyBlock, restitution: float, harmonics: Any, text: str
) -> None:
    chain = SimpleNamespace(harmonics=harmonics)
    point = point_of(block=block, restitution=restitution, chain=chain, model=LINEAR)
    assert branches.point_case(point) == text


@every(
    ("low", "high", "text"),
    [
        (1.0, 2.5, "1 to 2.5"),
        (1.23456, 1.23466, "1.2346 to 1.2347"),
        (1.23456, 1.234562, "1.23456 + 2e-06"),
    ],
)
def test_a_range_has_the_digits_that_tell_its_ends_apart(
    low: float, high: float, text: str
) -> None:
    assert branches.range_text(low, high) == text
    assert branches.stable_text([(low, high)]) == text
    assert branches.stable_text([(low, high), (3.0, 4.0)]) == f"{text} +1"
    assert branches.stable_text([(low, high)] * 3) == f"{text} +2"
    assert branches.stable_text([]) == "—"


def point_of(**changed: Any) -> Any:
    values = {
        "type": PointType.FOLD, "amplitude": 2.0, "frequency_ratio": 4.0, "restitution": 0.8,
        "period": 3, "impacts": 4, "symmetric": False, "stable": False, "admissible": True,
        "peaks": np.array([0.5, -0.25, 0.4]), "arclength": 1.5,
        "multipliers": np.array([2.0 + 0.5j, 0.25 - 0.125j]),
    }  # fmt: skip
    return SimpleNamespace(**{**values, **changed})


@every(("lean", "high", "low"), [(1.0, 0.5, -0.25), (-1.0, 0.25, -0.5)])
@every("block", [BARE, SIZED])
def test_a_point_has_the_extremes_and_multipliers_of_its_orbit_or_its_mirror_image(
    lean: float, high: float, low: float, block: AnyBlock
) -> None:
    row = branches.point_row(7, point_of(), lean, block)
    values: dict[str, Any] = branches.point_values(point_of(), lean, block)
    assert (row["highest"], row["lowest"]) == tuple(values["peaks"]) == (high, low)
    assert [row[f"multiplier_{name}"] for name in ("1_re", "1_im", "2_re", "2_im")] == [
        2.0, 0.5, 0.25, -0.125
    ]  # fmt: skip
    assert (row["branch"], row["type"], row["period"], row["impacts"]) == (7, "fold", 3, 4)
    assert (row["stable"], row["admissible"], row["arclength"]) == (False, True, 1.5)
    assert values["multipliers"] == [2.0 + 0.5j, 0.25 - 0.125j]
    if isinstance(block, Block):
        scaled = [high * block.alpha, low * block.alpha]
        assert [row["highest_rad"], row["lowest_rad"]] == values["peaks_rad"] == scaled
        for each in (row, values):
            assert each["accel_g"] == pytest.approx(2.0 * block.alpha)
            assert each["freq_hz"] == pytest.approx(4.0 * block.p / (2.0 * math.pi))
    else:
        assert not any(key.endswith(("_rad", "_g", "_hz")) for key in (*row, *values))


def test_a_branch_lists_where_it_is_stable_from_low_to_high() -> None:
    stretches = [
        SimpleNamespace(first=first, last=last, stable=stable)
        for first, last, stable in ((0, 2, True), (2, 3, False), (3, 4, True))
    ]
    branch: Any = SimpleNamespace(
        parameter="amplitude", values=np.array([5.0, 4.0, 3.0, 2.0, 2.5]), stretches=stretches,
        points=[point_of(amplitude=5.0), *3 * [None], point_of(amplitude=2.5)],
        period=1, impacts=2, symmetric=True,
    )  # fmt: skip
    values: dict[str, Any] = branches.branch_values(branch)
    assert list(map(list, values["stable_ranges"])) == [[2.0, 2.5], [3.0, 5.0]]
    assert (values["within"], values["points"]) == ([2.0, 5.0], 5)
    table = diagrams.branches_table([{"branch": 1, **values}], "amplitude")
    assert cells(table) == [["1", "1", "2", "symmetric", "fold", "fold", "2 to 2.5 +1"]]
    assert [column.left for column in table.columns] == 3 * [False] + 4 * [True]
    assert (values["begin"]["amplitude"], values["end"]["amplitude"]) == (5.0, 2.5)


@every("block", [BARE, SIZED])
@every("parameter", ["amplitude", "frequency_ratio", "restitution"])
def test_a_bifurcation_is_listed_with_degrees_and_a_unit_where_a_block_has_a_size(
    block: AnyBlock, parameter: str
) -> None:
    rows = [{"branch": 2, **branches.point_values(point_of(), 1.0, block)}]
    table = branches.bifurcations_table(rows, parameter, block)
    (row,) = cells(table)
    headings = [column.heading for column in table.columns]
    value = {"amplitude": 2.0, "frequency_ratio": 4.0, "restitution": 0.8}[parameter]
    scale = {"amplitude": SIZED.alpha, "frequency_ratio": SIZED.p / (2.0 * math.pi)}
    beside, heading, ends = "unsymmetric", "kind", ["0.5000", "-0.2500"]
    if block is SIZED:
        ends = [f"{math.degrees(u * SIZED.alpha):.2f}°" for u in (0.5, -0.25)]
        if parameter in scale:
            beside = f"{value * scale[parameter]:.6g}"
            heading = {"amplitude": "g", "frequency_ratio": "Hz"}[parameter]
    assert row == ["2", "fold", f"{value:.8f}", beside, "3", "4", *ends]
    lefts = ["bifurcation", "kind"] if heading == "kind" else ["bifurcation"]
    assert [column.heading for column in table.columns if column.left] == lefts
    assert headings[3] == heading


@every(
    ("values", "title"),
    [
        ([2.0], "cascade of 1 period doubling"),
        ([2.0, 1.5], "cascade of 2 period doublings"),
        ([2.0, 1.5, 1.4, 1.375], "cascade of 4 period doublings"),
    ],
)
def test_a_doubling_stands_with_the_distance_to_the_next_and_the_ratio_of_both_its_distances(
    values: list[float], title: str
) -> None:
    distances = np.diff(values).tolist()
    ratios = [a / b for a, b in pairwise(distances)]
    cascade: Any = SimpleNamespace(
        parameter="amplitude", points=[point_of(period=2**k) for k in range(len(values))],
        values=np.array(values), distances=np.array(distances), ratios=np.array(ratios), limit=1.25,
    )  # fmt: skip
    table = branches.cascade_table(cascade)
    assert table.title == title
    expected = []
    for k, value in enumerate(values):
        apart = f"{abs(distances[k]):.3e}" if k < len(distances) else ""
        ratio = f"{ratios[k - 1]:.4f}" if 1 <= k <= len(ratios) else ""
        expected.append([f"{2**k} -> {2 ** (k + 1)}", f"{value:.12f}", apart, ratio])
    assert cells(table) == expected
    (note,) = branches.cascade_notes(cascade)
    if len(values) < 3:
        assert note == "fewer than three doublings have no ratio"
    else:
        assert note.startswith("limit 1.250000000000, ")
