"""The study and its folder: what is written, when it is refused, and that nothing is half there."""

import csv
import errno
import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

from rocksteady.errors import InputError, OutputError
from rocksteady.formulas import steady_states
from rocksteady.orbits import compute_region_boundaries
from rocksteady.show.export.files import figure_bytes, json_text, save_csv
from rocksteady.studies.tso_wong_1989 import _study as study_module
from rocksteady.studies.tso_wong_1989._study import (
    FIGURES,
    SCHEMA,
    Study,
    check_folder,
    chosen_figures,
    reproduce,
    steps,
)
from tests.every import every
from tests.studies.tso_wong_1989.whole import PANELS, UNSTABLE, study, undrawn

mpl.use("Agg")

PNG, XML = b"\x89PNG\r\n", b"<?xml"
FEW = ("3b", "10")
"""Figures that are cheap to draw."""


@pytest.fixture
def whole(computed: None) -> Study:
    """The whole study with pictures that cost nothing."""
    assert computed is None
    return undrawn(study())


@pytest.fixture(scope="module")
def saved(computed: None, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder into which the whole study was saved, alone in another; for reading only."""
    assert computed is None
    folder = tmp_path_factory.mktemp("paper") / "out"
    written = undrawn(study()).save(folder)
    assert [file.parent for file in written] == [folder] * len(written)
    assert sorted(file.name for file in written) == names(folder)
    return folder


def names(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir())


def files_of(figures: tuple[str, ...]) -> set[str]:
    found = {f"figure-{name}.{kind}" for name in figures for kind in ("png", "svg", "pdf", "csv")}
    return found | {f"figure-{name}-fates.csv" for name in figures if name in UNSTABLE}


# ------------------------------------------------------------------------------------- what it is


def test_every_figure_of_the_paper_is_there_in_its_order(computed: None) -> None:
    assert computed is None
    assert FIGURES == PANELS
    assert tuple(timed.panel.id for timed in study().panels) == PANELS
    for timed in study().panels:
        panel = timed.panel
        assert panel.title
        assert panel.says.endswith(".")
        assert panel.computed.endswith(".")
        assert all(choice.endswith(".") for choice in panel.choices)
        assert panel.rows
        assert {len(row) for row in panel.rows} == {len(panel.header)}
        assert panel.command == f"rocksteady paper --only {panel.id} --out figure-{panel.id}"
        assert "nan" not in f"{panel.title} {panel.says} {panel.computed}".split()
        assert math.isfinite(timed.seconds)


def test_some_figures_come_in_the_papers_order_without_statements() -> None:
    said: list[str] = []
    few = reproduce(only=["10", "3b", "10"], done=said.append)
    assert [timed.panel.id for timed in few.panels] == list(FEW)
    assert said == [f"figure {name}" for name in FEW]
    assert few.claims == ()
    assert len(said) == steps(["10", "3b", "10"]) == few.steps
    assert few.counts() == {"reproduced": 0, "corrected": 0, "not-checkable": 0}


@pytest.mark.slow
def test_every_step_is_said(whole: Study, tmp_path: Path) -> None:
    said: list[str] = []
    whole.save(tmp_path / "out", done=said.append)
    assert said == [*(f"figure {name}" for name in PANELS), "report"]
    assert len(said) == whole.steps
    assert steps() == len(PANELS) + len(whole.claims)


@every("name", ["1", "2", "3", "8d", "14a", "", "3A", "figure-3a", " 3a"])
def test_a_figure_that_the_paper_has_not_is_refused_with_those_that_it_has(name: str) -> None:
    for refuse in (chosen_figures, lambda only: reproduce(only=only)):
        with pytest.raises(InputError, match=r"^only = .*3a 3b 4a") as caught:
            refuse(["3a", name])
        assert caught.value.value == name


# ------------------------------------------------------------------------------------- the folder


@pytest.mark.slow
def test_the_whole_study_leaves_these_files(saved: Path) -> None:
    assert set(names(saved)) == files_of(PANELS) | {"claims.json", "report.html"}
    assert names(saved.parent) == ["out"], "nothing is left beside it"
    for name in PANELS:
        assert (saved / f"figure-{name}.png").read_bytes().startswith(PNG)
        assert (saved / f"figure-{name}.svg").read_bytes().startswith(XML)


@pytest.mark.slow
def test_some_figures_leave_theirs_alone(tmp_path: Path) -> None:
    reproduce(only=FEW).save(tmp_path / "out")
    assert set(names(tmp_path / "out")) == files_of(FEW)


def test_claims_json_holds_every_statement(saved: Path) -> None:
    whole = study()
    text = (saved / "claims.json").read_text(encoding="utf-8")
    assert "NaN" not in text
    assert "Infinity" not in text
    values = json.loads(text)
    assert next(iter(values)) == "schema"
    assert values["schema"] == SCHEMA == "rocksteady/paper/1"
    assert len(values["claims"]) == len(whole.claims) >= 30
    assert sum(values["counts"].values()) == len(whole.claims)
    for claim, written in zip(whole.claims, values["claims"], strict=True):
        assert written["id"] == claim.id
        assert written["statement"] == claim.statement
        assert written["verdict"] in {"reproduced", "corrected", "not-checkable"}
        assert written["verdict"] == claim.verdict.value
        assert written["detail"] == claim.finding.detail
    corrected = {w["id"] for w in values["claims"] if w["verdict"] == "corrected"}
    assert corrected >= {f"E{number}" for number in range(1, 10)}


def test_the_report_names_every_file_and_holds_every_picture(saved: Path) -> None:
    page = (saved / "report.html").read_text(encoding="utf-8")
    for name in files_of(PANELS):
        assert f'"{name}"' in page
    assert page.count("data:image/svg+xml;base64,") == len(PANELS)
    assert str(saved) not in page


@pytest.mark.slow
def test_the_same_study_gives_the_same_bytes(tmp_path: Path) -> None:
    for folder in ("one", "two"):
        reproduce(only=FEW[1:]).save(tmp_path / folder)
    for name in names(tmp_path / "one"):
        one, two = ((tmp_path / folder / name).read_bytes() for folder in ("one", "two"))
        assert one == two, name


def test_the_statements_computed_again_are_the_same_bytes(whole: Study) -> None:
    # of those that are quick to compute again from nothing
    from rocksteady.studies.tso_wong_1989.claims import _equations as equations
    from rocksteady.studies.tso_wong_1989.claims import _regions as regions
    from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence

    again = Evidence()
    by_name = {claim.id: claim for claim in whole.claims}
    for statement in (*equations.STATEMENTS, *regions.STATEMENTS):
        finding, before = statement.check(again), by_name[statement.id].finding
        assert finding.detail == before.detail
        assert json_text("x", {"v": finding.values}) == json_text("x", {"v": before.values})


# -------------------------------------------------------------------------------------- the tables


def table(file: Path) -> tuple[list[str], list[list[str]]]:
    with file.open(encoding="utf-8", newline="") as stream:
        header, *rows = csv.reader(stream)
    return header, rows


def test_tables_read_back_as_they_were_computed(saved: Path) -> None:
    for timed in study().panels:
        panel = timed.panel
        header, rows = table(saved / f"figure-{panel.id}.csv")
        assert tuple(header) == panel.header
        assert len(rows) == len(panel.rows)
        for row, true in list(zip(rows, panel.rows, strict=True))[:: max(1, len(rows) // 40)]:
            for text, value in zip(row, true, strict=True):
                if isinstance(value, float):
                    assert float(text) == value or math.isnan(value)
                else:
                    assert text == str(value)


def test_the_table_of_a_plane_is_the_boundaries(saved: Path) -> None:
    header, rows = table(saved / "figure-4a.csv")
    column = {name: np.array([float(row[i]) for row in rows]) for i, name in enumerate(header)}
    expected = compute_region_boundaries(column["frequency_ratio"], 0.5, order=3)
    np.testing.assert_array_equal(column["existence_eq23"], expected.existence)
    np.testing.assert_array_equal(column["sign_eq24"], expected.sign)
    np.testing.assert_array_equal(column["kind_eq25"], expected.kind)


def test_the_table_of_peaks_is_the_closed_form(saved: Path) -> None:
    header, rows = table(saved / "figure-5b.csv")
    assert header == ["amplitude", "frequency_ratio", "peak", "stable"]
    chosen = rows[::211]
    a, w, peak = (np.array([float(row[i]) for row in chosen]) for i in range(3))
    states = steady_states(a, w, 0.8, order=3)
    assert states.peak is not None
    assert states.admissible is not None
    np.testing.assert_allclose(peak, np.where(states.admissible[0], states.peak[0], np.nan))
    assert [row[3] for row in chosen] == [str(bool(stable)) for stable in states.stable[0]]


# ----------------------------------------------------------------------------------- refused early


@pytest.mark.slow
def test_files_that_are_there_are_not_replaced_unasked(tmp_path: Path) -> None:
    few = reproduce(only=["10"])
    few.save(tmp_path / "out")
    file = tmp_path / "out" / "figure-10.csv"
    file.write_text("mine", encoding="utf-8")
    (tmp_path / "out" / "notes.txt").write_text("mine too", encoding="utf-8")
    before = names(tmp_path / "out")
    with pytest.raises(OutputError, match=r"figure-10.*--force"):
        few.save(tmp_path / "out")
    assert file.read_text(encoding="utf-8") == "mine"
    few.save(tmp_path / "out", force=True)
    assert file.read_text(encoding="utf-8") != "mine"
    assert (tmp_path / "out" / "notes.txt").read_text(encoding="utf-8") == "mine too"
    assert names(tmp_path / "out") == before
    assert names(tmp_path) == ["out"]


def test_figures_beside_those_of_another_run_are_no_conflict(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    for name in ("figure-8ab.png", "figure-1.csv", "claims2.json", "notes.txt"):
        (folder / name).touch()
    check_folder(folder)
    (folder / "figure-8a-fates.csv").touch()
    check_folder(folder, ["8b"])
    for only in (["8a"], []):
        with pytest.raises(OutputError, match="figure-8a-fates"):
            check_folder(folder, only)
        check_folder(folder, only, force=True)


@every("name", ["claims.json", "report.html", "figure-13d.svg"])
def test_any_file_of_the_whole_study_is_in_its_way(name: str, tmp_path: Path) -> None:
    (tmp_path / name).touch()
    with pytest.raises(OutputError, match=name.replace(".", r"\.")):
        check_folder(tmp_path)
    if not name.startswith("figure"):
        check_folder(tmp_path, ["3a"])


def a_file(path: Path) -> Path:
    path.touch()
    return path


@every(
    ("place", "reason"),
    [
        (lambda path: a_file(path / "file"), "it is a file"),
        (lambda path: path / "no" / "where", "does not exist"),
        (lambda path: a_file(path / "file") / "below", "does not exist"),
    ],
)
def test_a_place_that_cannot_be_a_folder_is_refused_before_anything_is_drawn(
    place: Callable[[Path], Path], reason: str, tmp_path: Path
) -> None:
    target = place(tmp_path)
    before = names(tmp_path)
    drawn: list[str] = []
    for force in (False, True):
        with pytest.raises(OutputError, match=reason):
            check_folder(target, force=force)
        with pytest.raises(OutputError, match=reason):
            reproduce(only=["10"]).save(target, force=force, done=drawn.append)
    assert drawn == []
    assert names(tmp_path) == before


def test_a_folder_that_is_not_writable_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rocksteady.show.export.folders.os.access", lambda *_: False)
    for target in (tmp_path, tmp_path / "new"):
        with pytest.raises(OutputError, match="not writable"):
            check_folder(target)
    assert names(tmp_path) == []


def test_an_empty_folder_that_is_there_is_used(tmp_path: Path) -> None:
    target = tmp_path / "out"
    target.mkdir()
    reproduce(only=["10"]).save(target)
    assert set(names(target)) == files_of(("10",))


# ---------------------------------------------------------------------------- nothing is half there


class OutOfInkError(Exception):
    """What a picture may fail with."""


def failing(few: Study, at: int, error: Exception) -> Study:
    """The study with a picture that cannot be drawn."""

    def draw() -> Any:
        raise error

    panels = list(few.panels)
    panels[at] = replace(panels[at], panel=replace(panels[at].panel, draw=draw))
    return replace(few, panels=tuple(panels))


@every("error", [OutOfInkError(), KeyboardInterrupt(), OSError(28, "full")])
@every("there", [False, True])
def test_a_picture_that_fails_leaves_nothing_behind(
    error: Exception, there: bool, tmp_path: Path
) -> None:
    few = failing(undrawn(reproduce(only=["10", "11b", "12a"])), 2, error)
    target = tmp_path / "out"
    if there:
        target.mkdir()
        (target / "figure-10.csv").write_text("old", encoding="utf-8")
    said: list[str] = []
    expected = OutputError if isinstance(error, OSError) else type(error)
    with pytest.raises(expected):
        few.save(target, force=True, done=said.append)
    assert said == ["figure 10", "figure 11b"], "it had begun"
    assert names(tmp_path) == (["out"] if there else [])
    if there:
        assert names(target) == ["figure-10.csv"]
        assert (target / "figure-10.csv").read_text(encoding="utf-8") == "old"


@pytest.mark.parametrize("at", [0, 1, 5])
def test_a_full_disk_leaves_nothing_behind_and_is_named(
    at: int, whole: Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    count = 0

    def full(*arguments: Any) -> None:
        nonlocal count
        count += 1
        if count > at:
            raise OSError(errno.ENOSPC, "No space left on device")
        save_csv(*arguments)

    monkeypatch.setattr(study_module, "save_csv", full)
    with pytest.raises(OutputError, match=r"^out = .*No space left on device"):
        whole.save(tmp_path / "out")
    assert names(tmp_path) == []


@pytest.mark.slow
def test_a_full_disk_at_the_last_file_leaves_nothing_behind(
    whole: Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_name: str, file: Path, text: str) -> None:
        assert text
        file.write_text(text[: len(text) // 2], encoding="utf-8")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(study_module, "save_text", full)
    with pytest.raises(OutputError, match="No space left"):
        whole.save(tmp_path / "out")
    assert names(tmp_path) == []


def test_a_step_that_is_interrupted_leaves_nothing_behind(tmp_path: Path) -> None:
    def interrupt(_: str) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        undrawn(reproduce(only=["10"])).save(tmp_path / "out", done=interrupt)
    assert names(tmp_path) == []


# ---------------------------------------------------------------------------------------- for real


@pytest.mark.slow
def test_every_figure_is_drawn_and_some_the_same_twice(computed: None, tmp_path: Path) -> None:
    assert computed is None
    for timed in study().panels:
        svg = figure_bytes(timed.panel.draw(), "svg")
        assert svg.startswith(XML)
        assert b"nan" not in svg.lower().replace(b"dominant", b"")
    few = replace(study(), panels=study().panels[::16])
    for folder in ("one", "two"):
        few.save(tmp_path / folder)
    for png in (tmp_path / "one").glob("*.png"):
        assert len(png.read_bytes()) > 10_000, png.name
    for name in names(tmp_path / "one"):
        if name != "report.html":  # it holds run times
            one, two = ((tmp_path / folder / name).read_bytes() for folder in ("one", "two"))
            assert one == two, name
