"""Objects at their demands: known shares and verdicts, and runs by an integrator of its own."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
import xarray

from rocksteady import BaseMotion, Block, Record, Status, run_ensemble
from rocksteady.formulas import Side
from rocksteady.motions import Floor, make_synthetic_suite
from rocksteady.risk import DescribedObject, RestitutionBand
from rocksteady.risk.assess import judging
from rocksteady.risk.assess.judging import Judged, band_of, judge_objects, onset_of, run_at_demand
from rocksteady.risk.assess.placed_objects import place_objects
from rocksteady.risk.counted.motions import Motion
from rocksteady.risk.counted.reach import lifting_levels
from rocksteady.risk.counted.suite import Peaks, Suite
from rocksteady.risk.counted.verdict import Decision, Target
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.screens.friction import needed_friction
from tests.dynamics.full_integrator import follow
from tests.risk.counted.recorded import G, described, judged, real_pairs, real_suite, the_floor
from tests.risk.counted.test_suite import peaks_of

SUITE = make_synthetic_suite(14, seed=3)

# ------------------------------------------------------------------------------ known answers


@dataclass(frozen=True, kw_only=True)
class Known:
    """An object, its demand, and what 56 records say of it: a value and its tolerance each."""

    width: float
    height: float
    verdict: str
    reason: str = ""
    demand: dict[str, Any]
    share: tuple[float, float] | None = None
    low: tuple[float, float] | None = None
    high: tuple[float, float] | None = None
    beyond: tuple[float, float] | None = None
    lifts_at: tuple[float, float] | None = None
    rate: tuple[float, float] | None = None
    width_needed: tuple[float, float] | None = None
    centre: float | None = None
    target: float = 0.1
    records: int = 56
    floor: bool = False

    @property
    def object(self) -> DescribedObject:
        shape = {} if self.centre is None else {"mass_centre_height_m": self.centre}
        return described(
            self.width, self.height, **self.demand, target=self.target, geometry=shape
        )  # fmt: skip


KNOWN = {
    "vase": Known(
        width=0.15, height=0.45, demand={"pga_g": 0.35, "pgv_m_s": 0.45}, verdict="green",
        share=(0.0, 0.004), high=(0.052, 0.002), beyond=(0.043, 0.02),
    ),
    "vase, stronger": Known(
        width=0.15, height=0.45, demand={"pga_g": 0.4, "pgv_m_s": 0.45}, verdict="not-shown",
        reason="band", share=(0.111, 0.02), low=(0.053, 0.015), high=(0.198, 0.02),
        beyond=(0.36, 0.03), width_needed=(0.165, 0.002),
    ),
    "vase, short pulses": Known(
        width=0.15, height=0.45, demand={"pga_g": 0.8, "pgv_m_s": 0.35}, verdict="red",
        share=(0.325, 0.02),
    ),
    "rack on a floor": Known(
        width=0.6, height=2.0, centre=0.95, demand={"pga_g": 0.3}, target=0.01, floor=True,
        verdict="red", share=(0.418, 0.02), low=(0.32, 0.02), high=(0.52, 0.02),
        lifts_at=(0.1421, 0.0003), rate=(1.04e-3, 0.05e-3),
    ),
    "low rack on a floor": Known(
        width=0.6, height=1.2, demand={"pga_g": 0.3}, target=0.01, floor=True,
        verdict="not-shown", reason="band", share=(0.0, 0.004), high=(0.052, 0.002),
        lifts_at=(0.2250, 0.0004), rate=(3.3e-4, 0.25e-4),
    ),
    "cabinet": Known(
        width=0.45, height=2.0, demand={"pga_g": 0.4}, target=0.05, verdict="red",
        share=(0.646, 0.02), width_needed=(0.699, 0.012),
    ),
    "bookcase, 28 records": Known(
        width=0.3, height=1.9, demand={"pga_g": 0.25, "pgv_m_s": 0.4}, records=28, verdict="red",
        share=(0.893, 0.03), low=(0.80, 0.02), high=(0.952, 0.02), lifts_at=(0.1579, 0.0002),
    ),
    "statue, 8 records": Known(
        width=0.6, height=1.8, demand={"pga_g": 0.5, "pgv_m_s": 0.5}, records=8,
        verdict="no-answer", reason="few-records",
    ),
    "chest": Known(
        width=0.5, height=1.0, demand={"pga_g": 0.1}, target=0.01, verdict="stands",
    ),
    "chest, 8 records": Known(
        width=0.5, height=1.0, demand={"pga_g": 0.1}, target=0.01, records=8, verdict="stands",
    ),
    "at the foot of a cliff": Known(
        width=0.32, height=1.8, demand={"pga_g": 0.196, "pgv_m_s": 0.307}, verdict="not-shown",
        reason="cliff", share=(0.018, 0.015), high=(0.082, 0.03), beyond=(0.307, 0.03),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", KNOWN)
def test_known_objects_have_their_shares_bands_and_verdicts(name: str) -> None:
    known = KNOWN[name]
    suite = real_suite()[: known.records]
    floor = the_floor() if known.floor else None
    found = judged(known.object, suite, floor=floor)
    assert found.decision == replace(found.decision, verdict=known.verdict, reason=known.reason)  # type: ignore[arg-type]
    if known.verdict == "stands":
        assert found.stands
        assert found.count is None
        return
    assert found.count is not None
    assert found.beyond is not None
    assert found.count.runs == 5 * known.records
    low, high = found.count.band
    for value, expected in (
        (found.count.share, known.share), (low, known.low), (high, known.high),
        (found.beyond.share, known.beyond),
    ):  # fmt: skip
        if expected is not None:
            assert value == pytest.approx(expected[0], abs=expected[1])
    if known.lifts_at is not None:
        motions = [*suite] if floor is None else [floor.motion(each) for each in suite]
        at = lifting_levels(Levels("pga_g", beside=()), [known.object.block], motions)
        assert at.min() == pytest.approx(known.lifts_at[0], abs=known.lifts_at[1])


# ----------------------------------------------------------------- against an own integrator

DRAWN = 20
ON = 12
"""Records of each object."""
PARTS = 4
"""Tests that share the objects."""


def sides_of(width: float, height: float, aside: float, ratio: float | None) -> tuple[Side, Side]:
    """Return both sides of a homogeneous rectangle whose mass centre lies aside, by mechanics.

    Without a ratio an impact keeps the angular momentum about the edge that strikes.
    """
    square = (width**2 + height**2) / 12.0
    h = 0.5 * height
    edges = (0.5 * width + aside, 0.5 * width - aside)
    sides = []
    for own, other in (edges, edges[::-1]):
        radius = math.hypot(own, h)
        kept = (square + h**2 - own * other) / (square + other**2 + h**2)
        sides.append(
            Side(
                alpha=math.atan2(own, h),
                radius=radius,
                p=math.sqrt(G * radius / (square + radius**2)),
                restitution=kept if ratio is None else ratio,
            )
        )
    return sides[0], sides[1]


def fate(record: Record, sides: tuple[Side, Side], sign: float) -> tuple[bool, float]:
    """Return whether a block falls under a record, by DOP853, and its largest theta/alpha."""
    values = [sign * each / G for each in record.acceleration_m_s2.tolist()]
    dt = record.dt_s
    end = dt * (len(values) - 1)

    def ground(t: float) -> float:
        if t > end:
            return 0.0
        k = min(int(t / dt), len(values) - 2)
        return float(values[k] + (t / dt - k) * (values[k + 1] - values[k]))

    breaks = (*(dt * np.arange(len(values))).tolist(), math.nextafter(end, 1e9), end + 20.0)
    seen = follow(ground, sides=sides, breaks=breaks, longest_step=0.05, slowest=1e-5)
    return seen.falls, seen.peak


@dataclass(frozen=True, kw_only=True)
class Drawn:
    """An object of the trial: its size, restitutions and demand."""

    width: float
    height: float
    aside: float
    restitution: Any
    peaks: Peaks
    draws: int

    @property
    def object(self) -> DescribedObject:
        return described(
            self.width,
            self.height,
            pga_g=self.peaks.pga_g,
            pgv_m_s=self.peaks.pgv_m_s,
            geometry={"offset_m": self.aside},
            restitution=self.restitution,
            assessment={"draws": self.draws},
        )

    def ratios(self) -> list[float | None]:
        """Return the restitutions of the draws; None for the block's own."""
        if isinstance(self.restitution, dict):
            return [self.restitution["low"], self.restitution["high"]][: self.draws]
        if isinstance(self.restitution, float):
            return [self.restitution]
        own = sides_of(self.width, self.height, self.aside, None)[0].restitution
        return [None, min(0.98, math.sqrt(own))][: self.draws]

    def shaken(self, record: Record) -> Record:
        """Return a record with the peaks of the demand, by its own peaks."""
        pga, pgv = peaks_of(record)
        if self.peaks.pga_g is None:
            return record.scaled((self.peaks.pgv_m_s or 0.0) / pgv)
        scale, stretch = self.peaks.pga_g / pga, 1.0
        if self.peaks.pgv_m_s is not None:
            stretch = self.peaks.pgv_m_s / (scale * pgv)
        return Record(
            acceleration_m_s2=scale * record.acceleration_m_s2, dt_s=stretch * record.dt_s
        )


