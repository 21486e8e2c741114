"""`--spectrum` of `rocksteady assess` and `fragility`: one answer by every way in, and refusals."""

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.codes import make_design_spectrum
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.every import every

CODE = "en1998-1:2004:type1:D:ag=0.2"
BLOCK = "assess --width-m 0.2 --height-m 1 --friction 0.6"
OBJECT = 'name = "crate"\nfriction = 0.6\n[geometry]\nwidth_m = 0.2\nheight_m = 1.0\n'


@pytest.fixture(scope="module", name="folder")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Twelve records beside a spectrum, objects and a table."""
    place = tmp_path_factory.mktemp("spectra")
    (place / "suite").mkdir()
    for seed in range(1, 13):
        at2(place / "suite" / f"G{seed}090.AT2", samples(seed), dt_s=0.01 * (1 + seed % 3))
    table = make_design_spectrum(CODE).table
    rows = np.column_stack([table.periods_s, table.values_g])
    lines = [f"{t!r} {sa!r}" for t, sa in rows.tolist()]
    (place / "design.csv").write_text("# damping 5 %, Sa [g]\n" + "\n".join(lines), "utf-8")
    (place / "late.csv").write_text("# damping 0.05\n0.1 0.6\n1 0.4\n4 0.05\n", "utf-8")
    (place / "plain.toml").write_text(OBJECT, "utf-8")
    for name, demand in (
        ("file", 'spectrum = "design.csv"'), ("code", f'spectrum = "{CODE}"'),
        ("late", 'pga_g = 0.27\nspectrum = "late.csv"'), ("peak", "pga_g = 0.3"),
    ):  # fmt: skip
        (place / f"{name}.toml").write_text(f"{OBJECT}[demand]\n{demand}\n", "utf-8")
    (place / "stated.csv").write_text("name,width_m,height_m,pga_g\ncrate,0.2,1,0.3\n", "utf-8")
    (place / "objects.csv").write_text(
        "name,width_m,height_m,friction,pga_g\ncrate,0.2,1,0.6,\nother,0.2,1,0.6,0.3\n", "utf-8"
    )
    return place


@pytest.mark.slow
def test_every_way_in_has_the_same_answer(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file of an object names its spectrum from its own folder."""
    monkeypatch.chdir(folder.parent)
    suite = folder / "suite"
    found: list[dict[str, Any]] = [
        rocksteady(f"{BLOCK} --spectrum {CODE} --json --records", suite).json,
        rocksteady(f"{BLOCK} --json --spectrum", folder / "design.csv", "--records", suite).json,
        *(rocksteady("assess --json", folder / f"{name}.toml", "--records", suite).json
          for name in ("file", "code")),
        rocksteady(f"assess --spectrum {CODE} --json", folder / "plain.toml", "--records",
                   suite).json,
    ]  # fmt: skip
    first = found[0]
    assert first["demand"] == {"kind": "spectrum", "words": "the spectrum of 0.27 g"}
    assert 0.0 < first["share"] < 1.0
    for other in found[1:]:
        for key in ("share", "low", "high", "share_1_1", "median_stretch", "verdict"):
            assert other[key] == first[key], key
    rows = folder / "rows.csv"
    ran = rocksteady(f"assess --spectrum {CODE} --records", suite, folder / "objects.csv",
                     "--csv", rows)  # fmt: skip
    assert ran.code == 0
    with rows.open(encoding="utf-8") as file:
        crate, other = sorted(csv.DictReader(file), key=lambda row: row["name"])
    assert float(crate["share"]) == first["share"]
    assert (crate["pga_g"], other["pga_g"]) == ("0.27", "0.3")
    assert crate["spectrum"] == "EN 1998-1:2004, 3.2.2.2 (type1:D:ag=0.2)"
    assert other["spectrum"] == ""


@every(
    ("flags", "words"),
    [
        (f"{BLOCK} --spectrum late.csv", "begins at 0.1 s; add its row at period 0, or state"),
        (f"{BLOCK} --spectrum {CODE} --damping 0.02", "--damping = [0.02] is not valid: formulas"),
        (f"assess file.toml --spectrum {CODE}", "file.toml states its own spectrum"),
        ("assess file.toml --no-stretch --records suite", "--no-stretch = True is not accepted"),
        (f"assess stated.csv --spectrum {CODE}", "all objects of stated.csv state a demand"),
    ],
)  # fmt: skip
def test_what_a_spectrum_does_not_go_with_is_refused(
    folder: Path, monkeypatch: pytest.MonkeyPatch, flags: str, words: str
) -> None:
    monkeypatch.chdir(folder)
    assert words in refused(flags)


def test_a_stated_peak_completes_a_spectrum_that_begins_late(folder: Path) -> None:
    for more in ((folder / "late.toml",), (folder / "plain.toml", "--pga-g", 0.27, "--spectrum",
                                           folder / "late.csv")):  # fmt: skip
        values = rocksteady("assess --json --motions 11", *more).json
        assert values["spectrum"]["pga_g"] == 0.27
        assert values["records"] == 11


def test_fragility_is_over_multiples_of_the_spectrum(folder: Path) -> None:
    """At its PGA the share of `assess`, of either level."""
    suite = folder / "suite"
    one = rocksteady(f"{BLOCK} --spectrum {CODE} --json --records", suite).json
    flags = f"fragility --width-m 0.2 --height-m 1 --spectrum {CODE} --levels 0.27,0.297 --json"
    many = rocksteady(f"{flags} --records", suite).json
    assert many["spectrum"] == one["spectrum"]
    shares = [row["share"] for row in many["shares"] if row["damage_state"] == "overturned"]
    assert shares == pytest.approx([one["share"], one["share_1_1"]])
