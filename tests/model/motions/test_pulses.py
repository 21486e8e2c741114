"""Pulses against the formulae of their papers, on fine grids; what is refused."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from numpy.polynomial.hermite_e import hermeroots
from numpy.typing import NDArray

from rocksteady import Block, Pulse
from rocksteady.dynamics.history.base_motion import base_acceleration, course_from_rest
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.core.motions import ANTISYMMETRIC_BENDS, BENDS, BEYOND
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions._pulse_shapes import peak_of_unit_velocity
from rocksteady.model.motions.pulses import PULSES
from rocksteady.motions import scale
from tests.every import every
from tests.model.motions.formulae_of_pulses import FORMULAE, GAMMA, NU, centred, type_c_phase
from tests.strategies import logarithmic

Floats = NDArray[np.float64]

BLOCK = Block.from_p(alpha=0.2, p=3.0, restitution=0.8)
WAVELETS = ("ricker", "ricker-antisymmetric", "mavroeidis-papageorgiou")
MP = {"oscillations": GAMMA, "phase": NU}


def made(name: str, a: float = 2.0, w: float = 3.0, **more: Any) -> Pulse:
    if name == "mavroeidis-papageorgiou":
        more = MP | more
    return Pulse(shape=name, amplitude=a, frequency_ratio=w, **more)


def acceleration(motion: Any, s: Floats) -> Floats:
    return base_acceleration(segment_table(motion), s)


def end_of(pulse: Pulse) -> tuple[float, float]:
    """Velocity and displacement of the base after the pulse, in units of alpha g/p, alpha g/p^2."""
    table = segment_table(pulse)
    later = course_from_rest(table, np.array([0.0, 1.0]) + pulse.duration)[1]
    return float(later[1] - later[0]), float(later[0])


def test_every_name_has_a_formula_here() -> None:
    assert {*FORMULAE, *WAVELETS} - {"type-c12"} == set(PULSES)


@every("name", FORMULAE)
@given(a=logarithmic(1e-6, 1e6), w=logarithmic(0.02, 500.0))
@settings(max_examples=20)
def test_a_shape_is_its_formula(name: str, a: float, w: float) -> None:
    periods, formula = FORMULAE[name]
    pulse = made(name, a, w)
    assert pulse.duration == pytest.approx(2.0 * math.pi * periods / w, rel=1e-14)
    inside = np.linspace(0.0, pulse.duration, 1001)[:-1]
    expected = formula(inside, a, w)
    np.testing.assert_allclose(acceleration(pulse, inside), expected, rtol=0.0, atol=1e-13 * a)
    assert float(acceleration(pulse, np.array(pulse.duration * 1.001))) == 0.0
    assert len(pulse.segments()) <= 2


@pytest.mark.slow
@every("name", WAVELETS)
@every("tolerance", [1e-2, 1e-4, 1e-6])
def test_a_wavelet_is_its_formula_within_its_tolerance(name: str, tolerance: float) -> None:
    a, w = 2.0, 3.0
    pulse = made(name, a, w, tolerance=tolerance)
    middle = 0.5 * pulse.duration
    # a grid that has nothing to do with the samples, and reaches past both ends
    s = np.linspace(0.0, 1.5 * pulse.duration, 177_147)
    error = np.abs(acceleration(pulse, s) - centred(name, s - middle, a, w))
    assert error.max() <= tolerance * a * (1.0 + 1e-6)
    if name != "mavroeidis-papageorgiou":  # whose bound adds three waves that never crest together
        inside = np.abs(s - middle) < 0.3 * pulse.duration
        assert error[inside].max() > 0.8 * tolerance * a, "no finer than it was asked to be"


@every("name", [*FORMULAE, *WAVELETS])
def test_the_amplitude_is_the_largest_acceleration(name: str) -> None:
    pulse = made(name, 2.0, 3.0)
    s = np.linspace(0.0, pulse.duration, 200_001)[:-1]
    assert np.abs(acceleration(pulse, s)).max() == pytest.approx(2.0, abs=5e-6)


@every(
    ("name", "velocity", "displacement"),
    [
        ("rectangle", 2.0 * math.pi / 3.0, 2.0 * (math.pi / 3.0) ** 2 / 2.0),
        ("half-sine", 2.0 * 2.0 / 3.0, None),
        ("versed-sine", 0.5 * 2.0 * math.pi / 3.0, None),
        ("triangle", 0.5 * 2.0 * math.pi / 3.0, None),
        ("decaying-ramp", 0.5 * 2.0 * math.pi / 3.0, None),
        ("one-sine", 0.0, 2.0 * 2.0 * math.pi / 9.0),
        ("one-cosine", 0.0, 0.0),
        ("type-c1", 0.0, 0.0),
        ("type-c2", 0.0, 0.0),
        ("type-c3", 0.0, 0.0),
        ("ricker", 0.0, 0.0),
        ("ricker-antisymmetric", 0.0, 0.0),
        ("mavroeidis-papageorgiou", 0.0, None),
    ],
)
def test_where_the_ground_comes_to(name: str, velocity: float, displacement: float | None) -> None:
    found = end_of(made(name, 2.0, 3.0))
    exact = 1e-12 if name in FORMULAE else 1e-5
    assert found[0] == pytest.approx(velocity, abs=exact)
    if displacement is not None:
        assert found[1] == pytest.approx(displacement, abs=10.0 * exact)


def test_the_velocity_of_a_mavroeidis_papageorgiou_pulse_is_theirs() -> None:
    pulse = made("mavroeidis-papageorgiou", 2.0, 3.0)
    s = np.linspace(0.0, pulse.duration, 20_001)
    place = course_from_rest(segment_table(pulse), s)[1]
    velocity = np.gradient(place, s)
    tau = s - 0.5 * pulse.duration
    bell = 0.5 * (1.0 + np.cos(3.0 * tau / GAMMA))
    shape = bell * np.cos(3.0 * tau + NU)
    size = float(velocity @ shape) / float(shape @ shape)
    np.testing.assert_allclose(velocity[5:-5], (size * shape)[5:-5], atol=1e-5 * size)


def test_the_phases_of_type_c() -> None:
    assert type_c_phase(1) / math.pi == pytest.approx(0.0697, abs=5.1e-5)  # as printed
    assert type_c_phase(2) / math.pi == pytest.approx(0.0410, abs=5.1e-5)
    (segment,) = made("type-c2").segments()
    assert segment.phase - 0.5 * math.pi == pytest.approx(type_c_phase(2), abs=1e-14)


@pytest.mark.parametrize("name", ["ricker", "ricker-antisymmetric"])
def test_the_spectrum_of_a_ricker_wavelet_is_largest_at_its_frequency(name: str) -> None:
    s = np.linspace(-40.0, 40.0, 40_001)
    wave = centred(name, s, 1.0, 3.0)
    ratios = np.linspace(2.0, 4.0, 401)
    size = [abs(np.trapezoid(wave * np.exp(-1j * w * s), s)) for w in ratios]
    assert ratios[int(np.argmax(size))] == pytest.approx(3.0, abs=0.005)


@every("name", [*FORMULAE, *WAVELETS])
def test_lasting_sets_the_duration(name: str) -> None:
    pulse = Pulse.lasting(1.7, shape=name, amplitude=2.0)
    assert pulse.duration == pytest.approx(1.7, rel=1e-12)
    assert (pulse.shape, pulse.amplitude) == (name, 2.0)


@pytest.mark.slow
@every("name", [*FORMULAE, *WAVELETS])
@every("w", [0.01, 5000.0])
def test_every_shape_has_the_whole_range_of_frequencies(name: str, w: float) -> None:
    assert made(name, w=w).duration > 0.0


@given(logarithmic(1e-3, 1e3), logarithmic(0.02, 50.0))
def test_a_pulse_in_si_and_back(acceleration_m_s2: float, frequency_hz: float) -> None:
    pulse = Pulse.from_si(
        BLOCK,
        shape="one-sine",
        acceleration_m_s2=acceleration_m_s2,
        frequency_hz=frequency_hz,
    )
    assert pulse.acceleration_m_s2(BLOCK) == pytest.approx(acceleration_m_s2, rel=1e-14)
    assert pulse.frequency_hz(BLOCK) == pytest.approx(frequency_hz, rel=1e-14)
    assert pulse.duration / BLOCK.p == pytest.approx(1.0 / frequency_hz, rel=1e-14)


def test_a_pulse_without_size_shakes_nothing() -> None:
    for name in [*FORMULAE, *WAVELETS]:
        pulse = made(name, a=0.0)
        assert pulse.duration > 0.0
        assert not acceleration(pulse, np.linspace(0.0, pulse.duration, 50)).any()


@every(
    ("given", "kind", "words"),
    [
        (
            {"shape": "onesine"},
            InputError,
            r"^shape = 'onesine' .*rectangle.*papageorgiou, or type-c4 to type-c99$",
        ),
        ({"shape": "type-c0"}, InputError, "^shape = "),
        ({"shape": "type-c"}, InputError, "^shape = "),
        ({"shape": "type-c1 "}, InputError, "^shape = "),
        ({"shape": None}, InputError, "^shape = "),
        ({"amplitude": -1.0}, InputError, "^amplitude = "),
        ({"amplitude": math.nan}, InputError, "^amplitude = "),
        ({"frequency_ratio": 0.0}, InputError, "^frequency_ratio = "),
        ({"frequency_ratio": 5001.0}, InputError, "^frequency_ratio = "),
        ({"tolerance": 0.0}, InputError, "^tolerance = "),
        ({"tolerance": 1.0}, InputError, "^tolerance = "),
        ({"oscillations": 2.0}, ModelError, "^oscillations = 2.0 .*one-sine pulse has none"),
        ({"phase": 0.0}, ModelError, "^phase = 0.0 .*one-sine pulse has none"),
        ({"shape": "ricker", "phase": 0.0}, ModelError, "^phase = "),
        ({"shape": "mavroeidis-papageorgiou", "oscillations": 1.0}, InputError, "^oscillations = "),
        ({"shape": "mavroeidis-papageorgiou", "oscillations": 51}, InputError, "^oscillations = "),
        ({"shape": "mavroeidis-papageorgiou", "phase": math.inf}, InputError, "^phase = "),
    ],
)
def test_a_bad_pulse_is_refused(given: dict[str, Any], kind: type[Exception], words: str) -> None:
    good: dict[str, Any] = {"shape": "one-sine", "amplitude": 2.0, "frequency_ratio": 4.0}
    with pytest.raises(kind, match=words):
        Pulse(**(good | given))


def test_bad_measures_of_a_pulse_are_refused_as_they_were_given() -> None:
    with pytest.raises(InputError, match=r"^frequency_hz = 1e-05 .*p = 3 rad/s"):
        Pulse.from_si(BLOCK, shape="one-sine", acceleration_m_s2=1.0, frequency_hz=1e-5)
    with pytest.raises(InputError, match=r"^acceleration_m_s2 = -1"):
        Pulse.from_si(BLOCK, shape="one-sine", acceleration_m_s2=-1.0, frequency_hz=1.0)
    with pytest.raises(InputError, match=r"^duration = 0"):
        Pulse.lasting(0.0, shape="one-sine", amplitude=1.0)


def test_a_wavelet_that_would_need_too_many_lines_says_what_would_do() -> None:
    long = made("mavroeidis-papageorgiou", a=5.0, oscillations=50.0, tolerance=1e-8)
    with pytest.raises(InputError, match=r"^tolerance = 1e-08 .*200000 are the most") as told:
        long.segments()
    better = float(told.value.hint.split()[1])
    assert 1e-8 < better < 1e-5
    enough = dataclasses.replace(long, tolerance=100.0 * better).segments()
    assert 15_000 < len(enough) <= 20_000, "so many that ten times as many are the most"


@every("shape", ["one-sine", "triangle", "type-c2", "ricker"])
def test_a_reversed_pulse_is_its_mirror_image(shape: str) -> None:
    pulse = Pulse(shape=shape, amplitude=2.0, frequency_ratio=3.0)
    turned = dataclasses.replace(pulse, reverse=True)
    assert turned.segments() == scale(pulse, -1.0).segments()
    assert (turned.duration, turned.amplitude) == (pulse.duration, pulse.amplitude)
    with pytest.raises(InputError, match="reverse = 'yes' is not valid: it must be True or False"):
        Pulse(shape=shape, amplitude=1.0, frequency_ratio=1.0, reverse="yes")  # type: ignore[arg-type]


@every(("order", "bends"), [(5, BENDS[:2]), (6, ANTISYMMETRIC_BENDS)])
def test_lines_along_a_ricker_wavelet_know_where_its_curvature_is_extreme(
    order: int, bends: tuple[float, ...]
) -> None:
    """The n-th derivative of a Gaussian bell is the n-th Hermite polynomial times the bell."""
    zeros = hermeroots([0.0] * order + [1.0])
    assert bends == pytest.approx(zeros[zeros > 1e-9].tolist(), rel=BEYOND - 1.0)


@every(("gamma", "nu"), [(1.5, 0.4), (2.5, 1.0), (4.0, -1.3)])
def test_the_peak_of_unit_velocity_is_that_of_a_fine_grid(gamma: float, nu: float) -> None:
    tau = np.linspace(-gamma * math.pi, gamma * math.pi, 2_000_001)
    bell, falls = 0.5 * (1.0 + np.cos(tau / gamma)), 0.5 * np.sin(tau / gamma) / gamma
    grid = np.abs(falls * np.cos(tau + nu) + bell * np.sin(tau + nu)).max()
    assert peak_of_unit_velocity(gamma, nu) == pytest.approx(grid, rel=1e-10)
