"""The freeze of answers: what has moved is seen, and what differs from run to run is left out."""

import itertools
import json
import math
import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import rocksteady as rs
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.sources import sources_hash
from tests.manual.lines import TYPED, shortened
from tests.strategies import PLAIN
from tools.freeze import __main__ as program
from tools.freeze import commands, files, kernels, records
from tools.freeze.run import Frozen
from tools.freeze.values import STORED, of_array, of_dataset, of_json, plain, tidy

ITEMS = {"steady -A 2": "exit 0\nregion  2\n\nangle  0.5", "long": "x" * 500, "empty": ""}


def test_records_are_read_as_they_are_written() -> None:
    short = {name: records.abridged(text) for name, text in ITEMS.items()}
    content = records.dumped(short)
    assert records.loaded(content) == short
    assert records.dumped(records.loaded(content)) == content
    assert records.moved(short, dict(reversed(short.items()))) == {}


def test_what_is_new_gone_or_another_value_is_named_with_both_values() -> None:
    now = {"steady -A 2": ITEMS["steady -A 2"].replace("0.5", "0.25"), "more": "1", "empty": ""}
    assert list(records.moved(ITEMS, now).values()) == [
        "gone: long",
        "new: more",
        "moved: steady -A 2\n  -angle  0.5\n  +angle  0.25",
    ]


def test_what_differs_by_rounding_alone_is_not_apart() -> None:
    hexed, near, far = ((2.0 / 3.0 + each).hex() for each in (0.0, 1e-10, 1e-5))
    hashes = records.digest("a"), records.digest("b")
    same = (
        (hexed, near),
        (f"peak={hexed}, side=1", f"peak={near}, side=1"),
        ("0.123 g of 1.23e-05", "0.124 g of 1.24e-05"),
        ("0.666666666666 to nan", "0.666666766666 to nan"),
        ("0x0.0p+0", (1e-10).hex()),
        (f"<f8[9] -1.5 to 2.25 {hashes[0]}", f"<f8[9] -1.5 to 2.25 {hashes[1]}"),
        ("", ""),
    )
    another = (
        (hexed, far),
        (hexed, "nan"),
        ("nan", "inf"),
        ("0.123 g", "0.125 g"),
        ("0.123 g", "0.123 m"),
        ("-0.5", "0.5"),
        ("1.2", "1.3"),
        ("3 runs", "4 runs"),
        ("0.666666666666", "0.666668"),
        (hashes[0], "1.5"),
        (f"<f8[9] -1.5 to 2.25 {hashes[0]}", f"<f8[9] -1.5 to 2.27 {hashes[0]}"),
        (f"<f8[9] -1.5 to 2.25 {hashes[0]}", f"<f4[9] -1.5 to 2.25 {hashes[0]}"),
        ("a", "a\nb"),
        ("a\nb", "a"),
    )
    assert [pair for pair in same if records.apart(*pair)] == []
    assert [pair for pair in another if not records.apart(*pair)] == []


def test_long_items_are_compared_to_their_ends_except_for_rounding() -> None:
    values = [(-1.0) ** k / k**4 for k in range(1, 60)]

    def line(**changed: float) -> str:
        every = dict(enumerate(values)) | {int(k[1:]): value for k, value in changed.items()}
        return "<f8[59] " + ", ".join(f"side={value.hex()}" for value in every.values())

    kept = records.abridged(line())
    assert records.apart(kept, line()) == ""
    assert (
        records.apart(kept, line(_0=-1.0 + 1e-10, _3=values[3] + 1e-10, _50=values[50] + 1e-10))
        == ""
    )
    for moved in (line(_3=values[3] + 1e-3), line(_50=values[50] + 1e-3), line(_9=-values[9])):
        assert records.apart(kept, moved).endswith(f"not {kept}")
    assert records.apart(kept, line(_40=values[41], _41=values[40]))
    assert records.apart(kept, f"{line()}, side={(0.0).hex()}")
    assert records.apart(kept, line().replace("side=0x1.5", "size=0x1.5"))

    waves = [f"{math.sin(k):.9f}" for k in range(60)]
    kept = records.abridged(", ".join(waves))
    for one, other in itertools.combinations(range(20, 60), 2):
        swapped = list(waves)
        swapped[one], swapped[other] = waves[other], waves[one]
        assert records.apart(kept, ", ".join(swapped)), (one, other)

    long = "\n".join(f"row {k}, {0.001 * k:.3f} m" for k in range(1000))
    kept = records.abridged(long)
    assert records.apart(kept, long) == records.apart(kept, long.replace("0.999", "1.000")) == ""
    for was, now in (
        *(("row 999", "row 7"), ("row 7,", "row 8,"), ("0.500", "0.800"), ("0.500", "-0.500")),
        *(("0.998 m", "0.998 g"), ("row 500, 0.500 m\nrow 501", "row 501"), ("0.500", "nan")),
    ):
        assert records.apart(kept, long.replace(was, now)), (was, now)
    assert records.apart(kept, f"{long}\nrow").startswith("1001 lines, not")
    without = kept.rpartition(", ")[0]
    assert records.apart(without, long), "a record without what stands for its rest"


