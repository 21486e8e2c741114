"""Records whose measures are known in closed form, and slow answers to what is exact."""

import numpy as np
from numpy.typing import NDArray

from rocksteady import Record

Floats = NDArray[np.float64]


def sine(samples: int = 4001, *, amplitude: float = 2.0, cycles: float = 1.0) -> Record:
    """Whole cycles of ``amplitude sin(2 pi t)``, closely sampled."""
    time = np.linspace(0.0, cycles, samples)
    return Record(
        acceleration_m_s2=amplitude * np.sin(2.0 * np.pi * time), dt_s=cycles / (samples - 1)
    )


def noise(seed: int, samples: int = 60, dt_s: float = 0.02) -> Record:
    """Samples without any order, whose lines cross zero in most of their intervals."""
    values = np.random.default_rng(seed).normal(size=samples)
    return Record(acceleration_m_s2=values, dt_s=dt_s)


def refined(record: Record, parts: int) -> Record:
    """The same motion with more samples on each of its lines."""
    values = record.acceleration_m_s2
    count = (len(values) - 1) * parts
    fine = np.interp(np.arange(count + 1) / parts, np.arange(len(values)), values)
    return Record(acceleration_m_s2=fine, dt_s=record.dt_s / parts)
