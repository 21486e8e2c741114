"""Components of loss models: what is refused, and shares that come back from both files."""

import importlib
from collections.abc import Callable
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
from rocksteady.measures import Measure
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Levels, RestitutionBand
from rocksteady.risk.counted.count import counts_of
from rocksteady.risk.counted.curve import Curve
from rocksteady.risk.fragility.fragility import Fragility
from tests.every import every
from tests.show.export.test_openquake import read

load_tabular = importlib.import_module("dlml._tabular").load_tabular
CABINET = Block.rectangle(width=0.3, height=1.5)
Shares = Callable[[Any], Any]
QUIET = [  # DLML sets options that pandas 3 no longer needs
    pytest.mark.filterwarnings("ignore:.*no_silent_downcasting.*"),
    pytest.mark.filterwarnings("ignore:.*copy_on_write.*"),
]
pytestmark = QUIET


@cache
def fragility(measure: str = "pga_g", levels: Any = None, **more: Any) -> Fragility:
    return compute_fragility(
        more.pop("block", CABINET),
        make_synthetic_suite(more.pop("count", 5)),
        levels=Levels(measure, levels, beside=()),
        restitution=RestitutionBand(draws=2),
        **more,
    )


def multilinear(text: str, unit: float) -> Shares:
    """Return the curve of a `multilinear_CDF`, by the rules of pelicun 3.10."""
    x, y = (np.array(part.split(","), dtype=float) for part in text.split("|"))
    in_si = np.array([float(f"{value:g}") for value in unit * x])
    shares = np.array([float(f"{value:g}") for value in y])
    assert (shares[0], shares[-1]) == (0.0, 1.0)
    for values in (in_si, shares):
        assert (np.diff(values) > 1e-8).all()
    return lambda at: np.interp(at, x, y, left=0.0, right=1.0)


def from_pelicun(made: LossComponent, folder: Path) -> list[Shares]:
    row = load_tabular(write_pelicun(folder / "a.csv", [made])[0]).loc["RS.a"]
    unit = {"g": 9.80665, "mps": 1.0}[row["Demand", "Unit"]]
    return [multilinear(row[f"LS{k + 1}", "Theta_0"], unit) for k in range(len(made.states))]


def from_openquake(made: LossComponent, folder: Path) -> list[Shares]:
    names, functions, _ = read(write_openquake(folder / "a.xml", [made]))
    unit = 100.0 if made.intensity.name == "pgv_m_s" else 1.0

    def curve(name: str) -> Shares:
        return lambda level: functions["RS.a"](name, unit * level)

    return list(map(curve, names))


def check_read_back(counted: Fragility, folder: Path) -> None:
    """Compare both files with the counted shares: at each level, and against uplift."""
    made = LossComponent.from_fragility("RS.a", counted)
    for curves in (from_pelicun(made, folder), from_openquake(made, folder)):
        before = np.ones(400)
        for state, share in zip(made.states, curves, strict=True):
            curve, points = counted.state(state.name).curve, np.array(state.levels)
            expected = lifting = curve.lifting(curve.levels)
            first = curve.lifts_at[0]
            if state.name != "uplift":
                expected = np.minimum(curve.steps, lifting)
            else:  # the first step, in its full height
                assert share(1.0001 * first) >= curve.lifting(np.nextafter(first, 1.0)) - 1e-5
            np.testing.assert_allclose(share(curve.levels), expected, atol=3e-5)
            assert (share(points) <= curve.lifting(points) + 3e-5).all()
            assert share(0.9999 * first) == 0.0
            between = share(np.geomspace(0.5 * first, curve.levels[-1], 400))
            assert (np.diff(between) >= 0.0).all()
            assert (between <= before + 3e-5).all(), "each state holds the next"
            before = between


@every(
    ("measure", "more"),
    [
        ("pga_g", {}), ("pga_g", {"levels": (0.1, 0.2, 0.25, 0.2500001)}), ("pgv_m_s", {}),
        ("pgv_m_s", {"levels": (0.1, 0.3), "states": ("uplift", "overturned")}),
        ("sa_g", {"levels": (0.05, 0.1, 0.3), "states": ("overturned",)}),
        ("pga_g", {"block": CABINET.against_wall()}),
    ],
)  # fmt: skip
def test_both_files_give_the_counted_share_at_each_level(
    measure: str, more: dict[str, Any], tmp_path: Path
) -> None:
    check_read_back(fragility(measure, **more), tmp_path)


