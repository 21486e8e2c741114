"""Hazard files: OpenQuake's and two columns, whole, spoilt and random."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocksteady import read_hazard_curves
from rocksteady.errors import InputError
from rocksteady.risk import HazardCurve
from tests.every import every

NEW = (
    "#,,,,,\"generated_by='OpenQuake engine 3.16.0', start_date='2024-06-03T09:36:04', "
    "checksum=1, kind='{}', investigation_time={}, imt='{}'\"\n"
)
"""First line of a file of a recent engine, whose fields are quoted."""
OLD = "# source_model_tree_path=('b1',), investigation_time=1.0, imt=\"PGA\"\n"
NAMES = "lon,lat,depth,poe-0.1,poe-0.4,poe-0.6\n"
SITE = "0.0,45.5,0.0,.4528811,.05589804,.006\n"


def of(curve: HazardCurve) -> str:
    """Return the text of a curve's measure."""
    return str(curve.to_dict()["measure"])


@pytest.fixture(name="file")
def _file(tmp_path: Path) -> Any:
    def write(content: str | bytes) -> Path:
        path = tmp_path / "hazard.csv"
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write


def test_probabilities_in_a_year_are_rates(file: Any) -> None:
    (curve,) = read_hazard_curves(file(OLD + NAMES + SITE))
    # OpenQuake's own case: its seven digits of .4528811 leave 9e-8 of the rate open.
    assert curve.rates[:2] == pytest.approx([0.6030892, 0.0575211], abs=9e-8)
    assert curve.levels.tolist() == [0.1, 0.4, 0.6]
    assert (of(curve), curve.site, curve.name) == ("pga_g", (0.0, 45.5), "")


@every(
    ("name", "second"),
    [
        ("rate per 50 years", 0.01 / 50.0),
        ("rate/50yr", 0.01 / 50.0),
        ("rate [1/yr]", 0.01),
        ("probability in 50 years [%]", -math.log1p(-1e-4) / 50.0),
        ("annual probability (%)", -math.log1p(-1e-4)),
    ],
)
def test_rates_of_several_years_and_per_cents_are_counted_as_such(
    file: Any, name: str, second: float
) -> None:
    (curve,) = read_hazard_curves(file(f"PGA [g], {name}\n0.1,0.1\n0.2,0.01\n"))
    assert curve.rates[1] == pytest.approx(second, rel=1e-14)


@every("name", ["rate per month", "annual rate [%]", "return period [ka]"])
def test_rates_of_other_times_and_in_per_cent_are_refused(file: Any, name: str) -> None:
    with pytest.raises(InputError, match=re.escape(repr(name))):
        read_hazard_curves(file(f"PGA [g], {name}\n0.1,100\n0.2,10\n"))


@every("kind", ["mean", "quantile-0.15", "rlz-000"])
@every("years", [1.0, 50.0])
def test_kind_time_and_sites_are_those_of_the_file(file: Any, kind: str, years: float) -> None:
    header = NEW.format(kind, years, "SA(1.0)")
    curves = read_hazard_curves(file(header + NAMES + SITE + "9.5,46,0.0,.4,.3,.2\n"))
    assert [(each.name, of(each)) for each in curves] == [(kind, "sa_g:1.0")] * 2
    assert curves[1].site == (9.5, 46.0)
    assert curves[1].rates * years == pytest.approx([-math.log(0.6), -math.log(0.7), 0.22314355])


def test_velocities_of_openquake_are_in_cm_s(file: Any) -> None:
    names = "lon,lat,depth,poe-10,poe-40,poe-60\n"
    (curve,) = read_hazard_curves(file(NEW.format("mean", 1.0, "PGV") + names + SITE))
    assert (of(curve), curve.unit) == ("pgv_m_s", "m/s")
    assert curve.levels == pytest.approx([0.1, 0.4, 0.6], rel=1e-15)


def test_infinite_rates_and_none_are_left_out_with_a_remark(file: Any) -> None:
    row = "0,0,0,1.000000E+00,.4,.2,.1,0.0,0.0\n"
    names = "lon,lat,depth,poe-0.01,poe-0.1,poe-0.2,poe-0.3,poe-0.4,poe-0.5\n"
    (curve,) = read_hazard_curves(file(OLD + names + row))
    assert curve.levels.tolist() == [0.1, 0.2, 0.3]
    assert curve.remarks == (
        "1 level left out: a probability of 1, an infinite rate.",
        "2 levels left out: no rate.",
    )


