"""Where each public name is defined."""

from .outcomes import INFINITELY_MANY as INFINITELY_MANY
from .outcomes import NO_START as NO_START
from .sweep.cases.axes import Axis as Axis
from .sweep.cases.grid import Grid as Grid
from .sweep.cases.outputs import Output as Output
from .sweep.evaluate import evaluate as evaluate

__all__: list[str]