def drawn_objects(seed: int = 11) -> list[Drawn]:
    """Return objects of .3 to 4 m, 2.5 to 7 times as high as wide, half of them unsymmetric."""
    random = np.random.default_rng(seed)
    objects = []
    for number in range(DRAWN):
        height = math.exp(random.uniform(math.log(0.3), math.log(4.0)))
        width = height / math.exp(random.uniform(math.log(2.5), math.log(7.0)))
        aside = 0.0 if number % 2 else float(random.uniform(-0.15, 0.15)) * width
        low = float(random.uniform(0.75, 0.9))
        bands: list[Any] = ["housner", low, {"low": low, "high": float(random.uniform(low, 0.97))}]
        slope = (0.5 * width - abs(aside)) / (0.5 * height)
        p = math.sqrt(0.75 * G / (0.5 * math.hypot(width, height)))
        pga = slope * float(random.uniform(1.1, 3.5))
        pgv = G * slope / p * float(random.uniform(0.5, 1.2))
        both = (Peaks(pga_g=pga, pgv_m_s=pgv), Peaks(pga_g=pga), Peaks(pgv_m_s=pgv))
        band = bands[int(random.integers(3))]
        draws = 2 if aside == 0.0 and not isinstance(band, float) else 1
        peaks = both[(0, 0, 1, 2)[number % 4]]
        objects.append(
            Drawn(width=width, height=height, aside=aside, restitution=band, peaks=peaks,
                  draws=draws)
        )  # fmt: skip
    return objects


