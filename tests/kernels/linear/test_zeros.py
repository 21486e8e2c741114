"""The first zero of a flight is never missed, never invented, and found to rounding."""

import math
from collections.abc import Callable
from typing import TypeVar

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import FOUND, NO_RETURN, SPAN_END
from rocksteady.kernels.linear.flight import make_flight, wrapped
from rocksteady.kernels.linear.zeros import Zero, next_zero
from rocksteady.kernels.machine_code.compilation import Kernel
from tests.every import every
from tests.oracles import ExactFlight, first_zero_in_double, mp
from tests.strategies import (
    AMPLITUDE,
    ANGLE,
    CONSTANT,
    FREQUENCY,
    PHASE,
    PLAIN,
    SLOPE,
    SPAN,
    VELOCITY,
    inner_sample_size,
    random_flights,
    rest_slow,
    sample_size,
)
from tools.aot.dispatch import dispatcher

Floats = NDArray[np.float64]
FunctionT = TypeVar("FunctionT", bound=Callable[..., object])

# Columns of what a search found.
EVENT, TIME, END_ANGLE, END_VELOCITY, END_PHASE, CYCLE = range(6)


def jit(function: FunctionT) -> FunctionT:
    """Compile a function that calls kernels by numba, unless they run as plain Python."""
    made: FunctionT = function if PLAIN else dispatcher(Kernel(function))
    return made


@jit
def search(flight: Floats, span: float, endless: bool, guess: float) -> Zero:
    forcing = make_forcing(flight[0], flight[1], flight[2], flight[3])
    phase = flight[6]
    start = make_flight(forcing, flight[4], flight[5], phase, math.sin(phase), math.cos(phase))
    return next_zero(start, forcing, span, endless, False, guess)


@jit
def search_all(flights: Floats, endless: bool, guesses: Floats, found: Floats) -> None:
    for i in range(len(flights)):
        span = math.inf if endless else flights[i, 7]
        zero = search(flights[i], span, endless, guesses[i])
        found[i, 0] = zero.event
        found[i, 1] = zero.time
        found[i, 2] = zero.angle
        found[i, 3] = zero.velocity
        found[i, 4] = zero.phase
        found[i, 5] = zero.cycle


@jit
def oracle_all(flights: Floats, found: Floats) -> None:
    for i in range(len(flights)):
        f = flights[i]
        sign = 1.0
        if f[4] < 0.0 or (f[4] == 0.0 and f[5] < 0.0):
            sign = -1.0
        found[i, 0], found[i, 1] = first_zero_in_double(
            f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], sign
        )


def exact(flight: Floats) -> ExactFlight:
    """Return the flight in 50 digits; its phase is the double, not what its sine rounds to."""
    return ExactFlight(*(mp.mpf(float(value)) for value in flight[:SPAN]))


def sign_of(flight: Floats) -> int:
    return -1 if flight[ANGLE] < 0 or (flight[ANGLE] == 0 and flight[VELOCITY] < 0) else 1


def blur(flight: Floats, time: float) -> float:
    """Return a few times the rounding of the angle at `time`, that of the start included."""
    w = flight[FREQUENCY]
    beta = flight[AMPLITUDE] / (1.0 + w * w)
    start = (
        abs(flight[ANGLE])
        + abs(flight[VELOCITY])
        + abs(flight[CONSTANT])
        + abs(flight[SLOPE])
        + beta * (1.0 + w)
    )
    return float(8.0 * 2.0**-52 * (start * math.exp(min(time, 700.0)) + beta * w * time))


def verdict(flight: Floats, event: float, time: float) -> str:
    """Judge one search in 50 digits: right, grazing (within the blur of rounding), or wrong."""
    sign, path = sign_of(flight), exact(flight)
    truth = path.first_zero(mp.mpf(float(flight[SPAN])), sign)
    found = event == FOUND
    if truth is not None and found and abs(truth - time) <= 1e-11 * time:
        return "right"
    if truth is None and not found:
        return "right"
    candidates = [time] if found else []
    candidates += [float(truth)] if truth is not None else []
    earliest = min(candidates)
    # How deep is the dip, or how far from zero the flight passes, where only one of them stops?
    at = mp.mpf(earliest)
    y, v = path.state(at)
    pull = y + path.forcing(at)
    least = abs(y) if pull == 0 else max(abs(y), abs(v * v / (2 * pull)))
    if truth is not None and found:
        slope = abs(path.state(truth)[1])
        if slope > 0 and abs(truth - time) * slope <= blur(flight, time):
            return "right"
    if least <= blur(flight, earliest) or abs(earliest - flight[SPAN]) <= 1e-12 * flight[SPAN]:
        return "grazing"
    return "wrong"


