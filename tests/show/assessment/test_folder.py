"""The folder of an assessment: read back, the same bytes twice, and all or nothing."""

import csv
import hashlib
import json
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import durable
from rocksteady.errors import InputError, OutputError
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.risk.assess.assessment import Assessment, assess_object
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.objects_table import assess_placed
from rocksteady.risk.assess.placed_objects import place_objects
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from rocksteady.show.assessment import folder as module
from rocksteady.show.assessment.folder import write_assessment
from tests.every import every
from tests.outputs import unrendered
from tests.risk.counted.recorded import described as shaken
from tests.show.assessment.loss_files import read_loss_files
from tests.show.assessment.pages import drawn_once
from tests.show.export.test_components import QUIET

SUITE = make_synthetic_suite(11)
pytestmark = QUIET
FILES = [
    *("fragility.csv", "fragility.json", "fragility.xml", "report.html", "results.csv"),
    *("run.json", "shares.csv"),
]
ALONE = ["report.html", "run.json"]
"""Files of an object that slides."""


def described(friction: float) -> DescribedObject:
    return DescribedObject(
        values={
            "name": "Büste, 3 (Saal)",
            "friction": friction,
            "geometry": {"width_m": 0.34, "height_m": 1.8},
            "demand": {"pga_g": 0.4, "pgv_m_s": 0.3},
            "assessment": {"damage_states": ["overturned"], "draws": 2},
        }
    )


@pytest.fixture(scope="module", name="rocking")
def _rocking() -> Assessment:
    return assess_object(described(0.5), SUITE)


@pytest.fixture(scope="module", name="sliding")
def _sliding() -> Assessment:
    return assess_object(described(0.1), SUITE)


