"""Overturning spectra: all windows of amplitude in which a pulse overturns a block."""

import functools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.history.lowering import side_attributes
from rocksteady.dynamics.history.nonlinear_tables import sides_of
from rocksteady.dynamics.orbits.return_map import bare_block
from rocksteady.dynamics.overturning._cases import (
    BATCH,
    OUTPUTS,
    load_kernel,
    uplifts_of,
    windows_at,
)
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import in_range, index_value, is_pair
from rocksteady.model.equations import Linear, Model, chosen_model
from rocksteady.model.motions.pulses import Pulse
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Run

if TYPE_CHECKING:
    import xarray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

TOP = 20.0
"""Default largest amplitude of the search; for a block that hardly lifts by then,"""
UPLIFTS = 2.0
"""up to as many times that at which it lifts."""
HIGHEST = 1e6
"""Largest amplitude of a range."""
RESOLUTION = 2e-3


class OverturningWindow(NamedTuple):
    """A range of amplitudes over which the block overturns in the same way."""

    low: float
    high: float
    """In units of alpha g; where `endless` is true, the end of the range of amplitudes."""
    impacts: int
    """Before it overturns; where they are ten or more, they vary, and these are those at `low`."""
    side: int
    """On which it falls, +1 or -1."""
    endless: bool
    """Whether the window reaches the end of the range, so that its own end is not known."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class OverturningWindows:
    """All windows of amplitude in which a pulse overturns a block, over the frequency ratio.

    Attributes
    ----------
    block, pulse
        What falls and what makes it; of the pulse its shape counts.
    model
        `Linear()` or `Nonlinear()`.
    frequency_ratio
        omega/p, ascending, shape (frequencies,).
    amplitudes
        Ends of the range that was searched, a_max/(alpha g).
    resolution
        The largest step of the first amplitudes that were tried, as a part of them.
    low, high
        Ends of the windows, shape (frequencies, windows); nan beyond the last of a frequency.
        Windows that touch differ in their impacts or their side.
    impacts
        Before the block overturns, the same shape; -1 beyond the last.  Ten or more vary in a
        window, and those at its lower end stand here; of the infinitely many before a rest
        those count that came before it was proved.
    side
        On which it falls, +1 or -1; 0 beyond the last.
    first
        The smallest amplitude that overturns the block, shape (frequencies,); nan where none does.
    left_out, left_out_width
        How many windows there are beyond the widest 32, and how wide they are together, to within
        the steps of the search.
    undecided
        Amplitudes that were tried and whose fate could not be decided; they count as safe.
    unsettled
        Intervals in which a window might still hide when the search ended, after more than ten
        thousand amplitudes; above 0 only where windows have no number, or nearly none.
    """

    block: Block | DimensionlessBlock
    pulse: Pulse
    model: Model
    frequency_ratio: Floats
    amplitudes: tuple[float, float]
    resolution: float
    low: Floats
    high: Floats
    impacts: Integers
    side: Integers
    first: Floats
    left_out: Integers
    left_out_width: Floats
    undecided: Integers
    unsettled: Integers

    def at(self, index: int) -> tuple[OverturningWindow, ...]:
        """Return the windows at one of the frequencies, in ascending order."""
        index = index_value(index, len(self.frequency_ratio), "frequency ratio")
        return tuple(
            OverturningWindow(low, high, impacts, side, high >= self.amplitudes[1])
            for low, high, impacts, side in zip(
                *(part[index].tolist() for part in (self.low, self.high, self.impacts, self.side)),
                strict=True,
            )
            if side != 0
        )

    def intervals(self, index: int) -> list[tuple[float, float]]:
        """Return where the block overturns at one of the frequencies, in whatever way."""
        found: list[tuple[float, float]] = []
        for window in self.at(index):
            if found and found[-1][1] == window.low:
                found[-1] = (found[-1][0], window.high)
            else:
                found.append((window.low, window.high))
        return found

    def to_dataset(self) -> "xarray.Dataset":
        """Return the windows as an xarray Dataset over frequency ratio and window."""
        import xarray

        along, both = ("frequency_ratio",), ("frequency_ratio", "window")
        amplitude = {"units": "1", "long_name": "a_max/(alpha g)"}
        return xarray.Dataset(
            {
                "low": (both, self.low, amplitude),
                "high": (both, self.high, amplitude),
                "impacts": (
                    both,
                    self.impacts,
                    {"units": "1", "long_name": "impacts; -1: no window"},
                ),
                "side": (both, self.side, {"units": "1"}),
                "first": (along, self.first, amplitude),
                "left_out": (along, self.left_out, {"units": "1"}),
                "left_out_width": (along, self.left_out_width, {"units": "1"}),
                "undecided": (along, self.undecided, {"units": "1"}),
                "unsettled": (along, self.unsettled, {"units": "1"}),
            },
            coords={
                "frequency_ratio": (along, self.frequency_ratio, {"long_name": "omega/p"}),
                "window": ("window", np.arange(self.low.shape[1])),
            },
            attrs={
                "pulse": self.pulse.shape,
                "model": self.model.name,
                **side_attributes(self.block),
                "amplitudes": list(self.amplitudes),
                "resolution": self.resolution,
            },
        )

    def _repr_html_(self) -> str:
        """Return a small table for notebooks."""
        rows = "".join(
            f"<tr><td>{ratio:.6g}</td><td>"
            + ", ".join(f"{low:.6g} to {high:.6g}" for low, high in self.intervals(index))
            + "</td></tr>"
            for index, ratio in enumerate(self.frequency_ratio.tolist())
        )
        caption = f"Amplitudes at which a {self.pulse.shape} pulse overturns the block"
        heads = "<tr><th>omega/p</th><th>a/(alpha g)</th></tr>"
        return f"<table><caption>{caption}</caption>{heads}{rows}</table>"


@checked
def find_overturning_windows(
    block: Block | DimensionlessBlock,
    pulse: Pulse | str,
    frequency_ratios: ArrayLike,
    *,
    model: Model | None = None,
    amplitudes: tuple[float, float] | None = None,
    resolution: float = RESOLUTION,
    run: Run | None = None,
) -> OverturningWindows:
    r"""Return all windows of amplitude in which a pulse overturns a block, over the frequency.

    The amplitudes at which a block stands are not an interval [1]_: under a one-sine pulse it may
    fall after one impact, stand under a stronger pulse, and fall without an impact under a still
    stronger one.  At each frequency ratio the borders are found to rounding, or in the nonlinear
    model to a part of 1e-12.  They are searched on
    a grid of amplitudes that is refined wherever the fate, the impacts on the way or the margin by
    which the block stands or falls leave a doubt: `rocksteady.dynamics.overturning._scan` says how,
    and which windows could still be missed.  Long pulses with many impacts, below omega/p = 1 or of
    several cycles, have windows without end to their number: there the result is those that the
    resolution shows, and `unsettled` says where the search was ended.

    Parameters
    ----------
    block
        The block, at rest at first.  In the linear model its restitution counts, and the ratios of
        its sides; in the nonlinear one its slenderness too.
    pulse
        The name of a shape, or a `Pulse` for its shape, oscillations, phase and tolerance.
    frequency_ratios
        omega/p, ascending, shape (frequencies,), from 0.01 to 5000.
    model
        `Linear()`, in closed form, or `Nonlinear()`, the full equations within its tolerance; by
        default nonlinear for a `Block`.
    amplitudes
        Range of a_max/(alpha g) to search, from 0 to 1e6; without, from uplift to 20, or to twice
        an uplift beyond 10.  Where a window reaches its end, nothing is known beyond.
    resolution
        Largest step of the first amplitudes, as a part of them, from 1e-6 to 0.1.
    run
        As for `rocksteady.sweep.evaluate.evaluate`; a cell is a frequency.

    Returns
    -------
    OverturningWindows
        The windows with the impacts before overturning and the side of each.

    Raises
    ------
    InputError
        If an argument is outside its range, or the ratios do not ascend.
    ModelError
        If the nonlinear model meets a block without slenderness, or as for `Pulse`.
    OutputError, UnfinishedError
        As for `rocksteady.sweep.evaluate.evaluate`.

    References
    ----------
    .. [1] J. Zhang and N. Makris, J. Eng. Mech. 127, 473-483 (2001).

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, find_overturning_windows
    >>> found = find_overturning_windows(
    ...     DimensionlessBlock(restitution=0.9), "one-sine", [2.0, 5.0]
    ... )
    >>> for window in found.at(1):
    ...     print(f"{window.low:.6f} to {window.high:.6f}, {window.impacts} impacts")
    3.018600 to 6.318071, 1 impacts
    7.168129 to 20.000000, 0 impacts

    The full equations of a block of that restitution with alpha = 0.25:

    >>> from rocksteady import Block
    >>> block = Block.from_p(alpha=0.25, p=2.14, restitution=0.9)
    >>> found = find_overturning_windows(block, "one-sine", 5.0)
    >>> [(round(low, 6), round(high, 6)) for low, high in found.intervals(0)]
    [(3.032339, 6.743019), (7.493, 20.0)]
    """
    bare = bare_block(block)
    axis = _ratios(frequency_ratios)
    unit = _unit(pulse, axis.points)
    chosen = chosen_model(model, block, unit)
    # What counts of a block of the linear model is dimensionless.
    body = bare if isinstance(chosen, Linear) else block
    uplifts = uplifts_of(sides_of(body, chosen))
    usual = min(*uplifts, 1.0), min(max(TOP, UPLIFTS * max(uplifts)), HIGHEST)
    low, high = _range(usual if amplitudes is None else amplitudes)
    hint = "give a part of the amplitude, as 0.002"
    step = in_range("resolution", resolution, 1e-6, 0.1, "[]", hint=hint)
    load_kernel(body, chosen, unit)
    data = evaluate(
        functools.partial(
            windows_at,
            block=body,
            model=chosen,
            pulse=unit,
            low=low,
            high=high,
            resolution=step,
        ),
        Grid(axes=(axis,)),
        OUTPUTS,
        run=run,
        batch=BATCH,
    )
    kept = max(1, int(data["windows"].values.max()))
    way = np.stack([data[f"way_{k}"].values for k in range(kept)], axis=1).astype(np.int64)
    return OverturningWindows(
        block=block,
        pulse=unit,
        model=chosen,
        frequency_ratio=axis.points,
        amplitudes=(low, high),
        resolution=step,
        low=np.stack([data[f"low_{k}"].values for k in range(kept)], axis=1),
        high=np.stack([data[f"high_{k}"].values for k in range(kept)], axis=1),
        impacts=np.abs(way) - 1,
        side=np.sign(way),
        first=data["first"].values,
        left_out=data["left_out"].values.astype(np.int64),
        left_out_width=data["left_out_width"].values,
        undecided=data["undecided"].values.astype(np.int64),
        unsettled=data["unsettled"].values.astype(np.int64),
    )


def _unit(pulse: Pulse | str, ratios: Floats) -> Pulse:
    """Return the pulse of amplitude 1 and frequency ratio 1, at which the table is made."""
    given = pulse
    if isinstance(given, str):
        given = Pulse(shape=given, amplitude=1.0, frequency_ratio=1.0)
    if not isinstance(given, Pulse):
        raise InputError(
            "pulse", pulse, "it must be a Pulse or the name of one", "give a name, as 'one-sine'"
        )
    shape: dict[str, Any] = {
        "shape": given.shape,
        "amplitude": 1.0,
        "oscillations": given.oscillations,
        "phase": given.phase,
        "tolerance": given.tolerance,
    }
    for ratio in (ratios.min(), ratios.max()):
        Pulse(frequency_ratio=float(ratio), **shape)  # refuses what is outside its range
    return Pulse(frequency_ratio=1.0, **shape)


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


def _range(amplitudes: tuple[float, float]) -> tuple[float, float]:
    """Return the ends of the range of amplitudes."""
    given: object = amplitudes
    hint = "give the lowest and the highest a_max/(alpha g), as (1.0, 20.0)"
    if not is_pair(given):
        raise InputError("amplitudes", given, "it must be a pair", hint)
    low = in_range("amplitudes", given[0], 0.0, HIGHEST, "[)", hint=hint)
    high = in_range("amplitudes", given[1], low, HIGHEST, "(]", hint=hint)
    return low, high
