"""A module with some of its entries: it computes the same with them, and is smaller."""

import json
import subprocess
from pathlib import Path

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer._trim import trimmed
from rocksteady.explorer.module import page_module
from tests.strategies import PLAIN
from tools.aot.replay.wasm import node

KEPT = frozenset({"fill_sin", "clock"})
EXPORTS = """
const fs = require('fs');
WebAssembly.instantiate(fs.readFileSync(process.argv[1]), {}).then(({ module, instance }) => {
  const { memory, malloc, _initialize, rs_clock } = instance.exports;
  _initialize?.();
  const at = malloc(64), data = new DataView(memory.buffer);
  data.setFloat64(at, 7.5, true);
  rs_clock(at);
  console.log(JSON.stringify([WebAssembly.Module.exports(module).map(({ name }) => name),
    Number(new DataView(memory.buffer).getBigInt64(at + 8, true))]));
});
"""


@pytest.fixture(scope="module")
def module() -> bytes:
    if PLAIN:
        pytest.skip("no library is loaded")
    try:
        return page_module().read_bytes()
    except MissingKernelsError as error:
        pytest.skip(str(error))


def test_what_is_kept_computes_and_nothing_else_is_left(module: bytes, tmp_path: Path) -> None:
    file = tmp_path / "trimmed.wasm"
    file.write_bytes(trimmed(module, KEPT))
    ran = subprocess.run(
        [*node(), "-e", EXPORTS, str(file)], capture_output=True, text=True, check=True
    )
    names, halves = json.loads(ran.stdout)
    entries = {name for name in names if name.startswith("rs_")} - {"rs_sources"}
    assert entries == {f"rs_{name}" for name in KEPT}
    assert {"memory", "malloc", "free"} <= set(names)
    assert halves == 2  # half cycles of a phase of 7.5


def test_a_module_without_a_march_is_small(module: bytes) -> None:
    assert len(trimmed(module, KEPT)) < 0.15 * len(module)


def test_all_entries_leave_all_that_they_reach(module: bytes) -> None:
    everything = frozenset({"march", "run_facts", "settle", "settle_cells", "pulse_fates"})
    made = trimmed(module, everything)
    assert trimmed(made, everything) == made
    assert len(made) > 0.7 * len(module)