def names(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


def write_whole(found: Assessment, folder: Path) -> Path:
    """Write an answer with all its pictures into a folder, and return that of the answer."""
    read = folder / "read.toml"
    read.write_bytes(b"name = 'x'")
    out = folder / "answer"
    written = write_assessment(found, out, command="rocksteady assess x", files=[read])
    assert sorted(file.name for file in written) == names(out) == FILES
    return out


@pytest.fixture(scope="module", name="out")
def _out(rocking: Assessment, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an answer; for reading only."""
    return write_whole(rocking, tmp_path_factory.mktemp("whole"))


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_the_manifest_has_the_answer_and_the_hashes_of_all_that_went_in(
    rocking: Assessment, out: Path
) -> None:
    values = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert values["command"] == "rocksteady assess x"
    assert values["files"][0]["sha256"] == hashlib.sha256(b"name = 'x'").hexdigest()
    samples = SUITE[0].acceleration_m_s2.astype("<f8").tobytes()
    assert values["records"][0]["sha256"] == hashlib.sha256(samples).hexdigest()
    assert len(values["records"]) == len(SUITE)
    assert values["settings"]["answer"]["share"] == rocking.share
    assert values["settings"]["object"]["values"]["geometry"]["width_m"] == 0.34


def test_each_run_has_the_factors_that_give_its_record_the_peaks_of_its_level(
    rocking: Assessment, out: Path
) -> None:
    """A scaled and stretched record has the PGA of the level, and the PGV that goes with it."""
    assert rocking.fragility is not None
    rows = rows_of(out / "results.csv")
    assert len(rows) == rocking.fragility.runs
    motions = {each.name: each for each in SUITE}
    for row in rows[:: len(rows) // 40]:
        motion, level = motions[row["record"]], float(row["level"])
        scaled = float(row["scale"]) * motion.acceleration_m_s2 / 9.80665
        assert np.abs(scaled).max() == pytest.approx(level, rel=1e-9)
        stretched = replace(
            motion.scaled(float(row["scale"])), dt_s=float(row["stretch"]) * motion.dt_s
        )
        pgv = compute_measure(stretched, Measure("pgv_m_s"))
        assert pgv == pytest.approx(level * 0.3 / 0.4, rel=1e-6)


def test_each_kind_of_a_table_has_a_component_unless_none_falls(tmp_path: Path) -> None:
    """Two kinds of one name have two; of the third all falls are taken out."""
    peaks: dict[str, Any] = {"pga_g": 0.5, "pgv_m_s": 0.45, "assessment": {"draws": 1}}
    objects = [
        shaken(width, 1.6, name=name, **peaks)
        for name, width in (("rack 6/7", 0.3), ("rack 6/7", 0.25), ("stele", 0.35))
    ]
    table = assess_placed(place_objects(objects, SUITE), None, [None] * 3, curves=True)
    state = table.curves[2].states[-1]
    stood = [replace(count, fell=0 * count.fell) for count in state.curve.counts]
    stands = replace(state, curve=replace(state.curve, counts=stood))
    table = replace(table, curves={**table.curves, 2: replace(table.curves[2], states=(stands,))})
    out = tmp_path / "answer"
    with unrendered():
        write_assessment(table, out)
    assert names(out) == sorted({*FILES, "answers.csv"} - {"results.csv"})
    values = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert values["settings"]["no_loss_component"] == ["stele"]
    components = read_loss_files(out)
    assert {*components} == {"RS.rack_6_7", "RS.rack_6_7.2"}
    kinds = [row for row, _ in table.kinds if row["name"] != "stele"]
    for row, curves in zip(kinds, components.values(), strict=True):
        for curve, (level, key) in product(curves, ((0.5, "share"), (0.55, "share_1_1"))):
            assert curve(level) == pytest.approx(max(row["share"], row[key]), abs=1e-5)


def test_lognormals_far_from_the_counts_are_refused(rocking: Assessment, tmp_path: Path) -> None:
    assert rocking.fragility is not None
    assert rocking.fragility.states[-1].lognormal.misfit > 0.1
    with pytest.raises(InputError, match="points"):
        write_assessment(rocking, tmp_path / "answer", lognormal=True)
    assert [*tmp_path.iterdir()] == []


@pytest.mark.slow
def test_the_same_answer_gives_the_same_bytes(
    rocking: Assessment, out: Path, tmp_path: Path
) -> None:
    again = write_whole(rocking, tmp_path)
    for file in FILES:
        assert (out / file).read_bytes() == (again / file).read_bytes()


@pytest.mark.slow
def test_an_object_that_slides_leaves_its_inputs_alone(
    sliding: Assessment, rocking: Assessment, tmp_path: Path
) -> None:
    out = tmp_path / "answer"
    with unrendered(), drawn_once():
        write_assessment(rocking, out)
    with pytest.raises(OutputError, match=r"it holds fragility\.csv and 6 more; add --force"):
        write_assessment(sliding, out)
    assert names(out) == FILES
    write_assessment(sliding, out, force=True)
    assert names(out) == ALONE, "no table of another answer stays behind"
    values = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert values["settings"]["answer"]["verdict"] == "slides"


def test_a_folder_with_anything_else_is_left_alone(sliding: Assessment, tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("years of work", encoding="utf-8")
    for force in (False, True):
        with pytest.raises(OutputError, match=r"it holds thesis\.txt, which is no file"):
            write_assessment(sliding, tmp_path, force=force)
    assert names(tmp_path) == ["thesis.txt"]
    (tmp_path / "empty").mkdir()
    write_assessment(sliding, tmp_path / "empty")
    assert names(tmp_path / "empty") == ALONE


@pytest.mark.slow
def test_a_run_that_was_killed_does_not_stand_in_the_way(
    sliding: Assessment, tmp_path: Path
) -> None:
    """As of `kill -9`, after which nothing can be tidied: the next write removes what it left."""
    left = tmp_path / ".rocksteady-partial-ab_12xyz"
    left.mkdir(mode=0o700)
    (left / "run.json").write_text("{", encoding="utf-8")
    write_assessment(sliding, tmp_path)
    write_assessment(sliding, tmp_path, force=True)
    assert names(tmp_path) == ALONE
    (tmp_path / ".partially").mkdir()
    with pytest.raises(OutputError, match=r"it holds \.partially, which is no file"):
        write_assessment(sliding, tmp_path, force=True)


def test_a_file_that_no_answer_wrote_is_not_replaced(sliding: Assessment, tmp_path: Path) -> None:
    """Not with force: an input of the name of an output may lie in a folder of its own."""
    for name in ("results.csv", "report.html", "fragility.csv"):
        folder = tmp_path / name.partition(".")[0]
        folder.mkdir()
        (folder / name).write_text("mine", encoding="utf-8")
        with pytest.raises(OutputError, match="which no earlier answer wrote"):
            write_assessment(sliding, folder, force=True)
        assert [each.read_text(encoding="utf-8") for each in folder.iterdir()] == ["mine"]


@every(("place", "name"), [(module, "write_manifest"), (durable, "write")])
def test_what_fails_leaves_nothing_half_written(
    place: Any, name: str, sliding: Assessment, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(place, name, full)
    with pytest.raises(OutputError, match="No space left") as refusal:
        write_assessment(sliding, tmp_path / "answer")
    assert "partial-" not in str(refusal.value)
    assert not (tmp_path / "answer").exists()


@pytest.mark.slow
def test_what_is_interrupted_at_the_disk_leaves_no_mixture(
    sliding: Assessment, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The old files stay, all of them, where Ctrl-C comes while the second is forced to it."""
    out = tmp_path / "answer"
    write_assessment(sliding, out, command="first")
    before = {each.name: each.read_bytes() for each in out.iterdir()}
    sync, forced = durable.sync, []

    def interrupted(file: Path) -> None:
        if file.parent.parent == out:
            forced.append(file)
        if len(forced) == 2:
            raise KeyboardInterrupt
        sync(file)

    monkeypatch.setattr(durable, "sync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_assessment(sliding, out, command="second", force=True)
    assert {each.name: each.read_bytes() for each in out.iterdir()} == before
