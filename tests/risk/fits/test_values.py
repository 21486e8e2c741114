"""Numbers of fits in words."""

import math

from rocksteady.risk.fits._values import range_words, value_words


def test_a_number_has_its_unit_and_its_band() -> None:
    assert value_words(0.25, "g", None) == "0.25 g"
    assert value_words(0.25, "", (0.2, 0.3)) == "0.25 (0.2 to 0.3)"
    assert "g" not in value_words(math.nan, "g", None)
    assert range_words((0.1, 0.5), "m/s") == "0.1 to 0.5 m/s"
