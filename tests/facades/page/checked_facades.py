"""Facades that the tests of pages and plots draw, with their checks."""

import functools

from rocksteady.facades.checks.actions import Load, PushingMass, Thrust, Tie
from rocksteady.facades.checks.check_facade import check_facade
from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_check import FacadeCheck
from rocksteady.facades.checks.facade_demand import FacadeDemand
from rocksteady.facades.checks.facade_runs import run_facade
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.risk.spectra.elastic_spectrum import ElasticSpectrum

SUITE = make_synthetic_suite(7)


def site(ag_g: float) -> ElasticSpectrum:
    return ElasticSpectrum(ag_g=ag_g, f0=2.5, tc_star_s=0.35, soil="B")


@functools.cache
def tied() -> FacadeCheck:
    """Return a wall with all that may act on it, every limit state and seven records."""
    wall = Facade(
        name="Fronte <A> & B",
        thickness_m=0.5,
        height_m=4.0,
        length_m=6.0,
        hinge_inset_m=0.03,
        loads=(Load(name="copertura", weight_kn=24.0, x_m=0.3, z_m=4.0),),
        masses=(PushingMass(name="volta", weight_kn=12.0, z_m=1.8),),
        ties=(Tie(name="catene", force_kn=10.0, z_m=3.6, until_collapse=True),),
        thrusts=(Thrust(name="puntoni", force_kn=4.0, z_m=3.9),),
    )
    demand = FacadeDemand(sld=site(0.06), slv=site(0.18), slc=site(0.24))
    return check_facade(wall, demand, runs=run_facade(wall, SUITE, pga_g=0.35))


@functools.cache
def thin() -> FacadeCheck:
    """Return a wall of 0.3 x 3 m that goes beyond d0 under one record of seven."""
    wall = Facade(name="fronte", thickness_m=0.3, height_m=3.0)
    runs = run_facade(wall, SUITE, pga_g=0.3)
    return check_facade(wall, FacadeDemand(slv=site(0.15)), runs=runs)


@functools.cache
def alone() -> FacadeCheck:
    """Return a gable without a demand."""
    return check_facade(
        Facade(name="timpano", kind="gable", thickness_m=0.4, height_m=3.0, length_m=8.0)
    )
