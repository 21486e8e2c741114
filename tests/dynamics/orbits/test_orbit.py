"""Orbits as starts: a run from any of their impacts is the orbit."""

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Steady,
    Still,
    find_attractor,
    map_fates,
    simulate,
)
from rocksteady.errors import ModelError
from rocksteady.histories import ImpactState
from rocksteady.model.equations import Model
from rocksteady.orbits import sweep_attractor


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_a_run_from_any_impact_of_an_orbit_is_the_orbit(model: Model) -> None:
    block = Block.from_p(alpha=0.2, p=2.0, restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=1.0)
    found = find_attractor(block, shaking, start=Steady(), model=model)
    assert found.orbit is not None
    course = found.orbit.trajectory()
    times = np.linspace(0.0, 0.999 * course.end_time_pt, 50)
    for state in found.orbit.states:
        run = simulate(block, shaking, start=state, cycles=found.orbit.period, model=model)
        assert isinstance(run.motion, Harmonic)
        assert run.motion.phase == state.phase
        since = 0.0
        if state is not found.orbit.states[0]:
            since = float(course.impacts.pt[found.orbit.states.index(state) - 1])
        early = times[times < 0.999 * course.end_time_pt - since]
        assert run(early).angle == pytest.approx(course(early + since).angle, abs=1e-9)
        again = find_attractor(block, shaking, start=state, model=model)
        assert again.orbit is not None
        assert (again.kind, again.after) == (found.kind, again.after)
        assert again.orbit.highest == pytest.approx(found.orbit.highest, abs=1e-12)
    trail = sweep_attractor(
        block, shaking, "amplitude", [2.0], start=found.orbit.states[0], model=model
    )
    assert trail.attractors[0].kind is found.kind


def test_an_impact_state_needs_harmonic_shaking_and_one_cell() -> None:
    state, block = ImpactState(side=1, phase=0.5, speed=0.3), DimensionlessBlock(restitution=0.8)
    with pytest.raises(ModelError, match="needs periodic shaking"):
        simulate(block, Still(), start=state)
    with pytest.raises(ModelError, match="one cell"):
        map_fates(
            block,
            Harmonic(amplitude=2.0, frequency_ratio=4.0),
            axes={"amplitude": [1.0]},
            start=state,
        )
