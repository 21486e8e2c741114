"""The flat public namespace: where each public name is defined."""

from .dynamics.basins.basins import BasinFraction as BasinFraction
from .dynamics.basins.basins import Basins as Basins
from .dynamics.basins.basins import compute_basins as compute_basins
from .dynamics.basins.measures.boundary import BoundaryTest as BoundaryTest
from .dynamics.basins.measures.boundary import check_boundary as check_boundary
from .dynamics.basins.measures.entropy import BasinEntropies as BasinEntropies
from .dynamics.basins.measures.entropy import BasinEntropy as BasinEntropy
from .dynamics.basins.measures.entropy import compute_basin_entropy as compute_basin_entropy
from .dynamics.basins.erosion import Erosion as Erosion
from .dynamics.basins.erosion import IntegrityDrop as IntegrityDrop
from .dynamics.basins.erosion import compute_erosion as compute_erosion
from .dynamics.basins.fate_basins import FateBasins as FateBasins
from .dynamics.basins.fate_basins import FateFraction as FateFraction
from .dynamics.basins.fate_basins import compute_fate_basins as compute_fate_basins
from .dynamics.batch.attractors import Attractors as Attractors
from .dynamics.batch.find_attractors import find_attractors as find_attractors
from .dynamics.basins.over.families import BasinFamily as BasinFamily
from .dynamics.basins.labels import BasinAttractor as BasinAttractor
from .dynamics.basins.over.matching import BasinMatching as BasinMatching
from .dynamics.basins.over.shares import BasinSampling as BasinSampling
from .dynamics.basins.over.shares import BasinShares as BasinShares
from .dynamics.basins.over.shares import compute_basin_shares as compute_basin_shares
from .dynamics.basins.measures.uncertainty import UncertaintyExponent as UncertaintyExponent
from .dynamics.basins.measures.uncertainty import (
    compute_uncertainty_exponent as compute_uncertainty_exponent,
)
from .dynamics.continuation.branch import follow_branch as follow_branch
from .dynamics.continuation.branches import BranchSearch as BranchSearch
from .dynamics.continuation.branches import find_branches as find_branches
from .dynamics.continuation.cascade import DoublingCascade as DoublingCascade
from .dynamics.continuation.cascade import find_cascade as find_cascade
from .dynamics.continuation.diagram import Bifurcation as Bifurcation
from .dynamics.continuation.diagram import BifurcationDiagram as BifurcationDiagram
from .dynamics.continuation.find_bifurcations import find_bifurcations as find_bifurcations
from .dynamics.continuation.curves.bifurcation_curves import BifurcationCurve as BifurcationCurve
from .dynamics.continuation.curves.bifurcation_curves import BifurcationCurves as BifurcationCurves
from .dynamics.continuation.curves.bifurcation_curves import CodimensionTwo as CodimensionTwo
from .dynamics.continuation.curves.bifurcation_curves import CurveSearch as CurveSearch
from .dynamics.continuation.curves.bifurcation_curves import Region as Region
from .dynamics.continuation.curves.loci import follow_bifurcation as follow_bifurcation
from .dynamics.continuation.curves.search_plane import (
    find_bifurcation_curves as find_bifurcation_curves,
)
from .dynamics.continuation.points import Branch as Branch
from .dynamics.continuation.points import BranchPoint as BranchPoint
from .dynamics.continuation.chains.point_types import PointType as PointType
from .dynamics.continuation.points import Stretch as Stretch
from .dynamics.edges.edge_state import EdgeState as EdgeState
from .dynamics.edges.growing import compute_manifold as compute_manifold
from .dynamics.edges.hilltop import HilltopSaddle as HilltopSaddle
from .dynamics.edges.hilltop import find_hilltop_saddles as find_hilltop_saddles
from .dynamics.edges.manifold import Manifold as Manifold
from .dynamics.edges.manifold import ManifoldBranch as ManifoldBranch