@every(
    ("header", "levels", "measure"),
    [
        ("PGA [g], annual rate", [0.1, 0.4], "pga_g"),
        ("pga_g,annual_rate", [0.1, 0.4], "pga_g"),
        ("Sa(1.0) [g],MAFE", [0.1, 0.4], "sa_g:1.0"),
        ("SA(0.3s) (g),annual frequency of exceedance", [0.1, 0.4], "sa_g:0.3"),
        ("# PGV [m/s],lambda", [0.1, 0.4], "pgv_m_s"),
        ("PGV [cm/s],rate (1/yr)", [0.001, 0.004], "pgv_m_s"),
        ("PGV (cm/sec),AFE", [0.001, 0.004], "pgv_m_s"),
        ("pgv_cm_s,rate", [0.001, 0.004], "pgv_m_s"),
        ("PGA [m/s^2],rate", [0.1 / 9.80665, 0.4 / 9.80665], "pga_g"),
        ("PGA [gal],rate", [0.001 / 9.80665, 0.004 / 9.80665], "pga_g"),
        ("Peak ground acceleration (g),annual exceedance rate", [0.1, 0.4], "pga_g"),
    ],
)
def test_names_and_units_of_two_columns(
    file: Any, header: str, levels: list[float], measure: str
) -> None:
    (curve,) = read_hazard_curves(file(f"{header}\n0.1,0.02\n0.4,0.001\n"))
    assert curve.levels == pytest.approx(levels, rel=1e-14)
    assert curve.rates.tolist() == [0.02, 0.001]
    assert of(curve) == measure


@every(
    ("header", "values", "options"),
    [
        ("PGA [g],return period [years]", (50, 1000), {}),
        ("PGA [g],annual probability of exceedance", (-math.expm1(-0.02), -math.expm1(-0.001)), {}),
        ("PGA [g],probability in 50 years", (-math.expm1(-1.0), -math.expm1(-0.05)), {}),
        ("PGA [g],PoE", (-math.expm1(-1.0), -math.expm1(-0.05)), {"poe_years": 50.0}),
    ],
)
def test_probabilities_and_return_periods_of_two_columns(
    file: Any, header: str, values: tuple[float, float], options: dict[str, Any]
) -> None:
    path = file(f"{header}\n0.1,{values[0]!r}\n0.4,{values[1]!r}\n")
    (curve,) = read_hazard_curves(path, **options)
    assert curve.rates == pytest.approx([0.02, 0.001], rel=1e-12)


@every(
    "content",
    [
        b"\xef\xbb\xbfPGA [g],rate\r\n0.1,0.02\r\n0.4,0.001\r\n",
        "PGA [g],rate\n0.1,0.02\n0.4,0.001\n".encode("utf-16"),
        b"PGA [g];rate\n0,1;0,02\n0,4;0,001\n",
        b"PGA [g];rate;\n0.1;0.02;\n0.4;0.001;\n",
        b"PGA [g]\trate\n0,1\t0,02\n0,4\t0,001\n",
        b"PGA [g]  rate\n0.1 0.02\n0.4 1e-3\n",
        b"# PGA [g], rate\n0,1 0,02\n0,4 0,001\n",
        b"PGA [g],rate\n0.4,0.001\n0.1,0.02\n",
        b"rate,PGA [g]\n0.02,0.1\n0.001,0.4\n",
        b"a site\n\nPGA [g],rate\n\n0.1,0.02\n# a remark\n0.4,0.001\n\n\n",
        b'"PGA [g]","rate"\n"0.1","0.02"\n"0.4","0.001"\n',
    ],
)
def test_marks_line_ends_separators_commas_and_orders(file: Any, content: bytes) -> None:
    (curve,) = read_hazard_curves(file(content))
    assert (curve.levels.tolist(), curve.rates.tolist()) == ([0.1, 0.4], [0.02, 0.001])


