"""Bifurcation diagrams: points, branches, sweeps and cascades."""

import json
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, find_attractor, find_bifurcations
from rocksteady.branches import BifurcationDiagram, BranchOptions
from rocksteady.dynamics.continuation.find_bifurcations import _range_of
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import symmetry_breaking_frequencies
from rocksteady.words.attractors import start_text
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
MOTION = Harmonic(amplitude=2.0, frequency_ratio=1.95)
WITHIN = (1.9, 2.0)
SMALL = BranchOptions(max_period=1, max_impacts=2, doublings=0)


@cache
def diagram_of(block: Block | DimensionlessBlock, parameter: str) -> BifurcationDiagram:
    """Return a small diagram about a symmetry breaking, without sweeps."""
    ends = {"frequency_ratio": WITHIN, "amplitude": (1.95, 2.05), "restitution": (0.78, 0.82)}
    return find_bifurcations(
        block, MOTION, parameter, within=ends[parameter], values=0, search=SMALL, model="linear"
    )


@pytest.mark.slow
@every("parameter", ["amplitude", "frequency_ratio", "restitution"])
def test_the_parameter_that_moves_has_no_one_value(parameter: str) -> None:
    values = diagram_of(SIZED, parameter).to_dict()
    assert values["parameter"] == parameter
    others = {"amplitude", "frequency_ratio", "restitution"} - {parameter}
    assert values[parameter] is None
    assert None not in {values[other] for other in others}
    assert (values["block"]["restitution"] is None) == (parameter == "restitution")
    assert (values["accel_g"] is None) == (parameter == "amplitude")
    assert (values["freq_hz"] is None) == (parameter == "frequency_ratio")
    assert diagram_of(BARE, parameter).to_dict().keys() & {"block", "accel_g", "freq_hz"} == set()


def test_a_bifurcation_on_two_branches_is_listed_once() -> None:
    diagram = diagram_of(BARE, "frequency_ratio")
    assert sum(len(branch.bifurcations) for branch in diagram.branches) == 2
    (each,) = diagram.points
    assert each.branches == (1, 2)
    assert each.point.type == "symmetry-breaking"
    exact = symmetry_breaking_frequencies(2.0, 0.8)
    assert np.abs(each.point.frequency_ratio - exact).min() < 1e-11
    (values,) = diagram.to_dict()["points"]
    assert (values["branch"], values["branches"]) == (1, [1, 2])
    assert values["peaks"] == [each.highest, each.lowest]
    # It counts as one where two branches come to it within rounding, and as two farther apart.
    begin, *more = diagram.branches[1].points
    for away, places in ((1e-9, 1), (1e-4, 2)):
        shifted = np.add(begin.chain.parameters, (0.0, away, 0.0))
        moved = replace(begin, chain=begin.chain.moved(begin.chain.phases, shifted))
        branch = replace(diagram.branches[1], points=(moved, *more))
        assert len(replace(diagram, branches=(diagram.branches[0], branch)).points) == places


def test_a_block_with_a_size_has_points_in_si() -> None:
    (bare,) = diagram_of(BARE, "frequency_ratio").to_dict()["points"]
    (point,) = diagram_of(SIZED, "frequency_ratio").to_dict()["points"]
    assert point.keys() - bare.keys() == {"accel_g", "freq_hz", "peaks_rad"}
    motion = Harmonic.from_si(
        SIZED, acceleration_m_s2=point["accel_g"] * SIZED.gravity, frequency_hz=point["freq_hz"]
    )
    assert motion.frequency_ratio == pytest.approx(point["frequency_ratio"])
    assert point["peaks_rad"] == [SIZED.alpha * peak for peak in point["peaks"]]


def test_of_mirror_images_the_one_that_leans_to_the_positive_side_is_listed() -> None:
    diagram = diagram_of(BARE, "frequency_ratio")
    symmetric, leaning = diagram.branches
    assert symmetric.lean == 1.0
    rows = [row for row in diagram.rows() if row["branch"] == 2]
    assert len(rows) == len(leaning.points)
    assert all(row["highest"] >= -row["lowest"] - 1e-12 > 0.0 for row in rows)
    assert rows[-1]["highest"] > 0.01 - rows[-1]["lowest"]


