"""Components of loss models: what is refused, and shares that come back from both files."""

import importlib
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from scipy import stats

from rocksteady import Block, compute_fragility
from rocksteady.errors import InputError
from rocksteady.export import LossComponent, LossState, write_openquake, write_pelicun
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Levels, RestitutionBand
from rocksteady.risk.counted.count import counts_of
from rocksteady.risk.counted.curve import Curve
from rocksteady.risk.fragility.fragility import Fragility
from tests.every import every
from tests.show.export.test_openquake import read as read_nrml

load_tabular = importlib.import_module("dlml._tabular").load_tabular
CABINET = Block.rectangle(width=0.3, height=1.5)
Curves = Mapping[str, Callable[[Any], Any]]

pytestmark = [  # DLML sets options that pandas 3 no longer needs
    pytest.mark.filterwarnings("ignore:.*no_silent_downcasting.*"),
    pytest.mark.filterwarnings("ignore:.*copy_on_write.*"),
]


@cache
def fragility(measure: str = "pga_g", levels: Any = None, **more: Any) -> Fragility:
    return compute_fragility(
        more.pop("block", CABINET),
        make_synthetic_suite(more.pop("count", 5)),
        levels=Levels(measure, levels, beside=()),
        restitution=RestitutionBand(draws=2),
        **more,
    )


def multilinear(text: str, unit: float) -> Callable[[Any], Any]:
    """Return the curve of a `multilinear_CDF`, by the rules of pelicun 3.10."""
    x, y = (np.array(part.split(","), dtype=float) for part in text.split("|"))
    in_si = np.array([float(f"{value:g}") for value in unit * x])
    shares = np.array([float(f"{value:g}") for value in y])
    assert (shares[0], shares[-1]) == (0.0, 1.0)
    for values in (in_si, shares):
        assert (np.diff(values) > 1e-8).all()
    return lambda at: np.interp(at, x, y, left=0.0, right=1.0)


def from_pelicun(made: LossComponent, folder: Path) -> Curves:
    row = load_tabular(write_pelicun(folder / "a.csv", [made])[0]).loc[made.identifier]
    unit = {"g": 9.80665, "mps": 1.0}[row["Demand", "Unit"]]
    return {
        state.name: multilinear(row[f"LS{place}", "Theta_0"], unit)
        for place, state in enumerate(made.states, start=1)
    }


def from_openquake(made: LossComponent, folder: Path) -> Curves:
    _, names, functions, _ = read_nrml(write_openquake(folder / "a.xml", [made]))
    function, unit = functions[made.identifier], 100.0 if made.measure == "pgv_m_s" else 1.0

    def curve(name: str) -> Callable[[Any], Any]:
        return np.vectorize(lambda level: function(name, unit * float(level)), otypes=[float])

    return {state.name: curve(name) for state, name in zip(made.states, names, strict=True)}


def check_read_back(counted: Fragility, folder: Path) -> None:
    """Compare both files with the counted shares, at the levels and between them."""
    made = LossComponent.from_fragility("RS.a", counted)
    levels = made.states[0].levels or ()
    for curves in (from_pelicun(made, folder), from_openquake(made, folder)):
        for name, share in curves.items():
            curve = counted.state(name).curve
            expected = np.minimum(curve.steps, curve.lifting(curve.levels))
            if name == "uplift":
                expected = curve.lifting(curve.levels)
            np.testing.assert_allclose(share(curve.levels), expected, atol=1e-5)
            last = max(levels) if name == "uplift" else curve.levels[-1]
            finite = curve.lifts_at[np.isfinite(curve.lifts_at)]
            between = np.geomspace(0.5 * curve.lifts_at[0], last, 400)
            between = np.sort([*between, *finite[finite <= last], *(0.9999 * finite)])
            assert (share(between) <= curve.lifting(1.0002 * between) + 3e-6).all()
            assert share(0.9998 * curve.lifts_at[0]) == 0.0
            assert (np.diff(share(between)) >= 0.0).all()


@every(
    ("measure", "more"),
    [
        ("pga_g", {}),
        ("pga_g", {"levels": (0.1, 0.2, 0.25, 0.4)}),
        ("pgv_m_s", {}),
        ("pgv_m_s", {"levels": (0.1, 0.3), "states": ("uplift", "overturned")}),
        ("sa_g", {"levels": (0.05, 0.1, 0.3), "states": ("overturned",)}),
        ("pga_g", {"block": CABINET.against_wall()}),
    ],
)
def test_both_files_give_the_counted_share_at_each_level(
    measure: str, more: dict[str, Any], tmp_path: Path
) -> None:
    check_read_back(fragility(measure, **more), tmp_path)


