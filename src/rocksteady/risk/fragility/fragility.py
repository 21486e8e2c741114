"""Fragility: counted shares of all damage states over levels, with the runs behind them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.results.result import Result
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.seismic.measures.scalar import Measure

if TYPE_CHECKING:
    import xarray


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Fragility(Result):
    """Fragility of blocks, from `rocksteady.compute_fragility`.

    Attributes
    ----------
    ensemble
        The runs.
    measure
        What the levels are in; None of plain factors.
    states
        Counted shares of each damage state, each containing the next.
    warnings
        Sentences on what limits the answer.
    records, runs
        Number of records and of runs; mirror images are runs that count once.
    friction, friction_needed
        Coefficient of friction that is given, and the one that rocking takes at the level where
        half reach the last state, or at the last level.
    slides_above
        Level above which it slides, where the levels end before it; else None.
    seconds
        Time that it took [s].
    """

    ensemble: "xarray.Dataset"
    measure: Measure | None
    states: tuple[StateFragility, ...]
    warnings: tuple[str, ...]
    records: int
    runs: int
    friction: float | None = None
    friction_needed: float | None = None
    slides_above: float | None = None
    seconds: float = 0.0

    @property
    def model(self) -> Model:
        """Equations of motion of the runs."""
        return Nonlinear() if self.ensemble.attrs["model"] == "nonlinear" else Linear()

    @property
    def key(self) -> str:
        """The measure's name in files."""
        return str(self.ensemble.attrs["measure"])

    @property
    def unit(self) -> str:
        """Unit of the levels; empty where they have none."""
        return "" if self.measure is None else self.measure.unit

    @property
    def scale_factor_max(self) -> float:
        """Largest factor of a record's accelerations."""
        return float(self.ensemble["scale"].max())

    def state(self, name: str) -> StateFragility:
        """Return the shares of a damage state.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        for each in self.states:
            if each.state.name == name:
                return each
        known = ", ".join(each.state.name for each in self.states)
        raise InputError("name", name, f"the damage states are {known}", "give one of them")
