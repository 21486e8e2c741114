"""Long-term motion of a block initially at rest, for one phase of the shaking or many."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady import DimensionlessBlock, Execution, map_attractors
from rocksteady.arrays import Floats
from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.outcomes import AttractorKind
from rocksteady.show.study.environment import Done, nothing
from rocksteady.show.study.parts import Parts
from rocksteady.studies.atlas.analysis.plane import Plane

if TYPE_CHECKING:
    import xarray


PHASES = 8
"""Phases of the shaking at its start, over half a period: half a period on all is mirrored."""
CYCLES = 500
MARKED = (1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0)
"""Frequency ratios of the page's tables, of bands and of the lowest amplitudes that overturn."""
STEPS = 700
"""Amplitudes from uplift to the plane's top that are tried at each."""
PARTS = 8
"""Parts of the cells after each of which `from_rest` reports its progress."""

FATES = (
    "rest",
    "symmetric, period 1",
    "unsymmetric, period 1",
    "period 1 with rests",
    "subharmonic",
    "aperiodic",
    "overturned",
    "undecided",
)
"""Long-term motion of a block, by its code in tables and pictures."""


@dataclass(frozen=True, kw_only=True)
class LowestFall:
    """The lowest amplitude that overturns a block from rest at one frequency.

    Attributes
    ----------
    frequency_ratio
        Omega.
    amplitude
        The lowest of those tried; nan where none overturns it.
    phase
        Phase of the shaking at its start [rad].
    step
        From one amplitude tried to the next.
    heteroclinic
        The heteroclinic amplitude there.
    """

    frequency_ratio: float
    amplitude: float
    phase: float
    step: float
    heteroclinic: float


@dataclass(frozen=True, kw_only=True, eq=False)
class FromRest:
    """Long-term motion of a block initially at rest.

    Attributes
    ----------
    plane
        Where.
    phases
        Phases of the shaking at its start [rad], shape (phases,).
    fate
        Index of `FATES`, shape (phases, amplitudes, columns).
    period, impacts
        As `rocksteady.map_attractors` has them, of the same shape.
    falls
        The lowest amplitudes that overturn.
    """

    plane: Plane
    phases: Floats
    fate: NDArray[np.int8]
    period: NDArray[np.int64]
    impacts: NDArray[np.int64]
    falls: tuple[LowestFall, ...]

    @cached_property
    def overturned(self) -> Floats:
        """Share of the phases at which the block overturns, shape (amplitudes, columns)."""
        share: Floats = (self.fate == FATES.index("overturned")).mean(axis=0)
        return share

    def share(self, fate: str) -> float:
        """Return the share of the plane in which a block ends in this motion at the first phase."""
        return float((self.fate[0] == FATES.index(fate)).mean())


def from_rest(
    plane: Plane,
    *,
    run: Execution | None = None,
    parts: Parts | None = None,
    done: Done = nothing,
) -> FromRest:
    """Return the long-term motion of a block initially at rest over a plane.

    Parameters
    ----------
    plane
        Where.
    run
        As for `rocksteady.map_attractors`; `parts` and `done` replace its store and progress.
    parts
        Where finished cells are kept.
    done
        Called `PARTS` times, each when another part of the cells is done.
    """
    phases: Floats = np.arange(PHASES, dtype=np.float64) * (math.pi / PHASES)
    marked = [w for w in MARKED if plane.window[0] <= w <= plane.window[1]]
    tried = np.linspace(1.0, plane.top, STEPS + 1) if plane.top > 1.0 else np.zeros(0)

    def say(part: int) -> None:
        done(f"from rest, {part + 1} of {PARTS}")

    cells = len(phases) * (len(plane.amplitudes) * len(plane.ratios) + len(tried) * len(marked))
    how = replace(Execution() if run is None else run, progress=in_steps(PARTS, cells, say))

    def settled(name: str, amplitude: Floats, ratio: ArrayLike) -> "xarray.Dataset":
        return map_attractors(
            DimensionlessBlock(restitution=plane.restitution),
            axes={"phase": phases, "amplitude": amplitude, "frequency_ratio": ratio},
            max_cycles=CYCLES,
            run=replace(how, store=None if parts is None else parts.store(name)),
        )

    dataset = settled("from-rest", plane.amplitudes, plane.ratios)
    period, impacts = (dataset[name].values for name in ("period", "impacts"))
    falls: tuple[LowestFall, ...] = ()
    if marked and tried.size:
        fallen = _where(settled("falls", tried, marked), AttractorKind.OVERTURNED)
        falls = _lowest(plane, marked, tried, phases, fallen)
    return FromRest(
        plane=plane,
        phases=phases,
        fate=_fates(dataset),
        period=period,
        impacts=impacts,
        falls=falls,
    )


def in_steps(steps: int, cells: int, done: Callable[[int], None]) -> Callable[[int], None]:
    """Return a progress callback that counts cells and reports the number of each completed step.

    There are `steps` steps in every `cells` cells.
    """
    passed = 0

    def swept(count: int) -> None:
        nonlocal passed
        before, passed = passed, passed + count
        for step in range(before * steps // cells, passed * steps // cells):
            done(step)

    return swept


def _where(dataset: "xarray.Dataset", which: AttractorKind) -> NDArray[np.bool_]:
    """Return in which cells of an attractor map a block settles to one kind."""
    kind = dataset["kind"]
    same: NDArray[np.bool_] = kind.values == kind.attrs["flag_meanings"].split().index(which)
    return same


def _fates(dataset: "xarray.Dataset") -> NDArray[np.int8]:
    """Return what came out of an attractor map, by the codes of `FATES`."""
    chosen = {
        "rest": _where(dataset, AttractorKind.REST),
        "overturned": _where(dataset, AttractorKind.OVERTURNED),
        "aperiodic": _where(dataset, AttractorKind.APERIODIC),
        "undecided": _where(dataset, AttractorKind.UNDECIDED),
        "subharmonic": dataset["period"].values > 1,
        "period 1 with rests": dataset["impacts"].values < 0,
        "symmetric, period 1": _where(dataset, AttractorKind.SYMMETRIC),
    }
    fates: NDArray[np.int8] = np.select(
        list(chosen.values()),
        [np.int8(FATES.index(name)) for name in chosen],
        default=np.int8(FATES.index("unsymmetric, period 1")),
    )
    return fates


def _lowest(
    plane: Plane, marked: list[float], tried: Floats, phases: Floats, fallen: NDArray[np.bool_]
) -> tuple[LowestFall, ...]:
    """Return the lowest amplitude that overturns, at any phase, for each marked frequency."""
    falls = []
    for place, ratio in enumerate(marked):
        here = fallen[:, :, place]
        row = int(np.argmax(here.any(axis=0)))
        falls.append(
            LowestFall(
                frequency_ratio=ratio,
                amplitude=float(tried[row]) if here[:, row].any() else math.nan,
                phase=float(phases[int(np.argmax(here[:, row]))]),
                step=float(tried[1] - tried[0]),
                heteroclinic=float(heteroclinic_amplitude(ratio, plane.restitution)),
            )
        )
    return tuple(falls)
