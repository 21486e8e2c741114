"""Names that come from outside, such as those of files, as terminals and pictures take them."""

import unicodedata


def printable(text: object, *, keep: str = "") -> str:
    r"""Return a text with its unprintable characters escaped, such as a line end in a name.

    Parameters
    ----------
    text
        Or what has one, as a path.
    keep
        Characters that are left as they are.

    Examples
    --------
    >>> print(printable("two\nlines and \u202eback"))
    two\nlines and \u202eback
    """
    return "".join(
        repr(letter)[1:-1] if _unprintable(letter) and letter not in keep else letter
        for letter in str(text)
    )


def literal(text: str) -> str:
    r"""Return a text that matplotlib draws as it is: printable, and no part of it a formula.

    Examples
    --------
    >>> print(literal("$\frac{$.at2"))
    \$\frac{\$.at2
    """
    return printable(text).replace("$", r"\$")


def legend_label(name: str) -> str:
    """Return a name as a label of a curve; matplotlib leaves out those that begin with "_".

    Examples
    --------
    >>> legend_label("_draft")
    ' _draft'
    """
    return f" {literal(name)}" if name.startswith("_") else literal(name)


def _unprintable(letter: str) -> bool:
    """Return whether a character is a control, a lone surrogate, or the end of a line."""
    category = unicodedata.category(letter)
    return category[0] == "C" or category in ("Zl", "Zp")
