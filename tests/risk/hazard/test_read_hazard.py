"""Hazard files: OpenQuake's and two columns, whole, spoilt and random."""

import math
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
RATES = "PGA [g],rate\n"
G = 9.80665


def of(curve: HazardCurve) -> str:
    """Return the text of a curve's measure."""
    return str(curve.to_dict()["measure"])


def read(folder: Path, content: str | bytes, **options: Any) -> list[HazardCurve]:
    """Return the curves of a file of this content."""
    path = folder / "hazard.csv"
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return read_hazard_curves(path, **options)


def test_probabilities_in_a_year_are_rates(tmp_path: Path) -> None:
    (curve,) = read(tmp_path, OLD + NAMES + SITE)
    # OpenQuake's own case: its seven digits of .4528811 leave 9e-8 of the rate open.
    assert curve.rates[:2] == pytest.approx([0.6030892, 0.0575211], abs=9e-8)
    assert curve.levels.tolist() == [0.1, 0.4, 0.6]
    assert (of(curve), curve.site, curve.name) == ("pga_g", (0.0, 45.5), "")
    (bare,) = read(tmp_path, NAMES + SITE, measure="pga_g", poe_years=1.0)
    assert bare.rates.tolist() == curve.rates.tolist()


@every("kind", ["mean", "quantile-0.15", "rlz-000"])
@every("years", [1.0, 50.0])
def test_kind_time_and_sites_are_those_of_the_file(tmp_path: Path, kind: str, years: float) -> None:
    header = NEW.format(kind, years, "SA(1.0)")
    curves = read(tmp_path, header + NAMES + SITE + "9.5,46,0.0,.4,.3,.2\n")
    assert [(each.name, of(each)) for each in curves] == [(kind, "sa_g:1.0")] * 2
    assert curves[1].site == (9.5, 46.0)
    assert curves[1].rates * years == pytest.approx([-math.log(0.6), -math.log(0.7), 0.22314355])


def test_velocities_of_openquake_are_in_cm_s(tmp_path: Path) -> None:
    names = "lon,lat,depth,poe-10,poe-40,poe-60\n"
    (curve,) = read(tmp_path, NEW.format("mean", 1.0, "PGV") + names + SITE)
    assert (of(curve), curve.unit) == ("pgv_m_s", "m/s")
    assert curve.levels == pytest.approx([0.1, 0.4, 0.6], rel=1e-15)


def test_infinite_rates_and_none_are_left_out_with_a_remark(tmp_path: Path) -> None:
    row = "0,0,0,1.000000E+00,.4,.2,.1,0.0,0.0\n"
    names = "lon,lat,depth,poe-0.01,poe-0.1,poe-0.2,poe-0.3,poe-0.4,poe-0.5\n"
    (curve,) = read(tmp_path, OLD + names + row)
    assert curve.levels.tolist() == [0.1, 0.2, 0.3]
    assert curve.remarks == (
        "1 level left out: a probability of 1, an infinite rate.",
        "2 levels left out: no rate.",
    )


