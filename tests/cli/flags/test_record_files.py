"""`rocksteady simulate --record`: the runs, their files, the published peaks, what is refused."""

import ast
import csv
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from rocksteady import Block, Record, State, simulate
from rocksteady.cli.flags.record_files import in_flags
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.records import suite
from rocksteady.records.core.assembling import _LEAVE_OUT
from tests.cli.motion_files import at2, real, samples
from tests.cli.program import refused, rocksteady
from tests.every import every
from tests.records.published import AT_PACOIMA_DAM, PEAKS

BLOCK = Block.rectangle(width=0.4, height=1.6)
SIZE = "--width-m 0.4 --height-m 1.6"


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    across = at2(tmp_path / "across.AT2", samples())
    return across, at2(tmp_path / "up.AT2", samples(9, 0.4), component="UP")


def record_of(values_g: np.ndarray) -> Record:
    return Record(acceleration_m_s2=9.80665 * values_g, dt_s=0.02)


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_a_run_is_that_of_the_library(files: tuple[Path, Path], model: Model) -> None:
    values = rocksteady(f"simulate {SIZE} --model {model.name} --json --record", files[0]).json
    truth = simulate(BLOCK, record_of(samples()), model=model)
    assert values["status"] == truth.status.label == "at-rest"
    assert values["peak"] == pytest.approx(truth.peak, rel=1e-9)
    assert values["impacts"] == len(truth.impacts) > 5
    assert values["overturn_time_s"] is None
    assert values["rest_time_s"] == pytest.approx((truth.rest_time_pt or 0.0) / BLOCK.p)
    assert values["record"] == "across"
    assert (values["npts"], values["dt_s"]) == (601, 0.02)
    assert values["pga_g"] == pytest.approx(0.6)


def test_a_record_is_scaled_to_a_pga_with_its_vertical_one(files: tuple[Path, Path]) -> None:
    across, up = files
    command = f"simulate {SIZE} --json --record"
    ran = rocksteady(command, across, "--vertical", up, "--pga-g", "0.9")
    factor = 0.9 / 0.6
    same = rocksteady(command, across, "--vertical", up, "--scale", repr(factor)).json
    assert ran.json["pga_g"] == pytest.approx(0.9)
    assert ran.json["vertical_pga_g"] == pytest.approx(same["vertical_pga_g"])
    assert ran.json["peak"] == pytest.approx(same["peak"], rel=1e-8)
    assert "is its unit right" not in ran.err
    strong = rocksteady(command, across, "--scale", "12")
    assert "--scale 12 multiplies" in strong.err
    assert "both given" in refused(f"{command} {across} --scale 2 --pga-g 0.3")
    assert "--pga-g = -0.3" in refused(f"{command} {across} --pga-g=-0.3")
    assert "--record" in refused(f"simulate {SIZE} --pga-g 0.3")


def test_examples_are_read_wherever_files_are() -> None:
    for command in (f"simulate {SIZE} --record", "record", f"fragility {SIZE} --records"):
        assert "synthetic" in rocksteady(f"{command} example:soft-soil --json").out
        for name in ("example:", "Example:nope"):
            assert "give one of example:near-fault" in refused(f"{command} {name}")
    line = f"simulate {SIZE} --record example:soft-soil --vertical example:soft-soil"
    assert "--vertical = 'example:soft-soil' is not valid: no example is" in refused(line)


def test_scale_and_reverse(files: tuple[Path, Path]) -> None:
    command = f"simulate {SIZE} --start 0.02,0 --json --record"
    plain = rocksteady(command, files[0]).json
    values = rocksteady(command, files[0], "--scale", "0.5", "--reverse").json
    truth = simulate(BLOCK, record_of(-0.5 * samples()), start=State(angle=0.02, velocity=0.0))
    assert values["peak"] == pytest.approx(truth.peak, rel=1e-9)
    assert values["pga_g"] == pytest.approx(0.3)
    assert values["peak"] != plain["peak"]
    # From rest the mirror image has the same peak.
    command = f"simulate {SIZE} --json --record"
    one, other = (rocksteady(command, files[0], *more).json for more in ([], ["--reverse"]))
    assert one["peak"] == pytest.approx(other["peak"], rel=1e-12)
    fallen = rocksteady(command, files[0], "--scale", "8").json
    assert fallen["status"] == "overturned"
    assert fallen["overturn_time_s"] > 0.0


