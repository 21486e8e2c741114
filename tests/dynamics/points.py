"""Points of the plane that several tests of steady states draw from."""

from typing import Any

from hypothesis import strategies as st

from rocksteady.formulas import steady_states
from rocksteady.orbits import SteadyStates
from tests.strategies import logarithmic

orders = st.sampled_from([1, 3, 5, 7])
points = st.tuples(logarithmic(0.05, 12.0), logarithmic(0.3, 50.0), st.floats(0.05, 0.999), orders)


def states_at(point: tuple[float, float, float, int], **options: bool) -> SteadyStates:
    a, w, r, n = point
    return steady_states(a, w, r, order=n, **options)


def checked(values: Any) -> Any:
    """Return an attribute that is None without shapes, known to be there."""
    assert values is not None
    return values