from .dynamics.edges.tracking import find_edge_state as find_edge_state
from .dynamics.continuation.resting.find_resting import RestingBranches as RestingBranches
from .dynamics.continuation.resting.find_resting import RestingGap as RestingGap
from .dynamics.continuation.resting.find_resting import (
    find_resting_branches as find_resting_branches,
)
from .dynamics.continuation.resting.find_resting import (
    follow_resting_orbit as follow_resting_orbit,
)
from .dynamics.continuation.resting.resting_branch import Excursion as Excursion
from .dynamics.continuation.resting.resting_branch import RestingBranch as RestingBranch
from .dynamics.continuation.resting.resting_branch import RestingPoint as RestingPoint
from .dynamics.continuation.resting.resting_types import NoRest as NoRest
from .dynamics.continuation.resting.resting_types import RestingPointType as RestingPointType
from .dynamics.history.samples import Flights as Flights
from .dynamics.history.samples import Impacts as Impacts
from .dynamics.history.samples import Samples as Samples
from .dynamics.history.neighbours import Neighbour as Neighbour
from .dynamics.history.neighbours import Neighbours as Neighbours
from .dynamics.history.neighbours import check_neighbours as check_neighbours
from .dynamics.history.simulate import simulate as simulate
from .dynamics.history.start import ImpactState as ImpactState
from .dynamics.history.start import Rest as Rest
from .dynamics.history.start import State as State
from .dynamics.history.start import Steady as Steady
from .dynamics.history.trajectory import Trajectory as Trajectory
from .dynamics.maps.attractor_map import map_attractors as map_attractors
from .dynamics.maps.fate_map import map_fates as map_fates
from .dynamics.maps.noise_fates import NoiseFates as NoiseFates
from .dynamics.maps.noise_fates import compute_noise_fates as compute_noise_fates
from .dynamics.orbits.attractor import Attractor as Attractor
from .dynamics.orbits.attractor import find_attractor as find_attractor
from .dynamics.orbits.attractor_sweep import AttractorSweep as AttractorSweep
from .dynamics.orbits.attractor_sweep import sweep_attractor as sweep_attractor
from .dynamics.orbits.orbit import Orbit as Orbit
from .dynamics.orbits.return_map import Passage as Passage
from .dynamics.orbits.return_map import ReturnMap as ReturnMap
from .dynamics.orbits.search import find_orbits as find_orbits
from .dynamics.overturning.free_rocking import equivalent_damping as equivalent_damping
from .dynamics.overturning.free_rocking import free_rocking_peaks as free_rocking_peaks
from .dynamics.overturning.free_rocking import free_rocking_period as free_rocking_period
from .dynamics.overturning.kicks import FatalKicks as FatalKicks
from .dynamics.overturning.kicks import find_fatal_kick as find_fatal_kick
from .dynamics.overturning.thresholds import overturning_impulse as overturning_impulse
from .dynamics.overturning.thresholds import overturning_threshold as overturning_threshold
from .dynamics.overturning.window_lists import OverturningWindow as OverturningWindow
from .dynamics.overturning.windows import OverturningWindows as OverturningWindows
from .dynamics.overturning.windows import find_overturning_windows as find_overturning_windows
from .dynamics.steady.regions import RegionBoundaries as RegionBoundaries
from .dynamics.steady.regions import RegionMap as RegionMap
from .dynamics.steady.regions import compute_region_map as compute_region_map
from .dynamics.steady.regions import heteroclinic_amplitude as heteroclinic_amplitude
from .dynamics.steady.regions import melnikov_amplitude as melnikov_amplitude
from .dynamics.steady.regions import region_boundaries as region_boundaries
from .dynamics.steady.regions import symmetry_breaking_amplitude as symmetry_breaking_amplitude
from .dynamics.steady.regions import symmetry_breaking_frequency as symmetry_breaking_frequency
from .dynamics.steady.response import ResponseCurve as ResponseCurve
from .dynamics.steady.response import compute_response_curve as compute_response_curve
from .dynamics.steady.states import SteadyOrbit as SteadyOrbit
from .dynamics.steady.states import SteadyStates as SteadyStates
from .dynamics.steady.states import compute_steady_orbit as compute_steady_orbit
from .dynamics.steady.states import find_steady_states as find_steady_states
from .errors import InputError as InputError
from .errors import MissingKernelsError as MissingKernelsError
from .errors import ModelError as ModelError
from .errors import OutputError as OutputError
from .errors import RecordFileError as RecordFileError
from .errors import RocksteadyError as RocksteadyError
from .errors import UnfinishedError as UnfinishedError
from .explorer.view import ExplorerView as ExplorerView
from .explorer.write import write_explorer as write_explorer
from .installation.check import Installation as Installation
from .installation.check import KernelCheck as KernelCheck
from .installation.check import check_installation as check_installation
from .model.blocks.block import Block as Block
from .model.blocks.dimensionless import DimensionlessBlock as DimensionlessBlock
from .model.blocks.examples import named_block as named_block
from .model.blocks.sides import Side as Side
from .model.blocks.sides import housner_restitution as housner_restitution
from .model.blocks.sides import impact_restitution as impact_restitution
from .model.equations import Linear as Linear
from .model.equations import Nonlinear as Nonlinear
from .model.motions.band_noise import BandNoise as BandNoise
from .model.motions.band_noise import add_noise as add_noise
from .model.motions.base_motion import BaseMotion as BaseMotion
from .model.motions.combine import add_motions as add_motions
from .model.motions.combine import cut_motion as cut_motion
from .model.motions.combine import delay_motion as delay_motion
from .model.motions.combine import join_motions as join_motions
from .model.motions.combine import scale_motion as scale_motion
from .model.motions.fourier import FourierSeries as FourierSeries
from .model.motions.impulses import Impulses as Impulses
from .model.motions.pulses import Pulse as Pulse
from .model.motions.record import Record as Record
from .model.motions.segments import Harmonic as Harmonic
from .model.motions.segments import Piecewise as Piecewise
from .model.motions.segments import Segment as Segment
from .model.motions.segments import Still as Still
from .model.motions.synthetic import SyntheticMotion as SyntheticMotion
from .model.motions.synthetic_suite import make_synthetic_suite as make_synthetic_suite
from .outcomes import INFINITELY_MANY as INFINITELY_MANY
from .outcomes import NO_START as NO_START
from .outcomes import AttractorKind as AttractorKind
from .outcomes import Event as Event
from .outcomes import Status as Status
from .records.core.recording import Recording as Recording
from .records.pairing import RecordSet as RecordSet
from .records.pairing import pair_records as pair_records
from .records.processing import correct_baseline as correct_baseline
from .records.processing import resample as resample
from .records.read import read_record as read_record
from .records.read import read_recordings as read_recordings
from .risk.assess.assessment import Assessment as Assessment
from .risk.assess.assessment import assess_object as assess_object
from .risk.assess.described.facts import ObjectFacts as ObjectFacts
from .risk.assess.described.facts import derive_facts as derive_facts
from .risk.assess.described.objects import ObjectFile as ObjectFile
from .risk.assess.described.objects import read_object as read_object
from .risk.assess.described.tables import read_objects as read_objects
from .risk.assess.objects_table import ObjectsTable as ObjectsTable
from .risk.assess.objects_table import assess_objects as assess_objects
from .risk.assess.two_numbers import (
    QuickAssessment as QuickAssessment,
    assess_two_numbers as assess_two_numbers,
)
from .risk.back_analysis.back_analyse import back_analyse as back_analyse
from .risk.back_analysis.back_analysis import BackAnalysis as BackAnalysis
from .risk.back_analysis.read_survey import read_survey as read_survey
from .risk.back_analysis.scan import Scan as Scan
from .risk.back_analysis.survey import Survey as Survey
from .risk.calibration.calibrate import calibrate as calibrate
from .risk.calibration.calibration import Calibration as Calibration
from .risk.calibration.held_out.predictions import Predictions as Predictions
from .risk.calibration.held_out.scores import (
    Scores as Scores,
    score_predictions as score_predictions,
)
from .risk.calibration.held_out.validate import Validation as Validation
from .risk.calibration.posterior import Posterior as Posterior
from .risk.calibration.sampling import Sampling as Sampling
from .risk.calibration.stored import StoredPosterior as StoredPosterior
from .risk.calibration.stored import read_posterior as read_posterior
from .risk.ensemble.levels import Stripes as Stripes
from .risk.ensemble.restitution_band import RestitutionBand as RestitutionBand
from .risk.ensemble.runs import run_ensemble as run_ensemble
from .risk.facades.actions import (
    Load as Load,
    PushingMass as PushingMass,
    Thrust as Thrust,
    Tie as Tie,
)
from .risk.facades.check_facade import check_facade as check_facade
from .risk.facades.elastic_spectrum import ElasticSpectrum as ElasticSpectrum
from .risk.facades.facade import Facade as Facade
from .risk.facades.facade_check import Check as Check, FacadeCheck as FacadeCheck
from .risk.facades.facade_demand import FacadeDemand as FacadeDemand
from .risk.facades.facade_runs import FacadeRuns as FacadeRuns, run_facade as run_facade
from .risk.facades.mechanism import Mechanism as Mechanism
from .risk.facades.read_facade import FacadeFile as FacadeFile, read_facade as read_facade
from .risk.facades.record_demand import RecordDemand as RecordDemand
from .risk.facades.spectrum_table import (
    SpectrumTable as SpectrumTable,
    read_spectrum_table as read_spectrum_table,
)
from .risk.fits.bands import Bands as Bands
from .risk.fits.fragility_curve import FragilityCurve as FragilityCurve
from .risk.fits.fragility_curve import fit_curve as fit_curve
from .risk.fits.two_stages import TwoStageCurve as TwoStageCurve
from .risk.fits.two_stages import fit_two_stages as fit_two_stages
from .risk.fits.vector_fit import VectorFit as VectorFit
from .risk.fits.vector_fit import fit_vector as fit_vector
from .risk.fragility.damage_states import DamageState as DamageState
from .risk.fragility.efficiency import Efficiency as Efficiency
from .risk.fragility.fit_fragility import (
    compute_fragility as compute_fragility,
    fit_fragility as fit_fragility,
)
from .risk.fragility.fitting import Fitting as Fitting
from .risk.fragility.fragility import Fragility as Fragility
from .risk.fragility.state_fragility import StateFragility as StateFragility
from .risk.free_rocking.fit_restitution import fit_restitution as fit_restitution
from .risk.free_rocking.release import Release as Release
from .risk.free_rocking.restitution_fit import RestitutionFit as RestitutionFit
from .risk.hazard.balanced_rocks import BranchTest as BranchTest
from .risk.hazard.balanced_rocks import reject_branches as reject_branches
from .risk.hazard.failure_risk import Risk as Risk
from .risk.hazard.failure_risk import compute_risk as compute_risk
from .risk.hazard.hazard_curve import HazardCurve as HazardCurve
from .risk.hazard.read_hazard import read_hazard_curves as read_hazard_curves
from .risk.observations.fates import Scatter as Scatter
from .risk.observations.fates import fates_on_records as fates_on_records
from .risk.observations.object_prior import ObjectPrior as ObjectPrior
from .risk.observations.observations import Observations as Observations
from .risk.observations.prior import Noise as Noise
from .risk.observations.prior import Prior as Prior
from .risk.observations.prior import read_prior as read_prior
from .risk.observations.read_peaks import read_peaks as read_peaks
from .risk.observations.read_tests import read_tests as read_tests
from .risk.observations.shaking_test import ShakingTest as ShakingTest
from .risk.observations.spread import Spread as Spread
from .risk.observations.synthetic_tests import (
    make_synthetic_tests as make_synthetic_tests,
)
from .risk.screens.demand import Demand as Demand
from .risk.screens.screen import Screen as Screen
from .risk.screens.screens import Screens as Screens
from .risk.screens.screens import screen_block as screen_block
from .seismic.measures.intensity import IntensityMeasures as IntensityMeasures
from .seismic.measures.intensity import measure_intensity as measure_intensity
from .seismic.measures.response_spectrum import ResponseSpectrum as ResponseSpectrum
from .seismic.measures.response_spectrum import (
    average_spectral_acceleration as average_spectral_acceleration,
)
from .seismic.measures.response_spectrum import (
    compute_response_spectrum as compute_response_spectrum,
)
from .seismic.measures.scalar import Intensity as Intensity
from .seismic.measures.scalar import measure_scalar as measure_scalar
from .seismic.measures.time_course import IntegratedRecord as IntegratedRecord
from .seismic.measures.time_course import Peak as Peak
from .seismic.measures.time_course import integrate_record as integrate_record
from .seismic.spectra.many import simulate_many as simulate_many
from .seismic.spectra.overturning_scales import OverturningScales as OverturningScales
from .seismic.spectra.overturning_scales import (
    find_overturning_scales as find_overturning_scales,
)
from .seismic.spectra.rocking import compute_rocking_spectrum as compute_rocking_spectrum
from .seismic.spectra.suite import summarise_spectra as summarise_spectra
from .show.assessment.folder import write_assessment as write_assessment
from .show.assessment.object_report import write_report as write_report
from .show.calibration.calibration_folder import write_calibration as write_calibration
from .show.export.components import LossComponent as LossComponent
from .show.export.components import LossState as LossState
from .show.export.dataset import export as export
from .show.export.ensemble_rows import write_results_csv as write_results_csv
from .show.export.manifest import make_manifest as make_manifest
from .show.export.manifest import write_manifest as write_manifest
from .show.export.openquake import write_openquake as write_openquake
from .show.export.pelicun import write_pelicun as write_pelicun
from .show.export.tests_folder import write_tests as write_tests
from .show.facade.facade_folder import write_facade_folder as write_facade_folder
from .show.film.animation import animate as animate
from .show.film.still import plot_block as plot_block
from .show.plots.portraits.basins import plot_basins as plot_basins
from .show.plots.portraits.basins import plot_erosion as plot_erosion
from .show.plots.portraits.basins import plot_safe_basin as plot_safe_basin
from .show.plots.portraits.edges import plot_edge_state as plot_edge_state
from .show.plots.portraits.manifolds import plot_manifolds as plot_manifolds
from .show.plots.portraits.shares import plot_basin_shares as plot_basin_shares
from .show.plots.portraits.fate_basins import plot_fate_basins as plot_fate_basins
from .show.plots.branches.bifurcations import plot_bifurcations as plot_bifurcations
from .show.plots.branches.curves import plot_bifurcation_curves as plot_bifurcation_curves
from .show.plots.branches.cascades import plot_cascade as plot_cascade
from .show.plots.facades.capacity import plot_capacity as plot_capacity
from .show.plots.facades.run_displacements import plot_facade_runs as plot_facade_runs
from .show.plots.facades.section import plot_facade as plot_facade
from .show.plots.maps import plot_map as plot_map
from .show.plots.motion import plot_base as plot_base
from .show.plots.motion import plot_phase_portrait as plot_phase_portrait
from .show.plots.motion import plot_trajectory as plot_trajectory
from .show.plots.observations.back_analysis import plot_back_analysis as plot_back_analysis
from .show.plots.observations.ladders import plot_ladders as plot_ladders
from .show.plots.observations.posteriors import plot_posterior as plot_posterior
from .show.plots.observations.predictions import plot_predictions as plot_predictions
from .show.plots.observations.reliability import plot_reliability as plot_reliability
from .show.plots.observations.residuals import plot_residuals as plot_residuals
from .show.plots.observations.restitution import plot_restitution as plot_restitution
from .show.plots.observations.scores import plot_learning as plot_learning
from .show.plots.observations.scores import plot_temper as plot_temper
from .show.plots.orbits import plot_multipliers as plot_multipliers
from .show.plots.orbits import plot_section as plot_section
from .show.plots.overturning import plot_free_rocking as plot_free_rocking
from .show.plots.overturning import plot_overturning as plot_overturning
from .show.plots.overturning_noise import plot_noise_fates as plot_noise_fates
from .show.plots.overturning_scales import plot_fatal_kicks as plot_fatal_kicks
from .show.plots.overturning_scales import (
    plot_overturning_scales as plot_overturning_scales,
)
from .show.plots.records import plot_husid as plot_husid
from .show.plots.records import plot_integrated_record as plot_integrated_record
from .show.plots.records import plot_response_spectra as plot_response_spectra
from .show.plots.risk.fragility import plot_fragility as plot_fragility
from .show.plots.risk.fragility import plot_fragility_states as plot_fragility_states
from .show.plots.risk.hazard import plot_risk as plot_risk
from .show.plots.risk.tornado import plot_ranking as plot_ranking
from .show.plots.risk.tornado import plot_tornado as plot_tornado
from .show.plots.spectra import plot_overturned_share as plot_overturned_share
from .show.plots.spectra import plot_rocking_spectrum as plot_rocking_spectrum
from .show.plots.spectra import plot_spectrum_map as plot_spectrum_map
from .show.plots.spectra import plot_suite_spectrum as plot_suite_spectrum
from .show.plots.steady import plot_orbit as plot_orbit
from .show.plots.steady import plot_regions as plot_regions
from .show.plots.steady import plot_response as plot_response
from .sweep.cases.axes import Axis as Axis
from .sweep.cases.grid import Grid as Grid
from .sweep.cases.outputs import Output as Output
from .sweep.evaluate import evaluate as evaluate
from .sweep.run import Run as Run
from .sweep.store.reading import open_store as open_store
from .sweep.store.store import Store as Store

__all__: list[str]
__version__: str
