"""Words of the pages of reports: verdicts, ranges, Greek letters, safe texts."""

import dataclasses
import re
from collections.abc import Mapping
from typing import Any, Final

from markupsafe import Markup

from rocksteady.results.numbers import number
from rocksteady.results.rendering import printable
from rocksteady.risk.counted.verdict import VERDICTS, Verdict
from rocksteady.risk.fragility.damage_states import OVERTURNED, UPLIFT

LOOKS: Final[dict[Verdict, str]] = {
    "green": "green", "red": "red", "not-shown": "open", "no-answer": "open",
}  # fmt: skip
"""Looks of verdicts; the others have ink alone."""
BADGES: Final = {
    verdict: (verdict.replace("-", " "), LOOKS.get(verdict, "plain")) for verdict in VERDICTS
}
"""Word and look of each verdict: the word says it, colour and outline repeat it."""
LONGEST: Final = 70
"""Letters of a name at the foot of a printed page."""
NOTHING: Final = "—"


def span(low: float, high: float, factor: float = 1.0) -> str:
    """Return a range in words, of equal ends their number.

    Examples
    --------
    >>> span(0.45, 0.6), span(0.1, 0.2, 100.0), span(0.3, 0.3)
    ('0.45 to 0.6', '10 to 20', '0.3')
    """
    first, last = number(factor * low), number(factor * high)
    return first if first == last else f"{first} to {last}"


def greek(text: str) -> str:
    """Return a text with the Greek letters that it names.

    Examples
    --------
    >>> greek("p PGV/(g tan alpha)"), greek("theta/alpha > 0.5"), greek("Sa_avg(2 pi/p), sqrt e")
    ('p PGV/(g tan α)', 'θ/α > 0.5', 'average Sa(2 π/p), √e')
    """
    for name, letter in (("alpha", "α"), ("theta", "θ"), ("beta", "β"), ("pi", "π")):
        text = re.sub(rf"\b{name}(?=\d|\b)", letter, text)
    text = re.sub(r"\bsqrt e\b", "√e", text).replace("beta_U", "β_U")
    return text.replace("Sa_avg", "average Sa")


def minus(text: str) -> str:
    """Return a text with minus signs before its negative numbers, and hyphens as they are.

    Examples
    --------
    >>> minus("width -5 %, from -.5 to 3-4")
    'width −5 %, from −.5 to 3-4'
    """
    return re.sub(r"(?<![\w.,)\]-])-(?=\.?\d)", "−", text)


def state_words(name: str) -> str:
    """Return what a block does in a damage state, as pictures and tables show it.

    Examples
    --------
    >>> state_words("uplift"), state_words("theta/alpha > 0.5"), state_words("overturned")
    ('lifts', 'tilt > 0.5 α', 'falls')
    """
    tilt = name.removeprefix("theta/alpha > ")
    if tilt != name:
        return f"tilt > {tilt} α"
    return {UPLIFT: "lifts", OVERTURNED: "falls"}.get(name, greek(name))


def sentence(text: str) -> str:
    """Return a text with a capital letter, which Greek symbols have not, and a full stop.

    Examples
    --------
    >>> sentence("one test"), sentence("α is identified.")
    ('One test.', 'α is identified.')
    """
    whole = text[:1].upper() + text[1:] if text[:1].isascii() else text
    return whole if whole.endswith((".", "!", "?")) else f"{whole}."


def plain_name(name: str) -> str:
    r"""Return a name for a string of a style sheet: short, without marks that could end it.

    Examples
    --------
    >>> plain_name('vase "7"\\'), plain_name("<b>"), plain_name("壺 3")
    ('vase 7', 'b', '壺 3')
    """
    kept = re.sub(r"[^\w .,()+/-]+", " ", name)
    return " ".join(kept.split())[:LONGEST].strip() or "object"


def cleaned(value: Any) -> Any:
    r"""Return values with all unprintable characters of their texts escaped.

    Examples
    --------
    >>> cleaned({"name": ["a\u202eb"], "count": 3})
    {'name': ['a\\u202eb'], 'count': 3}
    """
    if isinstance(value, str):
        words = printable(value, keep="\n\N{NO-BREAK SPACE}")
        return Markup(words) if isinstance(value, Markup) else words
    if isinstance(value, Mapping):
        return {key: cleaned(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [cleaned(each) for each in value]
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return cleaned({each.name: getattr(value, each.name) for each in dataclasses.fields(value)})
    return value
