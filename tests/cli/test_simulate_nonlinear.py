"""`--model nonlinear` of `rocksteady simulate`, `attractor` and `map`."""

from pathlib import Path

import pytest
from PIL import Image

from rocksteady import Block, Harmonic, attractor, simulate
from tests.cli.program import refused, rocksteady

SHAKEN = "simulate --alpha-rad 0.4 --p-rad-s 2 -A 2 -W 3 --cycles 6 --model nonlinear"


def test_its_json_is_that_of_the_library() -> None:
    values = rocksteady(f"{SHAKEN} --json").json
    run = simulate(
        Block.from_p(alpha=0.4, p=2.0),
        Harmonic(amplitude=2.0, frequency_ratio=3.0),
        cycles=6,
        model="nonlinear",
    )
    assert (values["model"], values["status"]) == ("nonlinear", run.status.label)
    assert (values["peak"], values["impacts"]) == (run.peak, len(run.impacts))
    assert rocksteady(f"{SHAKEN} --tolerance 1e-6 --json").json["peak"] == pytest.approx(
        run.peak, abs=1e-6
    )


def test_it_is_drawn_filmed_and_written(tmp_path: Path) -> None:
    plot, film, table = (tmp_path / name for name in ("run.png", "run.gif", "run.csv"))
    ran = rocksteady(f"{SHAKEN} --plot {plot} --animate {film} --csv {table}")
    assert ran.code == 0
    with Image.open(plot) as picture:
        assert picture.size[0] > 100
    with Image.open(film) as moving:
        assert getattr(moving, "n_frames", 1) > 10
    assert len(table.read_text(encoding="utf-8").splitlines()) > 100


def test_what_does_not_fit_is_one_line() -> None:
    assert "--model" in refused("simulate -A 2 -W 3 -r 0.8 --model quadratic")
    assert "slenderness" in refused("simulate -A 2 -W 3 -r 0.8 --model nonlinear")
    assert "--tolerance" in refused("simulate -A 2 -W 3 -r 0.8 --tolerance 1e-9")
    assert "--tolerance" in refused(f"{SHAKEN} --tolerance 1")


BLOCK = "--alpha-rad 0.4 --p-rad-s 2 -r 0.8 --model nonlinear"


def test_attractor_and_map_take_the_model(tmp_path: Path) -> None:
    plot = tmp_path / "orbit.png"
    found = rocksteady(f"attractor {BLOCK} -A 2 -W 4 --plot {plot} --json").json
    block = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)
    single = attractor(block, Harmonic(amplitude=2.0, frequency_ratio=4.0), model="nonlinear")
    assert (found["model"], found["kind"]) == ("nonlinear", single.kind.value)
    assert found["peaks"] == list(single.peaks or ())
    assert plot.is_file()
    for flags in ("", "--fate"):
        values = rocksteady(f"map {BLOCK} -A 1:3:2 -W 4:5:2 {flags} --json").json
        assert (values["model"], values["cells"]) == ("nonlinear", 4)
    assert "slenderness" in refused("map -A 1:3:2 -W 4:5:2 -r 0.8 --model nonlinear")
