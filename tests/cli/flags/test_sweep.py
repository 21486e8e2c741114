"""Where the cells of a command are kept, and how an interrupted one goes on."""

import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Execution, Store, map_attractors
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.groups import OutputFlags
from rocksteady.cli.flags.sweep import SweepFlags, resuming
from rocksteady.errors import InputError, OutputError, UnfinishedError
from tests.every import every


def filled(path: Path) -> Path:
    """Write a store of four cells."""
    axes: dict[str, Any] = {"amplitude": np.array([0.5, 1.5]), "frequency_ratio": [2.0, 3.0]}
    block = DimensionlessBlock(restitution=0.8)
    map_attractors(block, axes=axes, max_cycles=20, run=Execution(store=Store(path)))
    return path


def test_without_out_there_is_no_store() -> None:
    assert SweepFlags().run(force=False) == Execution()
    for flags in (SweepFlags(resume=True), SweepFlags(chunk=10)):
        with pytest.raises(FlagError, match="without --out there is no store"):
            flags.run(force=False)


def test_the_flags_make_a_run() -> None:
    assert SweepFlags(executor="serial", workers=2).run(force=False) == Execution(
        executor="serial", workers=2
    )
    with pytest.raises(InputError, match="executor = 'cloud' is not valid"):
        SweepFlags(executor="cloud").run(force=False)


def test_a_store_is_new_or_continued_or_begun_anew(tmp_path: Path) -> None:
    new = SweepFlags(out=tmp_path / "new.zarr", chunk=7).run(force=False).place
    assert new is not None
    assert (new.resume, new.overwrite, new.chunk) == (False, False, 7)
    there = filled(tmp_path / "a.zarr")
    with pytest.raises(OutputError, match="it exists; add --resume to continue it, or --force"):
        SweepFlags(out=there).run(force=False)
    again = SweepFlags(out=there, resume=True).run(force=False).place
    assert again is not None
    assert (again.resume, again.overwrite) == (True, False)
    anew = SweepFlags(out=there).run(force=True).place
    assert anew is not None
    assert (anew.resume, anew.overwrite) == (False, True)
    with pytest.raises(FlagError, match="--resume and --force are both given"):
        SweepFlags(out=there, resume=True).run(force=True)


@every(
    ("sweep", "output", "words"),
    [
        ({"netcdf": "a.nc"}, {"csv": "a.nc"}, "--csv writes the same file"),
        ({"out": "a.csv"}, {"csv": "a.csv"}, "--csv writes the same file"),
        ({"out": "a"}, {"plot": "a/b.png"}, "it lies in --out"),
        ({"netcdf": "a.csv"}, {}, "the extension sets the format: .nc"),
        ({"netcdf": "there.nc"}, {}, "--force"),
        ({"netcdf": "nowhere/a.nc"}, {}, "folder"),
    ],
)
def test_files_that_could_not_be_written_are_refused(
    sweep: dict[str, str], output: dict[str, str], words: str, tmp_path: Path
) -> None:
    (tmp_path / "there.nc").write_text("precious")
    (tmp_path / "a").mkdir()
    files: Any = {name: tmp_path / file for name, file in sweep.items()}
    others: Any = {name: tmp_path / file for name, file in output.items()}
    with pytest.raises((OutputError, InputError), match=words):
        SweepFlags(**files).check(OutputFlags(**others))


def test_a_command_that_is_resumed_writes_its_files_again(tmp_path: Path) -> None:
    for name in ("a.nc", "a.csv"):
        (tmp_path / name).write_text("older")
    output = OutputFlags(csv=tmp_path / "a.csv")
    files: Any = {"netcdf": tmp_path / "a.nc", "out": tmp_path / "a.zarr"}
    SweepFlags(**files, resume=True).check(output)
    with pytest.raises(OutputError, match="--force"):
        SweepFlags(**files).check(output)


@pytest.mark.parametrize("ended", [KeyboardInterrupt, UnfinishedError])
def test_an_end_says_what_is_kept_and_how_it_goes_on(
    ended: type[BaseException], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store = filled(tmp_path / "a b.zarr")
    arguments = ["map", "-A", "1:2:2", "--out", str(store), "--force"]
    error = ended() if ended is KeyboardInterrupt else UnfinishedError.__new__(UnfinishedError)
    with pytest.raises(ended), SweepFlags(out=store).resumable(arguments):
        raise error
    kept, command = capsys.readouterr().err.splitlines()
    assert kept == f"all 4 cells are kept in {store}; to see the answer:"
    assert shlex.split(command) == ["rocksteady", *arguments[:-1], "--resume"]
    with pytest.raises(ended), SweepFlags().resumable(arguments):
        raise error
    assert capsys.readouterr().err == "", "nothing is kept without a store"


def test_the_command_that_goes_on_is_quoted_and_resumes_once() -> None:
    arguments = ["map", "--start=-1:1:5,0", "--resume", "--force", "--out", "my map"]
    line = resuming(arguments)
    assert shlex.split(line) == [
        *("rocksteady", "map", "--start=-1:1:5,0", "--out", "my map", "--resume")
    ]
    assert resuming(shlex.split(line)[1:]) == line
