"""Where each public name is defined."""

from .dynamics.history.neighbours import Neighbour as Neighbour
from .dynamics.history.neighbours import Neighbours as Neighbours
from .dynamics.history.samples import Flights as Flights
from .dynamics.history.samples import Impacts as Impacts
from .dynamics.history.samples import Samples as Samples
from .dynamics.history.start import ImpactState as ImpactState
from .dynamics.history.trajectory import Trajectory as Trajectory
from .risk.free_rocking.release import Release as Release

__all__: list[str]
