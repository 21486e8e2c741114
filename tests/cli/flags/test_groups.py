"""Groups of flags: how they reach a command, files that are refused, --width and --legend."""

import inspect
from dataclasses import fields
from pathlib import Path

import pytest
from PIL import Image

from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.groups import AnimationFlags, OutputFlags, grouped
from rocksteady.cli.flags.start import StartFlags
from rocksteady.errors import InputError, OutputError
from tests.cli.program import refused, rocksteady
from tests.every import every

COMMANDS = (
    "simulate -A 2 -W 4 -r 0.8 --cycles 5",
    "attractor -A 2 -W 4 -r 0.8",
    "steady -A 1:3:3 -W 1:8:50 -r 0.8",
    "orbits -A 2 -W 4 -r 0.8",
    "bifurcate -A 1.5:2.5:11 -W 2 -r 0.8 --no-sweeps",
    "curves -A 0.2:2:2 -W 3:5:2 -r 0.8 --max-impacts 2",
    "basins -A 0:1:4 -W 4 -r 0.8 --angles -1:1:21 --velocities=-1:1:21 --cycles 10",
    "map -A 0.5:3:8 -W 1:8:8 -r 0.7:0.9:2",
    "overturn --pulse one-sine -W 1:6:8 -r 0.9",
)


@pytest.mark.slow
@every("command", COMMANDS)
def test_every_command_that_draws_has_a_width_and_a_legend(command: str, tmp_path: Path) -> None:
    file = tmp_path / "figure.png"
    ran = rocksteady(command, "--plot", file, "--width", "84mm", "--legend", "below")
    assert ran.code in (0, 3), ran.err
    with Image.open(file) as picture:
        assert picture.width == pytest.approx(200.0 * 84.0 / 25.4, abs=1.0)


@pytest.mark.slow
def test_the_units_of_a_width_agree(tmp_path: Path) -> None:
    seen = []
    for number, width in enumerate(("101.6mm", "10.16cm", "4in", "4 in")):
        file = tmp_path / f"{number}.png"
        ran = rocksteady("simulate -A 2 -W 4 -r 0.8 --cycles 5", "--plot", file, "--width", width)
        assert ran.code == 0, ran.err
        with Image.open(file) as picture:
            seen.append((picture.size, picture.tobytes()))
    assert len(set(seen)) == 1


@every("width", ["84", "-5mm", "1e9mm", "abc", "nanmm", "84pt", "", "10mm"])
def test_a_width_that_is_none_is_refused_before_anything_is_written(
    width: str, tmp_path: Path
) -> None:
    file = tmp_path / "figure.png"
    line = refused("simulate -A 2 -W 4 -r 0.8 --plot", file, f"--width={width}")
    assert "--width" in line
    assert "mm, cm or in" in line
    assert not file.exists()


def test_a_place_that_is_none_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "figure.png"
    line = refused("simulate -A 2 -W 4 -r 0.8 --plot", file, "--legend", "left")
    assert "inside, right, below, none" in line
    assert not file.exists()


@pytest.mark.parametrize("flags", ["--width 84mm", "--legend none"])
def test_without_a_picture_they_have_no_meaning(flags: str) -> None:
    line = refused(f"simulate -A 2 -W 4 -r 0.8 {flags}")
    assert flags.split(maxsplit=1)[0] in line
    assert "--plot" in line


@pytest.mark.slow
@every("name", [r"$\frac{$.csv"])
def test_the_name_of_a_record_is_no_mathematics(name: str, tmp_path: Path) -> None:
    record = tmp_path / name
    rows = "\n".join(f"{0.01 * k:.2f},{0.3 * (-1) ** (k // 20)}" for k in range(200))
    record.write_text(f"time (s),acceleration (g)\n{rows}\n", encoding="utf-8")
    for command in ("simulate --width-m 0.4 --height-m 1.6", "record", "spectrum --alpha-deg 10"):
        file = tmp_path / f"{command.split()[0]}.png"
        given = [record] if command == "record" else ["--record", record]
        ran = rocksteady(command, *given, "--plot", file)
        assert ran.code == 0, ran.err
        assert file.read_bytes().startswith(b"\x89PNG")


# ------------------------------------------------------------------------- groups as such


def test_a_command_gets_its_groups_whole_and_shows_their_flags() -> None:
    seen: dict[str, object] = {}

    @grouped
    def command(start: StartFlags, output: OutputFlags, cycles: int = 50) -> None:
        seen.update(start=start, output=output, cycles=cycles)

    names = [field.name for group in (StartFlags, OutputFlags) for field in fields(group)]
    assert list(inspect.signature(command).parameters) == [*names, "cycles"]
    assert command.__annotations__.keys() == {*names, "cycles"}
    defaults = {
        name: parameter.default for name, parameter in inspect.signature(command).parameters.items()
    }
    command(**{**defaults, "start": "steady", "kick": 1e-3, "as_json": True})
    assert seen == {
        "start": StartFlags(start="steady", kick=1e-3),
        "output": OutputFlags(as_json=True),
        "cycles": 50,
    }


def test_what_a_command_reads_is_not_written_over(tmp_path: Path) -> None:
    read = tmp_path / "a.gif"
    read.touch()
    output = OutputFlags(csv=tmp_path / "b.csv", plot=tmp_path / "a.png", force=True)
    output.check([read])
    AnimationFlags(animate=tmp_path / "b.gif").check(output, [read])
    with pytest.raises(OutputError, match="this file is read") as refused:
        AnimationFlags(animate=read).check(output, [read])
    assert refused.value.name == "--animate"
    with pytest.raises(OutputError, match="this file is read"):
        OutputFlags(csv=read, force=True).check([read])


@every(
    ("flags", "words"),
    [
        ({"speed": 2.0}, "without --animate it has no meaning"),
        ({"speed": 0.0, "animate": "a.gif"}, "speed = 0"),
        ({"animate": "a.mp4"}, "the extension sets the format: .gif"),
        ({"animate": "a.csv"}, "the extension sets the format: .gif"),
        ({"animate": "there.gif"}, "--force"),
    ],
)
def test_a_film_that_could_not_be_written_is_refused(
    flags: dict[str, object], words: str, tmp_path: Path
) -> None:
    (tmp_path / "there.gif").write_text("precious")
    if "animate" in flags:
        flags = {**flags, "animate": tmp_path / str(flags["animate"])}
    output = OutputFlags(csv=tmp_path / "a.csv")
    with pytest.raises((InputError, FlagError, OutputError), match=words):
        AnimationFlags(**flags).check(output)  # type: ignore[arg-type]
    AnimationFlags(animate=tmp_path / "a.gif", speed=2.0).check(output)
