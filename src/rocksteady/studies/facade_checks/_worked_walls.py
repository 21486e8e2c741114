"""Two walls of the plane on which the static and the dynamic check disagree, run again."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rocksteady import Linear, check_facade, simulate
from rocksteady.arrays import Floats
from rocksteady.codes import FacadeCheck, FacadeDemand, FacadeRuns, run_facade
from rocksteady.histories import Trajectory
from rocksteady.studies.facade_checks._checked_walls import DAMPING, SHARE, CheckedWalls, scaled

Kind = Literal["static refuses", "dynamic refuses"]
KINDS: tuple[Kind, ...] = ("static refuses", "dynamic refuses")
FEW = 7
"""Records of a smaller suite, where the whole one has no such wall: the fewest for a mean."""
LONGER = 2.0
"""Part of T_SLV up to which the spectrum of the governing record is looked at too."""
FAR = 3.0
"""Demand over capacity beyond which a verdict is no clearer."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WorkedWall:
    """A wall on which the checks disagree.

    Attributes
    ----------
    kind
        Which check refuses what the other accepts.
    level, row, column
        Its cell.
    records
        Places of the records among those of the plane.
    check
        Its checks under these records.
    governing
        Place in `records` of the record whose S_D exceeds the displacement of its run by most, or
        of a run beyond d0 whose S_D is the smallest.
    direction
        Sign of its worse run.
    history
        That run.
    spectra_m
        Largest S_D of each record up to T_SLV [m], shape (records,).
    longer_m
        That of the governing record up to twice the period [m].
    others
        Demand over capacity of the dynamic check by other assumptions.
    """

    kind: Kind
    level: int
    row: int
    column: int
    records: tuple[int, ...]
    check: FacadeCheck
    governing: int
    direction: str
    history: Trajectory
    spectra_m: Floats
    longer_m: float
    others: dict[str, float]

    @property
    def runs(self) -> FacadeRuns:
        """Its runs."""
        assert self.check.runs is not None
        return self.check.runs

    @property
    def ratios(self) -> dict[str, float]:
        """Demand over capacity of the three checks of SLV."""
        return {
            each.method: float(each.ratio)
            for each in self.check.checks
            if each.limit_state == "SLV" and each.ratio is not None
        }


def worked_walls(checked: CheckedWalls) -> tuple[WorkedWall, ...]:
    """Return the clearest wall of each kind; of seven records where the whole suite has none."""
    every = tuple(range(len(checked.plane.records)))
    walls = []
    for kind in KINDS:
        records = every
        cell = _clearest(checked, every, kind)[1]
        if cell is None:
            choices = ((_clearest(checked, few, kind), few) for few in _sevens(len(every)))
            (_, cell), records = max(choices, key=lambda each: each[0][0], default=((0, None), ()))
        if cell is not None:
            walls.append(_worked(checked, kind, cell, records))
    return tuple(walls)


def _sevens(count: int) -> Iterator[tuple[int, ...]]:
    """Yield seven records that stand side by side."""
    if count > FEW:
        for first in range(count - FEW + 1):
            yield tuple(range(first, first + FEW))


def _clearest(
    checked: CheckedWalls, records: tuple[int, ...], kind: Kind
) -> tuple[float, tuple[int, int, int] | None]:
    """Return how far the verdicts of a cell lie apart, and the cell; 0 and None where none does."""
    share = checked.dynamics[0].share[..., records]
    static = checked.spectral[..., records].mean(axis=-1)
    mean = np.where((share > 1.0).any(axis=-1), np.inf, share.mean(axis=-1) / SHARE)
    static, mean = (np.log(np.clip(each, 1.0 / FAR, FAR)) for each in (static, mean))
    apart = np.minimum(static, -mean) if kind == "static refuses" else np.minimum(-static, mean)
    best = int(np.argmax(apart))
    if apart.flat[best] <= 0.0:
        return 0.0, None
    level, row, column = (int(each) for each in np.unravel_index(best, apart.shape))
    return float(apart.flat[best]), (level, row, column)


def _worked(
    checked: CheckedWalls, kind: Kind, cell: tuple[int, int, int], records: tuple[int, ...]
) -> WorkedWall:
    """Run a wall again and look at the record that governs."""
    level, row, column = cell
    wall, pga_g = checked.plane.wall(row, column), float(checked.plane.levels_g[level])
    plane = replace(checked.plane, records=[checked.plane.records[place] for place in records])
    demand, factors = scaled(plane, pga_g)
    runs = run_facade(wall, list(plane.records), pga_g=pga_g)
    check = check_facade(wall, FacadeDemand(slv=demand), runs=runs)
    period = wall.mechanism.t_slv_s
    shorter, longer = (demand.displacements_m(times * period, DAMPING) for times in (1.0, LONGER))
    beyond = runs.beyond_d0.any(axis=1)
    governing = int(np.argmax(shorter - runs.largest_m))
    if kind == "dynamic refuses":
        worst = beyond if beyond.any() else runs.share.max(axis=1) == runs.share.max()
        governing = int(np.argmin(np.where(worst, shorter, math.inf)))
    sign = int(np.argmax(runs.share[governing]))
    shaking = plane.records[governing].scaled(factors[governing] * wall.mechanism.base_factor)
    motions = (shaking, shaking.reversed())
    others = {
        "nonlinear, e = 0": run_facade(
            replace(wall, restitution=0.0), list(plane.records), pga_g=pga_g
        ),
        "nonlinear, e = 0.8": run_facade(
            replace(wall, restitution=0.8), list(plane.records), pga_g=pga_g
        ),
        "linear, Housner": run_facade(wall, list(plane.records), pga_g=pga_g, model=Linear()),
    }
    return WorkedWall(
        kind=kind,
        level=level,
        row=row,
        column=column,
        records=records,
        check=check,
        governing=governing,
        direction=runs.directions[sign],
        history=simulate(wall.mechanism.block(), motions[sign]),
        spectra_m=shorter,
        longer_m=float(longer[governing]),
        others={name: _ratio(each) for name, each in others.items()},
    )


def _ratio(runs: FacadeRuns) -> float:
    """Return the demand over capacity of the dynamic check."""
    mean = runs.mean_m
    assert mean is not None
    return math.inf if runs.beyond else mean / runs.limit_m
