"""Facades: what is taken, and the one line for everything that is not."""

import math
from dataclasses import replace
from typing import Any

import pytest

from rocksteady.errors import RocksteadyError
from rocksteady.facades.checks.actions import Load, PushingMass, Thrust, Tie
from rocksteady.facades.checks.facade import Facade
from tests.every import every

SIZES: dict[str, Any] = {"name": "front", "thickness_m": 0.5, "height_m": 6.0}
LOAD: dict[str, Any] = {"name": "roof", "weight_kn": 5.0, "x_m": 0.2, "z_m": 3.0}
FORCE: dict[str, Any] = {"name": "rods", "force_kn": 5.0, "z_m": 3.0}


def test_weights_are_those_of_rectangle_and_triangle() -> None:
    assert Facade(**SIZES, length_m=4.0).weight_kn == pytest.approx(18.0 * 0.5 * 6.0 * 4.0)
    gable = Facade(**SIZES, kind="gable", length_m=4.0, unit_weight_kn_m3=20.0)
    assert gable.weight_kn == pytest.approx(0.5 * 20.0 * 0.5 * 6.0 * 4.0)


def test_defaults_follow_the_kind_and_a_facade_can_be_replaced() -> None:
    facade = Facade(**SIZES)
    assert facade.one_sided is True
    assert facade.knowledge_level == "LC1"
    assert Facade(**SIZES, kind="parapet").one_sided is False
    other = replace(facade, confidence_factor=1.2, thickness_m=0.6)
    assert other.knowledge_level == "LC2"
    assert other.mechanism.a0_g > facade.mechanism.a0_g
    assert replace(facade, confidence_factor=1.1).knowledge_level is None
    assert facade == Facade(**SIZES)


def test_a_hinge_further_inside_weakens_in_proportion_to_the_arm() -> None:
    whole, crushed = (Facade(**SIZES, hinge_inset_m=inset).mechanism for inset in (0.0, 0.1))
    assert crushed.alpha0 == pytest.approx(whole.alpha0 * (0.25 - 0.1) / 0.25, rel=1e-12)


def test_what_is_missing_of_a_facade_that_falls_by_itself_holds_it() -> None:
    """By hand: weights hold 54 x 0.25 = 13.5, a thrust of 5 kN at 3 m pushes 15 kN m."""
    with pytest.raises(RocksteadyError, match=r"falls by itself: weights and ties hold 13\.5 kN m"):
        Facade(**SIZES, thrusts=(Thrust(**FORCE),))
    held = Facade(  # the line names 0.25 kN at 6 m
        **SIZES,
        thrusts=(Thrust(**FORCE),),
        ties=(Tie(name="tie", force_kn=0.26, z_m=6.0, until_collapse=True),),
    )
    assert 0.0 < held.mechanism.alpha0 < 0.001


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"thickness_m": 300}, "thickness_m = 300 is not valid: it must lie in [0.05, 5]; size"),
    ({"thickness_m": 300}, "write 0.3 for 300 mm"),
    ({"height_m": 3000.0}, "sizes are in metres"),
    ({"unit_weight_kn_m3": 1800}, "it must lie in [8, 30]; give it in kN/m^3, as 18: 1800 kg/m^3"),
    ({"confidence_factor": 0.9}, "it must lie in [1, 2]; give 1.35, 1.2 or 1.0, for LC1, LC2"),
    ({"confidence_factor": "LC2"}, "confidence_factor = 'LC2' is not valid"),
    ({"length_m": float("nan")}, "length_m = nan is not valid"),
    ({"height_m": True}, "height_m = True is not valid"),
    ({"name": " "}, "name = ' ' is not valid: it must be a text"),
    ({"name": 3}, "name = 3 is not valid"),
    ({"kind": "tower"}, "it must be one of wall, parapet, pinnacle, gable"),
    ({"hinge_inset_m": 0.5}, "the hinge lies inside the wall, below thickness_m = 0.5"),
    ({"hinge_inset_m": -0.1}, "hinge_inset_m = -0.1 is not valid"),
    ({"hinge_inset_m": 0.25}, "front falls by itself"),
    ({"restitution": 1.2}, "restitution = 1.2 is not valid: it must lie in [0, 1]"),
    ({"restitution": "wall"}, 'it must be a number in (0, 1], "housner"'),
    ({"kind": "parapet", "restitution": 0.0}, "it must lie in (0, 1]"),
    ({"ties": (Tie(**{**FORCE, "z_m": 60.0}),)}, "z_m of rods = 60.0 is not valid: it is at most"),
    ({"loads": (Load(**{**LOAD, "z_m": 13.0}),)}, "it is at most twice height_m = 6"),
    ({"kind": "parapet", "loads": (Load(**LOAD),)}, "loads do not go with a parapet that rocks"),
    ({"one_sided": False, "loads": (Load(**LOAD),)}, "leave loads out, or set one_sided = true"),
    ({"one_sided": False, "ties": (Tie(**FORCE),)}, "ties do not go with a wall that rocks to bo"),
    ({"loads": (Load(**{**LOAD, "x_m": -4.0, "weight_kn": 50.0}),)}, "add ties of more than"),
]  # fmt: skip


@every(("keys", "line"), WRONG)
def test_what_is_wrong_is_named_in_one_line(keys: dict[str, Any], line: str) -> None:
    with pytest.raises(RocksteadyError) as refusal:
        Facade(**{**SIZES, **keys})
    assert line in str(refusal.value)
    assert "\n" not in str(refusal.value)


