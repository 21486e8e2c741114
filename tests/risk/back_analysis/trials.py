"""Trials of the region: simulated cemeteries under records that are in no suite.

``python -m tests.risk.back_analysis.trials 200 --objects 20`` prints how often the true (PGA, PGV)
lies in the region of 90 %.  A record is drawn, left out of the suite, and scaled at random; of each
object sizes, restitution and its scatter are drawn from the prior, and a gain error of 0.2; the
outcome is simulated.  The runs of the analysis are shared by all trials.
"""

import argparse
import math
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rocksteady import Execution, Nonlinear, Record, Status, read_record
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk.back_analysis._analysis import Tried, analyse
from rocksteady.risk.back_analysis._chances import Levels
from rocksteady.risk.back_analysis._fall_shares import POOL, draw_objects, fall_shares
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis
from rocksteady.risk.back_analysis.scan import ScanOptions
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.risk.observations.spread import PriorRange
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from rocksteady.seismic.spectra.batch import (
    GroundShaking,
    scattered_sides,
    shaken_fates,
    sides_in_si,
)
from tests.records import FOLDER

Floats = NDArray[np.float64]

GAIN_ERROR = 0.2
NOISE = OutcomeErrors(sigma_ln=PriorRange.between(0.1, 0.3))
LIMITS = (0.08, 3.5)
"""Of PGA [g]: of the truth, and of the analysis."""
MEASURES = (Measure("pga_g"), Measure("pgv_m_s"))


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One simulated cemetery: what was true, and what was found."""

    record: int
    pga_g: float
    pgv_m_s: float
    found: BackAnalysis

    @property
    def mixed(self) -> bool:
        """Whether some objects fell and some stood."""
        return self.found.bound == "interval"

    def held(self, measure: int) -> bool:
        """Return whether the interval of a measure holds the truth; an open end does."""
        truth = (self.pga_g, self.pgv_m_s)[measure]
        low, high = float(self.found.lows[measure]), float(self.found.highs[measure])
        return not (truth < low or truth > high)

    @property
    def covered(self) -> bool:
        """Whether the truth lies in the region."""
        return self.found.contains(self.pga_g, self.pgv_m_s)


def cemetery(count: int, seed: int = 0) -> list[ObjectPrior]:
    """Return objects of 0.5 to 2.2 m, 2.2 to 7 times as high as wide, measured to some per cent."""
    random = np.random.default_rng(seed)
    heights = np.exp(random.uniform(np.log(0.5), np.log(2.2), count))
    widths = heights / np.exp(random.uniform(np.log(2.2), np.log(7.0), count))
    return [
        ObjectPrior(
            name=f"grave {place + 1}",
            width_m=PriorRange.between(0.95 * width, 1.05 * width),
            height_m=PriorRange.between(0.98 * height, 1.02 * height),
            base=PriorRange.between(0.85, 1.0),
        )
        for place, (width, height) in enumerate(zip(widths.tolist(), heights.tolist(), strict=True))
    ]


def try_all(
    objects: list[ObjectPrior], records: list[Record], *, levels: int, draws: int, run: Execution
) -> Tried:
    """Return the runs that all trials share."""
    model = Nonlinear()
    survey = Survey(objects=objects, fell=[False] * len(objects))
    grounds = [GroundShaking(record=record) for record in records]
    at_one = np.array([[compute_measure(record, each) for each in MEASURES] for record in records])
    spans = Levels.between(*LIMITS, levels, NOISE)
    begun = time.perf_counter()
    shares = fall_shares(
        draw_objects(survey, model, count=POOL, seed=1),
        grounds,
        np.exp(spans.simulated) / at_one[:, :1],
        draws=draws,
        run=run,
    )
    return Tried(
        names=tuple(record.name or "" for record in records),
        measures=MEASURES,
        at_one=at_one,
        levels=spans,
        shares=shares,
        draws=draws,
        seconds=time.perf_counter() - begun,
        model=model,
    )


def run_trial(
    objects: list[ObjectPrior],
    records: list[Record],
    tried: Tried,
    *,
    count: int,
    number: int,
    trials: int = 4,
) -> Trial:
    """Return one cemetery of some of the objects, analysed without its record."""
    random = np.random.default_rng([2026, number, count])
    record = int(random.integers(len(records)))
    pga = float(np.exp(random.uniform(*np.log(LIMITS))))
    chosen = np.sort(random.choice(len(objects), count, replace=False))
    fell = _outcomes([objects[k] for k in chosen], records[record], pga, random)
    others = np.arange(len(records)) != record
    seen = replace(
        tried,
        names=tuple(np.array(tried.names)[others].tolist()),
        at_one=tried.at_one[others],
        shares=tried.shares[:, chosen][:, :, :, others],
    )
    survey = Survey(objects=[objects[k] for k in chosen], fell=fell)
    found = analyse(survey, seen, NOISE, ScanOptions(trials=trials, seed=number))
    ratio = tried.at_one[record, 1] / tried.at_one[record, 0]
    return Trial(record=record, pga_g=pga, pgv_m_s=float(pga * ratio), found=found)


def _outcomes(
    objects: list[ObjectPrior], record: Record, pga: float, random: np.random.Generator
) -> list[bool]:
    """Return which objects fall, each of sizes, restitution and gain drawn at random."""
    sides, gravity = [], 0.0
    for each in objects:
        values = each.draw(random.random((1, len(each.parameters))))
        block, gravity = each.block(values[0]), each.block(values[0]).gravity
        own = sides_in_si(block, Nonlinear())[np.newaxis]
        key = np.array([random.integers(2**50)])
        sides.append(scattered_sides(own, each.scatter_of(values), key)[0])
    gains = np.exp(GAIN_ERROR * random.standard_normal(len(objects)))
    scale = pga * gains / compute_measure(record, "pga_g")
    found = shaken_fates(
        [GroundShaking(record=record)],
        ground=np.zeros(len(objects), dtype=np.int64),
        scale=scale,
        sides=np.stack(sides),
        gravity=np.full(len(objects), gravity),
        peaks=False,
    )
    return [status == int(Status.OVERTURNED) for status in found.status.tolist()]


def suite_of(name: str) -> list[Record]:
    """Return the recorded suite, or a synthetic one."""
    if name == "synthetic":
        return list(make_synthetic_suite(24))
    return [read_record(path) for path in sorted((FOLDER / "suite_at2").glob("*.AT2"))]


def report(done: list[Trial], count: int) -> str:
    """Return how often truths were covered, in words."""
    mixed = [each for each in done if each.mixed]
    others = [each for each in done if not each.mixed]
    within = [np.mean([each.held(k) for each in mixed]) for k in range(2)]
    bounds = [each.held(k) for each in others for k in range(2)]
    tempers = [each.found.temper for each in mixed]
    shares = [each.found.share for each in mixed]
    ratio = np.mean([math.log(each.found.highs[1] / each.found.lows[1]) for each in mixed])
    return (
        f"{count} objects, {len(mixed)} surveys: the truth lies in the region in "
        f"{np.mean([each.covered for each in mixed]):.3f}, in the interval of PGA in "
        f"{within[0]:.3f}, of PGV in {within[1]:.3f}, which is a factor of {math.exp(ratio):.2f} "
        f"wide; median temper {np.median(tempers):g}, share {np.median(shares):.2f}; "
        f"{len(others)} more with outcomes of one kind, whose bounds hold in "
        f"{np.mean(bounds) if bounds else math.nan:.3f}"
    )


def say(text: str) -> None:
    """Write a line at once."""
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def main() -> None:
    """Print the coverage."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("trials", type=int)
    parser.add_argument("--objects", default="5,20,100")
    parser.add_argument("--suite", choices=("recorded", "synthetic"), default="recorded")
    parser.add_argument("--levels", type=int, default=18)
    parser.add_argument("--draws", type=int, default=4)
    parser.add_argument("--store", type=Path, default=None, help="folder that keeps the runs")
    given = parser.parse_args()
    counts = [int(part) for part in given.objects.split(",")]
    records = suite_of(given.suite)
    objects = cemetery(max(counts))
    tried = try_all(
        objects,
        records,
        levels=given.levels,
        draws=given.draws,
        run=Execution(store=given.store),
    )
    say(f"{tried.draws * tried.shares[0].size:,} runs in {tried.seconds:.0f} s")
    for count in counts:
        begun = time.perf_counter()
        done: list[Trial] = []
        number = 0
        while sum(each.mixed for each in done) < given.trials:
            done.append(run_trial(objects, records, tried, count=count, number=number))
            number += 1
        say(f"{report(done, count)}; {time.perf_counter() - begun:.0f} s")


if __name__ == "__main__":
    main()
