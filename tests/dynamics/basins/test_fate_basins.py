"""Fates over a window of initial states, against an independent integration and by symmetry."""

import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Linear,
    Nonlinear,
    Pulse,
    Record,
    State,
    Status,
    Still,
    Store,
    compute_fate_basins,
    simulate,
)
from rocksteady.basins import FateBasins
from rocksteady.dynamics.basins.fate_basins import _reaches
from rocksteady.dynamics.history.base_motion import base_acceleration, segment_starts
from rocksteady.errors import InputError, ModelError
from rocksteady.model.linear_tables import segment_table
from rocksteady.motions import Impulses, add, cut, delay, scale

BARE = DimensionlessBlock(restitution=0.9)
BLOCK = Block.rectangle(width=0.8, height=3.0, restitution=0.9)
PULSE = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0)
SUM = add(
    PULSE,
    delay(Pulse(shape="half-sine", amplitude=1.5, frequency_ratio=5.0), 0.4),
    tolerance=1e-4,
)
T = 0.1 * np.arange(25)
RECORD = Record(acceleration_m_s2=5.0 * np.sin(7.0 * T) * np.exp(-0.4 * T), dt_s=0.1)
WINDOW = 0.19 * (np.arange(14) - 6.5)
"""No state lies on the border u + du/d(pt) = 1, where rounding decides."""
SLOW = 1e-3
"""Speed after an impact below which the oracle, on a still base, has come to rest."""


def fates(motion: object, block: object = BARE, **options: object) -> FateBasins:
    given = {"angles": WINDOW, "velocities": WINDOW, **options}
    return compute_fate_basins(block, motion, **given)  # type: ignore[arg-type]


def followed(
    acceleration: Callable[[float], float],
    ends: list[float],
    state: tuple[float, float],
    alpha: float | None,
    ratio: float = 0.9,
) -> tuple[Status, int, float] | None:
    """Return fate, side and largest angle by a Runge-Kutta method of order 8, or None of chatter.

    `ends` are the times between which the acceleration is smooth, the last of them the end of the
    motion; alpha is None in the linear model.
    """

    def slope(s: float, y: np.ndarray, side: float, low: float, high: float) -> list[float]:
        a = acceleration(min(max(s, low), high))
        if alpha is None:
            return [y[1], y[0] - side + a]
        tilt = alpha * (side - y[0])
        return [y[1], (-math.sin(tilt) + alpha * a * math.cos(tilt)) / alpha]

    u, v = state
    peak = abs(u)
    pieces = [*pairwise(ends), (ends[-1], ends[-1] + 60.0)]
    for low, high in pieces:
        begun = low
        inside = np.nextafter(low, high), np.nextafter(high, low)
        while begun < high:
            side = 1.0 if (u or v) > 0.0 else -1.0

            def strikes(_s: float, y: np.ndarray, *_: object, sign: float = side) -> float:
                return sign * float(y[0])

            def falls(_s: float, y: np.ndarray, *_: object) -> float:
                return abs(float(y[0])) - 3.0

            strikes.terminal = falls.terminal = True  # type: ignore[attr-defined]
            strikes.direction = -1.0  # type: ignore[attr-defined]
            run = solve_ivp(
                slope, (begun, high), [u, v], "DOP853", events=(strikes, falls),
                args=(side, *inside), rtol=1e-12, atol=1e-13, max_step=0.05,
            )  # fmt: skip
            peak = max(peak, float(np.abs(run.y[0]).max()))
            u, v, begun = float(run.y[0, -1]), float(run.y[1, -1]), float(run.t[-1])
            if abs(u) > 2.99:
                return Status.OVERTURNED, int(side), math.nan
            if run.status == 1:
                u, v = 0.0, ratio * v
                if abs(v) < SLOW:
                    return (Status.AT_REST, 0, peak) if low == ends[-1] else None
    return Status.AT_REST, 0, peak


@pytest.mark.parametrize(
    ("motion", "block", "model"),
    [
        (PULSE, BARE, Linear()),
        (SUM, BARE, Linear()),
        (RECORD, BLOCK, Linear()),
        (RECORD, BLOCK, Nonlinear()),
    ],
    ids=["pulse", "sum", "record", "record, nonlinear"],
)
@pytest.mark.slow
def test_fates_are_those_of_an_integration_of_the_equations(
    motion: object, block: object, model: object
) -> None:
    found = fates(motion, block, model=model)
    table = segment_table(motion, block)  # type: ignore[arg-type]
    ends = segment_starts(table).tolist()
    alpha = BLOCK.alpha if isinstance(model, Nonlinear) else None
    compared = set()
    draw = np.random.default_rng(1)
    kinds = (found.safe, found.side == 1, found.side == -1)
    cells = [draw.choice(np.argwhere(kind), 6, replace=False) for kind in kinds]
    for row, column in np.concatenate(cells).tolist():
        start = found.state(row, column)
        known = followed(
            lambda s: float(base_acceleration(table, s)),
            ends,
            (start.angle, start.velocity),
            alpha,
        )
        if known is None:
            continue
        status, side, peak = known
        assert found.fate[row, column] == status
        assert found.side[row, column] == side
        if status is Status.AT_REST:  # to within what lies between two steps of the oracle
            assert found.peak[row, column] == pytest.approx(peak, abs=2e-3)
            assert found.peak[row, column] > peak - 1e-9
        compared.add((status, side))
    assert len(compared) == 3


def test_every_cell_is_how_a_time_history_ends() -> None:
    found = fates(SUM)
    for cell in np.ndindex(found.fate.shape):
        run = simulate(BARE, SUM, start=found.state(*cell))
        assert int(found.fate[cell]) == run.status
        assert int(found.impacts[cell]) == len(run.impacts)
        still = simulate(BARE, Still(), start=found.state(*cell))
        assert found.still_safe[cell] == (still.status is not Status.OVERTURNED)


