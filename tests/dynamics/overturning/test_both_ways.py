"""Windows of the reversed motion: simulations one by one, and searches of what is reversed."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Linear,
    Nonlinear,
    Pulse,
    Record,
    Status,
    find_fatal_kicks,
    find_overturning_scales,
    find_overturning_windows,
    simulate,
)
from rocksteady.dynamics.overturning.window_cells import follow
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.combine import scale
from rocksteady.motions import Floor, Impulses
from tests.every import every

UNEVEN = Block.asymmetric(left=0.22, right=0.16, height=1.5)
EVEN = Block.rectangle(width=0.38, height=1.5)
FLOOR = Floor(frequencies_hz=1.5, shapes=1.3)
SINE = Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=1.0)
SHOCKS = Record(
    acceleration_m_s2=3.0 * np.sin(np.linspace(0.0, 9.0, 91)) * np.linspace(1.0, 0.3, 91), dt_s=0.03
)

SHORT = Record(acceleration_m_s2=np.array([0.0, 4.0, -3.0, 0.0]), dt_s=0.3)


def drawn(seed: int) -> tuple[Block, float]:
    """Return an asymmetric block and a frequency ratio."""
    draw = np.random.default_rng(seed)
    height = draw.uniform(0.8, 2.5)
    left = height * draw.uniform(0.08, 0.2)
    right = left * math.exp(draw.uniform(-0.5, 0.5))
    kept = tuple(draw.uniform(0.75, 0.93, 2).tolist())
    block = Block.asymmetric(left=left, right=right, height=height, restitution=kept)
    return block, float(draw.uniform(1.0, 4.0))


def falls(block: Block, ratio: float, amplitude: float, model: Model, *, reverse: bool) -> bool:
    pulse = Pulse(shape="one-sine", amplitude=amplitude, frequency_ratio=ratio, reverse=reverse)
    return simulate(block, pulse, model=model).status is Status.OVERTURNED


@every("seed", range(10))
def test_a_pulse_fells_an_asymmetric_block_either_way_from_the_least_on(seed: int) -> None:
    block, ratio = drawn(seed)
    model: Model = Nonlinear() if seed % 2 else Linear()
    found = find_overturning_windows(block, "one-sine", [ratio], model=model)
    for reverse, least in ((False, found.first[0]), (True, found.opposite[0])):
        assert falls(block, ratio, least * (1.0 + 1e-9), model, reverse=reverse)
        tried = np.linspace(0.5 * found.within[0], least * (1.0 - 1e-9), 60).tolist()
        assert not any(falls(block, ratio, size, model, reverse=reverse) for size in tried)
    assert found.governing[0] == min(found.first[0], found.opposite[0])


@every("block", [UNEVEN, EVEN, UNEVEN.against_wall(0.6), EVEN.against_wall(0.6)])
@every("floor", [None, FLOOR])
def test_the_opposite_of_a_pulse_is_the_first_of_the_reversed(
    block: Block, floor: Floor | None
) -> None:
    ratios = [2.0, 3.0]
    ahead, back = (
        find_overturning_windows(
            block, replace(SINE, reverse=reverse), ratios, model=Linear(), floor=floor
        )
        for reverse in (False, True)
    )
    assert ahead.opposite == pytest.approx(back.first, rel=1e-9, nan_ok=True)
    assert back.opposite == pytest.approx(ahead.first, rel=1e-9, nan_ok=True)
    assert (ahead.opposite == ahead.first).all() == (block is EVEN)


def test_every_frequency_has_the_amplitude_of_the_direction_that_governs() -> None:
    block, ratios = DimensionlessBlock(restitution=0.8, negative_restitution=0.95), [2, 3, 4, 5, 6]
    pulses = [replace(SINE, reverse=reverse) for reverse in (False, True)]
    for within in ((1.0, 3.0), (1.5, 2.3)):  # in the second some stand as given
        ahead, back = (
            find_overturning_windows(block, pulse, ratios, within=within) for pulse in pulses
        )
        least = np.fmin(ahead.first, back.first)
        rows = ahead.to_dataframe().drop_duplicates("frequency_ratio")
        falls = ~np.isnan(least)
        assert rows.frequency_ratio.tolist() == np.array(ratios)[falls].tolist()
        assert rows.governing.to_numpy() == pytest.approx(least[falls], rel=1e-9)
        pairs = np.nan_to_num(np.stack([ahead.first, back.first]), nan=99.0).T[falls].tolist()
        words = {-1: "as given", 0: "either way", 1: "the other way"}
        assert rows.governs.tolist() == [words[int(np.sign(a - b))] for a, b in pairs]
        answer = " ".join(ahead.summary().split())
        assert f"It falls at {falls.sum()} of 5 frequencies" in answer
        order = np.argsort(least, kind="stable")[:3].tolist()
        shown = re.findall(r"W = (\d) falls (?:the other way )?(?:first )?at A = ([\d.]+)", answer)
        assert shown == [(str(ratios[row]), f"{least[row]:.3g}") for row in order]


def test_every_record_has_the_scale_of_the_direction_that_governs() -> None:
    records = [SHORT, SHORT.reversed(), SHOCKS.scaled(0.1)]
    ahead, back = (
        find_overturning_scales(UNEVEN, each, within=(0.2, 2.0), model=Linear())
        for each in (records, [record.reversed() for record in records])
    )
    least = np.fmin(ahead.first, back.first)
    rows = ahead.to_dict()["records"]
    falls = [row["governing"] for row in rows if row["governing"] is not None]
    assert falls == pytest.approx(least[~np.isnan(least)], rel=1e-9)
    assert sorted(row["governs"] for row in rows) == ["", "as given", "the other way"]
    answer = " ".join(ahead.summary().split())
    assert "It falls in 2 of 3 records" in answer
    assert "falls the other way first at" in answer


@pytest.mark.slow
def test_the_doubts_of_both_directions_count() -> None:
    """Neither a search nor that of what is reversed knows more than the other."""
    block = DimensionlessBlock(restitution=1.0, negative_restitution=0.99, alpha_ratio=0.7)
    ahead, back = (
        find_overturning_windows(
            block, replace(SINE, shape="type-c2", reverse=reverse), [0.7], within=(0.6, 1.2)
        )
        for reverse in (False, True)
    )
    assert (ahead.undecided, ahead.unsettled) == (back.undecided, back.unsettled)
    assert min(ahead.undecided[0], ahead.unsettled[0]) > 0
    assert "may be missing" in ahead.summary()


@every("block", [UNEVEN, EVEN, UNEVEN.against_wall(0.6)])
@every(
    ("motion", "model"),
    [(SHOCKS, Linear()), (BaseMotion(SHOCKS, SHOCKS.scaled(0.3)), Nonlinear())],
)
def test_the_opposite_of_a_record_is_the_first_of_the_reversed(
    block: Block, motion: Record | BaseMotion, model: Model
) -> None:
    within = 0.2, 2.0
    ahead, back = (
        find_overturning_scales(block, each, within=within, model=model)
        for each in (motion, motion.reversed())
    )
    assert ahead.opposite == pytest.approx(back.first, rel=1e-9, nan_ok=True)
    assert back.opposite == pytest.approx(ahead.first, rel=1e-9, nan_ok=True)
    assert np.array_equal(ahead.opposite, ahead.first, equal_nan=True) == (block is EVEN)


@every("motion", [None, Impulses(times=(0.4, 1.3), velocities=(0.3, -0.5))])
@every("block", [UNEVEN, EVEN, EVEN.against_wall(0.6)])
def test_the_least_kick_of_each_direction_is_that_of_a_fine_grid(
    block: Block, motion: Impulses | None
) -> None:
    kicks = find_fatal_kicks(block, motion=motion, times_pt=0.4, model=Linear())
    first = kicks.first.tolist()
    assert np.array_equal(kicks.opposite, first[::-1], equal_nan=True)
    given = [] if motion is None else list(zip(motion.times, motion.velocities, strict=True))
    for sign, least in zip((1.0, -1.0), first, strict=True):
        sizes = np.linspace(0.002, 4.0, 400)
        fates = []
        for size in sizes.tolist():
            jumps = {0.4: 0.0} | dict(given)
            jumps[0.4] += sign * size
            train = Impulses(times=tuple(jumps), velocities=tuple(jumps.values()))
            fates.append(simulate(block, train, model=Linear()).status is Status.OVERTURNED)
        if math.isnan(least):
            assert not any(fates)
        else:
            assert abs(sizes[fates.index(True)] - least) <= sizes[1] - sizes[0]


@every(("block", "ratio"), [(EVEN, 4.0), (UNEVEN, 2.0)])
def test_all_that_falls_on_a_floor_lies_in_a_window_or_is_left_out(
    block: Block, ratio: float
) -> None:
    found = find_overturning_windows(block, SINE, [ratio], model=Linear(), floor=FLOOR)
    moved = FLOOR.motion(replace(SINE, frequency_ratio=ratio), block)
    model, sizes = Linear(), np.geomspace(found.first[0], 5.0, 20_000)
    table = np.ascontiguousarray(segment_table(moved)[:-1])
    fell = sizes[follow(sizes, table=table, sides=model.sides(block)).overturns]
    spans = np.array(found.intervals(0)), np.array(found.unlisted(0))
    listed, left_out = (
        ((low <= fell[:, np.newaxis]) & (fell[:, np.newaxis] <= high)).any(axis=1)
        for low, high in (span.T for span in spans)
    )
    assert (listed | left_out).all()
    beside = fell[~listed].tolist()
    assert len(beside) > 4
    for size in beside[:10]:
        assert simulate(block, scale(moved, size), model=model).status is Status.OVERTURNED


def test_windows_on_a_floor_are_written_with_the_digits_that_are_right() -> None:
    found = find_overturning_windows(EVEN, SINE, [4.0], model=Linear(), floor=FLOOR)
    (row,) = found.to_dict()["windows"]
    ends = [*np.ravel(row["intervals"]), *np.ravel(row["intervals_g"]), row["first"]]
    assert all(float(f"{end:.4g}") == end for end in ends)
    scales = find_overturning_scales(EVEN, FLOOR.motion(SHOCKS), within=(0.1, 2.0), model=Linear())
    (record,) = scales.to_dict()["windows"]
    ends = [*np.ravel(record["intervals"]), *np.ravel(record["intervals_g"]), record["first"]]
    assert all(float(f"{end:.4g}") == end for end in ends)
    # Straight lines a hundred times as close move the first by less than the last digit.
    moved = FLOOR.motion(replace(SINE, frequency_ratio=4.0), EVEN, tolerance=1e-5)
    fates = [
        simulate(EVEN, scale(moved, row["first"] * part), model=Linear()).status
        for part in (1.0 - 5e-4, 1.0 + 5e-4)
    ]
    assert [fate is Status.OVERTURNED for fate in fates] == [False, True]


def test_every_answer_on_a_floor_says_down_to_which_width_it_searches() -> None:
    found = find_overturning_windows(
        EVEN, SINE, [4.0], model=Linear(), floor=FLOOR, within=(0.5, 2.0), resolution=0.01
    )
    records = FLOOR.motion(SHOCKS), SHOCKS
    floor, ground = (
        find_overturning_scales(EVEN, each, within=(0.1, 0.5), resolution=0.01, model=Linear())
        for each in records
    )
    for each, said in ((found, True), (floor, True), (ground, False)):
        quiet = replace(each, unsettled=0 * each.unsettled)
        text = " ".join(quiet.summary().split())
        assert ("ones narrower than 1 % may be missing" in text) is said
