"""Every kind of whole figure, small and quick to compute, and what is seen of it."""

from collections.abc import Callable
from functools import cache

import numpy as np
from matplotlib.figure import Figure
from matplotlib.text import Text

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Record,
    State,
    Still,
    compute_basins,
    compute_erosion,
    compute_fragility,
    compute_response_curve,
    compute_rocking_spectrum,
    find_attractor,
    find_bifurcations,
    find_orbits,
    find_overturning_windows,
    map_attractors,
    simulate,
)
from rocksteady.basins import SamplingOptions, compute_basin_shares
from rocksteady.branches import BranchOptions
from rocksteady.histories import Trajectory
from rocksteady.measures import compute_response_spectrum, compute_suite_spectrum, integrate_record
from rocksteady.model.equations import Linear, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.orbits import compute_region_map, compute_steady_orbit
from rocksteady.risk import RestitutionBand
from rocksteady.show.figures.maps import map_figure
from rocksteady.show.figures.risk import fragility_figure
from rocksteady.show.figures.single import (
    basins_figure,
    bifurcation_figure,
    cloud_figure,
    erosion_figure,
    orbit_figure,
    orbits_figure,
    overturning_figure,
    record_figure,
    response_figure,
    shares_figure,
    simulation_figure,
    steady_figure,
)
from rocksteady.show.figures.spectra import spectrum_figure, suite_figure
from rocksteady.show.style.page import Page

BARE = DimensionlessBlock(restitution=0.8)
BLOCK = Block.rectangle(width=0.4, height=1.6)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=4.0)
TITLE = "block 0.4 m by 1.6 m, A = 2, Ω = 4, restitution 0.8, linear model, 12 cycles from rest"


def shock(name: str = "", scale: float = 1.0) -> Record:
    """A record with a swelling and dying sine."""
    time = np.linspace(0.0, 4.0, 401)
    values = 4.0 * scale * np.sin(6.0 * time) * np.sin(np.pi * time / 4.0)
    return Record(acceleration_m_s2=values, dt_s=0.01, name=name)


@cache
def rocking() -> Trajectory:
    return simulate(BARE, SHAKING, cycles=12)


@cache
def vertical_too() -> Trajectory:
    return simulate(BLOCK, BaseMotion(shock(), shock(scale=0.5)), model=Nonlinear())


@cache
def resting() -> Trajectory:
    return simulate(BARE, Harmonic(amplitude=0.5, frequency_ratio=4.0), cycles=4)


