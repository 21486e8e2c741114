"""Proofs in ball arithmetic, their certificates, and the programs that check them alone."""

from functools import partial

from rocksteady.errors import ModelError, Words, check_installed

check_installed(partial(ModelError, "proofs", Words("cannot be computed")), "proof", "flint")
