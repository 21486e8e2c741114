"""Outputs in odd places: nothing that is there is replaced unasked, and no device ever."""

import os
import random
import stat
from collections.abc import Callable
from pathlib import Path

import pytest

from rocksteady import __version__, durable
from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import command_line
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.every import every
from tests.origins import origin_of

SIMULATE = "simulate -A 2 -W 4 -r 0.8 --cycles 3 --csv"
FLAGS = {
    "--csv": ("simulate -A 2 -W 4 -r 0.8 --cycles 3", "a.csv"),
    "--plot": ("simulate -A 2 -W 4 -r 0.8 --cycles 3", "a.png"),
    "--animate": ("simulate -A 2 -W 4 -r 0.8 --cycles 1", "a.gif"),
    "--netcdf": ("map -A 1:2:3 -W 2:3:3 -r 0.8", "a.nc"),
}


@pytest.mark.slow
@every("flag", FLAGS)
def test_a_link_that_leads_nowhere_counts_as_a_file(flag: str, tmp_path: Path) -> None:
    command, name = FLAGS[flag]
    link, target = tmp_path / name, tmp_path / "target"
    link.symlink_to(target)
    line = refused(f"{command} {flag}", link)
    assert "it is a link to a file that is missing; add --force" in line
    assert link.readlink() == target
    assert not target.exists()
    assert rocksteady(f"{command} --force {flag}", link).code == 0
    assert link.readlink() == target
    assert target.stat().st_size > 0


@every("flag", FLAGS)
@every("force", ["", "--force"])
def test_no_device_pipe_or_folder_is_replaced(flag: str, force: str, tmp_path: Path) -> None:
    command, name = FLAGS[flag]
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")
    for target, why in (
        (Path("/dev/null"), "a device or a pipe"),
        (tmp_path / "pipe", "a device or a pipe"),
        (tmp_path / "folder", "it is a folder"),
        (tmp_path / "missing" / "a", "the folder that the link leads to does not exist"),
        (tmp_path / name, "symbolic links"),
    ):
        link = tmp_path / name
        link.symlink_to(target)
        assert why in refused(f"{command} {force} {flag}", link)
        assert link.readlink() == target
        link.unlink()
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)
    assert stat.S_ISFIFO((tmp_path / "pipe").stat().st_mode)


def test_devices_themselves_are_refused() -> None:
    for device in ("/dev/null", "/dev/full", "/dev/tty"):
        if Path(device).exists():
            refused(f"{SIMULATE} {device} --force")
            assert stat.S_ISCHR(Path(device).stat().st_mode)


def test_two_names_of_one_file_are_one_file(tmp_path: Path) -> None:
    (tmp_path / "a.csv").symlink_to(tmp_path / "a.png")
    line = refused(
        f"simulate -A 2 -W 4 -r 0.8 --force --plot {tmp_path / 'a.png'} --csv", tmp_path / "a.csv"
    )
    assert "--plot writes the same file" in line


def test_names_that_no_file_can_have_are_refused_in_one_line(tmp_path: Path) -> None:
    refused(SIMULATE, tmp_path / ("x" * 300))
    refused(SIMULATE, tmp_path / "a" / "b.csv")
    (tmp_path / "a").write_text("", encoding="utf-8")
    refused(SIMULATE, tmp_path / "a" / "b.csv")


