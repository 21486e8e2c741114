"""Fate of a block in the paper's words, and its dependence on the initial state."""

import functools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING

import numpy as np

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    Rest,
    State,
    Steady,
    find_attractor,
    map_attractors,
    simulate,
)
from rocksteady.arrays import Floats
from rocksteady.orbits import Orbit
from rocksteady.outcomes import AttractorKind
from rocksteady.sweeps import Axis, Grid, Output, evaluate

if TYPE_CHECKING:
    import xarray


FALLING = 1000
"""Excitation periods for which a block may still go on after its last impact until it falls."""
OVERTURNED_AFTER = Output(name="overturned_after", long_name="forcing periods until it falls")


class Kind(StrEnum):
    """What became of a block."""

    REST = "at rest"
    SYMMETRIC = "symmetric harmonic"
    UNSYMMETRIC = "unsymmetric harmonic"
    SUBHARMONIC = "subharmonic"
    OVERTURNED = "overturned"
    UNSETTLED = "not settled"


@dataclass(frozen=True, kw_only=True)
class Fate:
    """What a block settles to.

    Attributes
    ----------
    kind
        What became of it.
    period
        Excitation periods after which the motion repeats itself; 0 unless it does.
    symmetric
        Whether half of that turns it into its mirror image.
    highest, lowest
        Extrema of theta/alpha of the motion; nan where there is none.
    overturned_after
        Excitation periods until it passes |theta| = alpha for good; nan unless it does.
    orbit
        The periodic motion of a single run; None where it rests, overturns or does not settle, and
        of one run among many.
    """

    kind: Kind
    period: int = 0
    symmetric: bool = False
    highest: float = math.nan
    lowest: float = math.nan
    overturned_after: float = math.nan
    orbit: Orbit | None = None

    @property
    def label(self) -> str:
        """What became of the block, in a few words."""
        if self.kind is Kind.OVERTURNED:
            return f"overturns after {self.overturned_after:.1f} periods"
        if self.kind is Kind.SUBHARMONIC:
            shape = "symmetric" if self.symmetric else "unsymmetric"
            return f"{shape} 1/{self.period} subharmonic"
        return self.kind.value

    @property
    def bias(self) -> int:
        """Side to which an unsymmetric motion leans, +1 or -1; 0 for every other."""
        if not self.period or self.symmetric:
            return 0
        return 1 if self.highest > -self.lowest else -1


def settle(restitution: float, shaking: Harmonic, start: Rest | State | Steady) -> Fate:
    """Return what a block settles to from a start.

    Parameters
    ----------
    restitution
        Restitution of the block, in (0, 1].
    shaking
        The base motion; a `Steady` start decides on its phase.
    start
        Where the block begins.
    """
    block = DimensionlessBlock(restitution=restitution)
    attractor = find_attractor(block, shaking, start=start)
    orbit = attractor.orbit
    if orbit is not None:
        return Fate(
            kind=_kind(attractor.kind, orbit.period),
            period=orbit.period,
            symmetric=orbit.symmetric,
            highest=orbit.highest,
            lowest=orbit.lowest,
            orbit=orbit,
        )
    kind = _kind(attractor.kind, 0)
    if kind is not Kind.OVERTURNED:
        return Fate(kind=kind)
    after = _falls_after(block, shaking, start, attractor.after + FALLING)
    return Fate(kind=kind, overturned_after=after)


def fates_over_kicks(
    restitution: float, shaking: Harmonic, start: Steady, *, kicks: Floats
) -> list[Fate]:
    """Return what a block settles to for each distance at which it leaves a steady state."""
    block = DimensionlessBlock(restitution=restitution)
    dataset = map_attractors(block, shaking, axes={"kick": kicks}, start=start)
    attractors, kinds = _attractors_in(dataset), list(kinds_in(dataset))
    fallen = np.array([kind is Kind.OVERTURNED for kind in kinds])
    after = np.full(len(kicks), math.nan)
    if fallen.any():
        times = functools.partial(
            _falls,
            block=block,
            shaking=shaking,
            start=start,
            cycles=int(dataset["after"].values[fallen].max()) + FALLING,
        )
        grid = Grid(axes=(Axis(name="kick", values=kicks[fallen]),))
        after[fallen] = evaluate(times, grid, (OVERTURNED_AFTER,))["overturned_after"].values
    columns = (dataset[name].values.tolist() for name in ("period", "highest", "lowest"))
    return [
        Fate(
            kind=kind,
            period=period,
            symmetric=settled is AttractorKind.SYMMETRIC,
            highest=highest if period else math.nan,
            lowest=lowest if period else math.nan,
            overturned_after=time,
        )
        for kind, settled, period, highest, lowest, time in zip(
            kinds, attractors, *columns, after.tolist(), strict=True
        )
    ]


def kinds_in(dataset: "xarray.Dataset") -> Iterator[Kind]:
    """Yield what became of each cell of `rocksteady.map_attractors`, in C order."""
    periods = dataset["period"].values.ravel().tolist()
    for kind, period in zip(_attractors_in(dataset), periods, strict=True):
        yield _kind(kind, period)


def _attractors_in(dataset: "xarray.Dataset") -> list[AttractorKind]:
    """Return to which attractor each cell of an attractor map settles, in C order."""
    names = dataset["kind"].attrs["flag_meanings"].split()
    return [AttractorKind(names[code]) for code in dataset["kind"].values.ravel().tolist()]


def _kind(kind: AttractorKind, period: int) -> Kind:
    """Return what became of a block by what it has settled to and, of an orbit, its period."""
    if kind is AttractorKind.REST:
        return Kind.REST
    if kind is AttractorKind.OVERTURNED:
        return Kind.OVERTURNED
    if not period:
        return Kind.UNSETTLED
    if period > 1:
        return Kind.SUBHARMONIC
    return Kind.SYMMETRIC if kind is AttractorKind.SYMMETRIC else Kind.UNSYMMETRIC


def _falls_after(
    block: DimensionlessBlock,
    shaking: Harmonic,
    start: Rest | State | Steady,
    cycles: int,
) -> float:
    """Return after how many forcing periods a block that overturns does so."""
    run = simulate(block, shaking, start=start, cycles=cycles)
    assert run.overturn_time_tau is not None
    return run.overturn_time_tau / (2.0 * math.pi)


def _falls(
    kick: Floats,
    *,
    block: DimensionlessBlock,
    shaking: Harmonic,
    start: Steady,
    cycles: int,
) -> dict[str, Floats]:
    """Return when blocks overturn that leave a steady state at some distances."""
    times = [
        _falls_after(block, shaking, replace(start, kick=distance), cycles)
        for distance in kick.tolist()
    ]
    return {"overturned_after": np.array(times)}
