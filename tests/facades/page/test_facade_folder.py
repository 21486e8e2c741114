"""The folder of a facade: read back, the same bytes twice, and all or nothing."""

import csv
import hashlib
import json
from pathlib import Path

import pytest

from rocksteady.errors import InputError, OutputError
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.page import facade_folder as module
from rocksteady.facades.page.facade_folder import write_facade
from rocksteady.facades.page.files import FACADE
from tests.facades.page.checked_facades import SUITE, alone, thin

FILES = ["checks.csv", "facade.json", "report.html", "run.json", "runs.csv"]


@pytest.fixture(name="no_page")
def _no_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write one line for the page, whose pictures take long and are tested elsewhere."""
    monkeypatch.setattr(module, "facade_html", lambda *_: "page")


def names(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.usefixtures("no_page")
def test_every_file_is_there_and_reads_back(tmp_path: Path) -> None:
    read = tmp_path / "wall.toml"
    read.write_bytes(b"[facade]")
    out = tmp_path / "answer"
    found = thin()
    write_facade(
        found, out, language="it", motions=SUITE, command="rocksteady facade wall", files=[read]
    )
    assert names(out) == FILES

    rows = rows_of(out / "checks.csv")
    assert [(row["limit_state"], row["method"]) for row in rows] == [
        (each.limit_state, each.method) for each in found.checks
    ]
    assert float(rows[1]["capacity"]) == pytest.approx(0.1 / 1.35)
    assert isinstance(found.runs, FacadeRuns)
    assert len(rows_of(out / "runs.csv")) == found.runs.share.size == 14

    values = json.loads((out / "facade.json").read_text(encoding="utf-8"))
    assert values["schema"] == "rocksteady/facade/2"
    assert values["a0_g"] == pytest.approx(0.098765, abs=5e-7)
    assert values["t_slv_s"] == pytest.approx(1.958239, abs=5e-7)
    assert values["t_slc_s"] == pytest.approx(2.727547, abs=5e-7)
    assert len(values["checks"]) == len(found.checks)
    assert values["a0_lumped_g"] == values["linear_g"] == pytest.approx(0.1 / 1.35)
    assert values["ending"] == []
    corners = [(each["displacement_m"], each["capacity_g"]) for each in values["capacity_curve"]]
    assert corners == [(0.0, values["a0_g"]), (values["d0_m"], 0.0)]

    made = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert made["command"] == "rocksteady facade wall"
    assert made["files"][0]["sha256"] == hashlib.sha256(b"[facade]").hexdigest()
    samples = SUITE[0].acceleration_m_s2.astype("<f8").tobytes()
    assert made["records"][0]["sha256"] == hashlib.sha256(samples).hexdigest()
    assert made["settings"] == {"language": "it"}


@pytest.mark.slow
def test_the_same_check_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        write_facade(alone(), tmp_path / name)
    for file in names(tmp_path / "one"):
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes()


@pytest.mark.usefixtures("no_page")
def test_tables_and_json_do_not_depend_on_the_language(tmp_path: Path) -> None:
    for language in ("en", "it"):
        write_facade(thin(), tmp_path / language, language=language)
    for file in ("checks.csv", "runs.csv", "facade.json"):
        assert (tmp_path / "en" / file).read_bytes() == (tmp_path / "it" / file).read_bytes()


@pytest.mark.usefixtures("no_page")
def test_only_a_folder_of_ours_is_replaced_and_no_runs_stay_behind(tmp_path: Path) -> None:
    out = tmp_path / "answer"
    write_facade(thin(), out)
    with pytest.raises(OutputError, match=r"it holds checks\.csv and 4 more; add --force"):
        write_facade(alone(), out)
    assert names(out) == FILES
    write_facade(alone(), out, force=True)
    assert names(out) == [name for name in FILES if name != "runs.csv"]
    (out / "thesis.txt").write_text("years of work", encoding="utf-8")
    with pytest.raises(OutputError, match=r"it holds checks\.csv and 3 more; add --force"):
        FACADE.check(out)
    with pytest.raises(OutputError, match=r"it holds thesis\.txt, which is no file of a facade"):
        FACADE.check(out, force=True)
    assert (out / "thesis.txt").exists()


def test_what_fails_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    with pytest.raises(InputError, match="language"):
        write_facade(alone(), tmp_path / "answer", language="fr")
    monkeypatch.setattr(module, "facade_html", full)
    with pytest.raises(OutputError, match="No space left"):
        write_facade(alone(), tmp_path / "answer")
    assert names(tmp_path) == []


@pytest.mark.usefixtures("no_page")
@pytest.mark.parametrize("name", ["runs.csv", "checks.csv"])
def test_a_file_that_was_read_is_neither_replaced_nor_removed(name: str, tmp_path: Path) -> None:
    out, link = tmp_path / "out", tmp_path / "link.csv"
    out.mkdir()
    (out / name).write_text("a record", encoding="utf-8")
    link.symlink_to(out / name)
    with pytest.raises(OutputError, match="this file is read; name another folder"):
        write_facade(alone(), out, files=[link], force=True)
    assert (out / name).read_text(encoding="utf-8") == "a record"
    assert names(out) == [name]
