"""Numbers as engineers write them: three significant digits, a unit, no exponent where it fits."""

import math
from typing import Final

CONFIDENCE: Final = 0.9
"""Default confidence of every interval."""
DIGITS = 3
"""Default number of significant digits of a number in a text."""
LEAST_PERCENT, LEAST_WHOLE_PERCENT, MOST_PERCENT = 0.1, 9.95, 99.5
"""Per cents below which a share has no figures and one decimal, and from which it has none."""
LARGEST_WHOLE = 1e6
"""Numbers below it are written without an exponent."""


def number(value: float, digits: int = DIGITS) -> str:
    """Return a number with some significant digits, without an exponent from 1e-4 to 1e6.

    Examples
    --------
    >>> number(0.8224892168), number(1800.0), number(12345.6), number(2.5e-7), number(-0.0)
    ('0.822', '1800', '12346', '2.5e-07', '0')
    """
    if not math.isfinite(value):
        return "—" if math.isnan(value) else ("infinite" if value > 0.0 else "-infinite")
    size = abs(value)
    if size == 0.0:
        return "0"
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e+" in text and size < LARGEST_WHOLE else text


def number_or_none(value: float | None) -> float | None:
    """Return a number; None of what JSON has no number for.

    Examples
    --------
    >>> number_or_none(0.25), number_or_none(math.nan), number_or_none(math.inf)
    (0.25, None, None)
    """
    return None if value is None or not math.isfinite(value) else float(value)


def quantity(value: float, unit: str, digits: int = DIGITS) -> str:
    """Return a number with its unit.

    Examples
    --------
    >>> quantity(0.82249, "alpha"), quantity(18.4349, "°")
    ('0.822 alpha', '18.4°')
    """
    space = "" if unit == "°" else " "
    return f"{number(value, digits)}{space}{unit}"


def angle(rad: float) -> str:
    """Return an angle [rad] in degrees.

    Examples
    --------
    >>> angle(0.3217505544)
    '18.4°'
    """
    return quantity(math.degrees(rad), "°")


def force_words(parts: tuple[float, float], unit: str) -> str:
    """Return a horizontal and a vertical force in words.

    Examples
    --------
    >>> force_words((1.25, 9.81), "kN")
    '1.25 kN across and 9.81 kN down'
    """
    across, down = (quantity(part, unit).rstrip() for part in parts)
    return f"{across} across and {down} down"


def length(metres: float) -> str:
    """Return a length [m] in millimetres below a metre, in metres from there on.

    Examples
    --------
    >>> length(0.0124), length(1.8)
    ('12.4 mm', '1.8 m')
    """
    return quantity(metres, "m") if abs(metres) >= 1.0 else quantity(1e3 * metres, "mm")


def share(part: int, whole: int) -> str:
    """Return a part of a whole in per cent.

    Examples
    --------
    >>> share(3, 8), share(0, 0)
    ('37.5 %', '—')
    """
    return f"{number(100.0 * part / whole)} %" if whole else "—"


def chance(probability: float | None, of: int = 0) -> str:
    """Return a probability, or a share, in per cent: whole, with one decimal below 10 %.

    The only rule for per cents of probabilities and counts, on screens and on pages.

    Parameters
    ----------
    probability
        In [0, 1]; 0 % is only what nothing can cause, and 100 % nothing; None for one not known.
    of
        Number of things that it was counted in: none and all of them are counts.

    Examples
    --------
    >>> chance(0.3992), chance(0.0623), chance(4e-4), chance(0.9996), chance(0.0, 168)
    ('40 %', '6.2 %', '< 0.1 %', '> 99 %', '0 of 168')
    """
    if probability is None or math.isnan(probability):
        return "—"
    percents = 100.0 * probability
    if of and probability in (0.0, 1.0):
        return f"{round(probability * of):,} of {of:,}"
    if 0.0 < percents < LEAST_PERCENT:
        return f"< {LEAST_PERCENT} %"
    if percents >= MOST_PERCENT:
        return "> 99 %"
    decimals = 1 if 0.0 < percents < LEAST_WHOLE_PERCENT else 0
    return f"{percents:.{decimals}f} %"


def share_of(share: float | None) -> str:
    """Return a counted share in per cent, "none" of none; empty where there is none.

    Examples
    --------
    >>> share_of(0.11), share_of(0.0), share_of(None)
    ('11 %', 'none', '')
    """
    if share is None:
        return ""
    return chance(share) if share else "none"


def interval(band: tuple[float | None, float | None] | None, confidence: float) -> str:
    """Return an interval of a probability after it, its level first; empty without one.

    Examples
    --------
    >>> interval((0.29, 0.428), 0.9), interval((0.0004, 0.07), 0.9), interval((None, None), 0.9)
    (' (90 %: 29 to 43 %)', ' (90 %: < 0.1 to 7.0 %)', '')
    """
    if band is None or None in band:
        return ""
    low, high = (chance(side) for side in band)
    return f" ({100.0 * confidence:g} %: {low.removesuffix(' %')} to {high})"


def counted(part: int, whole: str, verb: str = "fall") -> str:
    """Return a count with its verb, as "1 falls" and "3 fall".

    Examples
    --------
    >>> counted(1, "its 72 runs"), counted(41, "72 runs"), counted(0, "8 runs", "agree")
    ('1 of its 72 runs falls', '41 of 72 runs fall', 'none of 8 runs agree')
    """
    return f"{f'{part:,}' if part else 'none'} of {whole} {verb}{'s' * (part == 1)}"


def plural(count: int, thing: str) -> str:
    """Return a number of things.

    Examples
    --------
    >>> plural(1, "impact"), plural(1200, "impact")
    ('1 impact', '1,200 impacts')
    """
    return f"{count:,} {thing}" if count == 1 else f"{count:,} {thing}s"
