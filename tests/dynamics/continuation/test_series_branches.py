"""Branches under a Fourier series: of one sinusoid as a series, and against shooting by DOP853."""

import math

import numpy as np
import pytest

from rocksteady import (
    Block,
    Harmonic,
    Linear,
    Nonlinear,
    find_bifurcation_curves,
    find_bifurcations,
    find_orbits,
    simulate,
)
from rocksteady.branches import (
    Branch,
    find_branches,
    find_cascade,
    follow_bifurcation,
    follow_branch,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.motions import FourierSeries
from rocksteady.orbits import Orbit
from tests.dynamics.shooting import solved
from tests.every import every

MULTIPLIERS = {"fold": 1.0, "symmetry-breaking": -1.0, "period-doubling": -1.0, "grazing": None}
MERGED = 1e-9
MODELS = [Linear(), Nonlinear()]
UNEVEN: Harmonics = ((1, 1.0, 0.0), (2, 0.3, 0.5))
ODD: Harmonics = ((1, 1.0, 0.0), (3, 0.4, 1.1))


def block_of(alpha: float, restitution: float = 0.8) -> Block:
    return Block.from_p(alpha=alpha, p=3.0, restitution=restitution)


def starts(
    model: Linear | Nonlinear,
    motion: Harmonic | FourierSeries,
    *,
    block: Block | None = None,
    period: int = 1,
) -> list[Orbit]:
    body = block_of(0.3) if block is None else block
    found = find_orbits(body, motion, max_period=period, max_impacts=4, seeds=24, model=model)
    return [each for each in found if each.admissible and not each.rest_phases]


def series(harmonics: Harmonics, *, frequency: float = 2.2, phase: float = 0.0) -> FourierSeries:
    return FourierSeries(amplitude=2.0, frequency_ratio=frequency, harmonics=harmonics, phase=phase)


def events(branches: tuple[Branch, ...], parameter: str) -> list[tuple[str, float]]:
    return [
        (point.type.value, getattr(point, parameter))
        for branch in branches
        for point in branch.bifurcations
    ]


@pytest.mark.slow
@every("model", MODELS)
@every("parameter", ["amplitude", "frequency_ratio", "restitution"])
@every("order", [1, 3])
def test_a_sinusoid_as_a_series_has_its_branches(
    model: Linear | Nonlinear, parameter: str, order: int
) -> None:
    # Of order 3 an orbit closes after an odd number of periods of the sinusoid, three of them.
    breaking = 1.97 if isinstance(model, Linear) else 1.9
    frequency = {1: breaking if parameter == "restitution" else 2.2, 3: 4.2}[order]
    within = {
        "amplitude": (1.0, 3.0),
        "frequency_ratio": (0.75 * frequency, 1.2 * frequency),
        "restitution": (0.6, 0.95),
    }[parameter]
    motion = Harmonic(amplitude=2.0, frequency_ratio=frequency)
    mine = [each for each in starts(model, motion, period=order) if each.period == order][:1]
    scale = order if parameter == "frequency_ratio" else 1
    waves = ((order, 1.0, 0.0),)
    theirs = [
        each
        for each in starts(model, series(waves, frequency=frequency / order))
        if each.period == 1
        and each.impacts == mine[0].impacts
        and each.symmetric == mine[0].symmetric
        and abs(each.multipliers[0] - mine[0].multipliers[0]) < 1e-6
    ][:1]
    kept = {"max_branches": 2, "max_impacts": 8}
    one = find_branches(mine, parameter, within, max_period=2 * order, **kept)
    span = (within[0] / scale, within[1] / scale)
    two = find_branches(theirs, parameter, span, max_period=2, **kept)
    here, there = events(one, parameter), events(two, parameter)
    assert here
    assert [kind for kind, _ in here] == [kind for kind, _ in there]
    for (_, value), (_, again) in zip(here, there, strict=True):
        assert value == pytest.approx(scale * again, abs=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "harmonics", "parameter"),
    [  # each pair of the three once
        (Linear(), UNEVEN, "amplitude"),
        (Linear(), ODD, "frequency_ratio"),
        (Nonlinear(), UNEVEN, "frequency_ratio"),
        (Nonlinear(), ODD, "amplitude"),
    ],
)
def test_bifurcations_are_those_of_shooting(
    model: Linear | Nonlinear, harmonics: Harmonics, parameter: str
) -> None:
    within = {"amplitude": (1.0, 3.5), "frequency_ratio": (1.5, 2.8)}[parameter]
    origins = starts(model, series(harmonics), period=2)
    branches = find_branches(origins, parameter, within, max_branches=4, max_impacts=8)
    checked = set()
    for branch in branches:
        assert branch.symmetric <= (harmonics == ODD)
        for point in branch.bifurcations:
            if np.abs(point.chain.durations).min() < MERGED or point.chain.impacts > 4:
                continue
            there = solved(point, parameter, MULTIPLIERS[point.type.value])
            assert getattr(point, parameter) == pytest.approx(there, abs=1e-9), point
            checked.add(point.type.value)
    assert checked


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_the_phase_of_the_period_changes_nothing(model: Linear | Nonlinear) -> None:
    def moved(turn: float) -> list[tuple[str, float]]:
        waves = tuple((k, size, shift + k * turn) for k, size, shift in UNEVEN)
        origins = starts(model, series(waves, phase=2.0 * turn))[:1]
        return events(
            find_branches(origins, "frequency_ratio", (1.5, 2.8), max_branches=2),
            "frequency_ratio",
        )

    here, there = moved(0.0), moved(0.9)
    assert here
    assert [kind for kind, _ in here] == [kind for kind, _ in there]
    for (_, value), (_, again) in zip(here, there, strict=True):
        assert value == pytest.approx(again, abs=1e-10)


