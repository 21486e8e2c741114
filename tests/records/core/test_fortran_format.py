"""Fortran's formats as headers state them."""

from rocksteady.records.core.fortran_format import fixed_values, stated_width


def test_formats_of_fortran() -> None:
    assert stated_width("100 Integer-header values follow on 10 lines, Format= (10I8)") == 8
    assert stated_width("in cm/sec2. (8f10.6)") == 10
    assert stated_width("Format=(1P5E15.7)") == 15
    assert stated_width("no format (here)") is None
    assert fixed_values((" 1.0 2.0    ", "-999x"), 4) == [1.0, 2.0, -999.0, None]