@every(
    ("name", "options", "measure", "unit"),
    [
        *((name, {}, "pga_g", 1.0) for name in ("PGA [g]", "pga_g", "pga (g)", "PGA, g", "a_g/g")),
        ("Peak ground acceleration (g)", {}, "pga_g", 1.0),
        ("PGA [m/s^2]", {}, "pga_g", 1.0 / G),
        *((name, {}, "pga_g", 0.01 / G) for name in ("PGA [gal]", "PGA in cm/s2", "PGA_cm/s2")),
        *((name, {}, "pga_g", 0.01) for name in ("PGA [%g]", "PGA (% of g) on rock")),
        *((name, {}, "pgv_m_s", 1.0) for name in ("# PGV [m/s]", "pgv_m_s", "PGV (m s-1)")),
        *((name, {}, "pgv_m_s", 0.01) for name in ("PGV (cm/sec)", "pgv_cm_s", "PGV [kine]")),
        ("peak ground velocity (mm/s)", {}, "pgv_m_s", 0.001),
        ("PGV [in/s]", {}, "pgv_m_s", 0.0254),
        ("PGV [ft/sec]", {}, "pgv_m_s", 0.3048),
        *((f"{name} [g]", {}, "sa_g:1.0", 1.0) for name in ("Sa(1.0)", "SA_1.0", "Sa(1,5%)")),
        *((f"{name} (g)", {}, "sa_g:0.3", 1.0) for name in ("SA(0.3s)", "SA(T1=0,3 s)", "Sa .3")),
        ("psa[2] (m/s2)", {}, "sa_g:2.0", 1.0 / G),
        ("sa_g:0.5", {}, "sa_g:0.5", 1.0),
        *((name, {}, "sa_avg_g:0.5", 1.0) for name in ("sa_avg_g:0.5", "Sa_avg(0.5) [g]")),
        ("spectral acceleration [g]", {"measure": "sa_g:0.7"}, "sa_g:0.7", 1.0),
        ("PGA", {"level_unit": "m/s2"}, "pga_g", 1.0 / G),
        ("PGA [gal]", {"level_unit": "cm/s^2"}, "pga_g", 0.01 / G),
        *((name, {"measure": "pga_g"}, "pga_g", 1.0) for name in ("PGA [g]", "PGA", "level")),
        ("level", {"measure": "pgv_m_s", "level_unit": "cm/s"}, "pgv_m_s", 0.01),
    ],
)
def test_what_the_first_column_is_called(
    tmp_path: Path, name: str, options: dict[str, Any], measure: str, unit: float
) -> None:
    (curve,) = read(tmp_path, f"{name};rate\n0.1;0.2\n0.4;0.01\n", **options)
    assert of(curve) == measure
    assert curve.levels == pytest.approx([0.1 * unit, 0.4 * unit], rel=1e-14)
    assert curve.rates.tolist() == [0.2, 0.01]


def poe(years: float, percent: float = 1.0) -> float:
    """Return the annual rate of a probability in some years."""
    return -math.log1p(-percent / 100.0) / years


@every(
    ("names", "rate"),
    [
        ("annual rate,MAFE,mafoe,afe,frequency,lambda,λ,1/yr,H [/year],x (/a),H (1/y)", 0.01),
        ("events per year,tasso annuo,taux annuel,jährliche Rate", 0.01),
        ("rate per 10 years,rate [1/10 yr]", 0.001),
        ("rate per 50 years,rate/50yr,rate in 50 a", 0.0002),
        ("annual probability,AEP,apoe,PoE in 1 year,yearly probability", poe(1.0)),
        ("PoE in 50 years,probability (50 yr),wahrscheinlichkeit in 50 Jahren", poe(50.0)),
        ("probabilité en 50 ans,probabilità in 50 anni,probabilidad en 50 años", poe(50.0)),
        ("prob in 475.5 y", poe(475.5)),
        ("probability in 50 years [%],PoE in 50 yr (per cent)", poe(50.0, 0.01)),
        ("PoE,P(exceedance),H,poe in 30 years", poe(30.0)),
        ("return period [years],TR,T_R (yr),RP,recurrence,Wiederkehrperiode [Jahre]", 100.0),
        ("periodo di ritorno,période de retour,periodo de retorno", 100.0),
    ],
)
def test_what_the_second_column_is_called(tmp_path: Path, names: str, rate: float) -> None:
    """Rates by hand: of a probability p in T years -ln(1 - p)/T, of a return period its inverse."""
    for name in names.split(","):
        first = "0.001" if rate == 100.0 else "0.2"
        options = {"poe_years": 30.0} if rate == poe(30.0) else {}
        (curve,) = read(tmp_path, f"PGA [g],{name}\n0.1,{first}\n0.4,0.01\n", **options)
        assert curve.rates[1] == pytest.approx(rate, rel=1e-12), name
        assert curve.remarks == ()


