"""Restitution as it is given: numbers, Housner's value or a factor of it; in Python and as text."""

from dataclasses import dataclass
from typing import Any, Literal

from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.bounds import RESTITUTION
from rocksteady.model.checks.validation import positive

Housner = Literal["housner"] | tuple[Literal["housner"], float]
"""Restitution of inelastic impact, or a factor of it, as ("housner", 0.965)."""

Restitution = float | Housner
"""A ratio of angular velocities in (0, 1], "housner" for that of inelastic impact, or a measured
factor of it as ("housner", 0.965)."""

Restitutions = Restitution | tuple[float, float]
"""One for both impacts, or a pair: of the impact that ends positive rotation, and of the other."""

VALID = 'it must be a number in (0, 1], "housner", or a factor of it as ("housner", 0.965)'
VALID_TEXT = "it must be a number in (0, 1], 'housner', or a factor of it as 'housner*0.965'"


@dataclass(frozen=True)
class Impacts:
    """What is known of the impacts of a block before the block is: numbers, or a factor.

    Parameters
    ----------
    given
        What the caller gave.
    factor
        Factor of Housner's value that it is; None of numbers, which are not checked yet.
    """

    given: Any
    factor: float | None

    @classmethod
    def of(cls, given: object) -> "Impacts":
        """Take a restitution apart.

        Raises
        ------
        InputError
            If it is ("housner", ...) with anything but one positive number.

        Examples
        --------
        >>> [Impacts.of(each).factor for each in ("housner", ("housner", 0.965), 0.9)]
        [1.0, 0.965, None]
        """
        word, *factors = given if isinstance(given, tuple | list) and given else (given,)
        if not isinstance(word, str):
            return cls(given, None)
        valid = len(factors) == 1 and not isinstance(factors[0], str)
        if word != "housner" or not (valid or word is given):
            hint = 'give ("housner", 0.965) for a factor of it'
            raise InputError("restitution", given, VALID, hint)
        hint = 'give the factor as a number, as ("housner", 0.965)'
        return cls(given, positive("restitution", factors[0], hint=hint) if factors else 1.0)

    @property
    def noted(self) -> float | None:
        """The factor that a description shows; None of 1."""
        return None if self.factor == 1.0 else self.factor

    @property
    def numbers(self) -> tuple[float, float]:
        """The number of either impact: of one number twice that, of a pair each."""
        rule = RESTITUTION
        if not isinstance(self.given, tuple | list):
            return (rule("restitution", self.given),) * 2
        if len(self.given) != 2:
            raise InputError(
                "restitution",
                self.given,
                "there are two impacts: the end of positive and the end of negative rotation",
                "give one number for both, or a pair of them",
            )
        first, second = self.given
        return rule("restitution", first), rule("restitution", second)

    @property
    def pair(self) -> tuple[float, float] | None:
        """A pair of numbers, one for each impact; None where both impacts have one form."""
        unlike = self.factor is None and isinstance(self.given, tuple)
        return self.numbers if unlike else None

    @property
    def of_wall(self) -> Restitution:
        """The one restitution of a block against a wall."""
        if self.factor is None and isinstance(self.given, tuple):
            raise ModelError(
                "restitution",
                self.given,
                "a block against a wall has one restitution",
                "give one number in [0, 1]",
            )
        return self.given  # type: ignore[no-any-return]

    def times(self, ratio: float) -> float:
        """Return the factor of a ratio that is Housner's, 1 at most.

        Raises
        ------
        InputError
            If the factor makes the ratio larger than 1.
        """
        assert self.factor is not None
        if self.factor * ratio > 1.0:
            raise InputError(
                "restitution",
                form_text(self.factor),
                f"Housner's value is {ratio:.4g}, which the factor makes "
                f"{self.factor * ratio:.4g}, and no impact keeps more than 1",
                f"give a factor up to {int(1e4 / ratio) / 1e4:g}",
            )
        return self.factor * ratio


def form_of_text(text: str) -> Housner | None:
    """Return the form of Housner's restitution that a text is; None of any other text.

    Examples
    --------
    >>> form_of_text("housner"), form_of_text("housner*0.965"), form_of_text("0.8")
    ('housner', ('housner', 0.965), None)
    """
    parts = [part.strip() for part in text.split("*")]
    if parts == ["housner"]:
        return "housner"
    if len(parts) != 2 or "housner" not in parts or not text.isascii():
        return None
    try:
        factor = float(parts[1 - parts.index("housner")])
    except ValueError:
        return None
    form: Housner = ("housner", factor)
    Impacts.of(form)
    return form


def form_text(factor: float) -> str:
    """Return the text of a factor of Housner's restitution, as the command line takes it.

    Examples
    --------
    >>> form_text(1.0), form_text(0.965)
    ('housner', 'housner*0.965')
    """
    return "housner" if factor == 1.0 else f"housner*{factor!r}"


def ratio_words(ratio: float | str) -> str:
    """Return a restitution, or the text of a form, as in a title.

    Examples
    --------
    >>> ratio_words("housner*0.965"), ratio_words("housner"), ratio_words(0.9)
    ("restitution 0.965 of Housner's", "Housner's restitution", 'restitution 0.9')
    """
    if not isinstance(ratio, str):
        return f"restitution {ratio:.4g}"
    factor = Impacts.of(form_of_text(ratio)).factor
    return "Housner's restitution" if factor == 1.0 else f"restitution {factor:.4g} of Housner's"
