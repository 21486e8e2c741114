"""What --force may remove and what a store leaves alone: everything that no sweep wrote."""

import json
import os
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
import zarr

from rocksteady.errors import OutputError
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store.ownership import is_store, others, owner_of
from rocksteady.sweep.store.reading import open_store
from rocksteady.sweep.store.store import Store
from tests.every import every
from tests.sweep.store.faults import run, tree, whole


def everything(folder: Path) -> dict[str, bytes | str]:
    """Return all paths below a folder, each with its content or its kind."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        if path.is_file()
        else str(path.readlink() if path.is_symlink() else "folder")
        for path in folder.rglob("*")
    }


def group_with_done(path: Path) -> None:
    group = zarr.create_group(path, attributes={"by": "somebody else"})
    group.create_array("done", data=np.ones(3, dtype=np.bool_))
    group.create_array("thesis", data=np.arange(5.0))


def group_with_inputs(path: Path) -> None:
    path.mkdir()
    (path / "zarr.json").write_text('{"attributes":{"inputs":"{}"}}', encoding="utf-8")
    (path / "thesis.tex").write_text("years of work", encoding="utf-8")


def copy_by_xarray(path: Path) -> None:
    """Results that somebody went on with: they have a store's attributes and names."""
    run(path.with_name("b.zarr"))
    found = xarray.open_zarr(path.with_name("b.zarr"), consolidated=False).load()
    found.assign(mine=found["sum"] * 2.0).to_zarr(path, zarr_format=3, consolidated=False)


def version_2(path: Path) -> None:
    zarr.create_group(path, zarr_format=2).create_array("done", data=np.ones(3))


def a_folder_of_files(path: Path) -> None:
    (path / "done").mkdir(parents=True)
    (path / "done" / "lock").write_text("mine", encoding="utf-8")
    (path / "done" / "letter.partial").write_text("dear", encoding="utf-8")


def forged_marks(path: Path) -> None:
    """A folder with a file of the name of a store's marks, which says something else."""
    (path / "done").mkdir(parents=True)
    (path / "done" / "store.json").write_text('{"axes": ["..", "a"]}', encoding="utf-8")
    (path / "a").write_text("mine", encoding="utf-8")


FOREIGN = [
    group_with_done,
    group_with_inputs,
    copy_by_xarray,
    version_2,
    a_folder_of_files,
    forged_marks,
]


@pytest.mark.filterwarnings("ignore::UserWarning:xarray", "ignore::RuntimeWarning")
@pytest.mark.filterwarnings("ignore::FutureWarning")
@pytest.mark.parametrize("make", FOREIGN)
@pytest.mark.parametrize("how", ["overwrite", "resume", "plain"])
def test_what_merely_looks_like_a_store_is_left_alone(make: Any, how: str, tmp_path: Path) -> None:
    make(tmp_path / "a.zarr")
    before = everything(tmp_path)
    with pytest.raises(OutputError, match="it is a folder and no store") as caught:
        run(tmp_path / "a.zarr", **({} if how == "plain" else {how: True}))
    assert "\n" not in str(caught.value)
    assert everything(tmp_path) == before


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "notes.txt",
        "sum/notes.txt",
        "sum/c.1.0.partial",
        "sum/c.1.0.bak",
        "done/notes.partial",
        "done/c/x",
        "a/c/notes",
        "plots/map.png",
        ".hidden",
        "sum2/zarr.json",
    ],
)
@pytest.mark.parametrize("kind", ["file", "link", "folder"])
def test_files_of_a_user_in_a_store_are_kept_and_named(name: str, kind: str, begun: Path) -> None:
    place = begun / name
    place.parent.mkdir(exist_ok=True)
    if kind == "file":
        place.write_text("mine", encoding="utf-8")
    elif kind == "link":
        place.symlink_to("/nowhere")
    else:
        place.mkdir()
    before = everything(begun)
    first = (
        name
        if place.parent.name in {"sum", "done", "c", "a.zarr"}
        else name.split("/", maxsplit=1)[0]
    )
    with pytest.raises(OutputError, match="no sweep wrote") as caught:
        run(begun, overwrite=True)
    assert f"no sweep wrote {first}" in str(caught.value)
    assert everything(begun) == before
    run(begun, resume=True)
    assert everything(begun) == before


def test_a_link_in_the_place_of_a_chunk_is_not_followed_by_force(
    begun: Path, tmp_path: Path
) -> None:
    (tmp_path / "thesis").write_text("years of work", encoding="utf-8")
    (begun / "sum" / "c.1.0").unlink()
    (begun / "sum" / "c.1.0").symlink_to(tmp_path / "thesis")
    with pytest.raises(OutputError, match=r"no sweep wrote sum/c\.1\.0"):
        run(begun, overwrite=True)
    with pytest.warns(UserWarning, match="1 of 6 finished chunks are missing or damaged"):
        run(begun, resume=True)
    assert (tmp_path / "thesis").read_text(encoding="utf-8") == "years of work"
    assert not others(begun)


