"""Base motions: units, validation, and what they lower to."""

import dataclasses
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block, Harmonic, Piecewise, Still
from rocksteady.errors import InputError, ModelError
from rocksteady.model.motions.segments import segments_of
from rocksteady.motions import Segment
from tests.every import every
from tests.strategies import logarithmic

BLOCK = Block.from_p(alpha=0.2, p=3.0, restitution=0.8)


@given(logarithmic(1e-3, 1e3), logarithmic(0.02, 50.0), st.floats(-10.0, 10.0))
def test_harmonic_shaking_in_si_and_back(
    acceleration: float, frequency: float, phase: float
) -> None:
    motion = Harmonic.from_si(
        BLOCK, acceleration_m_s2=acceleration, frequency_hz=frequency, phase=phase
    )
    assert motion.acceleration_m_s2(BLOCK) == pytest.approx(acceleration, rel=1e-14)
    assert motion.frequency_hz(BLOCK) == pytest.approx(frequency, rel=1e-14)
    assert motion.phase == phase
    # alpha g lifts the block, and Omega is omega/p
    assert motion.amplitude == pytest.approx(acceleration / (0.2 * 9.80665), rel=1e-14)
    assert motion.frequency_ratio == pytest.approx(2.0 * math.pi * frequency / 3.0, rel=1e-14)


def test_a_frequency_out_of_range_is_reported_in_hertz() -> None:
    with pytest.raises(InputError, match=r"^frequency_hz = 1e-05 .*p = 3 rad/s"):
        Harmonic.from_si(BLOCK, acceleration_m_s2=1.0, frequency_hz=1e-5)


@every(
    ("name", "value"),
    [
        ("amplitude", -1.0),
        ("amplitude", math.nan),
        ("amplitude", math.inf),
        ("amplitude", 1e60),
        ("amplitude", "2"),
        ("amplitude", True),
        ("frequency_ratio", 0.0),
        ("frequency_ratio", -4.0),
        ("frequency_ratio", 0.009),
        ("frequency_ratio", 10001.0),
        ("frequency_ratio", math.nan),
        ("frequency_ratio", math.inf),
        ("frequency_ratio", "4"),
        ("phase", math.nan),
        ("phase", math.inf),
        ("phase", None),
    ],
)
def test_bad_shaking_is_refused(name: str, value: Any) -> None:
    arguments: dict[str, Any] = {"amplitude": 2.0, "frequency_ratio": 4.0, name: value}
    with pytest.raises(InputError, match=f"^{name} = "):
        Harmonic(**arguments)


@every(
    ("name", "value"), [("acceleration_m_s2", -1.0), ("frequency_hz", 0.0), ("frequency_hz", -1.0)]
)
def test_bad_shaking_in_si_is_refused(name: str, value: float) -> None:
    arguments = {"acceleration_m_s2": 1.0, "frequency_hz": 1.0, name: value}
    with pytest.raises(InputError, match=f"^{name} = "):
        Harmonic.from_si(BLOCK, **arguments)


def test_harmonic_shaking_is_one_endless_segment() -> None:
    (segment,) = Harmonic(amplitude=2, frequency_ratio=4, phase=0.5).segments()
    assert segment == Segment(duration=math.inf, amplitude=2.0, frequency=4.0, phase=0.5)


def test_a_still_base_has_no_segment() -> None:
    assert Still().segments() == ()
    assert Piecewise().segments() == ()


@given(st.floats(-5.0, -1e-3), st.floats(-5.0, 5.0), st.floats(0.0, 10.0))
def test_a_negative_amplitude_is_the_positive_one_half_a_cycle_on(
    amplitude: float, phase: float, time: float
) -> None:
    segment = Segment(duration=1.0, amplitude=amplitude, frequency=3.0, phase=phase)
    assert segment.amplitude == -amplitude
    assert segment.amplitude * math.sin(3.0 * time + segment.phase) == pytest.approx(
        amplitude * math.sin(3.0 * time + phase), abs=1e-13
    )


@every("more", [{}, {"harmonics": ((1, 1.0, 0.5), (2, 0.5, 0.0))}])
def test_without_an_amplitude_nothing_is_turned_round(more: dict[str, Any]) -> None:
    segment = Segment(duration=1.0, amplitude=0.0, frequency=3.0, phase=0.4, **more)
    assert (segment.phase, segment.harmonics) == (0.4, more.get("harmonics", ()))


