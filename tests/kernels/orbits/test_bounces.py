"""Where bounces that come to rest accumulate, against each bounce in many digits."""

import math

import numpy as np

from rocksteady.kernels.orbits.bounces import chatter_end, still_to_come
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.kernels.orbits.systems import System, make_system
from tests.every import every
from tests.oracles import ExactFlight, mp

SIDES = [
    ((0.5, 1.0, 1.0), (0.5, 1.0, 1.0)),
    ((0.8, 1.0, 1.0), (0.8, 1.0, 1.0)),
    ((0.7, 1.0, 1.0), (0.4, 1.3, 0.8)),
    ((0.5, 0.7, 1.2), (0.6, 1.0, 1.0)),
    ((-0.6, 1.0, 1.0), (1.0, 1.0, 1.0)),  # a wall behind it
]
"""Restitution, lean and rate of both sides."""


def system_of(
    amplitude: float, frequency: float, sides: tuple[tuple[float, float, float], ...]
) -> System:
    return make_system(amplitude, frequency, np.array(sides))


def bounced(
    amplitude: float,
    frequency: float,
    sides: tuple[tuple[float, float, float], ...],
    state: Section,
) -> float:
    """Return the pivot time that bounces last, each flown in 110 digits."""
    total, side, speed = mp.mpf(0), state.side, mp.mpf(state.speed)
    phase = mp.mpf(state.phase) + state.half_cycles * mp.pi
    while True:
        restitution, lean, rate = sides[0 if side > 0 else 1]
        pull = 1 - side * amplitude / mp.mpf(lean) * mp.sin(phase)
        own = speed / (mp.mpf(lean) * rate)
        time = 2 * own / pull
        if speed > 1e-7:
            seen = phase if side > 0 else phase + mp.pi
            flight = ExactFlight(
                mp.mpf(-1), mp.mpf(0), amplitude / mp.mpf(lean), frequency / mp.mpf(rate),
                mp.mpf(0), own, seen,
            )  # fmt: skip
            time = flight.zero_near(time)
            landing = -flight.state(time)[1] * lean * rate
        else:
            landing = speed
        total += time / rate
        phase += frequency * time / rate
        speed = abs(restitution) * landing
        side = side if restitution < 0.0 else -side
        if speed < 1e-15:
            return float(total)


@every("sides", SIDES)
def test_on_a_still_base_bounces_last_the_sum_of_their_closed_forms(
    sides: tuple[tuple[float, float, float], ...],
) -> None:
    system = system_of(0.0, 3.0, sides)
    for side in (1, -1) if sides[0][0] > 0.0 else (1,):
        for speed in (0.0, 1e-8, 1e-4, 1e-3, 1e-2):
            total, velocity, place = 0.0, speed, side
            while velocity > 1e-18:
                restitution, lean, rate = sides[0 if place > 0 else 1]
                total += 2.0 * math.atanh(velocity / (lean * rate)) / rate
                velocity *= abs(restitution)
                place = place if restitution < 0.0 else -place
            left, error = still_to_come(system, Section(side, 0, 0.4, speed))
            assert abs(left - total) <= error + 1e-14 * total + 2e-17, (side, speed)
            assert error <= 300.0 * speed * speed * total, (side, speed)
            end, lost, count = chatter_end(
                system, Section(1, 0, 0.1, 0.0), Section(side, 0, 0.4, speed)
            )
            assert abs(end - (0.3 + 3.0 * total)) <= 2e-14 + lost
            assert lost <= 1e-14
            assert (count == 1) == (speed < 1e-4)


@every(
    ("amplitude", "frequency", "sides"),
    zip([0.3, 0.6, 0.2, 0.3, 0.5], [2.0, 0.5, 9.0, 4.0, 1.0], SIDES, strict=True),
)
def test_on_a_shaken_base_bounces_end_where_many_digits_put_it(
    amplitude: float, frequency: float, sides: tuple[tuple[float, float, float], ...]
) -> None:
    system = system_of(amplitude, frequency, sides)
    for side, half, phase, speed in ((1, 0, 0.4, 2e-3), (-1, 1, 2.1, 1e-2), (1, 3, 1.3, 3e-2)):
        state = Section(1 if sides[0][0] < 0.0 else side, half, phase, speed)
        with mp.workdps(40):
            exact = bounced(amplitude, frequency, sides, state)
        left, error = still_to_come(system, state)
        assert abs(left - exact) <= 3.0 * error
        begin = Section(1, 0, 0.1, 0.0)
        end, lost, count = chatter_end(system, begin, state)
        expected = half * math.pi + phase - 0.1 + frequency * exact
        assert abs(end - expected) <= 1e-12
        assert lost <= 1e-14
        assert 1 < count < 100


def test_a_base_that_lifts_a_side_leaves_bounces_without_an_end() -> None:
    system = system_of(2.0, 3.0, SIDES[0])
    for phase, half in ((0.5 * math.pi, 0), (0.5 * math.pi, 1)):
        assert still_to_come(system, Section(1, half, phase, 0.1)) == (math.inf, math.inf)
