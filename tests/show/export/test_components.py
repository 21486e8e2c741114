"""Components of loss models: what is refused, and curves that come back from both files."""

import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import stats

from rocksteady import Block, compute_fragility
from rocksteady.errors import InputError
from rocksteady.export import LossComponent, LossState, write_openquake, write_pelicun
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Levels, RestitutionBand
from tests.every import every
from tests.show.export.test_openquake import read as read_nrml

load_tabular = importlib.import_module("dlml._tabular").load_tabular
GATE = 0.27


class Multilinear:
    """A `multilinear_CDF` as pelicun 3.10 takes it: its rules, its units to six digits."""

    def __init__(self, text: str, unit: float) -> None:
        ordinates, abscissae = (np.array(part.split(","), dtype=float) for part in text.split("|"))
        self.x = np.array([float(f"{value:g}") for value in unit * ordinates])
        self.y = np.array([float(f"{value:g}") for value in abscissae])
        assert (self.y[0], self.y[-1]) == (0.0, 1.0)
        for values in (self.x, self.y):
            assert (np.diff(values) > 0.0).all()
            assert not np.isclose(np.diff(values), 0.0).any()
        self.unit = unit

    def __call__(self, at: np.ndarray) -> np.ndarray:
        return np.asarray(np.interp(self.unit * at, self.x, self.y, left=0.0, right=1.0))


def as_pelicun_reads(file: Path, identifier: str, state: int) -> Any:
    row = load_tabular(file).loc[identifier]
    unit = {"g": 9.80665, "mps": 1.0}[row["Demand", "Unit"]]
    family, first = row[f"LS{state}", "Family"], row[f"LS{state}", "Theta_0"]
    if family == "multilinear_CDF":
        return Multilinear(first, unit)
    assert family == "lognormal"
    return stats.lognorm(float(row[f"LS{state}", "Theta_1"]), scale=float(first)).cdf


def gated(level: Any) -> Any:
    """Return a lognormal of twice the limit, above it alone."""
    shares = stats.norm.cdf(np.log(np.maximum(level, 1e-300) / (2.0 * GATE)) / 0.6)
    return np.where(level > GATE, shares, 0.0)


@every(
    ("measure", "no_damage", "state"),
    [
        ("pga_g", None, {"median": 0.6, "beta": 0.4}),
        ("pga_g", GATE, {"median": 0.6, "beta": 0.9}),
        ("pgv_m_s", None, {"curve": lambda level: level**3 / (0.1 + level**3)}),
        ("pga_g", None, {"curve": gated}),
    ],
)
@pytest.mark.filterwarnings("ignore:.*no_silent_downcasting.*", "ignore:.*copy_on_write.*")
def test_every_curve_comes_back_from_both_files_as_their_readers_take_it(
    measure: str, no_damage: float | None, state: dict[str, Any], tmp_path: Path
) -> None:
    """Within .01 of the curve, 0 below its limit."""
    falls = LossState(name="overturned", **state)
    made = LossComponent(
        identifier="RS.cabinet", measure=measure, states=(falls,), no_damage=no_damage
    )
    theirs = as_pelicun_reads(write_pelicun(tmp_path / "a.csv", [made])[0], "RS.cabinet", 1)
    function = read_nrml(write_openquake(tmp_path / "a.xml", [made]))[2]["RS.cabinet"]
    unit = 100.0 if measure == "pgv_m_s" else 1.0
    at = np.array([0.3, 0.999, 1.01, 1.5, 2.0, 4.0]) * GATE
    expected = falls.probability(at) * (no_damage is None or at > no_damage)
    np.testing.assert_allclose(theirs(at), expected, atol=0.01)
    quake = [function("overturned", unit * level) for level in at.tolist()]
    np.testing.assert_allclose(quake, expected, atol=0.01)


@every("write", [write_pelicun, write_openquake])
def test_counted_shares_are_refused_in_one_line(write: Any, tmp_path: Path) -> None:
    fragility = compute_fragility(
        Block.rectangle(width=0.3, height=1.5),
        make_synthetic_suite(2),
        levels=Levels("pga_g", [0.1, 0.3], beside=()),
        restitution=RestitutionBand(draws=1),
    )
    for given in (fragility, [fragility], fragility.states):
        with pytest.raises(InputError, match="components are counted shares: files") as caught:
            write(tmp_path / "a.csv", given)
        assert "\n" not in str(caught.value)
    for other in (None, 3, "falls", [LossState(name="falls", median=0.3, beta=0.5)]):
        with pytest.raises(InputError, match="it must be a list of components"):
            write(tmp_path / "a.csv", other)
    assert list(tmp_path.iterdir()) == []


@every(
    ("given", "line"),
    [
        ({"name": " "}, "a state has a name"),
        ({"name": 3}, "it must be a text"),
        ({"name": "x", "median": 0.4}, "a median and a beta, or a curve"),
        ({"name": "x"}, "a median and a beta, or a curve"),
        ({"name": "x", "median": 0.4, "beta": 0.5, "curve": np.sqrt}, "a median and a beta, or"),
        ({"name": "x", "median": -1.0, "beta": 0.5}, "above 0"),
        ({"name": "x", "median": 0.4, "beta": 0.0}, "above 0"),
    ],
)
def test_a_state_that_is_none_is_refused(given: dict[str, Any], line: str) -> None:
    with pytest.raises(InputError, match=line):
        LossState(**given)


@every(
    ("given", "line"),
    [
        ({"measure": "sa_g"}, "period_s"),
        ({"measure": "pga_g", "period_s": 1.0}, "period_s"),
        ({"measure": "pgd_m"}, "measure"),
        ({"measure": 5}, "measure"),
        ({"measure": "sa_g:x"}, "its period must be a number"),
        ({"measure": "sa_g:0.7", "period_s": 1.0}, "measure"),
        ({"measure": "pga_g", "no_damage": -0.1}, "no_damage"),
        ({"measure": "pga_g", "states": ()}, "states"),
    ],
)
def test_a_component_that_is_none_is_refused(given: dict[str, Any], line: str) -> None:
    states = (LossState(name="x", median=0.4, beta=0.5),)
    with pytest.raises(InputError, match=line):
        LossComponent(**{"identifier": "A", "states": states, **given})


def test_a_measure_as_text_has_its_period() -> None:
    states = (LossState(name="x", median=0.4, beta=0.5),)
    component = LossComponent(identifier="A", measure="sa_g:0.7", states=states)
    assert (component.measure, component.period_s) == ("sa_g", 0.7)


def test_two_names_that_would_be_one_in_a_file_are_refused() -> None:
    states = tuple(LossState(name=name, median=0.4, beta=0.5) for name in ("a > 1", "a < 1"))
    with pytest.raises(InputError, match="differ in letters and digits"):
        LossComponent(identifier="A", measure="pga_g", states=states)
