"""Housner's restitution as it is, or a measured factor of it: in Python and as text."""

from typing import Literal

from rocksteady.errors import InputError
from rocksteady.model.checks.validation import positive

Housner = Literal["housner"] | tuple[Literal["housner"], float]
"""Restitution of inelastic impact, or a factor of it, as ("housner", 0.965)."""

VALID = 'it must be a number in (0, 1], "housner", or a factor of it as ("housner", 0.965)'
VALID_TEXT = "it must be a number in (0, 1], 'housner', or a factor of it as 'housner*0.965'"


def housner_factor(value: object) -> float | None:
    """Return the factor of Housner's value that a restitution is; None of numbers.

    Raises
    ------
    InputError
        If it is ("housner", ...) with anything but one positive number.

    Examples
    --------
    >>> housner_factor("housner"), housner_factor(("housner", 0.965)), housner_factor(0.9)
    (1.0, 0.965, None)
    """
    word, *factors = value if isinstance(value, tuple | list) and value else (value,)
    if not isinstance(word, str):
        return None
    valid = len(factors) == 1 and not isinstance(factors[0], str)
    if word != "housner" or not (valid or word is value):
        raise InputError("restitution", value, VALID, 'give ("housner", 0.965) for a factor of it')
    hint = 'give the factor as a number, as ("housner", 0.965)'
    return positive("restitution", factors[0], hint=hint) if factors else 1.0


def noted(restitution: object) -> float | None:
    """Return the factor of Housner's value that a description shows; None of 1."""
    factor = housner_factor(restitution)
    return None if factor == 1.0 else factor


def restitution_of(factor: float, ratio: float) -> float:
    """Return a factor of Housner's value.

    Raises
    ------
    InputError
        If it is above 1.
    """
    if factor * ratio > 1.0:
        raise InputError(
            "restitution",
            form_text(factor),
            f"Housner's value is {ratio:.4g}, which the factor makes {factor * ratio:.4g}, and no "
            "impact keeps more than 1",
            f"give a factor up to {int(1e4 / ratio) / 1e4:g}",
        )
    return factor * ratio


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
    housner_factor(form)
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
    factor = housner_factor(form_of_text(ratio))
    return "Housner's restitution" if factor == 1.0 else f"restitution {factor:.4g} of Housner's"
