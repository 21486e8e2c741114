"""One point in the explorer's modules: every number is the Python API's, bit for bit."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Rest,
    State,
    Status,
    Steady,
    find_attractor,
    simulate,
)
from rocksteady.errors import ModelError
from rocksteady.formulas import steady_states
from rocksteady.histories import ImpactState, Trajectory
from rocksteady.orbits import Attractor, find_attractors
from tests.explorer.in_node import InNode

SCRIPT = """
const {{ attractorOf }} = await import(parts('physics/attractor.mjs'));
const {{ coexistingOf, endingsOf, fixedStarts }} = await import(parts('physics/coexisting.mjs'));
const {{ historyOf, motionAt }} = await import(parts('physics/history.mjs'));
const {{ steadyStatesAt }} = await import(parts('physics/steady.mjs'));
const plain = (key, value) => typeof value === 'number' && !Number.isFinite(value)
  ? String(value) : ArrayBuffer.isView(value) ? Array.from(value) : value;
const attempt = (work) => {{
  try {{ return work(); }} catch (error) {{ return {{ cause: error.cause, fix: error.fix }}; }}
}};
const found = asked.map((each) => {{ {work} }});
answer(JSON.parse(JSON.stringify(found, plain)));
"""

RNG_SEED = 25
MODELS = (False, True)
Asked = dict[str, Any]


def scripted(work: str) -> str:
    """Return a script that does a piece of work with `each` question."""
    return SCRIPT.format(work=work)


def case(
    a: float, w: float, r: float = 0.8, *, alpha: float = 0.2, nonlinear: bool = False
) -> Asked:
    """Return a case as the modules take it."""
    return {
        "amplitude": a,
        "frequencyRatio": w,
        "restitution": r,
        "nonlinear": nonlinear,
        "alpha": alpha,
    }


REST: Asked = {"kind": "rest"}
STEADY: Asked = {"kind": "steady"}


def state(angle: float, velocity: float) -> Asked:
    return {"kind": "state", "angle": angle, "velocity": velocity}


def impact(side: int, phase: float, speed: float) -> Asked:
    return {"kind": "impact", "side": side, "phase": phase, "speed": speed}


def questions() -> list[Asked]:
    """Return 200 points of both models with all starts, and some at the ends of the ranges."""
    rng = np.random.default_rng(RNG_SEED)
    chaotic = 0.6 + 5.4 / 39.0 * 4.0  # at which motions of restitution 0.8 are aperiodic
    pushed = state(0.0, 0.2)
    asked: list[Asked] = [{"given": case(chaotic, 2.0), "start": pushed}]
    asked.append({"given": case(0.6, 1.0, 1.0), "start": pushed})
    for k in range(200):
        w, r = rng.uniform(0.6, 8.0), rng.uniform(0.6, 0.98)
        # Up to where rest overturns, so that all kinds occur.
        a = rng.uniform(0.2, 1.0 + 0.25 * w * w)
        starts = (
            REST,
            STEADY,
            state(rng.uniform(-0.9, 0.9), rng.uniform(-0.5, 0.5)),
            impact(int(rng.choice([-1, 1])), rng.uniform(-7.0, 7.0), rng.uniform(0.0, 0.7)),
        )
        given = case(a, w, r, alpha=rng.uniform(0.05, 0.6), nonlinear=k % 2 == 1)
        asked.append({"given": given, "start": starts[k // 2 % 4]})
    ends = [
        *(
            case(a, w, 1.0, nonlinear=tilted)
            for a, w in ((1.5, 3.0), (0.5, 2.0))
            for tilted in MODELS
        ),
        *(case(0.0, 2.0, nonlinear=tilted) for tilted in MODELS),
        *(case(1000.0, w, nonlinear=tilted) for w in (0.5, 200.0) for tilted in MODELS),
        *(case(a, 0.01, nonlinear=tilted) for a in (0.5, 1.1) for tilted in MODELS),
        *(case(2.0, 4.0, alpha=alpha, nonlinear=True) for alpha in (0.001, 1.4)),
        case(6.0, 2.0),  # overturns
    ]
    others = (REST, state(0.4, -0.1), impact(-1, 2.0, 0.3), state(1.2, -0.4), state(-0.0, -0.0))
    return asked + [{"given": given, "start": start} for given in ends for start in others]


def python_case(asked: Asked) -> tuple[Any, Harmonic, Any, Any]:
    """Return block, motion, start and model of a question."""
    given, start = asked["given"], asked["start"]
    block: Any = DimensionlessBlock(restitution=given["restitution"])
    model: Any = Linear()
    if given["nonlinear"]:
        alpha = given["alpha"]
        block = Block.from_p(alpha=alpha, p=2.0, restitution=given["restitution"])
        model = Nonlinear()
    motion = Harmonic(amplitude=given["amplitude"], frequency_ratio=given["frequencyRatio"])
    values = {name: value for name, value in start.items() if name != "kind"}
    kinds = {"rest": Rest, "steady": Steady, "state": State, "impact": ImpactState}
    return block, motion, kinds[start["kind"]](**values), model


def attractor(asked: Asked) -> Attractor:
    block, motion, start, model = python_case(asked)
    return find_attractor(block, motion, start=start, model=model, max_cycles=400)


def number(value: float | None) -> Any:
    """Return a number as the script prints it."""
    if value is None or math.isfinite(value):
        return value
    return "NaN" if math.isnan(value) else ("Infinity" if value > 0.0 else "-Infinity")


def facts_of(found: Attractor) -> Asked:
    """Return an attractor in the words of the modules."""
    orbit = found.orbit
    highest, lowest = found.peaks or (None, None)
    facts: Asked = {
        "kind": found.kind.value,
        "period": found.period,
        "highest": highest,
        "lowest": lowest,
        "impacts": None if orbit is None else orbit.impacts,
        "lyapunov": number(found.lyapunov),
        "after": found.after,
        "growth": found.growth,
        "reason": found.reason,
        "state": None if found.state is None else vars(found.state),
        "phase": found.motion.phase if orbit is None else None,
    }
    if orbit is not None:
        facts |= {
            "states": [vars(each) for each in orbit.states],
            "multipliers": [[m.real, m.imag] for m in orbit.multipliers.tolist()],
            "largest": orbit.largest_multiplier,
            "residual": orbit.residual,
            "rests": orbit.rest_phases,
        }
    return facts


def assert_in(part: str, text: str) -> None:
    assert part in text


def test_attractors_are_those_of_python_bit_for_bit(in_node: InNode) -> None:
    asked = questions()
    found = in_node(
        scripted("""
        return attempt(() => {
          const { orbit, start, ...facts } = attractorOf(kernels, each.given, each.start, 400);
          if (!orbit) return facts;
          const { states, multipliers, largest, residual, rests } = orbit;
          return { ...facts, phase: null, states, multipliers, largest, residual, rests };
        });
        """),
        asked,
    )
    kinds = set()
    for each, there in zip(asked, found, strict=True):
        try:
            here = facts_of(attractor(each))
        except ModelError as error:
            here = {"kind": "no start", "text": str(error)}
            there["text"], there["kind"] = str(error), "no start"
            assert_in(there.pop("cause"), str(error))
            assert_in(there.pop("fix"), str(error))
        assert there == here, each
        kinds.add(here["kind"])
    assert len(kinds) == 7, f"some kinds do not occur: {kinds}"


def test_time_histories_are_those_of_python_bit_for_bit(in_node: InNode) -> None:
    asked = questions()
    found = in_node(
        scripted("""
        return attempt(() => {
          const run = historyOf(kernels, each.given, each.start, 7.25, 20000);
          const { starts, rows, impacts, lastDuration, phase, ...facts } = run;
          const times = Array.from({ length: 20 }, (_, k) => run.endTime * k / 20);
          const { angle, velocity } = motionAt(kernels, each.given, run, times);
          return { ...facts, impacts, times, angle, velocity };
        });
        """),
        asked,
    )
    statuses = set()
    for each, there in zip(asked, found, strict=True):
        block, motion, start, model = python_case(each)
        try:
            run = simulate(block, motion, start=start, cycles=7.25, model=model, max_flights=20000)
        except ModelError:
            assert set(there) == {"cause", "fix"}, each
            continue
        here = run_facts(run)
        samples = run(np.array(there.pop("times")))
        assert there.pop("angle") == samples.angle.tolist(), each
        assert there.pop("velocity") == samples.velocity.tolist(), each
        assert there == here, each
        statuses.add(here["status"])
    assert statuses == {"rocking", "at-rest", "overturned"}


def run_facts(run: Trajectory) -> Asked:
    """Return a time history in the words of the modules."""
    impacts = run.impacts
    phases = [
        ImpactState(side=1, phase=half % 2 * math.pi + phase, speed=0.0).phase
        for half, phase in zip(impacts.half_cycles.tolist(), impacts.phase.tolist(), strict=True)
    ]
    return {
        "status": run.status.label,
        "flights": len(run.rows),
        "endTime": run.end_time_pt,
        "overturnTime": run.overturn_time_pt,
        "restTime": run.rest_time_pt,
        "sidePeaks": list(run.side_peaks),
        "peak": run.peak,
        "peakVelocity": run.peak_velocity,
        "impactCount": run.impact_count,
        "impacts": {
            "time": impacts.pt.tolist(),
            "phase": phases,
            "side": impacts.side.tolist(),
            "before": impacts.velocity_before.tolist(),
            "after": impacts.velocity_after.tolist(),
        },
    }


@pytest.mark.parametrize("nonlinear", [False, True])
def test_mirrored_starts_give_mirrored_motions(nonlinear: bool, in_node: InNode) -> None:
    points = ((2.0, 1.9), (1.4, 3.0), (2.0, 6.0), (3.0, 4.0))
    starts = [impact(1, phase, 0.3) for phase in (0.4, 1.9, 3.3)]
    mirrored = [impact(-1, each["phase"] + math.pi, each["speed"]) for each in starts]
    asked = [
        {"given": case(a, w, nonlinear=nonlinear), "start": start}
        for a, w in points
        for pair in zip(starts, mirrored, strict=True)
        for start in pair
    ]
    found = in_node(
        scripted("""
        const run = historyOf(kernels, each.given, each.start, 12);
        const { kind, period, highest, lowest } = attractorOf(kernels, each.given, each.start);
        return { side: run.sidePeaks, run: run.impacts.after, kind, period, highest, lowest };
        """),
        asked,
    )
    for here, there in zip(found[::2], found[1::2], strict=True):
        assert here["side"] == pytest.approx(there["side"][::-1], rel=1e-9)
        assert here["run"] == pytest.approx([-each for each in there["run"]], rel=1e-6)
        assert (here["kind"], here["period"]) == (there["kind"], there["period"])
        if here["highest"] is not None:
            assert here["highest"] == pytest.approx(-there["lowest"], abs=1e-9)


def test_a_long_chatter_ends_at_the_limit_of_flights(in_node: InNode) -> None:
    """At rest, once it is proved that the bounces to come end in time; their number is known."""
    given, counts = case(0.0, 2.0, 0.999), set()
    limits = [100, 4096, 5000, 9000, 70000]
    asked = [{"given": given, "start": state(0.2, 0.0), "most": most} for most in limits]
    work = "return historyOf(kernels, each.given, each.start, 400, each.most);"
    for most, found in zip(limits, in_node(scripted(work), asked), strict=True):
        run = simulate(
            DimensionlessBlock(restitution=0.999),
            Harmonic(amplitude=0.0, frequency_ratio=2.0),
            start=State(angle=0.2, velocity=0.0),
            cycles=400,
            max_flights=most,
        )
        assert (found["status"], found["flights"]) == (run.status.label, len(run.rows))
        assert (found["peak"], found["restTime"]) == (run.peak, run.rest_time_pt)
        assert found["impactCount"] == run.impact_count
        assert (run.status.label == "at-rest") == (most > 5000)
        if run.status is Status.AT_REST:
            counts.add(run.impact_count)
            assert (len(run.impacts) == run.impact_count) == (most == limits[-1])
    assert len(counts) == 1


COEXIST = """
const { endings, starts } = endingsOf(kernels, each);
const parts = [];
for (let from = 0; from < starts; from += 13) {
  parts.push(...endingsOf(kernels, { ...each, from, to: from + 13 }).endings);
}
const begin = fixedStarts(kernels, each.given);
return { motions: coexistingOf(endings), parts: coexistingOf(parts), begin };
"""


@pytest.mark.parametrize("nonlinear", [False, True])
def test_motions_that_coexist_at_a_point(nonlinear: bool, in_node: InNode) -> None:
    points = ((0.8, 2.0), (2.0, 6.0), (2.0, 1.9))
    asked = [{"given": case(a, w, nonlinear=nonlinear, alpha=0.02)} for a, w in points]
    found = in_node(scripted(COEXIST), asked)
    names = [
        [(each["kind"], each["period"], round(each["highest"], 2)) for each in motions]
        for motions in (
            [each for each in answer["motions"] if each["kind"] != "overturned"] for answer in found
        )
    ]
    assert names[0] == [("rest", 0, 0.0), ("symmetric", 1, 0.39)]
    assert names[1] == [("symmetric", 1, 0.09), ("symmetric", 3, 0.29)]
    assert [name[:2] for name in names[2]] == [("unsymmetric", 1)] * 2
    first, second = found[2]["motions"][:2]
    assert (first["twin"], second["twin"]) == (1, 0)
    assert first["highest"] == -second["lowest"]
    for answer in found:
        assert answer["motions"] == answer["parts"], "chunks give another answer"


def test_coexisting_motions_are_what_python_finds_from_the_same_starts(in_node: InNode) -> None:
    points = ((0.8, 2.0), (2.0, 6.0), (2.0, 1.9), (3.2, 4.0))
    asked = [
        {"given": case(a, w, nonlinear=nonlinear), "start": REST}
        for nonlinear in MODELS
        for a, w in points
    ]
    for each, answer in zip(asked, in_node(scripted(COEXIST), asked), strict=True):
        for there in answer["motions"]:
            if not there["mirrored"]:
                begin = answer["begin"][there["from"]]
                assert {name: there[name] for name in ENDING} == ending(each, **begin), each


ENDING = ("kind", "highest", "lowest", "state")


def ending(asked: Asked, *, angle: float, velocity: float, phase: float) -> Asked:
    """Return what Python finds from a state: of many linear motions at once, as the page asks."""
    block, motion, _, model = python_case(asked)
    a, w = motion.amplitude, motion.frequency_ratio
    if asked["given"]["nonlinear"]:
        start = State(angle=angle, velocity=velocity, phase=phase)
        found = find_attractor(block, motion, start=start, model=model, max_cycles=600)
        there, begin = found.kind.value, None if found.orbit is None else found.orbit.start
        highest, lowest = found.peaks or (math.nan, math.nan)
    else:
        many = find_attractors(
            a, w, block.restitution, angle=angle, velocity=velocity, phase=phase, max_cycles=600
        )
        there = str(many.labels[0])
        begin = many.start(0) if many.period[0] else None
        highest, lowest = many.highest[0], many.lowest[0]
    return {
        "kind": there,
        "highest": number(float(highest)),
        "lowest": number(float(lowest)),
        "state": None if begin is None else vars(begin),
    }


def test_closed_forms_are_those_of_python(in_node: InNode) -> None:
    asked = [each for each in questions() if not each["given"]["nonlinear"]]
    found = in_node(scripted("return steadyStatesAt(kernels, each.given);"), asked)
    count = 0
    for each, there in zip(asked, found, strict=True):
        given = each["given"]
        here = []
        for order in (1, 3):
            states = steady_states(
                given["amplitude"], given["frequencyRatio"], given["restitution"], order=order
            )
            if states.region == 4:
                continue
            assert states.admissible is not None
            assert states.peak is not None
            for k in range(2):
                worth = "stable" if states.stable[k] else "unstable"
                worth = "neutral" if states.neutral[k] else worth
                half = states.half_cycle_multipliers[k].tolist()
                here.append(
                    {
                        "order": order,
                        "branch": k + 1,
                        "worth": worth if states.admissible[k] else "inadmissible",
                        "peak": number(states.peak[k].item()),
                        "half": [[number(m.real), number(m.imag)] for m in half],
                    }
                )
        for row in there:
            del row["state"], row["multipliers"]
        assert there == here, each
        count += len(here)
    assert count > 100
