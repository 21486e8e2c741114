"""What tests of counted runs share: 56 real records, and objects at a demand."""

import functools
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import BaseMotion, Record, read_record
from rocksteady.motions import Floor
from rocksteady.risk import DescribedObject, HazardCurve
from rocksteady.risk.assess.judging import Judged, judge_objects
from rocksteady.risk.assess.placed_objects import place_objects
from rocksteady.risk.counted.count import Count
from rocksteady.risk.counted.suite import Suite
from tests.records import ABSENT, FOLDER

Floats = NDArray[np.float64]
G = 9.80665
HIGH = 3.0
"""Friction with which nothing slides."""
RACKS = {"frequencies_hz": 1.25, "damping": 0.05, "shapes": 0.6667}
"""A floor of a building of .8 s."""
SITE = HazardCurve(
    measure="pga_g",
    levels=np.array([0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2.0]),
    rates=np.array([0.12, 0.085, 0.052, 0.0205, 0.0082, 2.6e-3, 1.15e-3, 3.3e-4, 8.5e-5, 2.2e-5,
                    3.1e-6]),
)  # fmt: skip
"""Hazard of a site [1/year]."""


@functools.cache
def real_suite() -> tuple[Record, ...]:
    """Return the 56 horizontal records, by name; the test is skipped without them."""
    files = sorted((FOLDER / "suite_at2").glob("*.AT2"))
    if not files:
        pytest.skip(ABSENT)
    return tuple(read_record(file) for file in files)


@functools.cache
def real_pairs(count: int = 14) -> tuple[BaseMotion, ...]:
    """Return records with another one, cut to half its size, as their vertical component."""
    suite = real_suite()
    pairs = []
    for place in range(count):
        across, other = suite[place], suite[-1 - place]
        samples = min(len(across.acceleration_m_s2), len(other.acceleration_m_s2))
        up = Record(acceleration_m_s2=0.5 * other.acceleration_m_s2[:samples], dt_s=across.dt_s)
        pairs.append(BaseMotion(across, up))
    return tuple(pairs)


def the_floor() -> Floor:
    return Floor(**RACKS)


def described(
    width: float,
    height: float,
    *,
    pga_g: float | None = None,
    pgv_m_s: float | None = None,
    target: float | None = 0.1,
    friction: float | None = HIGH,
    geometry: dict[str, Any] | None = None,
    **keys: Any,
) -> DescribedObject:
    """Return an object of a size at a demand; `geometry` adds keys of that table."""
    peaks = {"pga_g": pga_g, "pgv_m_s": pgv_m_s}
    demand = {key: value for key, value in peaks.items() if value is not None}
    values: dict[str, Any] = {
        "name": "object",
        "geometry": {"width_m": width, "height_m": height, **(geometry or {})},
        **keys,
        "demand": {**demand, **keys.get("demand", {})},
        "assessment": {
            **({} if target is None else {"target_probability": target}),
            **keys.get("assessment", {}),
        },
    }
    if friction is not None:
        values["friction"] = friction
    return DescribedObject(values=values)


def judged(
    described: DescribedObject,
    motions: Sequence[Record | BaseMotion] | Suite | None,
    *,
    floor: Floor | None = None,
    stretch: bool = True,
) -> Judged:
    """Return an object at its demand, without curve and sensitivity."""
    (found,) = judge_objects(place_objects([described], motions, floor=floor, stretch=stretch))
    return found


def count_of(fell: Sequence[int], ways: int = 5, answered: Sequence[int] | None = None) -> Count:
    """Return a count of falls of each record; all runs have an answer by default."""
    tried = [ways] * len(fell) if answered is None else answered
    return Count(fell=np.array(fell), answered=np.array(tried), ways=ways)


def spread_out(falls: int, records: int, ways: int = 5) -> Count:
    """Return a count in which the falls are those of as few records as can be."""
    fell = np.clip(falls - ways * np.arange(records), 0, ways)
    return count_of(fell.tolist(), ways)
