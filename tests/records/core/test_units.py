"""Units of acceleration however they are written, and directions by any name."""

import pytest

from rocksteady.errors import InputError
from rocksteady.records.core.directions import direction
from rocksteady.records.core.units import (
    UNITS,
    acceleration_unit,
    in_m_s2,
    in_seconds,
    leading,
    modifies,
    quantity_of,
    unit_named,
)
from tests.every import every

# Standard gravity and the foot are exact by definition (BIPM, SI brochure; NIST SP 811).
EXACT = {
    "g": 9.80665,
    "mg": 0.00980665,
    "m/s^2": 1.0,
    "cm/s^2": 0.01,
    "mm/s^2": 0.001,
    "gal": 0.01,
    "mgal": 1e-5,
    "in/s^2": 0.0254,
    "ft/s^2": 0.3048,
}


def test_the_table_is_exact() -> None:
    assert UNITS == EXACT


@every(
    ("written", "unit"),
    [
        ("G", "g"),
        ("g's", "g"),
        ("Gal", "gal"),
        ("GALS", "gal"),
        ("cm/s/s", "cm/s^2"),
        ("CM/SEC/SEC", "cm/s^2"),
        ("cm/sec2", "cm/s^2"),
        ("cm/sec**2", "cm/s^2"),
        ("cm s-2", "cm/s^2"),
        ("cm s^-2", "cm/s^2"),
        ("m/s\N{SUPERSCRIPT TWO}", "m/s^2"),
        ("[m/s2]", "m/s^2"),
        ("mm/s/s", "mm/s^2"),
        ("in/sec^2", "in/s^2"),
        ("inch/s2", "in/s^2"),
        ("ft/s^2", "ft/s^2"),
    ],
)
def test_spellings(written: str, unit: str) -> None:
    assert acceleration_unit(written) == unit
    assert in_m_s2(written) == EXACT[unit]


@every(
    ("written", "size"),
    [
        *[("milli g", 9.80665e-3), ("% of g", 9.80665e-2), ("10^-3 g", 9.80665e-3)],
        *[("1e-2 m/s2", 0.01), ("g/10", 0.980665), ("m/(s*s)", 1.0), ("cm/s.s", 0.01)],
        *[("meters per second squared", 1.0), ("ms-2", 1.0), ("\u00b5g", 9.80665e-6)],
        *[("m\u00b7s\u207b\u00b2", 1.0), ("10**-3 g", 9.80665e-3), ("micro g", 9.80665e-6)],
        *[("2 g", 19.6133), ("feet/second/second", 0.3048), ("1/1000 g", 9.80665e-3)],
    ],
)
def test_sizes_with_factors_prefixes_and_powers(written: str, size: float) -> None:
    assert in_m_s2(written) == pytest.approx(size, rel=1e-14)


@every(
    ("written", "size"),
    [
        *[("s", 1.0), ("ms", 1e-3), ("\u03bcs", 1e-6), ("min", 60.0), ("hours", 3600.0)],
        *[("Hz", -1.0), ("kHz", -1e-3), ("sps", -1.0), ("samples per second", -1.0)],
        *[("samples/min", -60.0), ("1/s", -1.0), ("MHz", None), ("g", None), ("UTC", None)],
    ],
)
def test_times_and_rates(written: str, size: float | None) -> None:
    assert in_seconds(written) == (None if size is None else pytest.approx(size, rel=1e-14))


@every(
    "written",
    [
        *["cm/s", "cm", "s", "", "km/s^2", "counts", "volts", "m/s^3", "g^2", "cm/s2 x 10", "g 10"],
        *[
            "g*1000",
            "cm/sec2(04)",
            "x 10 g",
            "Mg",
            "MGal",
            "kg",
            "-g",
            "0 g",
            "g/0",
            "1,5 g",
            "3 4 g",
        ],
        *["milli", "of g", "g per", "10^-3.5 g", "nan g", "9" * 70 + " g", "(g", "g)"],
    ],
)
def test_what_is_no_acceleration(written: str) -> None:
    assert acceleration_unit(written) is None
    with pytest.raises(InputError, match="it must be a unit of acceleration; use one of g, mg"):
        in_m_s2(written)