@every(
    "content",
    [
        b"\xef\xbb\xbfPGA [g],rate\r\n0.1,0.02\r\n0.4,0.001\r\n",
        "PGA [g],rate\n0.1,0.02\n0.4,0.001\n".encode("utf-16"),
        "PGA [g],Häufigkeit\n0.1,0.02\n0.4,0.001\n".encode("latin-1"),
        b"sep=;\r\nPGA [g];rate\r\n0,1;0,02\r\n0,4;0,001\r\n",
        b"PGA [g];rate;\n0.1;0.02;\n0.4;0.001;\n",
        b"PGA [g]\trate\n0,1\t0,02\n0,4\t0,001\n",
        b"PGA [g] annual rate\n0.1 0.02\n0.4 1e-3\n",
        b"# PGA [g], rate\n# of site A, Basel\n0,1 0,02\n0,4 0,001\n",
        b"PGA [g],rate\n0.4,0.001\n0.1,0.02\n",
        b"rate,PGA [g]\n0.02,0.1\n0.001,0.4\n",
        b"return period, 475\n2020\n\nPGA [g],rate\n\n0.1,0.02# low\n# a remark\n0.4,0.001\n\n,\n",
        b'"PGA [g]","rate"\n"0.1","0.02"\n"0.4","0.001"\n',
    ],
)
def test_marks_line_ends_separators_commas_and_orders(tmp_path: Path, content: bytes) -> None:
    (curve,) = read(tmp_path, content)
    assert (curve.levels.tolist(), curve.rates.tolist()) == ([0.1, 0.4], [0.02, 0.001])


def test_columns_without_names_are_annual_rates_with_a_remark(tmp_path: Path) -> None:
    (plain,) = read(tmp_path, "sep=;\n.1;.02\n.4;.001\n", measure="sa_g:0.5")
    assert (of(plain), plain.rates.tolist()) == ("sa_g:0.5", [0.02, 0.001])
    assert plain.remarks == ("The second column is taken as annual rates.",)
    (curve,) = read(tmp_path, ".1,.02\n.4,.01\n", measure="pga_g", poe_years=10.0)
    assert (curve.rates[1], curve.remarks) == (pytest.approx(poe(10.0)), ())


