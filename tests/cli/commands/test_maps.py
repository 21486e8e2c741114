"""`rocksteady map`: its contract, its axes, its store and its files."""

import csv
import re
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    State,
    Steady,
    map_attractors,
    open_store,
)
from rocksteady.cli.flags.parsing import axis
from rocksteady.show.plots.map_classes import LOOKS, map_cells
from tests.cli.program import refused, rocksteady
from tests.every import every
from tests.gpu.fake_gpu import FakeDriver, fake_gpu
from tests.sweep.executors.callers import tree

AXES = "-A 0.5:5:7 -W 1:8:9"
MAP = f"map {AXES} -r 0.8 --cycles 300"
BLOCK = DimensionlessBlock(restitution=0.8)


def test_the_table_has_the_shares_of_the_legend(tmp_path: Path) -> None:
    flags = "map -A 0.5:6:12 -W 0.5:8:12 -r 0.8"
    values = rocksteady(f"{flags} --json").json
    assert values["counts"]["subharmonic"] == sum(values["subharmonic_counts"].values()) > 0
    nc = tmp_path / "a.nc"
    out = rocksteady(f"{flags} --more --netcdf", nc).out
    with xr.open_dataset(nc) as found:
        shares = {LOOKS[one].words: share for one, share in map_cells(found).shares().items()}
    for words, share in shares.items():
        plain = words.removesuffix(" (period ≥ 2)")
        word = {"comes to rest": "rest", "falls": "overturned"}.get(plain, plain)
        assert re.search(rf"^{word} +\d+ +{100.0 * share:.2f} %$", out, re.MULTILINE), word
    assert "subharmonic (period ≥ 2)" in shares


RECTANGLE = Block.rectangle(width=0.5, height=1.5)
GROUND = {"acceleration_m_s2": 0.4 * 9.80665, "frequency_hz": 2.0}
SHAKEN = Harmonic.from_si(RECTANGLE, **GROUND)


@pytest.mark.slow
@every(
    ("flags", "block", "shaking", "arguments"),
    [
        (
            "-r 0.7:0.9:3 -A 2 -W 1:8:5",
            DimensionlessBlock(restitution=0.7),
            Harmonic(amplitude=2.0, frequency_ratio=1.0),
            {"axes": {"restitution": "0.7:0.9:3", "frequency_ratio": "1:8:5"}},
        ),
        (
            "-r 0.8 -A log:1:4:3 -W 3 --phase=-1:1:4",
            BLOCK,
            Harmonic(amplitude=1.0, frequency_ratio=3.0),
            {"axes": {"phase": "-1:1:4", "amplitude": "log:1:4:3"}},
        ),
        (
            "-r 0.8 -A 1.5 -W 4 --start=-1:1:5,-0.5:0.5:4",
            BLOCK,
            Harmonic(amplitude=1.5, frequency_ratio=4.0),
            {
                "axes": {"velocity": "-0.5:0.5:4", "angle": "-1:1:5"},
                "start": State(angle=-1.0, velocity=-0.5),
            },
        ),
        (
            "-r 0.8 -A 1:2:3 -W 4 --start=0.25,tau=-0.5:0.5:3",
            BLOCK,
            Harmonic(amplitude=1.0, frequency_ratio=4.0),
            {
                "axes": {"velocity": "-2:2:3", "amplitude": "1:2:3"},
                "start": State(angle=0.25, velocity=-2.0),
            },
        ),
        (
            "-r 0.8 -A 2 -W 1.5:2:4 --start steady --side - --kick 1e-6:1e-2:3",
            BLOCK,
            Harmonic(amplitude=2.0, frequency_ratio=1.5),
            {
                "axes": {"kick": "1e-6:1e-2:3", "frequency_ratio": "1.5:2:4"},
                "start": Steady(kick=1e-6, side=-1),
            },
        ),
        (
            "--width-m 0.5:0.9:3 --height-m 1.5:3:4 --accel-g 0.4 --freq-hz 2",
            RECTANGLE,
            SHAKEN,
            {
                "axes": {"height": "1.5:3:4", "width": "0.5:0.9:3"},
                "fixed": {**GROUND, "restitution": "housner"},
            },
        ),
        (
            "--width-m 0.5:0.9:3 --height-m 1.5 -r 0.9 --accel-g 0.4 --freq-hz 2",
            Block.rectangle(width=0.5, height=1.5, restitution=0.9),
            SHAKEN,
            {"axes": {"width": "0.5:0.9:3"}, "fixed": {"height": 1.5, **GROUND}},
        ),
        (
            "--width-m 0.5:0.9:3 --height-m 1.5 -r 0.9 -A 2 -W 3",
            Block.rectangle(width=0.5, height=1.5, restitution=0.9),
            Harmonic(amplitude=2.0, frequency_ratio=3.0),
            {"axes": {"width": "0.5:0.9:3"}, "fixed": {"height": 1.5}},
        ),
        (
            "--width-m 0.5 --height-m 1.5 --accel-g 0.4 --freq-hz 1:3:5",
            RECTANGLE,
            Harmonic.from_si(RECTANGLE, acceleration_m_s2=0.4 * 9.80665, frequency_hz=1.0),
            {"axes": {"frequency_hz": "1:3:5"}},
        ),
    ],
)
def test_any_flag_may_be_an_axis(
    flags: str, block: Any, shaking: Harmonic, arguments: dict[str, Any], tmp_path: Path
) -> None:
    path = tmp_path / "a.zarr"
    ran = rocksteady(f"map {flags} --cycles 200 --json --out", path)
    assert ran.code in (0, 3), ran.err
    axes = {name: axis("", text) for name, text in arguments["axes"].items()}
    more = {name: value for name, value in arguments.items() if name not in ("axes", "fixed")}
    named = {**axes, **arguments.get("fixed", {})}
    found = map_attractors(block, shaking, axes=named, max_cycles=200, **more)
    stored = open_store(path)
    assert stored.kind.dims == found.kind.dims
    for name in found.variables:
        assert np.array_equal(stored[name].values, found[name].values, equal_nan=True), name
    assert list(ran.json["axes"]) == list(axes)


