"""Runs of samples, in the way of either model."""

from rocksteady.kernels.core.tables import Floats, March
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.march._samples import fly_through, rest_through
from rocksteady.kernels.nonlinear.samples import fly_through as fly_through_nonlinear
from rocksteady.kernels.nonlinear.samples import rest_through as rest_through_nonlinear


@inlined
def fly_on(
    tables: Tables,
    state: March,
    until: Until,
    kept: Kept,
    work: Floats,
    ride: Floats,
    nonlinear: bool,
) -> tuple[March, bool, bool]:
    """Fly through the samples to come, in the model's own way.

    The model is an argument, so that each loop of the march holds its own case alone.
    """
    if nonlinear:
        return fly_through_nonlinear(tables, state, until, kept, work, ride)
    return fly_through(tables, state, until, kept)


@inlined
def rest_on(
    tables: Tables, segment: int, flights: int, limit: int, rows: Floats, nonlinear: bool
) -> tuple[int, int]:
    """Rest through the samples to come, in the model's own way."""
    if nonlinear:
        return rest_through_nonlinear(tables, segment, flights, limit, rows)
    return rest_through(tables, segment, flights, limit, rows)