OQ = OLD + NAMES
TWO = ".1,.02\n.4,.001\n"
REFUSED: list[tuple[str | bytes, str]] = [
    (TWO, "'a column without a name' is not one of PGA, PGV and Sa(PERIOD); state it"),
    *((f"{name},rate\n{TWO}", f"{name!r} is not one of PGA") for name in ("MMI", "Sa [g]", "x")),
    (f"PGA,rate\n{TWO}", 'write it into the name, as "[g]", or give level_unit='),
    (f"PGA {'x ' * 400},rate\n{TWO}", "x ' names no unit of acceleration"),
    (f"PGV [g],rate\n{TWO}", "'PGV [g]' names no unit of velocity"),
    *((f"PGA [{unit}],rate\n{TWO}", "names no unit of accel") for unit in ("cm/s", "furlong")),
    *((f"PGA [g],{p}\n{TWO}", "has no time in years; state it") for p in ("PoE", "PoE in 0 y")),
    *(
        (f"PGA [g],{name}\n{TWO}", f'{name!r} is not "annual rate", "return period [years]"')
        for name in ("H", "rate per month", "rate per 0 y", "rate [%]", "TR [ka]", "TR [10 y]")
    ),
    (f"{RATES}.1,.02\n.4,.03\n", "line 3, '.4,.03': the rate of 0.4 is above that of 0.1"),
    ("PGA [g],TR\n.1,475\n.4,50\n", "line 3, '.4,50': the rate of 0.4 is above that of 0.1"),
    (f"{RATES}.1,.02\n.1,.02\n", "line 3, '.1,.02': the level 0.1 is not above 0.1; sort"),
    (f"{RATES}.1,.02\n.4,.01\n.2,.001\n", "line 4, '.2,.001': the level 0.2 is not above 0.4"),
    (f"{RATES}0,.02\n.4,.01\n", "line 2, '0,.02': the level 0 is not above 0"),
    *(
        (f"{RATES}.1,.02\n{line}\n.5,.001\n", f"line 3, {line!r}: it must be two numbers from 0")
        for line in (".4,.01,3", ".4,", ".4", ".4,nan", ".4,inf", "-.4,.01", ".4,-.01", "N/A,x")
    ),
    (f"{RATES}N/A,.02\n.4,.01\n.5,.001\n", "line 2, 'N/A,.02': it must be two numbers"),
    ("PGA [g],rate,poe\n.1,.1,.1\n", "line 1, 'PGA [g],rate,poe': it must be two numbers"),
    ("PGA [g];TR\n0,1;1.000\n0,4;2.475\n", "line 2, '0,1;1.000': it must be two numbers"),
    ('PGA [g],TR\n.1,475\n.4,"2,475"\n', "line 3, '.4,\"2,475\"': it must be two numbers"),
    (f"{RATES}.4,.01{'x' * 40}\n{TWO}", f"line 2, '.4,.01{'x' * 34}...': it must be"),
    *((f"PGA [g],{p}\n.4,.01\n", "a probability must") for p in ("AEP\n.1,2", "TR\n.1,0")),
    *((f"{RATES}.1,.02\n{end}", "line 2, '.1,.02': the curve has 1") for end in ("", ".4,0.0")),
    (f"{RATES}10,.02\n40,.01\n", "no ground shakes with 40 g; state the unit of the file"),
    *((each, "it has no line of two numbers") for each in (RATES, "PGA [g]\n.1\n.4\n", "a text")),
    *((each, "it is empty") for each in ("", "\n \r\n\n")),
    *((each, "it is not text; give a CSV file") for each in (bytes(range(256)), b"\x00.\x001")),
    (b"PK\x03\x04 xl/workbook", "it is a spreadsheet; give a CSV file"),
    (OQ + "0,0,0,.4,.3\n", "line 3, '0,0,0,.4,.3': it has 5 columns, and there are 6 names"),
    (OQ + "0,0,0,.4,.5,.3\n", "line 3, '0,0,0,.4,.5,.3': the rate of 0.4 is above that of 0.1"),
    *((OQ + f"0,0,0,{p},.5,.3\n", "a probability must lie") for p in ("1.4", "-.4", "x", "nan")),
    *((OQ + f"{site},0,.4,.3,.2\n", "lon and lat must be degrees") for site in ("0,95", "x,0")),
    (OQ + "0,0,0,1,.3,0\n", "line 3, '0,0,0,1,.3,0': the curve has 1 level"),
    (OQ, "it has no row of a site"),
    (OLD + "lon,lat,poe-0.1,poe-0.1\n0,0,.2,.1\n", "the level 0.1 is not above 0.1"),
    *(
        (OLD + f"{names}\n0,0,.2,.1\n", f"line 2, '{names}': its names must be lon, lat and poe-L")
        for names in ("lon,lat,poe-x,poe-0.1", "x,y,poe-0.1,poe-0.2", "lon,lat,poe-0,poe-0.1")
    ),
    (NAMES + SITE, "'a file without imt' is not one of PGA, PGV and Sa(PERIOD)"),
    ("# imt='PGA'\n" + NAMES + SITE, "or give poe_years="),
    (NEW.format("mean", 1.0, "SA") + NAMES + SITE, "'SA' is not one of PGA"),
    *(
        (NEW.format("mean", years, "PGA") + NAMES + SITE, "has no time in years; state it")
        for years in ("0.0", "inf", "1e7")
    ),
]


@every(("content", "line"), REFUSED)
def test_what_is_not_clear_is_refused_in_a_line(
    tmp_path: Path, content: str | bytes, line: str
) -> None:
    with pytest.raises(InputError) as refusal:
        read(tmp_path, content)
    told = str(refusal.value)
    assert line in told
    assert "\n" not in told
    assert len(told) < 700
    assert told.startswith("hazard = ")


