"""Blocks and base motions drawn at random, as tables that kernels take."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.core.tables import (
    ALPHA,
    KEY,
    LEAN,
    LEFT_OUT,
    NONLINEAR_SIDE_COLUMNS,
    RATE,
    RESTITUTION,
    SCATTER,
    SCATTERED_SIDE_COLUMNS,
    SIDE_COLUMNS,
)
from rocksteady.kernels.elementary.arrays import exp, sin
from rocksteady.model.blocks.block import Block
from rocksteady.model.equations import Nonlinear
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.impulses import Impulses
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Harmonic, Piecewise, Segment

Floats = NDArray[np.float64]

CENTRES = np.array([[0.2, 0.75], [0.3, 0.7]])
"""Where the mass centre of a block lies, for the forces on its base."""
SLENDER = Block.from_p(alpha=0.25, p=2.0)
"""The block whose units the tables of records and of the nonlinear model have."""
PULSES = ("half-sine", "one-sine", "one-cosine", "ricker", "type-c2")
MOTIONS = ("harmonic", "record", "pulse", "pieces", "impulses")


@dataclass(frozen=True)
class Drawn:
    """Draws blocks and motions; each name has a row of random numbers of its own.

    Attributes
    ----------
    rng
        Where the numbers come from.
    """

    rng: np.random.Generator

    @classmethod
    def by_name(cls, name: str) -> "Drawn":
        """Return one whose numbers the name alone decides."""
        return cls(np.random.default_rng([1989, *name.encode()]))

    def between(self, low: float, high: float) -> float:
        """Return a number of [low, high)."""
        return float(self.rng.uniform(low, high))

    def over(self, low: float, high: float) -> float:
        """Return a number of [low, high), even in the logarithm."""
        return float(exp(self.rng.uniform(math.log(low), math.log(high))))

    def chance(self, share: float) -> bool:
        """Return True as often as that."""
        return bool(self.rng.random() < share)

    def sides(
        self, count: int, *, nonlinear: bool, alike: float = 0.5, scattered: bool = False
    ) -> Floats:
        """Return the sides of blocks, shape (count, 2, 3), (count, 2, 5) or (count, 2, 7).

        Parameters
        ----------
        count
            Number of blocks.
        nonlinear
            Whether they are those of the nonlinear model.
        alike
            Share of blocks whose sides are alike.
        scattered
            Whether their restitution scatters.
        """
        rng = self.rng
        columns = NONLINEAR_SIDE_COLUMNS if nonlinear else SIDE_COLUMNS
        sides = np.ones((count, 2, SCATTERED_SIDE_COLUMNS if scattered else columns))
        sides[:, :, SIDE_COLUMNS:] = 0.0
        sides[:, :, RESTITUTION] = rng.uniform(0.45, 0.99, (count, 2))
        sides[:, 1, LEAN] = rng.uniform(0.6, 1.6, count)
        sides[:, 1, RATE] = rng.uniform(0.8, 1.25, count)
        if nonlinear:
            sides[:, 0, ALPHA] = rng.uniform(0.05, 0.6, count)
            sides[:, 1, ALPHA] = sides[:, 0, ALPHA] * sides[:, 1, LEAN]
            sides[:, :, LEFT_OUT] = 1e-15
        if scattered:
            sides[:, :, SCATTER] = rng.uniform(0.02, 0.3, (count, 1))
            sides[:, :, KEY] = rng.integers(0, 2**53, (count, 1))
        same = rng.random(count) < alike
        sides[same, 1] = sides[same, 0]
        return sides

    def shaking(self) -> tuple[float, float]:
        """Return amplitude and frequency ratio of a harmonic motion that may rock a block."""
        ratio = self.over(0.5, 12.0)
        return self.between(0.9, 1.2 + 0.5 * ratio), ratio

    def record(self, samples: int) -> Record:
        """Return a record that makes `SLENDER` rock, and may overturn it."""
        noise = self.rng.normal(size=samples + 8)
        smooth = sum(noise[k : samples + k] for k in range(9)) / 3.0
        grown = sin(np.linspace(0.0, math.pi, samples)) * smooth
        size = self.between(1.2, 3.5) * SLENDER.uplift_acceleration
        return Record(
            acceleration_m_s2=size * grown / np.abs(grown).max(), dt_s=self.between(0.02, 0.08)
        )

    def segments(
        self, kind: str, *, nonlinear: bool, samples: int = 60, lift: float = 0.5
    ) -> Floats:
        """Return the table of a motion, which ends on a still base unless it is harmonic.

        Parameters
        ----------
        kind
            One of `MOTIONS`.
        nonlinear
            Whether the table is that of the nonlinear model; a record has vertical motion then.
        samples
            Of a record.
        lift
            Vertical acceleration of a record over the horizontal one of another.
        """
        amplitude, ratio = self.shaking()
        vertical = None
        motion: Harmonic | Pulse | Record | Piecewise | Impulses
        if kind == "harmonic":
            motion = Harmonic(
                amplitude=amplitude, frequency_ratio=ratio, phase=self.between(-3.0, 3.0)
            )
        elif kind == "record":
            motion = self.record(samples)
            vertical = self.record(samples // 2).scaled(lift)
        elif kind == "pulse":
            shape = str(self.rng.choice(PULSES))
            motion = Pulse(shape=shape, amplitude=amplitude, frequency_ratio=ratio, tolerance=3e-2)
        elif kind == "impulses":
            times = np.sort(self.rng.uniform(0.0, 4.0, 4))
            kicks = self.rng.uniform(-0.6, 0.6, 4)
            motion = Impulses(velocities=tuple(kicks.tolist()), times=tuple(times.tolist()))
        else:
            motion = Piecewise(
                pieces=tuple(
                    Segment(
                        duration=self.over(0.05, 2.0),
                        constant=self.between(-1.5, 1.5),
                        slope=self.between(-2.0, 2.0),
                        amplitude=self.between(0.0, 2.0),
                        frequency=self.over(0.5, 20.0),
                        phase=self.between(-3.0, 3.0),
                    )
                    for _ in range(6)
                )
            )
        if nonlinear:
            return Nonlinear().lower(SLENDER, motion, vertical).segments
        return segment_table(motion, SLENDER)
