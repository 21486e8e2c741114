"""Demand on a facade: a spectrum for each limit state."""

import itertools
from dataclasses import dataclass
from typing import Literal, Protocol

from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.spectra.elastic_spectrum import ElasticSpectrum

LimitState = Literal["SLD", "SLV", "SLC"]


class DemandSpectrum(Protocol):
    """Demand of a limit state: an elastic spectrum, a table, or the spectra of records."""

    def sa_g(self, period_s: float, damping: float) -> float:
        """Return the spectral acceleration [g] at a period [s]; the peak at period 0."""

    def displacement_m(self, period_s: float, damping: float) -> float:
        """Return the displacement demand [m] at a secant period [s]."""


@checked
@dataclass(frozen=True, kw_only=True)
class FacadeDemand:
    """Spectra at the base of a facade, one for each limit state.

    Parameters
    ----------
    sld, slv, slc
        `ElasticSpectrum` at the ground, `SpectrumTable` of the ground or of a floor, or
        `RecordDemand`; None (default) where a limit state is not checked.

    Raises
    ------
    InputError
        If one is no spectrum.
    ModelError
        If an elastic spectrum has a larger a_g than that of a rarer limit state.

    Examples
    --------
    >>> from rocksteady.codes import ElasticSpectrum
    >>> rock = ElasticSpectrum(ag_g=0.2, f0=2.5, tc_star_s=0.3, soil="A")
    >>> FacadeDemand(slv=rock).given
    ('SLV',)
    """

    sld: DemandSpectrum | None = None
    slv: DemandSpectrum | None = None
    slc: DemandSpectrum | None = None

    def __post_init__(self) -> None:
        """Refuse limit states in a wrong order: a rarer earthquake has no smaller a_g."""
        states = {"sld": self.sld, "slv": self.slv, "slc": self.slc}
        sites = [(key, site) for key, site in states.items() if isinstance(site, ElasticSpectrum)]
        for (key, site), (rarer, rarer_site) in itertools.pairwise(sites):
            if site.ag_g > rarer_site.ag_g:
                raise ModelError(
                    f"ag_g of {key}",
                    Words(f"is {site.ag_g:g}, above that of {rarer}, {rarer_site.ag_g:g}"),
                    "SLD, SLV and SLC are earthquakes of rising return periods",
                    f"check whether {key} and {rarer} are exchanged",
                )

    @property
    def given(self) -> tuple[LimitState, ...]:
        """The limit states that have a demand."""
        states: tuple[LimitState, ...] = ("SLD", "SLV", "SLC")
        return tuple(state for state in states if self.of(state) is not None)

    def of(self, limit_state: LimitState) -> DemandSpectrum | None:
        """Return the spectrum of a limit state; None without.

        Parameters
        ----------
        limit_state
            "SLD", "SLV" or "SLC".

        Raises
        ------
        InputError
            If it is none of them.
        """
        return {"SLD": self.sld, "SLV": self.slv, "SLC": self.slc}[limit_state]
