"""Damage states: what exceeds them, and what is none."""

import numpy as np
import pytest

from rocksteady import Status
from rocksteady.errors import InputError
from rocksteady.risk import DamageState
from rocksteady.risk.fragility.compute_fragility import damage_states
from rocksteady.risk.fragility.damage_states import exceeding
from tests.every import every

CODES = np.array([Status.AT_REST, Status.AT_REST, Status.ROCKING, Status.OVERTURNED])
PEAKS = np.array([0.0, 0.5, 1.2, 0.9])


@every(
    ("state", "exceeded"),
    [
        (DamageState("uplift"), [False, True, True, True]),
        (DamageState("half", 0.5), [False, False, True, True]),  # above it, not at it
        (DamageState("beyond", 1.0), [False, False, True, True]),  # a fall exceeds every tilt
        (DamageState("overturned"), [False, False, False, True]),  # beyond alpha is no fall
    ],
)
def test_what_exceeds_a_state(state: DamageState, exceeded: list[bool]) -> None:
    assert exceeding(state, CODES, PEAKS).tolist() == exceeded


def test_a_number_is_a_state_of_its_own_and_each_contains_the_next() -> None:
    assert damage_states(["overturned", 0.5, "0.25", "uplift"]) == (
        DamageState("uplift"),
        DamageState("theta/alpha > 0.25", 0.25),
        DamageState("theta/alpha > 0.5", 0.5),
        DamageState("overturned"),
    )


def test_what_is_no_state_is_refused() -> None:
    for name, peak in (("collapse", None), ("uplift", 0.5), ("half", -0.1), ("", 0.5)):
        with pytest.raises(InputError):
            DamageState(name, peak)
    wrong: list[list[float | str]] = [[], ["uplift", "uplift"], [0.5, "0.5"], ["nan"]]
    for states in wrong:
        with pytest.raises(InputError):
            damage_states(states)
