"""Windows of stable motions with more impacts: their borders, to the digits known."""

import numpy as np
import pytest

from rocksteady.studies.atlas.analysis.coexistence import OrbitClass, coexistence
from rocksteady.studies.atlas.analysis.plane import Plane
from rocksteady.studies.atlas.analysis.windows import windows


@pytest.mark.slow
def test_the_window_of_six_impacts_has_exact_borders() -> None:
    fine = Plane(
        restitution=0.8,
        amplitude=np.linspace(3.2, 3.8, 13),
        frequency_ratio=np.linspace(7.0, 10.0, 4),
    )
    (window,) = (w for w in windows(coexistence(fine)) if w.orbits == OrbitClass(3, 6, False))
    # A fold and a symmetry breaking of the branch that comes back from the graze at A = 9.09.
    assert window.frequency_ratio == 10.0
    assert window.low == pytest.approx(3.58212, abs=1e-5)
    assert window.high == pytest.approx(3.64173, abs=1e-5)
    assert {line.name for line in window.lines} >= {"fold", "symmetry-breaking"}
    assert {line.impacts for line in window.lines} == {6}
