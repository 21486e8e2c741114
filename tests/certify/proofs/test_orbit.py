"""Orbits proved: against the closed forms in 40 digits, and against every verdict of the search."""

import mpmath as mp
import numpy as np
import pytest
from flint import arb

import rocksteady as rs
from rocksteady.certify.proofs._balls import precision
from rocksteady.certify.proofs.orbit import certify_orbit, propose, prove_orbit
from rocksteady.errors import ModelError
from tests.every import every

BLOCK = rs.DimensionlessBlock(restitution=0.8)


def orbits(amplitude: float, ratio: float, restitution: float = 0.8) -> tuple[rs.orbits.Orbit, ...]:
    motion = rs.Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    block = rs.DimensionlessBlock(restitution=restitution)
    return rs.find_orbits(block, motion, max_period=3, seeds=12)


def closed_form(amplitude: str, ratio: str, restitution: str, order: int) -> tuple[mp.mpf, mp.mpf]:
    """Phase of branch 1 by (21), (22), and the trace of half a period, in 40 digits."""
    a, w, r = map(mp.mpf, (amplitude, ratio, restitution))
    length, share = order * mp.pi / w, (1 - r) / (1 + r)
    h, beta = mp.tanh(length / 2), a / (1 + w * w)
    p, q = share * h * w, share * h * h / beta
    root = mp.sqrt(1 + p * p - q * q)
    sine, cosine = (q + p * root) / (1 + p * p), (q * p - root) / (1 + p * p)
    growth = (mp.cosh(length) - 1) * (1 - r)
    trace = growth * ((1 + r) / (beta * sine) - (1 - r) * (1 + w * w)) / 2
    return mp.atan2(sine, cosine), trace - 2 * r * mp.cosh(length)


@every(
    "amplitude, ratio, restitution, order",
    [
        ("2", "2", "0.8", 1),
        ("6", "4", "0.8", 1),
        ("2", "6", "0.8", 3),
        ("2", "4.4", "0.8", 3),
        ("0.75", "4", "0.5", 1),
    ],
)
def test_symmetric_states_are_those_of_the_closed_form(
    amplitude: str, ratio: str, restitution: str, order: int
) -> None:
    found = orbits(float(amplitude), float(ratio), float(restitution))
    orbit = next(each for each in found if each.branch == 1 and each.period == order)
    proof = prove_orbit(propose(orbit))
    assert proof.verdict == "proved"
    assert proof.stability == "stable"
    assert proof.zero is not None
    assert proof.trace is not None
    with mp.workdps(40), precision(200):
        phase, trace = closed_form(amplitude, ratio, restitution, order)
        assert proof.zero.box[0].overlaps(arb(mp.nstr(phase, 35)))
        assert proof.zero.box[0].rad() < 1e-15
        assert proof.trace.overlaps(arb(mp.nstr(trace, 30)))


@every("times", [2, 3, 4])
def test_a_motion_that_is_repeated_is_no_motion_of_its_own(times: int) -> None:
    for orbit in (each for each in orbits(2.4, 2.0) if each.admissible and not each.rest_phases):
        chain = propose(orbit)
        repeated = chain._replace(
            half_periods=times * chain.half_periods, phases=times * chain.phases
        )
        whole = times == 2 and len(chain.phases) % 2 == 1  # both halves of a symmetric motion
        assert prove_orbit(repeated).verdict == ("proved" if whole else "undecided")


@every("case", [(2.4, 2.0), (2.655, 2.0), (2.0, 1.78), (0.9, 3.0)])
def test_every_verdict_of_the_search_is_proved(case: tuple[float, float]) -> None:
    found = [each for each in orbits(*case) if not each.rest_phases]
    assert len(found) >= 3
    for orbit in found:
        proof = prove_orbit(propose(orbit))
        assert proof.verdict == ("proved" if orbit.admissible else "refuted"), proof.reason
        if orbit.admissible:
            assert (proof.stability == "stable") == orbit.stable
            assert abs(float(proof.trace.mid()) - trace_of(orbit)) < 1e-7 * (  # type: ignore[union-attr]
                1.0 + abs(trace_of(orbit))
            )


def trace_of(orbit: rs.orbits.Orbit) -> float:
    """The trace of the chain that is proved, from the multipliers of the whole orbit."""
    total = float(orbit.multipliers.sum().real)
    if not orbit.symmetric:
        return total
    loss = 0.8 ** len(orbit.states)
    half = np.sqrt(total + 2.0 * loss)  # multipliers of half the orbit squared
    proof = prove_orbit(propose(orbit))
    assert proof.trace is not None
    return float(np.copysign(half, float(proof.trace.mid())))


@pytest.mark.slow
def test_a_thousand_states_agree_with_the_closed_forms_verdicts() -> None:
    random = np.random.default_rng(1)
    counts = {"proved": 0, "refuted": 0, "undecided": 0}
    for _ in range(500):
        a, w, r = random.uniform(0.3, 6), random.uniform(1, 8), random.uniform(0.3, 0.95)
        for orbit in rs.find_orbits(
            rs.DimensionlessBlock(restitution=r),
            rs.Harmonic(amplitude=a, frequency_ratio=w),
            max_period=1,
            seeds=2,
        ):
            if orbit.branch is None:
                continue
            proof = prove_orbit(propose(orbit))
            counts[proof.verdict] += 1
            if proof.verdict == "undecided":
                continue
            assert (proof.verdict == "proved") == orbit.admissible, (a, w, r)
            if orbit.admissible:
                assert (proof.stability == "stable") == orbit.stable, (a, w, r)
    assert sum(counts.values()) > 800
    assert counts["undecided"] == 0


def test_bits_grow_towards_a_fold_until_it_is_decided() -> None:
    fold = mp.mpf("0.23642815558672063973934133364")
    few, more = (
        next(o for o in orbits(float(fold) * (1 + part), 2.0) if o.branch == 1)
        for part in (1e-2, 1e-12)
    )
    assert prove_orbit(propose(few)).bits == 64
    assert prove_orbit(propose(more), 256).bits >= 64


def test_a_certificate_says_what_it_is_one_of() -> None:
    certificate = certify_orbit(orbits(2.0, 2.0)[0])
    assert certificate.proved
    assert "restitution: the decimal, its double, and all between" in certificate.summary()
    assert len(certificate.to_json()) < 700


def test_what_no_proof_is_written_for_is_refused_with_what_is_missing() -> None:
    motion = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    sides = rs.DimensionlessBlock(restitution=0.8, negative_restitution=0.7)
    with pytest.raises(ModelError, match="flights of two kinds for sides that differ"):
        certify_orbit(rs.find_orbits(sides, motion, max_period=1, seeds=8)[0])
    full = rs.find_orbits(
        rs.Block.from_p(alpha=0.1, p=2.0, restitution=0.8),
        motion,
        max_period=1,
        seeds=4,
        model=rs.Nonlinear(),
    )[0]
    with pytest.raises(ModelError, match="Taylor series of the full equations"):
        certify_orbit(full)
    resting = [
        each
        for each in rs.find_orbits(
            rs.DimensionlessBlock(restitution=0.25), rs.Harmonic(amplitude=6.0, frequency_ratio=6.0)
        )
        if each.rest_phases
    ]
    for orbit in resting[:1]:
        with pytest.raises(ModelError, match="infinitely many impacts before a rest"):
            certify_orbit(orbit)
