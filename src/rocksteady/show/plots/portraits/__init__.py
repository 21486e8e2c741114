"""Sets of states, drawn in the plane of angle and velocity."""