@pytest.mark.slow
@pytest.mark.parametrize("part", range(PARTS))
def test_objects_drawn_at_random_fall_as_often_as_by_an_integrator_of_its_own(part: int) -> None:
    """Each run of 20 objects on 12 records; fates at the border, and no others, may differ."""
    suite = sorted(real_suite(), key=lambda each: (each.duration_s, each.name or ""))[::5][:ON]
    assert len(suite) == ON
    differ, runs, falls = [], 0, 0
    for number, each in [*enumerate(drawn_objects())][part::PARTS]:
        found = judged(each.object, suite)
        assert found.count is not None
        assert found.runs is not None
        status = found.runs["status"].isel(block=0, vertical=0)
        signs = (1.0,) if each.aside == 0.0 else (1.0, -1.0)
        assert found.count.ways == len(signs) * each.draws
        fell = np.zeros((ON, len(signs), each.draws), dtype=bool)
        for draw, ratio in enumerate(each.ratios()):
            sides = sides_of(each.width, each.height, each.aside, ratio)
            for row, record in enumerate(suite):
                shaken = each.shaken(record)
                for way, sign in enumerate(signs):
                    fell[row, way, draw], peak = fate(shaken, sides, sign)
                    code = int(status.isel(record=row, direction=way, draw=draw))
                    if fell[row, way, draw] != (code == Status.OVERTURNED):
                        differ.append((number, row, sign, draw, round(peak, 4), code))
        if not any(place == number for place, *_ in differ):
            assert found.count.fell.tolist() == fell.sum(axis=(1, 2)).tolist()
            assert found.count.share == pytest.approx(fell.mean(), abs=1e-12)
        runs += fell.size
        falls += int(fell.sum())
    print(f"{falls} of {runs} runs fall; other fates: {differ}")  # noqa: T201
    assert 0.1 * runs < falls < 0.9 * runs
    assert len(differ) <= 0.02 * runs


