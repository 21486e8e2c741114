"""Where each public name is defined."""

from .dynamics.basins.basins import BasinShare as BasinShare
from .dynamics.basins.basins import Basins as Basins
from .dynamics.basins.erosion import Erosion as Erosion
from .dynamics.basins.erosion import IntegrityDrop as IntegrityDrop
from .dynamics.basins.fate_basins import FateBasins as FateBasins
from .dynamics.basins.fate_basins import FateShare as FateShare
from .dynamics.basins.labels import BasinAttractor as BasinAttractor
from .dynamics.basins.measures.boundary import BoundaryCheck as BoundaryCheck
from .dynamics.basins.measures.boundary import check_boundary as check_boundary
from .dynamics.basins.measures.entropy import BasinEntropies as BasinEntropies
from .dynamics.basins.measures.entropy import BasinEntropy as BasinEntropy
from .dynamics.basins.measures.entropy import compute_basin_entropy as compute_basin_entropy
from .dynamics.basins.measures.uncertainty import UncertaintyExponent as UncertaintyExponent
from .dynamics.basins.measures.uncertainty import (
    compute_uncertainty_exponent as compute_uncertainty_exponent,
)
from .dynamics.basins.over.families import BasinFamily as BasinFamily
from .dynamics.basins.over.matching import MatchingOptions as MatchingOptions
from .dynamics.basins.over.shares import BasinShares as BasinShares
from .dynamics.basins.over.shares import SamplingOptions as SamplingOptions
from .dynamics.basins.over.shares import compute_basin_shares as compute_basin_shares
from .dynamics.edges.edge_state import EdgeState as EdgeState
from .dynamics.edges.growing import compute_manifold as compute_manifold
from .dynamics.edges.hilltop import HilltopSaddle as HilltopSaddle
from .dynamics.edges.hilltop import find_hilltop_saddles as find_hilltop_saddles
from .dynamics.edges.manifold import Manifold as Manifold
from .dynamics.edges.manifold import ManifoldBranch as ManifoldBranch

__all__: list[str]
