"""One published formula applied to one block: its source, its value and its verdict."""

from dataclasses import dataclass
from typing import Final, Literal, get_args

from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.numbers import quantity
from rocksteady.results.result import Result

Standing = Literal["computed", "approximate", "needs input", "refused"]
"""Whether a row has an answer; "approximate" where the block is outside its formula."""

Kind = Literal["cask", "cabinet", "wall", "statue"]
"""Kinds of objects; a cask stands for any component of a nuclear facility."""
KINDS: Final[dict[str, Kind]] = {kind: kind for kind in get_args(Kind)}
ANY_BLOCK: Final = "any block"

Detail = tuple[str, float, str]
"""Name, value and unit of an intermediate quantity."""
KEYS = (
    "name", "equation", "edition", "status", "value", "unit", "verdict", "passes", "needs",
    "made_for", "source", "remark",
)  # fmt: skip
"""Columns of a row of JSON and CSV."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class Screen(Result):
    """A published formula applied to a block, from `rocksteady.screen_block`.

    Attributes
    ----------
    name
        Name of the row.
    equation, edition, source
        Number or form of the equation, edition of the document, and the full reference.
    status
        "computed"; "approximate" where the block is outside what the row was made for; "needs
        input"; "refused" where friction governs, or where a formula has no answer for the block.
    value, unit
        The threshold or capacity; None where an input is missing or there is no answer.
    verdict
        In a few words.
    passes
        Whether the demand is below a value that bounds falling; None where there is no verdict, as
        of uplift and friction, below a median, and where a row is made for one kind of object and
        that of the block is not stated.
    counts_vertical
        Whether the verdict depends on the vertical peak.
    needs
        What is missing; empty where nothing is.
    made_for
        Objects that the formula is made for, as "masonry walls"; "any block" by default.
    details
        Name, value and unit of each intermediate quantity.
    remark
        What a reader has to know beside; may be empty.
    """

    name: str
    equation: str
    edition: str
    source: str
    status: Standing
    value: float | None
    unit: str
    verdict: str
    passes: bool | None = None
    counts_vertical: bool = False
    needs: str = ""
    made_for: str = ANY_BLOCK
    details: tuple[Detail, ...] = ()
    remark: str = ""

    @property
    def words(self) -> str:
        """The value with its unit."""
        return "—" if self.value is None else quantity(self.value, self.unit).rstrip()

    def values(self) -> dict[str, str | float | bool | None]:
        """Return the row of JSON and CSV."""
        return {key: getattr(self, key) for key in KEYS}