RANGES = {
    "--width-m": (0.3, 0.8),
    "--height-m": (1.2, 3.0),
    "--alpha-rad": (0.1, 0.4),
    "--radius-m": (0.5, 2.0),
    "--p-rad-s": (1.5, 5.0),
    "--amplitude": (0.8, 4.0),
    "--accel-g": (0.1, 0.8),
    "--frequency-ratio": (1.0, 6.0),
    "--freq-hz": (0.5, 3.0),
    "--restitution": (0.6, 0.95),
    "--phase": (-4.0, 4.0),
}
"""From where the flags of random maps are drawn."""
DIMENSION = {
    "--restitution": "restitution",
    "--amplitude": "amplitude",
    "--accel-g": "acceleration_m_s2",
    "--frequency-ratio": "frequency_ratio",
    "--freq-hz": "frequency_hz",
    "--phase": "phase",
    **{f"--{name}": name.partition("-")[0] for name in ("width-m", "height-m", "alpha-rad")},
    **{f"--{name}": name.partition("-")[0] for name in ("radius-m", "p-rad-s")},
}


def drawn_flags(number: int) -> dict[str, str]:
    """Return the flags of a random map with one to three axes, one of them a size, up or down."""
    rng = np.random.default_rng(number)
    pairs = ("--width-m", "--height-m"), ("--alpha-rad", "--radius-m"), ("--alpha-rad", "--p-rad-s")
    sizes = pairs[number % 3]
    names = [*sizes, rng.choice(["--amplitude", "--accel-g"])]
    names.append(rng.choice(["--frequency-ratio", "--freq-hz"]))
    names += ["--restitution"] if rng.random() < 0.5 else []
    names += ["--phase"] if rng.random() < 0.5 else []
    moved = {sizes[rng.integers(2)], *rng.choice(names, size=2)}
    drawn = {str(name): rng.uniform(*RANGES[name], 2).tolist() for name in names}
    return {
        name: f"{ends[0]!r}:{ends[1]!r}:3" if name in moved else repr(ends[0])
        for name, ends in drawn.items()
    }