@pytest.mark.parametrize("text", ["\n".join(map(str, range(1000))), "7" * 1000])
def test_what_is_too_long_to_keep_counts_to_its_last_letter(text: str) -> None:
    short = records.abridged(text)
    assert len(short) < 300
    for place in (0, len(text) // 2, len(text) - 1):
        assert records.abridged(text[:place] + "x" + text[place + 1 :]) != short


def test_each_line_of_help_and_pages_is_recorded_and_ends_well() -> None:
    """A line that is new or changed is recorded first: `make freeze-all`."""
    held: dict[str, str] = {}
    for name in ("commands", "long-commands"):
        held |= records.loaded((records.FOLDER / f"{name}.txt").read_text(encoding="utf-8"))
    lines = [line for line in (*commands.examples(), *TYPED) if not commands.ELSEWHERE.search(line)]
    assert len(lines) > 200
    forms = {line: [*commands.forms(shortened(line))] for line in lines}
    ended = {line: [held.get(form, "not recorded") for form in forms[line]] for line in lines}
    # Of the few records of the pages' folders there may be no answer.
    well = re.compile("exit 0|exit 3\nNo answer")
    wrong = {line: ends for line, ends in ended.items() if not any(map(well.match, ends))}
    assert wrong == {}


def test_texts_lose_places_versions_and_addresses_but_no_number(tmp_path: Path) -> None:
    given = f"{tmp_path}/map.zarr rocksteady {rs.__version__}, {sources_hash()} at 0x7f12ab34"
    assert tidy(given, tmp_path) == "FOLDER/map.zarr rocksteady VERSION, SOURCES at ADDRESS"
    took = f"36 cells computed in 0.02 s, 1,548 a second\n{tempfile.gettempdir()}/rocksteady-a1/x"
    assert tidy(took) == "36 cells computed in DURATION\nTEMPORARY/x"
    numbers = "0.1, 0.10, 1.0, 10.1.0.2, 0.1.05, -3.5e-07 s, 12 s of 0.10, 2 runs fall in 0.5 s"
    assert tidy(numbers, tmp_path) == numbers


def test_json_loses_durations_and_what_a_store_says_of_its_code_alone() -> None:
    inputs = json.dumps({"case": "rocksteady.dynamics:settled", "axes": {"from": 0.1}})
    given = {"seconds": 0.2, "b": 1, "a": {"seconds": 3, "source": "x"}, "inputs": inputs}
    assert of_json(json.dumps(given)).splitlines() == [
        "b: 1",
        'a: {"source": "x"}',
        'inputs: {"case": "rocksteady.dynamics:settled", "axes": {"from": 0.1}}',
    ]
    assert of_json(json.dumps(given), STORED).splitlines() == [
        "b: 1",
        "a: {}",
        'inputs: {"axes": {"from": 0.1}}',
    ]


def test_every_bit_of_a_value_counts_except_which_nan_it_is() -> None:
    values = np.linspace(0.1, 1.0, 100)
    for change in (np.nextafter(values, 2.0), values.astype(np.float32), values.reshape(10, 10)):
        assert of_array(change) != of_array(values)
    assert of_array(np.array([0.0])) != of_array(np.array([-0.0]))
    other = np.array([0x7FF8000000000001], dtype=np.uint64).view(np.float64)
    assert kernels.of_bits(other) == kernels.of_bits(np.array([np.nan]))
    assert plain(0.1) == (0.1).hex()
    assert plain({"b": 1, "a": (2.5, None)}) == "{b: 1, a: [0x1.4000000000000p+1, None]}"
    dataset = xr.Dataset({"peak": ("x", values)}, attrs={"source": "rocksteady 01", "cycles": 3})
    again = dataset.assign_attrs(source="rocksteady 02")
    assert of_dataset(again) == of_dataset(dataset) != of_dataset(dataset.assign_attrs(cycles=4))


def test_a_store_is_its_chunks_and_its_metadata(tmp_path: Path) -> None:
    found: list[str] = []
    for restitution in (0.8, 0.8, 0.81):
        path = tmp_path / f"{len(found)}.zarr"
        axes = {"amplitude": [0.5, 2.0], "frequency_ratio": [1.0, 2.0]}
        block = rs.DimensionlessBlock(restitution=restitution)
        rs.map_fates(block, axes=axes, cycles=5, run=rs.Execution(store=path))
        found.append(files.of_store(path))
    assert found[0] == found[1] != found[2]
    assert re.search(r"^fate/c\S+ \d+ bytes, [0-9a-f]{16}$", found[0], re.MULTILINE)


def test_a_line_is_frozen_with_its_streams_and_files() -> None:
    text, made = sorted(commands.forms("steady -A 2 -W 4 -r 0.8 --json --plot a.png"))
    assert text == "steady -A 2 -W 4 -r 0.8"
    assert made == f"{text} --json --csv x.csv --plot x.svg"
    found = dict(commands.freeze_line(text))
    assert list(found) == [text]
    assert found[text].startswith("exit 0\n")
    refused = dict(commands.freeze_line("steady -A -2 -W 4 -r 0.8"))
    assert next(iter(refused.values())).startswith("exit 2\n\nrocksteady: --amplitude/-A = -2.0 ")


@pytest.mark.skipif(PLAIN, reason="takes long uncompiled")
def test_calls_of_a_kernel_are_the_same_ones_each_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernels, "CALLS", 50)
    (first,) = kernels.freeze_entry("symmetric_orbit")
    (again,) = kernels.freeze_entry("symmetric_orbit")
    assert first == again
    exact = ENTRIES["symmetric_orbit"]

    def another(*arguments: float) -> object:
        found = exact(*arguments)
        return found._replace(phase=float(np.nextafter(found.phase, 9.0)))

    another.__annotations__ = exact.__annotations__
    monkeypatch.setitem(ENTRIES, "symmetric_orbit", another)
    assert list(kernels.freeze_entry("symmetric_orbit")) != [first]


def test_a_changed_answer_is_printed_and_ends_with_1(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    answers = {"orbit": "peak 0.5", "node: 1": "0 differ"}
    missing: dict[str, str] = {}
    monkeypatch.setattr(records, "FOLDER", tmp_path)
    monkeypatch.setattr(
        "tools.freeze.run.frozen", lambda *_: [Frozen("things", answers, missing, 0.1)]
    )
    assert program.main(["record", "things"]) == 0
    assert program.main(["compare", "things"]) == 0
    answers["orbit"] = "peak 0.25"
    capsys.readouterr()
    assert program.main(["compare", "things"]) == 1
    assert "moved: orbit\n  -peak 0.5\n  +peak 0.25\n1 items have moved" in capsys.readouterr().out
    answers |= {"orbit": "peak 0.5"}
    del answers["node: 1"]
    assert program.main(["compare", "things"]) == 1
    missing["node"] = "it is not installed"
    assert program.main(["compare", "things"]) == 0
    assert "node is not compared: it is not installed" in capsys.readouterr().out
