"""The atlas and its folder: what is written, what it says, and that nothing is half there."""

import csv
import json
import math
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest

from rocksteady import Execution
from rocksteady.errors import OutputError
from rocksteady.studies.atlas import _study as module
from rocksteady.studies.atlas._study import PICTURES, SCHEMA, TABLES, atlas, plane_of, steps
from rocksteady.studies.atlas.analysis.from_rest import FATES
from tests.outputs import unrendered
from tests.studies.atlas.small import AMPLITUDES, FREQUENCY_RATIOS, small, smallest, tiny

mpl.use("Agg")

FILES = {
    *(f"{name}.{kind}" for name in PICTURES for kind in ("png", "svg", "pdf")),
    *(f"{name}.csv" for name in TABLES),
    "atlas.json",
    "atlas.html",
}


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder into which the atlas was saved, its pictures unrendered; for reading only."""
    folder = tmp_path_factory.mktemp("study") / "out"
    with unrendered():
        small().save(folder)
    return folder


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("draw_families", "draw_coexistence", "draw_from_rest"):
        monkeypatch.setattr(module, name, tiny)


def names(folder: Path) -> set[str]:
    return {file.name for file in folder.iterdir()}


def table(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


# ------------------------------------------------------------------------------------- the files


@pytest.mark.slow
def test_the_atlas_leaves_these_files(tmp_path: Path) -> None:
    saved = tmp_path / "out"
    small().save(saved)
    assert names(saved) == FILES
    assert names(saved.parent) == {"out"}
    for name in PICTURES:
        assert (saved / f"{name}.png").read_bytes().startswith(b"\x89PNG\r\n")
        assert (saved / f"{name}.svg").read_bytes().startswith(b"<?xml")
        assert (saved / f"{name}.pdf").read_bytes().startswith(b"%PDF")
        assert (saved / f"{name}.png").stat().st_size > 20_000


def test_the_json_holds_the_key_numbers(saved: Path) -> None:
    text = (saved / "atlas.json").read_text(encoding="utf-8")
    assert "NaN" not in text
    values = json.loads(text)
    assert next(iter(values)) == "schema"
    assert values["schema"] == SCHEMA == "rocksteady/atlas/1"
    assert values["restitution"] == 0.8
    counts = {"amplitude": len(AMPLITUDES), "frequency_ratio": len(FREQUENCY_RATIOS)}
    assert values["cells"] == counts
    assert set(values["figures"]) | set(values["tables"]) == FILES - {"atlas.json", "atlas.html"}
    assert math.fsum(values["coexistence"]["shares"].values()) == pytest.approx(1.0)
    assert values["coexistence"]["most"] == small().found.motions.max()
    third = next(family for family in values["families"] if family["order"] == 3)
    assert third["doubling_meets_graze"]["frequency_ratio"] == pytest.approx(5.6875, abs=1e-4)


def test_the_tables_are_the_results(saved: Path) -> None:
    cells = table(saved / "coexistence.csv")
    assert len(cells) == len(AMPLITUDES) * len(FREQUENCY_RATIOS)
    found = small().found
    assert [int(cell["motions"]) for cell in cells] == found.motions.ravel().tolist()
    for cell in cells:
        several = ("of_1_period", "of_3_periods", "of_5_periods", "of_other_periods")
        orbits = sum(int(cell[name]) for name in several)
        assert orbits == len(cell["orbits"].split())
        assert int(cell["motions"]) == orbits + int(cell["rest"]) + int(cell["aperiodic"])
    fates = table(saved / "from-rest.csv")
    assert {cell["fate_at_phase_0"] for cell in fates} <= set(FATES)
    shares = np.array([int(c["phases_overturned"]) / int(c["phases"]) for c in fates])
    np.testing.assert_allclose(shares, small().rest.overturned.ravel())
    bands = table(saved / "bands.csv")
    assert len(bands) == 3 * len(FREQUENCY_RATIOS)
    for row in bands:
        ends = [float(row[name]) for name in list(row)[2:]]
        assert ends == sorted(ends) or math.isnan(ends[0])
    borders = table(saved / "borders.csv")
    assert {row["border"] for row in borders} >= {"existence", "symmetry-breaking", "graze"}


def test_the_page_needs_nothing_and_names_every_file(saved: Path) -> None:
    page = (saved / "atlas.html").read_text(encoding="utf-8")
    assert page.count("data:image/svg+xml;base64,") == len(PICTURES)
    for name in FILES - {"atlas.html"}:
        assert f'href="{name}"' in page
    assert "http" not in page.replace("http-equiv", "")
    assert str(saved) not in page
    for unsaid in ("nan", "None", "inf "):
        assert unsaid not in page.split("base64,")[0]


@pytest.mark.slow
def test_the_same_atlas_gives_the_same_bytes(tmp_path: Path) -> None:
    plane = smallest().plane
    again = atlas(
        0.8,
        amplitude=plane.amplitude,
        frequency_ratio=plane.frequency_ratio,
        orders=(1,),
        run=Execution(workers=1),
    )
    smallest().save(tmp_path / "one")
    again.save(tmp_path / "two")
    for name in names(tmp_path / "one") - {"atlas.html"}:  # it holds run times
        one, two = ((tmp_path / folder / name).read_bytes() for folder in ("one", "two"))
        assert one == two, name


# -------------------------------------------------------------------------------- other planes


@pytest.mark.slow
@pytest.mark.parametrize("restitution", [0.2, 0.95])
@pytest.mark.usefixtures("undrawn")
def test_any_restitution_and_window_has_an_atlas(restitution: float, tmp_path: Path) -> None:
    rows, columns = np.linspace(0.1, 0.7, 3), np.linspace(9.0, 11.0, 3)
    said: list[str] = []
    whole = atlas(restitution, amplitude=rows, frequency_ratio=columns, done=said.append)
    assert len(said) == steps(whole.plane)
    assert set(whole.save(tmp_path / "out")) == {tmp_path / "out" / name for name in FILES}


@pytest.mark.slow
def test_a_plane_where_nothing_is_stable_can_be_drawn(tmp_path: Path) -> None:
    whole = atlas(0.3, amplitude=[7.0, 7.5, 8.0], frequency_ratio=[0.2, 0.3, 0.4], orders=(5,))
    assert whole.found.motions.max() == 0
    whole.save(tmp_path / "out")
    assert names(tmp_path / "out") == FILES


def test_the_default_plane_is_that_of_the_paper_and_more() -> None:
    plane = plane_of()
    assert plane.restitution == 0.8
    assert plane.orders == (1, 3, 5)
    assert (plane.ratios[0], plane.ratios[-1], len(plane.ratios)) == (0.075, 12.0, 160)
    assert (plane.amplitudes[0], plane.amplitudes[-1], len(plane.amplitudes)) == (0.08, 8.0, 100)


# ------------------------------------------------------------------------ nothing is half there


@pytest.mark.usefixtures("undrawn")
def test_files_that_are_there_are_not_replaced_unasked(tmp_path: Path) -> None:
    (tmp_path / "families.csv").touch()
    (tmp_path / "notes.txt").touch()
    small().save(tmp_path)
    (tmp_path / "bands.csv").write_text("mine", encoding="utf-8")
    with pytest.raises(OutputError, match="--force"):
        small().save(tmp_path)
    assert (tmp_path / "bands.csv").read_text(encoding="utf-8") == "mine"
    small().save(tmp_path, force=True)
    assert (tmp_path / "bands.csv").read_text(encoding="utf-8") != "mine"
    assert names(tmp_path) == FILES | {"families.csv", "notes.txt"}


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("error", [KeyboardInterrupt(), OSError(28, "No space left on device")])
def test_what_fails_on_the_way_leaves_nothing_behind(
    error: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object) -> None:
        raise error

    monkeypatch.setattr(module, "save_text", fails)
    expected = OutputError if isinstance(error, OSError) else KeyboardInterrupt
    with pytest.raises(expected):
        small().save(tmp_path / "out")
    assert list(tmp_path.iterdir()) == []
