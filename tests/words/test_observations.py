"""Words of tests and of their objects: counts, keys, defaults and warnings."""

import numpy as np
import pytest

from rocksteady.risk.observations.object_prior import ObjectPrior
from tests.risk.observations.test_observations import made


def test_usual_tests_have_no_warnings_and_defaults_are_named() -> None:
    shaken = made()
    assert shaken.warnings == ()
    notes = shaken.describe().notes
    words = "not given, so that calibrate takes priors as wide as geometry allows."
    assert f"base, offset, housner_factor, scatter: {words}" in notes
    assert f"housner_factor, scatter: {words}" in shaken.of("vase").describe().notes


def test_tests_in_words_and_keys() -> None:
    shaken = made(gain=1.5, session="day 1", sigma_ln=0.1)
    values = shaken.to_dict()
    assert (values["tests"], values["records"], values["groups"]) == (4, 2, 2)
    assert values["sources"] == {"a": "0"}
    assert values["objects"] == ["column", "vase"]
    row = values["rows"][1]
    for key, value in (
        *(("test", "t1"), ("object", "column"), ("record", "b"), ("outcome", "stood")),
        *(("gain", 1.5), ("session", "day 1"), ("sigma_ln", 0.1), ("group", "b")),
        *(("vertical", None), ("peak_rad", None), ("sigma_rad", None)),
    ):
        assert row[key] == value, key
    text = shaken.summary()
    assert "2 fell, 1 stood, 1 unknown" in text
    lines = text.splitlines()
    (heading,) = (line for line in lines if "outcome" in line and "gain" in line)
    assert heading.split() == ["test", "object", "record", "gain", "outcome"]
    first = next(line for line in lines if "t0" in line)
    for words, name in (("t0", "test"), ("column", "object"), ("fell", "outcome")):
        assert first.index(words) == heading.index(name)
    assert first.index("1.5") + 3 == heading.index("gain") + 4
    only = shaken.subset([0, 3])
    assert repr(only) == "<Observations: 2 tests of 2 objects on 2 records: 2 fell>"
    assert repr(only.of("vase")) == "<Observations: 1 test of 1 object on 1 record: 1 fell>"


def test_an_object_in_words_and_keys() -> None:
    given = ObjectPrior(name="column", width_m="0.15:0.17", height_m=0.6, base="0.9+-0.05")
    values = given.to_dict()
    assert values["name"] == "column"
    assert values["outline_alpha_rad"] == pytest.approx(np.arctan(0.16 / 0.6))
    rows = {row["parameter"]: row for row in values["parameters"]}
    assert (rows["width_m"]["low"], rows["width_m"]["high"]) == (0.15, 0.17)
    assert (rows["width_m"]["from"], rows["offset"]["from"]) == ("given", "default")
    assert (rows["base"]["mean"], rows["base"]["sd"], rows["width_m"]["mean"]) == (0.9, 0.05, None)
    assert f"{len(given.parameters)} numbers not exact" in repr(given)
    (shown,) = given.describe().tables
    assert all(column.left for column in shown.columns)
    assert [column.heading for column in shown.columns] == ["parameter", "spread", "from"]
    assert given.outline_radius_m == pytest.approx(0.5 * np.hypot(0.16, 0.6))
    unlike = ObjectPrior(name="o", left_m=0.2, right_m=0.1, mass_centre_height_m=0.5)
    assert unlike.outline_alpha_rad == pytest.approx(np.arctan(0.2))
    assert unlike.outline_radius_m == pytest.approx(np.hypot(0.1, 0.5))
    angled = ObjectPrior(name="o", alpha_rad=0.2, p_rad_s=2.0)
    assert angled.outline_alpha_rad == 0.2
    assert angled.outline_radius_m == pytest.approx(0.75 * 9.80665 / 4.0)
    centred = ObjectPrior(name="o", width_m=0.2, height_m=1.0, mass_centre_height_m=0.4)
    assert centred.outline_alpha_rad == pytest.approx(np.arctan(0.25))
