"""`rocksteady assess` of the block of its flags: its contract, its exit codes, its refusals."""

from pathlib import Path

import pytest

from rocksteady import Block, assess_object
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.demand import PeakFlags, described_block, sized_block
from rocksteady.model.blocks.examples import SOURCES
from rocksteady.risk import DescribedObject
from tests.cli.motion_files import at2, samples
from tests.cli.program import ran_once, rocksteady
from tests.every import every

VASE = "assess --width-m 0.15 --height-m 0.45 --pga-g 0.4 --pgv-m-s 0.45"
STRONG = "assess --width-m 0.15 --height-m 0.45 --pga-g 0.8 --pgv-m-s 0.6"
CHEST = "assess --width-m 0.5 --height-m 0.9 --pga-g 0.3 --pgv-m-s 0.4"


@pytest.fixture(scope="module", name="folder")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Twelve records."""
    place = tmp_path_factory.mktemp("suite")
    for seed in range(1, 13):
        at2(place / f"G{seed}090.AT2", samples(seed), dt_s=0.01 * (1 + seed % 3))
    return place


def test_the_answer_is_that_of_an_object_file_to_the_bit() -> None:
    """One function counts, of flags, of a file and in Python."""
    ran = ran_once(f"{VASE} --json")
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    assert values["schema"] == "rocksteady/assess/1"
    described = DescribedObject(
        values={
            "name": "block",
            "geometry": {"width_m": 0.15, "height_m": 0.45},
            "demand": {"pga_g": 0.4, "pgv_m_s": 0.45},
        }
    )
    found = assess_object(described).to_dict()
    assert {**values, "seconds": 0} == {
        **found,
        "seconds": 0,
        "schema": values["schema"],
        "left_out": [],
    }
    assert (values["by"], values["runs"]) == ("built-in motions", 295)


@every(
    ("flags", "codes"),
    [
        (VASE, (0, 3)),  # not shown: built-in motions are never green
        (f"{VASE} --target 0.005", (0, 1)),  # red
        (f"{VASE} --friction 0.1", (0, 1)),  # slides
        (CHEST, (0, 0)),  # stands
        (f"{VASE} --vertical-g 0.1", (3, 3)),  # no built-in motion has a vertical
    ],
)
def test_exit_codes(flags: str, codes: tuple[int, int]) -> None:
    assert (ran_once(flags).code, rocksteady(f"{flags} --check").code) == codes


def test_records_stand_beside_the_flags_of_a_block(folder: Path) -> None:
    values = rocksteady(f"{STRONG} --json --records", folder).json
    assert (values["by"], values["records"], values["runs"]) == ("runs", 12, 60)
    one = rocksteady(f"{STRONG.replace('--pgv-m-s 0.6', '')} --json --records", folder).json
    assert (one["stretched"], one["largest_stretch"]) == (False, 1.0)
    plain = rocksteady(f"{STRONG} --no-stretch --json --records", folder)
    assert plain.json["share"] == one["share"]
    assert plain.json["stretched"] is False
    assert "0.6 m/s" not in plain.json["sentence"], "its records have other peaks"
    assert values["share"] != one["share"]


def test_few_and_far_records_are_no_answer(folder: Path) -> None:
    file = min(folder.iterdir())
    far = VASE.replace("--pga-g 0.4 --pgv-m-s 0.45", "--pga-g 9 --pgv-m-s 0.1")
    for flags, records, reason in ((VASE, file, "few-records"), (far, folder, "too-far")):
        ran = rocksteady(f"{flags} --json --records", records)
        assert (ran.code, ran.json["verdict"], ran.json["reason"]) == (3, "no-answer", reason)


BLOCKS = [
    {"width_m": "0.32", "height_m": "1.8"},
    {"width_m": "0.32", "height_m": "1.8", "restitution": "housner*0.965"},
    {"width_m": "0.6", "height_m": "1.8", "offset_m": 0.05, "mass_centre_height_m": 1.1},
    {"left_m": 0.1, "right_m": 0.2, "height_m": "1.8", "restitution": "0.9"},
    {"left_m": 0.1, "right_m": 0.2, "height_m": "1.8", "gyration_m": 0.5},
    {"alpha_rad": "0.2", "radius_m": "1.5", "gravity_m_s2": 1.62},
    {"alpha_rad": "0.2", "p_rad_s": "2"},
    *({"block": name} for name in SOURCES),
    {"block": "statue-on-plinth", "one_sided": True},
    {"block": "server-rack", "columns": 4, "cap_mass_ratio": 2.0},
    {"width_m": "0.3", "height_m": "3", "one_sided": True, "restitution": "0"},
    {"width_m": "1.6", "height_m": "9.6", "columns": 1, "cap_mass_ratio": 0.5},
    {"alpha_rad": "0.2", "p_rad_s": "2", "columns": 3, "cap_mass_ratio": 0.5},
]


@every("given", BLOCKS)
def test_any_block_of_the_flags_is_an_object_with_its_measures(given: dict[str, object]) -> None:
    flags = BlockFlags(**given)  # type: ignore[arg-type]
    block = sized_block(flags)
    made = described_block(flags, PeakFlags(pga_g=0.3, pgv_m_s=0.3)).block
    assert measures(made) == pytest.approx(measures(block), rel=1e-14)
    assert (made.symmetric, made.one_sided) == (block.symmetric, block.one_sided)
    assert (made.cap, made.gravity) == (block.cap, block.gravity)


def measures(block: Block) -> list[float]:
    """Return what the runs of a block depend on, and its height."""
    sides = [block.positive, block.negative]
    return [
        block.height,
        block.restitution,
        *(value for side in sides for value in (side.alpha, side.p, side.radius)),
        *(side.restitution for side in sides),
    ]
