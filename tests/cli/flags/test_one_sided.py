"""A block against a wall on the command line: the flag, what is echoed, and refusals."""

import csv
from pathlib import Path

import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, State, Still, find_attractor, simulate
from tests.cli.program import rocksteady
from tests.every import every

FLAGS = "--width-m 0.3 --height-m 3 --one-sided"
FACADE = Block.rectangle(width=0.3, height=3.0).against_wall()


def test_simulate_echoes_the_wall() -> None:
    values = rocksteady(f"simulate {FLAGS} --accel-g 0.14 --freq-hz 1.5 --json").json
    shaking = Harmonic.from_si(FACADE, acceleration_m_s2=0.14 * 9.80665, frequency_hz=1.5)
    run = simulate(FACADE, shaking)
    assert values["status"] == run.status.label
    assert (values["peak"], values["impacts"]) == (run.peak, len(run.impacts))
    assert values["impacts"] > 0
    assert values["restitution"] == FACADE.restitution
    assert values["one_sided"] is True
    assert values["block"] == FACADE.to_dict()
    assert "negative_restitution" not in values


@every("ratio", ["0", "0.7", "1", "housner", "housner*0.9"])
def test_the_restitution_is_that_of_the_wall(ratio: str) -> None:
    form = {"housner": "housner", "housner*0.9": ("housner", 0.9)}
    block = FACADE.against_wall(form.get(ratio) or float(ratio))  # type: ignore[arg-type]
    start = "--start 0.4,0 --json"
    values = rocksteady(f"simulate {FLAGS} -r {ratio} {start}").json
    run = simulate(block, Still(), start=State(angle=0.4, velocity=0.0))
    assert (values["restitution"], values["rest_time_s"]) == (block.restitution, run.rest_time_s)
    if "housner" not in ratio:
        bare = rocksteady(f"simulate --one-sided -r {ratio} {start}").json
        other = simulate(
            DimensionlessBlock(restitution=float(ratio), one_sided=True),
            Still(),
            start=State(angle=0.4, velocity=0.0),
        )
        assert (bare["peak"], bare["rest_time_pt"]) == (other.peak, other.rest_time_pt)


def test_an_attractor_of_a_block_against_a_wall() -> None:
    values = rocksteady("attractor -r 0.5 --one-sided -A 1.3 -W 4 --json").json
    found = find_attractor(
        DimensionlessBlock(restitution=0.5, one_sided=True),
        Harmonic(amplitude=1.3, frequency_ratio=4.0),
    )
    assert values["kind"] == found.kind.value
    assert values["one_sided"] is True


@pytest.mark.slow
def test_tables_pictures_and_films_are_written(tmp_path: Path) -> None:
    files = {flag: tmp_path / f"run.{flag}" for flag in ("csv", "png", "gif")}
    shown = rocksteady(
        f"simulate {FLAGS} --pulse one-sine --accel-g 0.16 --freq-hz 1 --model nonlinear",
        *("--csv", files["csv"], "--plot", files["png"], "--animate", files["gif"]),
    )
    assert shown.code == 0
    assert "block against a wall" in shown.out
    assert "right edge" not in shown.out
    assert files["png"].read_bytes()[1:4] == b"PNG"
    assert files["gif"].read_bytes()[:3] == b"GIF"
    with files["csv"].open(newline="") as file:
        angles = [float(row["angle_per_alpha"]) for row in csv.DictReader(file)]
    assert max(angles) > 0.1
    assert min(angles) > -1e-12
