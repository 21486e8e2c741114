"""Samples that the tests of all networks write, read and compare."""

from pathlib import Path

import numpy as np
import pytest

from rocksteady.records import Recording, read_recordings
from tests.records.writers import samples

CM = samples(403, peak=150.0)


def read(tmp_path: Path, text: str, **given: float | str) -> tuple[Recording, ...]:
    path = tmp_path / "hut.txt"
    path.write_text(text)
    return read_recordings(path, **given)  # type: ignore[arg-type]


def close(recording: Recording, in_cm: np.ndarray, half_digit: float) -> None:
    np.testing.assert_allclose(
        recording.record.acceleration_m_s2, 0.01 * in_cm, rtol=1e-12, atol=0.0101 * half_digit
    )
    if recording.stated_peak_m_s2 is not None:
        assert recording.record.peak_acceleration_m_s2 == pytest.approx(
            recording.stated_peak_m_s2, rel=1e-3
        )
