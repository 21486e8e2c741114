"""Rocking of free-standing rigid blocks on a shaking base: exact, complete and fast.

This is the flat public namespace. Every name is imported from the module that defines it when it
is first used, so that ``import rocksteady`` costs nothing and loads no compiled code.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rocksteady.dynamics.basins.basins import Basins, Fraction, basins
    from rocksteady.dynamics.basins.erosion import Drop, Erosion, erosion
    from rocksteady.dynamics.basins.labels import BasinAttractor
    from rocksteady.dynamics.continuation.branch import continuation
    from rocksteady.dynamics.continuation.branches import bifurcation_branches
    from rocksteady.dynamics.continuation.cascade import DoublingCascade, doubling_cascade
    from rocksteady.dynamics.continuation.loci import bifurcation_curve
    from rocksteady.dynamics.continuation.points import Branch, BranchPoint, PointType
    from rocksteady.dynamics.continuation.stability import Stretch, stretches
    from rocksteady.dynamics.history.samples import Flights, Impacts, Samples
    from rocksteady.dynamics.history.simulate import simulate
    from rocksteady.dynamics.history.start import ImpactState, Rest, State, Steady
    from rocksteady.dynamics.history.trajectory import Trajectory
    from rocksteady.dynamics.maps.attractor_map import attractor_map
    from rocksteady.dynamics.maps.fate_map import fate_map
    from rocksteady.dynamics.orbits.attractor import Attractor, attractor
    from rocksteady.dynamics.orbits.orbit import Orbit
    from rocksteady.dynamics.orbits.return_map import Passage, ReturnMap
    from rocksteady.dynamics.orbits.search import orbits
    from rocksteady.dynamics.orbits.trail import AttractorTrail, attractor_trail
    from rocksteady.dynamics.overturning.free_rocking import (
        equivalent_damping,
        free_rocking_peaks,
        free_rocking_period,
    )
    from rocksteady.dynamics.overturning.thresholds import (
        overturning_impulse,
        overturning_threshold,
    )
    from rocksteady.dynamics.overturning.windows import (
        OverturningWindow,
        OverturningWindows,
        overturning_windows,
    )
    from rocksteady.dynamics.steady.regions import (
        Boundaries,
        RegionMap,
        boundaries,
        heteroclinic_amplitude,
        melnikov_amplitude,
        region_map,
        symmetry_breaking_amplitude,
        symmetry_breaking_frequency,
    )
    from rocksteady.dynamics.steady.response import ResponseCurve, response_curve
    from rocksteady.dynamics.steady.states import (
        SteadyOrbit,
        SteadyStates,
        steady_orbit,
        steady_states,
    )
    from rocksteady.errors import (
        InputError,
        MissingKernelsError,
        ModelError,
        OutputError,
        RecordFileError,
        RocksteadyError,
        UnfinishedError,
    )
    from rocksteady.installation.check import Installation, KernelCheck, check_installation
    from rocksteady.model.blocks.block import Block
    from rocksteady.model.blocks.dimensionless import DimensionlessBlock
    from rocksteady.model.blocks.examples import example_block
    from rocksteady.model.blocks.sides import Side, housner_restitution, impact_restitution
    from rocksteady.model.equations import Linear, Nonlinear
    from rocksteady.model.motions.base_motion import BaseMotion
    from rocksteady.model.motions.combine import added, delayed, joined, scaled
    from rocksteady.model.motions.impulses import Impulses
    from rocksteady.model.motions.pulses import Pulse
    from rocksteady.model.motions.record import Record
    from rocksteady.model.motions.segments import Harmonic, Piecewise, Segment, Still
    from rocksteady.model.motions.synthetic import SyntheticMotion
    from rocksteady.outcomes import AttractorKind, Event, Status
    from rocksteady.records.core.recording import Recording
    from rocksteady.records.pairing import RecordSet, pair_records
    from rocksteady.records.processing import baseline_corrected, resampled
    from rocksteady.records.read import read_record, read_recordings
    from rocksteady.seismic.measures.intensity import IntensityMeasures, intensity_measures
    from rocksteady.seismic.measures.response_spectrum import (
        ResponseSpectrum,
        average_spectral_acceleration,
        response_spectrum,
    )
    from rocksteady.seismic.measures.time_course import GroundCourse, Peak, ground_course
    from rocksteady.seismic.spectra.rocking import rocking_spectrum
    from rocksteady.seismic.spectra.suite import suite_spectrum
    from rocksteady.show.export.dataset import export
    from rocksteady.show.film.animation import animate
    from rocksteady.show.film.still import plot_block
    from rocksteady.show.plots.basins import plot_basins, plot_erosion, plot_safe_basin
    from rocksteady.show.plots.bifurcations import plot_bifurcations
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
    from rocksteady.sweep.cases.axes import Axis
    from rocksteady.sweep.cases.grid import Grid
    from rocksteady.sweep.cases.outputs import Output
    from rocksteady.sweep.evaluate import evaluate
    from rocksteady.sweep.run import Run
    from rocksteady.sweep.store.reading import open_store
    from rocksteady.sweep.store.store import Store
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
# the three agree is what tests/public/test_namespace.py checks.
__all__ = [
    "Attractor",
    "AttractorKind",
    "AttractorTrail",
    "Axis",
    "BaseMotion",
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
    "Event",
    "Flights",
    "Fraction",
    "Grid",
    "GroundCourse",
    "Harmonic",
    "ImpactState",
    "Impacts",
    "Impulses",
    "InputError",
    "Installation",
    "IntensityMeasures",
    "KernelCheck",
    "Linear",
    "MissingKernelsError",
    "ModelError",
    "Nonlinear",
    "Orbit",
    "Output",
    "OutputError",
    "OverturningWindow",
    "OverturningWindows",
    "Passage",
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
    "Run",
    "Samples",
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
    "check_installation",
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
    "Attractor": "rocksteady.dynamics.orbits.attractor",
    "AttractorKind": "rocksteady.outcomes",
    "AttractorTrail": "rocksteady.dynamics.orbits.trail",
    "Axis": "rocksteady.sweep.cases.axes",
    "BaseMotion": "rocksteady.model.motions.base_motion",
    "BasinAttractor": "rocksteady.dynamics.basins.labels",
    "Basins": "rocksteady.dynamics.basins.basins",
    "Block": "rocksteady.model.blocks.block",
    "Boundaries": "rocksteady.dynamics.steady.regions",
    "Branch": "rocksteady.dynamics.continuation.points",
    "BranchPoint": "rocksteady.dynamics.continuation.points",
    "DimensionlessBlock": "rocksteady.model.blocks.dimensionless",
    "DoublingCascade": "rocksteady.dynamics.continuation.cascade",
    "Drop": "rocksteady.dynamics.basins.erosion",
    "Erosion": "rocksteady.dynamics.basins.erosion",
    "Event": "rocksteady.outcomes",
    "Flights": "rocksteady.dynamics.history.samples",
    "Fraction": "rocksteady.dynamics.basins.basins",
    "Grid": "rocksteady.sweep.cases.grid",
    "GroundCourse": "rocksteady.seismic.measures.time_course",
    "Harmonic": "rocksteady.model.motions.segments",
    "ImpactState": "rocksteady.dynamics.history.start",
    "Impacts": "rocksteady.dynamics.history.samples",
    "Impulses": "rocksteady.model.motions.impulses",
    "InputError": "rocksteady.errors",
    "Installation": "rocksteady.installation.check",
    "IntensityMeasures": "rocksteady.seismic.measures.intensity",
    "KernelCheck": "rocksteady.installation.check",
    "Linear": "rocksteady.model.equations",
    "MissingKernelsError": "rocksteady.errors",
    "ModelError": "rocksteady.errors",
    "Nonlinear": "rocksteady.model.equations",
    "Orbit": "rocksteady.dynamics.orbits.orbit",
    "Output": "rocksteady.sweep.cases.outputs",
    "OutputError": "rocksteady.errors",
    "OverturningWindow": "rocksteady.dynamics.overturning.windows",
    "OverturningWindows": "rocksteady.dynamics.overturning.windows",
    "Passage": "rocksteady.dynamics.orbits.return_map",
    "Peak": "rocksteady.seismic.measures.time_course",
    "Piecewise": "rocksteady.model.motions.segments",
    "PointType": "rocksteady.dynamics.continuation.points",
    "Pulse": "rocksteady.model.motions.pulses",
    "Record": "rocksteady.model.motions.record",
    "RecordFileError": "rocksteady.errors",
    "RecordSet": "rocksteady.records.pairing",
    "Recording": "rocksteady.records.core.recording",
    "RegionMap": "rocksteady.dynamics.steady.regions",
    "ResponseCurve": "rocksteady.dynamics.steady.response",
    "ResponseSpectrum": "rocksteady.seismic.measures.response_spectrum",
    "Rest": "rocksteady.dynamics.history.start",
    "ReturnMap": "rocksteady.dynamics.orbits.return_map",
    "RocksteadyError": "rocksteady.errors",
    "Run": "rocksteady.sweep.run",
    "Samples": "rocksteady.dynamics.history.samples",
    "Segment": "rocksteady.model.motions.segments",
    "Side": "rocksteady.model.blocks.sides",
    "State": "rocksteady.dynamics.history.start",
    "Status": "rocksteady.outcomes",
    "Steady": "rocksteady.dynamics.history.start",
    "SteadyOrbit": "rocksteady.dynamics.steady.states",
    "SteadyStates": "rocksteady.dynamics.steady.states",
    "Still": "rocksteady.model.motions.segments",
    "Store": "rocksteady.sweep.store.store",
    "Stretch": "rocksteady.dynamics.continuation.stability",
    "SyntheticMotion": "rocksteady.model.motions.synthetic",
    "Trajectory": "rocksteady.dynamics.history.trajectory",
    "UnfinishedError": "rocksteady.errors",
    "added": "rocksteady.model.motions.combine",
    "animate": "rocksteady.show.film.animation",
    "attractor": "rocksteady.dynamics.orbits.attractor",
    "attractor_map": "rocksteady.dynamics.maps.attractor_map",
    "attractor_trail": "rocksteady.dynamics.orbits.trail",
    "average_spectral_acceleration": "rocksteady.seismic.measures.response_spectrum",
    "baseline_corrected": "rocksteady.records.processing",
    "basins": "rocksteady.dynamics.basins.basins",
    "bifurcation_branches": "rocksteady.dynamics.continuation.branches",
    "bifurcation_curve": "rocksteady.dynamics.continuation.loci",
    "boundaries": "rocksteady.dynamics.steady.regions",
    "check_installation": "rocksteady.installation.check",
    "continuation": "rocksteady.dynamics.continuation.branch",
    "delayed": "rocksteady.model.motions.combine",
    "doubling_cascade": "rocksteady.dynamics.continuation.cascade",
    "equivalent_damping": "rocksteady.dynamics.overturning.free_rocking",
    "erosion": "rocksteady.dynamics.basins.erosion",
    "evaluate": "rocksteady.sweep.evaluate",
    "example_block": "rocksteady.model.blocks.examples",
    "export": "rocksteady.show.export.dataset",
    "fate_map": "rocksteady.dynamics.maps.fate_map",
    "free_rocking_peaks": "rocksteady.dynamics.overturning.free_rocking",
    "free_rocking_period": "rocksteady.dynamics.overturning.free_rocking",
    "ground_course": "rocksteady.seismic.measures.time_course",
    "heteroclinic_amplitude": "rocksteady.dynamics.steady.regions",
    "housner_restitution": "rocksteady.model.blocks.sides",
    "impact_restitution": "rocksteady.model.blocks.sides",
    "intensity_measures": "rocksteady.seismic.measures.intensity",
    "joined": "rocksteady.model.motions.combine",
    "melnikov_amplitude": "rocksteady.dynamics.steady.regions",
    "open_store": "rocksteady.sweep.store.reading",
    "orbits": "rocksteady.dynamics.orbits.search",
    "overturning_impulse": "rocksteady.dynamics.overturning.thresholds",
    "overturning_threshold": "rocksteady.dynamics.overturning.thresholds",
    "overturning_windows": "rocksteady.dynamics.overturning.windows",
    "pair_records": "rocksteady.records.pairing",
    "plot_base": "rocksteady.show.plots.motion",
    "plot_basins": "rocksteady.show.plots.basins",
    "plot_bifurcation_curves": "rocksteady.show.plots.curves",
    "plot_bifurcations": "rocksteady.show.plots.bifurcations",
    "plot_block": "rocksteady.show.film.still",
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
    "region_map": "rocksteady.dynamics.steady.regions",
    "resampled": "rocksteady.records.processing",
    "response_curve": "rocksteady.dynamics.steady.response",
    "response_spectrum": "rocksteady.seismic.measures.response_spectrum",
    "rocking_spectrum": "rocksteady.seismic.spectra.rocking",
    "scaled": "rocksteady.model.motions.combine",
    "simulate": "rocksteady.dynamics.history.simulate",
    "steady_orbit": "rocksteady.dynamics.steady.states",
    "steady_states": "rocksteady.dynamics.steady.states",
    "stretches": "rocksteady.dynamics.continuation.stability",
    "suite_spectrum": "rocksteady.seismic.spectra.suite",
    "symmetry_breaking_amplitude": "rocksteady.dynamics.steady.regions",
    "symmetry_breaking_frequency": "rocksteady.dynamics.steady.regions",
}


def __dir__() -> list[str]:
    """Return the public names, whether they are imported yet or not."""
    return list(__all__)
