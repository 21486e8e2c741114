"""The nonlinear equation of motion: its flights, in Taylor series, and what is proved of them."""
