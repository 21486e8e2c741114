"""Runs of samples, in the way of either model."""

from rocksteady.kernels.core.tables import Floats, March
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.march._samples import fly_through, rest_through
from rocksteady.kernels.nonlinear.samples import fly_through as fly_through_nonlinear
from rocksteady.kernels.nonlinear.samples import rest_through as rest_through_nonlinear


@inlined
def fly_on(
    segments: Floats,
    sides: Floats,
    state: March,
    limit: int,
    rows: Floats,
    peaks: Floats,
    work: Floats,
    nonlinear: bool,
) -> tuple[int, float, float, int, bool]:
    """Fly through the samples to come, in the model's own way.

    The model is an argument, so that each loop of the march holds its own case alone.
    """
    if nonlinear:
        return fly_through_nonlinear(
            segments,
            sides,
            state.side,
            state.angle,
            state.velocity,
            state.segment,
            state.flights,
            limit,
            rows,
            peaks,
            work,
        )
    return fly_through(
        segments,
        sides,
        state.side,
        state.angle,
        state.velocity,
        state.segment,
        state.flights,
        limit,
        rows,
        peaks,
    )


@inlined
def rest_on(
    segments: Floats,
    sides: Floats,
    segment: int,
    flights: int,
    limit: int,
    rows: Floats,
    nonlinear: bool,
) -> tuple[int, int]:
    """Rest through the samples to come, in the model's own way."""
    if nonlinear:
        return rest_through_nonlinear(segments, sides, segment, flights, limit, rows)
    return rest_through(segments, sides, segment, flights, limit, rows)
