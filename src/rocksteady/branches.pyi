"""Where each public name is defined."""

from .dynamics.continuation.branch import follow_branch as follow_branch
from .dynamics.continuation.branches import BranchOptions as BranchOptions
from .dynamics.continuation.branches import find_branches as find_branches
from .dynamics.continuation.cascade import Cascade as Cascade
from .dynamics.continuation.cascade import find_cascade as find_cascade
from .dynamics.continuation.chains.point_types import PointType as PointType
from .dynamics.continuation.curves.bifurcation_curves import BifurcationCurve as BifurcationCurve
from .dynamics.continuation.curves.bifurcation_curves import BifurcationCurves as BifurcationCurves
from .dynamics.continuation.curves.bifurcation_curves import (
    CodimensionTwoPoint as CodimensionTwoPoint,
)
from .dynamics.continuation.curves.bifurcation_curves import CurveOptions as CurveOptions
from .dynamics.continuation.curves.bifurcation_curves import Region as Region
from .dynamics.continuation.curves.loci import follow_bifurcation as follow_bifurcation
from .dynamics.continuation.diagram import Bifurcation as Bifurcation
from .dynamics.continuation.diagram import BifurcationDiagram as BifurcationDiagram
from .dynamics.continuation.points import Branch as Branch
from .dynamics.continuation.points import BranchPoint as BranchPoint
from .dynamics.continuation.points import Stretch as Stretch
from .dynamics.continuation.resting.find_resting import RestingBranches as RestingBranches
from .dynamics.continuation.resting.find_resting import RestingGap as RestingGap
from .dynamics.continuation.resting.find_resting import (
    find_resting_branches as find_resting_branches,
)
from .dynamics.continuation.resting.find_resting import (
    follow_resting_branch as follow_resting_branch,
)
from .dynamics.continuation.resting.resting_branch import Excursion as Excursion
from .dynamics.continuation.resting.resting_branch import RestingBranch as RestingBranch
from .dynamics.continuation.resting.resting_branch import RestingPoint as RestingPoint
from .dynamics.continuation.resting.resting_types import NoRest as NoRest
from .dynamics.continuation.resting.resting_types import RestingPointType as RestingPointType

__all__: list[str]
