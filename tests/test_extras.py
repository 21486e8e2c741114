"""Without the extra ``stores`` everything but stores and NetCDF works, and these name the extra."""

import json
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

import rocksteady as rs
from rocksteady.errors import RocksteadyError
from tests.every import every

PACKAGES = ("zarr", "numcodecs", "h5py", "h5netcdf")
PROGRAM = f"""
import sys
sys.modules.update(dict.fromkeys({PACKAGES}))
from rocksteady.cli.app import run
print([run(line.split()) for line in sys.argv[1:]], file=sys.stderr)
"""
MAP = "map -A 0.5:3:4 -W 1:4:4 -r 0.8"
ANSWERS = (
    "simulate --pulse one-sine --accel-g 0.4 --freq-hz 2 --width-m 0.5 --height-m 2 --plot s.png",
    "assess --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4",
    "explore --no-browser --out page.html",
    "fragility --example --plot curves.png --csv runs.csv --json",
    f"{MAP} --plot map.png --csv map.csv --json",
    "bifurcate -A 2 -W 3:5:9 -r 0.8 --plot branches.svg",
    "paper --only 3a --out paper",
)
NO_ZARR, NO_NETCDF = "cannot be written: zarr", "cannot be written: h5netcdf"
REFUSED = {
    f"{MAP} --out m.zarr": f"--out = 'm.zarr' {NO_ZARR}",
    f"{MAP} --out m.zarr --resume": f"--out = 'm.zarr' {NO_ZARR}",
    f"{MAP} --csv m.csv --netcdf m.nc": f"--netcdf = 'm.nc' {NO_NETCDF}",
    "fragility --example --csv r.csv --netcdf r.nc": f"--netcdf = 'r.nc' {NO_NETCDF}",
    "assess --example --runs runs.zarr": f"--runs = 'runs.zarr' {NO_ZARR}",
    "study atlas --out atlas": f"--out = 'atlas' {NO_ZARR}",
}
HINT = "is not installed; install it: pip install 'rocksteady[stores]'"


def without_stores(folder: Path, *lines: str) -> list[str]:
    """Return standard error of commands that run in one process; its last line is their codes."""
    command = [sys.executable, "-c", PROGRAM, *lines]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return done.stderr.splitlines()


def test_answers_and_pictures_need_no_extra(tmp_path: Path) -> None:
    lines = without_stores(tmp_path, *ANSWERS)
    assert lines[-1] == str([0] * len(ANSWERS)), lines


def test_commands_name_the_extra_before_they_compute(tmp_path: Path) -> None:
    assert without_stores(tmp_path, *REFUSED) == [
        *(f"rocksteady: {words} {HINT}" for words in REFUSED.values()),
        str([2] * len(REFUSED)),
    ]
    assert not list(tmp_path.iterdir())


@every("name", ["store", "open_store", "write_dataset"])
def test_functions_name_the_extra(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    axes = {"amplitude": [0.5, 2.0], "frequency_ratio": [1.0]}
    compute = partial(rs.map_attractors, rs.DimensionlessBlock(restitution=0.8), axes=axes)
    result, store = compute(), tmp_path / "there.zarr"
    store.mkdir(exist_ok=True)
    (store / "zarr.json").write_text(json.dumps({"attributes": {"inputs": "{}"}}))
    calls: dict[str, Callable[[], object]] = {
        "store": lambda: compute(run=rs.Execution(store=tmp_path / "new.zarr")),
        "open_store": lambda: rs.open_store(store),
        "write_dataset": lambda: rs.export.write_dataset(result, tmp_path / "map.nc"),
    }
    with monkeypatch.context() as patch:
        for package in PACKAGES:
            patch.setitem(sys.modules, package, None)
        with pytest.raises(RocksteadyError) as refusal:
            calls[name]()
    assert str(refusal.value).endswith(HINT)
    assert [file.name for file in tmp_path.iterdir()] == ["there.zarr"]
