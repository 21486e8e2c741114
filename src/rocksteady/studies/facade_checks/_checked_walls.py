"""The three checks of every wall of the plane, and the dynamic one by other assumptions."""

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady import Execution, Linear, Nonlinear, Status, simulate_many
from rocksteady.arrays import Floats
from rocksteady.codes import RecordDemand
from rocksteady.studies.facade_checks._plane import Plane
from rocksteady.sweeps import Axis, Grid, Output, evaluate

Model = Linear | Nonlinear
Kept = Callable[[str], Execution]
"""Returns how a part of the study is run, and where it is kept."""

Q = 2.0
"""Behaviour factor of the linear check."""
DAMPING = 0.08
"""Of the nonlinear static check of SLV."""
SHARE = 0.4
"""d_SLV over d0."""
GRAVITY = 9.80665
METHODS = ("linear", "nonlinear static", "dynamic")
"""In the order of the checks; the first weighs 4 in a class, the last 1."""
COMES_BACK = (int(Status.AT_REST), int(Status.ROCKING))


@dataclass(frozen=True, kw_only=True, eq=False)
class Dynamics:
    """Runs of all walls by one model and restitution.

    Attributes
    ----------
    name
        Equations of motion and restitution.
    levels
        Places of its levels among those of the plane.
    share
        Largest displacement over d0 of each wall, record and level, of the worse sign, infinite
        without a return: shape (levels, rows, columns, records).
    undecided
        Number of runs whose end is not known, which count as beyond d0.
    """

    name: str
    levels: tuple[int, ...]
    share: Floats
    undecided: int

    @property
    def beyond(self) -> NDArray[np.int64]:
        """Number of records with a run beyond d0, shape (levels, rows, columns)."""
        counts: NDArray[np.int64] = (self.share > 1.0).sum(axis=-1)
        return counts

    @property
    def ratio(self) -> Floats:
        """Mean over d_SLV, infinite where a run goes beyond d0, shape (levels, rows, columns)."""
        return np.where(self.beyond > 0, np.inf, self.share.mean(axis=-1) / SHARE)


@dataclass(frozen=True, kw_only=True, eq=False)
class CheckedWalls:
    """Demand over capacity of all walls, as arrays of shape (levels, rows, columns).

    Attributes
    ----------
    plane
        The walls, their records and levels.
    linear
        Result of the linear check.
    spectral
        Largest S_D up to T_SLV over d_SLV, of each record: shape (levels, rows, columns, records).
    dynamics
        Runs by the full equations and Housner's restitution, then by other assumptions at the
        middle level.
    """

    plane: Plane
    linear: Floats
    spectral: Floats
    dynamics: tuple[Dynamics, ...]

    @property
    def static(self) -> Floats:
        """Demand over capacity of the nonlinear static check."""
        mean: Floats = self.spectral.mean(axis=-1)
        return mean

    @property
    def dynamic(self) -> Floats:
        """Demand over capacity of the dynamic check."""
        return self.dynamics[0].ratio

    @property
    def ratios(self) -> dict[str, Floats]:
        """Demand over capacity by the method."""
        return dict(zip(METHODS, (self.linear, self.static, self.dynamic), strict=True))

    @property
    def classes(self) -> NDArray[np.int64]:
        """4 where the linear check accepts, plus 2 of the static and 1 of the dynamic one."""
        accepts = [(ratio <= 1.0).astype(np.int64) for ratio in self.ratios.values()]
        return 4 * accepts[0] + 2 * accepts[1] + accepts[2]


VARIANTS: dict[str, tuple[Model, float | Literal["housner"]]] = {
    "nonlinear, Housner": (Nonlinear(), "housner"),
    "linear, Housner": (Linear(), "housner"),
    "nonlinear, e = 0": (Nonlinear(), 0.0),
    "nonlinear, e = 0.8": (Nonlinear(), 0.8),
}
"""Equations of motion and restitution of the runs; the first are those of the dynamic check."""


