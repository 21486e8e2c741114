"""Overturning spectra: all windows of amplitude in which a pulse overturns a block."""

import functools
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.nonlinear_tables import sides_of
from rocksteady.dynamics.overturning._cases import BATCH, least_lift, load_kernel, windows_at
from rocksteady.dynamics.overturning.thresholds import THRESHOLDS
from rocksteady.dynamics.overturning.window_cells import (
    kept_windows,
    outputs,
    search_both_ways,
    uplifts_of,
)
from rocksteady.dynamics.overturning.window_lists import (
    NO_WINDOW,
    OTHER_WAY,
    WindowLists,
    floor_digits,
    listed,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import in_range, index_value, is_pair, rising
from rocksteady.model.equations import Linear, ModelChoice, chosen_model
from rocksteady.model.facts import amplitude_text, case_text, restitution_values, solved_text
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.pulses import Pulse
from rocksteady.results.answer import Answer
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


TOP = 20.0
"""Default largest amplitude of the search; for a block that hardly lifts by then,"""
UPLIFTS = 2.0
"""up to as many times that at which it lifts."""
HIGHEST = 1e6
"""Largest amplitude of a range."""
RESOLUTION = 2e-3
MOST_ROWS = 100
"""Windows that a summary shows."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class OverturningWindows(WindowLists):
    """All windows of amplitude in which a pulse overturns a block, over the frequency ratio.

    Attributes
    ----------
    block, pulse
        Block and pulse; only the shape of the pulse counts.
    floor
        Floor of the block, or None; amplitudes and frequencies are those of the ground.
    model
        `Linear()` or `Nonlinear()`.
    frequency_ratio
        omega/p, ascending, shape (frequencies,).
    within
        Ends of the range of amplitudes that was searched, a_max/(alpha g).
    resolution
        The largest step of the first amplitudes that were tried, as a part of them.
    low, high
        Ends of the windows, shape (frequencies, windows); nan beyond the last of a frequency.  On a
        floor, whose motion is lines within 1e-3 of the ground's peak, four digits are right, and
        windows narrower than `resolution` may be missing.
        Windows that touch differ in their impacts or their side.
    impacts
        Impacts before the block overturns, as `Impacts` counts them, the same shape; -1 beyond the
        last.  Ten or more, and on a floor all, vary in a window: those at its lower end stand here.
    side
        Side on which it falls, +1 or -1; 0 beyond the last.
    first
        The smallest amplitude that overturns the block, shape (frequencies,); nan where none does.
    opposite
        That of the reversed pulse, the same for a block whose sides are alike; the smaller governs
        where the direction of the motion is not known.
    left_out, left_out_width
        Number of windows beyond the widest 32, and their total width, to within
        the steps of the search.
    left_out_low, left_out_high
        Ends of the stretches in which they lie, or narrower ones may hide, between and beside the
        windows listed, shape (frequencies, stretches); nan beyond the last.
    undecided
        Amplitudes that were tried, either way, and whose fate could not be decided; they count as
        safe.
    unsettled
        Intervals, either way, in which a window might still hide when the search ended.  On the
        ground above 0 only after more than ten thousand amplitudes: where windows have no number,
        or nearly none.
    """

    pulse: Pulse
    frequency_ratio: Floats
    floor: Floor | None = None

    def _row_of(self, index: int | str) -> int:
        """Return a frequency by its number."""
        return index_value(index, len(self.frequency_ratio), "frequency ratio")

    def to_dataset(self) -> "xarray.Dataset":
        """Return the windows as an xarray Dataset over frequency ratio and window."""
        import xarray

        along = "frequency_ratio"
        return xarray.Dataset(
            self._variables(along, {"units": "1", "long_name": "a_max/(alpha g)"}),
            coords={
                along: (along, self.frequency_ratio, {"long_name": "omega/p"}),
                "window": ("window", np.arange(self.low.shape[1])),
            },
            attrs={
                "pulse": self.pulse.shape,
                "reversed": int(self.pulse.reverse),
                **({} if self.floor is None else {"floor": self.floor.label}),
                **self._searched,
            },
        )

    def describe(self) -> Description:
        """Return the windows by frequency, in g and Hz too where the block has a size."""
        block, pulse, floor = self.block, self.pulse, self._floor_text
        least, most = (amplitude_text(block, end) for end in self.within)
        facts = [
            self._block_fact,
            Fact("pulse", pulse.shape, "pulse", self._pulse_text),
            Fact("reversed", pulse.reverse),
            Fact("oscillations", pulse.oscillations),
            Fact("phase", pulse.phase),
            Fact("floor", floor or None, "stands on" if floor else ""),
            Fact("model", self.model.name, "model"),
            Fact("amplitudes", list(self.within), "searched", f"{least} to {most}"),
            Fact("resolution", self.resolution),
            *(Fact(key, value) for key, value in restitution_values(block).items()),
        ]
        rows = [self._row(index) for index in range(len(self.frequency_ratio))]
        windows = Table(
            "",
            list(self._window_rows(rows)),
            self._columns(),
            most=MOST_ROWS,
            severity=lambda row: -row["low"],
        )
        notes = [f"A is a/(alpha g){', of the ground' if floor else ''}."]
        stands = [number(ratio) for ratio in self.frequency_ratio[np.isnan(self.governing)]]
        if stands:
            notes.append(
                f"The block stands throughout at omega/p = {', '.join(stands[:8])}"
                + (f" and {len(stands) - 8} more." if stands[8:] else ".")
            )
        left_out = int(self.left_out.sum())
        if left_out:
            notes.append(
                f"{left_out} narrower windows are left out, at no frequency more than "
                f"{self.left_out_width.max():.2g} wide together."
            )
        unsettled = int((self.unsettled > 0).sum())
        if unsettled:
            notes.append(
                f"At {unsettled} of the frequencies there are so many windows that narrow ones may "
                "be missing."
            )
        headline = (
            f"Overturning: {self._pulse_text} pulse, "
            f"{floor}{', ' if floor else ''}"
            f"{case_text(block)}, {self.model.name} model"
        )
        tables = [windows, Table("windows", rows)]
        return Description(headline, facts, tables, notes, answer=self._answer(rows))

    def _answer(self, rows: list[dict[str, Any]]) -> Answer:
        """Return where it falls, at the one frequency or at each."""
        sized, unit = isinstance(self.block, Block), 1.0
        if isinstance(self.block, Block):
            unit = in_g(self.block.uplift_acceleration)

        def write(amplitude: float) -> str:
            size = number(amplitude * unit)
            return f"{size} g" if sized else f"A = {size}"

        names = [
            quantity(row["freq_hz"], "Hz") if sized else f"W = {number(row['frequency_ratio'])}"
            for row in rows
        ]
        shown, pulse = self._by_first, f"{self._pulse_text} pulse"
        searched = f"{write(self.within[0])} to {write(self.within[1])}{self._missing}"
        facts = [
            ("stands on", self._floor_text),
            self._undecided,
            ("searched", solved_text(searched, self.block)),
            self._computed,
        ]
        at = names[0] if len(names) == 1 else f"all {len(names)} frequencies"
        stand = Answer(f"It stands in the {pulse} at {at}, up to {write(self.within[1])}.", facts)
        if not shown:
            return stand
        if len(rows) > 1:
            stands = [names[row] for row in np.flatnonzero(np.isnan(self.governing))]
            facts[1:1] = [
                *((names[row], self._governing_verdict(row, write)) for row in shown),
                self._rest,
                ("stands at", listed(stands)),
            ]
            least = float(self.governing[shown[0]])
            way = f", {OTHER_WAY}" * bool(self.opposite_governs[shown[0]])
            sentence = (
                f"It falls at {len(rows) - len(stands)} of {len(rows)} frequencies, "
                f"{self._first_at(least, write)} ({names[shown[0]]}, {pulse}{way})."
            )
            return Answer(sentence, facts)
        if math.isnan(self.first[0]):
            return self._with_other_way(write, stand)
        first, last = self.at(0)[0], self.at(0)[-1]
        after = f"{plural(first.impacts, 'impact')} at {write(first.low)}"
        if last.low > first.low:
            after += f", {plural(last.impacts, 'impact')} at {write(last.low)}"
        spans = "{} g" if sized else "A = {}"
        widest, closed = self._widest(0, unit), rows[0]["closed_form"]
        facts[1:1] = [
            ("falls", widest and f"{spans.format(widest)}{self._narrower(0)}"),
            ("falls after", after),
            ("without impact", "" if closed is None else f"from {write(closed)} on, closed form"),
        ]
        sentence = f"It falls {self._verdict(0, write)} ({names[0]} {pulse})."
        return self._with_other_way(write, Answer(sentence, facts))

    @property
    def _on_floors(self) -> bool:
        return self.floor is not None

    @property
    def _pulse_text(self) -> str:
        """The pulse in a word or two."""
        return f"reversed {self.pulse.shape}" if self.pulse.reverse else self.pulse.shape

    @property
    def _floor_text(self) -> str:
        """The floor in words; empty on the ground."""
        return "" if self.floor is None else self.floor.label

    def _row(self, index: int) -> dict[str, Any]:
        """Return all that is known at one of the frequencies."""
        ratio, intervals = float(self.frequency_ratio[index]), self.intervals(index)
        closed = None
        if self.pulse.shape in THRESHOLDS and isinstance(self.model, Linear) and self.floor is None:
            closed = float(threshold_without_impact(self.block, self.pulse, ratio))
        row: dict[str, Any] = {
            "frequency_ratio": ratio,
            "intervals": [list(ends) for ends in intervals],
            "modes": self._modes(index),
            "first": float(self.first[index]),
            "opposite": float(self.opposite[index]),
            "governing": float(self.governing[index]),
            "governs": self._governs(index),
            "closed_form": closed,
            **self._left(index),
        }
        if isinstance(self.block, Block):
            unit = in_g(self.block.uplift_acceleration)
            row["freq_hz"] = replace(self.pulse, frequency_ratio=ratio).frequency_hz(self.block)
            row["governing_g"] = row["governing"] * unit
            row["intervals_g"] = [[end * unit for end in ends] for ends in intervals]
        return row if self.floor is None else floor_digits(row)

    def _window_rows(self, rows: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
        """Yield one row per window, as in tables and files."""
        for row in rows:
            head: dict[str, Any] = {
                name: row[name]
                for name in ("frequency_ratio", "freq_hz", "governing", "governing_g", "governs")
                if name in row
            }
            for mode in row["modes"] or [NO_WINDOW] * bool(row["governs"]):
                low, high = mode["interval"]
                window: dict[str, Any] = {**head, "low": low, "high": high}
                if isinstance(self.block, Block):
                    unit = in_g(self.block.uplift_acceleration)
                    window |= {"low_g": low * unit, "high_g": high * unit}
                for name in ("impacts", "side", "endless"):
                    window[name] = mode[name]
                yield window if self.floor is None else floor_digits(window)

    def _columns(self) -> list[Column]:
        """Return what people read of a window: in Hz and g first where the block has a size."""

        def high(value: float) -> str:
            return "the end" if value >= self.within[1] else number(value, 6)

        columns = [
            Column("frequency_ratio", "omega/p", lambda value: number(value, 5)),
            Column("low", "from A", lambda value: number(value, 6)),
            Column("high", "to A", high),
            Column("impacts", "impacts", lambda value: str(value) if value >= 0 else ""),
            Column("side", "side", lambda value: ("", "+", "-")[value]),
        ]
        if self._two_ways:
            name, unit = ("_g", "g") if isinstance(self.block, Block) else ("", "A")
            columns.append(Column(f"governing{name}", f"first {unit}"))
            columns.append(Column("governs", "governs"))
        if isinstance(self.block, Block):
            columns[:0] = [
                Column("freq_hz", "Hz"),
                Column("low_g", "from g"),
                Column("high_g", "to g"),
            ]
        return columns


@checked
def find_overturning_windows(
    block: Block | DimensionlessBlock,
    pulse: Pulse | str,
    frequency_ratios: ArrayLike,
    *,
    within: tuple[float, float] | None = None,
    resolution: float | None = None,
    model: ModelChoice = None,
    floor: Floor | None = None,
    run: Execution | None = None,
) -> OverturningWindows:
    """Find all windows of amplitude in which a pulse overturns a block, over the frequency.

    The amplitudes at which a block stands are not an interval [1]_: under a one-sine pulse it may
    fall after one impact, stand under a stronger pulse, and fall without an impact under a still
    stronger one.  At each frequency ratio the borders are found to rounding, or in the nonlinear
    model to a part of 1e-12, on a grid of amplitudes that is refined wherever the fate, the impacts
    on the way or the margin leave a doubt.  Long pulses with many impacts, below omega/p = 1 or of
    several cycles, have windows without end to their number: there `unsettled` counts where the
    search was ended.

    Parameters
    ----------
    block
        At rest at first.  In the linear model its restitution counts, and the ratios of its sides;
        in the nonlinear one its slenderness too.  One against a wall is held by what throws it
        there.
    pulse
        The name of a shape, or a `Pulse` for its shape, oscillations, phase and tolerance.
    frequency_ratios
        omega/p, ascending, shape (frequencies,), from 0.01 to 5000.
    within
        Range (low, high) of a_max/(alpha g), from 0 to 1e6; by default from uplift to 20, or to
        twice an uplift beyond 10.  Where a window reaches its end, nothing is known beyond.
    resolution
        Largest step of the first amplitudes, as a part of them (default 0.002).
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    floor
        A `rocksteady.motions.Floor` on which the block stands, a `Block`: at each frequency the
        motion is `floor_motion` of the pulse; amplitudes are those of the ground, by default from
        the least that lifts the block.  Impacts are many there: they vary in a window, and do not
        part any.
    run
        Executor, store and progress, as for `evaluate`; a cell is a frequency.

    Returns
    -------
    OverturningWindows
        The windows with the impacts before overturning and the side of each.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If an argument is outside its range, the ratios do not ascend, the nonlinear model meets a
        block without slenderness, or as for `Pulse` and `evaluate`.

    References
    ----------
    .. [1] J. Zhang and N. Makris, J. Eng. Mech. 127, 473-483 (2001).

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, find_overturning_windows
    >>> block = DimensionlessBlock(restitution=0.9)
    >>> windows = find_overturning_windows(block, "one-sine", [2.0, 5.0])
    >>> for window in windows.at(1):
    ...     print(f"{window.low:.6f} to {window.high:.6f}, {window.impacts} impacts")
    3.018600 to 6.318071, 1 impacts
    7.168129 to 20.000000, 0 impacts
    """
    bare = block.dimensionless()
    axis = _ratios(frequency_ratios)
    unit = _unit(pulse, axis.points)
    chosen = chosen_model(model, block)
    # What counts of a block of the linear model is dimensionless.
    body = bare if isinstance(chosen, Linear) and floor is None else block
    if floor is not None and not isinstance(block, Block):
        raise ModelError("floor", floor, "its hertz need a block with a p", "give a Block")
    if within is None:
        top = min(max(TOP, UPLIFTS * max(uplifts_of(sides_of(body, chosen)))), HIGHEST)
        within = lowest_of(block, unit, axis.points.tolist(), model=chosen, floor=floor), top
    low, high = range_of(within)
    hint = "give a part of the amplitude, as 0.002"
    part = RESOLUTION if resolution is None else resolution
    step = in_range("resolution", part, 1e-6, 0.1, "[]", hint=hint)
    load_kernel(body, chosen, unit)
    data = compute_cells(
        functools.partial(
            search_both_ways,
            search=windows_at,
            block=body,
            model=chosen,
            pulse=unit,
            low=low,
            high=high,
            resolution=step,
            floor=floor,
        ),
        Grid(axes=(axis,)),
        outputs(),
        run=run,
        batch=BATCH,
    )
    return OverturningWindows(
        block=block,
        pulse=unit,
        model=chosen,
        frequency_ratio=axis.points,
        floor=floor,
        within=(low, high),
        resolution=step,
        **kept_windows(data),
    )


def lowest_of(
    block: Block | DimensionlessBlock,
    pulse: Pulse,
    ratios: Iterable[float],
    *,
    model: ModelChoice,
    floor: Floor | None,
) -> float:
    """Return the amplitude at which a search begins: of uplift, and on the ground at most 1.

    Parameters
    ----------
    block, pulse, model, floor
        As for `find_overturning_windows`.
    ratios
        omega/p.
    """
    equations = chosen_model(model, block)
    if floor is None:
        return min(*uplifts_of(sides_of(block, equations)), 1.0)
    return least_lift(floor, block, equations, replace(pulse, amplitude=1.0), ratios)


def threshold_without_impact(
    block: Block | DimensionlessBlock, pulse: Pulse, frequency_ratios: ArrayLike
) -> Floats:
    """Return `overturning_amplitude` for the side that a pulse lifts first, in A of the positive.

    Parameters
    ----------
    block
        For the negative side, which a reversed pulse lifts, alpha and p count; not for a block
        against a wall, which a reversed pulse holds at first.
    pulse
        Its shape and sign count.
    frequency_ratios
        Omega = omega/p of the positive side.
    """
    _, alpha_ratio, p_ratio = block.dimensionless().sides[int(pulse.reverse)]
    # Without the bounds of `overturning_amplitude`, which hold for the positive side.
    threshold = np.vectorize(THRESHOLDS[pulse.shape], otypes=[np.float64])
    amplitude: Floats = alpha_ratio * threshold(np.asarray(frequency_ratios) / p_ratio)
    return amplitude


def _unit(pulse: Pulse | str, ratios: Floats) -> Pulse:
    """Return the pulse of amplitude 1 and frequency ratio 1, at which the table is made."""
    given = pulse
    if isinstance(given, str):
        given = Pulse(shape=given, amplitude=1.0, frequency_ratio=1.0)
    if not isinstance(given, Pulse):
        raise InputError(
            "pulse", pulse, "it must be a Pulse or the name of one", "give a name, as 'one-sine'"
        )
    for ratio in (ratios.min(), ratios.max()):  # refuses what is outside its range
        replace(given, amplitude=1.0, frequency_ratio=float(ratio))
    return replace(given, amplitude=1.0, frequency_ratio=1.0)


def _ratios(frequency_ratios: ArrayLike) -> Axis:
    """Return the axis of frequency ratios."""
    axis = Axis(name="frequency_ratio", values=np.atleast_1d(frequency_ratios), long_name="omega/p")
    if axis.points.dtype.kind != "f" or (np.diff(axis.points) <= 0.0).any():
        raise InputError(
            "frequency_ratios",
            frequency_ratios,
            "they must be numbers that ascend",
            "give them from the lowest to the highest",
        )
    return axis


def range_of(within: tuple[float, float]) -> tuple[float, float]:
    """Return the ends of the range of amplitudes."""
    given: object = within
    hint = "give the lowest and the highest a_max/(alpha g), as (1.0, 20.0)"
    if not is_pair(given):
        raise InputError("within", given, "it must be a pair", hint)
    return rising("within", given, 0.0, HIGHEST, hint=hint)
