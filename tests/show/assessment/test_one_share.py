"""One object at one demand has one share and one rate, on every surface and in every file."""

import csv
import json
from pathlib import Path

import pytest

from rocksteady import assess_object, compute_risk
from rocksteady.export import write_assessment
from rocksteady.motions import make_synthetic_suite
from rocksteady.results.numbers import chance
from rocksteady.risk import DescribedObject
from rocksteady.words.hazard import rate_words
from tests.every import every
from tests.outputs import unrendered
from tests.risk.counted.recorded import SITE
from tests.show.assessment.loss_files import read_loss_files
from tests.show.assessment.pages import Page, drawn_once
from tests.show.export.test_components import QUIET

pytestmark = QUIET
SUITE = make_synthetic_suite(12)
CABINET = DescribedObject(
    values={
        "name": "cabinet",
        "friction": 0.6,
        "geometry": {"width_m": 0.5, "height_m": 1.8},
        "demand": {"pga_g": 0.5, "pgv_m_s": 0.5},
    }
)


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def counted(rows: list[dict[str, str]], level: float) -> float:
    """Return the share of the runs of a table that fall: of mirror images one counts."""
    kept = [
        row["status"] == "overturned"
        for row in rows
        if float(row["level"]) == level and row["direction"] == rows[0]["direction"]
    ]
    return sum(kept) / len(kept)


@every("stretch", [True, False])
def test_screen_page_json_and_tables_state_the_same_share_and_rate(
    stretch: bool, tmp_path: Path
) -> None:
    found = assess_object(CABINET, SUITE, stretch=stretch, hazard=SITE)
    share = found.share
    assert share is not None
    assert 0.1 < share < 0.9
    folder = tmp_path / "answer"
    with unrendered(), drawn_once():
        write_assessment(found, folder)
    assert counted(rows_of(folder / "results.csv"), 0.5) == pytest.approx(share, rel=1e-12)
    (row,) = (
        row
        for row in rows_of(folder / "shares.csv")
        if float(row["level"]) == 0.5 and row["damage_state"] == "overturned"
    )
    assert found.band is not None
    assert (float(row["share"]), float(row["low"])) == (share, found.band[0])
    answer = json.loads((folder / "run.json").read_text(encoding="utf-8"))["settings"]["answer"]
    assert answer["share"] == share
    assert found.risk is not None
    assert found.fragility is not None
    assert answer["rate_per_year"] == compute_risk(found.fragility, SITE).annual_rate
    (curves,) = read_loss_files(folder).values()
    for curve in curves:
        assert curve(0.5) == pytest.approx(share, abs=1e-5)
        assert curve(0.55) == pytest.approx(max(share, answer["share_1_1"]), abs=1e-5)

    page = Page((folder / "report.html").read_text(encoding="utf-8"))
    heading = page.headings[0][1].replace("\N{NO-BREAK SPACE}", " ")
    assert heading == found.sentence
    assert " ".join(found.summary().split()).startswith(heading)
    assert rate_words(found.risk) in " ".join(found.summary().split())
    assert rate_words(found.risk) in page.text
    words = chance(share)
    assert f": {words} (90 %" in heading
    table = page.text.partition("Counted shares")[2]
    assert words in table.partition("this demand")[2].partition(" g")[0]
    described = page.text.partition("as described")[2]
    assert described.lstrip().startswith(words)
