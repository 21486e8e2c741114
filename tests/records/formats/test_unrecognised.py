"""A file of a network with half its header is refused, and does not pass for a table."""

from pathlib import Path

import numpy as np

from rocksteady.errors import RecordFileError
from tests.every import every
from tests.records.formats.networks import CM, read
from tests.records.writers import at2, cosmos_channel, csmip_v2_channel, esm, knet, samples, smc

COUNTS = np.rint(1e5 * samples(800)).astype(np.int64) - 12085
DAMAGES = {
    "knet": (knet(COUNTS), 17),
    "esm": (esm(CM), 14),
    "smc": (smc(CM), 27),
    "cosmos": (cosmos_channel(CM), 46),
    "csmip": (csmip_v2_channel(CM), 30),
    "peer": (at2(samples(403)), 4),
}


@every("name", DAMAGES)
def test_a_damaged_header_makes_no_table(tmp_path: Path, name: str) -> None:
    text, head = DAMAGES[name]
    lines = text.split("\n")
    rng = np.random.default_rng(3)
    for _ in range(30):
        kept = [line for line in lines[:head] if rng.random() < 0.5]
        damaged = "\n".join([*kept, *lines[head:]])
        try:
            found = read(tmp_path, damaged, units="gal", dt_s=0.01)
        except RecordFileError:
            continue
        # Where nothing is left of the header, it is a table, and the caller has named its unit.
        assert found[0].format not in {"csv", "columns"} or not any(map(str.strip, kept))
    (table,) = read(tmp_path, "1.0\n-2.5\n0.5\n", format="columns", units="gal", dt_s=0.01)
    assert table.format == "columns"
