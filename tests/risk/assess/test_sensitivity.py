"""Cases of a changed object: each against runs of its own, and what is changed."""

import math
from dataclasses import replace
from itertools import product
from typing import Any

import pytest

from rocksteady import BaseMotion, Block, Record, Status
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import DescribedObject
from rocksteady.risk.assess.described.objects import parameter_words
from rocksteady.risk.assess.placed_objects import place_objects
from rocksteady.risk.assess.sensitivity import Bar, Case, bars_of, changes_of, vary
from rocksteady.risk.counted.band import share_band
from rocksteady.seismic.spectra.many import simulate_many
from tests.every import every
from tests.risk.counted.recorded import described
from tests.risk.counted.test_suite import peaks_of

SUITE = make_synthetic_suite(12)
BOTH = {"pga_g": 0.4, "pgv_m_s": 0.45}
TWO = {"assessment": {"draws": 2}}


def statue(**keys: Any) -> DescribedObject:
    return described(0.36, 1.8, **{**BOTH, **TWO, **keys})


def cases_of(one: DescribedObject, motions: Any = SUITE) -> tuple[Case, ...]:
    placed = place_objects([one], motions)
    (shaking,) = placed.shakings
    assert shaking is not None
    return vary(placed.objects[0], shaking)


def shaken(record: Record) -> Record:
    """Return a record with both peaks of the demand."""
    pga, pgv = peaks_of(record)
    scale = BOTH["pga_g"] / pga
    stretch = BOTH["pgv_m_s"] / (scale * pgv)
    return Record(acceleration_m_s2=scale * record.acceleration_m_s2, dt_s=stretch * record.dt_s)


def fallen(block: Block, ratios: tuple[float, ...] = (), *, signs: int = 1) -> int:
    """Count falls by another route: record by record, each with its own restitution and sign."""
    count = 0
    for ratio in ratios or (block.restitution,):
        body = block.with_restitution(ratio)
        for record, reverse in product(SUITE, (False, True)[:signs]):
            found = simulate_many(body, shaken(record), scales=1.0, reverse=reverse)
            count += int(found["status"] == Status.OVERTURNED)
    return count


@pytest.fixture(scope="module", name="cases")
def _cases() -> tuple[Case, ...]:
    return cases_of(statue())


def test_the_first_case_is_the_object_as_it_is(cases: tuple[Case, ...]) -> None:
    e = statue().block.restitution
    base = cases[0]
    assert base.parameter == "as described"
    assert (base.fall, base.runs) == (fallen(statue().block, (e, min(0.98, math.sqrt(e)))), 24)
    assert base.share == pytest.approx(base.fall / 24)
    assert base.low < base.share < base.high


def test_a_case_is_the_object_with_that_changed(cases: tuple[Case, ...]) -> None:
    k = math.hypot(0.36, 1.8) / math.sqrt(12.0)
    bodies = {
        ("base width", "-5 %, worn edges"): (0.171, 1.8),
        ("mass centre", "-10 %"): (0.18, 1.62),
        ("mass centre", "+10 %"): (0.18, 1.98),
    }
    found = {(case.parameter, case.change): case for case in cases}
    for key, (half, height) in bodies.items():
        body = Block.asymmetric(left=half, right=half, height=height, gyration=k)
        e = body.restitution
        assert found[key].fall == fallen(body, (e, min(0.98, math.sqrt(e)))), key
    falls = [found[key].fall for key in bodies]
    assert falls[1] < falls[2]
    assert {case.parameter for case in cases[1:]} == {"mass centre", "base width", "restitution"}


def test_the_ends_of_the_restitutions_stand_alone_and_add_up(cases: tuple[Case, ...]) -> None:
    base, low, high = (cases[0], *(case for case in cases if case.parameter == "restitution"))
    assert low.fall + high.fall == base.fall
    assert low.runs == high.runs == len(SUITE)
    e = statue().block.restitution
    assert (low.change, high.change) == (f"{e:.3f} alone", f"{min(0.98, math.sqrt(e)):.3f} alone")
    # One record, one run: the interval of a binomial count.
    one = [1.0] * low.fall + [0.0] * (low.runs - low.fall)
    assert (low.low, low.high) == pytest.approx(share_band(one, 1))


def test_a_single_restitution_is_not_varied() -> None:
    fixed = cases_of(statue(restitution=0.9))
    assert {case.parameter for case in fixed[1:]} == {"mass centre", "base width"}
    assert fixed[0].runs == len(SUITE)


def test_both_ends_of_each_range_are_cases() -> None:
    one = statue(
        geometry={"width_m": {"low": 0.32, "high": 0.6}, "mass_kg": 60.0},
        content={"mass_kg": {"low": 1.0, "high": 40.0}, "mass_centre_height_m": 1.5},
        fixed_parts=True,
        assessment={"draws": 1},
    )
    cases = cases_of(one)
    found = [(case.parameter, case.change) for case in cases[4:]]
    assert found == [
        ("geometry.width_m", "0.32"), ("geometry.width_m", "0.6"),
        ("content.mass_kg", "1"), ("content.mass_kg", "40"),
    ]  # fmt: skip
    for case, variant in zip(cases[4:], one.variants(), strict=True):
        assert case.fall == fallen(variant.block)
    assert cases[4].fall > cases[5].fall


