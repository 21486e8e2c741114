"""What a file states against what the caller gives."""

from pathlib import Path

from tests.records.formats.networks import CM, read
from tests.records.writers import smc


def test_an_interval_other_than_the_stated_one_is_told(tmp_path: Path) -> None:
    for factor, told in ((1.0, 0), (1.0 + 1e-8, 0), (1.0 - 1e-5, 1), (1.0 + 1e-5, 1), (2.0, 1)):
        (found,) = read(tmp_path, smc(CM), dt_s=0.005 * factor)
        assert found.record.dt_s == 0.005 * factor
        assert len([each for each in found.warnings if "0.005 s between" in each]) == told, factor
