"""Checks of a facade by the circular: linear, nonlinear static and dynamic side by side."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from rocksteady.errors import InputError, RocksteadyError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import number
from rocksteady.risk.facades.elastic_spectrum import LONGEST_NTC_S, ElasticSpectrum
from rocksteady.risk.facades.facade import Facade
from rocksteady.risk.facades.facade_check import Check, FacadeCheck, Method
from rocksteady.risk.facades.facade_demand import DemandSpectrum, FacadeDemand, LimitState
from rocksteady.risk.facades.facade_runs import FEWEST, FacadeRuns
from rocksteady.risk.facades.mechanism import Mechanism
from rocksteady.risk.facades.remark import Remark
from rocksteady.risk.facades.spectrum_table import SpectrumTable
from rocksteady.risk.screens.spectra import damping_factor

BEHAVIOUR_FACTOR: Final = 2.0
"""Behaviour factor q of the linear check of SLV."""
PEAK_DAMPING: Final = 0.05
"""Damping at period 0, where it changes nothing."""
DAMPINGS: Final = {"SLV": 0.08, "SLC": 0.1}
"""Damping of the nonlinear static check by the limit state."""


@checked
def check_facade(
    facade: Facade, demand: FacadeDemand | None = None, *, runs: FacadeRuns | None = None
) -> FacadeCheck:
    """Check a facade by the linear, nonlinear static and dynamic methods of C8.7.1.

    =====  ================  ==========  ==================================================
    SLD    linear            C8.7.1.8    S_e(0) <= a0
    SLV    linear            q = 2       S_e(0)/q <= a0
    SLV    nonlinear static  C8.7.1.12   S_e(T_SLV) T_SLV^2/(4 pi^2) <= d_SLV, 8 % damping
    SLC    nonlinear static  C8.7.1.12   S_e(T_SLC) T_SLC^2/(4 pi^2) <= d_SLC, 10 % damping
    SLV    dynamic           2.1.9       no run beyond d0, mean largest d <= d_SLV (d_SLC)
    =====  ================  ==========  ==================================================

    Parameters
    ----------
    facade
        The facade.
    demand
        Spectra of the limit states; without, capacities alone.
    runs
        Runs under 7 or more records, from `rocksteady.run_facade`; without, no dynamic check.

    Returns
    -------
    FacadeCheck
        A check for each line above, `satisfied` None where no demand is given.

    Raises
    ------
    InputError
        If the runs are those of another facade.
    ModelError
        If a period lies outside a table.

    References
    ----------
    Circolare 21 gennaio 2019 n. 7, C8.7.1.2.1, pp. 272-277, from an unreviewed transcription.

    Examples
    --------
    >>> from rocksteady import ElasticSpectrum
    >>> wall = Facade(name="front", thickness_m=0.3, height_m=3.0)
    >>> site = ElasticSpectrum(ag_g=0.15, f0=2.5, tc_star_s=0.35, soil="B")
    >>> check = check_facade(wall, FacadeDemand(slv=site))
    >>> print(check.verdict)
    front: SLV satisfied (linear), not satisfied (nonlinear static)
    """
    given = FacadeDemand() if demand is None else demand
    if runs is not None and runs.facade != facade:
        raise InputError(
            "runs",
            Words(f"are those of another facade, {runs.facade.name}"),
            f"{facade.name} is checked by its own",
            "run this facade with run_facade",
        )
    return FacadeCheck(
        facade=facade,
        demand=given,
        runs=runs,
        checks=tuple(_checks(facade.mechanism, given, runs)),
    )


def _checks(mechanism: Mechanism, demand: FacadeDemand, runs: FacadeRuns | None) -> Iterator[Check]:
    """Yield the checks in the order of the table."""
    yield _peak(mechanism, "SLD", demand.sld, "C8.7.1.8", 1.0)
    yield _peak(mechanism, "SLV", demand.slv, "C8.7.1, q = 2", BEHAVIOUR_FACTOR)
    yield _secant("SLV", demand.slv, "C8.7.1.10, 12", mechanism.t_slv_s, mechanism.d_slv_m)
    yield _secant("SLC", demand.slc, "C8.7.1.11, 12", mechanism.t_slc_s, mechanism.d_slc_m)
    yield _dynamic(mechanism, runs)


def _peak(
    mechanism: Mechanism,
    state: LimitState,
    spectrum: DemandSpectrum | None,
    formula: str,
    factor: float,
) -> Check:
    """Return a linear check: the peak of the acceleration against a0."""
    value, remarks = None, [Remark("no_demand", (state,))]
    if spectrum is not None:
        with _named(f"demand of {state}"):
            value = spectrum.sa_g(0.0, PEAK_DAMPING) / factor
        records = not isinstance(spectrum, ElasticSpectrum | SpectrumTable)
        remarks = [Remark("peak_of_records")] if records else []
        remarks += [Remark("q", (f"{factor:g}",))] if factor != 1.0 else []
    return _check(state, "linear", formula, value, mechanism.a0_g, remarks)


def _secant(
    state: LimitState,
    spectrum: DemandSpectrum | None,
    formula: str,
    period: float,
    capacity: float,
) -> Check:
    """Return a nonlinear static check: a displacement at the secant period."""
    value, remarks = None, [Remark("no_demand", (state,))]
    if spectrum is not None:
        damping = DAMPINGS[state]
        with _named(f"demand of {state} at T_{state}"):
            value = spectrum.displacement_m(period, damping)
        remarks = list(_how(spectrum, period, damping))
    return _check(state, "nonlinear static", formula, value, capacity, remarks)


@contextmanager
def _named(name: str) -> Iterator[None]:
    """Name the demand in the refusal of a period."""
    try:
        yield
    except RocksteadyError as error:
        raise type(error)(name, error.value, error.valid, error.hint) from None


def _how(spectrum: DemandSpectrum, period: float, damping: float) -> Iterator[Remark]:
    """Yield how a displacement follows from a spectrum."""
    if isinstance(spectrum, ElasticSpectrum):
        yield Remark("eta", (number(damping_factor(damping)), number(100.0 * damping)))
        if period > LONGEST_NTC_S:
            yield Remark("beyond_4_s", (number(period),))
    elif isinstance(spectrum, SpectrumTable):
        yield spectrum.remark(damping)
    else:
        yield Remark("records")


def _dynamic(mechanism: Mechanism, runs: FacadeRuns | None) -> Check:
    """Return the check of runs under records."""
    state: LimitState = "SLC" if runs is not None and runs.limit_state == "SLC" else "SLV"
    capacity = mechanism.d_slc_m if state == "SLC" else mechanism.d_slv_m
    value, remark = None, Remark("no_runs")
    if runs is not None:
        value = runs.mean_m
        remark = Remark("mean_of_runs")
        if value is None:
            remark = Remark("few_records", (f"{FEWEST}",))
        elif runs.beyond:
            value, remark = math.inf, Remark("beyond_d0", (", ".join(runs.beyond),))
    return _check(state, "dynamic", "C8.7.1.2.1.9", value, capacity, [remark])


def _check(
    state: LimitState,
    method: Method,
    formula: str,
    demand: float | None,
    capacity: float,
    remarks: list[Remark],
) -> Check:
    """Return a check: displacements in m, of the linear method accelerations in g."""
    linear = method == "linear"
    return Check(
        limit_state=state,
        method=method,
        formula=formula,
        quantity="acceleration" if linear else "displacement",
        unit="g" if linear else "m",
        demand=demand,
        capacity=capacity,
        satisfied=None if demand is None else demand <= capacity,
        remarks=tuple(remarks),
    )
