"""`--model nonlinear` of the commands that take it."""

from pathlib import Path

import pytest
from PIL import Image

from rocksteady import (
    Block,
    Harmonic,
    compute_basins,
    compute_erosion,
    find_attractor,
    find_orbits,
    simulate,
)
from rocksteady.cli.flags.parsing import axis
from rocksteady.model.equations import Nonlinear
from tests.cli.program import refused, rocksteady

SHAKEN = "simulate --alpha-rad 0.4 --p-rad-s 2 -A 2 -W 3 --cycles 6 --model nonlinear"


def test_its_json_is_that_of_the_library() -> None:
    values = rocksteady(f"{SHAKEN} --json").json
    run = simulate(
        Block.from_p(alpha=0.4, p=2.0),
        Harmonic(amplitude=2.0, frequency_ratio=3.0),
        cycles=6,
        model=Nonlinear(),
    )
    assert (values["model"], values["status"]) == ("nonlinear", run.status.label)
    assert (values["peak"], values["impacts"]) == (run.peak, len(run.impacts))
    assert rocksteady(f"{SHAKEN} --tolerance 1e-6 --json").json["peak"] == pytest.approx(
        run.peak, abs=1e-6
    )


@pytest.mark.slow
def test_it_is_drawn_filmed_and_written(tmp_path: Path) -> None:
    plot, film, table = (tmp_path / name for name in ("run.png", "run.gif", "run.csv"))
    ran = rocksteady(f"{SHAKEN} --plot {plot} --animate {film} --csv {table}")
    assert ran.code == 0
    with Image.open(plot) as picture:
        assert picture.size[0] > 100
    with Image.open(film) as moving:
        assert getattr(moving, "n_frames", 1) > 10
    assert len(table.read_text(encoding="utf-8").splitlines()) > 100


BLOCK = "--alpha-rad 0.4 --p-rad-s 2 -r 0.8 --model nonlinear"


def test_attractor_and_map_take_the_model(tmp_path: Path) -> None:
    plot = tmp_path / "orbit.png"
    found = rocksteady(f"attractor {BLOCK} -A 2 -W 4 --plot {plot} --json").json
    block = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)
    single = find_attractor(block, Harmonic(amplitude=2.0, frequency_ratio=4.0), model=Nonlinear())
    assert (found["model"], found["kind"]) == ("nonlinear", single.kind.value)
    assert found["peaks"] == list(single.peaks or ())
    assert plot.is_file()
    for flags in ("", "--fate"):
        values = rocksteady(f"map {BLOCK} -A 1:3:2 -W 4:5:2 {flags} --json").json
        assert (values["model"], values["cells"]) == ("nonlinear", 4)
    assert "slenderness" in refused("map -A 1:3:2 -W 4:5:2 -r 0.8 --model nonlinear")


BODY = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)


def test_a_steady_start_is_on_the_steady_state_of_the_model() -> None:
    start = "--start steady --cycles 20 --json"
    values = rocksteady(f"simulate {BLOCK} -A 2 -W 4 {start}").json
    settled = rocksteady(f"attractor {BLOCK} -A 2 -W 4 --json").json
    assert values["peak"] == pytest.approx(settled["peaks"][0], rel=1e-9)
    line = refused(
        f"simulate --alpha-rad 0.5 --p-rad-s 2 -r 0.8 -A 0.2366 -W 2 --model nonlinear {start}"
    )
    assert "--start" in line
    assert "there is none of order 1" in line


def test_orbits_take_the_model(tmp_path: Path) -> None:
    table, plot = tmp_path / "orbits.csv", tmp_path / "orbits.png"
    case = f"orbits {BLOCK} -A 2 -W 4 --max-period 1 --seeds 12"
    values = rocksteady(f"{case} --json --csv {table} --plot {plot}").json
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    found = find_orbits(BODY, shaking, max_period=1, seeds=12, model=Nonlinear())
    assert values["model"] == "nonlinear"
    assert [orbit["peaks"] for orbit in values["orbits"]] == [
        [orbit.highest, orbit.lowest] if orbit.admissible else None for orbit in found
    ]
    assert len(table.read_text(encoding="utf-8").splitlines()) == 1 + len(found)
    assert plot.is_file()
    text = rocksteady(f"{case} --more").out
    assert "nonlinear model" in text
    assert max(len(line) for line in text.splitlines()) <= 80
    assert "slenderness" in refused("orbits -A 2 -W 4 -r 0.8 --model nonlinear")


WINDOW = "--angles=-1:1:12 --velocities=-0.4:0.4:12"


def test_basins_take_the_model(tmp_path: Path) -> None:
    plot = tmp_path / "basins.png"
    values = rocksteady(f"basins {BLOCK} -A 2 -W 4 {WINDOW} --json --plot {plot}").json
    found = compute_basins(
        BODY,
        Harmonic(amplitude=2.0, frequency_ratio=4.0),
        angles=axis("", "-1:1:12"),
        velocities=axis("", "-0.4:0.4:12"),
        model=Nonlinear(),
    )
    assert values["model"] == "nonlinear"
    assert [part["states"] for part in values["fractions"]] == found.states.tolist()
    assert plot.is_file()
    line = refused("basins -A 2 -W 4 -r 0.8 --model nonlinear")
    assert "--model" in line
    assert "--alpha-rad" in line


def test_erosion_leaves_out_what_the_model_has_no_closed_form_of(tmp_path: Path) -> None:
    plot = tmp_path / "erosion.png"
    case = f"basins {BLOCK} -A 0.2:0.8:3 -W 2 {WINDOW} --cycles 20"
    values = rocksteady(f"{case} --json --plot {plot}").json
    found = compute_erosion(
        BODY,
        Harmonic(amplitude=1.0, frequency_ratio=2.0),
        axis("", "0.2:0.8:3"),
        angles=axis("", "-1:1:12"),
        velocities=axis("", "-0.4:0.4:12"),
        cycles=20,
        model=Nonlinear(),
    )
    assert values["model"] == "nonlinear"
    assert [row["safe_share"] for row in values["erosion"]] == found.safe_share.tolist()
    assert values["heteroclinic_amplitude"] is None
    assert values["heteroclinic_accel_g"] is None
    assert plot.is_file()
    text = rocksteady(f"{case} --more").out
    assert "no closed form in the nonlinear model" in text
    assert max(len(line) for line in text.splitlines()) <= 80
