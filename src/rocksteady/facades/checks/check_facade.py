"""Checks of a facade by the circular: linear, nonlinear static and dynamic side by side."""

import math
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Final

from rocksteady.errors import InputError, ModelError, RocksteadyError, Words
from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_check import FacadeCheck, LimitStateCheck, Method
from rocksteady.facades.checks.facade_demand import DemandSpectrum, FacadeDemand, LimitState
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.checks.mechanism import Mechanism
from rocksteady.facades.checks.record_demand import FEWEST
from rocksteady.facades.checks.remark import Remark
from rocksteady.facades.checks.spectrum_table import SpectrumTable
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import number
from rocksteady.risk.spectra.elastic_spectrum import LONGEST_NTC_S, ElasticSpectrum, damping_factor

LEAST_PGA = 0.9
"""Mean PGA of records over that of the demand, below which their runs are no answer."""
BEHAVIOUR_FACTOR: Final = 2.0
"""Behaviour factor q of the linear check of SLV."""
ELASTIC_DAMPING: Final = 0.05
"""Damping of the linear checks; at period 0 it changes nothing."""
DAMPINGS: Final = {"SLV": 0.08, "SLC": 0.1}
"""Damping of the nonlinear static check by the limit state."""


@checked
def check_facade(
    facade: Facade, demand: FacadeDemand | None = None, *, runs: FacadeRuns | None = None
) -> FacadeCheck:
    """Check a facade by the linear, nonlinear static and dynamic methods of C8.7.1.

    =====  ================  ==========  ==================================================
    SLD    linear            C8.7.1.8    S_e(0) <= min a0
    SLV    linear            q = 2       S_e(0)/q <= min a0
    SLV    nonlinear static  C8.7.1.12   S_D(T_SLV) <= d_SLV, 8 % damping
    SLC    nonlinear static  C8.7.1.12   S_D(T_SLC) <= d_SLC, 10 % damping
    SLV    dynamic           2.1.9       no run beyond d0, mean largest d <= d_SLV (d_SLC)
    =====  ================  ==========  ==================================================

    S_D(T) is S_e(T) T^2/(4 pi^2), and min a0 the smaller a0 of the two of `Mechanism`.

    An element free to vibrate (`Facade.free`) has C8.7.1.9 in place of the linear checks:
    S_e(T0, z) <= alpha_0 g/FC with 5 % damping, for SLD and SLV.  Its spectra are those at its
    height z.

    Parameters
    ----------
    facade
        The facade.
    demand
        Spectra of the limit states; without, capacities alone.
    runs
        Runs under 7 or more records, from `rocksteady.codes.run_facade`; without, no dynamic check.

    Returns
    -------
    FacadeCheck
        A check for each line above, `satisfied` None where no demand is given.

    Raises
    ------
    InputError
        If the runs are those of another facade.
    ModelError
        If a period lies outside a table, the height or T0 of the facade is needed and not known, or
        a spectrum of the ground is given for one above.

    References
    ----------
    Circolare 21 gennaio 2019 n. 7, C8.7.1.2.1, pp. 272-277: not checked against the printed text.

    Examples
    --------
    >>> from rocksteady.codes import ElasticSpectrum
    >>> wall = Facade(name="front", thickness_m=0.3, height_m=3.0)
    >>> site = ElasticSpectrum(ag_g=0.13, f0=2.5, tc_star_s=0.35, soil="B")
    >>> check = check_facade(wall, FacadeDemand(slv=site))
    >>> print(check.verdict)
    front: SLV satisfied (nonlinear static), not satisfied (linear)
    """
    given = FacadeDemand() if demand is None else demand
    if runs is not None and runs.facade != facade:
        raise InputError(
            "runs",
            Words(f"are those of another facade, {runs.facade.name}"),
            f"{facade.name} is checked by its own",
            "run this facade with run_facade",
        )
    if given.given:
        _check_inputs(facade, given)
    return FacadeCheck(
        facade=facade, demand=given, runs=runs, checks=tuple(_checks(facade, given, runs))
    )


def _check_inputs(facade: Facade, demand: FacadeDemand) -> None:
    """Check that height, T0 and spectrum of the element are known, before anything is compared."""
    height = facade.base_height_m
    if height is None and (facade.free or facade.kind != "wall"):
        raise ModelError(
            f"base_height_m of {facade.name}",
            Words("is not given"),
            f"the demand on a {facade.kind} is the spectrum at its height above the ground",
            "give base_height_m, 0 where it stands on the ground",
        )
    if facade.free and facade.t0_s is None:
        carries = bool(facade.loads or facade.masses)
        raise ModelError(
            f"{'elastic_period_s' if carries else 'elastic_modulus_mpa'} of {facade.name}",
            Words("is not given"),
            f"a {facade.kind} that is free to vibrate is checked at its period T0 (C8.7.1.9)"
            + (", whose formula leaves out what it carries" if carries else ""),
            "give elastic_period_s" + ("" if carries else ", or the modulus of the masonry in MPa"),
        )
    for state in demand.given:
        if height and isinstance(demand.of(state), ElasticSpectrum):
            raise ModelError(
                f"demand of {state}",
                Words(f"is a spectrum of the ground, and {facade.name} stands at {height:g} m"),
                "the building amplifies the motion of the ground",
                "give the spectrum of the floor as a table",
            )


