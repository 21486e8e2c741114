"""Response curves: peak of a symmetric steady state against frequency (Figs 5 to 7)."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.steady.states import (
    SteadyStates,
    refuse_asymmetric,
    states_of,
    validated_branch,
)
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import positive
from rocksteady.model.equations import Model, ModelChoice
from rocksteady.results.result import Result


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ResponseCurve(Result):
    """Peak of one branch against frequency, as arrays of shape (frequencies,).

    Attributes
    ----------
    frequency_ratio
        Omega.
    frequency_hz
        The same for the block [Hz]; None for a dimensionless one.
    peak
        Largest u = theta/alpha of the half cycle; nan where there is no admissible solution.
    stable
        Whether it is stable.
    branch
        1 or 2.
    states
        The steady states from which it was read.
    block
        The block whose curve it is.
    """

    frequency_ratio: Floats
    frequency_hz: Floats | None
    peak: Floats
    stable: NDArray[np.bool_]
    branch: int
    states: SteadyStates
    block: Block | DimensionlessBlock

    @property
    def model(self) -> Model:
        """The equations of motion that hold."""
        return self.states.model


@checked
def compute_response_curve(
    block: Block | DimensionlessBlock,
    amplitude: float,
    *,
    frequency_ratio: ArrayLike | None = None,
    frequency_hz: ArrayLike | None = None,
    order: int = 1,
    branch: Literal[1, 2] = 1,
    model: ModelChoice = None,
) -> ResponseCurve:
    """Return the peak of a linear steady state against frequency (eqs 7, 19, 21, 22).

    Parameters
    ----------
    block
        Its restitution counts and, for frequencies in Hz, its p (eqs 26, 27).
    amplitude
        A = a_max/(alpha g).
    frequency_ratio, frequency_hz
        Give one of them, shape (frequencies,): Omega, or Hz for a `Block`.
    order
        n = 1, 3, 5, ...
    branch
        1 or 2.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Returns
    -------
    ResponseCurve
        Peaks, stability and both abscissas, arrays of shape (frequencies,).

    Raises
    ------
    InputError
        If a number is outside its range, or the frequencies are not one row of one or more.
    ModelError
        If not exactly one kind of frequency is given, Hz or the nonlinear model for a dimensionless
        block, or a block whose sides differ.

    Examples
    --------
    >>> block = Block.from_p(alpha=0.2, p=6.283185307179586, restitution=0.8)
    >>> curve = compute_response_curve(block, 3.0, frequency_hz=[3.0, 4.0, 8.0])
    >>> print(curve.frequency_ratio.round(12), curve.peak.round(5))
    [3. 4. 8.] [0.41243 0.24153 0.06281]
    """
    if (frequency_ratio is None) == (frequency_hz is None):
        raise ModelError(
            "frequency_ratio, frequency_hz",
            Words("are both missing" if frequency_hz is None else "are both given"),
            "exactly one of the two sets the frequencies",
            "give frequency_ratio (omega/p), or frequency_hz for a Block",
        )
    branch = validated_branch("branch", branch)
    if frequency_hz is not None:
        if not isinstance(block, Block):
            raise ModelError(
                "frequency_hz",
                frequency_hz,
                "hertz need a block with a frequency parameter p",
                "give a Block, or frequency_ratio",
            )
        hertz = np.atleast_1d(real_array("frequency_hz", frequency_hz))
        for value in hertz[~(np.isfinite(hertz) & (hertz > 0.0))][:1]:
            positive("frequency_hz", value, hint="give the frequency in Hz")
        ratios = 2.0 * math.pi * hertz / block.p
    else:
        assert frequency_ratio is not None
        ratios = np.atleast_1d(real_array("frequency_ratio", frequency_ratio))
    if ratios.ndim > 1 or not ratios.size:
        name = "frequency_ratio" if frequency_hz is None else "frequency_hz"
        valid = f"a curve has its frequencies in one row, not the shape {ratios.shape}"
        raise InputError(name, ratios.tolist(), valid, "give one or more, as [3.0, 4.0]")
    refuse_asymmetric(block, "block", "a response curve")
    states = states_of(block, amplitude, ratios, order, model)
    assert states.peak is not None
    assert states.admissible is not None
    which = branch - 1
    return ResponseCurve(
        frequency_ratio=ratios,
        frequency_hz=ratios * block.p / (2.0 * math.pi) if isinstance(block, Block) else None,
        peak=np.where(states.admissible[which], states.peak[which], math.nan),
        stable=states.stable[which],
        branch=branch,
        states=states,
        block=block,
    )
