"""Reader of a table of surveyed objects, each with its outcome."""

import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.files.csv_table import Columns, read_csv_table, refuse_doubled
from rocksteady.risk.observations.object_table import NEEDED, OBJECT_COLUMNS, object_prior_of
from rocksteady.risk.observations.read_tests import OUTCOMES

_FACINGS: Final = {
    "yes": True, "true": True, "1": True, "no": False, "false": False, "0": False, "": None,
}  # fmt: skip

_TABLE: Final = Columns(
    known=(*OBJECT_COLUMNS, "outcome", "reversed"),
    needed={
        **NEEDED,
        "outcome": ("each object fell or stood", "add a column outcome with fell or stood"),
    },
    refused={
        name: (
            "the side that an object fell to is not used",
            f"leave {name} out, or call it side_seen to keep it as a remark",
        )
        for name in ("fell_side", "direction_deg")
    },
    things="objects",
    example="name,width_m,height_m,outcome",
)


@checked
def read_survey(path: Path | str) -> Survey:
    r"""Read a survey of fallen and standing objects from a CSV table.

    Parameters
    ----------
    path
        Table in CSV and UTF-8, an object in each line: ``name``, its sizes and what else is known
        of it as for `ObjectPrior` (a number, ``low:high`` or ``mean+-sd``), and ``outcome`` (fell,
        overturned, toppled or 1; stood, standing, survived or 0).  For an asymmetric object
        ``reversed`` (yes or no) is whether it faces the other way; an empty cell is an unknown
        facing.  Other columns are not read.

    Returns
    -------
    Survey
        With the hash of the file.

    Raises
    ------
    InputError, ModelError
        With file, line and column, if a cell is not valid, a column is missing or looks misspelt,
        an outcome is empty, or two objects have one name.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> text = "name,width_m,height_m,base,outcome\nA,0.20:0.22,0.8,1,stood\nB,0.2,1.2,1,fell\n"
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "cemetery.csv")
    ...     _ = file.write_text(text, "utf-8")
    ...     read_survey(file)
    <Survey: 2 objects: 1 fell, 1 stood>
    """
    table = read_csv_table(
        Path(path), _TABLE, name="survey", hint="name a table in CSV with name, sizes and outcome"
    )
    lines: dict[str, str] = {}
    objects, fell, facings = [], [], []
    for place, cells in table.lines():
        refuse_doubled(place, "name", cells["name"], lines, "give each object another name")
        fell.append(_meaning(place, cells, "outcome", OUTCOMES, "write fell or stood"))
        if fell[-1] is None:
            valid, hint = "each object fell or stood", "leave the line out where that is unknown"
            raise InputError(f"{place}, outcome", Words("is empty"), valid, hint)
        facings.append(_meaning(place, cells, "reversed", _FACINGS, "write yes or no"))
        objects.append(object_prior_of(cells, place))
    return Survey(
        objects=objects, fell=fell, reversed=facings, sources={table.source: table.sha256}
    )


def _meaning(
    place: str, cells: Mapping[str, str], column: str, known: Mapping[str, Any], otherwise: str
) -> Any:
    """Return what the word of a cell means, in capitals too."""
    cell = cells.get(column, "")
    word = cell.lower()
    if word in known:
        return known[word]
    words = [each for each in known if each]
    near = difflib.get_close_matches(word, words, n=1)
    hint = f"did you mean {near[0]}?" if near else otherwise
    raise InputError(f"{place}, {column}", cell, f"it must be one of {', '.join(words)}", hint)