def test_against_a_wall_both_signs_are_counted_and_the_restitution_is_the_walls() -> None:
    wall = statue(against_wall=True, restitution={"low": 0.2, "high": 0.5})
    cases = cases_of(wall)
    assert cases[0].runs == 2 * 2 * len(SUITE)
    assert cases[0].fall == fallen(wall.block, (0.2, 0.5), signs=2)
    ends = [case for case in cases if case.parameter == "restitution"]
    assert [case.change for case in ends] == ["0.200 alone", "0.500 alone"]
    assert [case.fall for case in ends] == [fallen(wall.block, (r,), signs=2) for r in (0.2, 0.5)]
    zero = cases_of(statue(against_wall=True, restitution={"low": 0.0, "high": 0.5}))
    assert next(case.change for case in zero if case.parameter == "restitution") == "0.000 alone"


def test_verticals_act_in_every_case() -> None:
    pairs = [BaseMotion(a, b.scaled(0.5)) for a, b in zip(SUITE, reversed(SUITE), strict=True)]
    one = statue(restitution=0.9)
    with_it, without = cases_of(one, pairs), cases_of(one)
    assert [case.runs for case in with_it] == [case.runs for case in without]
    assert [case.fall for case in with_it] != [case.fall for case in without]


def test_what_is_changed_is_the_height_of_the_mass_centre_by_a_tenth_and_the_width() -> None:
    changes = changes_of(statue())
    words = [(parameter, change) for parameter, change, _ in changes]
    assert words == [
        ("mass centre", "-10 %"),
        ("mass centre", "+10 %"),
        ("base width", "-5 %, worn edges"),
    ]
    tangents = [math.tan(block.alpha) for _, _, block in changes]
    assert tangents == pytest.approx([0.2 / 0.9, 0.2 / 1.1, 0.95 * 0.2])
    stocky = described(1.2, 0.9)  # with a lower centre no impacts
    assert [change for _, change, _ in changes_of(stocky)] == ["+10 %", "-5 %, worn edges"]
    ranged = described(0.36, 1.8, geometry={"width_m": {"low": 0.3, "high": 0.42}})
    ends = [math.tan(block.alpha) for name, _, block in changes_of(ranged) if "width_m" in name]
    assert sorted(ends) == pytest.approx([0.3 / 1.8, 0.42 / 1.8])


@every(
    ("key", "words"),
    [
        ("geometry.inertia_kg_m2", "inertia"),
        ("geometry.p_rad_s", "p"),
        ("geometry.alpha_deg", "alpha"),
        ("geometry.alpha_rad", "alpha"),
        ("content.mass_kg", "content mass"),
        ("geometry.mass_kg", "mass"),
        ("restitution", "restitution"),
    ],
)
def test_a_key_is_read_without_its_unit(key: str, words: str) -> None:
    assert parameter_words(key) == words


def test_bars_go_from_the_low_to_the_high_end_the_widest_first(cases: tuple[Case, ...]) -> None:
    base = cases[0]
    changes = [
        ("width", "-5 % alone", 0.5),
        ("width", "+5 % alone", 0.2),
        ("mass centre", "-2 %", 0.25),
        ("friction", "+10 %", 0.9),
        ("restitution", "+1 %", math.nan),
    ]
    made = [
        replace(base, parameter=parameter, change=change, share=share)
        for parameter, change, share in changes
    ]
    bars = bars_of([replace(base, share=0.3), *made])
    assert [bar[2:] for bar in bars] == [(0.3, 0.9), (0.5, 0.2), (0.25, 0.3)]
    assert bars[1].ends == "-5 % to +5 %"
    assert bars_of(()) == []
    assert bars_of(cases[:1]) == []


@every(
    ("low", "high", "words"),
    [
        (0.21, 0.428, "21 to 43 %"),
        (0.0, 0.08, "none to 8.0 %"),
        (0.42, 0.424, ""),
        (0.0, 0.0, ""),
        (0.5, 1.0, "50 to > 99 %"),
    ],
)
def test_a_bar_in_words_is_empty_where_its_ends_read_alike(
    low: float, high: float, words: str
) -> None:
    assert Bar("width", "", low, high).words == words
    assert Bar("width", "", high, low).words == words


def test_a_case_in_json_has_its_count_and_interval(cases: tuple[Case, ...]) -> None:
    values = cases[0].to_dict()
    assert set(values) == {"parameter", "change", "share", "low", "high", "fall", "runs"}
    assert values["share"] == cases[0].share
    assert replace(cases[0], share=math.nan).to_dict()["share"] is None
