"""The study of proved chaos: its map, its claims, its folder and its page."""

import csv
import json
import re
from functools import cache
from itertools import product
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest

from rocksteady.certify.chaos_study import _study as module
from rocksteady.certify.chaos_study._study import OURS, Chaos, chaos
from rocksteady.certify.proofs import checker
from rocksteady.certify.proofs.chaos import certify_chaos
from rocksteady.errors import OutputError
from rocksteady.formulas import heteroclinic_amplitude
from tests.outputs import unrendered

mpl.use("Agg")
EDGES = np.array([0.3, 0.4, 2.0, 2.1]), np.array([1.9, 2.0, 2.1])
STRIP = np.array([1.1, 1.3]), np.array([2.0])


@cache
def small() -> Chaos:
    return chaos("0.8", EDGES, STRIP)


def words(least: int, symbols: int, half_periods: int) -> int:
    """Number of sequences of flights that add up to some half periods, one by one."""
    counts = [1] + [0] * half_periods
    for length in range(1, half_periods + 1):
        lasts = range(least, length + 1, 2)
        counts[length] = symbols * sum(counts[length - last] for last in lasts)
    return counts[half_periods]


@pytest.mark.slow
def test_a_box_is_proved_where_a_point_of_it_is_and_none_below_the_closed_form() -> None:
    found = small().entropy
    assert found.shape == (3, 2)
    for (row, low), (column, ratio) in product(enumerate((0.3, 0.4, 2.0)), enumerate((1.9, 2.0))):
        if low < 0.4:
            assert low + 0.1 < heteroclinic_amplitude(ratio + 0.1, 0.8)
            assert found[row, column] == 0.0
        if low == 2.0:  # three half periods and more, over one phase or two
            growths = (words(3, n, 401) / words(3, n, 201) for n in (1, 2))
            bounds = [2.0 * np.log(growth) / 200.0 for growth in growths]
            assert min(abs(found[row, column] - bound) for bound in bounds) < 2e-3


@pytest.mark.slow
def test_the_rocking_itself_is_proved_chaotic_above_the_cascade_alone() -> None:
    """At 1.1 the motion that leans is stable (the cascade begins at 2.6246 = 1.238 of 2.1202)."""
    (stable,), (proved,) = small().rocking.tolist()
    assert stable == 0.0
    low, high = module.small_boxes(STRIP, "0.8")[1][0]
    assert low < 1.3 * 2.120166931264842 < high
    for amplitude in (low, high):
        point = certify_chaos(amplitude, 2, "0.8", kind="homoclinic")
        assert float(point.content["claim"]["entropy_per_period"]) == pytest.approx(
            proved, abs=0.03
        )


@pytest.mark.slow
def test_the_folder_holds_certificates_that_hold_and_claims_no_more(tmp_path: Path) -> None:
    study, done = small(), list[str]()
    with unrendered():
        files = study.save(tmp_path / "out", done=done.append)
    assert done == ["map", "rocking", "page"]
    assert len(done) == study.steps
    assert all(re.fullmatch(OURS, file.name) for file in files)
    values = json.loads((tmp_path / "out" / "chaos.json").read_text(encoding="utf-8"))
    assert values["entropy_per_period"] == study.entropy.tolist()
    assert values["rocking_per_period"] == study.rocking.tolist()
    for name in ("hilltop", "homoclinic"):
        text = (tmp_path / "out" / f"{name}.json").read_text(encoding="utf-8")
        assert checker.check(text, checker.arb) == "holds"
        assert values["points"][name]["proved"]
    page = (tmp_path / "out" / "chaos.html").read_text(encoding="utf-8").replace("\xa0", " ")
    assert page.count("<td>holds</td>") == 4
    assert "first computer-assisted proof" in page
    assert "is not shown" in page
    for sentence in study.sentences[:1]:
        assert sentence in page
    with (tmp_path / "out" / "map.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["entropy"]) for row in rows] == study.entropy.ravel().tolist()
    assert float(rows[-1]["amplitude_low"]) == 2.0
    assert float(rows[-1]["ratio_high"]) == 2.1
    with pytest.raises(OutputError):
        study.save(tmp_path / "out")


@pytest.mark.slow
def test_a_claim_that_is_undecided_has_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "CASES", {"hilltop": ("0.3", "2"), "homoclinic": ("2", "2")})
    study = chaos("0.8", (EDGES[0][:2], EDGES[1][:2]), (STRIP[0][:1], STRIP[1]))
    assert "undecided" in study.sentences[1]
    with unrendered():
        names = {file.name for file in study.save(tmp_path / "out")}
    assert not names & {"hilltop.json", "homoclinic.json"}