@st.composite
def random_counts(draw: st.DrawFn) -> Fragility:
    """Return a fragility whose states have random counts, nested, with levels at steps."""
    numbers = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    spread = draw(st.sampled_from([0.0, 1e-15, 1e-5, 1.0]))
    lifts = 0.1 * np.exp(spread * np.append(0.0, numbers.random(draw(st.integers(0, 7)))))
    near = lifts * (1.0 + draw(st.sampled_from([0.0, 1e-6, 4.5e-5, -1e-6])))
    last = draw(st.sampled_from([0.2, 0.5, 2.0]))
    levels = np.sort([*np.geomspace(0.08, last, draw(st.integers(2, 12))), 0.995 * last, *near])
    levels = levels[np.diff(levels, prepend=0.0) > 4e-5 * levels]
    reached = levels > np.repeat(lifts[:, np.newaxis, np.newaxis], 2, axis=1)
    states = []
    for each in fragility().states:
        counts = counts_of(reached, np.ones_like(reached))
        curve = Curve(levels=levels, counts=counts, lifts_at=np.sort(np.repeat(lifts, 2)))
        states.append(replace(each, curve=curve))
        reached = reached & (numbers.random(reached.shape) < draw(st.floats(0.0, 1.0)))
    return replace(fragility(), states=tuple(states))


@given(counted=random_counts())
@settings(max_examples=40, deadline=None, phases=(Phase.explicit, Phase.generate))
def test_any_counts_come_back_from_both_files(
    counted: Fragility, tmp_path_factory: pytest.TempPathFactory
) -> None:
    check_read_back(counted, tmp_path_factory.mktemp("counts"))


def test_what_no_run_reaches_is_left_out_and_the_note_has_the_runs() -> None:
    counted = fragility(levels=(0.1, 0.21), states=("uplift", 0.5, "overturned"))
    made = LossComponent.from_fragility("RS.a", counted, floor=True, description="A vase.")
    assert [state.name for state in made.states] == ["uplift"]
    assert (made.measure, made.floor) == (Measure("pga_g"), True)
    assert made.description == "A vase."
    runs = "20 runs of 5 records at 2 levels up to 0.21 g, made monotone."
    assert made.note == f"{runs} Left out: theta/alpha > 0.5, overturned, which no run reaches."
    assert "Left out" not in LossComponent.from_fragility("RS.a", fragility()).note


@every("block", [CABINET, Block.from_alphas(positive=0.25, negative=0.2, radius=0.8)])
def test_the_default_period_is_that_of_the_side_that_lifts_first(block: Block) -> None:
    counted = fragility("sa_g", (0.1, 0.3), block=block)
    side = min(block.positive, block.negative, key=lambda side: side.alpha)
    made = LossComponent.from_fragility("RS.a", counted)
    assert made.intensity.period_s == pytest.approx(2.0 * np.pi / side.p, rel=1e-12)


def test_a_lognormal_is_taken_where_it_is_near_the_counts() -> None:
    counted = fragility(levels=(0.2, 0.25, 0.5), states=("overturned",), count=12)
    made, (falls,) = LossComponent.from_fragility("RS.a", counted, lognormal=True), counted.states
    (state,) = made.states
    assert made.note.endswith("up to 0.5 g, as lognormals.")
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
        ({"name": " "}, "a text that is not empty"), ({"name": 3}, "it must be a text"),
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


@every("write", [write_pelicun, write_openquake])
def test_anything_but_components_is_refused_in_one_line(write: Any, tmp_path: Path) -> None:
    for given_ in (fragility(), [fragility()], None, 3, "falls", [LossState(name="x", **POINTS)]):
        with pytest.raises(InputError, match=r"components = .* it must be a") as caught:
            write(tmp_path / "a.csv", given_)
        assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_probability_is_0_before_the_points_and_stays_after_them() -> None:
    state = LossState(name="x", **POINTS)
    at = np.array([0.0, 0.1, 0.15, 0.3, 9.0])
    np.testing.assert_allclose(state.probability(at), [0.0, 0.0, 0.25, 0.5, 0.5])
    lognormal = LossState(name="x", median=0.2, beta=0.5)
    np.testing.assert_allclose(lognormal.probability(at), stats.lognorm(0.5, scale=0.2).cdf(at))
    for wrong in (-0.1, np.nan):
        with pytest.raises(InputError, match="intensity"):
            state.probability(wrong)


STATE = LossState(name="x", median=0.4, beta=0.5)


@every(
    ("given_", "line"),
    [
        ({"measure": "sa_g"}, "loss tools accept pga_g, pgv_m_s, sa_g:PERIOD"),
        ({"measure": "sa_avg_g:1"}, "loss tools accept"), ({"measure": 5}, "measure"),
        ({"measure": "pgd_m"}, "measure"), ({"measure": "pga_g:1"}, "pga_g has no period"),
        ({"measure": "sa_g:x"}, "its period must be a number"), ({"note": 5}, "note"),
        ({"states": ()}, "1 to 9"), ({"states": [STATE] * 2}, "names that differ"),
        ({"states": [replace(STATE, name=name) for name in ("a > 1", "a < 1")]}, "names that"),
        ({"states": [replace(STATE, name=f"state {k}") for k in range(10)]}, "1 to 9"),
        ({"states": [STATE, LossState(name="y", **POINTS)]}, "all must be lognormals"),
    ],
)  # fmt: skip
def test_a_component_that_is_none_is_refused(given_: dict[str, Any], line: str) -> None:
    with pytest.raises(InputError, match=line):
        LossComponent(**{"identifier": "A", "measure": "pga_g", "states": (STATE,), **given_})
