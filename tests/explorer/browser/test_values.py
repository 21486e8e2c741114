"""The numbers on the screen: bit for bit those of the Python API."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    Harmonic,
    Linear,
    Nonlinear,
    Rest,
    State,
    Steady,
    find_attractor,
    simulate,
)
from rocksteady.errors import ModelError
from rocksteady.histories import ImpactState
from tests.explorer.browser.watched import Explorer, turn_to, values

READOUT = "[data-panel='readout']"
SEED = 25
FIXED = {"r": 0.8, "b": 0.5, "h": 2.0, "model": "linear", "units": "none"}
RARE = [(2.0, 1.9, "rest"), (0.6 + 5.4 / 39.0 * 4.0, 2.0, "0.0,0.2"), (2.0, 6.0, "1:1.0:0.5")]
"""Points and starts of motions that are unsymmetric, aperiodic and subharmonic."""
CYCLES = 60
"""Periods of the page's time history."""


def cases(count: int) -> list[dict[str, Any]]:
    """Return states of the page: both models, all starts, of motions that rest, rock and fall."""
    rng = np.random.default_rng(SEED)
    found = [FIXED | {"A": a, "W": w, "start": start} for a, w, start in RARE]
    for k in range(count - len(RARE)):
        ratio = float(rng.uniform(0.6, 8.0))
        side, phase, speed = rng.choice([-1, 1]), rng.uniform(0.0, 6.2), rng.uniform(0.0, 0.6)
        angle, velocity = rng.uniform(-0.8, 0.8), rng.uniform(-0.4, 0.4)
        starts = ("rest", "steady", f"{angle},{velocity}", f"{side}:{phase}:{speed}")
        found.append(
            {
                "A": float(rng.uniform(0.2, 1.0 + 0.2 * ratio * ratio)),
                "W": ratio,
                "r": float(rng.uniform(0.6, 0.97)),
                "b": float(rng.uniform(0.1, 1.0)),
                "h": float(rng.uniform(1.0, 3.0)),
                "model": "nonlinear" if k % 2 else "linear",
                "units": "none",
                "start": starts[k // 2 % 4],
            }
        )
    return found


def start_of(text: str) -> Rest | State | Steady | ImpactState:
    """Return the start that the text of a link means."""
    if text in {"rest", "steady"}:
        return Rest() if text == "rest" else Steady()
    if "," in text:
        angle, velocity = map(float, text.split(","))
        return State(angle=angle, velocity=velocity)
    side, phase, speed = text.split(":")
    return ImpactState(side=1 if side == "1" else -1, phase=float(phase), speed=float(speed))


def expected(state: dict[str, Any]) -> dict[str, float | str | None]:
    """Return what Python says of a state."""
    block = Block.rectangle(width=state["b"], height=state["h"], restitution=state["r"])
    shaking = Harmonic(amplitude=state["A"], frequency_ratio=state["W"])
    model: Linear | Nonlinear = Nonlinear() if state["model"] == "nonlinear" else Linear()
    start = start_of(state["start"])
    found = find_attractor(block, shaking, start=start, model=model)
    run = simulate(block, shaking, start=start, cycles=CYCLES, model=model)
    highest, lowest = found.peaks or (None, None)
    numbers = {
        "kind": found.kind.value,
        "period": found.period,
        "highest": highest,
        "lowest": lowest,
        "multiplier": found.orbit.largest_multiplier if found.orbit else None,
        "lyapunov": found.lyapunov if math.isfinite(found.lyapunov) else None,
        "peak": run.peak,
        "overturn": run.overturn_time_pt,
        "after": found.after,
    }
    if found.orbit:
        numbers["impacts"] = found.orbit.impacts or "∞"
    return {name: value for name, value in numbers.items() if value is not None}


def shown(texts: dict[str, str]) -> dict[str, float | str]:
    """Return what the read-out says, its numbers as floats."""
    words = {"kind", *(["impacts"] if texts.get("impacts") == "∞" else [])}
    return {name: text if name in words else float(text) for name, text in texts.items()}


def compare(explorer: Explorer, count: int) -> set[str]:
    """Compare the read-out with Python at some states, and return the kinds that were met."""
    page, kinds = explorer.open(), set()
    for state in cases(count):
        turn_to(page, state)
        failed = page.locator(f"{READOUT}.failed").count() > 0
        try:
            here = expected(state)
        except ModelError:
            assert failed, state
            kinds.add("no start")
            continue
        assert not failed, state
        assert shown(values(page, READOUT)) == here, state
        kinds.add(str(here["kind"]))
    return kinds


def test_the_readout_is_what_python_computes_at_some_states(explorer: Explorer) -> None:
    assert {"symmetric", "unsymmetric", "aperiodic", "overturned"} <= compare(explorer, 12)


@pytest.mark.slow
def test_the_readout_is_what_python_computes_at_40_states(explorer: Explorer) -> None:
    assert {"rest", "no start"} <= compare(explorer, 40)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("state", "peaks"),
    [
        ({"A": 0.8, "W": 2.0, "r": 0.8}, {("rest", 0): 0.0, ("symmetric", 1): 0.391}),
        ({"A": 2.0, "W": 6.0, "r": 0.8}, {("symmetric", 1): 0.085, ("symmetric", 3): 0.289}),
    ],
)
def test_the_motions_that_coexist_are_seen_with_their_peaks(
    state: dict[str, float], peaks: dict[tuple[str, int], float], explorer: Explorer
) -> None:
    page = explorer.open(state)
    chips = page.locator(f"{READOUT} .chip[data-value]:not([data-value='overturned'])")
    chips.nth(len(peaks) - 1).wait_for()
    found = {
        (chip["kind"], int(chip["period"])): round(float(chip["highest"]), 3)
        for chip in chips.evaluate_all("all => all.map(one => ({ ...one.dataset }))")
    }
    assert found == peaks
