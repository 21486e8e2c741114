"""What orbits are in an answer."""

from rocksteady.dynamics.orbits.orbit import Orbit


def beyond_alpha(orbit: Orbit) -> bool:
    """Return whether a motion tilts beyond alpha."""
    return bool(max(orbit.highest, -orbit.lowest) > 1.0)