@st.composite
def random_counts(draw: st.DrawFn) -> Fragility:
    """Return a fragility whose states have random counts, nested, with levels at steps."""
    numbers = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    records, ways = draw(st.integers(1, 8)), draw(st.integers(1, 3))
    lifts = 0.1 * np.exp(draw(st.sampled_from([0.0, 1e-15, 1e-5, 1.0])) * numbers.random(records))
    near = lifts[:, np.newaxis] * (1.0 + np.array(draw(st.sampled_from([[0.0], [1e-6], [-1e-6]]))))
    levels = np.geomspace(0.08, draw(st.sampled_from([0.2, 0.5, 2.0])), draw(st.integers(2, 12)))
    levels = np.sort([*levels, *near.ravel()])
    levels = levels[np.concatenate([[True], np.diff(levels) > 3e-5 * levels[1:]])]
    lifted = levels > np.repeat(lifts[:, np.newaxis, np.newaxis], ways, axis=1)
    reached, states = lifted, []
    for each in fragility().states:
        counts = counts_of(reached, np.ones_like(reached))
        curve = Curve(levels=levels, counts=counts, lifts_at=np.sort(np.repeat(lifts, ways)))
        states.append(replace(each, curve=curve))
        reached = reached & (numbers.random(reached.shape) < draw(st.floats(0.0, 1.0)))
    return replace(fragility(), states=tuple(states))


@given(counted=random_counts())
@settings(max_examples=40, deadline=None, phases=(Phase.explicit, Phase.generate))
def test_any_counts_come_back_from_both_files(
    counted: Fragility, tmp_path_factory: pytest.TempPathFactory
) -> None:
    check_read_back(counted, tmp_path_factory.mktemp("counts"))


def test_what_no_run_reaches_is_left_out_and_the_note_has_the_answer() -> None:
    counted = fragility(levels=(0.1, 0.21))
    made = LossComponent.from_fragility("RS.a", counted, floor=True, description="A vase.")
    assert [state.name for state in made.states] == ["uplift"]
    assert (made.measure, made.period_s, made.floor) == ("pga_g", None, True)
    assert made.description == "A vase."
    assert "No answer: 5 records" in made.note
    assert "Left out: theta/alpha > 0.25, " in made.note
    assert "Left out" not in LossComponent.from_fragility("RS.a", fragility()).note


@every("block", [CABINET, Block.from_alphas(positive=0.25, negative=0.2, radius=0.8)])
def test_the_default_period_is_that_of_the_side_that_lifts_first(block: Block) -> None:
    counted = fragility("sa_g", (0.1, 0.3), block=block)
    side = min(block.positive, block.negative, key=lambda side: side.alpha)
    made = LossComponent.from_fragility("RS.a", counted)
    assert made.period_s == pytest.approx(2.0 * np.pi / side.p, rel=1e-12)


def test_a_lognormal_is_taken_where_it_is_near_the_counts() -> None:
    states = ("overturned",)
    counted = fragility(levels=(0.2, 0.25, 0.5), states=states, count=12)
    (state,), (falls,) = (
        LossComponent.from_fragility("RS.a", counted, lognormal=True).states, counted.states,
    )  # fmt: skip
    assert (state.median, state.beta) == (falls.lognormal.median, falls.lognormal.beta)
    shares = state.probability(falls.curve.levels)
    assert np.abs(shares - falls.curve.shares).max() <= 0.1
    far = replace(falls, lognormal=replace(falls.lognormal, misfit=0.2))
    with pytest.raises(InputError, match="'overturned', the best lognormal is 20 points away"):
        LossComponent.from_fragility("RS.a", replace(counted, states=(far,)), lognormal=True)


@every(
    ("counted", "line"),
    [
        (lambda: fragility("scale", (1.0,)), "of 1 block over scale: a component is of one block"),
        (lambda: fragility(levels=(0.3,), block=(CABINET, CABINET)), "of 2 blocks over pga_g"),
        (lambda: fragility(levels=(0.1,), states=(0.5, "overturned")), "no run that reaches theta"),
        (lambda: fragility().states[0], "must be a Fragility"),
    ],
)
def test_a_fragility_that_is_no_component_is_refused(counted: Callable[[], Any], line: str) -> None:
    with pytest.raises(InputError, match=line):
        LossComponent.from_fragility("RS.a", counted())


