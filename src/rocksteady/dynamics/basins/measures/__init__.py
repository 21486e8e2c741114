"""How uncertain the attractor of a state is: entropy, exponent and test of labelled states."""
