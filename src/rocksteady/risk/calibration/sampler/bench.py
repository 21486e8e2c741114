"""Runs of the draws of one object: every different shaking once, each draw at a few gains."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.kernels.elementary.arrays import cos, exp, log, sin, tan
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.equations import Model
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.risk.calibration.sampler.exact import rounded
from rocksteady.risk.calibration.sampler.space import Space
from rocksteady.risk.observations.fates import Scatter, compute_test_fates
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.sweep.run import Execution

GAINS = 2
"""Runs of a draw and a motion."""
REACH, FURTHEST = 0.5, 4.0
"""Largest ln of the gain of a run over that of its motion, and that of the largest errors."""
AUDITED = 32
"""Draws of a round that run motions whose fate seems settled, so that a mistake heals."""
WIDTH = 0.1
"""Of ln(gain) of tests that share their runs."""
PLANES = 9
"""Orientations that runs of tests with two horizontal channels have."""
LOST = (Status.LOST_CONTACT, Status.UNDECIDED, Status.ROCKING)
"""Ends without an answer; they count as standing."""


@dataclass(eq=False)
class Bench:
    """Tests of one object, and all runs that have been made of them.

    Attributes
    ----------
    space, tests, model, run
        The object, its tests, and how they are run.
    sigma
        Largest error of ln(gain) of a test that has none of its own.
    motion, shift
        Motion of each test, and ln of its gain over that of the motion, shape (tests,).
    shaken
        A test for each motion.
    features
        Properties of the blocks, shape (runs, features).
    gain
        ln of the gain of each run over that of its motion, shape (runs,).
    fell
        Whether each run fell; nan of what was not run, shape (motions, runs).
    peaks
        ln of the largest angle [rad] of runs that stood, where a test has a measured one; nan
        elsewhere, same shape.
    unknown
        Number of runs without an answer.
    """

    space: Space
    tests: Sequence[ShakingTest]
    model: Model
    run: Execution | None
    sigma: float = 0.0
    motion: Integers = field(init=False)
    shift: Floats = field(init=False)
    shaken: list[ShakingTest] = field(init=False)
    features: Floats = field(init=False)
    gain: Floats = field(init=False)
    fell: Floats = field(init=False)
    peaks: Floats = field(init=False)
    unknown: int = 0

    def __post_init__(self) -> None:
        """Find the motions, of which nothing has been run."""
        self.shaken, self.motion, self.shift = motions_of(self.tests)
        errors = [self.sigma if test.sigma_ln is None else test.sigma_ln for test in self.tests]
        self.reach = max(REACH, min(FURTHEST, 2.0 * max(errors)))
        self.features, self.gain = np.empty((0, 0)), np.empty(0)
        self.fell = self.peaks = np.empty((len(self.shaken), 0))
        measured = [test.peak_rad is not None for test in self.tests]
        self._measured = np.unique(self.motion[measured])
        self._least = min((test.sigma_rad or np.inf for test in self.tests), default=np.inf)

    @property
    def runs(self) -> int:
        """Runs of a motion, of the motions that are run with all draws."""
        return len(self.gain)

    def liftable(self, values: Floats) -> Bools:
        """Return which motions can lift some draw off its base, at some gain of its runs."""
        slope = float(tan(self.space.block.sides(values)[:, :, 0].min()))

        def peak(record: Record | None) -> float:
            return 0.0 if record is None else record.peak_acceleration_m_s2

        forces = [
            test.gain * (peak(test.record) + peak(test.transverse) + slope * peak(test.vertical))
            for test in self.shaken
        ]
        return np.asarray(float(exp(self.reach)) * np.array(forces) > STANDARD_GRAVITY * slope)

    def add(self, values: Floats, seed: Sequence[int], live: Bools) -> None:
        """Run draws, each at gains in strata of its own.

        Parameters
        ----------
        values
            Of the parameters, shape (draws, parameters).
        seed
            Of gains and impacts.
        live
            Motions that all draws run; the first draws run the others too.
        """
        rng = np.random.default_rng(list(seed))
        strata = np.tile(np.arange(GAINS), len(values)) + rng.random(GAINS * len(values))
        gain = rounded(self.reach * (2.0 * strata / GAINS - 1.0), 20)
        values = np.repeat(values, GAINS, axis=0)
        fell = np.full((len(self.shaken), len(values)), np.nan)
        peaks = fell.copy()
        for chosen, count in ((live, len(values)), (~live, min(AUDITED * GAINS, len(values)))):
            places = np.flatnonzero(chosen)
            if len(places):
                stream = int(rng.integers(2**31))
                fates = self.fates(places, values[:count], gain[:count], stream)
                fell[places, :count], peaks[places, :count] = fates
        features = self.space.features(values)
        self.features = np.vstack([self.features.reshape(-1, features.shape[1]), features])
        self.gain = np.append(self.gain, gain)
        self.fell, self.peaks = np.hstack([self.fell, fell]), np.hstack([self.peaks, peaks])

    def fates(
        self, places: Integers, values: Floats, gain: Floats, stream: int
    ) -> tuple[Floats, Floats]:
        """Return whether draws fall in some motions, and their peaks, shape (motions, draws).

        Parameters
        ----------
        places
            Numbers of the motions; one may be there more than once.
        values, gain
            Draws, and ln of their gains over that of the motion, shape (draws,) or (motions,
            draws).
        stream
            Seed of the impacts.
        """
        fell = np.empty((len(places), len(values)))
        peaks = np.full(fell.shape, np.nan)
        measured = np.isin(places, self._measured)
        angle = self.space.orientation(values)
        plane = np.zeros(len(values), dtype=np.int64)
        tests = [self.shaken[place] for place in places.tolist()]
        if any(test.transverse is not None for test in tests):
            ranks = np.argsort(np.argsort(angle, kind="stable"), kind="stable")
            plane = ranks * PLANES // len(angle)
        scatter = self.space.block.scatter_of(values)
        for number in np.unique(plane).tolist():
            inside = np.flatnonzero(plane == number)
            turn = float(rounded(angle[inside].mean(keepdims=True), 20)[0])
            factors = np.broadcast_to(exp(gain[..., inside]), (len(tests), len(inside)))
            fates = compute_test_fates(
                self.space.block.blocks(values[inside]),
                in_plane(tests, turn),
                gains=factors[:, :, np.newaxis],
                scatter=Scatter(scatter[inside], seed=stream + number),
                outputs=("status", "peak_angle") if measured.any() else ("status",),
                model=self.model,
                run=self.run,
            )
            status = fates["status"].transpose("test", "block", "gain", "draw").values[:, :, 0, 0]
            self.unknown += int(np.isin(status, LOST).sum())
            fell[:, inside] = status == Status.OVERTURNED
            if measured.any():
                ratio = fates["peak_angle"].transpose("test", "block", "gain", "draw").values
                angles = ratio[:, :, 0, 0] * self.space.derived(values[inside])["alpha_rad"]
                angles = log(np.maximum(angles, self._least))
                stood = measured[:, np.newaxis] & (fell[:, inside] == 0.0)
                peaks[:, inside] = np.where(stood, angles, np.nan)
        return fell, peaks


def motions_of(tests: Sequence[ShakingTest]) -> tuple[list[ShakingTest], Integers, Floats]:
    """Return tests whose runs do for all, the number of it of each test, and ln of its gain over.

    Tests of one motion whose gains are within 5 % of each other's middle share their runs; their
    surface is moved by what their gains differ.
    """
    keys: dict[tuple[object, ...], list[int]] = {}
    logs = log(np.array([test.gain for test in tests]))
    for place, test in enumerate(tests):
        records = (id(test.record), id(test.transverse), id(test.vertical), test.reversed)
        keys.setdefault((*records, round(float(logs[place]) / WIDTH)), []).append(place)
    shaken, motion, shift = [], np.zeros(len(tests), dtype=np.int64), np.zeros(len(tests))
    for number, places in enumerate(keys.values()):
        ends = logs[places].min(), logs[places].max()
        middle = 0.5 * (ends[0] + ends[1])
        gain = tests[places[0]].gain if ends[0] == ends[1] else float(exp(middle))
        shaken.append(replace(tests[places[0]], gain=gain))
        motion[places], shift[places] = number, rounded(logs[places] - middle, 20)
    return shaken, motion, shift


def in_plane(tests: Sequence[ShakingTest], angle: float) -> list[ShakingTest]:
    """Return tests with the motion in a plane at an angle from the first channel [rad]."""
    made: dict[tuple[int, int], Record] = {}

    def turned(test: ShakingTest) -> ShakingTest:
        if test.transverse is None:
            return test
        key = (id(test.record), id(test.transverse))
        if key not in made:
            first, second = test.record.acceleration_m_s2, test.transverse.acceleration_m_s2
            count = max(len(first), len(second))
            samples = np.zeros(count)
            samples[: len(first)] += cos(angle) * first
            samples[: len(second)] += sin(angle) * second
            made[key] = replace(test.record, acceleration_m_s2=samples)
        return replace(test, record=made[key], transverse=None)

    return [turned(test) for test in tests]