@every("write", [write_pelicun, write_openquake])
def test_anything_but_components_is_refused_in_one_line(write: Any, tmp_path: Path) -> None:
    falls = LossState(name="falls", median=0.3, beta=0.5)
    for given_ in (fragility(), [fragility()], None, 3, "falls", [falls]):
        with pytest.raises(InputError, match=r"components = .* it must be a") as caught:
            write(tmp_path / "a.csv", given_)
        assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


POINTS: dict[str, Any] = {"levels": [0.1, 0.2, 0.4], "shares": [0.0, 0.5, 0.5]}


BAD_LEVELS: Any = (
    [], [0.1], [0.0, 0.1, 0.2], [0.1, 0.1, 0.2], [0.2, 0.1, 0.3], [0.1, 0.1000001, 1.0],
    [0.1, 0.2, np.inf], [0.1, np.nan, 0.3], 0.1, "abc",
)  # fmt: skip
BAD_SHARES: Any = ([], [0.1, 0.2, 0.3], [0.0, 0.5, 0.4], [0.0, 0.5, 1.1], [0.0, np.nan, 1.0])
PAIR = "a median and a beta, or levels"


@every(
    ("given_", "line"),
    [
        ({"name": " "}, "a state has a name"), ({"name": 3}, "it must be a text"),
        ({"note": 3, **POINTS}, "it must be a text"),
        ({}, PAIR), ({"median": 0.4}, PAIR), ({"median": 0.4, "beta": 0.5, **POINTS}, PAIR),
        ({"levels": [0.1, 0.2]}, PAIR), ({**POINTS, "shares": [0.0, 1.0]}, "as many shares"),
        ({"median": -1.0, "beta": 0.5}, "above 0"), ({"median": 0.4, "beta": 0.0}, "above 0"),
        *(({**POINTS, "levels": levels}, "levels") for levels in BAD_LEVELS),
        *(({**POINTS, "shares": shares}, "shares") for shares in BAD_SHARES),
    ],
)  # fmt: skip
def test_a_state_that_is_none_is_refused(given_: dict[str, Any], line: str) -> None:
    with pytest.raises(InputError, match=line):
        LossState(**{"name": "x", **given_})


def test_a_probability_is_0_before_the_points_and_stays_after_them() -> None:
    state = LossState(name="x", **POINTS)
    at = np.array([0.0, 0.1, 0.15, 0.3, 9.0])
    np.testing.assert_allclose(state.probability(at), [0.0, 0.0, 0.25, 0.5, 0.5])
    lognormal = LossState(name="x", median=0.2, beta=0.5)
    np.testing.assert_allclose(lognormal.probability(at), stats.lognorm(0.5, scale=0.2).cdf(at))
    for wrong in (-0.1, np.nan):
        with pytest.raises(InputError, match="intensity"):
            state.probability(wrong)


@every(
    ("measure", "given_", "line"),
    [
        ("sa_g", {}, "period_s"), ("pga_g", {"period_s": 1.0}, "period_s"),
        ("sa_g", {"period_s": -1.0}, "period_s"), ("pgd_m", {}, "measure"), (5, {}, "measure"),
        ("sa_g:x", {}, "its period must be a number"),
        ("sa_g:0.7", {"period_s": 1.0}, "measure"), ("pga_g", {"states": ()}, "states"),
        ("pga_g", {"note": 5}, "note"),
    ],
)  # fmt: skip
def test_a_component_that_is_none_is_refused(
    measure: Any, given_: dict[str, Any], line: str
) -> None:
    states = (LossState(name="x", median=0.4, beta=0.5),)
    with pytest.raises(InputError, match=line):
        LossComponent(**{"identifier": "A", "measure": measure, "states": states, **given_})


@every("names", [("a > 1", "a < 1"), [f"state {k}" for k in range(10)]])
def test_names_that_would_be_one_and_more_than_nine_are_refused(names: Any) -> None:
    states = tuple(LossState(name=name, median=0.4, beta=0.5) for name in names)
    with pytest.raises(InputError, match="1 to 9, of names that differ in letters and digits"):
        LossComponent(identifier="A", measure="pga_g", states=states)