def test_a_branch_is_stable_where_its_points_are() -> None:
    diagram = diagram_of(BARE, "frequency_ratio")
    listed = diagram.to_dict()["branches"]
    breaking = diagram.points[0].point.frequency_ratio
    assert [each["branch"] for each in listed] == [1, 2]
    symmetric, leaning = listed
    assert symmetric["within"] == list(WITHIN)
    assert (symmetric["symmetric"], leaning["symmetric"]) == (True, False)
    ((low, high),) = symmetric["stable_ranges"]
    assert (low, high) == (pytest.approx(breaking), WITHIN[1])
    ((low, high),) = leaning["stable_ranges"]
    assert (low, high) == (WITHIN[0], pytest.approx(breaking))
    assert leaning["end"] == {"type": "end-of-range", "frequency_ratio": WITHIN[0]}


def test_a_branch_that_ends_without_loss_is_as_stable_as_just_before() -> None:
    diagram = find_bifurcations(
        BARE, MOTION, "restitution", within=(0.9, 1.0), values=0, search=SMALL
    )
    (branch,) = diagram.branches
    assert branch.stable[:-1].all()
    assert diagram.to_dict()["branches"][0]["stable_ranges"] == [[0.9, 1.0]]


@pytest.mark.parametrize("block", [BARE, SIZED])
def test_there_is_a_row_a_point(block: Block | DimensionlessBlock) -> None:
    diagram = diagram_of(block, "frequency_ratio")
    frame = diagram.to_dataframe()
    followed = sum(len(branch.points) for branch in diagram.branches)
    assert len(frame) == followed + sum(len(branch.points) for branch in diagram.resting)
    added = [name for name in frame if name not in set(next(diagram.rows()))]
    assert added == (["highest_deg", "lowest_deg"] if block is SIZED else [])
    assert not any(name.endswith("_rad") for name in frame)
    assert len(frame.columns) == 18 + (4 if block is SIZED else 0)
    moduli = [
        np.hypot(frame[f"multiplier_{n}_re"], frame[f"multiplier_{n}_im"]).to_numpy()
        for n in (1, 2)
    ]
    inside = np.maximum(*moduli) < 1.0
    regular = (frame["type"] == "regular").to_numpy()
    assert regular.sum() > 10
    assert (inside == frame["stable"].to_numpy())[regular].all()


def test_sweeps_go_both_ways_and_keep_what_single_motions_settle_to() -> None:
    diagram = find_bifurcations(
        BARE, MOTION, "frequency_ratio", within=WITHIN, values=5, search=SMALL
    )
    up, down = diagram.sweeps
    assert up.values.tolist() == down.values[::-1].tolist() == np.linspace(*WITHIN, 5).tolist()
    assert (start_text(up.start), start_text(down.start)) == ("steady", "steady")
    alone = find_attractor(BARE, Harmonic(amplitude=2.0, frequency_ratio=1.9), start=up.start)
    assert (up.attractors[0].kind, up.attractors[0].after) == (alone.kind, alone.after)
    for sweep, values in zip(diagram.sweeps, diagram.to_dict()["sweeps"], strict=True):
        assert values["direction"] == sweep.direction
        assert sum(run["values"] for run in values["runs"]) == 5 == sum(values["counts"].values())
        at = 0
        for run in values["runs"]:
            for each in sweep.attractors[at : at + run["values"]]:
                assert (each.kind.value, each.period) == (run["kind"], run["period"])
            at += run["values"]


@every(("values", "ends"), [([2.0, 1.9], (1.9, 2.0)), ([1.95], (0.975, 3.9)), (1, (0.975, 3.9))])
def test_the_range_is_that_of_some_values_or_a_factor_of_two(values: Any, ends: Any) -> None:
    found, steps = _range_of(BARE, MOTION, "frequency_ratio", None, values)
    assert found == ends
    assert steps.tolist() == (sorted(values) if isinstance(values, list) else [ends[0]])


