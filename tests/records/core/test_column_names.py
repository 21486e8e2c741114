"""Names of columns: which are times or accelerations, in which unit, and which are refused."""

from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records.core.column_names import column_name
from rocksteady.records.core.units import in_m_s2
from tests.every import every
from tests.records.tables import THREE, G, read


@every(
    ("name", "size"),
    [
        ("acc (milli g)", 1e-3 * G),
        ("acc (10^-3 g)", 1e-3 * G),
        ("acc (1e-3 g)", 1e-3 * G),
        ("acc (0.001 g)", 1e-3 * G),
        ("acc (10\u207b\u00b3 g)", 1e-3 * G),
        ("acc (% of g)", 1e-2 * G),
        ("acc (%g)", 1e-2 * G),
        ("acc (1e-2 m/s2)", 1e-2),
        ("acc (\u00b5g)", 1e-6 * G),
        ("acc_milli_g", 1e-3 * G),
        ("acc/(m/s2)", 1.0),
        ("acc [cm s\u207b\u00b2]", 1e-2),
        ("acc (g/1000)", 1e-3 * G),
        ("acc [0.5g]", 0.5 * G),
        ("acc (units of g)", G),
        ("ug'' (m/s2)", 1.0),
        ("d2u/dt2 (m/s2)", 1.0),
    ],
)
def test_units_with_factors_are_understood_as_a_whole(
    tmp_path: Path, name: str, size: float
) -> None:
    (found,) = read(tmp_path, f"time (s),{name}\n0,1.0\n0.01,-2.5\n0.02,0.5\n")
    np.testing.assert_allclose(found.record.acceleration_m_s2, np.array(THREE) * size, rtol=1e-14)


@every(
    "name",
    [
        *("acc (cm/s2 x 10)", "1000*acc (g)", "acc x 1000 (g)", "acc (x1000) (g)", "acc (g x 10)"),
        *("acc^2 (g)", "acc\u00b2 (g)", "acc (g^2)", "-acc (g)", "|acc| (g)", "milli acc (g)"),
        *("acc_m_g", "acc_cm/s2 (g)", "acc/9.81 (g)", "scaled acc (g)"),
        *("acc (Mg)", "acc (gal) (g)", "acc (g or m/s2)", "acc (g) E-3", "acc (g) e-2"),
        *("accE3 (g)", "acc (g)\u00b71000", "acc [g] 1:10", "acc (g, 1/10)", "acc (gal, g)"),
        *("acc (g) (doubled)", "acc (g) (half)", "acc (g) (reversed)", "acc (g) (opposite sign)"),
        *("acc (g) flipped", "neg acc (g)", "acc (g) + 0.1", "d(acc)/dt (g)", "acc -x (g)"),
        *("acc 100 (g)", "acc wobbled (g)", "acc BY10 (g)", "Z- (g)"),
    ],
)
def test_what_is_not_understood_as_a_whole_is_refused(tmp_path: Path, name: str) -> None:
    text = f"time (s),{name}\n0,1.0\n0.01,-2.5\n0.02,0.5\n"
    with pytest.raises(RecordFileError):
        read(tmp_path, text)
    (given,) = read(tmp_path, text, units="mg", column=2)
    assert given.record.acceleration_m_s2[0] == pytest.approx(1e-3 * G)


@every(
    ("name", "quantity"),
    [
        *(
            ("acc (LSB)", "counts"),
            ("acc (counts)", "counts"),
            ("acc_counts", "counts"),
            ("vel (cm/s)", "velocity"),
        ),
        *(("SA (g)", "spectra"), ("PSA (g)", "spectra"), ("Sa(T1) (g)", "spectra")),
        *(("pseudo-acceleration (g)", "spectra"), ("spectral acc (g)", "spectra")),
        *(
            (f"{name} (g)", "another quantity")
            for name in (
                *("max acc", "log acc", "cumulative acc", "PGA", "acc error", "acc uncertainty"),
                *("acc noise", "acc sigma", "acc residual", "acc diff", "acc coefficient", "tilt"),
                *("Acceleration Response", "accuracy"),
            )
        ),
    ],
)
def test_another_quantity_is_refused(tmp_path: Path, name: str, quantity: str) -> None:
    text = f"time (s),{name}\n0,1.0\n0.01,-2.5\n0.02,0.5\n"
    assert column_name(name).quantity == quantity
    for units in (None, "mg"):
        with pytest.raises(RecordFileError) as found:
            read(tmp_path, text, units=units)
        assert quantity in {found.value.kind, "another quantity"}
    with pytest.raises(RecordFileError):
        read(tmp_path, text, units="mg", column=2)


@every(
    ("name", "step"),
    [
        *[("time (min)", 60.0), ("time (h)", 3600.0), ("time (us)", 1e-6), ("time (cs)", 0.01)],
        *[("t (10^-3 s)", 1e-3), ("t/ms", 1e-3), ("time_ms", 1e-3), ("time (\u00b5s)", 1e-6)],
        *[("time hours", 3600.0), ("ms", 1e-3), ("t", 1.0), ("time since start", 1.0)],
        *[("elapsed time (s)", 1.0), ("Elapsed (ms)", 1e-3), ("elapsed_time_ms", 1e-3)],
        *[("Seconds (s)", 1.0), ("sec [sec]", 1.0)],
    ],
)
def test_units_of_time(tmp_path: Path, name: str, step: float) -> None:
    (found,) = read(tmp_path, f"{name},acc (g)\n0,1.0\n10,-2.5\n20,0.5\n")
    assert found.record.dt_s == pytest.approx(10.0 * step, rel=1e-12)


