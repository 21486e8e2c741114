"""One figure of the paper as reported: its text, data and drawing function."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, kw_only=True)
class Panel:
    """One figure of the paper, computed again.

    Attributes
    ----------
    id
        As the paper numbers it: "3a".
    title
        What it shows, in one line.
    says
        What the paper shows and says of it, in our words.
    computed
        What came out, with its numbers.
    choices
        What the paper, or its scan, does not say, and what was taken.
    header, rows
        The data: names of the columns with their units, and the rows.
    more_tables
        Further data, by a short name: header and rows of each.
    draw
        Makes the figure.
    """

    id: str
    title: str
    says: str
    computed: str
    choices: tuple[str, ...]
    header: tuple[str, ...]
    rows: Sequence[Sequence[object]]
    draw: Callable[[], "Figure"]
    more_tables: Mapping[str, tuple[Sequence[str], Sequence[Sequence[object]]]] = field(
        default_factory=dict
    )

    @property
    def command(self) -> str:
        """The command that makes this panel alone."""
        return f"rocksteady paper --only {self.id} --out figure-{self.id}"
