"""The full equation of motion of a facade from Lagrange, integrated by DOP853 with events."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rocksteady import Record
from rocksteady.codes import Facade

G = 9.80665
STILL = 1e-9
"""Speed [rad/s] below which a wall that strikes what stands behind stays there."""


@dataclass(frozen=True)
class Section:
    """Points of a wall that leans about a hinge at the origin; x inwards, z upwards.

    A point (x, z) is at (x cos - z sin, x sin + z cos) when the wall leans outwards by theta.
    """

    facade: Facade

    def coefficients(self) -> tuple[float, ...]:
        f = self.facade
        t, h, hinge = f.thickness_m, f.height_m, f.hinge_inset_m
        wall = f.unit_weight_kn_m3 * t * h * f.length_m
        points = [(wall, t / 2 - hinge, h / 2)]
        points += [(load.weight_kn, load.x_m - hinge, load.z_m) for load in f.loads]
        inertia = sum(w * (x * x + z * z) for w, x, z in points) + wall * (t * t + h * h) / 12
        across, up = (sum(w * p[k] for w, *p in points) for k in (0, 1))
        pulls = sum(tie.force_kn * tie.z_m for tie in f.ties)
        pulls -= sum(thrust.force_kn * thrust.z_m for thrust in f.thrusts)
        pushed = sum(m.weight_kn * m.z_m for m in f.masses)
        pushed_second = sum(m.weight_kn * m.z_m**2 for m in f.masses)
        return inertia, across, up, pulls, pushed, pushed_second

    def acceleration(self, theta: float, omega: float, push: float) -> float:
        """Return theta'' of the wall where the ground moves inwards with `push` [m/s^2].

        Kinetic energy: sum P/(2g) |v|^2 + sum Q/(2g) v_x^2, v of the ground included; potential
        energy sum P z' less the work of ties and thrusts, which stay horizontal.  FC divides what
        holds the wall, as it divides the capacity of the circular.
        """
        inertia, across, up, pulls, pushed, second = self.coefficients()
        sine, cosine = math.sin(theta), math.cos(theta)
        held = (across * cosine - up * sine + pulls * cosine) / self.facade.confidence_factor
        driven = push / G * (across * sine + up * cosine + pushed * cosine)
        gyred = second * cosine * sine * omega * omega
        return G * (driven - held + gyred) / (inertia + second * cosine * cosine)


def largest_tilt(facade: Facade, record: Record, restitution: float) -> float:
    """Return the largest tilt [rad] of a wall that is at rest as the record begins.

    The integration begins anew at each sample, after each impact and where the wall lifts; it goes
    on for 10 s after the record.
    """
    section, dt = Section(facade), record.dt_s
    samples = np.append(record.acceleration_m_s2, np.zeros(round(10.0 / dt)))
    state, most = np.zeros(2), 0.0
    for first, last in pairwise(samples.tolist()):
        state, most = _over(section, state, most, (first, last, dt), restitution)
        if state[0] > 1.5:
            return math.inf
    return most


def _over(
    section: Section,
    state: NDArray[np.float64],
    most: float,
    segment: tuple[float, float, float],
    restitution: float,
) -> tuple[NDArray[np.float64], float]:
    """Return state and largest tilt after one interval of a record."""
    first, last, dt = segment

    def push(t: float) -> float:
        return first + (last - first) * t / dt

    def slope(t: float, y: NDArray[np.float64]) -> list[float]:
        return [y[1], section.acceleration(y[0], y[1], push(t))]

    def strikes(_: float, y: NDArray[np.float64]) -> float:
        return float(y[0])

    def peaks(_: float, y: NDArray[np.float64]) -> float:
        return float(y[1])

    strikes.terminal, strikes.direction = True, -1.0  # type: ignore[attr-defined]
    peaks.direction = -1.0  # type: ignore[attr-defined]
    now = 0.0
    while now < dt:
        if state[0] == 0.0 and state[1] <= STILL:
            ends = [section.acceleration(0.0, 0.0, push(t)) for t in (now, dt)]
            if ends[0] <= 0.0:
                if ends[1] <= 0.0:
                    return np.zeros(2), most
                now = brentq(lambda t: section.acceleration(0.0, 0.0, push(t)), now, dt)
                now = math.nextafter(now, dt) + 1e-12
            state = np.array([0.0, 0.0])
        begin = state if state[0] != 0.0 or state[1] != 0.0 else np.array([1e-18, 0.0])
        run = solve_ivp(
            slope,
            (now, dt),
            begin,
            method="DOP853",
            events=(strikes, peaks),
            rtol=1e-11,
            atol=1e-13,
        )
        assert run.t_events is not None
        assert run.y_events is not None
        most = max(most, float(run.y[0].max()), *(float(y[0]) for y in run.y_events[1]))
        if run.status == 1:
            now, speed = float(run.t_events[0][0]), float(run.y_events[0][0][1])
            after = -restitution * speed
            state = np.array([0.0, after if after > STILL else 0.0])
        else:
            now, state = dt, run.y[:, -1]
    return state, most
