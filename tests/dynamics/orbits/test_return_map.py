"""The return map as users call it: against simulations, composed, mirrored, and refused."""

import math
from itertools import islice

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block, DimensionlessBlock, Harmonic, State, Still, simulate
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.histories import ImpactState
from rocksteady.orbits import ReturnMap
from rocksteady.outcomes import Event
from tests.dynamics.kicks import apart
from tests.every import every
from tests.strategies import logarithmic

BARE = DimensionlessBlock(restitution=0.8)


def returns(amplitude: float, frequency: float, restitution: float = 0.8) -> ReturnMap:
    return ReturnMap(
        DimensionlessBlock(restitution=restitution),
        Harmonic(amplitude=amplitude, frequency_ratio=frequency),
    )


# ------------------------------------------------------------------------------ against the march


@every("side", [1, -1])
@every(
    ("amplitude", "frequency", "restitution", "phase", "speed"),
    [(2.0, 4.0, 0.8, 2.5, 0.6), (1.2, 3.0, 0.6, 2.0, 0.3), (3.0, 9.0, 0.95, 2.8, 0.2)],
)
def test_it_meets_the_impacts_of_a_simulation(
    amplitude: float, frequency: float, restitution: float, phase: float, speed: float, side: int
) -> None:
    start = phase if side > 0 else phase + math.pi
    run = simulate(
        DimensionlessBlock(restitution=restitution),
        Harmonic(amplitude=amplitude, frequency_ratio=frequency, phase=start),
        start=State(angle=0.0, velocity=side * speed),
        cycles=20,
    )
    map_ = returns(amplitude, frequency, restitution)
    state = ImpactState(side=side, phase=start, speed=speed)
    count = len(run.impacts.pt)
    assert count > 30
    passed = 0.0
    for passage, s, velocity in zip(
        islice(map_.passages(state), count),
        run.impacts.pt,
        run.impacts.velocity_after,
        strict=True,
    ):
        assert passage.kind is Event.IMPACT
        assert passage.state is not None
        passed += passage.phase
        assert passed == pytest.approx(frequency * s, rel=1e-9)
        assert passage.state.side * passage.state.speed == pytest.approx(velocity, rel=1e-7)
        assert passage.landing_speed == pytest.approx(abs(velocity) / restitution, rel=1e-7)
        gone = (passage.state.phase - start - passed) / (2.0 * math.pi)
        assert gone == pytest.approx(round(gone), abs=1e-9)


def test_a_symmetric_orbit_is_half_a_period_of_it() -> None:
    for a, w, r, n in [(2.0, 4.0, 0.8, 1), (2.0, 6.0, 0.8, 3), (1.0, 2.0, 0.5, 1)]:
        states = steady_states(a, w, r, order=n)
        first = ImpactState(side=1, phase=float(states.phase[0]), speed=float(states.velocity[0]))
        passage = returns(a, w, r)(first)
        assert passage.state is not None
        assert apart(passage.state, first.mirrored) < 1e-12
        assert passage.phase == pytest.approx(n * math.pi, rel=1e-13)
        assert passage.time == pytest.approx(n * math.pi / w, rel=1e-13)
        assert np.trace(passage.jacobian) == pytest.approx(float(states.trace[0]), rel=1e-11)
        assert np.linalg.det(passage.jacobian) == pytest.approx(r * r, rel=1e-11)


# ------------------------------------------------------------------------------------ composition