def test_integrity_is_1_at_most_where_shaking_moves_more_safe_states_into_the_window() -> None:
    above = 0
    beside = {"angles": np.linspace(0.3, 1.7, 15), "velocities": np.linspace(-1.7, 0.3, 21)}
    for amplitude in (-1.5, -0.6, 0.6, 1.5):
        reverse = amplitude < 0.0
        pulse = Pulse(
            shape="half-sine", amplitude=abs(amplitude), frequency_ratio=4.0, reverse=reverse
        )
        found = fates(pulse, **beside)
        area = found.safe_share / found.still_share
        above += area > 1.0
        assert found.global_integrity == min(area, 1.0)
        assert found.integrity_factor == min(found.radius / found.still_radius, 1.0)
    assert above > 0


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_the_mirrored_motion_mirrors_the_fates(model: object) -> None:
    one = fates(RECORD, BLOCK, model=model)
    other = fates(RECORD.reversed(), BLOCK, model=model)
    assert (other.fate[::-1, ::-1] == one.fate).all()
    assert (other.side[::-1, ::-1] == -one.side).all()
    assert (other.peak[::-1, ::-1] == one.peak).all()


def test_the_default_window_is_as_wide_for_a_motion_as_for_its_mirror_image() -> None:
    sides = Linear().sides(BLOCK)
    still, one, other = (
        _reaches(segment_table(Impulses(velocities=velocities, times=(0.0, 1.0))), sides)
        for velocities in ((1e-9, 1e-9), (0.9, 0.6), (-0.9, -0.6))
    )
    assert one == other
    assert min(one) > min(still)


def test_a_later_moment_is_a_window_on_the_rest_of_the_motion() -> None:
    later = fates(delay(PULSE, 2.0), time_pt=2.0)
    assert (later.fate == fates(PULSE).fate).all()
    gone = fates(PULSE, time_pt=100.0)
    assert (gone.safe == gone.still_safe).all()
    assert gone.global_integrity == gone.integrity_factor == 1.0


@pytest.mark.slow
def test_integrity_is_1_on_a_still_base_and_falls_with_the_scale() -> None:
    still = compute_fate_basins(BARE, Still())
    assert still.angle[-1] == pytest.approx(1.5, abs=0.01)
    assert still.global_integrity == still.integrity_factor == 1.0
    parts = still.fractions()
    assert sum(part.share for part in parts) == pytest.approx(1.0)
    assert {part.side for part in parts} == {0, 1, -1}
    # By symmetry both sides have one share; each is inside its interval.
    assert parts[1].states == parts[2].states
    assert all(part.low < part.share < part.high for part in parts)
    weak, strong = (
        fates(cut(Harmonic(amplitude=a, frequency_ratio=3.0), 20.0)).global_integrity
        for a in (0.0, 3.0)
    )
    assert weak == 1.0
    assert strong < 0.5


def test_without_loss_a_block_rocks_on() -> None:
    found = fates(
        Still(), DimensionlessBlock(restitution=1.0), angles=[-0.2, 0.2], velocities=[-0.1, 0.1]
    )
    assert (found.fate == Status.ROCKING).all()
    assert found.safe.all()
    assert "Still rocking" in found.summary(more=True)


def test_a_store_is_resumed_to_the_same_result(tmp_path: Path) -> None:
    class StoppedError(Exception):
        pass

    def stop(cells: int) -> None:
        if cells:
            raise StoppedError

    window = np.linspace(-1.3, 1.3, 40)
    given = {"angles": window, "velocities": window}
    place = tmp_path / "fates.zarr"
    with pytest.raises(StoppedError):
        fates(PULSE, **given, run=Execution(store=Store(place, chunk=100), progress=stop))
    counts: list[int] = []
    again = fates(
        PULSE,
        **given,
        run=Execution(store=Store(place, resume=True, chunk=100), progress=counts.append),
    )
    assert counts[0] > 0
    memory = fates(PULSE, **given, run=Execution(executor="serial"))
    assert again.to_dataset().equals(memory.to_dataset())


def test_what_cannot_be_computed_is_refused() -> None:
    with pytest.raises(InputError, match="cut"):
        fates(Harmonic(amplitude=1.0, frequency_ratio=2.0))
    with pytest.raises(ModelError, match="sizes"):
        fates(RECORD)
    with pytest.raises(InputError, match="time_pt"):
        fates(PULSE, time_pt=math.nan)
    with pytest.raises(ModelError, match="wall"):
        fates(PULSE, DimensionlessBlock(restitution=0.5, one_sided=True))


def test_it_speaks_for_itself() -> None:
    found = fates(RECORD, BLOCK)
    assert repr(found).startswith("<FateBasins: Fates under a record")
    assert found.model == Nonlinear()
    values = found.to_dict()
    assert values["global_integrity"] == found.global_integrity
    assert [row["states"] for row in values["fractions"]] == [p.states for p in found.fractions()]
    frame = found.to_dataframe()
    assert len(frame) == found.fate.size
    assert frame.fate[0] == Status(found.fate[0, 0]).label
    assert found.state(0, 1) == State(angle=WINDOW[1], velocity=WINDOW[0])
    edge = fates(scale(PULSE, 0.0), angles=[5.0, 6.0], velocities=[5.0, 6.0])
    assert math.isnan(edge.global_integrity)
    assert edge.to_dict()["global_integrity"] is None
    assert "global_integrity" not in edge.to_dataset().attrs
