"""NRML 0.5: read back by a parser of the tests, lognormals from arithmetic moments."""

import math
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st
from scipy import stats

from rocksteady.errors import InputError
from rocksteady.export import LossComponent, LossState, write_openquake
from tests.every import every

QUICK = (Phase.explicit, Phase.generate)
"""A failure is not made smaller: each example writes files to the disk."""
N = "{http://openquake.org/xmlns/nrml/0.5}"
P58 = {
    "E.20.22.102a": (0.724, 82.0399, 43.7224),
    "E.20.22.103a": (0.493, 55.8642, 29.7723),
    "E.20.22.104a": (0.361, 40.9067, 21.8008),
    "E.20.22.105a": (0.290, 32.8613, 17.5131),
    "E.20.22.106a": (0.251, 28.4420, 15.1579),
    "E.20.22.112a": (1.229, 139.2639, 74.2194),
    "E.20.22.114a": (0.498, 56.4308, 30.0742),
    "E.20.22.124a": (0.688, 77.9606, 41.5484),
    "E.20.22.125a": (0.526, 59.6036, 31.7652),
}
"""Median [m/s], and mean and standard deviation [cm/s], of the unanchored cabinets."""


class Function(NamedTuple):
    """A fragility function as OpenQuake evaluates it."""

    imt: str
    limit: float
    shown: tuple[float, float]
    moments: dict[str, tuple[float, float]]
    points: dict[str, tuple[np.ndarray, np.ndarray]]

    def __call__(self, state: str, level: float) -> float:
        """Return the probability as the engine's source has it: clipped, 0 up to the limit."""
        if self.points:
            levels, poes = self.points[state]
            at = np.concatenate([[self.limit], levels])
            return float(np.interp(min(level, levels[-1]), at, np.concatenate([[0.0], poes])))
        mean, deviation = self.moments[state]
        clipped = min(max(level, self.shown[0]), self.shown[1])
        if clipped <= self.limit:
            return 0.0
        sigma = math.sqrt(math.log(1.0 + (deviation / mean) ** 2))
        scale = mean**2 / math.sqrt(deviation**2 + mean**2)
        return float(stats.lognorm.cdf(clipped, sigma, scale=scale))


def read(file: Path) -> tuple[dict[str, str], list[str], dict[str, Function], str]:
    """Return the model's attributes, its states, functions and description."""
    root = ET.parse(file).getroot()
    assert root.tag == f"{N}nrml"
    (model,) = root
    assert model.tag == f"{N}fragilityModel"
    description, limits, *functions = model
    states = (limits.text or "").split()
    found = {}
    for each in functions:
        imls, *rest = each
        assert [part.get("ls") for part in rest] == states, "in the order of the limit states"
        shown, moments, points = (math.nan, math.nan), {}, {}
        if each.get("format") == "continuous":
            assert each.get("shape") == "logncdf"
            shown = float(imls.get("minIML", "")), float(imls.get("maxIML", ""))
            moments = {
                part.get("ls", ""): (float(part.get("mean", "")), float(part.get("stddev", "")))
                for part in rest
            }
        else:
            levels = np.array((imls.text or "").split(), dtype=float)
            points = {
                part.get("ls", ""): (levels, np.array((part.text or "").split(), dtype=float))
                for part in rest
            }
        limit = float(imls.get("noDamageLimit", ""))
        found[each.get("id", "")] = Function(imls.get("imt", ""), limit, shown, moments, points)
    return model.attrib, states, found, description.text or ""


def falls(median: float = 0.3, beta: float = 0.5, **more: Any) -> LossState:
    return LossState(name="overturned", median=median, beta=beta, **more)


def component(*states: LossState, **more: Any) -> LossComponent:
    given: dict[str, Any] = {"identifier": "RS.vase", "measure": "pga_g"}
    return LossComponent(**{**given, "states": states or (falls(),), **more})


def test_the_cabinets_of_p58_have_the_published_moments(tmp_path: Path) -> None:
    made = [
        component(falls(median), identifier=name, measure="pgv_m_s", floor=True)
        for name, (median, _, _) in P58.items()
    ]
    _, states, found, _ = read(write_openquake(tmp_path / "a.xml", made))
    assert (states, list(found)) == (["overturned"], list(P58))
    for name, (median, mean, deviation) in P58.items():
        function = found[name]
        assert function.imt == "PGV"
        assert function.moments["overturned"] == pytest.approx((mean, deviation), abs=5.1e-5)
        assert function("overturned", 100.0 * median) == pytest.approx(0.5, abs=1e-12)


