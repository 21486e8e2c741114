"""Rocking of free-standing rigid blocks on a shaking base: exact, complete and fast.

This is the flat public namespace. Every name is imported from the module that defines it when it
is first used, so that ``import rocksteady`` costs nothing and loads no compiled code.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rocksteady.dynamics.simulate import simulate
    from rocksteady.dynamics.steady import SteadyStates, steady_states
    from rocksteady.dynamics.trajectory import Trajectory
    from rocksteady.errors import InputError, ModelError, OutputError, RocksteadyError, Status
    from rocksteady.model.block import Block, DimensionlessBlock
    from rocksteady.model.motions import Harmonic, Piecewise, Segment, Still
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
    "Block",
    "DimensionlessBlock",
    "Harmonic",
    "InputError",
    "ModelError",
    "OutputError",
    "Piecewise",
    "RocksteadyError",
    "Segment",
    "Status",
    "SteadyStates",
    "Still",
    "Trajectory",
    "__version__",
    "simulate",
    "steady_states",
]

_DEFINED_IN = {
    "Block": "rocksteady.model.block",
    "DimensionlessBlock": "rocksteady.model.block",
    "Harmonic": "rocksteady.model.motions",
    "InputError": "rocksteady.errors",
    "ModelError": "rocksteady.errors",
    "OutputError": "rocksteady.errors",
    "Piecewise": "rocksteady.model.motions",
    "RocksteadyError": "rocksteady.errors",
    "Segment": "rocksteady.model.motions",
    "Status": "rocksteady.errors",
    "SteadyStates": "rocksteady.dynamics.steady",
    "Still": "rocksteady.model.motions",
    "Trajectory": "rocksteady.dynamics.trajectory",
    "simulate": "rocksteady.dynamics.simulate",
    "steady_states": "rocksteady.dynamics.steady",
}


def __dir__() -> list[str]:
    """Return the public names, whether they are imported yet or not."""
    return list(__all__)
