"""`rocksteady bifurcate` of the nonlinear model and of blocks whose sides differ."""

from typing import Any

import pytest

from rocksteady import Block, Harmonic, Nonlinear, find_orbits
from rocksteady.branches import follow_branch
from tests.cli.program import ran_once, refused, rocksteady


def values_of(command: str) -> dict[str, Any]:
    ran = ran_once(f"{command} --json")
    assert ran.code == 0, ran
    return ran.json


@pytest.mark.slow
def test_the_nonlinear_model_has_its_own_bifurcations() -> None:
    command = "bifurcate --alpha-rad 0.3 --radius-m 1 -r 0.8 -A 2 -W 1.5:2.4:4 --no-sweeps"
    straight, full = values_of(command), values_of(f"{command} --model nonlinear --cascade")
    assert (straight["model"], full["model"]) == ("linear", "nonlinear")
    assert full["cascade"]["ratios"][-1] == pytest.approx(4.669, abs=0.01)
    (here,), (there,) = (
        [point["frequency_ratio"] for point in found["points"] if "breaking" in point["type"]]
        for found in (straight, full)
    )
    assert here == pytest.approx(1.948377644, abs=1e-9)
    block = Block.from_radius(alpha=0.3, radius=1.0, restitution=0.8)
    origin = find_orbits(
        block, Harmonic(amplitude=2.0, frequency_ratio=2.2), max_period=1, model=Nonlinear()
    )[0]
    branch = follow_branch(origin, "frequency_ratio", (1.5, 2.4), direction=-1)
    breaking = next(point for point in branch if point.type == "symmetry-breaking")
    assert there == pytest.approx(breaking.frequency_ratio, abs=1e-10)
    told = rocksteady(f"{command} --model nonlinear --more").out
    assert "nonlinear model, alpha 0.3 rad" in " ".join(told.split())


@pytest.mark.slow
def test_a_block_with_sides_that_differ_has_branches() -> None:
    found = values_of(
        "bifurcate --left-m 0.15 --right-m 0.2 --height-m 1.2 -r 0.85 -A 2.2 -W 1.4:2.8:4 "
        "--no-sweeps"
    )
    assert {point["type"] for point in found["points"]} == {"fold", "period-doubling"}
    assert not any(branch["symmetric"] for branch in found["branches"])
    assert found["block"]["negative"]["alpha_rad"] != found["block"]["alpha_rad"]


@pytest.mark.slow
def test_harmonics_have_their_own_bifurcations() -> None:
    command = "bifurcate -r 0.8 -A 2 -W 1.7:2.4:4 --no-sweeps"
    plain = values_of(command)
    alone = values_of(f"{command} --harmonic 1,1,0")
    both = values_of(f"{command} --harmonic 1,1,0 --harmonic 2,0.3,0.5")
    assert "harmonics" not in plain
    assert both["harmonics"] == [[1, 1.0, 0.0], [2, 0.3, 0.5]]

    def breaking(values: dict[str, Any]) -> list[float]:
        return [
            point["frequency_ratio"] for point in values["points"] if "breaking" in point["type"]
        ]

    assert breaking(alone) == pytest.approx(breaking(plain), abs=1e-12)
    assert breaking(both) == []
    line = refused("bifurcate -r 0.8 -A 2 -W 2:2.4:4 --harmonic 2,1,0 --start steady")
    assert "a steady state needs harmonic shaking" in line
    assert "three numbers" in refused(f"{command} --harmonic 2,1")