def disagreements(flights: Floats) -> tuple[int, list[tuple[int, str]]]:
    """Return how many zeros the oracle finds, and each case that 50 digits had to decide."""
    count = len(flights)
    found, truth = np.zeros((count, 6)), np.zeros((count, 2))
    search_all(flights, False, np.full(count, -1.0), found)
    oracle_all(flights, truth)
    hit = found[:, EVENT] == FOUND
    same = (hit & (np.abs(found[:, TIME] - truth[:, 0]) <= 1e-9 * truth[:, 0])) | (
        ~hit & np.isinf(truth[:, 0])
    )
    cases = [
        (i, verdict(flights[i], found[i, EVENT], found[i, TIME]))
        for i in np.flatnonzero(~same).tolist()
    ]
    return int(np.isfinite(truth[:, 0]).sum()), cases


def none_missed(seed: int, count: int) -> None:
    flights = random_flights(np.random.default_rng(seed), count)
    zeros, cases = disagreements(flights)
    assert zeros > 0.2 * count, "the sample must hold many zeros"
    wrong = [(flights[i].tolist(), said) for i, said in cases if said == "wrong"]
    assert not wrong, f"{len(wrong)} of {count}: {wrong[:3]}"
    assert len(cases) < 2e-3 * count + 5, "too many were left to 50 digits"


@pytest.mark.parametrize("seed", rest_slow(range(5), 2))
def test_no_zero_is_missed_or_invented(seed: int) -> None:
    none_missed(seed, inner_sample_size(40_000, 300))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 110))
def test_no_zero_is_missed_in_a_million_flights(seed: int) -> None:
    none_missed(seed, sample_size(100_000, 300))


# ------------------------------------------------------------------------------ endless forcing


def check_no_return(seed: int, count: int) -> None:
    flights = random_flights(np.random.default_rng(seed), count)
    flights[:, SLOPE] = 0.0
    flights[:, SPAN] = np.where(flights[:, FREQUENCY] > 30.0, 20.0, 60.0)
    found, truth = np.zeros((count, 6)), np.zeros((count, 2))
    search_all(flights, True, np.full(count, -1.0), found)
    oracle_all(flights, truth)
    never = found[:, EVENT] == NO_RETURN
    assert 0.2 * count < never.sum() < 0.9 * count
    assert set(found[:, EVENT]) <= {float(FOUND), float(NO_RETURN)}
    broken = [
        i
        for i in np.flatnonzero(never & np.isfinite(truth[:, 0]))
        if verdict(flights[i], NO_RETURN, found[i, TIME]) == "wrong"
    ]
    assert not broken, flights[broken[:3]].tolist()
    # The other way round: whoever lands on endless forcing lands where the oracle says.
    late = np.abs(found[:, TIME] - truth[:, 0]) > 1e-9 * found[:, TIME]
    wrong = [
        i
        for i in np.flatnonzero(~never & late & (found[:, TIME] < flights[:, SPAN]))
        if verdict(flights[i], FOUND, found[i, TIME]) == "wrong"
    ]
    assert not wrong, flights[wrong[:3]].tolist()


@pytest.mark.slow
def test_no_return_is_claimed_only_where_there_is_none() -> None:
    check_no_return(11, sample_size(40_000, 300))


def test_no_return_is_claimed_of_a_few_flights_only_where_there_is_none() -> None:
    check_no_return(12, 120)


def test_no_return_holds_in_fifty_digits_for_a_long_time() -> None:
    rng = np.random.default_rng(12)
    flights = random_flights(rng, 4000)
    flights = flights[(flights[:, SLOPE] == 0.0) & (flights[:, FREQUENCY] < 20.0)]
    checked = 0
    for flight in flights:
        zero = search(flight, math.inf, True, -1.0)
        if zero.event != NO_RETURN:
            continue
        sign = sign_of(flight)
        assert exact(flight).first_zero(mp.mpf(40), sign) is None, flight.tolist()
        y, v = exact(flight).state(mp.mpf(40))
        assert sign * y > 0
        assert sign * v > 0
        checked += 1
        if checked == sample_size(150, 15):
            break


def test_a_balanced_flight_never_returns_nor_falls() -> None:
    # y'' = y - 1 with y = 1: it stays there for ever. No proof of falling may be claimed.
    still = np.array([-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, math.inf])
    assert search(still, math.inf, True, -1.0).event == SPAN_END
    # Under shaking the balanced motion 1 - beta sin psi stays above the floor if beta < 1. Here
    # the growing part is exactly zero, and neither return nor fall can be concluded in the span.
    hover = np.array([-1.0, 0.0, 0.5, 1.0, 1.0, -0.25, 0.0, 50.0])
    zero = search(hover, 50.0, True, -1.0)
    assert zero.event == SPAN_END
    assert zero.angle == pytest.approx(1.0 - 0.25 * math.sin(50.0), abs=1e-15)


