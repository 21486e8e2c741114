"""Attractors that several tests ask for, and a check of one by the return map alone."""

import math
from dataclasses import replace

import pytest

from rocksteady import DimensionlessBlock, Harmonic, Rest, State, Steady, find_attractor
from rocksteady.orbits import Attractor
from tests.dynamics.kicks import apart, around

Start = Rest | State | Steady


def settled(
    amplitude: float,
    frequency: float,
    restitution: float,
    *,
    phase: float = 0.0,
    side: int | None = None,
    **more: object,
) -> Attractor:
    """Return the attractor of a point; `side` is that of a `Steady` start."""
    if side is not None:
        start = more.get("start", Steady())
        assert isinstance(start, Steady)
        more["start"] = replace(start, side=side)
    return find_attractor(
        DimensionlessBlock(restitution=restitution),
        Harmonic(amplitude=amplitude, frequency_ratio=frequency, phase=phase),
        **more,  # type: ignore[arg-type]
    )


def is_an_orbit_that_attracts(found: Attractor) -> None:
    """Check an attractor by the return map alone."""
    orbit = found.orbit
    assert orbit is not None
    assert orbit.stable
    assert orbit.residual <= 1e-12
    assert found.kind.value == orbit.kind
    assert found.period == orbit.period
    assert found.peaks == (orbit.highest, orbit.lowest)
    assert found.lyapunov < 0.0
    round_once = around(orbit)(orbit.states[0], len(orbit.states))
    assert apart(round_once.state, orbit.states[0]) < 1e-9
    assert round_once.phase == pytest.approx(2.0 * math.pi * orbit.period, rel=1e-9)
    if orbit.rest_phases:
        assert orbit.impacts is None
        assert found.lyapunov == orbit.lyapunov == -math.inf
        assert (orbit.multipliers == 0.0).all()
    else:
        assert found.lyapunov == pytest.approx(orbit.lyapunov, rel=1e-6, abs=1e-12)
