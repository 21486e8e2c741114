"""Number of coexisting stable motions at each point, found from many initial states."""

import functools
import math
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady import Execution
from rocksteady.arrays import Floats, Integers
from rocksteady.formulas import steady_states
from rocksteady.kernels.elementary.arrays import cos, sin
from rocksteady.orbits import Attractors, find_attractors
from rocksteady.outcomes import AttractorKind
from rocksteady.studies.atlas.analysis.plane import Plane
from rocksteady.sweeps import INFINITELY_MANY, Axis, Grid, Output, evaluate

Upright = tuple[Floats, Floats]
"""Velocity du/d(pt) and phase [rad] of blocks that stand upright, shape (cells,)."""

CYCLES = 500
"""Forcing periods after which a motion counts as aperiodic or undecided."""
REST_PHASES = 8
"""Phases of the shaking, over half a period, at which a block at rest is let go: half a period on,
everything is mirrored."""
STEADY = (*((n, branch) for n in (1, 3, 5) for branch in (1, 2)), (7, 1), (9, 1))
"""Symmetric states on whose either side motions begin: order and branch."""
ASIDE = 1e-3
"""Part of its velocity by which a motion begins off such a state."""
PHASES, SPEEDS = 12, 4
"""States just after an impact on the positive side: mirror images count once."""
SLOWEST = 0.05
"""Least reach of their speeds, where every impact at that phase is followed by a fall."""
MOST = 10
"""Orbits that a cell has room for."""
SAME = 1e-6
"""Difference of extrema of theta/alpha, relative to the larger, below which orbits are one."""
ROOM = 1_000_000
"""Of the numbers of impacts in a code."""


@dataclass(frozen=True)
class OrbitClass:
    """What orbits have in common that are drawn and counted together.

    Attributes
    ----------
    period
        Forcing periods.
    impacts
        In a period of the orbit; None for infinitely many, where it comes to rest.
    unsymmetric
        Whether it differs from its mirror image, with which it is counted once.
    """

    period: int
    impacts: int | None
    unsymmetric: bool

    def __lt__(self, other: "OrbitClass") -> bool:
        return self.code < other.code

    @property
    def code(self) -> int:
        """All three in one number, above 0."""
        impacts = INFINITELY_MANY if self.impacts is None else self.impacts
        return 2 * (ROOM * self.period + 1 + impacts) + self.unsymmetric

    @classmethod
    def of(cls, code: int) -> "OrbitClass":
        """Return the class of a code."""
        rest, unsymmetric = divmod(code, 2)
        period, after = divmod(rest, ROOM)
        return cls(period, after - 1 if after else None, bool(unsymmetric))

    @property
    def text(self) -> str:
        """As in tables: "3x6", "3x6-unsymmetric", "1xrests"."""
        impacts = "rests" if self.impacts is None else str(self.impacts)
        return f"{self.period}x{impacts}" + ("-unsymmetric" if self.unsymmetric else "")

    @property
    def words(self) -> str:
        """As in sentences: "an unsymmetric motion of 3 periods and 6 impacts"."""
        periods = "1 period" if self.period == 1 else f"{self.period} periods"
        impacts = "with rests" if self.impacts is None else f"and {self.impacts} impacts"
        kind = "an unsymmetric" if self.unsymmetric else "a symmetric"
        return f"{kind} motion of {periods} {impacts}"


OUTPUTS = (
    Output(name="rest", dtype=np.bool_),
    Output(name="aperiodic", dtype=np.bool_),
    Output(name="undecided", dtype=np.int32),
    Output(name="orbits", dtype=np.int32),
    *(Output(name=f"code_{place}", dtype=np.int64) for place in range(MOST)),
)


@dataclass(frozen=True, kw_only=True, eq=False)
class Coexistence:
    """Coexisting stable motions, as arrays of shape (amplitudes, columns).

    Attributes
    ----------
    plane
        Where.
    rest
        Whether a block at rest may stay there.
    aperiodic
        Whether a motion was found that does not repeat itself.
    undecided
        Number of starts of which nothing is known after 500 periods.
    orbits
        Number of stable orbits, mirror images counted once.
    codes
        Classes of the first ten of them, 0 for none, shape (10, amplitudes, columns).
    """

    plane: Plane
    rest: NDArray[np.bool_]
    aperiodic: NDArray[np.bool_]
    undecided: Integers
    orbits: Integers
    codes: Integers

    @cached_property
    def motions(self) -> Integers:
        """Number of them all: rest, orbits, and what is aperiodic as one."""
        return self.rest.astype(np.int64) + self.aperiodic + self.orbits

    @cached_property
    def classes(self) -> dict[OrbitClass, int]:
        """Number of cells in which orbits of a class were found."""
        cells = self.codes.reshape(len(self.codes), -1).T.tolist()
        counts = Counter(code for cell in cells for code in set(cell) if code)
        return {OrbitClass.of(code): count for code, count in sorted(counts.items())}

    def having(self, test: Callable[[OrbitClass], bool]) -> NDArray[np.bool_]:
        """Return where there is an orbit of a class that passes a test."""
        wanted = [kind.code for kind in self.classes if test(kind)]
        return np.asarray(np.isin(self.codes, wanted).any(axis=0), dtype=np.bool_)

    def text_at(self, row: int, column: int) -> str:
        """Return the orbits of a cell, as tables have them."""
        codes = self.codes[:, row, column].tolist()
        return " ".join(OrbitClass.of(code).text for code in codes if code)