@every(
    ("content", "line"),
    [
        (".1,.02\n.4,.001\n", "the columns have no names, as PGA, PGV and Sa(PERIOD)"),
        ("x,rate\n.1,.02\n.4,.001\n", "or give measure="),
        ("Sa [g],rate\n.1,.02\n.4,.001\n", 'as "Sa(1.0) [g]", or give measure="sa_g:1.0"'),
        ("PGA,rate\n.1,.02\n.4,.001\n", 'give level_unit=, as "g"'),
        ("PGV,rate\n.1,.02\n.4,.001\n", 'give level_unit=, as "m/s"'),
        ("PGV [g],rate\n.1,.02\n.4,.001\n", "names no unit of velocity"),
        ("PGA [g],probability\n.1,.02\n.4,.001\n", "give poe_years="),
        ("PGA [g],H\n.1,.02\n.4,.001\n", 'name the column "annual rate", or give poe_years='),
        ("PGA [g],rate\n.1,.02\n.4,.03\n", "line 3, '.4,.03': the rate of 0.4 is above that"),
        ("PGA [g],rate\n.1,.02\n.1,.02\n", "line 3, '.1,.02': the level 0.1 is repeated"),
        ("PGA [g],rate\n.1,.02\n.4,.01\n.2,.001\n", "line 4, '.2,.001': the level 0.2 follows 0.4"),
        ("PGA [g],rate\n.1,.02\n.4,.01,3\n", "line 3, '.4,.01,3': it must be two numbers"),
        ("PGA [g],rate\n.1,nan\n.2,.1\n.4,.01\n", "line 2, '.1,nan': it must be two numbers"),
        ("PGA [g],rate\n.1,.02\n.4,\n", "line 3, '.4,': it must be two numbers"),
        ("PGA [g],rate\n.1,-.02\n.4,-1\n", "a rate is not negative"),
        ("PGA [g],rate\n0,.02\n.4,.01\n", "a level must be above 0"),
        ("PGA [g],poe in 1 year\n.1,2\n.4,.01\n", "a probability of exceedance must lie in [0, 1]"),
        ("PGA [g],rate\n.1,.02\n", "fewer than two levels"),
        ("PGA [g],rate\n", "it has no line of two numbers"),
        ("", "it is empty"),
        ("\n \r\n\n", "it is empty"),
        (OLD + NAMES + "0,0,0,.4,.3\n", "it has 5 columns, and there are 6 names"),
        (OLD + NAMES + "0,0,0,.4,.5,.3\n", "the rate of 0.4 is above that of 0.1"),
        (OLD + NAMES + "0,0,0,1.4,.5,.3\n", "a probability of exceedance must lie in [0, 1]"),
        (OLD + NAMES + "0,0,0,x,.5,.3\n", "line 3, '0,0,0,x,.5,.3': a probability"),
        (OLD + NAMES + "0,95,0,.4,.3,.2\n", "longitude and latitude must be degrees"),
        (OLD + NAMES + "0,0,0,1,.3,0\n", "fewer than two levels"),
        (OLD + NAMES, "it has no row of a site"),
        (OLD + "lon,lat,depth,poe-0.1,poe-0.1\n0,0,0,.2,.1\n", "the level 0.1 is repeated"),
        (OLD + "lon,lat,depth,poe-x,poe-0.1\n0,0,0,.2,.1\n", "must name its level"),
        (OLD + "x,y,poe-0.1,poe-0.2\n0,0,.2,.1\n", "the columns lon and lat are missing"),
        (NAMES + SITE, "give measure="),
        ("# imt='PGA'\n" + NAMES + SITE, "give poe_years="),
        (NEW.format("mean", 1.0, "MMI") + NAMES + SITE, "its imt is MMI: known are PGA"),
        (NEW.format("mean", 1.0, "SA") + NAMES + SITE, "its imt is SA: known are PGA"),
        (NEW.format("mean", 0.0, "PGA") + NAMES + SITE, "investigation_time = 0.0 is no time"),
    ],
)
def test_what_is_not_clear_is_refused_in_a_line(file: Any, content: str, line: str) -> None:
    path = file(content)
    with pytest.raises(InputError) as refusal:
        read_hazard_curves(path)
    told = str(refusal.value)
    assert line in told
    assert "\n" not in told
    assert told.startswith("hazard = ")


def test_arguments_give_what_a_file_leaves_open(file: Any) -> None:
    path = file(".1,.02\n.4,.001\n")
    (plain,) = read_hazard_curves(path, measure="sa_g:0.5")
    assert (of(plain), plain.levels.tolist()) == ("sa_g:0.5", [0.1, 0.4])
    (velocity,) = read_hazard_curves(path, measure="pgv_m_s", level_unit="cm/s", poe_years=10.0)
    assert velocity.levels == pytest.approx([0.001, 0.004])
    assert velocity.rates == pytest.approx([-math.log(0.98) / 10.0, -math.log(0.999) / 10.0])
    (bare,) = read_hazard_curves(file(NAMES + SITE), measure="pga_g", poe_years=1.0)
    assert bare.rates[0] == pytest.approx(0.6030892, abs=9e-8)