@every(
    ("component", "azimuth"),
    [
        ("000", 0.0),
        ("360", 0.0),
        ("340 deg", 340.0),
        ("N", 0.0),
        ("E-W", 90.0),
        ("W", 270.0),
        ("N21E", 21.0),
        ("S69E", 111.0),
        ("S14W", 194.0),
        ("N10W", 350.0),
        ("HNE", 90.0),
        ("HN1", None),
        ("H2", None),
        ("H180", 180.0),
        ("0", 0.0),
        ("90", 90.0),
        ("FN", None),
    ],
)
def test_horizontal(component: str, azimuth: float | None) -> None:
    assert direction(component) == ("horizontal", azimuth)


@every("component", ["UP", "DWN", "Up", "U-D", "V", "vert", "HNZ", "BLZ"])
def test_vertical(component: str) -> None:
    assert direction(component) == ("vertical", None)


@every("component", [None, "", "acc (g)", "400", "HN3", "ax", "1", "3"])
def test_unknown(component: str | None) -> None:
    assert direction(component) == (None, None)


def test_the_grammar_of_units() -> None:
    """Sizes by hand: what stands below the stroke, powers in brackets, words and prefixes."""
    for written, size in (
        *(("m/s^(2)", 1.0), ("m s^(-2)", 1.0), ("m*s^-2", 1.0), ("m s^+2", None), ("m/s^+2", 1.0)),
        *(("m/s^02", 1.0), ("m/s^002", None), ("m/s^2.0", None), ("m/s^(2", None), ("m/s^", None)),
        *(("(m)/(s^2)", 1.0), ("((m/s^2))", 1.0), ("m/(s s)", 1.0), ("m/s/(s", None), ("()", None)),
        *(
            ("m/s s", 1.0),
            ("m/s*s", 1.0),
            ("m.s-2", 1.0),
            ("m/s squared", 1.0),
            ("m per s per s", 1.0),
        ),
        *(("1/s^2 m", 1.0), ("/s^2 m", 1.0), ("* g", None), ("g *", None), ("g / ", None)),
        *(
            ("10 g", 98.0665),
            ("10 * 2 g", 196.133),
            ("10 2 g", None),
            ("g * 10", None),
            ("g / 4", 2.4516625),
        ),
        *(
            ("g 10", None),
            ("50%g", None),
            ("50 * %g", 4.903325),
            ("2^2 g", 39.2266),
            ("1e3 mm/s2", 1.0),
            (".5 g", 4.903325),
        ),
        *(
            ("milli g", 9.80665e-3),
            ("milli-g", 9.80665e-3),
            ("milli foot/s2", None),
            ("milli x", None),
        ),
        *(
            ("micro gal", 1e-8),
            ("centi m/s2", 0.01),
            ("standard g", 9.80665),
            ("standard gravity", 9.80665),
        ),
        *(
            ("dm/s2", None),
            ("km/s2", None),
            ("cm/min2", 0.01 / 3600.0),
            ("um/s2", None),
            ("dg", 0.980665),
        ),
        *(
            ("cg", 0.0980665),
            ("mgals", 1e-5),
            ("kg", None),
            ("mgee", 9.80665e-3),
            ("m/s/ms", 1000.0),
        ),
        *(("g samples", None), ("samples g", 9.80665), ("in/s/s", 0.0254), ("feet/s2", 0.3048)),
        *(("gn", 9.80665), ("g0", 9.80665), ("g's", 9.80665), ("MG", 9.80665e-3), ("m/s2.", 1.0)),
        *(("'g'", 9.80665), ("[g]", 9.80665), ("(g) (g)", None), ("ms^-2", None), ("cms-2", 0.01)),
        *(
            ("ft sec-2", 0.3048),
            ("m^1 s^-2", 1.0),
            ("m^2/s^2", None),
            ("m^0 g", 9.80665),
            ("0 g", None),
        ),
        *(
            ("1e999 g", None),
            ("g/0", None),
            ("1" + "*1" * 11 + " g", 9.80665),
            ("1" + "*1" * 12 + " g", None),
        ),
        *(
            (f"{'1' * 57} g", float("1" * 57) * 9.80665),
            (f"{'1' * 59} g", None),
            ("g g/g", 9.80665),
        ),
    ):
        if size is None:
            assert acceleration_unit(written) is None, written
        else:
            assert acceleration_unit(written) is not None, written
            assert in_m_s2(written) == pytest.approx(size, rel=1e-14), written