@every(
    ("arguments", "kind", "name"),
    [
        ({"duration": 0.0}, InputError, "duration"),
        ({"duration": -1.0}, InputError, "duration"),
        ({"duration": math.nan}, InputError, "duration"),
        ({"duration": -math.inf}, InputError, "duration"),
        ({"duration": "1"}, InputError, "duration"),
        ({"constant": math.nan}, InputError, "constant"),
        ({"constant": 1e60}, InputError, "constant"),
        ({"slope": math.inf}, InputError, "slope"),
        ({"jump": math.inf}, InputError, "jump"),
        ({"amplitude": math.nan, "frequency": 1.0}, InputError, "amplitude"),
        ({"phase": math.nan}, InputError, "phase"),
        ({"frequency": -1.0}, InputError, "frequency"),
        ({"frequency": math.nan}, InputError, "frequency"),
        ({"amplitude": 1.0}, ModelError, "frequency"),
        ({"duration": math.inf, "slope": 1e-9}, ModelError, "slope"),
    ],
)
def test_a_bad_segment_is_refused(
    arguments: dict[str, Any], kind: type[Exception], name: str
) -> None:
    with pytest.raises(kind, match=f"^{name} = "):
        Segment(**{"duration": 1.0, **arguments})


def test_only_the_last_piece_may_be_endless() -> None:
    endless, short = Segment(duration=math.inf), Segment(duration=1.0)
    assert Piecewise(pieces=(short, endless)).segments() == (short, endless)
    with pytest.raises(ModelError, match="only the last segment"):
        Piecewise(pieces=(endless, short))


def test_pieces_may_be_any_sequence_and_are_kept_as_a_tuple() -> None:
    pieces: Any = [Segment(duration=1.0)]
    motion = Piecewise(pieces=pieces)
    pieces.append(Segment(duration=2.0))
    assert motion.segments() == (Segment(duration=1.0),)


@every(
    "motion",
    [Harmonic(amplitude=2.0, frequency_ratio=4.0), Segment(duration=1.0), Piecewise()],
)
def test_motions_are_frozen_and_keyword_only(motion: Any) -> None:
    name = dataclasses.fields(motion)[0].name
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(motion, name, 1.0)
    with pytest.raises(InputError, match="takes no arguments without a name"):
        type(motion)(1.0, 4.0)


def test_a_negative_amplitude_is_a_positive_one_half_a_cycle_on() -> None:
    turned: dict[str, Any] = {"duration": 1.0, "frequency": 2.0}
    for phase in (0.0, 1.0, -1.0, 3.0, -3.0, 1e-300, 6.0):
        segment = Segment(**turned, amplitude=-0.5, phase=phase)
        assert segment.amplitude == 0.5
        assert abs(segment.phase) <= max(math.pi, abs(phase))
        assert math.sin(segment.phase) == pytest.approx(-math.sin(phase), abs=1e-15)
        assert math.cos(segment.phase) == pytest.approx(-math.cos(phase), abs=1e-15)
        kept = Segment(**turned, amplitude=0.5, phase=phase)
        assert (kept.amplitude, kept.phase) == (0.5, phase)
    assert Segment(**turned, amplitude=-0.5).phase == math.pi
    waves = Segment(**turned, amplitude=-0.5, phase=0.3, harmonics=((3, 0.5, 0.1), (1, -1.0, 0.2)))
    assert (waves.amplitude, waves.phase) == (0.5, 0.3)
    assert waves.harmonics == ((1, 1.0, 0.2), (3, -0.5, 0.1))


@every("given", [(1.0,), ("a",), [None], 3.0, "ab", {"a": 1}, (Segment(duration=1.0), 2.0)])
def test_what_are_no_segments_is_refused_by_a_motion_and_of_one(given: Any) -> None:
    class Own:
        def segments(self) -> Any:
            return given

    with pytest.raises(InputError, match=r"^pieces = .* a sequence of Segments"):
        Piecewise(pieces=given)
    with pytest.raises(InputError, match=r"^motion = .* its segments\(\) must return Segments"):
        segments_of(Own())


def test_lists_and_tuples_of_segments_are_taken_and_only_the_last_may_be_endless() -> None:
    first, last = Segment(duration=1.0, constant=0.5), Segment(duration=math.inf)
    for pieces in ((first, last), [first, last], (), [last]):
        given: Any = pieces
        assert Piecewise(pieces=given).segments() == tuple(pieces)
        assert segments_of(Piecewise(pieces=given)) == tuple(pieces)
    for wrong in ((last, first), (first, last, first), (last, last)):
        with pytest.raises(ModelError, match="only the last segment may be endless"):
            Piecewise(pieces=wrong)
