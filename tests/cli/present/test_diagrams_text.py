"""A bifurcation diagram as text."""

from typing import Any

import pytest

from rocksteady import Block, DimensionlessBlock
from rocksteady.cli.present.diagrams_text import print_diagram
from rocksteady.cli.present.diagrams_values import bifurcation_values, branch_values, range_values
from tests.cli.present.diagrams import BARE, SIZED, branches_of, span_of
from tests.cli.present.printed import fits, printed

RUN = {"from": 1.9, "to": 1.95, "values": 3, "kind": "unsymmetric", "period": 2}


def values_of(
    block: Block | DimensionlessBlock, parameter: str = "frequency_ratio"
) -> dict[str, Any]:
    span, branches = span_of(block, parameter), branches_of(parameter)
    return {
        **range_values(span),
        "max_period": 1,
        "max_impacts": 2,
        "points": bifurcation_values(branches, span),
        "branches": branch_values(branches, span),
        "sweeps": [],
    }


@pytest.mark.parametrize("parameter", ["frequency_ratio", "amplitude", "restitution"])
@pytest.mark.parametrize("block", [BARE, SIZED])
def test_bifurcations_and_branches_are_a_row_each(
    block: Block | DimensionlessBlock, parameter: str
) -> None:
    values, span = values_of(block, parameter), span_of(block, parameter)
    text = printed(print_diagram, values, span)
    assert fits(text)
    assert text.startswith(f"{span.text}\n2 branches up to 1 period and 2 impacts, 1 bifurcation\n")
    (point,) = values["points"]
    (row,) = (line for line in text.splitlines() if "symmetry breaking" in line)
    assert f"{point[parameter]:.8f}" in row
    unit = {"frequency_ratio": "freq_hz", "amplitude": "accel_g"}.get(parameter)
    in_si = block is SIZED and unit is not None
    assert ("symmetric" in row) == (not in_si), "the unit takes the place of the kind"
    if in_si:
        assert f"{point[unit]:.6g}" in row
    assert sum("range end" in line for line in text.splitlines()) == 2
    assert sum(" unsymmetric " in line for line in text.splitlines()) == 1


def test_the_longest_runs_of_a_sweep_are_listed_in_their_order() -> None:
    runs = [{**RUN, "from": 1.0 + 0.01 * k, "values": 1 + (k % 5), "period": k} for k in range(12)]
    runs[-1] |= {"kind": "rest", "period": None}
    sweeps = [
        {"direction": "up", "start": "steady", "runs": runs},
        {"direction": "down", "start": "rest", "runs": runs[:3]},
    ]
    span = span_of(BARE)
    text = printed(print_diagram, {**values_of(BARE), "sweeps": sweeps}, span)
    assert fits(text)
    upward, downward = text.partition("upward sweep from steady")[2].split(
        "downward sweep from rest"
    )
    assert "and 4 shorter runs; --json has them" in upward
    assert "shorter" not in downward
    listed = [float(line.split()[0]) for line in upward.splitlines() if "1.95" in line]
    assert len(listed) == 8
    assert listed == sorted(listed)
    assert 1.0 not in listed, "a run of one value is among the shorter ones"
    assert "unsymmetric, period 2" in upward
    assert "unsymmetric, period 1" not in downward


def test_a_cascade_is_a_row_a_doubling() -> None:
    cascade = {
        "values": [1.8, 1.79, 1.788],
        "periods": [1, 2, 4],
        "distances": [-0.01, -0.002],
        "ratios": [5.0],
        "limit": 1.7875,
    }
    span = span_of(BARE)
    text = printed(print_diagram, {**values_of(BARE), "cascade": cascade}, span)
    assert fits(text)
    rows = [line.split() for line in text.splitlines() if " -> " in line]
    assert rows == [
        ["1", "->", "2", "1.800000000000", "1.000e-02"],
        ["2", "->", "4", "1.790000000000", "2.000e-03", "5.0000"],
        ["4", "->", "8", "1.788000000000"],
    ]
    assert "limit 1.787500000000" in text
    cascade |= {"values": [1.8], "periods": [1], "distances": [], "ratios": [], "limit": None}
    text = printed(print_diagram, {**values_of(BARE), "cascade": cascade}, span)
    assert "fewer than three doublings have no ratio" in text
    text = printed(print_diagram, {**values_of(BARE), "cascade": None}, span)
    assert "no cascade" in text


def test_a_narrow_range_keeps_its_width_and_an_unstable_branch_a_dash() -> None:
    values = values_of(BARE)
    first, second = values["branches"]
    first["stable_ranges"] = [[1.95, 1.95000001], [1.96, 1.97]]
    second["stable_ranges"] = []
    text = printed(print_diagram, values, span_of(BARE))
    assert fits(text)
    assert "1.95 + 1e-08 +1" in text
    assert sum(line.rstrip().endswith("—") for line in text.splitlines()) == 1


def test_nothing_that_moves_is_no_table() -> None:
    values = {**values_of(BARE), "points": [], "branches": []}
    text = printed(print_diagram, values, span_of(BARE))
    assert "0 branches up to 1 period and 2 impacts, 0 bifurcations" in text
    assert "stable in" not in text