def test_a_start_on_or_past_the_end_of_the_span_is_the_end() -> None:
    flight = np.array([-1.0, 0.0, 2.0, 4.0, 0.0, 0.3, 2.8, 0.0])
    for span in (0.0, -1e-16):
        for endless in (False, True):
            zero = search(flight, span, endless, 0.2)
            assert (zero.event, zero.time, zero.angle, zero.velocity) == (SPAN_END, 0.0, 0.0, 0.3)


# ------------------------------------------------------------------------------------- accuracy


def test_zeros_lie_where_fifty_digits_put_them() -> None:
    flights = random_flights(np.random.default_rng(21), sample_size(900, 60))
    checked = 0
    for flight in flights:
        zero = search(flight, flight[SPAN], False, -1.0)
        if zero.event != FOUND:
            continue
        sign = sign_of(flight)
        truth = exact(flight).first_zero(mp.mpf(float(flight[SPAN])), sign)
        assert truth is not None
        slope = abs(exact(flight).state(truth)[1])
        tolerance = 1e-15 * truth + blur(flight, zero.time) / slope
        assert abs(zero.time - truth) <= 2 * tolerance, flight.tolist()
        velocity = exact(flight).state(truth)[1]
        pull = abs(exact(flight).forcing(truth))
        bound = blur(flight, zero.time) + 2 * tolerance * pull
        assert abs(zero.velocity - velocity) <= 2 * bound, flight.tolist()
        checked += 1
    assert checked > 0.2 * len(flights)


def test_where_a_search_ends_its_phase_is_that_of_the_time() -> None:
    count = sample_size(20_000, 200)
    flights = random_flights(np.random.default_rng(22), count)
    found = np.zeros((count, 6))
    search_all(flights, False, np.full(count, -1.0), found)
    reached = found[:, END_PHASE] + 2.0 * math.pi * found[:, CYCLE]
    direct = flights[:, PHASE] + flights[:, FREQUENCY] * found[:, TIME]
    assert np.all(np.abs(reached - direct) <= 1e-14 * np.abs(direct) + 1e-14)
    shaken = found[:, EVENT] == FOUND
    assert np.all(found[shaken, END_PHASE] >= -0.5 * math.pi - 1e-12)


@every("velocity", [1e-12, 1e-10, 1e-8, 1e-5, 1e-3])
def test_tiny_bounces_keep_their_relative_accuracy(velocity: float) -> None:
    rng = np.random.default_rng(23)
    for _ in range(sample_size(60, 10)):
        amplitude = 10.0 ** rng.uniform(-1.0, 1.0)
        frequency = 10.0 ** rng.uniform(-1.3, 3.0)
        phase = wrapped(rng.uniform(0.0, 2.0 * math.pi))
        pull = amplitude * math.sin(phase) - 1.0
        if pull > -0.05 or velocity * frequency > 0.01:
            continue
        flight = np.array([-1.0, 0.0, amplitude, frequency, 0.0, velocity, phase, 10.0])
        zero = search(flight, 10.0, False, -1.0)
        assert zero.event == FOUND
        truth = exact(flight).zero_near(zero.time)
        assert truth > 0
        assert abs(zero.time - truth) <= 4e-15 * truth
        assert abs(zero.velocity - exact(flight).state(truth)[1]) <= 4e-15 * velocity


# --------------------------------------------------------------------------------------- guesses


def test_a_guess_never_changes_which_zero_is_found() -> None:
    count = sample_size(40_000, 300)
    rng = np.random.default_rng(31)
    flights = random_flights(rng, count)
    plain, guided = np.zeros((count, 6)), np.zeros((count, 6))
    search_all(flights, False, np.full(count, -1.0), plain)
    hits = plain[:, EVENT] == FOUND
    # Guesses: anywhere in the span; later zeros or none; near the zero; absurd.
    for guesses in (
        rng.uniform(0.0, 1.0, count) * flights[:, SPAN],
        np.where(hits, plain[:, TIME] * (1.0 + 1e-3 * rng.normal(size=count)), 1.0),
        np.where(hits, plain[:, TIME] * (1.0 + 0.3 * rng.normal(size=count)), 1.0),
        10.0 ** rng.uniform(-18.0, 2.0, count),
    ):
        search_all(flights, False, guesses, guided)
        assert np.array_equal(plain[:, EVENT], guided[:, EVENT])
        moved = np.abs(plain[:, TIME] - guided[:, TIME])
        allowed = 1e-14 * plain[:, TIME]
        steep = np.abs(plain[:, END_VELOCITY])
        for i in np.flatnonzero(moved > allowed).tolist():
            # Where the block lands so gently that rounding hides the zero, within that blur.
            assert hits[i]
            assert moved[i] * steep[i] <= blur(flights[i], plain[i, TIME]), flights[i].tolist()