@pytest.mark.slow
@every("flag", FLAGS)
def test_what_another_program_writes_meanwhile_is_kept(
    flag: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command, name = FLAGS[flag]
    write = durable.write

    def late(file: Path, fill: Callable[[Path], object]) -> None:
        (tmp_path / name).write_text("mine", encoding="utf-8")
        write(file, fill)

    monkeypatch.setattr(durable, "write", late)
    ran = rocksteady(f"{command} {flag}", tmp_path / name)
    assert ran.code == 2
    assert "another program has written it meanwhile; add --force" in ran.err
    assert (tmp_path / name).read_text(encoding="utf-8") == "mine"
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert rocksteady(f"{command} --force {flag}", tmp_path / name).code == 0
    assert (tmp_path / name).read_bytes() != b"mine"


def test_a_record_that_is_read_is_not_written_over(tmp_path: Path) -> None:
    file = tmp_path / "quake.csv"
    at2(file, samples())
    before = file.read_bytes()
    link = tmp_path / "link.csv"
    link.symlink_to(file)
    for command, read in (
        ("record", (file,)),
        ("simulate --width-m 0.4 --height-m 2 --record", (file,)),
        ("spectrum --alpha-rad 0.2 --periods-s 1:2:2 --record", (file,)),
        ("record", (link,)),
    ):
        line = refused(command, *read, "--csv", file, "--force")
        assert "this file is read" in line
    assert file.read_bytes() == before


def test_nothing_is_written_into_a_store(tmp_path: Path) -> None:
    store = tmp_path / "a.zarr"
    command = "map -A 1:2:3 -W 1:2:3 -r 0.8 --fate --out"
    assert rocksteady(command, store).code == 0
    before = sorted(store.rglob("*"))
    for flag, name in (("--csv", "x.csv"), ("--plot", "x.png"), ("--netcdf", "done/x.nc")):
        line = refused(command, store, "--resume", flag, store / name)
        assert "it lies in --out" in line
    assert sorted(store.rglob("*")) == before


def other_path(draw: random.Random, file: Path, folder: Path) -> Path:
    """Return a path to a file: its own, through folders or links, or a second name."""
    through, link, second = (folder / f"{kind}{file.suffix}" for kind in ("to", "soft", "hard"))
    through.symlink_to(file.parent)
    link.symlink_to(file)
    os.link(file, second)
    around = file.parent / ".." / file.parent.name / file.name
    return draw.choice([file, around, through / file.name, link, second])


def test_no_combination_of_outputs_replaces_an_input(tmp_path: Path) -> None:
    draw = random.Random(29)
    wall, statue, record = (tmp_path / name for name in ("wall.toml", "statue.toml", "a.at2"))
    wall.write_text('[facade]\nname = "a"\nthickness_m = 0.3\nheight_m = 3.0\n')
    statue.write_text('name = "a"\n[geometry]\nwidth_m = 0.3\nheight_m = 1.5\n')
    text = at2(record, samples()).read_text(encoding="utf-8")
    rows = "name,width_m,height_m\na,0.3,1.5\n"
    commands = (
        (f"facade {wall} --records", ("runs.csv", "report.html", "run.json"), text),
        (f"assess {statue} --records", ("results.csv", "report.html", "fragility.csv"), text),
        (f"assess --pgv-m-s 0.4 --records {record}", ("answers.csv", "results.csv"), rows),
        ("calibrate --tests", ("predictions.csv", "posterior.csv"), "name\n"),
        ("calibrate --example --prior", ("predictions.csv", "report.html"), "name\n"),
        ("explore --no-browser --record", ("page.html",), text),
    )
    for number in range(50):
        command, names, content = draw.choice(commands)
        out = tmp_path / str(number) / "out"
        out.mkdir(parents=True)
        file = out / draw.choice(names)
        file.write_text(content, encoding="utf-8")
        manifest = out / ("fit.json" if command.startswith("calibrate") else "run.json")
        if not command.startswith("explore"):
            manifest.touch()  # of an earlier answer, which --force replaces
        target = file if command.startswith("explore") else out
        read = other_path(draw, file, out.parent)
        line = refused(command, read, "--out", target, "--force")
        assert "this file is read" in line, (command, read)
        assert file.read_text(encoding="utf-8") == content
        assert set(out.iterdir()) <= {file, manifest}


def test_no_output_lies_in_the_folder_of_another(tmp_path: Path) -> None:
    (tmp_path / "wall.toml").write_text('[facade]\nname = "a"\nthickness_m = 0.3\nheight_m = 3.0\n')
    out = tmp_path / "out"
    out.mkdir()
    block = "--width-m 0.3 --height-m 1.5 --pga-g 0.4 --pgv-m-s 0.4"
    for command, flag, path in (
        (f"facade {tmp_path / 'wall.toml'}", "--csv", out / "checks.csv"),
        (f"facade {tmp_path / 'wall.toml'}", "--plot", out / "sub" / ".." / "a.png"),
        ("calibrate --example", "--csv", out / "predictions.csv"),
        ("assess --example", "--runs", out / "runs.zarr"),
        ("assess --example", "--runs", out),
        (f"assess {block}", "--csv", out / "answers.csv"),
    ):
        line = refused(command, flag, path, "--out", out, "--force")
        assert "it lies in --out" in line or "writes the same file" in line, (command, flag)
        assert list(out.iterdir()) == []


# ---------------------------------------------------------------------------------- of a picture


def test_a_picture_keeps_the_command_without_folders_of_what_is_written() -> None:
    terminal.arguments[:] = [
        *["simulate", "--record", "my records/a b.AT2", "--plot", "/home/me/a.png"],
        *["--csv=/tmp/x.csv", "--force", "--json"],
    ]
    assert command_line() == (
        "rocksteady simulate --record 'my records/a b.AT2' --plot a.png --csv=x.csv"
    )


@pytest.mark.slow
@every("kind", ["png", "svg", "pdf"])
def test_a_picture_of_the_program_has_its_command(kind: str, tmp_path: Path) -> None:
    command = "simulate -A 2 -W 4 -r 0.8 --cycles 3"
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        assert rocksteady(f"{command} --plot", tmp_path / folder / f"a.{kind}").code == 0
    one, two = ((tmp_path / folder / f"a.{kind}").read_bytes() for folder in ("one", "two"))
    assert one == two
    made_by = (f"rocksteady {__version__}", f"rocksteady {command} --plot a.{kind}")
    assert origin_of(one, kind) == made_by
    assert str(tmp_path).encode() not in one


def test_a_picture_keeps_no_folder_of_runs_and_not_who_computed_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    words = "map --runs /home/me/runs --executor tcp://node:8786 --workers=2 --chunk 64 -r 0.8"
    monkeypatch.setattr(terminal, "arguments", words.split())
    assert command_line() == "rocksteady map --runs runs -r 0.8"
