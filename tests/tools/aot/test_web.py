"""The loader of the WebAssembly module, and the types that are made from the kernels."""

import json
import re
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.explorer._program import PARTS
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.orbits.return_map import Section
from tests.every import every
from tests.strategies import PLAIN
from tools.aot.replay.outcome import MissingProgramError
from tools.aot.replay.wasm import node
from tools.aot.targets import PAGE, TARGETS, WASM
from tools.aot.web.generated import FILES, WEB, signatures, types

SCRIPT = """
import { readFileSync } from 'node:fs';
import { load } from '%(loader)s';
const bytes = readFileSync('%(module)s');
const kernels = await load(bytes);
%(lines)s
"""


def in_node(built: Path, folder: Path, lines: str, target: str = WASM) -> Any:
    """Return what a script prints as JSON that has the kernels at hand."""
    script = folder / "script.mjs"
    values = {"loader": (WEB / "loader.mjs").as_uri(), "module": built / TARGETS[target].file}
    script.write_text(SCRIPT % {**values, "lines": lines}, encoding="utf-8")
    try:
        command = [*node(), str(script)]
    except MissingProgramError as error:
        pytest.skip(str(error))
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout)


@every("file", FILES)
def test_what_is_made_from_the_kernels_is_up_to_date(file: Path) -> None:
    assert file.read_text(encoding="utf-8") == FILES[file](), "run `python -m tools.aot.web`"


def test_the_page_knows_the_kernels_that_it_calls_and_no_other() -> None:
    texts = "".join(file.read_text("utf-8") for file in sorted(PARTS.rglob("*.mjs")))
    called = set(re.findall(r"\bkernels\.(\w+)", texts)) & ENTRIES.keys()
    called |= {
        f"fill_{name}" for name in re.findall(r"\bevaluate(?:Each)?\([\w.]*kernels, '(\w+)'", texts)
    }
    assert called == set(TARGETS[PAGE].entries)


def test_every_kernel_has_its_signature_and_its_types() -> None:
    for name in ENTRIES:
        assert f"\n  {name}: {{ takes: [" in signatures()
        assert re.search(rf"^  {name}\(.*\): .*;$", types(), re.MULTILINE), name
    march = "march(tables: Tables, start: March, until: Until, kept: Kept): [number, March];"
    assert march in types()
    assert "march: { takes: [Tables, March, Until, Kept], gives: ['i', March] }" in signatures()
    assert "const Kept = { rows: 'f2', peaks: 'f1' };" in signatures()
    assert "multipliers(jacobian: Jacobian, determinant: number): [[number, number]," in types()


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="no library is loaded")
def test_results_are_numbers_objects_and_arrays_as_in_python(built: Path, tmp_path: Path) -> None:
    found = in_node(
        built,
        tmp_path,
        """
        const orbit = kernels.symmetric_orbit(2, 4, 0.8, 1, 1);
        const clock = kernels.clock(-20.5);
        const sides = kernels.array('f', [2, 3], [0.8, 1, 1, 0.8, 1, 1]);
        const system = kernels.make_system(2, 4, sides);
        const state = { side: 1, half_cycles: 0, phase: 0.5, speed: 0.3 };
        const step = kernels.next_passage(system, state, -1);
        const pair = kernels.multipliers(step.jacobian, 0.4);
        const table = kernels.array('f', [2, 4], [1, 0, 0.5, 0.3, -1, 1, 0.5, 0.3]);
        const alike = [1, 2].map((passages) => kernels.is_symmetric(system, table, passages, 1));
        const nothing = kernels.fill_exp(kernels.array('f', [1], [1]), kernels.array('f', [1]));
        const found = { orbit, clock, system, step, pair, alike, nothing: nothing === undefined };
        console.log(JSON.stringify(found));
        """,
    )
    orbit = ENTRIES["symmetric_orbit"](2.0, 4.0, 0.8, 1, 1)
    assert found["orbit"] == orbit._asdict()
    assert found["clock"] == list(ENTRIES["clock"](-20.5))
    sides = np.array([[0.8, 1.0, 1.0]] * 2)
    system = ENTRIES["make_system"](2.0, 4.0, sides)
    assert found["system"]["positive"] == system.positive._asdict()
    assert found["system"]["restitution"] == [0.8, 0.8]
    step = ENTRIES["next_passage"](system, Section(1, 0, 0.5, 0.3), -1.0)
    assert found["step"]["state"] == step.state._asdict()
    pair = ENTRIES["multipliers"](step.jacobian, 0.4)
    assert found["pair"] == [[value.real, value.imag] for value in pair]
    table = np.array([[1.0, 0.0, 0.5, 0.3], [-1.0, 1.0, 0.5, 0.3]])
    assert found["alike"] == [ENTRIES["is_symmetric"](system, table, n, 1) for n in (1, 2)]
    assert found["alike"] == [False, True]
    assert found["nothing"] is True


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="no library is loaded")
def test_the_page_has_the_entries_that_it_calls(built: Path, tmp_path: Path) -> None:
    names = "Object.keys((await WebAssembly.instantiate(bytes, {})).instance.exports)"
    lines = f"console.log(JSON.stringify({names}));"
    whole, page = (
        {name.removeprefix("rs_") for name in in_node(built, tmp_path, lines, target)}
        for target in (WASM, PAGE)
    )
    assert whole >= ENTRIES.keys()
    assert page & ENTRIES.keys() == set(TARGETS[PAGE].entries)
    small, large = ((built / TARGETS[name].file).stat().st_size for name in (PAGE, WASM))
    assert small < 0.85 * large


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="no library is loaded")
def test_arrays_outlive_the_growth_of_the_memory(built: Path, tmp_path: Path) -> None:
    found = in_node(
        built,
        tmp_path,
        """
        const x = kernels.array('f', [3], [0, 1, 2]), y = kernels.array('f', [3]);
        const before = x.values;
        const large = kernels.array('f', [5000000]);
        kernels.fill_exp(x, y);
        const zeros = large.values.every(value => value === 0);
        large.free();
        const again = kernels.array('f', [5000000]);
        console.log(JSON.stringify({
            x: [...x.values], y: [...y.values], moved: before.length === 0, zeros,
            reused: again.values.every(value => value === 0), shape: x.shape,
        }));
        """,
    )
    out = np.zeros(3)
    ENTRIES["fill_exp"](np.arange(3.0), out)
    assert found["y"] == out.tolist()
    assert found["x"] == [0.0, 1.0, 2.0]
    assert found["moved"] is True, "the memory has grown, or this test tests nothing"
    assert (found["zeros"], found["reused"], found["shape"]) == (True, True, [3])


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="no library is loaded")
@pytest.mark.parametrize(
    "call", ["fill_exp(floats, whole)", "fill_exp(table, floats)", "next_passage(3)"]
)
def test_an_array_of_another_type_is_refused(call: str, built: Path, tmp_path: Path) -> None:
    found = in_node(
        built,
        tmp_path,
        f"""
        const floats = kernels.array('f', [2]), whole = kernels.array('i', [2]);
        const table = kernels.array('f', [2, 1]);
        let error = null;
        try {{ kernels.{call}; }} catch (found) {{ error = found.constructor.name; }}
        console.log(JSON.stringify([error, typeof kernels.{call.partition("(")[0]}]));
        """,
    )
    assert found == ["TypeError", "function"]