@pytest.mark.parametrize("model", MODELS)
def test_the_series_turned_round_gives_the_mirror_images(model: Linear | Nonlinear) -> None:
    def peaks(sign: float) -> list[list[float]]:
        waves = tuple((k, sign * size, shift) for k, size, shift in UNEVEN)
        (start,) = starts(model, series(waves))[:1]
        return [
            sorted(sign * point.peaks)
            for point in follow_branch(start, "amplitude", (1.5, 3.0), direction=-1)
        ]

    here, there = peaks(1.0), peaks(-1.0)
    assert len(here) == len(there) > 1
    for one, two in zip(here, there, strict=True):
        assert one == pytest.approx(two, abs=1e-7)


@pytest.mark.parametrize("model", MODELS)
def test_orbits_of_a_branch_repeat_in_simulation(model: Linear | Nonlinear) -> None:
    (start,) = starts(model, series(UNEVEN))[:1]
    point = list(follow_branch(start, "frequency_ratio", (2.0, 2.8)))[5]
    orbit = point.orbit
    assert isinstance(orbit.motion, FourierSeries)
    assert orbit.motion.harmonics == UNEVEN
    run = simulate(orbit.block, orbit.motion, start=orbit.start, cycles=2, model=model)
    period = 2.0 * math.pi / point.frequency_ratio
    there = run(0.4 * point.chain.durations[0] + np.array([0.0, period]))
    assert abs(np.diff(there.angle)) < 1e-9
    assert abs(np.diff(there.velocity)) < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_cascades_and_curves(model: Linear | Nonlinear) -> None:
    (start,) = starts(model, series(UNEVEN))[:1]
    found = find_cascade(start, "frequency_ratio", (1.4, 2.4), direction=-1, doublings=5)
    assert found.ratios[-1] == pytest.approx(4.67, abs=0.1)
    assert "orders 1, 2" in found.describe().headline
    curve = list(
        follow_bifurcation(
            found.points[0],
            ("amplitude", "frequency_ratio"),
            ((1.5, 3.0), (1.4, 2.4)),
            most_points=6,
        )
    )
    point = curve[4]
    assert abs(point.amplitude - 2.0) > 1e-3
    there = solved(point, "frequency_ratio", -1.0)
    assert point.frequency_ratio == pytest.approx(there, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_a_diagram_under_a_series(model: Linear | Nonlinear) -> None:
    diagram = find_bifurcations(
        block_of(0.3),
        series(UNEVEN),
        "frequency_ratio",
        within=(1.7, 2.4),
        values=5,
        model=model,
    )
    kinds = [each.point.type.value for each in diagram.points]
    assert "period-doubling" in kinds
    assert "symmetry-breaking" not in kinds
    assert diagram.resting == ()
    text = str(diagram.describe().headline)
    assert "orders 1, 2" in text
    assert diagram.to_dict()["harmonics"] == [list(wave) for wave in UNEVEN]
    assert "Of mirror images" not in str(diagram.describe().notes)


def test_refusals() -> None:
    (start,) = starts(Linear(), series(UNEVEN))[:1]
    with pytest.raises(InputError, match="its order 2 may be at most 10000 p fast"):
        follow_branch(start, "frequency_ratio", (1.0, 6000.0))
    with pytest.raises(ModelError, match="single sinusoid"):
        find_bifurcation_curves(
            block_of(0.3),
            series(UNEVEN),  # type: ignore[arg-type]
            ("amplitude", "frequency_ratio"),
            within=((1.0, 2.0), (2.0, 3.0)),
        )