@given(median=st.floats(1e-3, 1e3), beta=st.floats(0.01, 2.0))
@settings(max_examples=25, deadline=None, phases=QUICK)
def test_median_and_beta_come_back(
    median: float, beta: float, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.mktemp("nrml") / "a.xml"
    write_openquake(file, [component(falls(median, beta))])
    mean, deviation = read(file)[2]["RS.vase"].moments["overturned"]
    assert math.sqrt(math.log1p((deviation / mean) ** 2)) == pytest.approx(beta, rel=1e-10)
    assert mean**2 / math.hypot(mean, deviation) == pytest.approx(median, rel=1e-10)


def test_what_is_cut_off_is_a_millionth(tmp_path: Path) -> None:
    function = read(write_openquake(tmp_path / "a.xml", [component()]))[2]["RS.vase"]
    assert function("overturned", 0.99 * function.limit) == 0.0
    assert function("overturned", 1.01 * function.limit) < 2e-6
    assert 1.0 > function("overturned", 1e9) > 1.0 - 2e-6


def test_points_are_at_the_levels_of_all_states(tmp_path: Path) -> None:
    """The first level is the limit, velocities are in cm/s, and a lognormal is sampled."""
    uplift = LossState(name="uplift", levels=[0.2, 0.4], shares=[0.0, 0.75])
    tilts = LossState(name="tilts", levels=[0.3, 0.6, 0.8], shares=[0.0, 0.5, 0.5])
    made = component(uplift, tilts, measure="pgv_m_s")
    function = read(write_openquake(tmp_path / "a.xml", [made]))[2]["RS.vase"]
    assert function.limit == 20.0
    for state, expected in (("uplift", [0.375, 0.75, 0.75, 0.75]), ("tilts", [0, 1 / 6, 0.5, 0.5])):
        levels, poes = function.points[state]
        np.testing.assert_allclose(levels, [30.0, 40.0, 60.0, 80.0])
        np.testing.assert_allclose(poes, expected, atol=1e-12)
        assert (function(state, 19.9), function(state, 1e9)) == (0.0, expected[-1])
    mixed = component(uplift, falls(0.5, 0.4))
    function = read(write_openquake(tmp_path / "b.xml", [mixed]))[2]["RS.vase"]
    for level in np.geomspace(0.05, 5.0, 300):
        share = function("overturned", level)
        assert share == pytest.approx(stats.norm.cdf(np.log(level / 0.5) / 0.4), abs=2e-4)


def test_states_are_named_in_order_and_alike(tmp_path: Path) -> None:
    names = ("uplift", "theta/alpha > 0.25", "theta/alpha > 0.5", "theta/alpha > 1", "overturned")
    states = [LossState(name=name, median=0.2 + 0.1 * k, beta=0.4) for k, name in enumerate(names)]
    made = [
        component(*states),
        component(*states, identifier="RS.b", measure="sa_g", period_s=0.75),
    ]
    _, found, functions, _ = read(write_openquake(tmp_path / "a.xml", made))
    assert found == [
        "uplift", "theta_alpha_0p25", "theta_alpha_0p5", "theta_alpha_1", "overturned",
    ]  # fmt: skip
    assert functions["RS.b"].imt == "SA(0.75)"
    with pytest.raises(InputError, match=r"RS.c has the states overturned.*same states"):
        write_openquake(tmp_path / "b.xml", [*made, component(identifier="RS.c")])


@given(text=st.text(max_size=60))
@example(text="<!-- ]]> & \" ' <x/>\x00\x1b[31m\ud800 =1+1")
@settings(max_examples=40, deadline=None, phases=QUICK)
def test_any_text_from_outside_is_well_formed_xml(
    text: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.mktemp("text") / "a.xml"
    _, states, found, description = read(write_openquake(file, [component(note=f"[{text}]")]))
    assert (states, list(found)) == (["overturned"], ["RS.vase"])
    before, inside = text.replace("\r\n", "\n"), description.partition("[")[2].rpartition("]")[0]
    assert len(inside) == len(before)
    pairs = zip(before, inside, strict=True)
    assert all(was == now for was, now in pairs if was.isprintable() or was in "\t\n")


@every(("name", "value"), [("model_id", "a b"), ("model_id", ""), ("loss_category", "vases")])
def test_what_is_wrong_is_named(name: str, value: Any, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=f"{name} = '{value}'"):
        write_openquake(tmp_path / "a.xml", [component()], **{name: value})
    assert list(tmp_path.iterdir()) == []