@every("how", [{}, {"resume": True}, {"overwrite": True}])
def test_what_stands_beside_a_store_is_nobody_s_business(
    how: dict[str, bool], tmp_path: Path, undisturbed: Path
) -> None:
    """Names that a store once gave to what it was about to be, also of hours ago."""
    for name in ("new-thesis", "old-backup", "new-123", "old-456", "partial"):
        folder = tmp_path / f".a.zarr.{name}"
        folder.mkdir()
        (folder / "chapter").write_text("years of work", encoding="utf-8")
        os.utime(folder, (0, 0))
    before = everything(tmp_path)
    run(tmp_path / "a.zarr", **how)
    assert tree(tmp_path / "a.zarr") == tree(undisturbed)
    shutil.rmtree(tmp_path / "a.zarr")
    assert everything(tmp_path) == before


def test_force_takes_a_store_whose_marks_are_half_damaged(begun: Path, undisturbed: Path) -> None:
    for name in ("store.json", "store-copy.json"):
        before = (begun / "done" / name).read_bytes()
        (begun / "done" / name).write_bytes(before[:30])
        assert run(begun, resume=True)[1] > 0
        assert whole(begun, undisturbed)
        (begun / "done" / name).unlink()
        run(begun, overwrite=True)
        assert whole(begun, undisturbed)


def test_a_store_without_marks_is_no_more_certainly_ours(begun: Path) -> None:
    for name in ("store.json", "store-copy.json"):
        (begun / "done" / name).unlink()
    before = everything(begun)
    assert owner_of(begun) is None
    for how in ("resume", "overwrite"):
        with pytest.raises(OutputError, match="no store of a sweep"):
            run(begun, **{how: True})
    assert everything(begun) == before
    assert open_store(begun).sizes == {"a": 30, "b": 20}


@every("how", [{}, {"overwrite": True}, {"resume": True}])
def test_a_store_that_was_about_to_be_begun_is_begun(
    how: Any, tmp_path: Path, undisturbed: Path
) -> None:
    (tmp_path / "a.zarr" / "done").mkdir(parents=True)
    (tmp_path / "a.zarr" / "done" / "lock").touch()
    run(tmp_path / "a.zarr", **how)
    assert whole(tmp_path / "a.zarr", undisturbed)


def test_of_two_that_begin_one_store_one_wins(
    tmp_path: Path, undisturbed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second comes between the folder and the lock of the first, and finishes."""
    place, make = tmp_path / "a.zarr", Store._make_folder

    def make_and_wait(store: Store) -> bool:
        monkeypatch.setattr(Store, "_make_folder", make)
        made = make(store)
        run(place)
        return made

    monkeypatch.setattr(Store, "_make_folder", make_and_wait)
    with pytest.raises(OutputError, match="it exists; resume it"):
        run(place)
    assert whole(place, undisturbed)


@pytest.mark.slow
def test_another_sweep_takes_the_place_without_a_trace(begun: Path, undisturbed: Path) -> None:
    """Other axes, outputs and chunks: nothing of them stays."""
    from rocksteady.sweep.cases.axes import Axis
    from rocksteady.sweep.cases.grid import Grid
    from rocksteady.sweep.cases.outputs import Output
    from rocksteady.sweep.evaluate import evaluate
    from tests.sweep.store.test_store import cases

    grid = Grid(axes=tuple(Axis(name=n, values=v) for n, v in (("b", [0.1, 0.2]), ("c", [1, 2]))))
    word = Axis(name="word", values=["a", "long"])
    grid = Grid(axes=(word, *grid.axes))
    names = ("product", "kind", "truth", "nothing")
    outputs = [Output(name=n, dtype=d) for n, d in zip(names, "db?d", strict=True)]
    evaluate(cases, grid, outputs, run=Execution(store=Store(begun, overwrite=True, chunk=2)))
    assert not (begun / "sum").exists()
    assert not others(begun)
    run(begun, overwrite=True)
    assert whole(begun, undisturbed)


def test_marks_are_what_makes_a_store(begun: Path) -> None:
    assert is_store(begun)
    marks = json.loads((begun / "done" / "store.json").read_text(encoding="utf-8"))
    assert marks["axes"] == ["a", "b"]
    assert marks["outputs"] == ["sum", "sign"]
    assert not is_store(begun / "sum")
    (begun / "zarr.json").write_text("{", encoding="utf-8")
    assert not is_store(begun)


def test_marks_that_no_sweep_writes_are_those_of_no_store(begun: Path) -> None:
    marks = json.loads((begun / "done" / "store.json").read_text(encoding="utf-8"))
    assert owner_of(begun) is not None
    wrong: dict[str, list[Any]] = {
        "axes": [["a b"], ["", "b"], [1, "b"], [], ["..", "b"], None],
        "outputs": [["sum", "../sum"], ["3"], [2], [], None],
        "box": [[], [0, 3], [2, -1], [2.0, 3], ["2", 3], [2], [2, 3, 4], None],
        "sweep": ["", "none", marks["sweep"][1:], marks["sweep"].upper() + "G", 7, None],
    }
    taken = []
    for name, values in wrong.items():
        for value in values:
            for file in ("store.json", "store-copy.json"):
                text = json.dumps({**marks, name: value})
                (begun / "done" / file).write_text(text, encoding="utf-8")
            if owner_of(begun) is not None:
                taken.append((name, value))
    assert taken == []