# ------------------------------------------------------------------------- order, statics, doubt


def same(one: Judged, other: Judged) -> None:
    """Hold two judgements to the last digit, but for the order of the records."""
    assert one.decision == other.decision
    assert (one.stands, one.lifted, one.friction) == (other.stands, other.lifted, other.friction)
    for first, second in ((one.count, other.count), (one.beyond, other.beyond),
                          (one.near, other.near), (one.plain, other.plain)):  # fmt: skip
        assert (first is None) == (second is None)
        if first is not None and second is not None:
            assert (first.share, first.band) == (second.share, second.band)
            assert (first.falls, first.runs) == (second.falls, second.runs)


@pytest.mark.parametrize("floor", [None, the_floor()], ids=["ground", "floor"])
def test_the_order_of_the_records_is_of_no_account(floor: Floor | None) -> None:
    random = np.random.default_rng(2)
    pairs = [BaseMotion(a, b.scaled(0.4)) for a, b in zip(SUITE, reversed(SUITE), strict=True)]
    objects = [
        described(0.15, 0.45, pga_g=0.4, pgv_m_s=0.35),
        described(0.4, 1.6, pga_g=0.5, geometry={"offset_m": 0.03}),
        described(0.4, 1.6, pgv_m_s=0.6, demand={"vertical_g": 0.2}),
    ]
    for each in objects:
        mixed: list[Motion] = [*pairs[:12], *SUITE[12:]]
        for motions in ([*SUITE], mixed):
            turned = [motions[k] for k in random.permutation(len(motions))]
            same(judged(each, motions, floor=floor), judged(each, turned, floor=floor))


def test_statics_decides_on_the_ground_alone_and_where_a_pga_is_given() -> None:
    """Up to its uplift of 0.25 g; the share at 1.1 times the demand is counted from there on."""
    calls: list[int] = []
    for pga, floor, stands, counted in (
        (0.22, None, True, False), (0.2272, None, True, False), (0.228, None, True, True),
        (0.2499, None, True, True), (0.2501, None, False, True), (0.1, the_floor(), False, True),
    ):  # fmt: skip
        found = judged(described(0.4, 1.6, pga_g=pga), SUITE, floor=floor)
        assert found.stands == stands, pga
        assert (found.count is not None) == counted, pga
        calls.append(found.lifted or 0)
    assert calls[:-1] == [0, 0, 0, 0, len(SUITE)]
    by_velocity = judged(described(0.4, 1.6, pgv_m_s=0.01), SUITE)
    assert not by_velocity.stands
    assert by_velocity.lifted == 0
    assert by_velocity.count is not None
    assert by_velocity.count.band[1] == pytest.approx(1.0 - 0.05 ** (1.0 / len(SUITE)))


def test_records_with_a_vertical_one_lift_it_below_its_uplift_and_are_counted() -> None:
    """Statics knows the peaks of the demand alone, and not those of the records' verticals."""
    lifted = [BaseMotion(each, each.scaled(-0.6)) for each in SUITE]
    found = judged(described(0.4, 1.6, pga_g=0.22), lifted)
    assert not found.stands
    # a > (g - 0.6 a) tan alpha to one side: from 0.217 g on, where its peak is on that side.
    driven = [each.acceleration_m_s2.max() / each.peak_acceleration_m_s2 for each in SUITE]
    assert found.lifted == sum(0.22 * part > 0.25 / 1.15 for part in driven)
    assert 0 < (found.lifted or 0) < len(SUITE)
    assert judged(described(0.4, 1.6, pga_g=0.22), SUITE).stands


