"""Windows of overturning: published numbers, closed forms, a dense scan, invariants, bad input."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Pulse,
    Status,
    Store,
    find_overturning_windows,
    simulate,
)
from rocksteady.dynamics.overturning.thresholds import THRESHOLDS
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import overturning_amplitude
from rocksteady.model.equations import Linear
from rocksteady.overturning import OverturningWindows
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.9)


def only(found: OverturningWindows) -> list[tuple[float, float, int]]:
    """The windows at the only frequency: ends and impacts."""
    return [(window.low, window.high, window.impacts) for window in found.at(0)]


# ---------------------------------------------------------------------- published numbers


@every(
    ("w", "low", "high", "without"),
    [
        (2.0, 1.225179, 2.314403, 2.349903),  # Z3, Z1
        (3.0, 1.403565, 3.484663, 3.631150),
        (4.0, 1.795442, 4.850111, 5.238964),
        (5.0, 3.018600, 6.318071, 7.168129),  # Z2
        (6.0, 5.164159, 7.669873, 9.416966),
    ],
)
def test_z2_z3_the_windows_of_one_sine(w: float, low: float, high: float, without: float) -> None:
    first, second = only(find_overturning_windows(BLOCK, "one-sine", [w]))
    assert first == pytest.approx((low, high, 1), abs=5.1e-7)
    assert second == pytest.approx((without, 20.0, 0), abs=5.1e-7)


def test_z3_the_window_after_one_impact_vanishes() -> None:
    there, gone = (
        len(find_overturning_windows(BLOCK, "one-sine", [w]).at(0)) for w in (6.58, 6.59)
    )
    assert (there, gone) == (2, 1)


@pytest.mark.parametrize(
    ("shape", "accel_g"), [("one-sine", 0.451540), ("one-cosine", 0.595894)]
)  # M1, M2
def test_m1_m2_the_smallest_accelerations_of_a_block(shape: str, accel_g: float) -> None:
    block = Block.rectangle(width=1, height=3, restitution=0.85, gravity=9.81)
    pulse = Pulse.from_si(block, shape=shape, acceleration_m_s2=1.0, frequency_hz=1.0)
    found = find_overturning_windows(block, shape, [pulse.frequency_ratio], model=Linear())
    unit = block.uplift_acceleration / block.gravity
    assert found.first[0] * unit == pytest.approx(accel_g, abs=5.1e-7)


@pytest.mark.slow
@every("shape", THRESHOLDS)
def test_the_window_without_an_impact_begins_at_the_closed_form(shape: str) -> None:
    ratios = np.geomspace(0.3, 12.0, 9)
    expected = overturning_amplitude(shape, ratios)
    found = find_overturning_windows(BLOCK, shape, ratios, within=(1.0, 400.0))
    for index, a in enumerate(expected.tolist()):
        last = found.at(index)[-1]
        assert (last.impacts, last.side, last.endless) == (0, 1, True)
        assert last.low == pytest.approx(a, rel=1e-12)


# ---------------------------------------------------------------------- an independent scan


@pytest.mark.slow
@every(
    ("shape", "w", "restitution"),
    [
        ("one-sine", 1.0, 0.9),
        ("one-sine", 5.0, 0.95),
        ("one-cosine", 1.2, 0.9),
        ("one-cosine", 2.5, 0.8),
        ("type-c1", 2.0, 0.85),
        ("triangle", 2.0, 0.9),
        ("mavroeidis-papageorgiou", 3.0, 0.9),
    ],
)
def test_a_dense_scan_of_time_histories_finds_no_other_window(
    shape: str, w: float, restitution: float
) -> None:
    block = DimensionlessBlock(restitution=restitution)
    like = Pulse(shape=shape, amplitude=1.0, frequency_ratio=1.0, tolerance=1e-4)
    found = find_overturning_windows(block, like, [w], within=(1.0, 8.0))
    borders = {a for ends in found.intervals(0) for a in ends}
    spread = 1.0 + np.geomspace(1e-3, 7.0, 50 if "m" in shape[:1] else 900)
    # And the two sides of every border.
    close = [a * (1.0 + shift) for a in borders if 1.0 < a < 8.0 for shift in (-1e-8, 1e-8)]
    for a in [*spread.tolist(), *close]:
        pulse = Pulse(shape=shape, amplitude=a, frequency_ratio=w, tolerance=1e-4)
        run = simulate(block, pulse)
        inside = [window for window in found.at(0) if window.low <= a <= window.high]
        assert (run.status is Status.OVERTURNED) == bool(inside), a
        if inside and inside[0].impacts < 10:
            assert len(run.impacts) == inside[0].impacts
            assert np.sign(run(run.end_time_pt).angle) == inside[0].side


@every(("shape", "w"), [("one-sine", 0.5), ("one-cosine", 0.7), ("type-c1", 1.0)])
def test_a_coarse_and_a_fine_grid_find_the_same(shape: str, w: float) -> None:
    coarse, fine = (
        find_overturning_windows(BLOCK, shape, [w], resolution=step) for step in (0.01, 1e-4)
    )
    assert len(coarse.at(0)) == len(fine.at(0))
    np.testing.assert_allclose(coarse.low, fine.low, rtol=1e-12)
    np.testing.assert_allclose(coarse.high, fine.high, rtol=1e-12)


# ---------------------------------------------------------------------- invariants


def test_windows_ascend_and_windows_that_touch_differ() -> None:
    found = find_overturning_windows(BLOCK, "one-cosine", np.linspace(0.5, 3.0, 6))
    for index in range(6):
        windows = found.at(index)
        assert all(window.low < window.high for window in windows)
        for one, other in pairwise(windows):
            assert one.high <= other.low
            if one.high == other.low:
                assert (one.impacts, one.side) != (other.impacts, other.side)
        intervals = found.intervals(index)
        assert all(one[1] < other[0] for one, other in pairwise(intervals))
        assert found.first[index] == intervals[0][0]


def test_without_a_rebound_only_what_happens_in_the_pulse_overturns() -> None:
    # An impact that leaves next to nothing: the block starts anew, as from rest.
    found = find_overturning_windows(DimensionlessBlock(restitution=1e-9), "half-sine", [1.0, 4.0])
    for index in range(2):
        assert [window.impacts for window in found.at(index)] == [0]
    dead = find_overturning_windows(DimensionlessBlock(restitution=1e-9), "one-sine", [2.0])
    lively = find_overturning_windows(BLOCK, "one-sine", [2.0])
    assert dead.at(0)[-1].low == pytest.approx(lively.at(0)[-1].low, rel=1e-12)
    assert dead.first[0] > lively.first[0]


def test_the_range_cuts_windows_and_changes_nothing_else() -> None:
    whole = find_overturning_windows(BLOCK, "one-sine", [5.0])
    part = find_overturning_windows(BLOCK, "one-sine", [5.0], within=(4.0, 7.0))
    ((low, high, impacts),) = only(part)
    assert (low, impacts, part.at(0)[0].endless) == (4.0, 1, False)
    assert high == pytest.approx(whole.at(0)[0].high, rel=1e-14)
    cut = find_overturning_windows(BLOCK, "one-sine", [5.0], within=(4.0, high - 1e-3))
    assert [(each.high, each.endless) for each in cut.at(0)] == [(high - 1e-3, True)]
    below = find_overturning_windows(BLOCK, "one-sine", [5.0], within=(0.0, 0.9))
    assert below.at(0) == ()
    assert np.isnan(below.first[0])


def test_the_shape_alone_of_a_pulse_counts() -> None:
    named = find_overturning_windows(BLOCK, "one-sine", [2.0, 5.0])
    given = Pulse(shape="one-sine", amplitude=7.0, frequency_ratio=3.0)
    np.testing.assert_array_equal(find_overturning_windows(BLOCK, given, [2.0, 5.0]).low, named.low)
    block = Block.from_p(alpha=0.2, p=3.0, restitution=0.9)
    np.testing.assert_array_equal(
        find_overturning_windows(block, "one-sine", [2.0, 5.0], model=Linear()).low, named.low
    )


def test_of_very_many_windows_the_widest_are_kept_and_the_others_counted() -> None:
    found = find_overturning_windows(BLOCK, "type-c2", [0.7], resolution=0.01)
    assert len(found.at(0)) == 32
    assert found.left_out[0] > 0
    assert 0.0 < found.left_out_width[0] < 0.1
    stretches = found.unlisted(0)
    assert found.left_out_width[0] <= sum(high - low for low, high in stretches)
    (row,) = found.to_dict()["windows"]
    assert row["left_out_within"] == [list(ends) for ends in stretches]
    data = found.to_dataset()
    assert data.left_out_low.dims == ("frequency_ratio", "stretch")
    ends = np.stack([data.left_out_low[0], data.left_out_high[0]], axis=1)
    assert ends.tolist() == [list(pair) for pair in stretches]


@every("w", [0.7, 3.0])
@every("shape", ["one-sine", "one-cosine", "triangle"])
def test_without_loss_every_amplitude_is_decided(shape: str, w: float) -> None:
    # A block that has barely lifted bounces without end.
    found = find_overturning_windows(DimensionlessBlock(restitution=1.0), shape, [w])
    assert not found.undecided.any()
    nearly = find_overturning_windows(DimensionlessBlock(restitution=1.0 - 1e-9), shape, [w])
    wide = np.flatnonzero(found.high[0] - found.low[0] > 1e-3)
    assert wide.size
    np.testing.assert_allclose(
        found.low[0, wide], nearly.low[0, : len(found.low[0])][wide], rtol=1e-6
    )


def test_a_side_that_lifts_sooner_sets_the_range() -> None:
    block = DimensionlessBlock(restitution=0.9, alpha_ratio=0.5)
    found = find_overturning_windows(block, "one-sine", [1.0])
    assert found.within == (0.5, 20.0)
    assert 0.5 < found.first[0] < 1.0
    for a, status in (
        (found.first[0] * (1.0 + 1e-9), Status.OVERTURNED),
        (found.first[0] * (1.0 - 1e-9), Status.AT_REST),
    ):
        run = simulate(block, Pulse(shape="one-sine", amplitude=a, frequency_ratio=1.0))
        assert run.status is status


# ---------------------------------------------------------------------- sweeps


@pytest.mark.slow
@every("how", [Execution(workers=1), Execution(executor="serial"), Execution(workers=2)])
def test_every_executor_gives_the_same_bits(how: Execution, tmp_path: Path) -> None:
    ratios = np.linspace(1.0, 6.0, 7)
    expected = find_overturning_windows(BLOCK, "one-cosine", ratios).to_dataset()
    found = find_overturning_windows(BLOCK, "one-cosine", ratios, run=how).to_dataset()
    assert found.identical(expected)
    kept = find_overturning_windows(
        BLOCK, "one-cosine", ratios, run=replace(how, store=tmp_path / "windows.zarr")
    )
    assert kept.to_dataset().identical(expected)


def test_progress_is_told_by_frequency() -> None:
    told: list[int] = []
    find_overturning_windows(
        BLOCK, "half-sine", [1.0, 2.0, 3.0], run=Execution(progress=told.append)
    )
    assert told[0] == 0
    assert sum(told) == 3


def test_the_dataset_and_the_table_say_what_was_found() -> None:
    found = find_overturning_windows(BLOCK, "one-sine", [5.0, 8.0])
    data = found.to_dataset()
    assert data.sizes == {"frequency_ratio": 2, "window": 2, "stretch": 1}
    assert data.low.sel(frequency_ratio=8.0, window=0) == found.first[1]
    assert np.isnan(data.low.sel(frequency_ratio=8.0, window=1))
    assert (data.attrs["pulse"], data.attrs["model"]) == ("one-sine", "linear")
    assert ">7.16813</td>" in found._repr_html_()
    assert found.to_dataframe().low.tolist() == [
        window.low for k in (0, 1) for window in found.at(k)
    ]


# ---------------------------------------------------------------------- bad input


@every(
    ("arguments", "words"),
    [
        ({"pulse": "two-sine"}, "no pulse of that name"),
        ({"pulse": 3}, "a Pulse or the name"),
        ({"frequency_ratios": [2.0, 1.0]}, "ascend"),
        ({"frequency_ratios": [1.0, 1.0]}, "once"),
        ({"frequency_ratios": []}, "one or more"),
        ({"frequency_ratios": [0.001]}, "frequency_ratio"),
        ({"frequency_ratios": ["a"]}, "real numbers"),
        ({"within": (2.0, 1.0)}, "within"),
        ({"within": 3.0}, "pair"),
        ({"within": np.array(3.0)}, "pair"),
        ({"within": ((1.0, 2.0), 3.0)}, "within"),
        ({"within": (1.0, 1e9)}, "within"),
        ({"resolution": 0.0}, "resolution"),
        ({"resolution": 0.11}, "resolution"),
        ({"block": "stone"}, "Block"),
    ],
)
def test_bad_input_is_refused(arguments: dict[str, Any], words: str) -> None:
    given: dict[str, Any] = {"block": BLOCK, "pulse": "one-sine", "frequency_ratios": [1.0]}
    with pytest.raises(InputError, match=words):
        find_overturning_windows(**(given | arguments))


def test_oscillations_belong_to_one_pulse_alone() -> None:
    with pytest.raises(ModelError, match="has none"):
        Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=1.0, oscillations=3.0)


@pytest.mark.slow
def test_an_interrupted_search_keeps_most_of_its_frequencies(tmp_path: Path) -> None:
    ratios, passed = np.linspace(1.0, 5.0, 20), 0
    how: dict[str, Any] = {"resolution": 0.02}

    def stopped(cells: int) -> None:
        nonlocal passed
        passed += cells
        if passed >= 14:
            raise KeyboardInterrupt

    path = tmp_path / "windows.zarr"
    with pytest.raises(KeyboardInterrupt):
        find_overturning_windows(
            BLOCK,
            "one-sine",
            ratios,
            run=Execution(executor="serial", store=path, progress=stopped),
            **how,
        )
    told: list[int] = []
    store = Store(path, resume=True)
    found = find_overturning_windows(
        BLOCK, "one-sine", ratios, run=Execution(store=store, progress=told.append), **how
    )
    assert told[0] >= 8  # of chunks that are finished
    assert sum(told) == 20
    whole = find_overturning_windows(BLOCK, "one-sine", ratios, **how)
    assert np.array_equal(found.low, whole.low, equal_nan=True)
