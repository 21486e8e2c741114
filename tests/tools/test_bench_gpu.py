"""The script that measures a GPU: it runs by the emulation, and says what is missing."""

import json
import os
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from filelock import FileLock

from bench.gpu import __main__ as script
from bench.gpu import atlas, devices, report, stages, whole, work
from bench.report import EXPLORER, MEASURED_GPU, ROOT, write_section
from rocksteady.errors import InputError
from rocksteady.kernels.devices import FORMS
from rocksteady.kernels.machine_code.library import targets
from tests.gpu.fake_gpu import FakeDriver, fake_gpu, host_kernels
from tests.strategies import PLAIN
from tools.aot.build import LOWERED
from tools.aot.device.build import emulation
from tools.aot.link import compilers
from tools.aot.targets import TARGETS

pytestmark = pytest.mark.skipif(PLAIN, reason="takes minutes uncompiled")


@pytest.fixture(autouse=True)
def _same_environment() -> Iterator[None]:
    """Take back what a measurement sets for its process."""
    before = os.environ.copy()
    yield
    os.environ.clear()
    os.environ.update(before)


@pytest.fixture(scope="session", name="emulation")
def _emulation() -> None:
    """Build the emulation once."""
    if not targets() or not compilers(TARGETS[targets()[0]]):
        pytest.skip("no C compiler is in reach: gcc, clang or the package ziglang")
    LOWERED.mkdir(parents=True, exist_ok=True)
    with FileLock(LOWERED / "device.lock"):
        emulation()


