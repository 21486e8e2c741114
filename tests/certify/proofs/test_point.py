"""Bifurcation points, against their closed forms in 35 digits and the published cascade."""

import mpmath as mp
import pytest

import rocksteady as rs
from rocksteady.certify.proofs import checker
from rocksteady.certify.proofs.point import certify_point
from rocksteady.errors import ModelError

BLOCK = rs.DimensionlessBlock(restitution=0.8)
DOUBLINGS = (
    "2.624661060049262795522613056",
    "2.681131829276628259455446143",
    "2.69052938690430352439974283",
    "2.6924570168677",
)
"""Of 2, 4, 8 and 16 impacts at Omega = 2, restitution .8, by another program."""


def branch_points(direction: int) -> list[rs.branches.BranchPoint]:
    motion = rs.Harmonic(amplitude=1.0, frequency_ratio=2.0)
    orbit = rs.find_orbits(BLOCK, motion, max_period=1, seeds=2)[0]
    found = rs.branches.follow_branch(orbit, "amplitude", (0.1, 2.3), direction=direction)
    return [each for each in found if each.type != "regular"]


def test_fold_and_symmetry_breaking_are_the_closed_forms() -> None:
    with mp.workdps(40):
        r, w = mp.mpf("0.8"), mp.mpf(2)
        share, h = (1 - r) / (1 + r), mp.tanh(mp.pi / 4)
        fold = (1 + w * w) * share * h * h / mp.sqrt(1 + (share * h * w) ** 2)  # (23)
        level = (1 - r) ** 2 * (1 + w * w) / 2 + 2 * r - (1 - r) ** 2 / (mp.cosh(mp.pi / 2) - 1)
        s = (1 + r) ** 2 / (2 * level)
        breaking = (1 + w * w) * mp.sqrt((share * s) ** 2 + ((h * h - s) / (h * w)) ** 2)  # (M)
        for direction, name, exact, sign in (
            (-1, "fold", fold, 1),
            (1, "symmetry-breaking", breaking, -1),
        ):
            point = next(each for each in branch_points(direction) if each.type == name)
            certificate = certify_point(point)
            assert certificate.proved
            enclosed = mp.mpf(str(certificate.content["amplitude"]))
            assert abs(enclosed - exact) < mp.mpf(10) ** -30
            side = {} if sign == 1 else {"criticality": "supercritical"}
            assert certificate.content["claim"] == {"sign": sign, "opens": 1} | side
            assert checker.check(certificate.to_json(), checker.arb) == "holds"
            assert ("supercritical" in certificate.claim) == (sign < 0)


def test_only_points_with_a_multiplier_of_1_or_minus_1_are_proved() -> None:
    with pytest.raises(ModelError, match="fold, a symmetry-breaking or a period-doubling"):
        certify_point(branch_points(1)[-1])


@pytest.mark.slow
def test_the_cascade_is_certified_to_two_to_the_fifth() -> None:
    motion = rs.Harmonic(amplitude=1.0, frequency_ratio=2.0)
    orbit = rs.find_orbits(BLOCK, motion, max_period=1, seeds=2)[0]
    cascade = rs.branches.find_cascade(orbit, "amplitude", (0.5, 3.0), doublings=4)
    assert [each.impacts for each in cascade.points] == [2, 4, 8, 16]
    for point, digits in zip(cascade.points, DOUBLINGS, strict=True):
        certificate = certify_point(point)
        assert certificate.proved
        assert "supercritical" in certificate.claim
        assert str(certificate.content["amplitude"]).startswith(digits[:-1])
        assert checker.check(certificate.to_json(), checker.arb) == "holds"
