"""Calibrations by synthetic tests, small and quick to compute."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from typing import Any
from unittest.mock import patch

from rocksteady import Block, Linear, calibrate
from rocksteady.calibration import Calibration, Observations, make_synthetic_tests
from rocksteady.motions import make_synthetic_suite
from rocksteady.show.calibration import _calibration_report

PICTURES: dict[str, Any] = {"ladders": [], "posteriors": []}
HOSTILE = '<script>alert(1)</script> $x$ & "co"\u202e'


@contextmanager
def without_pictures() -> Iterator[None]:
    """Leave the pictures of a page out, which take most of the time of a folder."""
    with patch.object(_calibration_report, "pictures_of", lambda _: PICTURES):
        yield


@cache
def observations() -> Observations:
    """Tests of one block on six records at four gains, in two sessions."""
    made = make_synthetic_tests(
        Block.rectangle(width=0.15, height=0.6), make_synthetic_suite(6), model=Linear()
    )
    tests = [replace(test, session=f"day {1 + place % 2}") for place, test in enumerate(made.tests)]
    return replace(made, tests=tests, sources={"tests.csv": "ab" * 32})


def few(tests: Observations) -> Calibration:
    """Calibrate with few runs of the linear model."""
    return calibrate(tests, most_runs=200, model=Linear())


@cache
def calibrated() -> Calibration:
    """Return a calibration with all that a page shows."""
    return few(observations())


@cache
def hostile() -> Calibration:
    """Return one whose names are markup, mathematics and marks of direction."""
    made = observations()
    known = next(iter(made.objects.values()))
    tests = [
        replace(
            test,
            name=f"{HOSTILE} {place}",
            object=HOSTILE,
            record=replace(test.record, name=f"{HOSTILE} {test.record.name}"),
            group=f"{HOSTILE} {test.group}",
            session=f"{HOSTILE} {test.session}",
        )
        for place, test in enumerate(made.tests)
    ]
    return few(
        Observations(
            tests=tests,
            objects={HOSTILE: replace(known, name=HOSTILE)},
            sources={f"{HOSTILE}.csv": "cd" * 32},
        )
    )


@cache
def unscored() -> Calibration:
    """Return one of a single record: nothing can be held out."""
    made = observations()
    first = made.tests[0].record
    return few(made.subset([place for place, t in enumerate(made.tests) if t.record is first]))
