"""Words on the stability of periodic motions."""

from collections.abc import Iterable


def verdict(*, admissible: bool, neutral: bool | None, stable: bool | None) -> str:
    """Return the verdict on a solution in a word."""
    if not admissible:
        return "inadmissible"
    if neutral:
        return "neutral"
    return "stable" if stable else "unstable"


def multipliers_text(multipliers: Iterable[complex]) -> str:
    """Return a pair of multipliers as people write it.

    Examples
    --------
    >>> multipliers_text([0.5 + 0.25j, 0.5 - 0.25j]), multipliers_text([1.2e-7, 0.0])
    ('0.500 ± 0.250i', '1.2e-7, 0')
    """
    first, second = (complex(value) for value in multipliers)
    if first.imag != 0.0:
        return f"{first.real:.3f} ± {abs(first.imag):.3f}i"
    text = f"{first.real:.3g}, {second.real:.3g}"
    for sign in ("-", "+"):  # 1e-06 is 1e-6, and 1e+06 is 1e6
        text = text.replace(f"e{sign}0", f"e{sign}")
    return text.replace("e+", "e")