@every(
    ("kind", "keys", "line"),
    [
        (Load, {**LOAD, "weight_kn": 0.0}, "weight_kn of load roof = 0.0 is not valid"),
        (Load, {**LOAD, "x_m": 200}, "x_m of load roof = 200 is not valid"),
        (PushingMass, {"name": "v", "weight_kn": 1.0, "z_m": -1.0}, "z_m of mass v = -1.0 is not"),
        (Tie, {**FORCE, "force_kn": float("inf")}, "force_kn of tie rods = inf is not valid"),
        (Thrust, {**FORCE, "force_kn": -2.0}, "force_kn of thrust rods = -2.0 is not valid"),
    ],
)
def test_what_acts_is_checked_by_itself(kind: Any, keys: dict[str, Any], line: str) -> None:
    with pytest.raises(RocksteadyError) as refusal:
        kind(**keys)
    assert line in str(refusal.value)


def test_a_parapet_against_something_takes_loads() -> None:
    statue = Load(name="statue", weight_kn=3.0, x_m=0.25, z_m=7.0)
    facade = Facade(**SIZES, kind="parapet", one_sided=True, loads=(statue,))
    assert facade.mechanism.one_sided
    assert (
        Facade(
            **SIZES,
            kind="parapet",
            masses=(PushingMass(name="rail", weight_kn=1.0, z_m=6.0),),
        ).mechanism.base_factor
        > 1.35
    )


@every("name", ["\0", "a\x1b[2J", "a\u202eb", "a\u2028b", "a\rb", "a\tb"])
def test_a_name_has_no_characters_that_do_not_print(name: str) -> None:
    with pytest.raises(RocksteadyError, match="printable"):
        Facade(name=name, thickness_m=0.5, height_m=6.0)
    with pytest.raises(RocksteadyError, match="printable"):
        Tie(name=name, force_kn=1.0, z_m=1.0)


def test_a_tie_in_newtons_is_refused() -> None:
    # 54 kN at 3 m make 162 kN m: 4 kN at 2.8 m leave it rocking, 4000 kN do not.
    assert (
        Facade(**SIZES, ties=(Tie(name="rods", z_m=2.8, force_kn=4.0),)).mechanism.theta0_rad
        < math.pi / 4
    )
    with pytest.raises(RocksteadyError, match=r"force_kn of the ties.*162 kN m.*in kN"):
        Facade(**SIZES, ties=(Tie(name="rods", z_m=2.8, force_kn=4000.0),))


def test_a_load_in_newtons_or_centimetres_is_refused() -> None:
    # On 0.5 m x 1 m, 5000 kN and 54 kN make 10.1 MPa.
    with pytest.raises(RocksteadyError, match=r"weight_kn of roof.*10\.1 MPa"):
        Facade(**SIZES, loads=(Load(name="roof", weight_kn=5000.0, x_m=0.2, z_m=3.0),))
    with pytest.raises(RocksteadyError, match=r"x_m of roof.*twice thickness_m = 0\.5"):
        Facade(**SIZES, loads=(Load(name="roof", weight_kn=5.0, x_m=5.0, z_m=3.0),))


def test_numbers_reach_the_ends_of_their_ranges_and_no_further() -> None:
    """Sizes in metres, weights in kN; an end that does not belong to its range is refused."""
    held = {**SIZES, "thickness_m": 5.0}
    things: dict[str, Any] = {
        "facade": (lambda **given: Facade(**{**held, **given})),
        "load": (lambda **given: Load(**{**LOAD, **given})),
        "tie": (lambda **given: Tie(**{**FORCE, **given})),
        "thrust": (lambda **given: Thrust(**{**FORCE, **given})),
        "mass": (
            lambda **given: PushingMass(**{"name": "m", "weight_kn": 1.0, "z_m": 3.0, **given})
        ),
    }
    wrong = []
    for thing, key, low, high, ends in (
        ("facade", "thickness_m", 0.05, 5.0, "[]"),
        ("facade", "height_m", 0.1, 50.0, "[]"),
        ("facade", "length_m", 0.1, 200.0, "[]"),
        ("facade", "unit_weight_kn_m3", 8.0, 30.0, "[]"),
        ("facade", "confidence_factor", 1.0, 2.0, "[]"),
        ("facade", "base_height_m", 0.0, 300.0, "[]"),
        ("facade", "elastic_modulus_mpa", 10.0, 1e5, "[]"),
        ("facade", "elastic_period_s", 0.001, 10.0, "[]"),
        *(("load", "weight_kn", 0.0, 1e6, "(]"), ("mass", "weight_kn", 0.0, 1e6, "(]")),
        *(("tie", "force_kn", 0.0, 1e6, "(]"), ("thrust", "force_kn", 0.0, 1e6, "(]")),
        ("load", "x_m", -5.0, 10.0, "[]"),
        *((each, "z_m", 0.0, 100.0, "(]") for each in ("load", "tie", "thrust", "mass")),
        *((each, "lost_at_m", 0.0, 10.0, "(]") for each in ("load", "tie", "thrust")),
    ):
        step = 1e-6 * (high - low)
        for value, taken in (
            *((low - step, False), (low, ends[0] == "["), (low + step, True)),
            *((high - step, True), (high, ends[1] == "]"), (high + step, False)),
        ):
            try:
                things[thing](**{key: value})
                result = True
            except RocksteadyError:
                result = False
            if result != taken:
                wrong.append((thing, key, value))
    assert wrong == []
