"""The public names and their signatures: those of a text file, tests/frozen/signatures.txt."""

import sys

import numpy as np
import pytest
from numpy.typing import NDArray

from tools.freeze.records import FOLDER, dumped, loaded, moved, short
from tools.freeze.results import freeze_signatures

OTHERWISE = sys.version_info >= (3, 12) or "tuple" not in str(NDArray[np.float64])
"""Whether a later Python or NumPy's lower bound write annotations in other words."""


@pytest.mark.skipif(OTHERWISE, reason="annotations have other words there")
def test_the_public_names_and_signatures_are_the_recorded_ones() -> None:
    """A new one is recorded by `make freeze`; one that goes or changes is a line of CHANGELOG."""
    recorded = loaded((FOLDER / "signatures.txt").read_text(encoding="utf-8"))
    assert len(recorded) > 300
    differences = moved(recorded, loaded(dumped(short(dict(freeze_signatures(""))))))
    assert not differences, "\n".join(differences.values())
