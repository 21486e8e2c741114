"""Options of the fits to an ensemble."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.fits.bands import BandOptions
from rocksteady.risk.fragility.damage_states import DEFAULT_STATES, DamageState, state_of
from rocksteady.seismic.measures.scalar import Measure


@checked
@dataclass(frozen=True, kw_only=True)
class FitOptions:
    """Options of the curves that are fitted to an ensemble.

    Parameters
    ----------
    states
        Damage states: each a `DamageState`, the name of one, or a number for a theta/alpha that is
        exceeded; default uplift, 0.25, 0.5, 1 and overturned.
    family
        "lognormal" (default) or "logistic".
    bands
        Options of the confidence bands; default `BandOptions()`, None or no replicates for none.
    measures
        Measures whose efficiency is compared; by default all that the ensemble holds.

    Raises
    ------
    InputError
        If there is no state, or one comes twice.

    Examples
    --------
    >>> from rocksteady.risk import FitOptions
    >>> [state.name for state in FitOptions(states=["uplift", 0.4, "overturned"]).states]
    ['uplift', 'theta/alpha > 0.4', 'overturned']
    """

    states: Sequence[DamageState | float | str] = DEFAULT_STATES
    family: Literal["lognormal", "logistic"] = "lognormal"
    bands: BandOptions | None = BandOptions()  # noqa: RUF009 -- it is frozen
    measures: Sequence[Measure] | None = None

    def __post_init__(self) -> None:
        """Validate."""
        states = tuple(state_of(state) for state in self.states)
        names = [state.name for state in states]
        twice = next((name for name in names if names.count(name) > 1), None)
        if not states or twice is not None:
            raise InputError(
                "states",
                twice,
                "there is one damage state or more, each once",
                "give states, as ['uplift', 0.5, 'overturned']",
            )
        object.__setattr__(self, "states", states)
        if self.bands is not None and not self.bands.replicates:
            object.__setattr__(self, "bands", None)
        if self.measures is not None:
            object.__setattr__(self, "measures", tuple(self.measures))

    @property
    def damage_states(self) -> tuple[DamageState, ...]:
        """The states, each as a `DamageState`."""
        return tuple(state_of(state) for state in self.states)
