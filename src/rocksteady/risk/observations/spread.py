"""What is known of a number: its value, two bounds, or a mean with a standard deviation."""

import math
import re
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array
from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import finite, in_range, positive

_NUMBER: Final = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_FORMS: Final = re.compile(rf"(log:)?({_NUMBER})(?:\s*(:|\+-|\+/-|±)\s*({_NUMBER}))?")
_LONGEST: Final = 200
"""Characters of a text that is a number; longer ones are not tried."""


@checked
@dataclass(frozen=True, kw_only=True)
class PriorRange:
    """Distribution of a number before the tests.

    A value (`exactly`), a density between two bounds that is uniform in the number (`between`) or
    in its logarithm (`in_logarithm`), or a normal density that is cut off at bounds (`around`).

    Parameters
    ----------
    low, high
        Bounds; equal of a value.
    mean, sd
        Mean and standard deviation of the normal density before it is cut off; none for a value and
        for a uniform density.
    logarithmic
        Whether the density is uniform in the logarithm, of bounds above 0; default False.

    Raises
    ------
    InputError
        If a number is not finite, `low` is above `high`, the standard deviation is not above 0, or
        the mean is outside the bounds.  Bounds of a normal density may be infinite.

    Examples
    --------
    >>> PriorRange.parse("0.6:1.0").quantile([0.0, 0.5, 1.0]).tolist()
    [0.6, 0.8, 1.0]
    >>> PriorRange.parse("0.30+-0.02").within("height_m", 0.0, 1.0)
    <Spread 0.3+-0.02>
    >>> PriorRange.exactly(0.25).fixed
    True
    """

    low: float
    high: float
    mean: float | None = None
    sd: float | None = None
    logarithmic: bool = False

    def __post_init__(self) -> None:
        """Validate."""
        normal = self.mean is not None or self.sd is not None
        for name in ("low", "high"):
            value = getattr(self, name)
            if not (normal and isinstance(value, float) and math.isinf(value)):
                number = finite(name, value, hint="give a number")
                object.__setattr__(self, name, number + 0.0)  # of -0.0 it makes 0.0
        if self.low > self.high:
            raise InputError(
                "low", self.low, f"it must not be above high = {self.high:g}", "exchange the two"
            )
        if self.logarithmic and (normal or self.low <= 0.0):
            hint = "give bounds above 0, or leave log: out"
            raise InputError("low", self.low, "a range in the logarithm lies above 0", hint)
        if not normal:
            return
        object.__setattr__(self, "sd", positive("sd", self.sd, hint="give a standard deviation"))
        mean = finite("mean", self.mean, hint="give a number")
        object.__setattr__(self, "mean", mean)
        if not self.low <= mean <= self.high or self.low == self.high:
            raise InputError(
                "mean",
                mean,
                f"it must lie in [{self.low:g}, {self.high:g}], which is what is possible",
                "give another mean",
            )

    @classmethod
    def exactly(cls, value: float) -> "PriorRange":
        """Return a number without any spread."""
        return cls(low=value, high=value)

    @classmethod
    def between(cls, low: float, high: float) -> "PriorRange":
        """Return a uniform density between two bounds."""
        return cls(low=low, high=high)

    @classmethod
    def in_logarithm(cls, low: float, high: float) -> "PriorRange":
        """Return a density between two bounds above 0, uniform in the logarithm."""
        return cls(low=low, high=high, logarithmic=True)

    @classmethod
    def around(
        cls, mean: float, sd: float, *, low: float = -math.inf, high: float = math.inf
    ) -> "PriorRange":
        """Return a normal density, cut off at bounds where they are given."""
        return cls(low=low, high=high, mean=mean, sd=sd)

    @classmethod
    def parse(cls, text: str, *, name: str = "spread") -> "PriorRange":
        """Return the spread of a text.

        Parameters
        ----------
        text
            A number, ``low:high``, ``log:low:high`` or ``mean+-sd``.
        name
            What it is called in messages; default "spread".

        Raises
        ------
        InputError
            If it is none of the three, or as for `PriorRange`.
        """
        given: object = text
        parts = parts_of(given) if isinstance(given, str) else None
        if parts is None:
            hint = "write a point for a decimal comma" if "," in str(given) else "leave units out"
            if str(given).strip().lower().startswith("housner"):
                hint = "give a factor of Housner's value as housner_factor, 1 for the value itself"
            valid = (
                "it must be a number, a range as 0.3:0.5 or log:0.03:1.2, or mean and deviation as "
                "0.4+-0.05"
            )
            raise InputError(name, text, valid, hint)
        numbers, sign = parts
        for number in numbers:
            in_range(name, number, -1e50, 1e50, "[]", hint="give numbers of usual size")
        try:
            if sign == "+-":
                return cls.around(*numbers)
            return cls(low=numbers[0], high=numbers[-1], logarithmic=sign == "log:")
        except InputError as error:
            raise InputError(name, text, f"{error.name}: {error.valid}", error.hint) from None

    @property
    def fixed(self) -> bool:
        """Whether it is a value without any spread."""
        return self.low == self.high

    @property
    def middle(self) -> float:
        """The value, the mean of both bounds (in the logarithm), or that of the normal density."""
        if self.logarithmic:
            return math.sqrt(self.low * self.high)
        return 0.5 * (self.low + self.high) if self.mean is None else self.mean

    def within(self, name: str, low: float, high: float, *, hint: str = "") -> "PriorRange":
        """Return the spread inside what is possible.

        Parameters
        ----------
        name, hint
            What it is called in messages, and what to do next.
        low, high
            Limits: a normal density is cut off there, a value or a bound outside is refused.

        Raises
        ------
        InputError
            If a value, a bound or a mean is outside.
        """
        low, high = (
            finite(key, end, hint="give it") for key, end in (("low", low), ("high", high))
        )
        hint = hint or f"give a number from {low:.6g} to {high:.6g}"
        ends = (self.low, self.high) if self.mean is None else (self.mean,)
        for end in ends:
            in_range(name, end, low, high, "[]", hint=hint)
        if self.mean is None:
            return self
        return replace(self, low=max(self.low, low), high=min(self.high, high))

    def quantile(self, uniforms: ArrayLike) -> Floats:
        """Return the value below which a share of the density lies.

        Parameters
        ----------
        uniforms
            Shares from 0 to 1, of any shape.

        Returns
        -------
        ndarray
            Values, of that shape.

        Raises
        ------
        InputError
            If a share is no number from 0 to 1.
        """
        share = checked_array("uniforms", uniforms, Bounds(0.0, 1.0, "[]", "give shares"))
        if self.logarithmic:
            values = self.low * exp(share * log(self.high / self.low))
        elif self.mean is None or self.sd is None:
            values = self.low + share * (self.high - self.low)
        else:
            from scipy.special import ndtr, ndtri

            low, high = ((end - self.mean) / self.sd for end in (self.low, self.high))
            below = float(ndtr(low))
            inside = max(0.0, 1.0 - below - float(ndtr(-high)))
            # From the nearer end, where the share of what lies beyond it is a small number.
            from_low = below + share * inside
            from_high = (1.0 - below - inside) + (1.0 - share) * inside
            score = np.where(from_low < 0.5, ndtri(from_low), -ndtri(from_high))
            score = np.rint(score * 2.0**30) / 2.0**30  # the same on every processor
            values = self.mean + self.sd * score
        return np.asarray(np.clip(values, self.low, self.high))

    def __str__(self) -> str:
        """Return it as `parse` reads it."""
        if self.mean is not None:
            return f"{self.mean!r}+-{self.sd!r}"
        ends = f"{'log:' * self.logarithmic}{self.low!r}:{self.high!r}"
        return f"{self.low!r}" if self.fixed else ends

    def __repr__(self) -> str:
        """Return one line."""
        return f"<Spread {self}>"


def parts_of(text: str) -> tuple[tuple[float, ...], str] | None:
    """Return the numbers of a text, one or two, and the sign between them; None where it has none.

    The sign is ":", "log:" or "+-", and empty of a single number.
    """
    match = _FORMS.fullmatch(text.strip()) if len(text) <= _LONGEST else None
    if match is None:
        return None
    scale, first, sign, second = match.groups()
    if sign is None:
        return None if scale else ((float(first),), "")
    if scale and sign != ":":
        return None
    return (float(first), float(second)), scale or (":" if sign == ":" else "+-")


def spread_of(name: str, value: "PriorRange | float | str") -> PriorRange:
    """Return what a caller means by a spread, a number or a text.

    Raises
    ------
    InputError
        If it is none of them.
    """
    given: object = value
    if isinstance(given, PriorRange):
        return given
    if isinstance(given, str):
        return PriorRange.parse(given, name=name)
    return PriorRange.exactly(finite(name, given, hint="give a number, or a text as '0.3:0.5'"))