@every(
    ("content", "options", "line"),
    [
        ("PGA [g],rate\n.1,.02\n.4,.001\n", {"measure": "pgv_m_s"}, "measure = 'pgv_m_s'"),
        ("PGA [g],rate\n.1,.02\n.4,.001\n", {"level_unit": "m/s^2"}, "level_unit = 'm/s^2'"),
        ("PGA [g],rate\n.1,.02\n.4,.001\n", {"level_unit": "cm"}, "a unit of acceleration"),
        ("PGA [g],rate\n.1,.02\n.4,.001\n", {"poe_years": 50.0}, "poe_years = 50.0"),
        ("PGA [g],poe in 10 years\n.1,.2\n.4,.1\n", {"poe_years": 50.0}, "poe_years = 50.0"),
        (OLD + NAMES + SITE, {"measure": "pgv_m_s"}, "the file states PGA"),
        (OLD + NAMES + SITE, {"poe_years": 50.0}, "the file states 1 years"),
        (OLD + NAMES + SITE, {"level_unit": "g"}, "leave it out"),
    ],
)
def test_arguments_against_the_file_are_refused(
    file: Any, content: str, options: dict[str, Any], line: str
) -> None:
    with pytest.raises(InputError) as refusal:
        read_hazard_curves(file(content), **options)
    assert line in str(refusal.value)


def test_no_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file"):
        read_hazard_curves(tmp_path / "none.csv")
    with pytest.raises(InputError, match="it is a folder"):
        read_hazard_curves(tmp_path)


CURVES = (
    st.lists(st.floats(1e-3, 10.0), min_size=2, max_size=8, unique=True)
    .map(sorted)
    .flatmap(
        lambda levels: st.tuples(
            st.just(levels),
            st.lists(st.floats(1e-6, 5.0), min_size=len(levels), max_size=len(levels)),
        )
    )
)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(CURVES, st.sampled_from([",", ";", "\t", " "]), st.sampled_from(["\n", "\r\n", "\r"]))
def test_what_is_written_is_read(
    tmp_path: Path, points: tuple[list[float], list[float]], separator: str, end: str
) -> None:
    levels, rates = points[0], sorted(points[1], reverse=True)
    rows = [f"{x!r}{separator}{y!r}" for x, y in zip(levels, rates, strict=True)]
    path = tmp_path / "two.csv"
    path.write_bytes(end.join(["PGA [g], rate", *rows, ""]).encode())
    (curve,) = read_hazard_curves(path)
    assert (curve.levels.tolist(), curve.rates.tolist()) == (levels, rates)
    names = ["lon", "lat", *(f"poe-{x!r}" for x in levels)]
    poes = [-math.expm1(-0.5 * rate) for rate in rates]
    rows = [NEW.format("mean", 0.5, "PGA").strip(), ",".join(names)]
    path.write_bytes(end.join([*rows, ",".join(map(repr, [1.0, 2.0, *poes]))]).encode())
    (curve,) = read_hazard_curves(path)
    assert curve.levels.tolist() == levels
    assert curve.rates == pytest.approx(rates, rel=1e-12)


PIECES = st.sampled_from(
    ["PGA [g]", "Sa(1.0)", "rate", "poe-0.1", "poe-", "lon", "lat", ",", ";", "\t", " ", "\n",
     "\r\n", "0.1", "1e-3", "1", "0", "-1", "nan", "1e999", "0,5", "#", "imt='PGA'", "imt=\"SA(",
     "investigation_time=1.0", "\x00", "é", '"', "'", "1e-320", "probability in 50 years", "(", "]"]
)  # fmt: skip


