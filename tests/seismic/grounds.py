"""Grounds of seconds that shake blocks hard enough, and the spectra of them."""

import numpy as np

from rocksteady import Record
from tests.records import synthetic

STEP = 0.02  # s
ALPHAS = (0.12, 0.2, 0.3)
PERIODS = (1.0, 1.7, 2.4, 3.3, 5.0)


def ground(seed: int = 5, peak: float = 5.0, samples: int = 300, name: str = "noise") -> Record:
    values = synthetic(np.random.default_rng(seed), samples, STEP, peak)
    return Record(acceleration_m_s2=values, dt_s=STEP, name=name)


def lifting(seed: int = 6, peak: float = 4.0, samples: int = 380) -> Record:
    """Return vertical motion, longer than the horizontal and of another interval."""
    values = synthetic(np.random.default_rng(seed), samples, 0.7 * STEP, peak)
    return Record(acceleration_m_s2=values, dt_s=0.7 * STEP, name="up")
