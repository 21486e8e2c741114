"""One probability by one method, and no input that makes an object safer by an unknown sign."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.risk.assess._probability import onset_of
from rocksteady.risk.assess.assessment import assess_object
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.objects_table import assess_objects
from rocksteady.risk.assess.two_numbers import assess_by_formula
from rocksteady.risk.screens.demand import Demand
from rocksteady.risk.screens.friction import MODES
from rocksteady.risk.screens.screens import screen_block
from rocksteady.sweep.run import Execution

SUITE = make_synthetic_suite(3)
FEW = {"draws": 2, "levels": 4, "replicates": 0, "target_probability": 0.95}
CABINET = {"width_m": 0.32, "height_m": 1.8}
PEAKS = {"pga_g": 0.24, "pgv_m_s": 0.6}
GREENER = ("green", "amber", "red", "grey")


def described(name: str = "cabinet", **keys: Any) -> DescribedObject:
    values: dict[str, Any] = {"name": name, "friction": 0.9, "geometry": CABINET, "demand": PEAKS}
    return DescribedObject(values={**values, "assessment": FEW, **keys})


def never_falls(values: list[Any]) -> bool:
    return all(after >= before for before, after in pairwise(values))


@pytest.mark.usefixtures("no_remedies")
def test_vertical_motion_makes_the_cabinet_safer_by_no_door() -> None:
    """Of the file, the table, two numbers and the screens: it was 73 % and red, then green."""
    first: list[Any] = []
    for pga in (0.24, 0.15):
        shares, colours, uplifts, needs, counts = [], [], [], [], []
        for vertical in (0.0, 0.2, 0.4):
            demand = {"pga_g": pga, "pgv_m_s": 0.6, "vertical_g": vertical}
            cabinet = described(demand=demand)
            file = assess_object(cabinet, SUITE)
            (row,) = assess_objects([cabinet], SUITE, pga_g=pga, pgv_m_s=0.6).rows
            two = assess_by_formula(cabinet.block, pga, 0.6, 0.9, vertical_g=vertical)
            screens = screen_block(cabinet.block, Demand(**demand), friction=0.9)
            shares.append([file.probability, row["probability"], two.probability])
            colours.append([GREENER.index(each) for each in (file.colour, row["colour"])])
            lifts = [file.facts.uplift_pga_g, row["uplift_pga_g"], two.uplift_pga_g]
            lifts.append(screens.row("uplift").value)
            assert len({*lifts}) == 1  # one number for one idea
            uplifts.append(-lifts[0])
            need = [file.friction_needed, row["friction_needed"], two.friction_needed]
            need.append(screens.row("friction to rock").value)
            assert len({*need}) == 1
            needs.append(need[0])
            counts.append(sum(each.passes is False for each in screens.rows))
        for column in zip(*shares, strict=True):
            assert never_falls(list(column))
        for column in zip(*colours, strict=True):
            assert never_falls(list(column))
        assert never_falls(uplifts)
        assert never_falls(needs)
        assert never_falls(counts)
        assert shares[-1][0] > 0.5
        assert uplifts[-1] == pytest.approx(-0.6 * 0.32 / 1.8)
        first = shares[0]
    assert first == [0.0, 0.0, 0.0]  # 0.15 g alone does not lift it


def test_no_object_is_safer_for_more_of_what_drives_it_or_less_of_what_holds_it() -> None:
    """Of random objects: vertical motion, its share, PGA, PGV, friction and ranges, one by one."""
    rng = np.random.default_rng(20)
    for draw in range(15):
        height, slope = rng.uniform(0.5, 3.0), rng.uniform(0.05, 0.4)
        width = slope * height
        geometry = {"width_m": width, "height_m": height}
        geometry["offset_m"] = float(rng.uniform(-0.2, 0.2)) * width * (draw % 2)
        pga, pgv = slope * float(rng.uniform(0.5, 2.0)), float(rng.uniform(0.1, 1.5))
        base: dict[str, Any] = {
            "pga_g": pga, "pgv_m_s": pgv, "vertical_g": rng.uniform(0.0, 0.6),
            "vertical_share": rng.uniform(0.2, 1.0),
        }  # fmt: skip
        base = {key: float(value) for key, value in base.items()}
        friction = float(slope * rng.uniform(0.7, 2.5))
        ladders = {
            "vertical_g": [0.0, 0.2, 0.5, 0.9],
            "vertical_share": [0.0, 0.4, 1.0],
            "pga_g": [0.3 * slope, slope, 3.0 * slope],
            "pgv_m_s": [0.1, 0.4, 2.0],
            "friction": [3.0, 1.5 * slope, slope, 0.5 * slope],
            "range": [0.0, 0.05, 0.2],
            "offset_m": [0.0, 0.1 * width, 0.3 * width],
        }
        for key, values in ladders.items():
            ranks, shares, uplifts = [], [], []
            for value in values:
                demand, own, mu = dict(base), dict(geometry), friction
                if key in demand:
                    demand[key] = value
                elif key == "friction":
                    mu = value
                elif key == "range" and value:
                    low, high = width * (1.0 - value), width * (1.0 + value)
                    own |= {"width_m": {"low": low, "high": high}}  # type: ignore[dict-item]
                elif key == "offset_m":
                    own |= {key: value}
                thing = described(geometry=own, demand=demand, friction=mu)
                onset = onset_of(thing)
                assert onset.motion is not None
                ranks.append(MODES.index(onset.motion))
                two = assess_by_formula(thing.block, **demand)
                shares.append(two.probability)
                uplifts.append(-two.uplift_pga_g)
                mirrored = described(
                    geometry=own | {"offset_m": -own["offset_m"]}, demand=demand, friction=mu
                )
                again = onset_of(mirrored)
                assert again.motion == onset.motion
                assert again.friction_needed == pytest.approx(onset.friction_needed)
            # The ends of a range decide; of unlike sides a width between them may need most.
            if key != "range" or not geometry["offset_m"]:
                assert never_falls(ranks), (key, ranks)
            if key not in ("friction", "range"):
                assert never_falls(shares), (key, shares)
                assert never_falls(uplifts), (key, uplifts)


def test_the_mirror_image_and_the_reversed_records_have_the_same_probability() -> None:
    """Bits of the sides may differ in the last place: the runs are counted alike."""
    first = described(geometry={**CABINET, "offset_m": 0.03})
    second = described(geometry={**CABINET, "offset_m": -0.03})
    reverse = [record.reversed() for record in SUITE]
    rows = [
        assess_objects([each], suite, pga_g=0.24, pgv_m_s=0.6).rows[0]
        for each, suite in ((first, SUITE), (second, SUITE), (first, reverse))
    ]
    for row in rows[1:]:
        assert (row["fell"], row["lifted"]) == (rows[0]["fell"], rows[0]["lifted"])
        assert row["probability"] == pytest.approx(rows[0]["probability"], rel=1e-9)
    assert rows[0]["probability"] > 0.0


@pytest.mark.usefixtures("no_remedies")
def test_a_file_and_a_row_of_a_table_give_one_object_one_answer(tmp_path: Any) -> None:
    """To the bit, alone and among others, with a store and without."""
    objects = [
        described("cabinet"),
        described("band", restitution={"low": 0.8, "high": 0.9}),
        described("off centre", geometry={**CABINET, "offset_m": 0.04}),
        described("wall", against_wall=True, restitution=0.4),
        described("narrow", geometry={"width_m": 0.24, "height_m": 1.8}),
        described("smooth", friction=0.1),
        described("chest", geometry={"width_m": 0.9, "height_m": 1.8}),
        described("vertical", demand={**PEAKS, "vertical_g": 0.3, "vertical_share": 0.4}),
        described("few levels", assessment={**FEW, "levels": 2, "draws": 1}),
        described(
            "frame", geometry={**CABINET, "mass_kg": 50.0, "columns": 2, "cap_mass_ratio": 0.5}
        ),
        described("heavy", geometry={**CABINET, "mass_kg": 300.0}),
    ]
    run = Execution(store=tmp_path / "s.zarr")
    peaks: dict[str, Any] = {"pga_g": 0.24, "pgv_m_s": 0.6, "target_probability": 0.95}
    table = assess_objects(objects, SUITE, run=run, **peaks)
    assert (tmp_path / "s-2.zarr").is_dir()
    seen = set()
    for each, row in zip(objects, table.rows, strict=True):
        file = assess_object(each, SUITE)
        for key in (
            "probability",
            "by_curve",
            "basis",
            "method",
            "verdict",
            "colour",
            "friction_needed",
        ):
            assert getattr(file, key) == row[key], (each.name, key)
        assert file.facts.uplift_pga_g == row["uplift_pga_g"]
        for key, value in file.qualification.items():
            assert value == row[key], (each.name, key)
        forces = row["base_force_across_kn"], row["base_force_down_kn"]
        assert forces == (file.base_force_kn or (None, None)), each.name
        if file.cases:
            assert (file.cases[0].fell, file.cases[0].trials) == (row["fell"], row["tried"])
        seen.add((row["basis"], row["by_curve"] is None))
    (alone,) = assess_objects(objects[:1], SUITE, **peaks).rows
    assert alone == table.rows[0]
    by_runs = {("curve", False), ("count", False), ("count", True)}
    assert seen == by_runs | {("statics", True), (None, True)}
    assert "restitutions from" in table.rows[0]["method"]
    assert table.rows[-1]["base_force_down_kn"] > 0.9 * 9.81 * 0.3
    assert table.rows[-2]["base_force_down_kn"] > 0.9 * 9.81 * 0.15, "of columns and cap"


def test_progress_counts_the_runs_of_each_object_once() -> None:
    """A symmetric object is run with one sign, whatever stands beside it."""
    objects = [
        described("cabinet"),
        described("off centre", geometry={**CABINET, "offset_m": 0.04}),
    ]
    counted: list[int] = []
    peaks: dict[str, Any] = {**PEAKS}
    for asked in (objects[:1], objects[1:], objects):
        told: list[int] = []
        assess_objects(asked, SUITE, run=Execution(progress=told.append), **peaks)
        counted.append(sum(told))
    assert counted[0] + counted[1] == counted[2] == 1.5 * counted[1]


def test_where_all_slide_nothing_is_run_or_stored(tmp_path: Any) -> None:
    run = Execution(store=tmp_path / "s.zarr")
    table = assess_objects([described(friction=0.1)], SUITE, run=run, pga_g=0.4, pgv_m_s=0.4)
    assert [row["verdict"] for row in table.rows] == ["slides"]
    assert not [*tmp_path.iterdir()]


def test_a_range_whose_worse_end_lifts_does_not_stand() -> None:
    """Its middle is 0.178: a PGA of 0.17 g lifts it at the low end alone."""
    demand = {"pga_g": 0.17, "pgv_m_s": 0.6}
    assert onset_of(described(demand=demand)).motion == "rest"
    narrow = {"width_m": {"low": 0.26, "high": 0.38}, "height_m": 1.8}
    assert onset_of(described(demand=demand, geometry=narrow)).motion == "rocks"


def test_a_base_that_falls_as_fast_as_the_object_is_refused_with_its_key() -> None:
    with pytest.raises(InputError, match=r"\[demand\] vertical_g = 1\.2 .* below 1 g"):
        described(demand={**PEAKS, "vertical_g": 1.2})
    shared = described(demand={**PEAKS, "vertical_g": 1.2, "vertical_share": 0.4})
    assert shared.demand.vertical_at_peak_g == pytest.approx(0.48)
    with pytest.raises(InputError, match=r"vertical_g = -0\.2 .*without a sign"):
        described(demand={**PEAKS, "vertical_g": -0.2})
