"""The public namespace: where each name on top is defined, and the public modules."""

from . import basins as basins
from . import branches as branches
from . import calibration as calibration
from . import codes as codes
from . import errors as errors
from . import export as export
from . import formulas as formulas
from . import histories as histories
from . import installation as installation
from . import measures as measures
from . import motions as motions
from . import orbits as orbits
from . import outcomes as outcomes
from . import overturning as overturning
from . import plots as plots
from . import proofs as proofs
from . import records as records
from . import risk as risk
from . import sweeps as sweeps

from .dynamics.basins.basins import compute_basins as compute_basins
from .dynamics.basins.erosion import compute_erosion as compute_erosion
from .dynamics.basins.fate_basins import compute_fate_basins as compute_fate_basins
from .dynamics.continuation.curves.search_plane import (
    find_bifurcation_curves as find_bifurcation_curves,
)
from .dynamics.continuation.find_bifurcations import find_bifurcations as find_bifurcations
from .dynamics.edges.tracking import find_edge_state as find_edge_state
from .dynamics.history.neighbours import check_neighbours as check_neighbours
from .dynamics.history.simulate import simulate as simulate
from .dynamics.history.start import Rest as Rest
from .dynamics.history.start import State as State
from .dynamics.history.start import Steady as Steady
from .dynamics.maps.attractor_map import map_attractors as map_attractors
from .dynamics.maps.fate_map import map_fates as map_fates
from .dynamics.maps.noise_fates import compute_noise_fates as compute_noise_fates
from .dynamics.orbits.attractor import find_attractor as find_attractor
from .dynamics.orbits.search import find_orbits as find_orbits
from .dynamics.overturning.kicks import find_fatal_kicks as find_fatal_kicks
from .dynamics.overturning.windows import find_overturning_windows as find_overturning_windows
from .dynamics.steady.response import compute_response_curve as compute_response_curve
from .dynamics.steady.states import find_steady_states as find_steady_states
from .errors import RocksteadyError as RocksteadyError
from .explorer.write import write_explorer as write_explorer
from .model.blocks.block import Block as Block
from .model.blocks.dimensionless import DimensionlessBlock as DimensionlessBlock
from .model.equations import Linear as Linear
from .model.equations import Nonlinear as Nonlinear
from .model.motions.base_motion import BaseMotion as BaseMotion
from .model.motions.floor import floor_motion as floor_motion
from .model.motions.pulses import Pulse as Pulse
from .model.motions.record import Record as Record
from .model.motions.segments import Harmonic as Harmonic
from .model.motions.segments import Piecewise as Piecewise
from .model.motions.segments import Still as Still
from .model.motions.synthetic import SyntheticMotion as SyntheticMotion
from .outcomes import Status as Status
from .records.read import read_record as read_record
from .records.suite import read_records as read_records
from .risk.assess.assessment import assess_object as assess_object
from .risk.assess.described.objects import read_object as read_object
from .risk.assess.described.tables import read_objects as read_objects
from .risk.assess.objects_table import assess_objects as assess_objects
from .risk.back_analysis.back_analyse import back_analyse as back_analyse
from .risk.back_analysis.read_survey import read_survey as read_survey
from .risk.calibration.calibrate import calibrate as calibrate
from .risk.ensemble.runs import run_ensemble as run_ensemble
from .facades.checks.check_facade import check_facade as check_facade
from .facades.checks.read_facade import read_facade as read_facade
from .risk.fragility.compute_fragility import compute_fragility as compute_fragility
from .risk.free_rocking.fit_restitution import fit_restitution as fit_restitution
from .risk.hazard.failure_risk import compute_risk as compute_risk
from .risk.hazard.read_hazard import read_hazard_curves as read_hazard_curves
from .risk.observations.read_tests import read_tests as read_tests
from .risk.screens.demand import Demand as Demand
from .risk.screens.screens import screen_block as screen_block
from .seismic.measures.intensity import compute_measures as compute_measures
from .seismic.spectra.many import simulate_many as simulate_many
from .seismic.spectra.overturning_scales import find_overturning_scales as find_overturning_scales
from .seismic.spectra.rocking import compute_rocking_spectrum as compute_rocking_spectrum
from .sweep.run import Execution as Execution
from .sweep.store.reading import open_store as open_store
from .sweep.store.store import Store as Store

__all__: list[str]
__version__: str
