"""What the study finds: a verdict on each statement of the paper, and a panel for each figure."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Verdict(StrEnum):
    """What the computation says of a statement."""

    REPRODUCED = "reproduced"
    CORRECTED = "corrected"
    NOT_CHECKABLE = "not-checkable"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """The outcome of one check.

    Attributes
    ----------
    holds
        Whether the statement holds as it stands; None where it cannot be checked.
    detail
        What came out, with its numbers; for a statement that does not hold, what holds instead.
    values
        The numbers behind the detail, by name.
    """

    holds: bool | None
    detail: str
    values: Mapping[str, object] = field(default_factory=dict)

    @property
    def verdict(self) -> Verdict:
        """The verdict that follows."""
        if self.holds is None:
            return Verdict.NOT_CHECKABLE
        return Verdict.REPRODUCED if self.holds else Verdict.CORRECTED


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A statement of the paper with what the computation says of it.

    Attributes
    ----------
    id
        Short and lasting; E1 to E9 are those of the package's reference results.
    statement
        What the paper says, in our words.
    page
        Where it says so, in the journal's numbering.
    figures
        The panels that show it, as "12b"; they are right or wrong with it.
    see
        Further panels on which it bears.
    finding
        The outcome.
    """

    id: str
    statement: str
    page: int
    figures: tuple[str, ...]
    see: tuple[str, ...] = ()
    finding: Finding

    @property
    def verdict(self) -> Verdict:
        """Reproduced, corrected or not checkable."""
        return self.finding.verdict


def corrected(claims: Sequence[Claim]) -> list[Claim]:
    """Return the corrected statements: those numbered E1 to E9 first, the others in their order."""
    found = [claim for claim in claims if claim.verdict is Verdict.CORRECTED]
    numbered = [claim for claim in found if re.fullmatch(r"E\d", claim.id)]
    return [*sorted(numbered, key=lambda claim: claim.id), *(c for c in found if c not in numbered)]


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