def test_the_vertical_motion_in_its_worst_phase_takes_its_share_of_uplift_by_statics() -> None:
    """0.25 (1 - 0.4 x 0.2) = 0.23 g, without records of it."""
    vertical = {"vertical_g": 0.2, "vertical_share": 0.4}
    for pga, stands in ((0.2299, True), (0.2301, False)):
        found = judged(described(0.4, 1.6, pga_g=pga, demand=vertical), SUITE)
        assert found.stands == stands
    # Nor has it an answer then: no record has a vertical one.
    found = judged(described(0.4, 1.6, pga_g=0.2301, demand=vertical), SUITE)
    assert found.decision == Decision(verdict="no-answer", reason="few-vertical")
    assert found.count is None
    assert found.plain is not None
    assert found.plain.records == len(SUITE)


def test_of_a_demand_with_a_vertical_one_the_records_that_have_one_decide() -> None:
    pairs = [BaseMotion(a, b.scaled(0.4)) for a, b in zip(SUITE, reversed(SUITE), strict=True)]
    one = described(0.4, 1.6, pga_g=0.5, demand={"vertical_g": 0.2})
    few = judged(one, [*pairs[:10], *SUITE[10:]])
    assert few.decision == Decision(verdict="no-answer", reason="few-vertical")
    assert few.count is not None
    assert few.plain is not None
    assert (few.count.records, few.plain.records) == (10, len(SUITE))
    many = judged(one, pairs)
    assert many.count is not None
    assert many.decision.verdict != "no-answer"
    assert many.count.records == len(SUITE)
    # Its runs are those with the vertical component, the others those without.
    plain = judged(described(0.4, 1.6, pga_g=0.5), [*SUITE])
    assert plain.count is not None
    assert many.plain is not None
    assert many.plain.fell.tolist() == plain.count.fell.tolist()
    assert many.runs is not None
    assert many.runs["vertical"].values.tolist() == ["with"]