@pytest.mark.slow
@settings(max_examples=400, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.one_of(
        st.binary(max_size=200),
        st.text(max_size=200).map(lambda text: text.encode("utf-8", "surrogatepass")),
        st.lists(PIECES, max_size=60).map(lambda parts: "".join(parts).encode()),
        st.tuples(st.integers(0, 200), st.integers(0, 4), st.binary(max_size=4)).map(
            lambda cut: spoilt((OLD + NAMES + SITE).encode(), *cut)
        ),
        st.tuples(st.integers(0, 40), st.integers(0, 4), st.binary(max_size=4)).map(
            lambda cut: spoilt(b"PGA [g],rate\n0.1,0.02\n0.4,0.001\n", *cut)
        ),
    ),
    st.sampled_from([None, "pga_g", "pgv_m_s"]),
    st.sampled_from([None, 50.0]),
)
def test_any_bytes_are_curves_or_one_clear_line(
    tmp_path: Path, content: bytes, measure: str | None, poe_years: float | None
) -> None:
    path = tmp_path / "any.csv"
    path.write_bytes(content)
    try:
        curves = read_hazard_curves(path, measure=measure, poe_years=poe_years)
    except InputError as error:
        curves, line = [], str(error)
    else:
        line = ""
    assert bool(curves) != bool(line)
    assert "\n" not in line
    assert len(line) < 700
    for curve in curves:
        assert isinstance(curve, HazardCurve)
        assert np.all(np.diff(curve.rates) <= 0.0)
        assert np.all(curve.rates > 0.0)


def spoilt(content: bytes, at: int, count: int, instead: bytes) -> bytes:
    """Return bytes of which some are replaced by others."""
    return content[:at] + instead + content[at + count :]


def test_what_the_second_column_is_called(file: Any) -> None:
    """Rates by hand: of a probability p in T years -ln(1 - p)/T, of a return period its inverse."""

    def poe(years: float) -> float:
        return -math.log1p(-0.01) / years

    for name, options, rate in (
        *(
            (each, {}, 0.01)
            for each in ("annual rate", "MAFE", "mafoe", "afe", "frequency", "lambda")
        ),
        *(
            (each, {}, 0.01)
            for each in ("1/yr", "H [/year]", "x (/a)", "events per year", "H (1/y)")
        ),
        *(("rate per 10 years", {}, 0.001), ("rate/2.5 y", {}, 0.004), ("rate in 5 a", {}, 0.002)),
        *(("annual probability", {}, poe(1.0)), ("AEP", {}, poe(1.0)), ("apoe", {}, poe(1.0))),
        *(("PoE in 50 years", {}, poe(50.0)), ("poe in 1 year", {}, poe(1.0))),
        *(("prob in 475.5 y", {}, poe(475.5)), ("yearly probability", {}, poe(1.0))),
        *(("PoE", {"poe_years": 30.0}, poe(30.0)), ("P(exceedance)", {"poe_years": 2.0}, poe(2.0))),
        *(("poe in 30 years", {"poe_years": 30.0}, poe(30.0)), ("H", {"poe_years": 1.0}, poe(1.0))),
        *(("return period [years]", {}, 100.0), ("recurrence in 10 years", {}, 100.0)),
    ):
        first = "0.001" if "re" in name[:3] and rate == 100.0 else "0.2"
        text = f"PGA [g],{name}\n0.1,{first}\n0.4,0.01\n"
        (curve,) = read_hazard_curves(file(text), **options)  # type: ignore[arg-type]
        assert curve.rates[1] == pytest.approx(rate, rel=1e-12), name
    for name, options, words in (
        ("rate per 0 years", {}, "is of no time; name the columns"),
        ("annual rate %", {}, "is in per cent, which is for probabilities"),
        ("poe in 0 years", {}, "0 years is no time; give poe_years="),
        ("poe in 1000001 years", {}, "1e.06 years is no time"),
        ("return period", {"poe_years": 1.0}, "the file states 'return period'; leave it out"),
        ("H", {}, "'h' is not clear; name the column \"annual rate\", or give poe_years="),
        ("rate per decade", {}, "is of a time that is not counted in years"),
    ):
        with pytest.raises(InputError, match=words):
            read_hazard_curves(file(f"PGA [g],{name}\n0.1,0.2\n0.4,0.01\n"), **options)  # type: ignore[arg-type]
    for name, value in (("return period", "0"), ("return period", "-5"), ("rate", "-0.01")):
        with pytest.raises(
            InputError, match=r"line 3, .*a rate is not negative, a return period ab"
        ):
            read_hazard_curves(file(f"PGA [g],{name}\n0.1,0.2\n0.4,{value}\n"))
    (ended,) = read_hazard_curves(file("PGA [g],rate\n0.1,0.2\n0.4,0.01\n0.6,0\n"))
    assert ended.remarks == ("1 level left out: no rate.",)