def checked_walls(plane: Plane, *, kept: Kept, done: Callable[[str], None]) -> CheckedWalls:
    """Return the three checks of all walls.

    Parameters
    ----------
    plane
        Walls, records and levels.
    kept
        Returns the `Execution` of a part, by its name.
    done
        Called with the name of each part.
    """
    walls = plane.walls()
    shape = (len(plane.heights_m), len(plane.slendernesses))
    levels = plane.levels_g[:, np.newaxis, np.newaxis]
    capacity, d_slv = (
        np.array([getattr(wall.mechanism, name) for wall in walls]).reshape(shape)
        for name in ("linear_g", "d_slv_m")
    )
    per_g = _spectral(plane, kept("spectra"))[:, np.newaxis]
    done("spectra")
    dynamics = []
    for place, (name, how) in enumerate(VARIANTS.items()):
        chosen = (plane.middle,) if place else tuple(range(len(plane.levels_g)))
        dynamics.append(_runs(plane, name, how, chosen, kept(f"runs-{place}")))
        done(f"runs: {name}")
    return CheckedWalls(
        plane=plane,
        linear=levels / Q / capacity,
        spectral=levels[..., np.newaxis] * per_g / d_slv[..., np.newaxis],
        dynamics=tuple(dynamics),
    )


def steps() -> int:
    """Return the number of times that `checked_walls` calls `done`."""
    return 1 + len(VARIANTS)


def scaled(plane: Plane, pga_g: float) -> tuple[RecordDemand, list[float]]:
    """Return the demand of the records at a level of PGA [g], and the factor of each."""
    factors = [pga_g * GRAVITY / each.peak_acceleration_m_s2 for each in plane.records]
    pairs = zip(plane.records, factors, strict=True)
    return RecordDemand(records=tuple(each.scaled(by) for each, by in pairs)), factors


def _spectral(plane: Plane, run: Execution) -> Floats:
    """Return the largest S_D up to T_SLV at a PGA of 1 g [m], shape (rows, records).

    A bare wall's T_SLV follows from its height alone.
    """
    periods = [plane.wall(row, 0).mechanism.t_slv_s for row in range(len(plane.heights_m))]
    outputs = [Output(name=f"record_{place}") for place in range(len(plane.records))]
    grid = Grid(axes=(Axis(name="period", values=periods, units="s"),))
    dataset = evaluate(
        functools.partial(_largest, demand=scaled(plane, 1.0)[0]), grid, outputs, run=run
    )
    return np.stack([dataset[each.name].values for each in outputs], axis=-1)


def _largest(period: Floats, *, demand: RecordDemand) -> dict[str, Floats]:
    """Return the largest S_D [m] of each record up to each period."""
    values = np.array([demand.displacements_m(each, DAMPING) for each in period.tolist()])
    return {f"record_{place}": column for place, column in enumerate(values.T)}


def _runs(
    plane: Plane,
    name: str,
    how: tuple[Model, float | Literal["housner"]],
    levels: tuple[int, ...],
    run: Execution,
) -> Dynamics:
    """Return the runs of all walls at some levels."""
    model, restitution = how
    walls = [replace(wall, restitution=restitution) for wall in plane.walls()]
    dataset = simulate_many(
        [wall.mechanism.block() for wall in walls],
        list(plane.records),
        # Of a bare wall the base acceleration is multiplied by FC alone.
        pga_g=plane.levels_g[list(levels)] * walls[0].mechanism.base_factor,
        reverse="both",
        model=model,
        run=run,
    )
    status, tilt = dataset["status"].values, dataset["peak_angle"].values
    share: Floats = np.where(np.isin(status, COMES_BACK), tilt, np.inf).max(axis=2)
    shape = (len(levels), len(plane.heights_m), len(plane.slendernesses), len(plane.records))
    return Dynamics(
        name=name,
        levels=levels,
        share=np.moveaxis(share, 2, 0).reshape(shape),
        undecided=int((~np.isin(status, (*COMES_BACK, int(Status.OVERTURNED)))).sum()),
    )
