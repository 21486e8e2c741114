"""Outputs: what they say of themselves, and what they refuse."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.sweep.cases.outputs import Output
from tests.every import every


def test_classes_say_what_they_mean() -> None:
    attributes = Output(
        name="kind", dtype=np.int8, long_name="what it is", flags={0: "at rest", 2: "overturned"}
    ).attributes
    assert attributes["flag_values"].dtype == np.int8
    assert attributes["flag_values"].tolist() == [0, 2]
    assert attributes["flag_meanings"] == "at_rest overturned"
    assert (attributes["long_name"], attributes["units"]) == ("what it is", "1")


def test_a_float_has_no_flags() -> None:
    with pytest.raises(InputError, match="only integers have flags"):
        Output(name="kind", flags={0: "rest"})


@every("flags", [{0: "rest", 1.5: "falls"}, {"0": "rest"}, {0: 1}, {0: None}])
def test_each_whole_number_has_its_meaning_in_words(flags: Any) -> None:
    with pytest.raises(InputError, match=r"flags: .* (whole number|text); give"):
        Output(name="kind", dtype=np.int8, flags=flags)


@every("dtype", [np.complex128, "U3", object, "datetime64[s]"])
def test_an_output_is_a_number_or_a_truth(dtype: Any) -> None:
    with pytest.raises(InputError, match="boolean, integer or float"):
        Output(name="kind", dtype=dtype)


def test_what_is_not_computed_is_no_number_that_could_be() -> None:
    assert math.isnan(Output(name="a").nothing)
    assert Output(name="a", dtype=np.int8).nothing == -128
    assert Output(name="a", dtype=np.uint8).nothing == 0
    assert Output(name="a", dtype=np.bool_).nothing is False
