"""NRML 0.5: read back by a parser of the tests, lognormals from arithmetic moments."""

import math
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from scipy import stats

from rocksteady.errors import InputError, OutputError
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
    attributes, states, found, _ = read(write_openquake(tmp_path / "a.xml", made))
    assert attributes == {
        "id": "rocksteady",
        "assetCategory": "buildings",
        "lossCategory": "contents",
    }
    assert states == ["overturned"]
    assert list(found) == list(P58)
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


def test_below_the_uplift_limit_there_is_no_damage(tmp_path: Path) -> None:
    file = write_openquake(tmp_path / "a.xml", [component(no_damage=0.18)])
    function = read(file)[2]["RS.vase"]
    assert [function("overturned", level) for level in (0.001, 0.1, 0.18)] == [0.0, 0.0, 0.0]
    assert function("overturned", 0.181) == pytest.approx(
        stats.norm.cdf(math.log(0.181 / 0.3) / 0.5)
    )
    assert function.shown[0] < function.limit, "or the engine would raise small levels above it"


def test_what_is_cut_off_is_a_millionth(tmp_path: Path) -> None:
    function = read(write_openquake(tmp_path / "a.xml", [component()]))[2]["RS.vase"]
    assert function("overturned", 0.99 * function.limit) == 0.0
    assert function("overturned", 1.01 * function.limit) < 2e-6
    assert 1.0 > function("overturned", 1e9) > 1.0 - 2e-6


def test_points_hold_any_curve(tmp_path: Path) -> None:
    def product(level: Any) -> Any:
        level = np.maximum(level, 1e-300)
        return stats.norm.cdf(np.log(level / 0.2) / 0.1) * stats.norm.cdf(np.log(level / 0.4) / 0.5)

    made = component(LossState(name="overturned", curve=product), measure="pgv_m_s")
    file = write_openquake(tmp_path / "a.xml", [made])
    function = read(file)[2]["RS.vase"]
    levels, poes = function.points["overturned"]
    np.testing.assert_allclose(poes, product(levels / 100.0), rtol=1e-12)
    assert (np.diff(levels) > 0.0).all()
    assert 0.0 < function.limit < levels[0]
    assert poes[0] < 2e-6
    assert poes[-1] > 1.0 - 2e-5
    for level in np.geomspace(10.0, 200.0, 300):
        assert function("overturned", level) == pytest.approx(product(level / 100.0), abs=1e-3)


def test_a_step_is_points_and_what_does_not_rise_from_0_to_1_is_refused(tmp_path: Path) -> None:
    step = LossState(name="uplift", curve=lambda level: (level > 0.3) * 1.0)
    function = read(write_openquake(tmp_path / "a.xml", [component(step)]))[2]["RS.vase"]
    assert [function("uplift", level) for level in (0.2, 0.2998, 0.3002, 0.5)] == [0, 0, 1, 1]
    curves = {
        "does not go from 0 to 1": lambda level: 0.0 * level,
        "falls with the intensity": lambda level: np.exp(-level),
        "no probability at some": lambda level: np.where(level > 1.0, np.nan, 0.0),
    }
    for words, curve in curves.items():
        made = component(step, LossState(name="overturned", curve=curve))
        with pytest.raises(InputError, match=words):
            write_openquake(tmp_path / "b.xml", [made])
        assert not (tmp_path / "b.xml").exists()


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


def test_curves_that_cross_are_remarked_on(tmp_path: Path) -> None:
    crossing = [LossState(name="uplift", median=0.5, beta=0.2), falls(0.6, 0.8)]
    *_, description = read(write_openquake(tmp_path / "a.xml", [component(*crossing)]))
    assert "The curve of 'overturned' is up to" in description
    apart = [LossState(name="uplift", median=0.2, beta=0.5), falls(0.6, 0.5)]
    *_, description = read(write_openquake(tmp_path / "a.xml", [component(*apart)]))
    assert "forced apart" not in description


@given(text=st.text(max_size=60))
@settings(max_examples=40, deadline=None, phases=QUICK)
def test_any_text_from_outside_is_well_formed_xml(
    text: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.mktemp("text") / "a.xml"
    *_, description = read(write_openquake(file, [component(description=f"[{text}]")]))
    file.read_bytes().decode("utf-8")
    inside = description[description.index("[") + 1 : description.rindex("]")]
    assert len(inside) == len(text.replace("\r\n", "\n"))
    allowed = [
        (was, now)
        for was, now in zip(text.replace("\r\n", "\n"), inside, strict=True)
        if was.isprintable() or was in "\t\n"
    ]
    assert all(was == now for was, now in allowed)


@every("text", ["<!-- ]]> & \" ' <x/>", "\x00\x1b[31m\ud800", "波 عربي 🏺", "=1+1"])
def test_hostile_text_stays_text(text: str, tmp_path: Path) -> None:
    made = component(falls(note=text), description=text)
    _, states, found, description = read(write_openquake(tmp_path / "a.xml", [made]))
    assert (states, list(found)) == (["overturned"], ["RS.vase"])
    assert description.count(text[-3:].replace("\ud800", "\N{REPLACEMENT CHARACTER}")) == 2


def test_the_same_bytes_twice(tmp_path: Path) -> None:
    files = [write_openquake(tmp_path / name, [component()]) for name in ("a.xml", "b.xml")]
    assert files[0].read_bytes() == files[1].read_bytes()


@every(
    ("given_", "line"),
    [
        ({"model_id": "a b"}, "model_id = 'a b' is not valid"),
        ({"model_id": ""}, "model_id = ''"),
        ({"loss_category": "vases"}, "loss_category = 'vases'"),
    ],
)
def test_what_is_wrong_is_named(given_: dict[str, Any], line: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        write_openquake(tmp_path / "a.xml", [component()], **given_)
    assert str(caught.value).startswith(line)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_is_not_replaced(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="it is a folder"):
        write_openquake(tmp_path, [component()])