def test_without_a_gpu_it_says_so_and_exits_with_2(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def none() -> None:
        raise InputError("executor", "gpu", "there is no GPU", "look for one")

    monkeypatch.setattr(devices, "loaded_driver", none)
    assert script.main(["--out", str(tmp_path)]) == 2
    said = capsys.readouterr()
    assert said.err == (
        "python -m bench.gpu: executor = 'gpu' is not valid: there is no GPU; look for one\n"
    )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.usefixtures("emulation")
def test_all_of_it_runs_by_the_emulation_and_finds_the_same_bits(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = ROOT / "docs" / "benchmarks.md"
    before = page.read_bytes()
    assert script.main(["--emulated", "--out", str(tmp_path), "--seconds", "200"]) == 0
    data = json.loads((tmp_path / "gpu-emulated.json").read_text(encoding="utf-8"))
    assert [row["kernel"] for row in data["sameness"]] == list(FORMS)
    for row in data["sameness"]:
        assert row["cells"] >= 64, row
        assert (row["classes"], row["bits"], row["first"]) == (0, 0, []), row
    assert {row["order"] for row in data["orders"]} >= {"expected length", "natural", "random"}
    assert [row["same"] for row in data["map"] if "same" in row] == [True, True]
    assert sum(data["atlas"]["kinds"].values()) == data["atlas"]["cells"] > 500
    assert (tmp_path / "gpu-atlas.png").stat().st_size > 10_000
    assert page.read_bytes() == before
    said = capsys.readouterr().out
    assert [name for name in script.SHARES if f"s  {name}: " not in said] == []


class TimingDriver(FakeDriver):
    """A fake driver with what only measurements ask of one: events, attributes, options."""

    CUfunction_attribute = SimpleNamespace(
        CU_FUNC_ATTRIBUTE_NUM_REGS=168, CU_FUNC_ATTRIBUTE_LOCAL_SIZE_BYTES=976
    )
    CUjit_option = SimpleNamespace(CU_JIT_MAX_REGISTERS=0)

    def __init__(self) -> None:
        super().__init__(host_kernels())
        self.CUdevice_attribute.CU_DEVICE_ATTRIBUTE_CLOCK_RATE = 13
        self.CUdevice_attribute.CU_DEVICE_ATTRIBUTE_MEMORY_CLOCK_RATE = 36
        self.answers |= {"cuDriverGetVersion": 13000, "cuEventCreate": 1}
        self.answers |= {"cuEventRecord": None, "cuEventElapsedTime": 2.0}
        self.caps: list[list[int]] = []

    def _cuModuleLoadDataEx(self, image: bytes, count: int, options: Any, values: Any) -> bytes:
        assert count == len(options) == len(values)
        self.caps.append(values)
        return image

    def _cuFuncGetAttribute(self, attribute: int, function: str) -> int:
        assert function in self.kernels
        return attribute


@pytest.mark.slow
def test_all_of_it_runs_on_a_fake_gpu_and_writes_its_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module, name, value in (
        (script, "ROOT", tmp_path),
        (script, "MANY", 512),
        (stages, "BATCHES", (64, 256)),
        (whole, "SIDES", (12,)),
    ):
        monkeypatch.setattr(module, name, value)
    driver, programs = TimingDriver(), tmp_path / "programs"
    programs.mkdir()
    with fake_gpu(programs, driver):
        given = ["--out", str(tmp_path / "out"), "--cells-compared", "640", "--seconds", "100"]
        assert script.main(given) == 0
    assert [128] in driver.caps
    data = json.loads((tmp_path / "out" / "gpu.json").read_text(encoding="utf-8"))
    assert {row["kernel"] for row in data["speed"]} == set(FORMS)
    assert {row["kernel_s"] for row in data["speed"]} == {2e-3}
    assert [row["bits"] for row in data["sameness"]] == [0] * len(FORMS)
    assert {row["block"] for row in data["shapes"]} == set(stages.BLOCKS)
    page = " ".join((tmp_path / "docs" / "benchmarks.md").read_text(encoding="utf-8").split())
    assert "**NVIDIA Imaginary** (compute capability 9.0, 2 multiprocessors" in page
    assert "**Atlas of coexisting motions**" in page


@pytest.mark.slow
@pytest.mark.usefixtures("emulation")
def test_time_that_is_up_ends_it_with_what_there_is(tmp_path: Path) -> None:
    assert script.main(["--emulated", "--out", str(tmp_path), "--seconds", "0"]) == 0
    data = json.loads((tmp_path / "gpu-emulated.json").read_text(encoding="utf-8"))
    assert set(data) == {"device", "emulated", "device after"}


@pytest.mark.slow
@pytest.mark.usefixtures("emulation")
def test_an_interruption_writes_what_there_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setitem(script.MEASUREMENTS, "speed", interrupted)
    assert script.main(["--emulated", "--out", str(tmp_path), "--only", "loading", "speed"]) == 130
    data = json.loads((tmp_path / "gpu-emulated.json").read_text(encoding="utf-8"))
    assert len(data["loading"]) == len(FORMS)
    assert "speed" not in data


@pytest.mark.parametrize("name", list(FORMS))
def test_work_is_what_the_host_kernel_takes(name: str) -> None:
    given = work.work(name, 20)
    done = work.on_host(name, given, workers=2)
    assert len(work.classes(done)) == 20
    alone = work.on_host(name, work.work(name, 20), workers=1)
    for one, two in zip(done[-1], alone[-1], strict=True):
        left = work.classes(done) == -1
        np.testing.assert_array_equal(one[~left], two[~left])


def test_cells_with_other_bits_are_counted_and_listed() -> None:
    class Wrong:
        """A device whose third cell differs by a bit, and its fifth by its class."""

        def launch(self, form: object, arguments: work.Arguments) -> None:
            assert form is FORMS["lane_fates"]
            right = work.on_host("lane_fates", arguments, workers=1)
            for mine, other in zip(arguments[-1], right[-1], strict=True):
                mine[...] = other
            fates = arguments[-1]
            fates.final[2, 0] = np.nextafter(fates.final[2, 0], np.inf)
            fates.status[4] += 1

    row = {"kernel": "lane_fates", "cells": 0, "classes": 0, "bits": 0, "left_over": 0, "first": []}
    stages.compare(Wrong(), "lane_fates", 16, 1, 1, row)  # type: ignore[arg-type]
    assert (row["cells"], row["classes"], row["bits"]) == (16, 1, 2)
    first = row["first"]
    assert isinstance(first, list)
    assert [each["cell"] for each in first] == [2, 4]
    assert first[0]["device"][2][0] > first[0]["processor"][2][0]


# -------------------------------------------------------------------------------------- the atlas


def test_the_atlas_has_about_as_many_cells_as_are_asked_for() -> None:
    for cells in (640, 10**6, 10**9):
        sizes = [len(values) for values in atlas.axes(cells).values()]
        assert 0.9 < np.prod(sizes) / cells < 1.1, cells


def test_motions_are_told_apart_by_kind_period_impacts_and_angle() -> None:
    kind = np.array([[1, 1, 1, 1], [1, 1, 2, 2], [1, 1, 1, 1], [1, 1, 1, 1]])
    period = np.array([[1, 1, 1, 1], [1, 1, 1, 1], [1, 3, 1, 3], [1, 1, 1, 1]])
    impacts = np.full((4, 4), 2)
    highest = np.array([[0.5] * 4, [0.5] * 4, [0.5] * 4, [0.5, 0.5 * (1 + 1e-9), 0.6, np.nan]])
    number = atlas.motions(kind, period, impacts, highest, -0.1 * np.ones((4, 4)))
    assert number.tolist() == [1, 2, 2, 3]


def test_an_atlas_that_is_read_in_slabs_has_the_same_counts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = atlas.computed(640, tmp_path / "atlas.zarr", "serial")
    whole = atlas.counted(done)
    monkeypatch.setattr(atlas, "SLAB", 1)
    parts = atlas.counted(done)
    np.testing.assert_array_equal(whole.pop("number"), parts.pop("number"))
    assert parts == whole
    assert sum(whole["points_by_motions"].values()) == whole["points"]


# ------------------------------------------------------------------------------------- the pages


def test_what_was_measured_has_a_section_with_the_name_of_the_gpu(tmp_path: Path) -> None:
    facts = {
        "name": "NVIDIA X",
        "capability": "9.0",
        "multiprocessors": 132,
        "clock_mhz": 1980.0,
        "driver": 13000,
    }
    call = {"kernel": "lane_fates", "cells": 10, "kernel_s": 0.5, "whole_s": 0.6}
    rates = {"cells_per_s": 20.0, "impacts": 5, "impacts_per_s": None, "left_over": 0}
    other = {"kernel": "lane_fates", "cells": 9, "classes": 1, "bits": 2, "left_over": 3}
    data = {
        "device": facts,
        "speed": [call | rates],
        "shapes": [call | rates | {"block": 64, "registers": 0}],
        "orders": [call | rates | {"order": "natural"}],
        "sameness": [other | {"first": [{"cell": 7}]}],
        "map": [{"model": "linear", "executor": "gpu", "cells": 4, "seconds": 1.0, "same": False}],
        "atlas": {
            "cells": 8,
            "phases": 2,
            "points": 4,
            "seconds": 1.0,
            "kinds": {"rest": 8},
            "points_by_motions": {"1": 4},
        },
    }
    source, page = tmp_path / "gpu.json", tmp_path / "page.md"
    source.write_text(json.dumps(data), encoding="utf-8")
    write_section(page, EXPLORER, "the page")
    report.main(source, page)
    text = page.read_text(encoding="utf-8")
    words = " ".join(text.split())
    assert text.index(f"## {EXPLORER}") < text.index(f"## {MEASURED_GPU}")
    assert "**NVIDIA X** (compute capability 9.0, 132 multiprocessors" in words
    for row in ("| lane_fates | 10 | 500.0 ms | 600.0 ms | 2.00e+01 |  |", '`{"cell": 7}`'):
        assert row in text
