"""Rocking of free-standing rigid blocks on a shaking base: exact, complete and fast.

This is the flat public namespace. Every name is imported from the module that defines it when it
is first used, so that ``import rocksteady`` costs nothing and loads no compiled code.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rocksteady.dynamics.attractor import Attractor, AttractorKind, attractor
    from rocksteady.dynamics.basin_attractors import BasinAttractor
    from rocksteady.dynamics.basins import Basins, Fraction, basins
    from rocksteady.dynamics.continuation.branch import continuation
    from rocksteady.dynamics.continuation.cascade import DoublingCascade, doubling_cascade
    from rocksteady.dynamics.continuation.curves import bifurcation_curve
    from rocksteady.dynamics.continuation.diagram import bifurcation_branches
    from rocksteady.dynamics.continuation.points import Branch, BranchPoint, PointType
    from rocksteady.dynamics.continuation.stretches import Stretch, stretches
    from rocksteady.dynamics.courses import Flights, Impacts, Motions
    from rocksteady.dynamics.erosion import Drop, Erosion, erosion
    from rocksteady.dynamics.fates import fate_map
    from rocksteady.dynamics.free_rocking import (
        equivalent_damping,
        free_rocking_peaks,
        free_rocking_period,
    )
    from rocksteady.dynamics.maps import attractor_map
    from rocksteady.dynamics.orbit import Orbit
    from rocksteady.dynamics.orbits import orbits
    from rocksteady.dynamics.overturning.thresholds import (
        overturning_impulse,
        overturning_threshold,
    )
    from rocksteady.dynamics.overturning.windows import (
        OverturningWindow,
        OverturningWindows,
        overturning_windows,
    )
    from rocksteady.dynamics.regions import (
        Boundaries,
        RegionMap,
        boundaries,
        heteroclinic_amplitude,
        melnikov_amplitude,
        region_map,
        symmetry_breaking_amplitude,
        symmetry_breaking_frequency,
    )
    from rocksteady.dynamics.response import ResponseCurve, response_curve
    from rocksteady.dynamics.return_map import ImpactState, Passage, PassageKind, ReturnMap
    from rocksteady.dynamics.simulate import simulate
    from rocksteady.dynamics.start import Rest, State, Steady
    from rocksteady.dynamics.steady import SteadyOrbit, SteadyStates, steady_orbit, steady_states
    from rocksteady.dynamics.trail import AttractorTrail, attractor_trail
    from rocksteady.dynamics.trajectory import Trajectory
    from rocksteady.errors import (
        InputError,
        ModelError,
        OutputError,
        RecordFileError,
        RocksteadyError,
        Status,
        UnfinishedError,
    )
    from rocksteady.model.block import Block, DimensionlessBlock, Side, housner_restitution
    from rocksteady.model.combine import added, delayed, joined, scaled
    from rocksteady.model.examples import example_block
    from rocksteady.model.impulses import Impulses
    from rocksteady.model.motions import Harmonic, Piecewise, Segment, Still
    from rocksteady.model.pulses import Pulse
    from rocksteady.model.record import Record
    from rocksteady.model.sides import impact_restitution
    from rocksteady.model.synthetic import SyntheticMotion
    from rocksteady.records.pairs import RecordSet, pair_records
    from rocksteady.records.processing import baseline_corrected, resampled
    from rocksteady.records.read import read_record, read_recordings
    from rocksteady.records.recording import Recording
    from rocksteady.seismic.ground_course import GroundCourse, Peak, ground_course
    from rocksteady.seismic.measures import IntensityMeasures, intensity_measures
    from rocksteady.seismic.response_spectrum import (
        ResponseSpectrum,
        average_spectral_acceleration,
        response_spectrum,
    )
    from rocksteady.seismic.spectra import rocking_spectrum
    from rocksteady.seismic.spectra_suite import suite_spectrum
    from rocksteady.show.animation import animate
    from rocksteady.show.export import export
    from rocksteady.show.plots.basins import plot_basins, plot_erosion, plot_safe_basin
    from rocksteady.show.plots.bifurcations import plot_bifurcations
    from rocksteady.show.plots.block import plot_block
    from rocksteady.show.plots.curves import plot_bifurcation_curves
    from rocksteady.show.plots.maps import plot_map
    from rocksteady.show.plots.motion import plot_base, plot_phase_portrait, plot_trajectory
    from rocksteady.show.plots.orbits import plot_multipliers, plot_section
    from rocksteady.show.plots.overturning import plot_free_rocking, plot_overturning
    from rocksteady.show.plots.records import plot_ground_course, plot_husid, plot_response_spectra
    from rocksteady.show.plots.spectra import (
        plot_overturned_share,
        plot_rocking_spectrum,
        plot_spectrum_map,
        plot_suite_spectrum,
    )
    from rocksteady.show.plots.steady import plot_orbit, plot_regions, plot_response
    from rocksteady.sweep.axes import Axis
    from rocksteady.sweep.evaluate import evaluate
    from rocksteady.sweep.grid import Grid
    from rocksteady.sweep.outputs import Output
    from rocksteady.sweep.reading import open_store
    from rocksteady.sweep.store import Store
else:
    # Out of the sight of type checkers, which would take every misspelt name to be of type object.
    def __getattr__(name: str) -> object:
        """Import a public name from the module that defines it, once (PEP 562)."""
        if name not in _DEFINED_IN:
            message = f"module {__name__!r} has no attribute {name!r}"
            raise AttributeError(message, name=name, obj=import_module(__name__))
        value = getattr(import_module(_DEFINED_IN[name]), name)
        globals()[name] = value  # the next access does not come here again
        return value


__version__ = "0.1.0"

# Type checkers and editors read the imports above and the list below; Python reads the dict. That
# the three agree is what tests/test_namespace.py checks.
__all__ = [
    "Attractor",
    "AttractorKind",
    "AttractorTrail",
    "Axis",
    "BasinAttractor",
    "Basins",
    "Block",
    "Boundaries",
    "Branch",
    "BranchPoint",
    "DimensionlessBlock",
    "DoublingCascade",
    "Drop",
    "Erosion",
    "Flights",
    "Fraction",
    "Grid",
    "GroundCourse",
    "Harmonic",
    "ImpactState",
    "Impacts",
    "Impulses",
    "InputError",
    "IntensityMeasures",
    "ModelError",
    "Motions",
    "Orbit",
    "Output",
    "OutputError",
    "OverturningWindow",
    "OverturningWindows",
    "Passage",
    "PassageKind",
    "Peak",
    "Piecewise",
    "PointType",
    "Pulse",
    "Record",
    "RecordFileError",
    "RecordSet",
    "Recording",
    "RegionMap",
    "ResponseCurve",
    "ResponseSpectrum",
    "Rest",
    "ReturnMap",
    "RocksteadyError",
    "Segment",
    "Side",
    "State",
    "Status",
    "Steady",
    "SteadyOrbit",
    "SteadyStates",
    "Still",
    "Store",
    "Stretch",
    "SyntheticMotion",
    "Trajectory",
    "UnfinishedError",
    "__version__",
    "added",
    "animate",
    "attractor",
    "attractor_map",
    "attractor_trail",
    "average_spectral_acceleration",
    "baseline_corrected",
    "basins",
    "bifurcation_branches",
    "bifurcation_curve",
    "boundaries",
    "continuation",
    "delayed",
    "doubling_cascade",
    "equivalent_damping",
    "erosion",
    "evaluate",
    "example_block",
    "export",
    "fate_map",
    "free_rocking_peaks",
    "free_rocking_period",
    "ground_course",
    "heteroclinic_amplitude",
    "housner_restitution",
    "impact_restitution",
    "intensity_measures",
    "joined",
    "melnikov_amplitude",
    "open_store",
    "orbits",
    "overturning_impulse",
    "overturning_threshold",
    "overturning_windows",
    "pair_records",
    "plot_base",
    "plot_basins",
    "plot_bifurcation_curves",
    "plot_bifurcations",
    "plot_block",
    "plot_erosion",
    "plot_free_rocking",
    "plot_ground_course",
    "plot_husid",
    "plot_map",
    "plot_multipliers",
    "plot_orbit",
    "plot_overturned_share",
    "plot_overturning",
    "plot_phase_portrait",
    "plot_regions",
    "plot_response",
    "plot_response_spectra",
    "plot_rocking_spectrum",
    "plot_safe_basin",
    "plot_section",
    "plot_spectrum_map",
    "plot_suite_spectrum",
    "plot_trajectory",
    "read_record",
    "read_recordings",
    "region_map",
    "resampled",
    "response_curve",
    "response_spectrum",
    "rocking_spectrum",
    "scaled",
    "simulate",
    "steady_orbit",
    "steady_states",
    "stretches",
    "suite_spectrum",
    "symmetry_breaking_amplitude",
    "symmetry_breaking_frequency",
]

_DEFINED_IN = {
    "Attractor": "rocksteady.dynamics.attractor",
    "AttractorKind": "rocksteady.dynamics.attractor",
    "AttractorTrail": "rocksteady.dynamics.trail",
    "Axis": "rocksteady.sweep.axes",
    "BasinAttractor": "rocksteady.dynamics.basin_attractors",
    "Basins": "rocksteady.dynamics.basins",
    "Block": "rocksteady.model.block",
    "Boundaries": "rocksteady.dynamics.regions",
    "Branch": "rocksteady.dynamics.continuation.points",
    "BranchPoint": "rocksteady.dynamics.continuation.points",
    "DimensionlessBlock": "rocksteady.model.block",
    "DoublingCascade": "rocksteady.dynamics.continuation.cascade",
    "Drop": "rocksteady.dynamics.erosion",
    "Erosion": "rocksteady.dynamics.erosion",
    "Flights": "rocksteady.dynamics.courses",
    "Fraction": "rocksteady.dynamics.basins",
    "Grid": "rocksteady.sweep.grid",
    "GroundCourse": "rocksteady.seismic.ground_course",
    "Harmonic": "rocksteady.model.motions",
    "ImpactState": "rocksteady.dynamics.return_map",
    "Impacts": "rocksteady.dynamics.courses",
    "Impulses": "rocksteady.model.impulses",
    "InputError": "rocksteady.errors",
    "IntensityMeasures": "rocksteady.seismic.measures",
    "ModelError": "rocksteady.errors",
    "Motions": "rocksteady.dynamics.courses",
    "Orbit": "rocksteady.dynamics.orbit",
    "Output": "rocksteady.sweep.outputs",
    "OutputError": "rocksteady.errors",
    "OverturningWindow": "rocksteady.dynamics.overturning.windows",
    "OverturningWindows": "rocksteady.dynamics.overturning.windows",
    "Passage": "rocksteady.dynamics.return_map",
    "PassageKind": "rocksteady.dynamics.return_map",
    "Peak": "rocksteady.seismic.ground_course",
    "Piecewise": "rocksteady.model.motions",
    "PointType": "rocksteady.dynamics.continuation.points",
    "Pulse": "rocksteady.model.pulses",
    "Record": "rocksteady.model.record",
    "RecordFileError": "rocksteady.errors",
    "RecordSet": "rocksteady.records.pairs",
    "Recording": "rocksteady.records.recording",
    "RegionMap": "rocksteady.dynamics.regions",
    "ResponseCurve": "rocksteady.dynamics.response",
    "ResponseSpectrum": "rocksteady.seismic.response_spectrum",
    "Rest": "rocksteady.dynamics.start",
    "ReturnMap": "rocksteady.dynamics.return_map",
    "RocksteadyError": "rocksteady.errors",
    "Segment": "rocksteady.model.motions",
    "Side": "rocksteady.model.block",
    "State": "rocksteady.dynamics.start",
    "Status": "rocksteady.errors",
    "Steady": "rocksteady.dynamics.start",
    "SteadyOrbit": "rocksteady.dynamics.steady",
    "SteadyStates": "rocksteady.dynamics.steady",
    "Still": "rocksteady.model.motions",
    "Store": "rocksteady.sweep.store",
    "Stretch": "rocksteady.dynamics.continuation.stretches",
    "SyntheticMotion": "rocksteady.model.synthetic",
    "Trajectory": "rocksteady.dynamics.trajectory",
    "UnfinishedError": "rocksteady.errors",
    "added": "rocksteady.model.combine",
    "animate": "rocksteady.show.animation",
    "attractor": "rocksteady.dynamics.attractor",
    "attractor_map": "rocksteady.dynamics.maps",
    "attractor_trail": "rocksteady.dynamics.trail",
    "average_spectral_acceleration": "rocksteady.seismic.response_spectrum",
    "baseline_corrected": "rocksteady.records.processing",
    "basins": "rocksteady.dynamics.basins",
    "bifurcation_branches": "rocksteady.dynamics.continuation.diagram",
    "bifurcation_curve": "rocksteady.dynamics.continuation.curves",
    "boundaries": "rocksteady.dynamics.regions",
    "continuation": "rocksteady.dynamics.continuation.branch",
    "delayed": "rocksteady.model.combine",
    "doubling_cascade": "rocksteady.dynamics.continuation.cascade",
    "equivalent_damping": "rocksteady.dynamics.free_rocking",
    "erosion": "rocksteady.dynamics.erosion",
    "evaluate": "rocksteady.sweep.evaluate",
    "example_block": "rocksteady.model.examples",
    "export": "rocksteady.show.export",
    "fate_map": "rocksteady.dynamics.fates",
    "free_rocking_peaks": "rocksteady.dynamics.free_rocking",
    "free_rocking_period": "rocksteady.dynamics.free_rocking",
    "ground_course": "rocksteady.seismic.ground_course",
    "heteroclinic_amplitude": "rocksteady.dynamics.regions",
    "housner_restitution": "rocksteady.model.block",
    "impact_restitution": "rocksteady.model.sides",
    "intensity_measures": "rocksteady.seismic.measures",
    "joined": "rocksteady.model.combine",
    "melnikov_amplitude": "rocksteady.dynamics.regions",
    "open_store": "rocksteady.sweep.reading",
    "orbits": "rocksteady.dynamics.orbits",
    "overturning_impulse": "rocksteady.dynamics.overturning.thresholds",
    "overturning_threshold": "rocksteady.dynamics.overturning.thresholds",
    "overturning_windows": "rocksteady.dynamics.overturning.windows",
    "pair_records": "rocksteady.records.pairs",
    "plot_base": "rocksteady.show.plots.motion",
    "plot_basins": "rocksteady.show.plots.basins",
    "plot_bifurcation_curves": "rocksteady.show.plots.curves",
    "plot_bifurcations": "rocksteady.show.plots.bifurcations",
    "plot_block": "rocksteady.show.plots.block",
    "plot_erosion": "rocksteady.show.plots.basins",
    "plot_free_rocking": "rocksteady.show.plots.overturning",
    "plot_ground_course": "rocksteady.show.plots.records",
    "plot_husid": "rocksteady.show.plots.records",
    "plot_map": "rocksteady.show.plots.maps",
    "plot_multipliers": "rocksteady.show.plots.orbits",
    "plot_orbit": "rocksteady.show.plots.steady",
    "plot_overturned_share": "rocksteady.show.plots.spectra",
    "plot_overturning": "rocksteady.show.plots.overturning",
    "plot_phase_portrait": "rocksteady.show.plots.motion",
    "plot_regions": "rocksteady.show.plots.steady",
    "plot_response": "rocksteady.show.plots.steady",
    "plot_response_spectra": "rocksteady.show.plots.records",
    "plot_rocking_spectrum": "rocksteady.show.plots.spectra",
    "plot_safe_basin": "rocksteady.show.plots.basins",
    "plot_section": "rocksteady.show.plots.orbits",
    "plot_spectrum_map": "rocksteady.show.plots.spectra",
    "plot_suite_spectrum": "rocksteady.show.plots.spectra",
    "plot_trajectory": "rocksteady.show.plots.motion",
    "read_record": "rocksteady.records.read",
    "read_recordings": "rocksteady.records.read",
    "region_map": "rocksteady.dynamics.regions",
    "resampled": "rocksteady.records.processing",
    "response_curve": "rocksteady.dynamics.response",
    "response_spectrum": "rocksteady.seismic.response_spectrum",
    "rocking_spectrum": "rocksteady.seismic.spectra",
    "scaled": "rocksteady.model.combine",
    "simulate": "rocksteady.dynamics.simulate",
    "steady_orbit": "rocksteady.dynamics.steady",
    "steady_states": "rocksteady.dynamics.steady",
    "stretches": "rocksteady.dynamics.continuation.stretches",
    "suite_spectrum": "rocksteady.seismic.spectra_suite",
    "symmetry_breaking_amplitude": "rocksteady.dynamics.regions",
    "symmetry_breaking_frequency": "rocksteady.dynamics.regions",
}


def __dir__() -> list[str]:
    """Return the public names, whether they are imported yet or not."""
    return list(__all__)