def test_what_the_first_column_is_called(file: Any) -> None:
    g = 9.80665
    for name, options, measure, factor in (
        ("pga (g)", {}, "pga_g", 1.0),
        ("peak ground acceleration [cm/s2]", {}, "pga_g", 0.01 / g),
        ("PGA, g", {}, "pga_g", 1.0),
        ("peak ground velocity (mm/s)", {}, "pgv_m_s", 0.001),
        ("PGV [in/s]", {}, "pgv_m_s", 0.0254),
        ("PGV [ft/sec]", {}, "pgv_m_s", 0.3048),
        ("PGV [kine]", {}, "pgv_m_s", 0.01),
        ("PGV [mps]", {}, "pgv_m_s", 1.0),
        ("pgv_m_s", {}, "pgv_m_s", 1.0),
        ("SA(T=0.5 s) [g]", {}, "sa_g:0.5", 1.0),
        ("psa[2] (m/s2)", {}, "sa_g:2.0", 1.0 / g),
        ("spectral acceleration [g]", {"measure": "sa_g:0.7"}, "sa_g:0.7", 1.0),
        ("PGA", {"level_unit": "m/s2"}, "pga_g", 1.0 / g),
        ("PGA [g]", {"level_unit": "g"}, "pga_g", 1.0),
        ("PGA [g]", {"measure": "pga_g"}, "pga_g", 1.0),
        ("PGA", {"measure": "pga_g"}, "pga_g", 1.0),
        ("level", {"measure": "pgv_m_s", "level_unit": "cm/s"}, "pgv_m_s", 0.01),
    ):
        separator = ";" if "," in name else ","
        text = f"{name}{separator}rate\n0.1{separator}0.2\n0.4{separator}0.01\n"
        (curve,) = read_hazard_curves(file(text), **options)  # type: ignore[arg-type]
        assert of(curve) == measure, name
        assert curve.levels == pytest.approx([0.1 * factor, 0.4 * factor], rel=1e-12), name
    for name, options, words in (
        ("PGA [furlong]", {}, "names no unit of acceleration; give level_unit="),
        ("PGV [g]", {}, "names no unit of velocity; give level_unit="),
        ("PGA [furlong]", {"measure": "pga_g"}, "names no unit of acceleration; give level_unit="),
        ("PGA [g]", {"level_unit": "furlong"}, "level_unit = 'furlong' .*a unit of acceleration"),
        ("PGV [m/s]", {"level_unit": "cm/s"}, "the file states 'pgv .m/s.'; leave it out"),
        ("Sa [g]", {}, "'sa .g.' names no period"),
        ("x", {}, "'x' is not one of PGA, PGV and Sa"),
        ("PGA [g]", {"measure": "pgv_m_s"}, "the file states 'pga .g.'; leave out measure="),
    ):
        with pytest.raises(InputError, match=words):
            read_hazard_curves(file(f"{name},rate\n0.1,0.2\n0.4,0.01\n"), **options)  # type: ignore[arg-type]


def test_bounds_of_a_file_of_a_hazard_curve(file: Any) -> None:
    head = "PGA [g],rate\n0.1,0.2\n0.4,0.01\n"
    for length, fits in ((100_000, True), (100_001, False)):
        text = f"# {'x' * (length - 2)}\n{head}"
        if fits:
            assert len(read_hazard_curves(file(text))) == 1
        else:
            with pytest.raises(InputError, match="it has lines of 100,000 characters; give an"):
                read_hazard_curves(file(text))
    long = "0.5,0.5" + " " * 60 + "x"
    with pytest.raises(InputError) as refused:
        read_hazard_curves(file(f"{head}{long}\n"))
    assert "line 4, '0.5,0.5" in str(refused.value)
    assert "x'" not in str(refused.value)
    for forty in ("0.5,0.5" + "y" * 33, "0.5,0.5" + "y" * 34):
        with pytest.raises(InputError) as refused:
            read_hazard_curves(file(f"{head}{forty}\n"))
        assert ("..." in str(refused.value)) == (len(forty) > 40)
    (equal,) = read_hazard_curves(file("PGA [g],rate\n0.1,0.2\n0.4,0.2\n"))
    assert equal.rates.tolist() == [0.2, 0.2]
