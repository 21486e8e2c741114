"""A store after a power failure at any moment: what counts as finished is there, nothing is wrong.

Writes that were not forced to the disk are dropped, torn and reordered by `tests.disk`.
"""

import shutil
import warnings
from pathlib import Path

import pytest

from rocksteady.sweep.run import Execution
from rocksteady.sweep.store import _writer
from rocksteady.sweep.store.ownership import others
from rocksteady.sweep.store.store import Store
from tests.disk import Moment, after_losses, recorded
from tests.sweep.executors.cases import GRID
from tests.sweep.store.faults import CHUNK, run, tree, whole


@pytest.fixture(params=[True, False], ids=["each chunk at once", "several at once"])
def _pace(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_writer, "SHARE", float("inf") if request.param else 1e-9)


def some_of(moments: list[Moment], step: int) -> list[Moment]:
    return [*moments[:-1:step], moments[-1]]


def resumed(folder: Path, undisturbed: Path) -> int:
    """Resume what is left of a store, and return how many cells it had."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # what counts as finished is whole: `done` is never ahead
        _, there = run(folder / "a.zarr", resume=True)
    assert whole(folder / "a.zarr", undisturbed)
    return there


@pytest.mark.slow
@pytest.mark.usefixtures("_pace")
def test_a_sweep_that_loses_power_is_resumed(undisturbed: Path, tmp_path: Path) -> None:
    place, lost = tmp_path / "place", tmp_path / "lost"
    place.mkdir()
    lost.mkdir()
    with recorded(place) as recorder:
        run(place / "a.zarr", executor="serial")
    counts = []
    for moment, folder in after_losses(some_of(recorder.moments, 7), lost, draws=1):
        counts.append(resumed(folder, undisturbed))
        assert counts[-1] == GRID.size or moment is not recorder.moments[-1], "not all was kept"
    assert {0, GRID.size} <= set(counts)


@pytest.mark.parametrize(("step", "draws"), [(23, 1), pytest.param(3, 2, marks=pytest.mark.slow)])
def test_a_resumed_sweep_that_loses_power_is_resumed(
    step: int, draws: int, begun: Path, undisturbed: Path, tmp_path: Path
) -> None:
    lost = tmp_path / "lost"
    lost.mkdir()
    place = tmp_path / "place"
    place.mkdir()
    shutil.move(begun, place / "a.zarr")
    for chunk in (1, 4):
        (place / "a.zarr" / "done" / "c" / str(chunk)).unlink()
    with recorded(place) as recorder:
        run(place / "a.zarr", resume=True, executor="serial")
    for _, folder in after_losses(some_of(recorder.moments, step), lost, draws=draws):
        assert resumed(folder, undisturbed) >= GRID.size - 2 * CHUNK


@pytest.mark.parametrize(("step", "draws"), [(61, 1), pytest.param(17, 1, marks=pytest.mark.slow)])
def test_a_store_that_is_replaced_when_the_power_fails_is_the_old_one_or_the_new_one(
    step: int, draws: int, undisturbed: Path, tmp_path: Path
) -> None:
    import functools

    from rocksteady.errors import OutputError
    from rocksteady.sweep.evaluate import evaluate
    from tests.sweep.executors.cases import OUTPUTS, some

    place, lost = tmp_path / "place", tmp_path / "lost"
    place.mkdir()
    lost.mkdir()
    old = functools.partial(some, factor=2.0)
    evaluate(old, GRID, OUTPUTS, run=Execution(store=Store(place / "a.zarr", chunk=CHUNK)))
    before = tree(place / "a.zarr")
    with recorded(place) as recorder:
        run(place / "a.zarr", overwrite=True, executor="serial")
    kept = set()
    for _, folder in after_losses(some_of(recorder.moments, step), lost, draws=draws):
        assert not others(folder / "a.zarr")
        try:
            resumed(folder, undisturbed)
            kept.add("new")
        except OutputError:
            assert tree(folder / "a.zarr") == before
            kept.add("old")
    assert kept == {"old", "new"}