@pytest.mark.slow
@every("number", range(8))
def test_a_cell_of_any_size_is_what_the_command_attractor_says(number: int, tmp_path: Path) -> None:
    given = drawn_flags(number)
    start = ["--start", ("rest", "0.2,-0.1")[number % 2], "--cycles", "100"]
    ran = rocksteady(
        "map", *start, *(f"{name}={text}" for name, text in given.items()), "--out", tmp_path / "a"
    )
    assert ran.code in (0, 3), ran.err
    stored = open_store(tmp_path / "a")
    words = stored.kind.attrs["flag_meanings"].split()
    moved = {name: axis("", text) for name, text in given.items() if ":" in text}
    assert {DIMENSION[name] for name in moved} == set(stored.kind.dims)
    for places in np.ndindex(*(len(values) for values in moved.values())):
        point = dict(zip(moved, places, strict=True))
        numbers = given | {name: repr(moved[name][place]) for name, place in point.items()}
        alone = rocksteady(
            "attractor --json", *start, *(f"{name}={text}" for name, text in numbers.items())
        ).json
        cell = stored.isel({DIMENSION[name]: place for name, place in point.items()})
        assert words[int(cell.kind)] == alone["kind"]
        assert int(cell.period) == (alone["period"] or 0)
        assert int(cell.after) == alone["settled_after_periods"]
        for name, value in zip(
            ("highest", "lowest", "lyapunov"),
            (*(alone["peaks"] or (None, None)), alone["lyapunov"]),
            strict=True,
        ):
            found = float(cell[name])
            if value is None:
                assert not np.isfinite(found), name
            else:
                assert found == pytest.approx(value, rel=0.0, abs=1e-8), name


@pytest.mark.parametrize("shaking", ["-A 2 -W 2", "--accel-g 0.4 --freq-hz 2"])
def test_the_direction_of_an_axis_does_not_matter(shaking: str, tmp_path: Path) -> None:
    for name, ends in (("up", "0.25:0.75:3"), ("down", "0.75:0.25:3")):
        command = f"map --height-m 2 -r 0.7 {shaking} --width-m {ends} --out"
        assert rocksteady(command, tmp_path / name).code == 0
    up, down = open_store(tmp_path / "up"), open_store(tmp_path / "down")
    assert up.equals(down.isel(width=slice(None, None, -1)))
    for name in ("amplitude", "acceleration_m_s2", "frequency_ratio", "frequency_hz"):
        assert up.attrs.get(name) == down.attrs.get(name)


@pytest.mark.slow
@every(
    ("flags", "none", "kept"),
    [
        ("--width-m 0.3:0.6:2 -A 2 -W 3", {"accel_g", "freq_hz"}, {"amplitude", "frequency_ratio"}),
        (
            "--width-m 0.3:0.6:2 --accel-g 0.4 --freq-hz 2",
            {"amplitude", "frequency_ratio"},
            {"accel_g", "freq_hz"},
        ),
        ("--width-m 0.4 -A 1:2:2 --freq-hz 2", {"amplitude", "accel_g"}, {"frequency_ratio"}),
    ],
)
def test_what_moves_with_an_axis_has_no_one_value(
    flags: str, none: set[str], kept: set[str], tmp_path: Path
) -> None:
    picture = tmp_path / "a.svg"
    values = rocksteady(f"map {flags} --height-m 1.5 --json --plot {picture}").json
    assert {name for name in none if values[name] is None} == none
    assert {name for name in kept if values[name] is None} == set()
    if "accel_g" in kept:
        assert (values["accel_g"], values["freq_hz"]) == pytest.approx((0.4, 2.0))


def test_an_acceleration_in_g_is_an_axis_too(tmp_path: Path) -> None:
    command = "map --width-m 0.5 --height-m 1.5 --accel-g 0.3:0.6:4 --freq-hz 2 --json --out"
    values = rocksteady(command, tmp_path / "a.zarr").json
    assert values["accel_g"] is None
    assert values["freq_hz"] == pytest.approx(2.0)
    stored = open_store(tmp_path / "a.zarr")
    assert stored.acceleration_m_s2.values == pytest.approx(
        9.80665 * np.array([0.3, 0.4, 0.5, 0.6])
    )


def test_what_is_written_is_what_was_found(tmp_path: Path) -> None:
    files = {end: tmp_path / f"a.{end}" for end in ("png", "csv", "nc", "zarr")}
    ran = rocksteady(
        f"{MAP} --more --plot {files['png']} --csv {files['csv']} --netcdf {files['nc']}",
        "--out",
        files["zarr"],
    )
    assert ran.code == 0
    assert files["png"].read_bytes().startswith(b"\x89PNG")
    stored = open_store(files["zarr"])
    with files["csv"].open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 63
    for row, highest in zip(rows, stored.highest.values.ravel().tolist(), strict=True):
        assert float(row["highest"]) == highest or np.isnan(highest)
    assert re.search(r"^store +", ran.out, re.MULTILINE)
    again = rocksteady(f"{MAP} --json --resume --out", files["zarr"]).json
    assert again["computed"] == 0
    assert again["cells"] == 63