@cache
def makers() -> dict[str, Callable[[Page], Figure]]:
    """Return what draws each kind of figure for a page."""
    fine = np.linspace(1.0, 8.0, 120)
    orbit = find_attractor(BARE, SHAKING).orbit
    assert orbit is not None
    starts = find_orbits(BARE, Harmonic(amplitude=2.0, frequency_ratio=2.2), max_period=1, seeds=2)
    diagram = find_bifurcations(
        BARE,
        Harmonic(amplitude=2.0, frequency_ratio=2.0),
        "frequency_ratio",
        within=(1.6, 2.4),
        values=41,
        search=BranchOptions(max_period=2, doublings=0),
    )
    eroded = compute_erosion(
        BARE,
        Harmonic(amplitude=1.0, frequency_ratio=2.0),
        np.linspace(0.0, 1.4, 8),
        angles=np.linspace(-1.2, 1.2, 41),
        velocities=np.linspace(-1.2, 1.2, 41),
        cycles=20,
    )
    drop = eroded.drop(tolerance=0.05)
    windows = find_overturning_windows(
        DimensionlessBlock(restitution=0.9), "one-sine", np.linspace(1.0, 6.0, 21)
    )
    plane = {"amplitude": np.linspace(0.2, 6.0, 20), "frequency_ratio": np.linspace(0.5, 8.0, 24)}
    flat = map_attractors(BARE, axes=plane)
    panels = map_attractors(BARE, axes={"restitution": [0.6, 0.7, 0.8, 0.9], **plane})
    line = map_attractors(BARE, axes={"amplitude": plane["amplitude"], "frequency_ratio": [4.0]})
    suite = [shock("one"), shock("two", 0.7), shock("three", 1.3)]
    courses = [integrate_record(each) for each in suite]
    spectra = [compute_response_spectrum(each, np.geomspace(0.05, 4.0, 40)) for each in suite]
    spectrum = compute_rocking_spectrum(
        suite, alpha=[0.1, 0.2, 0.3], periods_s=np.linspace(1.0, 6.0, 30), model=Linear()
    )
    many = compute_rocking_spectrum(
        suite[0],
        alpha=np.linspace(0.05, 0.4, 9),
        periods_s=np.linspace(1.0, 6.0, 30),
        model=Linear(),
    )
    curves = [
        compute_response_curve(BARE, a, frequency_ratio=fine) for a in (1.0, 2.0, 3.0, 4.0, 5.0)
    ]
    around = compute_region_map(np.linspace(0.1, 14.0, 300), 0.8)
    steady = [
        (f"branch {n}: {kind}", compute_steady_orbit(2, 4, 0.8, branch=n))
        for n, kind in ((1, "out-of-phase, stable"), (2, "not admissible"))
    ]
    cells = compute_basins(
        BARE, SHAKING, angles=np.linspace(-1, 1, 40), velocities=np.linspace(-1, 1, 40)
    )
    window = np.linspace(-1.2, 1.2, 30)
    shared = compute_basin_shares(
        DimensionlessBlock(restitution=0.95),
        Harmonic(amplitude=0.5, frequency_ratio=2.0),
        "frequency_ratio",
        np.linspace(1.6, 3.0, 8),
        sampling=SamplingOptions(angles=window, velocities=window, seed=1),
    )
    free = simulate(BLOCK, Still(), start=State(angle=0.8, velocity=0.0), model=Linear())
    fallen = compute_fragility(BLOCK, suite, restitution=RestitutionBand(draws=1))
    return {
        "simulation": lambda page: simulation_figure(rocking(), TITLE, page),
        "free": lambda page: simulation_figure(free, TITLE, page),
        "vertical": lambda page: simulation_figure(vertical_too(), TITLE, page),
        "rest": lambda page: simulation_figure(resting(), TITLE, page),
        "orbit": lambda page: orbit_figure(orbit, orbit.trajectory(), TITLE, page),
        "cloud": lambda page: cloud_figure(rocking(), rocking(), since=1.0, title=TITLE, page=page),
        "orbits": lambda page: orbits_figure(starts, TITLE, page),
        "steady": lambda page: steady_figure(
            steady, around, point=(4.0, 2.0), title=TITLE, page=page
        ),
        "response": lambda page: response_figure(curves, title=TITLE, page=page),
        "basins": lambda page: basins_figure(cells, TITLE, page),
        "shares": lambda page: shares_figure(shared, TITLE, page),
        "erosion": lambda page: erosion_figure(eroded, [drop] if drop else (), TITLE, page),
        "overturning": lambda page: overturning_figure(windows, TITLE, page),
        "bifurcation": lambda page: bifurcation_figure(diagram, title=TITLE, page=page),
        "record": lambda page: record_figure(courses[:1], spectra[:1], TITLE, page),
        "records": lambda page: record_figure(courses, spectra, TITLE, page),
        "map": lambda page: map_figure(flat, TITLE, page),
        "panels": lambda page: map_figure(panels, TITLE, page),
        "line": lambda page: map_figure(line, TITLE, page),
        "spectrum": lambda page: spectrum_figure(spectrum.isel(record=0), TITLE, page),
        "spectrum-map": lambda page: spectrum_figure(many, TITLE, page),
        "fragility": lambda page: fragility_figure(fallen, title=TITLE, page=page),
        "suite": lambda page: suite_figure(compute_suite_spectrum(spectrum), TITLE, page),
    }


NAMES = (
    *("simulation", "free", "vertical", "rest", "orbit", "cloud", "orbits", "steady", "response"),
    *("basins", "shares", "erosion", "overturning", "bifurcation", "record", "records"),
    *("map", "panels", "line", "spectrum", "spectrum-map", "suite", "fragility"),
)


def texts_of(figure: Figure) -> list[Text]:
    """Return the texts of a figure that are seen."""
    found: list[Text] = figure.findobj(Text)
    return [text for text in found if text.get_visible() and text.get_text().strip()]
