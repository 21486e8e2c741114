"""Small ground-motion files for the program to read."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import detrend

from tests.records import ABSENT, FOLDER, synthetic

Floats = NDArray[np.float64]


def samples(seed: int = 1, peak_g: float = 0.6) -> Floats:
    """Twelve seconds of noise like an earthquake's [g], without a drift, rounded as in files."""
    values: Floats = detrend(synthetic(np.random.default_rng(seed), 601, 0.02, 1.0))
    rounded: Floats = np.round(peak_g / np.abs(values).max() * values, 7)
    return rounded


def at2(file: Path, values_g: Floats, dt_s: float = 0.02, component: str = "090") -> Path:
    """Write a PEER file."""
    head = f"PEER NGA STRONG MOTION DATABASE RECORD\nTown, 1/2/1990, Hut, {component}\n"
    head += f"ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {len(values_g)}, DT= {dt_s} SEC\n"
    rows = (values_g[k : k + 5] for k in range(0, len(values_g), 5))
    body = "\n".join("".join(f"{value:15.7E}" for value in row) for row in rows)
    file.write_text(head + body + "\n", encoding="ascii")
    return file


def real(pattern: str) -> Path:
    """Return a real PEER file; the test is skipped without it."""
    found = sorted((FOLDER / "peer_at2").glob(pattern))
    if not found:
        pytest.skip(ABSENT)
    return found[0]