def test_vertical_motion_is_scaled_with_the_record_and_not_reversed(
    files: tuple[Path, Path],
) -> None:
    across, up = files
    command = f"simulate {SIZE} --json --scale 0.8 --reverse --vertical"
    values = rocksteady(command, up, "--record", across).json
    truth = simulate(
        BLOCK,
        BaseMotion(record_of(-0.8 * samples()), record_of(0.8 * samples(9, 0.4))),
        model=Nonlinear(),
    )
    assert values["peak"] == pytest.approx(truth.peak, rel=1e-9)
    assert values["peak"] != pytest.approx(
        simulate(BLOCK, record_of(-0.8 * samples()), model=Nonlinear()).peak, rel=1e-3
    )
    assert (values["vertical"], values["vertical_pga_g"]) == ("up", pytest.approx(0.32))


def test_one_file_may_hold_what_shakes_across_and_upwards(
    files: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from rocksteady.records import read

    command = f"simulate {SIZE} --model nonlinear --json --record"
    apart = rocksteady(command, files[0], "--vertical", files[1]).json
    both = tmp_path / "both"
    (across,), (up,) = (read.read_recordings(file) for file in files)
    channels = (
        replace(across, component="NS", orientation="horizontal", warnings=("its clock is odd",)),
        replace(up, component="UP", orientation="vertical"),
    )
    monkeypatch.setattr(read, "read_recordings", lambda *_, **__: channels)
    ran = rocksteady(command, both, "--channel", "NS", "--vertical", both)
    assert ran.json["peak"] == pytest.approx(apart["peak"], rel=1e-9)
    assert ran.err == f"rocksteady: {both}: its clock is odd\n"
    line = refused(command, both)
    assert "--channel is not given" in line
    assert "1 (NS), 2 (UP)" in line
    monkeypatch.setattr(
        read, "read_recordings", lambda *_, **__: (replace(across, orientation="horizontal"),) * 2
    )
    assert "0 are vertical" in refused(command, files[0], "--channel", 1, "--vertical", both)


def test_a_vertical_whose_direction_is_not_stated(files: tuple[Path, Path], tmp_path: Path) -> None:
    plain = tmp_path / "plain.csv"
    rows = "".join(f"{0.02 * at:.2f},{value:.6f}\n" for at, value in enumerate(samples(9, 0.4)))
    plain.write_text(f"time (s),acc (g)\n{rows}")
    ran = rocksteady(f"simulate {SIZE} --model nonlinear --record", files[0], "--vertical", plain)
    assert "is not stated: it is taken as vertical, upwards" in " ".join(ran.err.split())


def test_a_vertical_that_is_filed_downwards(files: tuple[Path, Path], tmp_path: Path) -> None:
    across, up = files
    down = at2(tmp_path / "dn.AT2", -samples(9, 0.4), component="DWN")
    command = f"simulate {SIZE} --model nonlinear --json --record"
    plain, turned = (rocksteady(command, across, "--vertical", one) for one in (up, down))
    assert (plain.err, turned.err) == ("", "")
    assert turned.json["peak"] == plain.json["peak"]
    assert plain.json["vertical_processing"] == []
    note = "sign changed: DWN is positive downwards, and vertical motion upwards"
    assert turned.json["vertical_processing"] == [note]
    filed = rocksteady(command, across, "--vertical", down, "--reverse-vertical").json
    assert filed["vertical_processing"] == [note, "sign changed: --reverse-vertical"]
    truth = simulate(
        BLOCK, BaseMotion(record_of(samples()), record_of(-samples(9, 0.4))), model=Nonlinear()
    )
    assert filed["peak"] == pytest.approx(truth.peak, rel=1e-9) != plain.json["peak"]
    text = rocksteady(
        f"simulate {SIZE} --model nonlinear --more --record", across, "--vertical", down
    )
    assert "sign changed: DWN" in " ".join(text.out.split())
    assert "without --vertical" in refused(command, across, "--reverse-vertical")


def test_a_vertical_that_does_not_belong(files: tuple[Path, Path], tmp_path: Path) -> None:
    other = at2(tmp_path / "other.AT2", samples(9, 0.4)[:300], 0.01, component="UP")
    other.write_text(other.read_text().replace("Hut", "Shed").replace("1990", "1991"))
    command = f"simulate {SIZE} --model nonlinear --json --record"
    ran = rocksteady(command, files[0], "--vertical", other)
    for words in (
        "may not belong",
        "'Hut' and 'Shed'",
        "1991",
        "0.01, 0.02 s",
        "from 300 to 601 samples",
    ):
        assert words in ran.err
    assert "in the place of a vertical" in rocksteady(command, files[0], "--vertical", files[0]).err
    assert "UP is vertical: it shakes across" in rocksteady(command, files[1]).err


def test_pacoima_dam_with_its_vertical() -> None:
    across, down = real("RSN77*PUL164*"), real("RSN77*PULDWN*")
    command = "simulate --width-m .6 --height-m 1.8 --model nonlinear --json --record"
    ran = rocksteady(command, across, "--vertical", down)
    assert ran.json["peak"] == pytest.approx(0.203, abs=5e-4)
    assert "name states upwards, and its header downwards" in ran.err
    filed = rocksteady(command, across, "--vertical", down, "--reverse-vertical").json
    assert filed["peak"] == pytest.approx(0.822, abs=5e-4)


def test_a_base_that_falls_away_ends_the_run(files: tuple[Path, Path], tmp_path: Path) -> None:
    falling = at2(tmp_path / "falling.AT2", samples(9, 1.5), component="UP")
    command = f"simulate {SIZE} --model nonlinear --json --record"
    assert rocksteady(command, files[0], "--vertical", falling).json["status"] == "lost-contact"


@pytest.mark.slow
def test_plot_film_and_table(files: tuple[Path, Path], tmp_path: Path) -> None:
    across, up = files
    plot, film, table = (tmp_path / name for name in ("run.png", "run.gif", "run.csv"))
    files_out = ("--plot", plot, "--animate", film, "--csv", table)
    command = f"simulate {SIZE} --model nonlinear --speed 6"
    ran = rocksteady(command, *files_out, "--record", across, "--vertical", up)
    assert ran.code == 0, ran.err
    assert ran.out.startswith("It comes to rest ")
    with Image.open(plot) as picture:
        assert picture.size[0] > 1000
    with Image.open(film) as picture:
        assert getattr(picture, "n_frames", 1) > 30
    with table.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    time = np.array([float(row["time_s"]) for row in rows])
    inside = time <= 12.0
    for column, values in (
        ("base_acceleration_g", samples()),
        ("vertical_acceleration_g", samples(9, 0.4)),
    ):
        found = np.array([float(row[column]) for row in rows])
        expected = np.interp(time, np.arange(601) * 0.02, values)
        np.testing.assert_allclose(found[inside], expected[inside], atol=1e-10)


# --------------------------------------------------------------------- numbers of others


@every(("name", "p", "alpha", "expected"), PEAKS)
def test_peaks_under_recorded_motions(name: str, p: float, alpha: float, expected: float) -> None:
    block = f"--alpha-rad {alpha!r} --p-rad-s {p!r} --model nonlinear"
    values = rocksteady(f"simulate {block} --json --record", real(f"*{name}*")).json
    assert values["status"] == "at-rest"
    assert values["peak_rad"] == pytest.approx(expected, rel=1e-5)


@every(("degrees", "period", "falls"), AT_PACOIMA_DAM)
def test_what_topples_at_pacoima_dam(degrees: float, period: float, falls: bool) -> None:
    alpha, p = math.radians(degrees), 2.0 * math.pi / period
    block = f"--alpha-rad {alpha!r} --p-rad-s {p!r} --model nonlinear"
    values = rocksteady(f"simulate {block} --json --record", real("*PUL164*")).json
    assert values["status"] == ("overturned" if falls else "at-rest")


# ------------------------------------------------------------------------- words of readers


ORDINARY = re.compile(r"(?:its|the|such) columns?\b|^column $|two units|units=|records\.resample")
"""Words of files in texts of readers, which are no arguments."""


def texts_of_readers() -> set[str]:
    """Texts of the readers' modules, values in them as braces; no docstrings and patterns."""
    found: set[str] = set()
    for file in Path(suite.__file__).parent.rglob("*.py"):
        nodes = list(ast.walk(ast.parse(file.read_text("utf-8"))))
        inside = {id(part) for node in nodes for part in getattr(node, "values", ())}
        inside |= {id(node.value) for node in nodes if isinstance(node, ast.Expr)}  # docstrings
        for node in nodes:
            if isinstance(node, ast.JoinedStr):
                found.add(
                    "".join(
                        str(part.value) for part in node.values if isinstance(part, ast.Constant)
                    )
                )
            elif isinstance(node, ast.Constant) and id(node) not in inside:
                found.add(str(node.value))
    return {text for text in found if " " in text and not re.search(r"\\[bsdwSW1]|\n", text)}


def test_every_argument_in_a_text_of_a_reader_becomes_its_flag() -> None:
    names = re.compile(r"(?<!-)\b(?:units|dt_s|column|resample|ignore_header)\b")
    asked = {text for text in texts_of_readers() if names.search(ORDINARY.sub("", text))}
    left = {text for text in asked if names.search(ORDINARY.sub("", in_flags(text)))}
    assert left == set()
    assert len(asked) > 10


@every(
    ("words", "in_words"),
    [
        (
            _LEAVE_OUT.format("units"),
            "leave out --units where the file is right, else read it with --ignore-header",
        ),
        (
            "give dt_s 0.005 where they are, else ignore_header with dt_s",
            "give --dt-s 0.005 where they are, else --ignore-header with --dt-s",
        ),
        (
            "the file states that its numbers are in g, and units in gal",
            "the file states that its numbers are in g, and --units in gal",
        ),
        ("it states two units of time", "it states two units of time"),
        ("give column, by its name", "give --column, by its name"),
        ("ask for resampling (resample) to have it", "ask for resampling (--resample) to have it"),
    ],
)
def test_words_in_flags(words: str, in_words: str) -> None:
    assert in_flags(words) == in_words


@every(
    ("names", "channel", "words"),
    [
        ("acc ns (g)", None, ""),
        ("acc (g)", None, "where it points is not stated: it shakes across"),
        ("acc ns (g),acc up (g)", 2, "is vertical: it shakes across"),
        ("radial acc (g)", None, "turned from the components that were recorded: it shakes across"),
    ],
)
def test_what_shakes_across_without_being_horizontal_is_named(
    names: str, channel: int | None, words: str, tmp_path: Path
) -> None:
    rows = "".join(f"{0.02 * at:.2f},{at % 3},{at % 2}\n" for at in range(9))
    rows = rows if "," in names else re.sub(r",\d$", "", rows, flags=re.MULTILINE)
    file = tmp_path / "few.csv"
    file.write_text(f"time (s),{names}\n{rows}")
    flags = [] if channel is None else ["--channel", channel]
    for command in (f"simulate {SIZE} --record", "explore --json --record"):
        err = rocksteady(command, file, *flags).err
        assert words in err
        assert bool(err) == bool(words)


def test_ignoring_a_header_reads_the_samples_by_the_options_alone(tmp_path: Path) -> None:
    file = tmp_path / "wrong.csv"
    file.write_text("acc ns (cm/s2)\n1\n-2\n1\n")
    assert "--ignore-header" in refused("record --units g --dt-s 0.01", file)
    values = rocksteady("record --json --ignore-header --units g --dt-s 0.01", file).json
    assert (values["npts"], values["dt_s"], values["pga_g"]) == (3, 0.01, 2.0)
    assert "header" in " ".join(values["processing"])
