"""Overturning scales: time histories, a published case, borders, symmetry, bad input."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    Execution,
    Linear,
    Nonlinear,
    Record,
    Status,
    find_overturning_scales,
    read_record,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import Model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.seismic.spectra import overturning_scales
from rocksteady.seismic.spectra.overturning_scales import RESOLUTION, OverturningScales
from tests.every import every
from tests.records import ABSENT, FOLDER
from tests.seismic.grounds import ground

BLOCK = Block.rectangle(width=0.4, height=1.6, restitution=0.85)
WALL = BLOCK.against_wall(0.5)
LEANING = Block.asymmetric(left=0.25, right=0.35, height=1.6, restitution=(0.9, 0.8))
SHOCK = Record(acceleration_m_s2=np.array([0.0, 4.0, -4.0, 0.0]), dt_s=0.3, name="shock")
RECORD = Record(
    acceleration_m_s2=ground(1).acceleration_m_s2, dt_s=3.0 * ground(1).dt_s, name="slow"
)
LIFTED = BaseMotion(RECORD, RECORD.scaled(0.3))
# Two cycles and a half, whose windows are few.
WAVE = Record(
    acceleration_m_s2=3.0 * np.sin(2.0 * math.pi * 0.05 * np.arange(51)), dt_s=0.04, name="wave"
)
PEER = FOLDER / "peer_at2"
MODELS = [Linear(), Nonlinear()]


def falls(block: Block, motion: Record | BaseMotion, scale: float, model: Model) -> bool:
    return simulate(block, motion.scaled(scale), model=model).status is Status.OVERTURNED


@every(
    ("block", "motion", "model", "top"),
    [
        (BLOCK, RECORD, Linear(), 2.0),
        (LEANING, RECORD.reversed(), Nonlinear(), 2.0),
        (LEANING, LIFTED, Nonlinear(), 2.0),
        (WALL, RECORD, Linear(), 2.0),
        (WALL, RECORD.reversed(), Nonlinear(), 2.0),
        (LEANING.against_wall(0.0), LIFTED, Nonlinear(), 4.0),
    ],
)
def test_time_histories_agree_with_the_windows(
    block: Block, motion: Record | BaseMotion, model: Model, top: float
) -> None:
    found = find_overturning_scales(block, motion, within=(0.2, top), model=model)
    assert found.top[0] == top
    widths = [math.log(high / low) for low, high in found.intervals(0)]
    # The widest 256 windows are listed, and the share is that of all.
    assert -1e-12 < found.share[0] - sum(widths) / math.log(top / 0.2) < 2e-3
    assert found.share[0] > 0.0
    scales = np.exp(np.random.default_rng(1).uniform(math.log(0.2), math.log(top), 30))
    fates = [falls(block, motion, scale, model) for scale in scales.tolist()]
    assert 0 < sum(fates) < len(fates)
    listed = [not unlisted(found, scale) for scale in scales.tolist()]
    assert sum(listed) > 20
    told = [found.falls(0, scale) for scale in scales[listed].tolist()]
    # The windows of so long a record have no end to their number: narrow ones are missed.
    assert int((np.array(told) != np.array(fates)[listed]).sum()) <= 1


def unlisted(found: OverturningScales, scale: float) -> bool:
    """Return whether windows are left out about a scale that is in none of those listed."""
    if any(low <= scale <= high for low, high in found.intervals(0)):
        return False
    stretches = zip(found.left_out_low[0], found.left_out_high[0], strict=True)
    return any(low <= scale <= high for low, high in stretches)


def test_what_is_left_out_of_the_list_is_not_taken_to_stand() -> None:
    found = find_overturning_scales(BLOCK, RECORD, within=(0.2, 2.0), model=Linear())
    (row,) = found.to_dict()["windows"]
    assert row["left_out"] == found.left_out[0] > 0
    stretches = row["left_out_within"]
    assert 0 < len(stretches) <= 64
    assert all(below[1] < above[0] for below, above in pairwise(stretches))
    assert found.left_out_width[0] <= sum(high - low for low, high in stretches)
    data = found.to_dataset()
    ends = np.stack([data.left_out_low[0], data.left_out_high[0]], axis=1)
    assert ends.tolist() == stretches
    places = [0.5 * (low + high) for low, high in stretches]
    hidden = next(place for place in places if unlisted(found, place))
    with pytest.raises(InputError, match="windows narrower than those listed are left out"):
        found.falls(0, hidden)
    assert found.falls(0, float(found.first[0]))
    drawn = found.plot().get_legend()
    assert drawn is not None
    assert "narrower windows, not listed" in [text.get_text() for text in drawn.get_texts()]
    assert {row["left_out"] for row in found.describe().tables[0].rows} == {found.left_out[0]}


@pytest.mark.slow
@every("motion", [WAVE, BaseMotion(WAVE, WAVE.scaled(0.2))])
@every("block", [BLOCK, LEANING, WALL])
def test_every_fate_under_a_short_motion_agrees(block: Block, motion: Record | BaseMotion) -> None:
    found = find_overturning_scales(block, motion, within=(0.5, 4.0))
    scales = np.geomspace(0.5, 4.0, 2001).tolist()
    fates = [falls(block, motion, scale, Nonlinear()) for scale in scales]
    assert 100 < sum(fates) < 1900
    assert [found.falls(0, scale) for scale in scales] == fates


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_borders_are_found_to_the_last_digits(model: Model) -> None:
    found = find_overturning_scales(BLOCK, WAVE, within=(0.5, 4.0), model=model)
    near = 1e-12 if isinstance(model, Linear) else 1e-9
    intervals = found.intervals(0)
    assert intervals
    for low, high in intervals:
        assert falls(BLOCK, WAVE, low * (1.0 + near), model)
        assert not falls(BLOCK, WAVE, low * (1.0 - near), model)
        if high < 4.0:
            assert falls(BLOCK, WAVE, high * (1.0 - near), model)
            assert not falls(BLOCK, WAVE, high * (1.0 + near), model)


def test_a_finer_search_may_try_more_amplitudes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(overturning_scales, "MOST", 200)
    left = [
        find_overturning_scales(
            BLOCK, RECORD, within=(1.0, 1.2), resolution=part * RESOLUTION, model=Linear()
        ).unsettled[0]
        for part in (1.0, 0.25)
    ]
    assert left[0] > 0
    assert left[1] == 0


@pytest.mark.parametrize("reverse", [False, True])
def test_the_side_is_that_on_which_it_falls(reverse: bool) -> None:
    motion = WAVE.reversed() if reverse else WAVE
    found = find_overturning_scales(LEANING, motion, within=(0.5, 4.0), model=Linear())
    assert found.at(0)
    for window in found.at(0):
        run = simulate(LEANING, motion.scaled(0.5 * (window.low + window.high)), model=Linear())
        assert np.sign(run(run.end_time_pt).angle) == window.side


def test_reversed_a_symmetric_block_falls_at_the_same_scales_on_the_other_side() -> None:
    found = find_overturning_scales(BLOCK, [WAVE, WAVE.reversed()], within=(0.5, 4.0))
    np.testing.assert_array_equal(found.low[0], found.low[1])
    np.testing.assert_array_equal(found.side[0], -found.side[1])


def test_against_a_wall_it_falls_to_the_free_side_and_the_reversed_record_is_another() -> None:
    found = find_overturning_scales(WALL, [WAVE, WAVE.reversed()], within=(0.5, 4.0))
    assert set(found.side[found.side != 0].tolist()) == {1}
    assert found.first[0] != found.first[1]
    # What never pushes it off the wall does not make it fall.
    push = Record(acceleration_m_s2=np.array([0.0, -9.0, -9.0, 0.0]), dt_s=0.3, name="push")
    assert np.isnan(find_overturning_scales(WALL, push, within=(0.5, 4.0)).first[0])
    assert np.isfinite(find_overturning_scales(WALL, push.reversed(), within=(0.5, 4.0)).first[0])


def test_twice_the_record_has_half_the_scales() -> None:
    found, double = (
        find_overturning_scales(BLOCK, record, within=within, model=Linear())
        for record, within in ((WAVE, (0.5, 4.0)), (WAVE.scaled(2.0), (0.25, 2.0)))
    )
    np.testing.assert_allclose(found.low, 2.0 * double.low, rtol=1e-12)
    assert double.pga_g[0] == pytest.approx(2.0 * found.pga_g[0])
    assert double.pgv_m_s[0] == pytest.approx(2.0 * found.pgv_m_s[0])


def test_a_scale_that_was_not_searched_is_refused() -> None:
    # Its vertical component ends the search of one record below that of the other.
    lifted = BaseMotion(WAVE, WAVE.scaled(2.0))
    found = find_overturning_scales(BLOCK, [WAVE, lifted], within=(0.2, 4.0))
    first, second = found.top.tolist()
    assert second < first == 4.0
    for row, top in enumerate((first, second)):
        for scale in (0.2, top):
            assert found.falls(row, scale) is found.falls(found.names[row], scale)
        for scale in (0.2 - 1e-9, top * (1.0 + 1e-9), math.inf, math.nan, -1.0):
            with pytest.raises(InputError, match=r"scale = .*\[0\.2, .*search further"):
                found.falls(row, scale)


def test_a_base_that_falls_away_ends_the_search() -> None:
    lifted = BaseMotion(WAVE, WAVE.scaled(0.3))
    found = find_overturning_scales(BLOCK, lifted, within=(0.2, 400.0))
    least = -0.3 * float(WAVE.acceleration_m_s2.min()) / 9.80665
    assert found.top[0] == pytest.approx(1.0 / least, rel=1e-8)
    assert simulate(BLOCK, lifted.scaled(found.top[0] * 0.999)).status is not Status.LOST_CONTACT
    assert "-g" in " ".join(found.describe().notes)


def test_a_weak_record_overturns_nothing() -> None:
    found = find_overturning_scales(BLOCK, SHOCK.scaled(1e-3))
    assert (found.intervals(0), found.share[0]) == ([], 0.0)
    assert math.isnan(found.first[0])
    assert "stands at all scales" in " ".join(found.describe().notes)


@pytest.mark.slow
def test_a_suite_is_its_records_and_workers_do_not_count() -> None:
    suite = [WAVE, SHOCK]
    both = find_overturning_scales(BLOCK, suite, within=(0.3, 3.0), run=Execution(workers=2))
    for place, record in enumerate(suite):
        alone = find_overturning_scales(
            BLOCK, record, within=(0.3, 3.0), run=Execution(executor="serial")
        )
        assert both.intervals(place) == alone.intervals(0)
        assert both.at(both.names[place]) == alone.at(0)
    frame = both.to_dataframe()
    assert frame["low_g"].to_numpy() == pytest.approx(
        frame["low"].to_numpy() * both.pga_g[[both.names.index(name) for name in frame["record"]]]
    )
    windows, records = both.describe().tables[:2]
    side = windows.columns[-1].text
    assert side is not None
    assert (side(1), side(-1)) == ("+", "-")
    # Of too many the lowest scales are shown, and records that fall before those that stand.
    one, two = ({"governing": least, "governs": "as given"} for least in (1.0, 2.0))
    order: list[tuple[dict[str, Any], dict[str, Any]]] = [
        ({"low": 1.0}, {"low": 2.0}),
        (one, two),
        (two, {"governs": ""}),
    ]
    for table, (first, then) in zip((windows, records, records), order, strict=True):
        severity = table.severity
        assert severity is not None
        assert severity(first) > severity(then)
    assert both.to_dataset()["first"].sel(record="shock") == both.first[1]


def test_what_is_refused() -> None:
    with pytest.raises(InputError, match="within"):
        find_overturning_scales(BLOCK, SHOCK, within=(2.0, 1.0))
    with pytest.raises(InputError, match="resolution"):
        find_overturning_scales(BLOCK, SHOCK, resolution=0.0)
    with pytest.raises(ModelError, match="vertical"):
        find_overturning_scales(BLOCK, LIFTED, model=Linear())


@pytest.mark.skipif(not PEER.exists(), reason=ABSENT)
def test_a_rack_under_pacoima_dam() -> None:
    # practice.md: .90 falls, .95 and 1.00 stand, 1.02 falls, 1.05 stands, 1.10 falls.
    rack = Block.rectangle(width=0.6, height=1.8)
    record = read_record(PEER / "RSN77_SFERN_PUL164-hor1.AT2")
    found = find_overturning_scales(rack, record, within=(0.85, 1.15), resolution=5e-4)
    fates = [found.falls(0, scale) for scale in (0.90, 0.95, 1.00, 1.02, 1.05, 1.10)]
    assert fates == [True, False, False, True, False, True]
