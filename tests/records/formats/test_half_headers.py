"""A file of a network with half its header: refused, or a table of its samples and of no other."""

from pathlib import Path

import numpy as np

from rocksteady.errors import RecordFileError
from tests.every import every
from tests.records.formats.networks import CM, read
from tests.records.writers import at2, cosmos_channel, csmip_v2_channel, esm, knet, samples, smc

COUNTS = np.rint(1e5 * samples(800)).astype(np.int64) - 12085
DAMAGES = {
    "knet": (knet(COUNTS), 17, COUNTS),
    "esm": (esm(CM), 14, CM),
    "smc": (smc(CM), 27, CM),
    "cosmos": (cosmos_channel(CM), 46, CM),
    "csmip": (csmip_v2_channel(CM), 30, CM),
    "peer": (at2(samples(403)), 4, samples(403)),
}


@every("name", DAMAGES)
def test_half_a_header_adds_nothing_to_the_samples(tmp_path: Path, name: str) -> None:
    text, head, written = DAMAGES[name]
    lines = text.split("\n")
    rng = np.random.default_rng(3)
    for _ in range(30):
        kept = [line for line in lines[:head] if rng.random() < 0.5]
        damaged = "\n".join([*kept, *lines[head:]])
        try:
            (found,) = read(tmp_path, damaged, units="gal", dt_s=0.01)
        except RecordFileError:
            continue
        assert found.record.dt_s == 0.01
        expected = 0.01 * written
        if found.format == "knet":
            expected = read(tmp_path, text)[0].record.acceleration_m_s2
        np.testing.assert_allclose(
            found.record.acceleration_m_s2, expected, atol=1e-6, err_msg=str(kept)
        )
    (plain,) = read(tmp_path, "1.0\n-2.5\n0.5\n", format="columns", units="gal", dt_s=0.01)
    assert plain.format == "columns"
