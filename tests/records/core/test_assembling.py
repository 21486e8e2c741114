"""What a file states against what the caller gives, and the doubts about units and samples."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import Recording
from rocksteady.records.core.assembling import Channel, Given, built, interval, unit
from rocksteady.records.core.text import RecordText
from tests.records import refused
from tests.records.formats.networks import CM, read
from tests.records.writers import smc

G = 9.80665
TEXT = RecordText(path=Path("hut.txt"), lines=("head", "1 2"))
CHANNEL: dict[str, Any] = {"values": np.array([0.5, -1.0, 0.25]), "units": "g", "dt_s": 0.01}


def made(text: RecordText = TEXT, given: Given | None = None, **fields: Any) -> Recording:
    """Return what is built of three samples in g, with any field as given."""
    return built(text, "csv", Channel(**{**CHANNEL, **fields}), given or Given())


def test_an_interval_other_than_the_stated_one_is_refused(tmp_path: Path) -> None:
    for factor in (1.0, 1.0 + 1e-8):
        (found,) = read(tmp_path, smc(CM), dt_s=0.005 * factor)
        assert (found.record.dt_s, found.warnings) == (0.005 * factor, ())
    for factor in (1.0 - 1e-5, 1.0 + 1e-5, 2.0):
        words = f"the file states 0.005 s between samples, and dt_s {0.005 * factor:g} s; leave out"
        with refused("contradiction", words):
            read(tmp_path, smc(CM), dt_s=0.005 * factor)


def test_intervals_that_are_unusual_or_none() -> None:
    for stated, usual in ((1e-4, True), (0.99e-4, False), (0.1, True), (0.1001, False)):
        words = f"samples {stated:g} s apart are unusual: see whether the header is right"
        assert interval(TEXT, stated, Given()) == (stated, () if usual else (words,)), stated
        assert interval(TEXT, stated, Given(dt_s=stated)) == (stated, ())
    assert interval(TEXT, None, Given(dt_s=3.0)) == (3.0, ())
    with refused(
        "contradiction",
        "the file states 0.01 s between samples, and dt_s 0.02 s; leave out dt_s where the file is "
        "right, else read it with ignore_header",
    ):
        interval(TEXT, 0.01, Given(dt_s=0.02))
    for wrong, words in (
        (None, "the file does not state the interval between samples; give dt_s, in seconds"),
        (0.0, "that it states, 0 s, is not above 0; correct it in the file"),
        (-0.01, "that it states, -0.01 s, is not above 0; correct it in the file"),
    ):
        with refused("", words):
            interval(TEXT, wrong, Given())


def test_units_of_the_file_and_of_the_caller() -> None:
    assert unit(TEXT, "G", Given()) == "g"
    for given, name in (("cm/s/s", "cm/s^2"), ("gal", "gal"), ("0.01 m/s2", "cm/s^2")):
        assert unit(TEXT, "gal", Given(units=given)) == name
    with refused(
        "contradiction",
        r"states that its numbers are in cm/s\^2, and units in g; leave out units where the file "
        "is right, else read it with ignore_header",
    ):
        unit(TEXT, "cm/s2", Given(units="G"))
    for stated in (None, "furlongs"):
        assert unit(TEXT, stated, Given(units="mg")) == "mg"
    with refused("", "does not state the unit of its numbers; give units"):
        unit(TEXT, None, Given())
    with refused("", "the unit that the file states, 'furlongs', is not understood; give units"):
        unit(TEXT, "furlongs", Given())
    for stated, quantity in (("volts", "counts"), ("cm/s", "velocity"), ("mm", "displacement")):
        for whatever in (Given(), Given(units="mg")):
            with refused(quantity, f"its numbers are in {stated}: {quantity}, and the base moves"):
                unit(TEXT, stated, whatever)


def test_the_size_of_a_peak_is_doubted_and_then_refused() -> None:
    words = "more than any earthquake has caused: see whether its numbers are in g"
    for peak, doubts in ((9.99, ()), (10.01, (f"its peak is 10 g, {words}",))):
        for sign in (1.0, -1.0):
            assert made(values=sign * np.array([0.5, peak, 0.1])).warnings == doubts, peak
    assert len(made(values=np.array([0.5, -999.0, 0.1])).warnings) == 1
    with pytest.raises(
        RecordFileError, match=r"a peak of 1e.03 g is none of a record; see whether"
    ):
        made(values=np.array([0.5, -1001.0, 0.1]))
    with pytest.raises(RecordFileError, match=r"its samples are no record, .*whole file"):
        made(values=np.zeros(3))


def test_a_peak_may_be_a_hundredth_off_the_stated_one() -> None:
    for peak, agrees in ((0.9901, True), (0.989, False), (1.0099, True), (1.011, False)):
        for sign in (1.0, -1.0):
            result = made(values=np.array([0.1, -peak, 0.2]), stated_peak=sign)
            assert result.stated_peak_m_s2 == pytest.approx(G)
            words = f"its peak is {peak * G:.6g} m/s^2, and the header states 9.80665 m/s^2"
            assert result.warnings == (() if agrees else (words,)), (peak, sign)
    assert made().stated_peak_m_s2 is None


def test_a_last_sample_that_stands_out_of_twenty() -> None:
    for count, last, doubted in (
        *((20, 0.61, True), (20, -0.61, True), (20, 0.59, False), (19, 0.9, False)),
        *((21, 0.61, True), (300, -0.59, False)),
    ):
        values = np.full(count, 0.1)
        values[count // 2] = -0.4
        values[-1] = last
        words = ("its last sample is its peak by far: see whether the file is cut inside it",)
        assert made(values=values).warnings == (words if doubted else ()), (count, last)


def test_a_channel_that_is_positive_downwards_is_turned() -> None:
    rows: list[tuple[dict[str, Any], float, str]] = [
        ({"orientation": "vertical", "down": True, "component": "ch"}, -1.0, "ch"),
        ({"orientation": "vertical", "down": True}, -1.0, "file's name"),
        ({"orientation": "vertical", "down": False}, 1.0, ""),
        ({"orientation": "vertical"}, 1.0, ""),
        ({"component": "DWN"}, -1.0, "DWN"),
        ({"component": "DWN", "processing": ("first",)}, -1.0, "DWN"),
    ]
    for fields, sign, component in rows:
        result = made(**fields)
        assert result.orientation == "vertical"
        np.testing.assert_allclose(
            result.record.acceleration_m_s2, sign * G * np.array([0.5, -1.0, 0.25]), rtol=1e-14
        )
        words = f"sign changed: {component} is positive downwards, and vertical motion upwards"
        first = fields.get("processing", ())
        assert result.processing == (*first, *((words,) if sign < 0.0 else ())), fields


def test_directions_of_codes_words_and_names() -> None:
    """A code goes before words, both before the file's name; one degree is no contradiction."""
    north: dict[str, Any] = {"orientation": "horizontal", "azimuth_deg": 0.0}
    for component, apart in (
        *(("001", ""), ("359", ""), ("360", ""), ("002", "2 deg"), ("358", "358 deg")),
        *(("180", "180 deg"), ("H1", ""), ("sensor", "")),
    ):
        result = made(component=component, **north)
        words = f"the channel is called {component!r}, {apart}, and its code in the header states "
        assert result.warnings == ((f"{words}0 deg: the code is taken",) if apart else ())
        assert (result.orientation, result.azimuth_deg) == ("horizontal", 0.0)
    assert made(orientation="horizontal", azimuth_deg=370.0).azimuth_deg == 10.0
    named = RecordText(path=Path("hut-UP.txt"), lines=())
    of_names: list[tuple[str | None, bool, tuple[str, ...]]] = [
        (None, True, ()),
        ("UP", True, ()),
        ("vertical", True, ()),
        ("DWN", False, ()),
        *(
            (name, True, (f"the file's name states {differs} ({name}): the header is taken",))
            for name, differs in (
                ("DWN", "upwards, and its header downwards"),
                ("090", "vertical, and its header horizontal"),
            )
        ),
    ]
    for label, alone, expected in of_names:
        assert made(named, component=label, alone=alone).warnings == expected, label
    down = RecordText(path=Path("hut-DWN.txt"), lines=())
    by_name = "the file's name alone states that its values are positive downwards"
    for label, turned in ((None, True), ("acc 1", True), ("hut", False)):
        result = made(down, component=label)
        odd = (f"where its channel points, {label!r}, is not understood",)
        assert result.warnings == ((by_name,) if turned else odd), label
        assert (result.record.acceleration_m_s2[0] < 0.0) == turned
        of_many = made(down, component=label, alone=False)
        assert of_many.warnings == (() if turned else odd), label


def test_what_the_caller_gives_is_looked_at_first() -> None:
    assert Given(dt_s=1).dt_s == 1.0
    refused: list[tuple[dict[str, Any], str]] = [
        ({"dt_s": 0.0}, "give the time between samples in seconds"),
        ({"dt_s": -0.01}, "give the time between samples in seconds"),
        ({"dt_s": True}, "give the time between samples in seconds"),
        ({"units": "furlong"}, "it must be a unit of acceleration"),
    ]
    for wrong, words in refused:
        with pytest.raises(ValueError, match=re.escape(words)):
            Given(**wrong)
    defaults = Given()
    assert (defaults.units, defaults.dt_s, defaults.column) == (None, None, None)
    assert defaults.resample is False
