"""Where each public name is defined."""

from .risk.back_analysis.back_analysis import BackAnalysis as BackAnalysis
from .risk.back_analysis.scan import ScanOptions as ScanOptions
from .risk.back_analysis.survey import Survey as Survey
from .risk.calibration.calibration import Calibration as Calibration
from .risk.calibration.held_out.predictions import Predictions as Predictions
from .risk.calibration.held_out.scores import Scores as Scores
from .risk.calibration.held_out.validate import Validation as Validation
from .risk.calibration.posterior import Posterior as Posterior
from .risk.calibration.stored_posterior import StoredPosterior as StoredPosterior
from .risk.calibration.stored import read_posterior as read_posterior
from .risk.free_rocking.restitution_fit import RestitutionFit as RestitutionFit
from .risk.observations.fates import Scatter as Scatter
from .risk.observations.fates import compute_test_fates as compute_test_fates
from .risk.observations.object_prior import ObjectPrior as ObjectPrior
from .risk.observations.observations import Observations as Observations
from .risk.observations.prior import OutcomeErrors as OutcomeErrors
from .risk.observations.prior import Prior as Prior
from .risk.observations.prior import read_prior as read_prior
from .risk.observations.read_peaks import read_peaks as read_peaks
from .risk.observations.shaking_test import ShakingTest as ShakingTest
from .risk.observations.spread import PriorRange as PriorRange
from .risk.observations.synthetic_tests import make_synthetic_tests as make_synthetic_tests

__all__: list[str]
