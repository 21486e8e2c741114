"""A study of nine walls at two levels, computed once for all tests of a process."""

from functools import cache

from rocksteady.motions import make_synthetic_suite
from rocksteady.studies.facade_checks._plane import Plane
from rocksteady.studies.facade_checks.study import FacadeChecks, facade_checks, plane_of

HEIGHTS_M, SLENDERNESS, PGA_G = [2.0, 6.0, 11.0], [7.0, 13.0, 19.0], [0.15, 0.35]


@cache
def plane(factor: float = 1.0) -> Plane:
    return plane_of(
        make_synthetic_suite(8),
        height_m=HEIGHTS_M,
        slenderness=SLENDERNESS,
        pga_g=PGA_G,
        confidence_factor=factor,
    )


@cache
def study(factor: float = 1.0) -> FacadeChecks:
    return facade_checks(plane(factor))