def _checks(
    facade: Facade, demand: FacadeDemand, runs: FacadeRuns | None
) -> Iterator[LimitStateCheck]:
    """Yield the checks in the order of the table."""
    mechanism = facade.mechanism
    if facade.free:
        yield _free(facade, "SLD", demand.sld)
        yield _free(facade, "SLV", demand.slv)
    else:
        yield _peak(mechanism, "SLD", demand.sld, "C8.7.1.8", 1.0)
        yield _peak(mechanism, "SLV", demand.slv, "C8.7.1, q = 2", BEHAVIOUR_FACTOR)
    yield _secant("SLV", demand.slv, "C8.7.1.10, 12", mechanism.t_slv_s, mechanism.d_slv_m)
    yield _secant("SLC", demand.slc, "C8.7.1.11, 12", mechanism.t_slc_s, mechanism.d_slc_m)
    yield _dynamic(mechanism, runs, demand)


def _peak(
    mechanism: Mechanism,
    state: LimitState,
    spectrum: DemandSpectrum | None,
    formula: str,
    factor: float,
) -> LimitStateCheck:
    """Return a linear check: the peak of the acceleration against a0."""
    value, remarks = None, [Remark("no_demand", (state,))]
    if spectrum is not None:
        with _named(f"demand of {state}"):
            value = spectrum.sa_g(0.0, ELASTIC_DAMPING) / factor
        records = not isinstance(spectrum, ElasticSpectrum | SpectrumTable)
        remarks = [Remark("peak_of_records")] if records else []
        remarks += [Remark("q", (f"{factor:g}",))] if factor != 1.0 else []
    names = ("S_e(0)" if factor == 1.0 else "S_e(0)/q", mechanism.linear_name)
    return _check(state, "linear", formula, value, mechanism.linear_g, remarks, names=names)


def _free(facade: Facade, state: LimitState, spectrum: DemandSpectrum | None) -> LimitStateCheck:
    """Return the check of an element free to vibrate: S_e(T0, 5 %) against alpha_0 g/FC."""
    value, remark = None, Remark("no_demand", (state,))
    period, mechanism = facade.t0_s, facade.mechanism
    if spectrum is not None and period is not None:
        with _named(f"demand of {state} at T0"):
            value = spectrum.sa_g(period, ELASTIC_DAMPING)
        remark = Remark("free", (number(period), number(facade.base_height_m or 0.0)))
    names = ("S_e(T0, z)", mechanism.linear_name)
    return _check(state, "linear", "C8.7.1.9", value, mechanism.linear_g, [remark], names=names)


def _secant(
    state: LimitState,
    spectrum: DemandSpectrum | None,
    formula: str,
    period: float,
    capacity: float,
) -> LimitStateCheck:
    """Return a nonlinear static check: a displacement at the secant period."""
    value, remarks = None, [Remark("no_demand", (state,))]
    if spectrum is not None:
        damping = DAMPINGS[state]
        with _named(f"demand of {state} at T_{state}"):
            value = spectrum.displacement_m(period, damping)
        remarks = list(_how(spectrum, period, damping))
    names = (f"S_D(T_{state})", f"d_{state}")
    return _check(state, "nonlinear static", formula, value, capacity, remarks, names=names)


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


def _dynamic(
    mechanism: Mechanism, runs: FacadeRuns | None, demand: FacadeDemand
) -> LimitStateCheck:
    """Return the check of runs under records; no answer under records weaker than the demand."""
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
        elif (weak := _weaker(runs, demand.of(state), state)) is not None:
            value, remark = None, weak
    names = ("mean d", f"d_{state}")
    return _check(state, "dynamic", "C8.7.1.2.1.9", value, capacity, [remark], names=names)


def _weaker(runs: FacadeRuns, spectrum: DemandSpectrum | None, state: LimitState) -> Remark | None:
    """Return a remark where the mean PGA of the records is below that of the demand."""
    peak = 0.0
    if spectrum is not None:
        with suppress(RocksteadyError):  # a table that does not begin at period 0
            peak = spectrum.sa_g(0.0, ELASTIC_DAMPING)
    mean = float(runs.pga_g.mean())
    if mean >= LEAST_PGA * peak:
        return None
    return Remark("weak_records", (number(mean), number(peak), state))


def _check(
    state: LimitState,
    method: Method,
    formula: str,
    demand: float | None,
    capacity: float,
    remarks: list[Remark],
    *,
    names: tuple[str, str],
) -> LimitStateCheck:
    """Return a check: displacements in m, of the linear method accelerations in g."""
    return LimitStateCheck(
        limit_state=state,
        method=method,
        formula=formula,
        demand_name=names[0],
        capacity_name=names[1],
        unit="g" if method == "linear" else "m",
        demand=demand,
        capacity=capacity,
        satisfied=None if demand is None else demand <= capacity,
        remarks=tuple(remarks),
    )
