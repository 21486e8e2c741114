"""The folder of an assessment: read back, the same bytes twice, and all or nothing."""

import csv
import hashlib
import json
import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from rocksteady import durable
from rocksteady.errors import OutputError
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.risk.assess.assessment import Assessment, assess_object
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.show.assessment import folder as module
from rocksteady.show.assessment.folder import write_assessment
from tests.every import every
from tests.outputs import unrendered
from tests.show.assessment.pages import drawn_once

SUITE = make_synthetic_suite(11)
FILES = [
    "fragility.csv", "fragility.json", "fragility.xml", "fragility_peaks.xml", "report.html",
    "results.csv", "run.json",
]  # fmt: skip
ALONE = ["report.html", "run.json"]
"""Files of an object that slides."""


def described(friction: float) -> DescribedObject:
    return DescribedObject(
        values={
            "name": "Büste, 3 (Saal)",
            "friction": friction,
            "geometry": {"width_m": 0.34, "height_m": 1.8},
            "demand": {"pga_g": 0.4, "pgv_m_s": 0.3, "place": "floor"},
            "assessment": {
                "damage_states": ["overturned"], "draws": 2, "levels": 6, "replicates": 0,
                "target_probability": 0.9,
            },
        }
    )  # fmt: skip


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


@pytest.mark.slow
def test_every_file_is_there_and_reads_back(rocking: Assessment, out: Path) -> None:
    assert rocking.fragility is not None
    with (out / "results.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == rocking.fragility.ensemble["status"].size
    # Of a symmetric block the reversed record gives the mirror image: a row, and no trial.
    fell = sum(
        row["status"] == "overturned" for row in rows if row["direction"] == rows[0]["direction"]
    )
    assert fell == rocking.fragility.state("overturned").plain.failures

    values = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert values["command"] == "rocksteady assess x"
    assert values["files"][0]["sha256"] == hashlib.sha256(b"name = 'x'").hexdigest()
    samples = SUITE[0].acceleration_m_s2.astype("<f8").tobytes()
    assert values["records"][0]["sha256"] == hashlib.sha256(samples).hexdigest()
    assert len(values["records"]) == len(SUITE)
    assert values["settings"]["answer"]["probability"] == rocking.probability
    assert values["settings"]["object"]["values"]["geometry"]["width_m"] == 0.34


@pytest.mark.slow
def test_curves_are_in_metres_a_second_for_pelicun_and_centimetres_for_openquake(
    rocking: Assessment, out: Path
) -> None:
    with (out / "fragility.csv").open(encoding="utf-8", newline="") as stream:
        row, peaks = csv.DictReader(stream)
    assert peaks["ID"] == f"{row['ID']}.peaks"
    assert rocking.fragility is not None
    curve = rocking.fragility.state("overturned").curve  # over PGV, of the runs that lift
    assert isinstance(curve, FragilityCurve)
    assert row["Demand-Type"] == "Peak Floor Velocity"
    assert row["Demand-Directional"] == "1"
    assert float(row["LS1-Theta_0"]) == pytest.approx(curve.median, rel=1e-9)
    assert float(row["LS1-Theta_1"]) == pytest.approx(curve.beta, rel=1e-9)
    assert re.fullmatch(r"RS\.[A-Za-z0-9_.]+", row["ID"])
    root = ET.fromstring((out / "fragility.xml").read_text(encoding="utf-8"))
    space = {"n": "http://openquake.org/xmlns/nrml/0.5"}
    imls = root.find(".//n:imls", space)
    params = root.find(".//n:params", space)
    assert imls is not None
    assert params is not None
    assert imls.attrib["imt"] == "PGV"
    mean = 100.0 * curve.median * math.exp(0.5 * curve.beta**2)
    assert float(params.attrib["mean"]) == pytest.approx(mean, rel=1e-9)


@pytest.mark.slow
def test_the_description_for_loss_tools_names_the_object_once_a_component(out: Path) -> None:
    for name, count in (("fragility.json", 2), ("fragility.xml", 1), ("fragility_peaks.xml", 1)):
        text = (out / name).read_text(encoding="utf-8")
        assert len(re.findall(r"B(?:ü|\\u00fc)ste, 3 \(Saal\)", text)) == count, name


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
    assert names(out) == ALONE, "no curve of another answer stays behind"
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


def test_what_fails_leaves_nothing_half_written(
    rocking: Assessment, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "write_openquake", full)
    with pytest.raises(OutputError, match="No space left"):
        write_assessment(rocking, tmp_path / "answer")
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


def test_a_full_disk_is_reported_with_the_folder_of_the_answer(
    sliding: Assessment, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(durable, "write", full)
    with pytest.raises(OutputError, match="No space left") as refusal:
        write_assessment(sliding, tmp_path / "answer")
    assert "partial-" not in str(refusal.value)
    assert not (tmp_path / "answer").exists()


@pytest.mark.slow
@every("states", [None, ["uplift"]])
def test_any_damage_states_make_a_folder_with_both_components(
    states: list[str] | None, tmp_path: Path
) -> None:
    """Those of an object that names none are four, and the cut at a ratio of peaks has the last."""
    options: dict[str, Any] = {
        "draws": 2, "levels": 6, "replicates": 0, "target_probability": 0.9,
    }  # fmt: skip
    if states is not None:
        options["damage_states"] = states
    values: dict[str, Any] = {**described(0.5).values, "assessment": options}
    found = assess_object(DescribedObject(values=values), SUITE)
    out = tmp_path / "answer"
    with unrendered(), drawn_once():
        write_assessment(found, out)
    assert names(out) == FILES
    with (out / "fragility.csv").open(encoding="utf-8", newline="") as stream:
        rows = [row["ID"] for row in csv.DictReader(stream)]
    assert rows == ["RS.Buste_3_Saal", "RS.Buste_3_Saal.peaks"]
    for file, identifier in zip(("fragility.xml", "fragility_peaks.xml"), rows, strict=True):
        root = ET.fromstring((out / file).read_text(encoding="utf-8"))
        (function,) = root.iter("{http://openquake.org/xmlns/nrml/0.5}fragilityFunction")
        assert function.attrib["id"] == identifier
