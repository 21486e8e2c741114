"""Values of bifurcation diagrams: axes, points, branches, sweeps and cascades."""

import numpy as np
import pytest

from rocksteady import (
    Harmonic,
    find_cascade,
    find_orbits,
    sweep_attractor,
    symmetry_breaking_frequency,
)
from rocksteady.cli.flags.sweep_start import Sweep
from rocksteady.cli.present.diagrams_values import (
    CSV_HEADER,
    bifurcation_values,
    branch_values,
    cascade_values,
    csv_rows,
    extremes,
    lean,
    range_values,
    sweep_values,
)
from tests.cli.present.diagrams import BARE, SIZED, WITHIN, branches_of, span_of
from tests.cli.present.printed import as_json


def test_the_parameter_that_moves_has_no_one_value() -> None:
    for name in ("amplitude", "frequency_ratio", "restitution"):
        values = as_json(range_values(span_of(SIZED, name)))
        assert values["parameter"] == name
        others = {"amplitude", "frequency_ratio", "restitution"} - {name}
        assert values[name] is None
        assert None not in {values[other] for other in others}
        assert (values["block"]["restitution"] is None) == (name == "restitution")
        assert (values["accel_g"] is None) == (name == "amplitude")
        assert (values["freq_hz"] is None) == (name == "frequency_ratio")
    bare = range_values(span_of(BARE))
    assert bare.keys() == {"parameter", "within", "amplitude", "frequency_ratio", "restitution"}


def test_a_bifurcation_on_two_branches_is_listed_once() -> None:
    branches = branches_of()
    assert sum(len(branch.bifurcations) for branch in branches) == 2
    (point,) = bifurcation_values(branches, span_of(BARE))
    assert (point["branch"], point["branches"]) == (1, [1, 2])
    assert point["type"] == "symmetry-breaking"
    exact = symmetry_breaking_frequency(2.0, 0.8)
    assert np.abs(point["frequency_ratio"] - exact).min() < 1e-11
    assert (point["period"], point["impacts"], point["symmetric"]) == (1, 2, True)
    # The other branch alone lists it too.
    (alone,) = bifurcation_values(branches[1:], span_of(BARE))
    assert (alone["branch"], alone["branches"]) == (1, [1])
    assert alone["frequency_ratio"] == pytest.approx(point["frequency_ratio"], abs=1e-9)


def test_a_block_with_a_size_has_points_in_si() -> None:
    (bare,) = bifurcation_values(branches_of(), span_of(BARE))
    (point,) = as_json({"points": bifurcation_values(branches_of(), span_of(SIZED))})["points"]
    assert point.keys() - bare.keys() == {"accel_g", "freq_hz", "peaks_rad"}
    shaking = Harmonic.from_si(
        SIZED, acceleration_m_s2=point["accel_g"] * SIZED.gravity, frequency_hz=point["freq_hz"]
    )
    assert shaking.frequency_ratio == pytest.approx(point["frequency_ratio"])
    assert point["peaks_rad"] == [SIZED.alpha * peak for peak in point["peaks"]]


def test_of_mirror_images_the_one_that_leans_to_the_positive_side_is_listed() -> None:
    symmetric, leaning = branches_of()
    assert lean(symmetric) == 1.0
    sign = lean(leaning)
    for point in leaning.points:
        high, low = extremes(point, sign)
        assert high >= -low - 1e-12 > 0.0
        assert extremes(point, -sign) == [-low, -high]
    far = extremes(leaning.points[-1], sign)
    assert far[0] > 0.01 - far[1]


def test_a_branch_is_stable_where_its_points_are() -> None:
    branches = branches_of()
    listed = as_json({"branches": branch_values(branches, span_of(BARE))})["branches"]
    (breaking,) = (
        point["frequency_ratio"] for point in bifurcation_values(branches, span_of(BARE))
    )
    assert [one["branch"] for one in listed] == [1, 2]
    symmetric, leaning = listed
    assert symmetric["within"] == list(WITHIN)
    assert (symmetric["symmetric"], leaning["symmetric"]) == (True, False)
    ((low, high),) = symmetric["stable_ranges"]
    assert (low, high) == (pytest.approx(breaking), WITHIN[1])
    ((low, high),) = leaning["stable_ranges"]
    assert (low, high) == (WITHIN[0], pytest.approx(breaking))
    assert leaning["begin"]["type"] == "symmetry-breaking"
    assert leaning["end"] == {"type": "end-of-range", "frequency_ratio": WITHIN[0]}
    assert [one["points"] for one in listed] == [len(branch.points) for branch in branches]


@pytest.mark.parametrize("block", [BARE, SIZED])
def test_there_is_a_row_a_point(block: object) -> None:
    branches = branches_of()
    span = span_of(SIZED if block is SIZED else BARE)
    rows = list(csv_rows(branches, span))
    assert len(rows) == sum(len(branch.points) for branch in branches)
    assert {len(row) for row in rows} == {len(CSV_HEADER) + (4 if block is SIZED else 0)}
    for row in rows:
        cells = dict(zip(CSV_HEADER, row, strict=False))
        multipliers = [
            complex(cells[f"multiplier_{n}_re"], cells[f"multiplier_{n}_im"])  # type: ignore[call-overload]
            for n in (1, 2)
        ]
        inside = max(map(abs, multipliers)) < 1.0
        assert inside == cells["stable"] or cells["type"] != "regular"


def test_a_sweep_is_told_in_runs() -> None:
    values = np.linspace(1.9, 2.0, 6)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=1.9, phase=0.5)
    trail = sweep_attractor(BARE, shaking, "frequency_ratio", values)
    found = as_json(sweep_values(Sweep(start="rest", trail=trail)))
    assert (found["direction"], found["start"], found["values"]) == ("up", "rest", 6)
    assert sum(run["values"] for run in found["runs"]) == 6 == sum(found["counts"].values())
    assert (found["runs"][0]["from"], found["runs"][-1]["to"]) == (1.9, 2.0)
    at = 0
    for run in found["runs"]:
        for one in trail.attractors[at : at + run["values"]]:
            assert (one.kind.value, one.period) == (run["kind"], run["period"])
        at += run["values"]
        orbit = trail.attractors[at - 1].orbit
        assert run["impacts_per_period"] == (None if orbit is None else orbit.impacts)


def test_a_cascade_has_a_ratio_from_three_doublings_on() -> None:
    assert cascade_values(None) is None
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    start = find_orbits(BARE, shaking, max_period=1, max_impacts=2)[0]
    two, three = (
        cascade_values(
            find_cascade(start, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=many)
        )
        for many in (2, 3)
    )
    assert two is not None
    assert three is not None
    assert (len(two["values"]), len(two["distances"]), two["ratios"]) == (2, 1, [])
    assert three["periods"] == [1, 2, 4]
    first, second, third = three["values"]
    assert three["distances"] == pytest.approx([second - first, third - second])
    assert three["ratios"] == pytest.approx([(second - first) / (third - second)])
    assert as_json(three)["limit"] < third