# ---------------------------------------------------------------------------------------- mirror


def test_a_flight_and_its_mirror_image_end_alike() -> None:
    count = sample_size(20_000, 200)
    flights = random_flights(np.random.default_rng(41), count)
    mirrored = flights.copy()
    mirrored[:, [CONSTANT, SLOPE, ANGLE, VELOCITY]] *= -1.0
    for i in range(count):
        mirrored[i, PHASE] = wrapped(flights[i, PHASE] + math.pi)
    one, other = np.zeros((count, 6)), np.zeros((count, 6))
    search_all(flights, False, np.full(count, -1.0), one)
    search_all(mirrored, False, np.full(count, -1.0), other)
    assert np.array_equal(one[:, EVENT], other[:, EVENT])
    spread = np.abs(one[:, TIME] - other[:, TIME])
    for i in np.flatnonzero(spread > 1e-14 * one[:, TIME]).tolist():
        steep = max(abs(one[i, END_VELOCITY]), 1e-300)
        assert spread[i] * steep <= blur(flights[i], one[i, TIME]), flights[i].tolist()


# --------------------------------------------------------------------------------------- grazing


def grazing_flight(rng: np.random.Generator) -> tuple[Floats, mpmath.mpf, float] | None:
    """Return a flight that touches the floor, its exact starting velocity, and when it touches.

    A touch at phase psi with positive forcing is followed backwards in time to its start; then
    the starting velocity is solved for in 50 digits at the start's phase in double precision.
    """
    amplitude = 1.0 + 10.0 ** rng.uniform(-1.5, 1.0)
    frequency = 10.0 ** rng.uniform(math.log10(0.05), 3.0)
    rising = math.asin(1.0 / amplitude)
    touch = rising + rng.uniform(0.1, 0.9) * (math.pi - 2.0 * rising)
    forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
    back = wrapped(math.pi - touch)
    reversed_flight = make_flight(forcing, 0.0, 0.0, back, math.sin(back), math.cos(back))
    start = next_zero(reversed_flight, forcing, 15.0, False, True, -1.0)
    if start.event != FOUND:
        return None
    phase = wrapped(touch - frequency * start.time)
    flight = np.array([-1.0, 0.0, amplitude, frequency, 0.0, -start.velocity, phase, 30.0])

    def contact(time: mpmath.mpf, velocity: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
        path = exact(flight)
        return ExactFlight(
            path.constant, path.slope, path.amplitude, path.frequency, 0, velocity, path.phase
        ).state(time)

    time, velocity = mp.findroot(contact, (start.time, -start.velocity), tol=1e-60, verify=False)
    assert max(map(abs, contact(time, velocity))) < 1e-30
    flight[VELOCITY] = float(velocity) * (1.0 + 1e-9)
    early, _ = first_zero_in_double(*flight[:7], float(time) * 1.01, 1.0)  # type: ignore[call-arg]
    assert math.isinf(early), "nothing comes before the touch"
    return flight, velocity, float(time)


def check_grazing_jumps(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    checked = 0
    while checked < count:
        case = grazing_flight(rng)
        if case is None:
            continue
        flight, velocity, touch = case
        # While r > 0 the block cannot come back: it lands at the touch or after the next node.
        falling = math.pi - math.asin(1.0 / flight[AMPLITUDE])
        turned = wrapped(flight[PHASE] + flight[FREQUENCY] * touch)
        late = touch + 0.5 * (falling - turned) / flight[FREQUENCY]

        def lands_late(speed: float, flight: Floats = flight, late: float = late) -> bool:
            flight[VELOCITY] = speed
            zero = search(flight, flight[SPAN], False, -1.0)
            return zero.event != FOUND or zero.time > late

        low, high = float(velocity) * (1.0 - 1e-9), float(velocity) * (1.0 + 1e-9)
        assert not lands_late(low)
        assert lands_late(high)
        for _ in range(60):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            low, high = (low, middle) if lands_late(middle) else (middle, high)
        assert abs(high - velocity) <= 1e-12 * max(1, velocity), flight.tolist()
        checked += 1


@pytest.mark.slow
def test_the_landing_jumps_where_the_flight_grazes_the_floor() -> None:
    check_grazing_jumps(51, sample_size(300, 15))


@pytest.mark.slow
def test_a_thousand_grazing_jumps() -> None:
    check_grazing_jumps(52, 100 if PLAIN else 1000)
