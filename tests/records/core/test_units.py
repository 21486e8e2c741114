"""Units of acceleration however they are written, and directions by any name."""

import pytest

from rocksteady.errors import InputError
from rocksteady.records.core.directions import direction
from rocksteady.records.core.units import UNITS, acceleration_unit, in_m_s2, in_seconds
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