@given(
    phase=st.floats(0.0, 6.28), speed=logarithmic(0.01, 1.0), steps=st.integers(1, 7),
    restitution=st.floats(0.3, 1.0),
)  # fmt: skip
def test_several_steps_are_one_after_the_other(
    phase: float, speed: float, steps: int, restitution: float
) -> None:
    map_ = returns(1.5, 5.0, restitution)
    state = ImpactState(side=-1, phase=phase, speed=speed)
    single = list(islice(map_.passages(state), steps))
    together = map_(state, steps)
    last = single[-1]
    assert together.kind is last.kind
    if last.state is None:
        assert together.state is None
        assert np.isnan(together.jacobian).all()
        assert together.phase == together.time == math.inf
        return
    assert apart(together.state, last.state) < 1e-9 * math.exp(3.0 * steps)
    assert together.impacts == sum(passage.impacts for passage in single)
    assert together.uplifts == sum(passage.uplifts for passage in single)
    assert together.impacts + together.uplifts == steps
    assert together.time == pytest.approx(math.fsum(p.time for p in single), rel=1e-9)
    assert together.phase == pytest.approx(math.fsum(p.phase for p in single), rel=1e-9)
    assert together.landing_speed == pytest.approx(last.landing_speed, rel=1e-6, abs=1e-9)
    if any(passage.kind is Event.GRAZE for passage in single):
        return
    product = np.eye(2)
    for passage in single:
        product = passage.jacobian @ product
    size = np.prod([np.abs(passage.jacobian).max() for passage in single])
    assert np.abs(together.jacobian - product).max() <= 1e-6 * max(size, 1.0)


@given(
    amplitude=st.floats(0.0, 6.0), frequency=logarithmic(0.3, 50.0),
    phase=st.floats(0.0, 6.28), speed=logarithmic(1e-6, 2.0), side=st.sampled_from([1, -1]),
)  # fmt: skip
def test_a_mirrored_state_leads_to_the_mirrored_state(
    amplitude: float, frequency: float, phase: float, speed: float, side: int
) -> None:
    map_ = returns(amplitude, frequency)
    state = ImpactState(side=side, phase=phase, speed=speed)
    here, there = map_(state), map_(state.mirrored)
    if here.kind is not there.kind:
        return  # the rounding of the mirrored phase decides whether chatter is proved to end
    if here.state is not None:
        slack = 1e-12 * math.exp(2.0 * here.time) * (1.0 + 1.0 / max(here.landing_speed, 1e-9))
        assert apart(here.state.mirrored, there.state or state) < max(slack, 1e-9)


def test_of_the_linear_model_neither_phase_nor_size_counts() -> None:
    state = ImpactState(side=1, phase=2.8, speed=0.7)
    expected = returns(2.0, 4.0)(state)
    block = Block.from_radius(alpha=0.2, radius=3.0, restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=1.234)
    found = ReturnMap(block, shaking, model="linear")(state)
    assert found.state == expected.state
    assert np.array_equal(found.jacobian, expected.jacobian)


# ------------------------------------------------------------------------------ kinds of passages


def test_a_rest_ends_in_an_uplift_that_forgets_what_was_before() -> None:
    map_ = returns(1.01, 2.0)
    ends = []
    for phase, speed in ((3.0, 1e-4), (3.1, 2e-4), (3.0, 1e-6)):
        passage = map_(ImpactState(side=1, phase=phase, speed=speed))
        assert passage.kind is Event.UPLIFT
        assert (passage.impacts, passage.uplifts) == (0, 1)
        assert (passage.jacobian == 0.0).all()
        assert passage.landing_speed == 0.0
        ends.append(passage.state)
    assert ends[0] == ends[1] == ends[2]
    assert ends[0] == ImpactState(side=-1, phase=math.pi + math.asin(1 / 1.01), speed=0.0)
    # Composed with what follows, the derivative stays 0.
    later = map_(ImpactState(side=1, phase=3.0, speed=1e-4), 3)
    assert (later.jacobian == 0.0).all()
    assert later.uplifts >= 1


def test_a_graze_has_no_derivative() -> None:
    map_ = returns(2.0, 2.0)
    passage = map_(ImpactState(side=1, phase=4.0, speed=1e-12))
    assert passage.kind is Event.GRAZE
    assert passage.impacts == 1
    assert passage.state is not None
    assert np.isnan(passage.jacobian).all()
    assert np.isnan(map_(ImpactState(side=1, phase=4.0, speed=1e-12), 2).jacobian).all()


