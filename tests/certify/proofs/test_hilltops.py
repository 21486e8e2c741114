"""What is searched near the hilltops: phases by the equation of endless flights, and entropies."""

import math

from rocksteady.certify.proofs._hilltops import entropy_of, hilltop_phases, horseshoes
from rocksteady.formulas import heteroclinic_amplitude


def test_phases_solve_the_equation_of_endless_flights() -> None:
    a, w, r = 2.0, 2.0, 0.8
    for phase in hilltop_phases(a, w, r):
        left = (1 + r) * math.sin(phase) + (1 - r) * w * math.cos(phase)
        assert abs(left - (1 - r) * (1 + w * w) / a) < 1e-14
    least = float(heteroclinic_amplitude(w, r))
    assert hilltop_phases(0.999 * least, w, r) == []
    assert len(hilltop_phases(1.001 * least, w, r)) == 2


def test_entropy_is_the_growth_of_the_number_of_sequences() -> None:
    # Two symbols and flights of 3, 5, ... half periods, counted: c(L) = sum over n of 2 c(L - n).
    counts = [1]
    for length in range(1, 400):
        counts.append(sum(2 * counts[length - n] for n in range(3, length + 1, 2)))
    rate = 2.0 * math.log(counts[399] / counts[299]) / 100.0
    assert abs(entropy_of(2, 3) - rate) < 1e-6


def test_claims_come_by_their_entropy() -> None:
    entropies = [float(c["claim"]["entropy_per_period"]) for c in horseshoes(2.0, 2.0, 0.8)]
    assert entropies == sorted(entropies, reverse=True)
    assert list(horseshoes(0.4, 2.0, 0.8)) == []
