"""Files of SMC: header, samples, times and samples in turn, and what is refused."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from tests.every import every
from tests.records.formats.networks import CM, close, read
from tests.records.writers import smc


def test_smc(tmp_path: Path) -> None:
    (found,) = read(tmp_path, smc(CM))
    close(found, CM, 5e-3)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("smc", "cm/s^2", 0.005)
    assert (found.orientation, found.azimuth_deg) == ("horizontal", 0.0)
    assert (found.station, found.event) == ("Hut, 1295 Shafter", "Somewhere, CA")
    assert found.start_time == datetime(1989, 10, 18, 17, 4, 5, 250000, tzinfo=UTC)
    assert found.warnings == ()


def test_smc_states_when_its_peak_comes_on_either_side(tmp_path: Path) -> None:
    for values in (CM, -CM):
        assert read(tmp_path, smc(values))[0].warnings == ()
        early = np.roll(values, 50)
        text = smc(values).partition("| 12.5")[0] + "|" + smc(early).partition("|")[2]
        (found,) = read(tmp_path, text)
        assert "its peak comes after" in "".join(found.warnings)


def test_smc_vertical_and_without_comments(tmp_path: Path) -> None:
    (found,) = read(tmp_path, smc(CM, comments=0, angles=(0, 0)))
    close(found, CM, 5e-3)
    assert found.orientation == "vertical"


def test_smc_counts_its_comments_with_or_without_their_bar(tmp_path: Path) -> None:
    for comment in ("| 12.5 of comment", "12.5 of comment"):
        (found,) = read(tmp_path, smc(CM).replace("| 12.5 of comment", comment))
        close(found, CM, 5e-3)
        assert found.warnings == ()


def test_smc_of_times_and_samples_in_turn(tmp_path: Path) -> None:
    times = 0.00149 * np.arange(len(CM))
    times[9::10] += 0.0006
    pairs = np.column_stack([times, CM]).ravel()
    text = smc(pairs, rate=None, first="1 UNCORRECTED ACCELEROGRAM")
    with pytest.raises(RecordFileError, match="ask for resampling"):
        read(tmp_path, text)
    (found,) = read(tmp_path, text, resample=True, dt_s=0.001)
    assert found.record.dt_s == 0.001
    assert found.record.peak_acceleration_m_s2 == pytest.approx(1.5, rel=0.2)


@every("first", ["3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA"])
def test_smc_of_another_quantity_is_refused(tmp_path: Path, first: str) -> None:
    with pytest.raises(RecordFileError, match=r"line 1, .*must be an accelerogram"):
        read(tmp_path, smc(CM, first=first))


def test_smc_that_is_cut(tmp_path: Path) -> None:
    lines = smc(CM).split("\n")
    for kept in (12, 16, 20, 28, 40):
        with pytest.raises(RecordFileError):
            read(tmp_path, "\n".join(lines[:kept]))
