"""What the cells of the map do: the package's answer, settled in many digits where it matters."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from bench.peers import kernel
from bench.peers.reference import Fate, exact_fate
from bench.peers.work import OVERTURNED, TURN, Cells, Outcome, cells

WORST = 10  # last impacts of each solver that are settled


class Truth:
    """Fates of the whole map, by cell."""

    def __init__(self) -> None:
        self.cells = cells()
        outcome, flights = kernel.scalar(self.cells), kernel.record(self.cells)
        self.flights = flights
        self.overturned = outcome.status == OVERTURNED
        self.impacts = outcome.impacts.copy()
        self.last_phase = flights.last_phase.copy()
        # Cells that come to rest at some time: how many bounces they make is a matter of the rule.
        self.rested = flights.rested
        self.settled = np.zeros(len(self.impacts), bool)

    def settle(self, which: Iterable[int], digits: int) -> list[Fate]:
        """March some cells in so many digits and believe that."""
        fates = []
        for i in which:
            fate = exact_fate(self.cells.amplitude[i], self.cells.frequency_ratio[i], digits)
            self.overturned[i] = fate.status == OVERTURNED
            self.impacts[i], self.last_phase[i] = fate.impacts, fate.last_phase
            self.settled[i] = True
            fates.append(fate)
        return fates

    def disputed(self, own: Cells, outcome: Outcome) -> set[int]:
        """Return the cells in which a solver says otherwise or has its worst last impacts."""
        at = own.index
        counted = ~self.rested[at]
        wrong = (outcome.status == OVERTURNED) != self.overturned[at]
        wrong |= counted & (outcome.impacts != self.impacts[at])
        found = set(at[wrong].tolist())
        if outcome.last_phase is not None:
            off = np.nan_to_num(apart(outcome.last_phase, self.last_phase[at]))
            off[wrong | ~counted] = 0.0
            found.update(at[np.argsort(-off)[:WORST]].tolist())
        return found

    def agreement(self, own: Cells, outcome: Outcome) -> dict[str, object]:
        """Return what a solver got right."""
        at = own.index
        return agreement(
            overturned=self.overturned[at],
            impacts=self.impacts[at],
            last_phase=self.last_phase[at],
            counted=~self.rested[at],
            status=outcome.status,
            found_impacts=outcome.impacts,
            found_phase=outcome.last_phase,
        )

    def own_agreement(self, outcome: Outcome) -> dict[str, object]:
        """Return what the package got right among the cells that were settled without it."""
        at = np.flatnonzero(self.settled)
        chosen = Cells(self.cells.amplitude[at], self.cells.frequency_ratio[at], at)
        phases = kernel.last_phases(self.cells, outcome, self.flights)
        return self.agreement(
            chosen,
            Outcome(
                status=outcome.status[at],
                impacts=outcome.impacts[at],
                last_phase=phases[at],
                seconds=outcome.seconds,
            ),
        )


def agreement(
    *,
    overturned: NDArray[np.bool_],
    impacts: NDArray[np.int64],
    last_phase: NDArray[np.float64],
    counted: NDArray[np.bool_],
    status: NDArray[np.int64],
    found_impacts: NDArray[np.int64],
    found_phase: NDArray[np.float64] | None,
) -> dict[str, object]:
    """Return what a solver got right, from what is right and what it found, one value a cell."""
    same = found_impacts == impacts
    found: dict[str, object] = {
        "same_class": share((status == OVERTURNED) == overturned),
        "same_impacts": share(same[counted]),
    }
    if found_phase is not None:
        off = apart(found_phase, last_phase)[counted & same & (impacts > 0)]
        found["last_impact"] = {"median": float(np.median(off)), "largest": float(off.max())}
    return found


def share(right: NDArray[np.bool_]) -> float:
    """Return the share of cells."""
    return float(np.mean(right))


def apart(phases: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance of phases on the circle."""
    return np.abs((phases - right + 0.5 * TURN) % TURN - 0.5 * TURN)
