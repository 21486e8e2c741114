"""A recording describes itself: keys, name and title."""

from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.records import Recording
from tests.cli.motion_files import samples
from tests.records import recording


def hut(**fields: Any) -> Recording:
    return recording(9.80665 * samples(), 0.02, **fields)


def test_the_values_keep_the_contract() -> None:
    start = datetime(2020, 1, 2, 3, 4, 5, tzinfo=UTC)
    one = hut(component="090", orientation="horizontal", azimuth_deg=90.0, start_time=start)
    values = one.to_dict()
    assert (values["format"], values["npts"], values["dt_s"]) == ("csv", 601, 0.02)
    assert (values["file"], values["units_in_file"]) == ("hut.csv", "g")
    assert values["duration_s"] == pytest.approx(12.0)
    assert datetime.fromisoformat(values["start_time"]) == start
    assert (values["warnings"], values["processing"]) == ([], [])
    bare = hut().to_dict()
    assert {bare[name] for name in ("component", "azimuth_deg", "start_time", "station")} == {None}


def test_a_channel_has_a_name_and_a_title() -> None:
    assert hut().name == "hut.csv"
    assert hut(component="hut").name == "hut.csv"
    named = hut(component="090", event="Town  1990", station="Hut")
    assert named.name == "hut.csv 090"
    assert named.title == "Town 1990, Hut, 090"
    assert hut().title == "hut.csv"
    assert repr(named) == "<Recording: Town 1990, Hut, 090>"


def test_the_summary_has_what_was_done_and_what_is_odd() -> None:
    one = hut(stated_peak_m_s2=5.9, processing=("mean taken off",), warnings=("it is odd",))
    text = one.summary()
    for words in ("peak stated", "5.9 m/s^2", "mean taken off", "601 every 0.02 s, 12 s, in g"):
        assert words in text
    assert text.endswith("it is odd")
    long = replace(one, record=Record(acceleration_m_s2=np.ones(4800), dt_s=0.01))
    assert "4,800 every 0.01 s" in long.summary()
    assert one.to_dict()["processing"] == ["mean taken off"]
    assert np.abs(one.record.acceleration_m_s2).max() > 0.0


def test_every_fact_has_its_key_and_its_words() -> None:
    start = datetime(2020, 1, 2, 3, 4, 5, tzinfo=UTC)
    single = hut(
        component="UP",
        orientation="vertical",
        station="Hut",
        event="Town",
        start_time=start,
        stated_peak_m_s2=5.9,
        processing=("first", "second"),
        warnings=("it is odd",),
    )
    values = single.to_dict()
    fields = ("orientation", "station", "event", "component")
    assert [values[name] for name in fields] == ["vertical", "Hut", "Town", "UP"]
    assert (values["stated_peak_m_s2"], values["start_time"]) == (5.9, "2020-01-02T03:04:05+00:00")
    assert values["processing"] == ["first", "second"]
    assert values["warnings"] == ["it is odd"]
    assert values["npts"] == 601
    text = single.summary()
    assert text.startswith("Town, Hut, UP")
    for words in ("hut.csv (csv)", "first", "second", "peak stated"):
        assert words in text
    assert "peak stated" not in hut().summary()
    again = single.processed(hut().record, "third")
    assert again.processing == ("first", "second", "third")
    assert again.warnings == single.warnings