@every(
    ("content", "options", "line"),
    [
        (RATES + TWO, {"measure": "pgv_m_s"}, "measure = 'pgv_m_s' is not valid: the file states"),
        (RATES + TWO, {"level_unit": "m/s^2"}, "the file states 'PGA [g]'; give g, or none"),
        (RATES + TWO, {"level_unit": "cm"}, "level_unit = 'cm' is not valid: it must be a unit of"),
        (RATES + TWO, {"poe_years": 50.0}, "poe_years = 50.0 is not valid: the file states 'rate'"),
        (RATES + TWO, {"poe_years": -1.0}, "it must lie in (0, 1000000]; give a time in years"),
        (f"PGA [g],poe in 10 y\n{TWO}", {"poe_years": 50.0}, "the file states 'poe in 10 y'"),
        (f"PGA [x],rate\n{TWO}", {"measure": "pga_g"}, "'PGA [x]' names no unit of acceleration"),
        (f"Sa [g],rate\n{TWO}", {"measure": "pga_g"}, "'Sa [g]' is not one of PGA"),
        (OQ + SITE, {"measure": "pgv_m_s"}, "measure = 'pgv_m_s' is not valid: the file states"),
        (OQ + SITE, {"poe_years": 50.0}, "the file states 'investigation_time=1.0'; leave it out"),
        (OQ + SITE, {"level_unit": "g"}, "OpenQuake's levels are in g or, of PGV, cm/s; leave it"),
        (OQ.replace("PGA", "MMI") + SITE, {"measure": "pga_g"}, "its imt is MMI; export PGA"),
    ],
)
def test_arguments_against_the_file_are_refused(
    tmp_path: Path, content: str, options: dict[str, Any], line: str
) -> None:
    with pytest.raises(InputError) as refusal:
        read(tmp_path, content, **options)
    assert line in str(refusal.value)


def test_no_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file"):
        read_hazard_curves(tmp_path / "none.csv")
    with pytest.raises(InputError, match="it is a folder"):
        read_hazard_curves(tmp_path)


CURVES = st.dictionaries(st.floats(1e-3, 10.0), st.floats(1e-6, 5.0), min_size=2, max_size=8)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(CURVES, st.sampled_from([",", ";", "\t", " "]), st.sampled_from(["\n", "\r\n", "\r"]))
def test_what_is_written_is_read(
    tmp_path: Path, points: dict[float, float], separator: str, end: str
) -> None:
    levels, rates = sorted(points), sorted(points.values(), reverse=True)
    rows = [f"{x!r}{separator}{y!r}" for x, y in zip(levels, rates, strict=True)]
    for ordered in (rows, rows[::-1]):
        (curve,) = read(tmp_path, end.join(["PGA [g], rate", *ordered, ""]))
        assert (curve.levels.tolist(), curve.rates.tolist()) == (levels, rates)
    names = ["lon", "lat", *(f"poe-{x!r}" for x in levels)]
    poes = [-math.expm1(-0.5 * rate) for rate in rates]
    rows = [NEW.format("mean", 0.5, "PGA").strip(), ",".join(names)]
    (curve,) = read(tmp_path, end.join([*rows, ",".join(map(repr, [1.0, 2.0, *poes]))]))
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
            lambda cut: spoilt((OQ + SITE).encode(), *cut)
        ),
        st.tuples(st.integers(0, 40), st.integers(0, 4), st.binary(max_size=4)).map(
            lambda cut: spoilt((RATES + TWO).encode(), *cut)
        ),
    ),
    st.sampled_from([None, "pga_g", "pgv_m_s"]),
    st.sampled_from([None, 50.0]),
)
def test_any_bytes_are_curves_or_one_clear_line(
    tmp_path: Path, content: bytes, measure: str | None, poe_years: float | None
) -> None:
    curves, line = [], ""
    try:
        curves = read(tmp_path, content, measure=measure, poe_years=poe_years)
    except InputError as error:
        line = str(error)
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
