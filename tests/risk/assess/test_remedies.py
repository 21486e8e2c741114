"""Remedies: against a slow scan of edited objects, and what ends or forbids a scan."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from rocksteady import Record, assess_object
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import DescribedObject, Target
from rocksteady.risk.assess._remedies import (
    FINER,
    WIDER,
    WIDEST,
    _Change,
    _remedy,
    _Tried,
    is_helped,
    remedies_of,
)
from rocksteady.risk.assess.judging import Judged, judge_objects
from rocksteady.risk.assess.placed_objects import place_objects
from rocksteady.risk.assess.remedy import Remedy
from rocksteady.words._object_sentences import change_words, remedy_warning
from tests.every import every
from tests.risk.assess.test_judging import KNOWN
from tests.risk.counted.recorded import Floats, described, judged, real_suite

SUITE = make_synthetic_suite(14, seed=3)
WIDTH, HEIGHT, TARGET = 0.36, 1.8, 0.25


def statue(width: float = WIDTH, centre: float = 0.5 * HEIGHT, **keys: Any) -> DescribedObject:
    usual: dict[str, Any] = {
        "pga_g": 0.4, "pgv_m_s": 0.45, "target": TARGET, "assessment": {"draws": 2},
        "geometry": {"mass_centre_height_m": centre},
    }  # fmt: skip
    return described(width, HEIGHT, **{**usual, **keys})


def changes_of(
    objects: Sequence[DescribedObject], motions: Sequence[Record] = SUITE
) -> list[tuple[Remedy, ...]]:
    """Return the remedies of objects, in one batch."""
    placed = place_objects(objects, motions)
    pairs = zip(placed.objects, placed.shakings, strict=True)
    return remedies_of([(each, shaking) for each, shaking in pairs if shaking is not None])


def shares_of(judgement: Judged) -> tuple[float, float]:
    """Return the shares at the demand and at 1.1 times it; none of what nothing lifts."""
    count, beyond = judgement.count, judgement.beyond
    at_demand = 0.0 if count is None or judgement.stands else count.share
    return at_demand, 0.0 if beyond is None else beyond.share


def printed(value: float) -> float:
    """Return a length with three digits."""
    return float(f"{value:.3g}")


def is_shown(judgement: Judged) -> bool:
    """Whether a verdict is safe, and the interval at 1.1 times the demand below the target."""
    beyond = judgement.beyond
    safe = judgement.decision.verdict in ("green", "stands")
    return safe and (beyond is None or beyond.band[1] < TARGET)


@every(
    ("change", "edited", "exact"),
    [
        (0, statue, WIDTH * WIDER ** np.arange(41)),
        (1, lambda by: statue(centre=0.5 * HEIGHT - by), 0.02 * np.arange(23)),
    ],
)
def test_a_remedy_is_that_of_a_slow_scan_of_edited_objects(
    change: int, edited: Callable[[float], DescribedObject], exact: Floats
) -> None:
    """From each value on all that are scanned pass, and the one a step of eight parts below not."""
    remedy = changes_of([statue()])[0][change]
    values = np.array([printed(each) for each in exact])
    assert remedy.value is not None
    assert remedy.shown_at is not None
    assert values[0] < remedy.value < remedy.shown_at < values[-1]
    assert shares_of(judged(edited(remedy.value), SUITE)) == (remedy.share, remedy.share_1_1)
    assert remedy.last == pytest.approx(values[-1], rel=1e-12)
    for value, passes in (
        (remedy.value, lambda each: max(shares_of(each)) <= TARGET),
        (remedy.shown_at, is_shown),
    ):
        above = int(np.searchsorted(values, value * (1.0 - 1e-12)))
        parts = np.linspace(values[above - 1], values[above], FINER + 1).tolist()
        before = max(each for each in map(printed, parts) if each < value)
        scanned = [before, value, *values[above:]]
        placed = place_objects([edited(float(each)) for each in scanned], SUITE)
        assert [*map(passes, judge_objects(placed))] == [False] + [True] * (len(scanned) - 1)


@every("name", [name for name, known in KNOWN.items() if known.width_needed is not None])
def test_known_objects_need_their_widths(name: str) -> None:
    known = KNOWN[name]
    assert known.width_needed is not None
    remedy = changes_of([known.object], real_suite())[0][0]
    value, within = known.width_needed
    assert remedy.value == pytest.approx(value, abs=within)


def test_smaller_stretches_that_pass_are_islands() -> None:
    """Two were put in; the object as it is is none, nor what all larger ones pass with."""
    shares = [0.1, 0.4, 0.2, 0.1, 0.4, 0.4, 0.2, 0.4, 0.2, 0.0, 0.0]
    change = _Change(
        name="base width", values=[1.0 + k for k in range(11)], make=lambda _: statue()
    )
    tried = [
        _Tried(
            value=1.0 + k, share=0.5 * share, beyond=share, is_shown=share == 0.0, friction=0.1 * k
        )
        for k, share in enumerate(shares)
    ]
    remedy = _remedy(change, tried, [], TARGET)
    assert remedy.islands == ((3.0, 4.0), (7.0, 7.0))
    assert (remedy.value, remedy.share_1_1, remedy.shown_at) == (9.0, 0.2, 10.0)
    assert (remedy.friction_needed, remedy.slides) == (0.9, False)
    assert "3 m to 4 m, 7 m would do too, but not all others below 9 m" in remedy_warning(remedy)
    assert change_words(remedy, Target(TARGET)) == (
        "base 9 m wide (20 % at 1.1 x); 10 m to be sure of 25 %"
    )
    # With the last of them above the target there is no remedy.
    fails = [*tried, _Tried(value=12.0, share=0.3, beyond=0.3, is_shown=False, friction=1.0)]
    none = _remedy(change, fails, [], TARGET)
    assert (none.value, none.shown_at, none.friction_needed) == (None, None, None)
    assert none.islands == ((3.0, 4.0), (7.0, 7.0), (9.0, 11.0))


def test_values_that_would_slide_end_the_scan() -> None:
    friction = 0.27
    wide, low = changes_of([statue(friction=friction)])[0]
    free = changes_of([statue()])[0][0]
    assert (wide.slides, free.slides) == (True, False)
    assert wide.last < (free.value or 0.0) < free.last
    assert (wide.value, wide.shown_at) == (None, None)
    assert "the next would slide" in change_words(wide, Target(TARGET))
    at = [judged(statue(wide.last * factor, friction=friction), SUITE) for factor in (1.0, WIDER)]
    assert [each.decision.verdict == "slides" for each in at] == [False, True]
    assert low.friction_needed is None or low.friction_needed <= friction


def test_a_stocky_object_ends_where_no_wider_one_rocks() -> None:
    chest = described(1.1, 0.9, pga_g=1.6, pgv_m_s=1.5, target=0.01, assessment={"draws": 1})
    wide, low = changes_of([chest])[0]
    assert (wide.slides, low.slides) == (False, False)
    assert (wide.value, low.value) == (None, None)
    assert 1.1 <= wide.last < 1.1 * WIDEST


def test_a_change_is_looked_for_where_shape_can_help_alone() -> None:
    red = statue()
    assert is_helped(judged(red, SUITE), red, built_in=False)
    in_years = red.with_target(Target(0.01, years=50.0))
    for each, motions in (
        (statue(pga_g=0.1), SUITE), (statue(0.9), SUITE), (statue(friction=0.1), SUITE),
        (statue(0.9, friction=None), SUITE), (in_years, SUITE), (red, SUITE[:5]),
    ):  # fmt: skip
        assert not is_helped(judged(each, motions), each, built_in=False)
    assert assess_object(red).remedies == ()  # built-in motions
    assert assess_object(red.with_target(Target(0.99)), SUITE).remedies == ()  # green


def test_objects_of_one_batch_have_the_remedies_of_each_alone() -> None:
    objects = [statue(), statue(0.3, target=0.4), statue(friction=0.27), statue(pga_g=0.5)]
    together = changes_of(objects)
    assert together == changes_of(objects[::-1])[::-1]
    assert together == [changes_of([each])[0] for each in objects]
    assert len(set(together)) == 4