@every(
    "name",
    [
        *("acc (g)", "a_g", "accNS (g)", "AccelX (g)", "Acceleration Ch 1 (g)", "acc. X [g]"),
        *("EW (g)", "N21E (g)", "acc 090 (g)", "acc - x (g)", "TCU054-N (g)", "a(t) (g)"),
        *(
            "HN.STA..HNZ (g)",
            "ground acceleration (g)",
            "u_g'' (g)",
            "\u00fcg (g)",
            "g",
            "acc N/S (g)",
        ),
    ],
)
def test_names_of_known_words(tmp_path: Path, name: str) -> None:
    (found,) = read(tmp_path, f"time (s),{name}\n0,1.0\n0.01,-2.5\n0.02,0.5\n")
    assert found.record.acceleration_m_s2.tolist() == [G * value for value in THREE]


@every(
    "name",
    [
        *(
            "time (UTC)",
            "time (Hz)",
            "t^2 (s)",
            "time (s x 10)",
            "t (g)",
            "t/T",
            "t/Tn",
            "time (-)",
        ),
        *("time/period", "time ratio", "time fraction", "time lag", "time (s or ms)", "time (%)"),
    ],
)
def test_times_in_no_unit_of_time_are_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(RecordFileError, match="line 1, "):
        read(tmp_path, f"{name},acc (g)\n0,1.0\n0.01,-2.5\n0.02,0.5\n")


def test_what_a_name_states() -> None:
    for name, kind, label, unit, seconds in (
        ("acc (g)", "acceleration", "acc", "g", None),
        ("acc_cm/s2", "acceleration", "acc", "cm/s^2", None),
        ("acc in m/s2", "acceleration", "acc", "m/s^2", None),
        ("acc 0.3 g", "acceleration", "acc 0.3 g", None, None),
        ("acc 5 mg", "acceleration", "acc 5 mg", None, None),
        ("acc 0.01 g", "acceleration", "acc", "0.01 g", None),
        ("acc 1e-2 g", "acceleration", "acc", "1e-2 g", None),
        ("acc 10^-3 g", "acceleration", "acc", "mg", None),
        ("N-S (g)", "acceleration", "N-S", "g", None),
        ("acc (N) (g)", "acceleration", "acc (N)", "g", None),
        ("(g)", "acceleration", "", "g", None),
        ("ug", "unknown", "ug", None, None),
        ("foo", "unknown", "foo", None, None),
        ("foo (g)", "acceleration", "foo", "g", None),
        ("foo (N)", "acceleration", "foo (N)", None, None),
        ("foo (-)", "unknown", "foo", None, None),
        ("UP", "acceleration", "UP", None, None),
        ("vel (cm/s)", "other", "vel", None, None),
        ("SA (g)", "other", "SA", "g", None),
        ("SA (g) (gal)", "other", "SA", None, None),
        ("SA (0.2 s) (g)", "other", "SA", "g", None),
        ("time (ms)", "time", "time", None, 1e-3),
        ("time", "time", "time", None, None),
        ("t in ms", "time", "t in ms", None, 1e-3),
        ("time of day", "time", "time of day", None, None),
        ("time (s) (ms)", "time", "time", None, None),
        ("time_ms (ms)", "time", "time_ms", None, 1e-3),
        ("s", "time", "s", None, 1.0),
        ("ms", "time", "ms", None, 1e-3),
        ("min", "other", "min", None, None),
        ("acc (g) - Plot 1", "acceleration", "acc", "g", None),
    ):
        result = column_name(name)
        assert (result.kind, result.label) == (kind, label), (name, result)
        assert (result.unit is None) == (unit is None), (name, result)
        assert result.unit is None or in_m_s2(result.unit) == in_m_s2(unit or ""), (name, result)
        assert result.seconds == seconds, (name, result)
    for name, uncertain in (
        *(("1000*acc (g)", "1000*acc"), ("acc (g)", ""), ("time of day", "day")),
        *(
            ("time (s) (ms)", "s, ms"),
            ("time (UTC)", "UTC"),
            ("time (Hz)", "Hz"),
            ("t (0 s)", "0 s"),
        ),
        *(("acc (g) (gal)", "g, gal"), ("acc (x10) (g)", "x10"), ("acc (raw) (g)", "")),
        *(
            ("acc (raw)", "raw"),
            ("acc (cm/s2) (gal)", ""),
            ("acc x 10", "acc x 10"),
            ("foo x 10", ""),
        ),
        *(
            ("time since start", ""),
            ("time (s)", ""),
            ("time lag", "lag"),
            ("acc_gal (g)", "g, gal"),
        ),
    ):
        assert column_name(name).uncertain == uncertain, (name, column_name(name))


def test_the_first_word_of_a_name_that_is_not_known() -> None:
    for name, leftover in (
        *(("acc (g)", ""), ("acc wobbled more (g)", "wobbled"), ("acc (wobbled) (g)", "wobbled")),
        *(
            ("acc 10 (g)", "10"),
            ("acc 100 (g)", "100"),
            ("acc 360 (g)", ""),
            ("acc 361 (g)", "361"),
        ),
        *(("acc 45 (g)", ""), ("acc 5 (g)", ""), ("ch12 (g)", ""), ("ch123 (g)", "ch123")),
        *(("TCU054 (g)", ""), ("TCUABC054 (g)", "TCUABC054"), ("BY10 (g)", "BY10"), ("A1 (g)", "")),
        *(
            ("acc -x (g)", "acc -x"),
            ("accx", ""),
            ("acc 1:10 (g)", "acc 1:10"),
            ("acc e5 (g)", "acc e5"),
        ),
        *(("foo1 (g)", "foo1"), ("100 (g)", "100"), ("090 (g)", ""), ("10 deg (g)", "10")),
    ):
        assert column_name(name).leftover == leftover, (name, column_name(name))
