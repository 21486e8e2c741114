"""Words of base motions: what is told of them, and tables of both components."""

import math

import numpy as np
import pytest

from rocksteady import BaseMotion, Harmonic, Record
from rocksteady.model.motions.segments import Piecewise, Segment
from rocksteady.seismic.measures.motion_course import motion_course
from rocksteady.words.motions import describe_motion, to_dataframe

PERIOD = 2.0 * math.pi / 5.0
HARMONIC = Harmonic(amplitude=2.0, frequency_ratio=5.0, phase=0.3)
BOX = Piecewise(pieces=(Segment(duration=1.0, constant=1.5), Segment(duration=3.0, constant=-0.5)))


def test_what_is_told_of_a_motion_that_ends_and_of_one_that_does_not() -> None:
    told = {fact.key: fact for fact in describe_motion(BOX).facts}
    assert told["duration_pt"].value == 4.0
    assert told["duration_pt"].text == "pt = 4"
    assert told["peak_acceleration"].value == 1.5
    assert told["peak_velocity"].value == pytest.approx(1.5)
    assert told["peak_displacement"].value == pytest.approx(3.0)
    assert "alpha g/p^2" in told["peak_displacement"].words
    endless = {fact.key: fact for fact in describe_motion(HARMONIC).facts}
    assert endless["duration_pt"].value is None
    assert endless["duration_pt"].text == "endless"
    assert endless["peak_acceleration"].value == pytest.approx(2.0, rel=2e-3)
    constant = Piecewise(pieces=(Segment(duration=math.inf, constant=1.0),))
    assert {f.key: f.text for f in describe_motion(constant).facts}["duration_pt"] == "endless"


def test_velocity_that_is_left_over_moves_the_ground_no_further_in_what_is_told() -> None:
    """The largest displacement is until the end, and not that of the rows after it."""
    push = Piecewise(pieces=(Segment(duration=2.0, constant=1.0),))
    told = {fact.key: fact.value for fact in describe_motion(push).facts}
    assert told["peak_displacement"] == pytest.approx(2.0)
    assert motion_course(push).displacement[-1] == pytest.approx(2.0 + 2.0 * 0.2)
    # Without a step at the end there is no row just before it: the end itself counts.
    pieces = Segment(duration=1.0, slope=1.0), Segment(duration=1.0, constant=1.0, slope=-1.0)
    told = {fact.key: fact.value for fact in describe_motion(Piecewise(pieces=pieces)).facts}
    peaks = [told[f"peak_{name}"] for name in ("acceleration", "velocity", "displacement")]
    assert peaks == pytest.approx([1.0, 1.0, 1.0], rel=1e-12)


def record(count: int, dt_s: float, name: str) -> Record:
    values = np.sin(np.arange(1.0, count + 1.0))
    return Record(acceleration_m_s2=values, dt_s=dt_s, name=name)


def test_both_components_are_told_and_tabled_under_their_names() -> None:
    across, up = record(30, 0.02, "across"), record(45, 0.01, "up")
    told = describe_motion(BaseMotion(across, up))
    keys = [fact.key for fact in told.facts]
    single = [fact.key for fact in describe_motion(across).facts]
    assert keys == [*single, *(f"vertical_{key}" for key in single)]
    values = {fact.key: fact.value for fact in told.facts}
    assert values["vertical_pga_m_s2"] == up.peak_acceleration_m_s2
    assert "vertical PGA" in [fact.label for fact in told.facts]
    assert told.headline.endswith(", with a vertical motion")
    assert describe_motion(BaseMotion(across)) == describe_motion(across)
    table = to_dataframe(BaseMotion(across, up))
    assert "arias_m_s" not in table
    assert table["t_s"].is_monotonic_increasing
    assert len(table) == len(set(0.02 * np.arange(30)) | set(0.01 * np.arange(45)))
    known = table["vertical_acceleration_m_s2"].dropna()
    assert known.tolist() == up.acceleration_m_s2.tolist()
    assert to_dataframe(BaseMotion(across)).equals(to_dataframe(across))


def test_the_history_of_a_motion_is_its_table() -> None:
    frame = HARMONIC.to_dataframe()
    assert list(frame) == ["pt", "acceleration", "velocity", "displacement"]
    for name, values in motion_course(HARMONIC)._asdict().items():
        assert frame[name].tolist() == values.tolist()
