"""Blocks, pulses and runs that several tests of time histories share."""

import math
from typing import Any

from rocksteady import Block, DimensionlessBlock, Harmonic, Piecewise, State, simulate
from rocksteady.histories import Trajectory
from rocksteady.motions import Segment

BARE = DimensionlessBlock(restitution=0.8)
HOUSNER = Block.from_radius(alpha=0.2, radius=1.0, gravity=9.81)  # R = 1 m, as in results.md


def rocked(
    a: float, w: float, r: float, angle: float, velocity: float, phase: float = 0.0, **more: Any
) -> Trajectory:
    return simulate(
        DimensionlessBlock(restitution=r),
        Harmonic(amplitude=a, frequency_ratio=w, phase=phase),
        start=State(angle=angle, velocity=velocity),
        **more,
    )


def pulse(*pieces: Segment) -> Piecewise:
    return Piecewise(pieces=pieces)


def rectangle(a: float, duration: float) -> Piecewise:
    return pulse(Segment(duration=duration, constant=a))


def half_sine(a: float, w: float) -> Piecewise:
    return pulse(Segment(duration=math.pi / w, amplitude=a, frequency=w))


def one_sine(a: float, w: float) -> Piecewise:
    return pulse(Segment(duration=2.0 * math.pi / w, amplitude=a, frequency=w))


def versed_sine(a: float, duration: float) -> Piecewise:
    w = 2.0 * math.pi / duration
    return pulse(
        Segment(
            duration=duration,
            constant=0.5 * a,
            amplitude=0.5 * a,
            frequency=w,
            phase=-0.5 * math.pi,
        )
    )


def triangle(a: float, duration: float) -> Piecewise:
    half = 0.5 * duration
    return pulse(
        Segment(duration=half, slope=a / half),
        Segment(duration=half, constant=a, slope=-a / half),
    )