def test_a_unit_has_one_name() -> None:
    for written, name in (
        *(
            ("Gal", "gal"),
            ("gals", "gal"),
            ("mGal", "mgal"),
            ("mgals", "mgal"),
            ("milligal", "mgal"),
        ),
        *(("cm/s/s", "cm/s^2"), ("0.01 m/s2", "cm/s^2"), ("1e-3 g", "mg"), ("2 G", "2 g")),
        *(("10 mm/s2", "cm/s^2"), ("12 in/s2", "ft/s^2"), ("1.000001 g", "1.000001 g")),
    ):
        assert acceleration_unit(written) == name, written
    for wrong in (None, 3, 1.5, ["g"], "furlong"):
        with pytest.raises(InputError, match=r"^u = .*it must be a unit of acceleration; use one"):
            unit_named(wrong, "u")
    assert unit_named("CM/S/S") == "cm/s^2"


def test_times_and_rates_in_words() -> None:
    for written, size in (
        *(("60 s", 60.0), ("1/2 s", 0.5), ("s s/s", 1.0), ("s^2", None), ("0.5 Hz", -2.0)),
        *(("2/s", -0.5), ("samples / (2 s)", -2.0), ("m", None), ("", None), ("points", None)),
        *(("1/min", -60.0), ("cycles/s", -1.0), ("s^-1", -1.0), ("ks", None), ("us", 1e-6)),
        *((f"{'1' * 56} s", float("1" * 56)), (f"{'1' * 59} s", None), ("hz s hz", -1.0)),
    ):
        assert in_seconds(written) == (None if size is None else pytest.approx(size)), written


def test_units_at_the_beginning_of_words() -> None:
    for text, known, expected in (
        ("g, hut", acceleration_unit, ("g", ", hut")),
        ("g. Hut", acceleration_unit, ("g.", " Hut")),
        ("g", acceleration_unit, ("g", "")),
        ("cm/s2 per count", acceleration_unit, ("cm/s2", " per count")),
        ("hut g", acceleration_unit, (None, "hut g")),
        ("m / s2 x", acceleration_unit, ("m / s2", " x")),
        ("g (s)", acceleration_unit, ("g", " (s)")),
        ("", acceleration_unit, (None, "")),
        ("ms, 3", in_seconds, ("ms", ", 3")),
        ("s", in_seconds, ("s", "")),
        ("g", in_seconds, (None, "g")),
        (" g)", acceleration_unit, ("g", ")")),
        ("sec.;", in_seconds, ("sec.", ";")),
        ("m/s 2", acceleration_unit, (None, "m/s 2")),
        ("m/s 2", quantity_of, ("m/s", " 2")),
        ("cm, x", quantity_of, ("cm", ", x")),
        ("ms", quantity_of, (None, "ms")),
    ):
        assert leading(text, known) == expected, text
    assert leading("ms")[0] is None
    for rest, changed in (
        *((" x 10", True), (" times 2", True), (" * 2", True), ("/2", True), (" 10^3", True)),
        *((" 1e3", True), (", 2", True), (" -2", True), (" 2 hut", True), (" 2nd", False)),
        *((" per volt", True), ("%", True), (" hut", False), ("", False), (" (raised", True)),
        *((" to the 2", True), (" scaled by", True), (" x y", False), (" scales", False)),
    ):
        assert modifies(rest) == changed, rest
