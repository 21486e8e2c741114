"""Where each public name is defined."""

from .dynamics.batch.attractors import Attractors as Attractors
from .dynamics.batch.find_attractors import find_attractors as find_attractors
from .dynamics.orbits.attractor import Attractor as Attractor
from .dynamics.orbits.attractor_sweep import AttractorSweep as AttractorSweep
from .dynamics.orbits.attractor_sweep import sweep_attractor as sweep_attractor
from .dynamics.orbits.orbit import Orbit as Orbit
from .dynamics.orbits.return_map import Passage as Passage
from .dynamics.orbits.return_map import ReturnMap as ReturnMap
from .dynamics.steady.regions import RegionBoundaries as RegionBoundaries
from .dynamics.steady.regions import RegionMap as RegionMap
from .dynamics.steady.regions import compute_region_boundaries as compute_region_boundaries
from .dynamics.steady.regions import compute_region_map as compute_region_map
from .dynamics.steady.response import ResponseCurve as ResponseCurve
from .dynamics.steady.states import SteadyOrbit as SteadyOrbit
from .dynamics.steady.states import SteadyStates as SteadyStates
from .dynamics.steady.states import compute_steady_orbit as compute_steady_orbit

__all__: list[str]
