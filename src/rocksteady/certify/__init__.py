"""Proofs in ball arithmetic, their certificates, and the programs that check them alone."""

from importlib.util import find_spec

from rocksteady.errors import ModelError, Words

if find_spec("flint") is None:
    raise ModelError(
        "python-flint",
        Words("is not installed"),
        "proofs are computed in its ball arithmetic",
        'install it: python3 -m pip install "rocksteady[proof]"',
    )
