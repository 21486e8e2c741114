"""Pictures of what the calls of plots do not show: other data, for the other branches of a plot."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

import rocksteady as rs
from rocksteady import plots
from tests.public.things import things
from tests.show.drawn_figures import BARE, BLOCK, SHAKING, resting, rocking, shock, vertical_too
from tests.show.drawn_maps import found, random_map
from tests.show.plots.branches.test_bifurcations import (
    curves,
    diagram_of,
    over_amplitude,
    over_frequency,
    sweeps,
)
from tests.show.plots.test_read_back import CASES, everything

WALLED = BLOCK.against_wall()
RICKER = rs.Pulse(shape="ricker", amplitude=2.5, frequency_ratio=3.0)
KICKS = rs.motions.Impulses(velocities=(0.5, -0.7), times=(0.0, 1.0))
FAST = rs.Harmonic(amplitude=2.0, frequency_ratio=2.2)
PLANE = {"amplitude": np.linspace(0.2, 6.0, 20), "frequency_ratio": np.geomspace(0.5, 8.0, 24)}
SIZES = {"width": np.linspace(0.2, 0.8, 12), "height": np.linspace(1.0, 3.0, 10)}


def varied() -> dict[str, Callable[[], Any]]:
    """Return what draws the axes of each picture, by its name."""
    t = everything(things())
    cases = {
        f"plot_{name.removeprefix('plot_')}, read back": partial(
            getattr(plots, name.split()[0].removeprefix("plot_")), **case(t)[0]
        )
        for name, case in CASES.items()
        if " " in name
    }
    return cases | _motions() | _maps() | _orbits() | _risks(t)


def _motions() -> dict[str, Callable[[], Any]]:
    run, both = rocking(), rs.BaseMotion(shock(), shock(scale=0.5))
    walled = rs.simulate(WALLED, RICKER)
    kicked = rs.simulate(BARE, KICKS)
    sides = rs.simulate(rs.Block.asymmetric(left=0.15, right=0.25, height=1.2), RICKER)
    bare_wall = rs.DimensionlessBlock(restitution=0.8, one_sided=True)
    bare = rs.simulate(bare_wall, SHAKING, cycles=3)
    tilted = rs.simulate(BLOCK, rs.Still(), start=rs.State(angle=0.3, velocity=0.0))
    runs = {
        "walled": walled,
        "kicked": kicked,
        "sides": sides,
        "by a bare wall": bare,
        "tilted a little": tilted,
        "that rests": resting(),
    }
    drawn: dict[str, Callable[[], Any]] = {
        "base of a record": partial(plots.base, shock()),
        "base of both components": partial(plots.base, both),
        "velocity of both components": partial(plots.base, both, quantity="velocity"),
        "base of impulses": partial(plots.base, KICKS),
        "base of a run of impulses": partial(plots.base, kicked),
        "base of a run of both": partial(plots.base, vertical_too()),
        "part of a run": partial(plots.trajectory, run, span=(2.0, 5.0)),
        "impacts of a run": partial(plots.phase_portrait, walled, mark="impacts"),
    }
    for name, each in runs.items():
        drawn[f"run {name}"] = partial(plots.trajectory, each)
        drawn[f"phases {name}"] = partial(plots.phase_portrait, each)
        drawn[f"block {name} later"] = partial(
            plots.block, each, pt=0.6 * each.end_time_pt, glow=1.5
        )
    return drawn


def _maps() -> dict[str, Callable[[], Any]]:
    computed = found()
    line = rs.map_attractors(BARE, axes={"amplitude": PLANE["amplitude"], "frequency_ratio": [4.0]})
    fates = rs.map_fates(BARE, axes=PLANE, cycles=30)
    sizes = rs.map_fates(
        BLOCK, rs.Harmonic(amplitude=2.0, frequency_ratio=3.0), axes=SIZES, cycles=20
    )
    drawn: dict[str, Callable[[], Any]] = {
        "random map": partial(plots.outcomes, random_map(PLANE)),
        "fates of a plane": partial(plots.outcomes, fates),
        "fates by size": partial(plots.outcomes, sizes),
        "line of fates": partial(plots.outcomes, fates.isel(frequency_ratio=7)),
    }
    for by in ("period", "lyapunov", "peak"):
        drawn[f"map by {by}"] = partial(plots.outcomes, computed, by=by)
        drawn[f"line by {by}"] = partial(plots.outcomes, line, by=by)
    states = rs.formulas.steady_states([[2.0], [3.0]], np.linspace(2.0, 8.0, 30), 0.8)
    regions = rs.orbits.compute_region_map(np.linspace(0.5, 10.0, 80), 0.8)
    boundaries = rs.orbits.compute_region_boundaries(np.linspace(1.0, 8.0, 40), 0.8)
    curve = rs.compute_response_curve(BLOCK, 2.0, frequency_ratio=np.linspace(1.0, 8.0, 60))
    return drawn | {
        "steady states": partial(plots.steady_states, states),
        "region map": partial(
            plots.steady_regions, regions, point=(4.0, 2.0), top=6.0, key="beside"
        ),
        "region boundaries": partial(plots.steady_regions, boundaries),
        "response of a block": partial(plots.response, curve, top=1.5),
        "free rocking": partial(plots.free_rocking, [0.7, 0.8, 0.9], impacts=5),
    }


def _orbits() -> dict[str, Callable[[], Any]]:
    many = rs.find_orbits(BARE, FAST, max_period=2, seeds=6)
    resting = rs.branches.find_resting_branches(
        BARE, rs.Harmonic(amplitude=1.0, frequency_ratio=2.0), "amplitude", (0.9, 1.3), max_period=1
    )
    diagram = replace(diagram_of(over_frequency(), "frequency_ratio"), sweeps=sweeps())
    hilltop = rs.basins.find_hilltop_saddles(BARE, rs.Harmonic(amplitude=0.2, frequency_ratio=2.0))[
        0
    ]
    over = rs.basins.compute_manifold(hilltop, "stable", over="impacts", spacing=0.1)
    starts = rs.find_overturning_windows(
        BARE, "ricker", np.linspace(0.8, 4.0, 25), within=(1.0, 12.0)
    )
    few = np.linspace(-1.0, 1.0, 15)
    basins = rs.compute_basins(BLOCK, SHAKING, angles=few, velocities=few, max_cycles=60)
    eroded = rs.compute_erosion(
        BLOCK,
        rs.Harmonic(amplitude=1.0, frequency_ratio=2.0),
        np.linspace(0.0, 3.0, 5),
        angles=few,
        velocities=few,
        cycles=10,
    )
    return {
        "basins of a block": partial(plots.basins, basins),
        "erosion of a block": partial(plots.erosion, eroded),
        "multipliers of many": partial(plots.multipliers, many),
        "section of many": partial(plots.poincare_section, many),
        "resting branches": partial(plots.bifurcations, resting),
        "branches and resting ones": partial(
            plots.bifurcations, [*over_amplitude(), *resting.branches], side="both"
        ),
        "branches and sweeps": partial(plots.bifurcations, diagram),
        "branches over the amplitude": partial(plots.bifurcations, over_amplitude(), top=1.0),
        "bifurcation curves": partial(plots.bifurcation_curves, curves()),
        "manifold over impacts": partial(plots.manifolds, over),
        "many windows": partial(plots.overturning, starts),
    }


def _risks(t: dict[str, Any]) -> dict[str, Callable[[], Any]]:
    rows = [("hazard 0.5 to 2", 0.000631, 0.00252), ("width 0.28 to 0.36", 0.00168, 0.000972)]
    objects = [
        rs.risk.DescribedObject(
            values={"name": name, "geometry": {"width_m": width, "height_m": height}}
        )
        for name, (width, height) in {"vase": (0.12, 0.5), "chest": (0.9, 1.1)}.items()
    ]
    eleven = rs.motions.make_synthetic_suite(11)
    several = rs.assess_objects(objects, eleven, demand=rs.risk.Peaks(pga_g=0.4, pgv_m_s=0.5))
    names = ("boundary", "screen", "branch test")
    drawn: dict[str, Callable[[], Any]] = {
        f"rows of {name}": partial(plots.rows, t[name]) for name in names
    }
    at, fell = np.geomspace(0.1, 1.0, 6), [0, 2, 9, 14, 19, 20]
    fitted = rs.risk.fit_curve(at, fell, [20] * 6)
    step = rs.risk.fit_curve([0.1, 0.2, 0.3, 0.4], [0, 0, 20, 20], [20] * 4)
    suite = [shock("weak", 0.3), shock("once"), shock("a record with a long name indeed", 3.0)]
    return drawn | {
        "fitted curve": partial(plots.fragility, fitted),
        "step of a curve": partial(plots.fragility, step),
        "one state": partial(plots.fragility, t["state_fragility"]),
        "scales of three": partial(
            plots.overturning_scales,
            rs.find_overturning_scales(BLOCK, suite, within=(0.2, 6.0)),
        ),
        "tornado of rates": partial(plots.tornado, rows, 0.00126, label="falls a year"),
        "objects": partial(plots.objects, several),
        "hazards": partial(plots.hazard_curve, [t["hazard"], t["hazard"]]),
    }
