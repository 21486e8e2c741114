"""Finding of a check, and the verdict on the statement."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum


class Verdict(StrEnum):
    """What the computation gives for a statement."""

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
    """A statement of the paper with what the computation gives.

    Attributes
    ----------
    id
        Short and lasting: reports and later versions refer to it.
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
    corrected_claims = [claim for claim in claims if claim.verdict is Verdict.CORRECTED]
    numbered = [claim for claim in corrected_claims if re.fullmatch(r"E\d", claim.id)]
    return [
        *sorted(numbered, key=lambda claim: claim.id),
        *(c for c in corrected_claims if c not in numbered),
    ]