def test_an_undrawable_map_is_refused_before_it_is_computed(tmp_path: Path) -> None:
    command = "map -A 1:2:1000 -W 1:2:1000 -r 0.7:0.8:1000 --plot"
    line = refused(command, tmp_path / "a.png", "--out", tmp_path / "a.zarr")
    assert "found" not in line
    assert list(tmp_path.iterdir()) == []


def test_what_is_there_is_not_lost(tmp_path: Path) -> None:
    path = tmp_path / "a.zarr"
    assert rocksteady(f"{MAP} --out", path).code == 0
    assert "add --resume to continue it, or --force" in refused(f"{MAP} --out", path)
    other = MAP.replace("0.8", "0.85")
    line = refused(f"{other} --resume --out", path)
    assert f"--out = '{path}' cannot be written: it holds another sweep" in line
    assert "restitution 0.8 there, 0.85 here" in line
    assert "leave one out" in refused(f"{MAP} --resume --force --out", path)
    assert rocksteady(f"{other} --force --out", path).code == 0
    assert open_store(path).attrs["restitution"] == 0.85
    (tmp_path / "folder").mkdir()
    assert "no store of a sweep" in refused(f"{MAP} --force --out", tmp_path / "folder")


HELD = """
import time
from rocksteady.cli.app import main
from rocksteady.sweep.store import _writer

put = _writer.StoreWriter.put

def put_or_wait(writer, answer):
    put(writer, answer)
    if writer._finished.sum() > 3:
        time.sleep(3600.0)

_writer.SHARE = float("inf")  # each chunk is marked as finished at once
_writer.StoreWriter.put = put_or_wait
main()
"""
"""The program, which does not end of its own accord when it has written some chunks."""


@pytest.mark.slow
def test_an_interrupted_map_says_how_it_goes_on_and_does(tmp_path: Path) -> None:
    """Ctrl-C while it computes; the command that it prints finishes it."""
    path = tmp_path / "a map.zarr"
    command = "map -A 0.1:6:80 -W 0.2:8:80 -r 0.8 --chunk 80 --force --out"
    arguments = [*command.split(), str(path)]
    program = [sys.executable, "-c", HELD]
    with subprocess.Popen(
        [*program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as running:
        flags = path / "done" / "c"
        while not (flags.is_dir() and len(list(flags.iterdir())) > 3):
            assert running.poll() is None
            time.sleep(0.01)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=200)
    assert running.returncode == 130
    assert out == ""
    lines = err.splitlines()
    kept = re.fullmatch(r"([\d,]+) of 6,400 cells are kept in .*; to go on:", lines[-3])
    assert kept is not None, err
    cells = int(kept[1].replace(",", ""))
    assert 240 <= cells < 6400
    assert cells == int(open_store(path, partial=True).computed.sum())
    assert lines[-1] == "rocksteady: interrupted"
    told = shlex.split(lines[-2])
    assert told == ["rocksteady", *(a for a in arguments if a != "--force"), "--resume"]
    ran = rocksteady("", *told[1:], "--json")
    assert ran.json["computed"] == 6400 - cells
    assert "Traceback" not in err


@pytest.mark.slow
def test_a_picture_is_coloured_by_what_is_asked_for(tmp_path: Path) -> None:
    files = {by: tmp_path / f"{by}.png" for by in ("class", "period", "peak")}
    for by, file in files.items():
        assert rocksteady(f"{MAP} --by {by} --plot", file).code == 0
    assert len({file.read_bytes() for file in files.values()}) == 3


def test_a_map_on_a_gpu_is_that_of_threads(tmp_path: Path) -> None:
    command = "map --fate -A 0.5:4:20 -W 1:6:15 -r 0.9 --cycles 20 --json"
    with fake_gpu(tmp_path) as driver:
        values = rocksteady(f"{command} --executor gpu --out", tmp_path / "gpu.zarr").json
    by_threads = rocksteady(f"{command} --out", tmp_path / "threads.zarr").json
    assert values["counts"] == by_threads["counts"]
    assert driver.launches
    assert tree(tmp_path / "gpu.zarr") == tree(tmp_path / "threads.zarr")


def test_a_map_without_a_gpu_is_refused_before_a_store_is_begun(tmp_path: Path) -> None:
    with fake_gpu(tmp_path, FakeDriver(gpus=0)):
        line = refused(f"{MAP} --executor gpu --out", tmp_path / "map.zarr")
    assert line == (
        "rocksteady: --executor = 'gpu' is not valid: the CUDA driver shows no GPU; check "
        "nvidia-smi and CUDA_VISIBLE_DEVICES, or leave the executor out for threads"
    )
    assert not (tmp_path / "map.zarr").exists()
