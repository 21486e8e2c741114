"""The statement on slender blocks: its verdict turns where the full equations are others."""

from collections.abc import Callable

import pytest

from rocksteady.studies.tso_wong_1989.claims import _linearised as linearised
from tests.studies.tso_wong_1989.whole import evidence, finding, found

pytestmark = pytest.mark.usefixtures("computed")

REFERENCE = (0.18530, 0.18494, 0.18350, 0.18107)
"""Peaks at alpha = 0.05, 0.1, 0.2, 0.3 of an independent integrator, which samples the motion."""

LINEAR = 0.18549910598627367

FALSE: dict[str, list[Callable[[float], float]]] = {
    # An error that does not go with alpha^2, and one that is large.
    "slender": [
        lambda alpha: LINEAR * (1.0 - 0.02 * alpha),
        lambda alpha: LINEAR * (1.0 - 2.0 * alpha**2),
    ],
}
"""Peaks with which the verdict must be the other one."""


@pytest.mark.parametrize("peak", FALSE["slender"])
def test_a_verdict_turns_with_its_evidence(
    peak: Callable[[float], float], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert finding("slender").holds is True
    monkeypatch.setattr(linearised, "peak_by_full_equations", peak)
    assert found("slender", evidence()).holds is False


def test_the_peaks_are_those_of_an_independent_integrator() -> None:
    values = finding("slender").values
    assert values["linear"] == pytest.approx(0.18550, abs=5e-6)
    assert values["peaks"] == pytest.approx(REFERENCE, abs=1e-4)