def test_where_no_impact_follows_there_is_no_state() -> None:
    for map_, state, kind in (
        (returns(2.0, 4.0), ImpactState(side=1, phase=1.0, speed=5.0), Event.OVERTURNED),
        (returns(0.5, 4.0), ImpactState(side=-1, phase=1.0, speed=1e-6), Event.AT_REST),
    ):
        passage = map_(state, 4)
        assert passage.kind is kind
        assert passage.state is None
        assert passage.time == passage.phase == math.inf
        assert np.isnan(passage.jacobian).all()
        assert list(map_.passages(state))[-1].kind is kind


def test_kinds_have_names_for_people() -> None:
    assert [kind.label for kind in Event] == [
        "impact",
        "uplift",
        "graze",
        "overturned",
        "at-rest",
        "undecided",
    ]


# --------------------------------------------------------------------------------------- states


@given(st.floats(-1e6, 1e6), st.sampled_from([1, -1]))
def test_the_phase_of_a_state_is_taken_modulo_a_period(phase: float, side: int) -> None:
    state = ImpactState(side=side, phase=phase, speed=0.5)
    assert 0.0 <= state.phase <= 2.0 * math.pi
    assert math.cos(state.phase - phase) == pytest.approx(1.0, abs=1e-9)
    twice = state.mirrored.mirrored
    assert twice.side == side
    assert math.cos(twice.phase - phase) == pytest.approx(1.0, abs=1e-9)
    assert state.mirrored.side == -side


@every(
    ("values", "message"),
    [
        ({"side": 0}, r"^side = 0 .*1 or -1"),
        ({"side": 2}, r"^side = 2 "),
        ({"side": "+"}, r"^side = '\+' "),
        ({"phase": math.nan}, r"^phase = nan "),
        ({"phase": math.inf}, r"^phase = inf "),
        ({"speed": -0.1}, r"^speed = -0\.1 "),
        ({"speed": math.nan}, r"^speed = nan "),
        ({"speed": 1e51}, r"^speed = 1e\+51 "),
    ],
)
def test_what_is_no_state_is_refused(values: dict[str, float], message: str) -> None:
    with pytest.raises(InputError, match=message):
        ImpactState(**{"side": 1, "phase": 0.0, "speed": 1.0, **values})  # type: ignore[arg-type]


@every("steps", [0, -1, 1.5, math.nan])
def test_steps_are_a_whole_number(steps: int) -> None:
    with pytest.raises(InputError, match=r"^steps = "):
        returns(2.0, 4.0)(ImpactState(side=1, phase=1.0, speed=1.0), steps)


def test_what_is_no_block_and_what_is_not_harmonic_is_refused() -> None:
    with pytest.raises(InputError, match=r"^block = 0\.8 .*DimensionlessBlock"):
        ReturnMap(0.8, Harmonic(amplitude=1.0, frequency_ratio=1.0))  # type: ignore[arg-type]
    with pytest.raises(ModelError, match=r"^motion = Still.*Harmonic"):
        ReturnMap(BARE, Still())  # type: ignore[arg-type]


@every("side", [1, -1])
@every("phase", [0.0, 3.3, 6.0])
def test_a_state_at_rest_waits_for_the_base_to_lift_it(side: int, phase: float) -> None:
    # 2 sin(phase) is between -1 and 1: the block stands until the next uplift.
    resting = returns(2.0, 2.0)(ImpactState(side=side, phase=phase, speed=0.0))
    bouncing = returns(2.0, 2.0)(ImpactState(side=side, phase=phase, speed=1e-12))
    assert bouncing.kind is Event.UPLIFT
    assert resting.kind is Event.UPLIFT
    assert resting.time >= 0.0
    assert resting.state == bouncing.state


def test_no_passage_goes_back_in_time() -> None:
    for phase in np.linspace(0.0, 6.2, 32).tolist():
        for side in (1, -1):
            state = ImpactState(side=side, phase=phase, speed=0.0)
            assert returns(2.0, 2.0)(state).time >= 0.0


def test_the_phase_of_a_state_is_less_than_a_period() -> None:
    assert ImpactState(side=1, phase=-1e-17, speed=1.0).phase < 2.0 * math.pi


def test_the_side_of_a_state_is_a_whole_number() -> None:
    assert type(ImpactState(side=1.0, phase=1.0, speed=1.0).side) is int  # type: ignore[arg-type]
