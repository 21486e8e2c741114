"""Where linear, nonlinear static and dynamic checks of a facade disagree."""