def test_a_sweep_begins_at_rest_where_there_is_no_steady_state() -> None:
    diagram = find_bifurcations(
        BARE,
        Harmonic(amplitude=1.0, frequency_ratio=4.0),
        "amplitude",
        values=[0.1, 0.2],
        search=SMALL,
    )
    assert diagram.within == (0.1, 0.2)
    assert {start_text(sweep.start) for sweep in diagram.sweeps} == {"rest"}


def test_the_cascade_tends_to_feigenbaums_ratio() -> None:
    diagram = find_bifurcations(
        BARE,
        MOTION,
        "frequency_ratio",
        within=(1.7, 2.1),
        values=0,
        search=BranchOptions(max_period=2, doublings=4),
    )
    assert diagram.cascade is not None
    values = diagram.to_dict()["cascade"]
    assert values["periods"] == [1, 2, 4, 8]
    first, second, third, fourth = values["values"]
    assert values["distances"] == pytest.approx([second - first, third - second, fourth - third])
    assert values["ratios"][-1] == pytest.approx(4.6692, rel=0.06)
    assert values["limit"] < fourth
    text = diagram.summary(more=True)
    assert f"{first:.12f}" in text
    assert f"limit {values['limit']:.12f}" in text
    assert len(repr(diagram.cascade)) < 160
    assert "cascade" not in diagram_of(BARE, "frequency_ratio").to_dict()


def test_a_diagram_is_drawn_in_one_line() -> None:
    axes = diagram_of(BARE, "frequency_ratio").plot()
    assert axes.get_xlim() == WITHIN
    words = " ".join(text.get_text() for text in axes.texts)
    assert "symmetry breaks" in words


def test_a_diagram_becomes_json() -> None:
    def plain(value: object) -> Any:
        assert isinstance(value, complex)
        return [value.real, value.imag]

    values = diagram_of(SIZED, "amplitude").to_dict()
    assert json.loads(json.dumps(values, default=plain))["within"] == [1.95, 2.05]


@every(
    ("change", "message"),
    [
        ({"parameter": "phase"}, "parameter = 'phase'"),
        ({"within": (2.0, 1.0)}, "within = "),
        ({"within": (-1.0, 1.0)}, "frequency_ratio = -1"),
        ({"values": -1}, "values = -1"),
        ({"values": 30_000}, "values = 30000|values = 20001"),
    ],
)
def test_what_is_no_diagram_is_refused(change: dict[str, Any], message: str) -> None:
    given = {"parameter": "frequency_ratio", "within": WITHIN, "values": 3, **change}
    parameter = given.pop("parameter")
    with pytest.raises(InputError, match=message):
        find_bifurcations(BARE, MOTION, parameter, search=SMALL, **given)
    with pytest.raises(InputError, match="max_impacts = 0"):
        BranchOptions(max_impacts=0)
    with pytest.raises(InputError, match="max_cycles = 0"):
        BranchOptions(max_cycles=0)


def test_a_block_against_a_wall_has_no_branches() -> None:
    block = DimensionlessBlock(restitution=0.9, one_sided=True)
    with pytest.raises(ModelError, match="stands against a wall"):
        find_bifurcations(block, MOTION, "amplitude")


def test_branches_start_from_each_order() -> None:
    block, motion = (
        DimensionlessBlock(restitution=0.87),
        Harmonic(amplitude=5.0, frequency_ratio=8.0),
    )

    def kinds(*orders: int) -> set[tuple[int, int]]:
        search = BranchOptions(orders=orders, max_period=3, max_impacts=2, doublings=0)
        found = find_bifurcations(
            block, motion, "frequency_ratio", within=(7.0, 9.0), values=0, search=search
        )
        assert found.to_dict()["orders"] == list(dict.fromkeys(orders))
        return {(branch.period, branch.impacts) for branch in found.branches}

    assert kinds(3, 1, 3) == kinds(1) | kinds(3) > kinds(1)
    assert BranchOptions(orders=(1, 5)).longest == 20
    for bad in ((), (2,), (1, -1), (1001,)):
        with pytest.raises(InputError, match="orders"):
            BranchOptions(orders=bad)