def test_what_slides_is_not_run(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    def run(blocks: list[Block], *_: object, **__: object) -> xarray.Dataset:
        asked.append(len(blocks))
        raise AssertionError

    monkeypatch.setattr(judging, "run_ensemble", run)
    smooth = described(0.4, 1.6, pga_g=0.5, friction=0.2)
    found = judged(smooth, SUITE)
    assert found.decision == Decision(verdict="slides")
    assert found.count is None
    assert asked == []
    # It lifts with 0.28, and slides as it does so: at 0.5 g it takes 0.31.
    both = judged(described(0.4, 1.6, pga_g=0.5, friction=0.28), SUITE)
    assert both.decision == Decision(verdict="slides")
    assert both.friction.largest == pytest.approx(0.3099, abs=1e-4)
    ranged = described(0.4, 1.6, pga_g=0.5, friction={"low": 0.2, "high": 2.0})  # type: ignore[arg-type]
    assert judged(ranged, SUITE).decision.verdict == "slides"


def test_the_friction_is_that_of_the_worst_end_of_every_range() -> None:
    ranged = described(
        0.4, 1.6, pga_g=0.4, pgv_m_s=0.4, geometry={"width_m": {"low": 0.3, "high": 0.5}}
    )
    need = judged(ranged, SUITE).friction.largest
    ends = [judged(described(w, 1.6, pga_g=0.4, pgv_m_s=0.4), SUITE) for w in (0.3, 0.4, 0.5)]
    assert need == pytest.approx(max(each.friction.largest for each in ends), rel=1e-12)
    # It stands where it does at both ends.
    low = described(0.4, 1.6, pga_g=0.2, geometry={"width_m": {"low": 0.3, "high": 0.5}})
    (shaking,) = place_objects([low], SUITE).shakings
    assert shaking is not None
    assert not onset_of(low, shaking).stands
    assert judged(described(0.4, 1.6, pga_g=0.2), SUITE).stands


def test_on_a_floor_the_friction_is_that_of_the_strongest_motion() -> None:
    one = described(0.4, 1.6, pga_g=0.4)
    scales = [0.4 * G / each.peak_acceleration_m_s2 for each in SUITE[:3]]
    floors = [the_floor().motion(each.scaled(k)) for each, k in zip(SUITE[:3], scales, strict=True)]
    peaks = [each.peak_acceleration_m_s2 / G for each in floors]
    least, need = (needed_friction(one.block, peak).largest for peak in (min(peaks), max(peaks)))
    found = judged(one, SUITE[:3], floor=the_floor())
    assert found.friction.largest == pytest.approx(need, rel=1e-9)
    between = described(0.4, 1.6, pga_g=0.4, friction=0.5 * (least + need))
    assert judged(between, SUITE[:3], floor=the_floor()).decision.verdict == "slides"


def test_records_that_are_hardly_stretched_are_counted_beside_the_answer() -> None:
    one = described(0.15, 0.45, pga_g=0.4, pgv_m_s=0.45)
    found = judged(one, real_suite())
    assert found.near is not None
    assert found.shaking is not None
    stretches = np.maximum(found.shaking.stretches, 1.0 / found.shaking.stretches)
    kept = [k for k, stretch in enumerate(stretches) if stretch < 2.0]
    alone = judged(one, [real_suite()[k] for k in kept])
    assert alone.count is not None
    assert found.near.records == len(kept) == 36
    assert found.near.share == alone.count.share
    assert found.near.share == pytest.approx(0.17, abs=0.02)
    assert judged(one, None).near is None
    assert judged(one, SUITE, stretch=False).near is None
    assert judged(described(0.15, 0.45, pga_g=0.4), SUITE).near is None


def test_what_stands_and_slides_is_decided_with_the_worst_ends_together() -> None:
    """At .31 g neither end alone lifts the middle of the other, but both together: .15/.5 g."""
    ranges: dict[str, Any] = {
        "width_m": {"low": 0.15, "high": 0.18}, "mass_centre_height_m": {"low": 0.2, "high": 0.25},
    }  # fmt: skip
    found = judged(described(0.165, 0.5, pga_g=0.31, geometry=ranges), SUITE)
    assert not found.stands
    assert found.uplift_g == pytest.approx(0.3, rel=1e-12)
    just = judged(described(0.5, 1.0, pga_g=0.4, friction=0.4), SUITE)
    assert just.decision.verdict == "stands"  # a need of .4 to the last bit is met by .4


def test_never_green_without_records_of_earthquakes_enough_of_them_or_friction() -> None:
    """Green on 56 records with a known friction, and not otherwise."""
    demand: dict[str, Any] = {"pga_g": 0.35, "pgv_m_s": 0.45}
    known, unknown = (described(0.15, 0.45, **demand, friction=mu) for mu in (1.0, None))
    assert judged(known, real_suite()).decision == Decision(verdict="green")
    for one, motions, verdict, reason in (
        (unknown, real_suite(), "not-shown", "friction"),
        (known, real_suite()[:10], "no-answer", "few-records"),
        (known, real_suite()[:28], "not-shown", "band"),
    ):
        found = judged(one, motions).decision
        assert (found.verdict, found.reason) == (verdict, reason)
    wide = described(0.2, 0.45, pga_g=0.46, pgv_m_s=0.3, target=0.2)
    for one, reason in ((wide, "built-in"), (known.with_target(Target(0.5)), "built-in")):
        found = judged(one, None).decision
        assert (found.verdict, found.reason) == ("not-shown", reason)


def test_far_records_are_no_answer_and_the_fold_is_the_larger_of_both() -> None:
    weak = [each.scaled(1e-2) for each in SUITE]
    found = judged(described(0.15, 0.45, pga_g=0.4, pgv_m_s=0.45), weak).decision
    assert found == Decision(verdict="no-answer", reason="too-far")
    for factor, doubts in ((0.5, ()), (0.02, ("far",))):
        pga = [each.peak_acceleration_m_s2 / G for each in SUITE]
        scaled = [each.scaled(0.4 * factor / a) for each, a in zip(SUITE, pga, strict=True)]
        fold = 1.0 / factor
        decision = judged(described(0.15, 0.45, pga_g=0.4), scaled).decision
        if fold > 30.0:
            assert decision.reason == "too-far"
        else:
            assert decision.doubts == doubts


# ---------------------------------------------------------------------------------- equal ones


def test_equal_blocks_at_one_demand_are_run_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[int, int]] = []

    def counted(blocks: list[Block], motions: list[Record], **how: Any) -> xarray.Dataset:
        asked.append((len(blocks), len(motions)))
        return run_ensemble(blocks, motions, **how)

    monkeypatch.setattr(judging, "run_ensemble", counted)
    demands: list[dict[str, Any]] = [{"pga_g": pga, "pgv_m_s": 0.45} for pga in (0.4, 0.5)]
    rows = [described(0.15, 0.45, **demands[k % 2]) for k in range(20)]
    rows += [described(0.18, 0.45, **demands[0]), described(0.15, 0.45, **demands[0], friction=0.5)]
    found = judge_objects(place_objects(rows, SUITE))
    assert asked == [(2, len(SUITE)), (1, len(SUITE))]  # two blocks at one demand, one at the other
    for place in range(2, 20):
        same(found[place], found[place % 2])
    for place, row in enumerate(rows):
        if place in (0, 1, 20, 21):
            same(found[place], judged(row, SUITE))


