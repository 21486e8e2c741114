"""NRML 0.5: read back by a parser of the tests, lognormals from arithmetic moments."""

import math
from dataclasses import replace
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
    "E.20.22.106a": (0.251, 28.4420, 15.1579),
    "E.20.22.112a": (1.229, 139.2639, 74.2194),
}
"""Median [m/s], and mean and standard deviation [cm/s], of unanchored cabinets."""


class Function(NamedTuple):
    """A fragility function as OpenQuake evaluates it."""

    imls: ET.Element
    curves: dict[str, ET.Element]

    @property
    def limit(self) -> float:
        return float(self.imls.attrib["noDamageLimit"])

    def __call__(self, state: str, level: Any) -> Any:
        """Return the probability as the engine's source has it: clipped, 0 up to the limit."""
        if self.curves[state].tag == f"{N}poes":
            texts = (self.imls.text or "").split(), (self.curves[state].text or "").split()
            levels, poes = np.array(texts, dtype=float)
            return np.interp(level, np.append(self.limit, levels), np.append(0.0, poes))
        mean, deviation = moments(self.curves[state])
        low, high = (float(self.imls.attrib[key]) for key in ("minIML", "maxIML"))
        clipped = np.clip(level, low, high)
        sigma = math.sqrt(math.log(1.0 + (deviation / mean) ** 2))
        share = stats.lognorm.cdf(clipped, sigma, scale=mean**2 / math.hypot(deviation, mean))
        return np.where(clipped <= self.limit, 0.0, share)


def moments(curve: ET.Element) -> tuple[float, float]:
    return float(curve.attrib["mean"]), float(curve.attrib["stddev"])


def read(file: Path) -> tuple[list[str], dict[str, Function], str]:
    """Return the states, the functions and the description of a model."""
    (model,) = ET.parse(file).getroot()
    description, limits, *functions = model
    states, found = (limits.text or "").split(), {}
    for function in functions:
        curves = {each.attrib["ls"]: each for each in function[1:]}
        assert list(curves) == states, "in the order of the limit states"
        found[function.attrib["id"]] = Function(function[0], curves)
    return states, found, description.text or ""


def falls(median: float = 0.3, beta: float = 0.5) -> LossState:
    return LossState(name="overturned", median=median, beta=beta)


def component(*states: LossState, **more: Any) -> LossComponent:
    given: dict[str, Any] = {"identifier": "RS.vase", "measure": "pga_g"}
    return LossComponent(**{**given, "states": states or (falls(),), **more})


def test_the_cabinets_of_p58_have_the_published_moments(tmp_path: Path) -> None:
    made = [
        component(falls(median), identifier=name, measure="pgv_m_s", floor=True)
        for name, (median, _, _) in P58.items()
    ]
    states, found, _ = read(write_openquake(tmp_path / "a.xml", made))
    assert (states, list(found)) == (["overturned"], list(P58))
    for name, (_, mean, deviation) in P58.items():
        assert found[name].imls.get("imt") == "PGV"
        published = pytest.approx((mean, deviation), abs=5.1e-5)
        assert moments(found[name].curves["overturned"]) == published


@every(("median", "beta"), [(1e-3, 0.01), (0.3, 0.5), (1e3, 2.0)])
def test_lognormals_come_back_but_for_a_millionth(
    median: float, beta: float, tmp_path: Path
) -> None:
    file = write_openquake(tmp_path / "a.xml", [component(falls(median, beta))])
    function = read(file)[1]["RS.vase"]
    levels = median * np.exp(beta * np.array([-4.0, -1.0, 0.0, 2.0, 9.0]))
    expected = stats.lognorm(beta, scale=median).cdf(levels)
    np.testing.assert_allclose(function("overturned", levels), expected, rtol=1e-9, atol=1.1e-6)
    assert function("overturned", 0.99 * function.limit) == 0.0
    assert 0.0 < function("overturned", 1.0001 * function.limit) < 1.1e-6


def test_points_are_at_the_levels_of_all_states(tmp_path: Path) -> None:
    """The first level is the limit, and velocities are in cm/s."""
    uplift = LossState(name="uplift", levels=[0.2, 0.4], shares=[0.0, 0.75])
    tilts = LossState(name="tilts", levels=[0.3, 0.6, 0.8], shares=[0.0, 0.5, 0.5])
    made = component(uplift, tilts, measure="pgv_m_s")
    function = read(write_openquake(tmp_path / "a.xml", [made]))[1]["RS.vase"]
    assert function.limit == 20.0
    assert function.imls.text == "30.0 40.0 60.0 80.0"
    levels = [19.9, 30.0, 40.0, 60.0, 80.0, 1e9]
    for state, expected in (("uplift", [0.375, 0.75, 0.75, 0.75]), ("tilts", [0, 1 / 6, 0.5, 0.5])):
        np.testing.assert_allclose(function(state, levels), [0.0, *expected, expected[-1]])


def test_states_are_named_in_order_and_alike(tmp_path: Path) -> None:
    names = ("uplift", "theta/alpha > 0.25", "theta/alpha > 0.5", "theta/alpha > 1", "overturned")
    states = [replace(falls(), name=name) for name in names]
    made = [component(*states), component(*states, identifier="RS.b", measure="sa_g:0.75")]
    found, functions, _ = read(write_openquake(tmp_path / "a.xml", made))
    tilts = ["theta_alpha_0p25", "theta_alpha_0p5", "theta_alpha_1"]
    assert found == ["uplift", *tilts, "overturned"]
    assert functions["RS.b"].imls.get("imt") == "SA(0.75)"
    with pytest.raises(InputError, match=r"RS.c has the states overturned.*same states"):
        write_openquake(tmp_path / "b.xml", [*made, component(identifier="RS.c")])


@given(text=st.text(max_size=60))
@example(text="<!-- ]]> & \" ' <x/>\x00\x1b[31m\ud800 =1+1")
@settings(max_examples=40, deadline=None, phases=QUICK)
def test_any_text_from_outside_is_well_formed_xml(
    text: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.mktemp("text") / "a.xml"
    states, found, description = read(write_openquake(file, [component(note=f"[{text}]")]))
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
