"""Where each public name is defined."""

from .assess.assessment import Assessment as Assessment
from .assess.described.facts import ObjectFacts as ObjectFacts
from .assess.described.facts import compute_object_facts as compute_object_facts
from .assess.described.building import Building as Building
from .assess.described.building import read_buildings as read_buildings
from .assess.described.objects import DescribedObject as DescribedObject
from .assess.objects_table import ObjectsTable as ObjectsTable
from .assess.two_numbers import FormulaAssessment as FormulaAssessment
from .assess.two_numbers import assess_by_formula as assess_by_formula
from .counted.built_in import make_built_in_suite as make_built_in_suite
from .counted.suite import Peaks as Peaks
from .counted.verdict import Target as Target
from .ensemble.levels import Levels as Levels
from .ensemble.restitution_band import RestitutionBand as RestitutionBand
from .ensemble.ways import Ways as Ways
from .fits.fragility_curve import FragilityCurve as FragilityCurve
from .fits.fragility_curve import fit_curve as fit_curve
from .fragility.damage_states import DamageState as DamageState
from .fragility.compute_fragility import count_fragility as count_fragility
from .fragility.fragility import Fragility as Fragility
from .fragility.state_fragility import StateFragility as StateFragility
from .hazard.balanced_rocks import HazardBranchCheck as HazardBranchCheck
from .hazard.balanced_rocks import check_hazard_branches as check_hazard_branches
from .hazard.failure_risk import Risk as Risk
from .hazard.hazard_curve import HazardCurve as HazardCurve

__all__: list[str]