def test_what_differs_in_anything_that_runs_depend_on_is_run_by_itself() -> None:
    """Answers of a mixed list are those of each object alone."""
    rows = [
        described(0.3, 1.5, pga_g=0.4, pgv_m_s=0.45),
        described(0.3, 1.5, pga_g=0.4, pgv_m_s=0.45, restitution=0.9),
        described(0.3, 1.5, pga_g=0.4, pgv_m_s=0.45, restitution=0.8),
        described(0.3, 1.5, pga_g=0.4, pgv_m_s=0.45, restitution={"low": 0.8, "high": 0.9}),
        described(0.3, 1.5, pga_g=0.4, pgv_m_s=0.45, assessment={"draws": 2}),
        described(0.3, 1.5, pga_g=0.4, pgv_m_s=0.45, geometry={"offset_m": 0.02}),
        described(0.3, 1.5, pga_g=0.4, pgv_m_s=0.45, against_wall=True, restitution=0.4),
        described(0.3, 1.5, pga_g=0.4),
        described(0.3, 1.5, pgv_m_s=0.45),
        described(0.3, 1.5, pga_g=0.1),
        described(0.3, 1.5, pga_g=0.4, friction=0.1),
    ]
    whole = judge_objects(place_objects(rows, SUITE))
    for found, row in zip(whole, rows, strict=True):
        same(found, judged(row, SUITE))
    shares = [each.count.share for each in whole if each.count is not None]
    assert len(set(shares)) > 4


def test_runs_at_multiples_of_a_demand_are_those_of_records_so_scaled() -> None:
    """The share at 1.1 x the demand is that of another demand, 1.1 times both peaks."""
    at = described(0.15, 0.45, pga_g=0.4, pgv_m_s=0.45)
    more = described(0.15, 0.45, pga_g=1.1 * 0.4, pgv_m_s=1.1 * 0.45)
    for motions in (SUITE, real_pairs()):
        one, two = judged(at, motions), judged(more, motions)
        assert one.beyond is not None
        assert two.count is not None
        assert one.beyond.fell.tolist() == two.count.fell.tolist()
    shaking = Suite(motions=SUITE).at(Peaks(pga_g=0.4, pgv_m_s=0.45))
    (runs,) = run_at_demand([(at.block, shaking, RestitutionBand(draws=1))])
    assert runs.sizes["level"] == 1
    assert float(runs["level"][0]) == 0.4


def test_restitutions_are_those_of_the_file() -> None:
    usual = band_of(described(0.4, 1.6))
    assert usual == RestitutionBand(draws=5)
    assert band_of(described(0.4, 1.6, assessment={"draws": 3})) == RestitutionBand(draws=3)
    one = described(0.4, 1.6, restitution=0.9)
    assert band_of(one).ratios(one.block).tolist() == [[0.9, 0.9]]
    ranged = described(0.4, 1.6, restitution={"low": 0.8, "high": 0.9}, assessment={"draws": 3})
    assert band_of(ranged).ratios(ranged.block)[:, 0] == pytest.approx([0.8, 0.85, 0.9])
    factor = described(0.4, 1.6, restitution="housner*0.9")
    assert band_of(factor).ratios(factor.block).tolist() == [[factor.block.restitution] * 2]
