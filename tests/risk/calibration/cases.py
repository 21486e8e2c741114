"""Short motions, tests of a stone on a narrow base, and its calibration, which tests share."""

from functools import cache
from typing import Any

import numpy as np

from rocksteady import Execution, Linear, Record, Status, calibrate
from rocksteady.calibration import (
    Calibration,
    ObjectPrior,
    Observations,
    Scatter,
    ShakingTest,
    compute_test_fates,
)

LINEAR, SERIAL = Linear(), Execution(executor="serial")
STONE = ObjectPrior(name="stone", width_m=0.7, height_m=0.8)
TRUTH = {"base": 0.08, "offset": 0.1, "housner_factor": 0.95, "scatter": 0.02}
"""Far below the bases of published stones."""


def make_records(count: int, seed: int = 0) -> list[Record]:
    """Return short strong motions: two sines that rise and fade, 2 s at 50 Hz."""
    rng = np.random.default_rng([seed, 1])
    time = 0.02 * np.arange(100)
    records = []
    for number in range(count):
        rates, phases = rng.uniform(3.0, 14.0, size=(2, 1)), rng.uniform(0.0, 6.0, size=(2, 1))
        samples = np.sin(rates * time + phases).sum(axis=0) * np.sin(0.5 * np.pi * time)
        samples *= 1.2 / np.abs(np.cumsum(samples) * 0.02).max()
        records.append(Record(acceleration_m_s2=samples, dt_s=0.02, name=f"motion {number + 1}"))
    return records


@cache
def narrow_tests() -> Observations:
    """Return 60 tests on 15 motions, in three sessions and a lone one.

    p PGV/(g tan alpha) is 0.4 to 2.2; ln(gain) has errors of 0.1 and of the session.
    """
    truth = ObjectPrior(name="stone", width_m=0.7, height_m=0.8, **TRUTH).block([])
    rng, suite = np.random.default_rng([1, 2]), make_records(15, 1)
    day, tests = rng.integers(3, size=60), []
    day[0] = 3
    for place in range(60):
        level = np.exp(rng.uniform(np.log(0.4), np.log(2.2)))
        gain = float(level * 9.81 * np.tan(truth.alpha) / (truth.p * 1.2))
        usual: dict[str, Any] = {"name": f"t{place}", "record": suite[place % 15], "gain": gain}
        tests.append(usual | {"object": "stone", "session": f"day {day[place] + 1}"})
    gains = np.exp(np.array([-0.15, 0.1, 0.2, 0.1])[day] + 0.1 * rng.standard_normal(60))
    plain = [ShakingTest(**test) for test in tests]
    scatter = Scatter(0.02, seed=1)
    fates = compute_test_fates(truth, plain, gains=gains[:, None], scatter=scatter, model=LINEAR)
    fell = (fates.status.values.ravel() == Status.OVERTURNED).tolist()
    shaken = [ShakingTest(**test, fell=end) for test, end in zip(tests, fell, strict=True)]
    return Observations(tests=shaken, objects={"stone": STONE})


@cache
def narrow() -> Calibration:
    """Return the calibration by these tests."""
    return calibrate(narrow_tests(), model=LINEAR, run=SERIAL)
