"""Commands as a shell reads them: each word in quotes where it needs them."""

import shlex
from collections.abc import Iterable

from rocksteady.results.rendering import printable


def quoted(word: object) -> str:
    r"""Return a word of a command in quotes where it needs them, all of it printable.

    A control, or a byte that is no UTF-8, is written by its octal codes as ``$'...'`` has them.

    Parameters
    ----------
    word
        Or what has one, as a path.

    Examples
    --------
    >>> print(quoted("a.csv"), quoted("a b.csv"), quoted("it's\n.csv"))
    a.csv 'a b.csv' $'it\'s\012.csv'
    """
    text = str(word)
    if printable(text) == text:
        return shlex.quote(text)
    return "$'" + "".join(map(_escaped, text)) + "'"


def command_of(words: Iterable[str]) -> str:
    """Return words as one command.

    Examples
    --------
    >>> command_of(["rocksteady", "record", "a b.csv"])
    "rocksteady record 'a b.csv'"
    """
    return " ".join(map(quoted, words))


def _escaped(letter: str) -> str:
    """Return a character as it stands within ``$'...'``."""
    if letter in "\\'":
        return f"\\{letter}"
    if printable(letter) == letter:
        return letter
    stray = "\udc80" <= letter <= "\udcff"  # a byte of a name of the system
    codes = letter.encode("utf-8", "surrogateescape" if stray else "surrogatepass")
    return "".join(f"\\{code:03o}" for code in codes)