def coexistence(
    plane: Plane,
    *,
    run: Execution | None = None,
) -> Coexistence:
    """Return what motions from many starts settle to, cell by cell.

    A search: what has a small basin may be missed, so that the counts are lower bounds.

    Parameters
    ----------
    plane
        Where.
    run
        As for `rocksteady.sweeps.evaluate`.
    """
    grid = Grid(
        axes=(
            Axis(name="amplitude", values=plane.amplitudes),
            Axis(name="frequency_ratio", values=plane.ratios),
        )
    )
    cases = functools.partial(_found, restitution=plane.restitution)
    data = evaluate(cases, grid, OUTPUTS, run=run)
    return Coexistence(
        plane=plane,
        rest=data["rest"].values,
        aperiodic=data["aperiodic"].values,
        undecided=data["undecided"].values,
        orbits=data["orbits"].values,
        codes=np.array([data[f"code_{place}"].values for place in range(MOST)]),
    )


def starts(amplitude: Floats, ratio: Floats, restitution: float) -> Iterator[Upright]:
    """Yield the initial states, all of angle 0: the velocity and the phase in every cell.

    Parameters
    ----------
    amplitude, ratio
        Amplitude and frequency ratio of the cells, shape (cells,).
    restitution
        Restitution of all blocks.
    """
    still = np.zeros(len(amplitude))
    for k in range(REST_PHASES):
        yield still, np.full(len(amplitude), k * math.pi / REST_PHASES)
    for order, branch in STEADY:
        states = steady_states(amplitude, ratio, restitution, order=order)
        assert states.admissible is not None
        admissible = states.admissible[branch - 1]
        phase = np.where(admissible, states.phase[branch - 1], 0.0)
        velocity = np.where(admissible, states.velocity[branch - 1], 0.0)
        for aside in (1.0 - ASIDE, 1.0 + ASIDE):  # at rest where there is no such state
            yield aside * velocity, phase
    beta = amplitude / (1.0 + ratio * ratio)
    for k in range(PHASES):
        turn = 2.0 * math.pi * (k + 0.5) / PHASES
        # A faster block flies off for good: the growing part of its flight is positive.
        fastest = 1.0 - beta * (sin(turn) + ratio * cos(turn))
        for j in range(SPEEDS):
            speed = np.maximum(fastest, SLOWEST) * (j + 0.5) / SPEEDS
            yield speed, np.full(len(amplitude), turn)


def _found(
    amplitude: Floats, frequency_ratio: Floats, *, restitution: float
) -> dict[str, NDArray[Any]]:
    """Return what the motions in some cells settle to."""
    settled = [
        find_attractors(
            amplitude,
            frequency_ratio,
            restitution,
            velocity=velocity,
            phase=phase,
            max_cycles=CYCLES,
        )
        for velocity, phase in starts(amplitude, frequency_ratio, restitution)
    ]

    def each(which: AttractorKind) -> NDArray[np.bool_]:
        return np.stack([attractors.are(which) for attractors in settled])

    def any_of(which: AttractorKind) -> NDArray[np.bool_]:
        return np.asarray(each(which).any(axis=0))

    codes = _codes(settled, each(AttractorKind.UNSYMMETRIC))
    undecided = each(AttractorKind.UNDECIDED).sum(axis=0)
    return {
        "rest": any_of(AttractorKind.REST),
        "aperiodic": any_of(AttractorKind.APERIODIC),
        "undecided": undecided.astype(np.int32),
        "orbits": np.array([len(cell_codes) for cell_codes in codes], dtype=np.int32),
        **{
            f"code_{place}": np.array(
                [cell_codes[place] if place < len(cell_codes) else 0 for cell_codes in codes],
                dtype=np.int64,
            )
            for place in range(MOST)
        },
    }


def _codes(settled: list[Attractors], unsymmetric: NDArray[np.bool_]) -> list[list[int]]:
    """Return, for each cell, the classes of the different orbits that its motions settle to.

    Orbits are one where class and extrema agree; of mirror images the extrema change sides.
    """
    period, passages, rests, highest, lowest = (
        np.array([getattr(each, name) for each in settled])
        for name in ("period", "passages", "rests", "highest", "lowest")
    )
    impacts = np.where(rests > 0, INFINITELY_MANY, passages)
    codes = np.where(period > 0, 2 * (ROOM * period + 1 + impacts) + unsymmetric, 0)
    larger, smaller = np.maximum(highest, -lowest), np.minimum(highest, -lowest)
    lists = []
    for cell in range(codes.shape[1]):
        here = np.flatnonzero(codes[:, cell])
        order = here[np.lexsort((smaller[here, cell], larger[here, cell], codes[here, cell]))]
        ranked, near = codes[order, cell], SAME * larger[order[1:], cell]
        new = (
            (np.diff(ranked) != 0)
            | (np.diff(larger[order, cell]) > near)
            | (np.abs(np.diff(smaller[order, cell])) > near)
        )
        lists.append([*ranked[:1].tolist(), *ranked[1:][new].tolist()])
    return lists
