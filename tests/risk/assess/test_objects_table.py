"""Tables of objects: each row against runs of its own, kinds run once, order, refusals."""

from dataclasses import replace
from typing import Any

import pytest
import xarray

from rocksteady import (
    BaseMotion,
    Block,
    Record,
    Status,
    assess_object,
    assess_objects,
    run_ensemble,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import DescribedObject, Peaks, RestitutionBand, Target
from rocksteady.risk.assess import judging
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.counted.verdict import VERDICTS
from rocksteady.seismic.spectra.many import simulate_many
from tests.risk.counted.recorded import described
from tests.risk.counted.test_suite import peaks_of

SUITE = make_synthetic_suite(12)
BOTH: dict[str, Any] = {"pga_g": 0.4, "pgv_m_s": 0.45}
PEAKS = Peaks(**BOTH)
TWO = {"assessment": {"draws": 2}}
SIZES = {f"object {b} {h}": (b, h) for b in (0.2, 0.3, 0.4, 0.5) for h in (1.2, 1.6, 2.0)}


def one(name: str, width: float, height: float, **keys: Any) -> DescribedObject:
    return described(width, height, **{**TWO, "name": name, **keys})


def objects() -> list[DescribedObject]:
    plain = [
        replace(one(name, b, h), extra={"room": "4", "name": "again"})
        for name, (b, h) in SIZES.items()
    ]
    return [
        *plain,
        one("off centre", 0.4, 1.6, geometry={"offset_m": 0.05}),
        one("smooth", 0.3, 1.8, friction=0.1),
        one("chest", 1.0, 1.2),
        one("heavy", 0.45, 1.6, geometry={"mass_kg": 120.0}),
        one("its own", 0.5, 1.6, demand={"pga_g": 0.5}),
    ]


@pytest.fixture(scope="module", name="table")
def _table() -> ObjectsTable:
    return assess_objects(objects(), SUITE, demand=PEAKS)


def shaken(record: Record) -> Record:
    """Return a record with both peaks of the demand."""
    pga, pgv = peaks_of(record)
    scale = 0.4 / pga
    return Record(
        acceleration_m_s2=scale * record.acceleration_m_s2,
        dt_s=0.45 / pgv / scale * record.dt_s,
    )


def test_each_row_counts_what_runs_of_its_own_do(table: ObjectsTable) -> None:
    rows = {row["name"]: row for row in table.rows}
    fallen = 0
    for each in [*objects()[:12:2], objects()[12]]:
        signs = [False] if each.block.symmetric else [False, True]
        statuses = [
            int(simulate_many(body, shaken(record), scales=1.0, reverse=sign)["status"])
            for body in map(
                each.block.with_restitution,
                map(tuple, RestitutionBand(draws=2).ratios(each.block).tolist()),
            )
            for sign in signs
            for record in SUITE
        ]
        row = rows[each.name]
        if row["by"] == "statics":
            assert statuses.count(Status.OVERTURNED) == 0
            continue
        assert row["runs"] == 2 * len(SUITE) * len(signs)
        assert row["fall"] == statuses.count(Status.OVERTURNED), each.name
        fallen += row["fall"]
    assert fallen > 5


def test_each_row_is_the_assessment_of_its_object_alone(table: ObjectsTable) -> None:
    helped = 0
    for each, row in zip(objects()[::3] + objects()[12:], [*table.rows[::3], *table.rows[12:]],
                         strict=False):  # fmt: skip
        own = each if each.given.demand.pga_g is not None else each.with_peaks(**BOTH)
        found = assess_object(own, SUITE)
        values = found.to_dict()
        assert row["name"] == found.described.name
        assert (row["share"], row["verdict"]) == (found.share, found.verdict)
        for key in ("low", "high", "share_1_1", "fall", "runs", "records", "lifted", "by", "reason",
                    "share_near", "records_near", "friction_needed", "median_stretch"):  # fmt: skip
            assert row[key] == values[key], (row["name"], key)
        for key, value in (values["qualification"] or {}).items():
            assert row[key] == value
        for remedy in found.remedies:
            key = remedy.change.replace(" ", "_")
            changes = (row[f"{key}_m"], row[f"{key}_shown_m"])
            if changes != (None, None):  # one of the worst kinds
                assert changes == (remedy.value, remedy.shown_at)
                helped += 1
        force = (row["base_force_across_kn"], row["base_force_down_kn"])
        expected = found.base_force_kn
        assert force == ((None, None) if expected is None else pytest.approx(expected, rel=1e-14))
    assert helped > 2
    rows = {row["name"]: row for row in table.rows}
    assert rows["heavy"]["base_force_across_kn"] > 0.0
    assert rows["smooth"]["verdict"] == "slides"
    assert rows["smooth"]["share"] is None
    assert (rows["chest"]["verdict"], rows["chest"]["share"]) == ("stands", 0.0)
    assert (rows["its own"]["pga_g"], rows["its own"]["pgv_m_s"]) == (0.5, None)


# --------------------------------------------------------------------------- kinds, run once


def test_a_row_that_is_repeated_is_run_once_and_has_the_same_answer(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    cells: list[int] = []

    def counted(*given: Any, **how: Any) -> xarray.Dataset:
        found = run_ensemble(*given, **how)
        cells.append(int(found["status"].size))
        return found

    monkeypatch.setattr(judging, "run_ensemble", counted)
    rows = [one("rack", 0.3, 1.6), one("shelf", 0.25, 1.5)]
    single = assess_objects(rows, SUITE, demand=PEAKS)
    once, cells[:] = list(cells), []
    twenty = assess_objects(rows[:1] * 20 + rows[1:], SUITE, demand=PEAKS)
    assert cells == once
    assert len(twenty.rows) == 21
    for row in twenty.rows[:20]:
        assert row == single.rows[0]
    assert twenty.rows[20] == single.rows[1]
    assert [(row["name"], count) for row, count in twenty.kinds] == sorted(
        [("rack", 20), ("shelf", 1)],
        key=lambda kind: -(single.rows[kind[0] == "shelf"]["share"] or 0.0),
    )


def test_objects_of_other_names_and_columns_are_of_one_kind_and_of_other_runs_are_not() -> None:
    base: dict[str, Any] = {}
    changes: list[dict[str, Any]] = [
        base, {"kind": "cabinet"}, {"friction": 0.4}, {"restitution": 0.8},
        {"geometry": {"offset_m": 0.01}}, {"demand": {"pga_g": 0.41, "pgv_m_s": 0.45}},
        {"assessment": {"draws": 3}}, {"against_wall": True, "restitution": 0.4},
    ]  # fmt: skip
    rows = [one(f"{k}", 0.3, 1.6, **keys) for k, keys in enumerate(changes)]
    table = assess_objects(rows, SUITE, demand=PEAKS)
    assert [row["like"] for row in table.rows] == [0, 0, 1, 2, 3, 4, 5, 6]
    assert sum(count for _, count in table.kinds) == len(rows)
    assert {row["name"] for row, _ in table.kinds} == set("02345678"[: len(rows) - 1])  # the first


def test_objects_that_differ_in_their_vertical_motion_are_two_kinds() -> None:
    """One stands by statics, the other does not, whether the records have a vertical or none."""
    pairs = [BaseMotion(each, each.scaled(0.2)) for each in SUITE]
    rows = [
        one(f"{up:g}", 0.4, 1.6, demand={"pga_g": 0.23, "pgv_m_s": 0.45, "vertical_g": up})
        for up in (0.05, 0.3, 0.05)
    ]
    for motions in ([*SUITE], pairs):
        table = assess_objects(rows, motions)
        needs = [row["friction_needed"] for row in table.rows]
        assert needs[0] == needs[2] < needs[1]
        assert [row["like"] for row in table.rows] == [0, 1, 0]
        assert [count for _, count in table.kinds] in ([1, 2], [2, 1])


# ------------------------------------------------------------------------------- order and codes


def test_the_worst_rows_come_first_and_of_a_verdict_the_highest_share(table: ObjectsTable) -> None:
    keys = [(VERDICTS.index(row["verdict"]), -(row["share"] or 0.0)) for row in table.worst]
    assert keys == sorted(keys)
    assert {row["verdict"] for row in table.rows} >= {"red", "slides", "stands"}
    values = table.to_dict()
    assert [row["name"] for row in values["objects"]] == [row["name"] for row in table.worst]
    assert sum(values["verdicts"].values()) == len(table.rows)
    assert list(values["verdicts"]) == [each for each in VERDICTS if each in values["verdicts"]]
    assert [row["name"] for row in table.rows] == [each.name for each in objects()]


def test_rows_are_sorted_by_any_column_and_those_without_a_value_are_last(
    table: ObjectsTable,
) -> None:
    ranked = table.sorted_by("share")
    shares = [row["share"] for row in ranked]
    assert shares[-1] is None
    assert shares[:-1] == sorted(shares[:-1], reverse=True)
    names = [row["name"] for row in table.sorted_by("name", descending=False)]
    assert names == sorted(names)
    assert len(names) == len(table.rows)
    with pytest.raises(InputError, match="columns are name, kind"):
        table.sorted_by("colours")


def test_further_columns_are_kept_and_overwrite_none(table: ObjectsTable) -> None:
    first = table.rows[0]
    assert first["room"] == "4"
    assert first["name"] == "object 0.2 1.2"
    assert first["name (given)"] == "again"


# --------------------------------------------------------------------------------- demands


def test_an_acceleration_alone_counts() -> None:
    block = Block.rectangle(width=0.3, height=1.6)
    (row,) = assess_objects(
        [one("x", 0.3, 1.6, assessment={"draws": 1})], SUITE, demand=Peaks(pga_g=0.6)
    ).rows
    found = simulate_many(block, SUITE, pga_g=0.6)
    assert row["fall"] == int((found["status"] == Status.OVERTURNED).sum())
    assert "at 0.6 g:" in row["sentence"]
    assert row["share_near"] is None


def test_the_target_is_that_of_the_table() -> None:
    rows = [one("x", 0.3, 1.6, target=0.3), one("x", 0.3, 1.6, target=0.01)]
    for target, verdict in ((0.01, "red"), (0.999, "green")):
        table = assess_objects(rows, SUITE, demand=PEAKS, target=target)
        assert table.target == Target(target)
        assert [row["verdict"] for row in table.rows] == [verdict] * 2
        assert [row["like"] for row in table.rows] == [0, 0]
    for end in (0.0, 1.0):
        with pytest.raises(InputError, match="target"):
            assess_objects(rows, SUITE, demand=PEAKS, target=end)


def test_without_records_motions_are_built_in_and_nothing_is_green() -> None:
    table = assess_objects([one("wide", 0.62, 1.6), one("slim", 0.2, 1.6)], demand=PEAKS)
    assert table.suite.built_in
    assert table.records == 59
    assert [row["by"] for row in table.rows] == ["built-in motions"] * 2
    assert "green" not in table.verdicts
    assert "on built-in motions" in table.summary().replace("\n", " ")
    with pytest.raises(ModelError, match="built-in motions are made of both peaks"):
        assess_objects([one("wide", 0.62, 1.6)], demand=Peaks(pga_g=0.4))
