"""Page of a table of objects, sorted without a script."""

from collections.abc import Mapping, Sequence
from typing import Any

from rocksteady.results.numbers import chance, number, plural, share_of
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.ensemble.qualification import FORCES
from rocksteady.show.assessment._assessment_tables import ends, share_cell
from rocksteady.show.export.provenance import provenance
from rocksteady.show.plots.risk.plan import floors_of, plot_plan
from rocksteady.show.report import picture, prose, render
from rocksteady.show.style.markup import Row, badge, figure, named, quiet
from rocksteady.show.style.wording import BADGES, NOTHING, cleaned, greek
from rocksteady.words.ensembles import OF_ROCKING

FLOOR = 0.8
"""Height of a floor in the plan [inches]."""
ORDERS = (
    ("verdict", "verdict", False),
    ("share", "share that falls", True),
    ("uplift_pga_g", "acceleration that lifts it", False),
    ("name", "name", False),
)
"""Column, words, and whether the largest comes first, of each order."""


def objects_html(table: ObjectsTable, manifest: Mapping[str, Any]) -> str:
    """Return the page of a table of objects as the text of one HTML file.

    A row stands for objects that are alike, the worst first.  Each has its place in every other
    order, which a style sheet applies: nothing runs, and what is printed is what is seen.

    Parameters
    ----------
    table
        From `rocksteady.assess_objects`.
    manifest
        From `rocksteady.export.make_manifest`.
    """
    kinds = table.kinds
    rows = [row for row, _ in kinds]
    places = {"verdict": [*range(len(rows))]}
    places |= {key: _places(rows, key, descending) for key, _, descending in ORDERS[1:]}
    description = table.describe()
    values: dict[str, Any] = {
        "alike": len(kinds) < len(table.rows),
        "answer": greek(description.sentence),
        "caveats": [greek(each) for each in description.notes],
        "counts": [
            {"badge": badge(*BADGES[each]), "count": f"{count:,}"}
            for each, count in table.verdicts.items()
        ],
        "forces": any(row["base_force_down_kn"] is not None for row in rows),
        "kinds": [
            _shown(row, count)
            | {"places": ";".join(f"--{key}:{places[key][at]}" for key in places)}
            for at, (row, count) in enumerate(kinds)
        ],
        "objects": plural(len(table.rows), "object"),
        "all": _all_rows(table),
        "notes": [
            f"The friction, which is not given for every object, {text}."
            for label, text in description.screen
            if label == "friction" and text
        ],
        "orders": [{"key": key, "words": words} for key, words, _ in ORDERS],
        "provenance": provenance(manifest),
        "records": f"{table.records:,}" + " built-in" * table.suite.built_in,
        "share": OF_ROCKING,
        "target": table.target.words,
    }
    return render(__package__, "objects.html.j2", **cleaned(values), plan=_plan(table))


def _shown(row: Mapping[str, Any], count: int) -> dict[str, Any]:
    """Return the cells of objects that are alike."""
    force = [row[key] for key in FORCES]
    return {
        "name": row["name"],
        "more": f"and {count - 1:,} alike" if count > 1 else "",
        "badge": badge(*BADGES[row["verdict"]]),
        "share": _share(row),
        "band": _band(row),
        "beyond": NOTHING if row["share_1_1"] is None else prose(share_of(row["share_1_1"])),
        "uplift": number(row["uplift_pga_g"]),
        "clearance": NOTHING
        if row["clearance_m"] is None
        else f"{1000.0 * row['clearance_m']:.0f}",
        "force": NOTHING if force[1] is None else " / ".join(map(number, force)),
        "friction": number(row["friction_needed"]),
        "sentence": greek(row["sentence"] + _beside(row)),
    }


def _beside(row: Mapping[str, Any]) -> str:
    """Return the rate and the least change after a sentence; empty without."""
    words = ""
    if row["probability_50_years"] is not None and "years" not in row["sentence"]:
        words = f" In 50 years: {chance(row['probability_50_years'])}."
    return words + (f" Least change: {row['least_change']}." if row["least_change"] else "")


def _share(row: Mapping[str, Any]) -> str:
    """Return the share that falls; a dash where there is none, or statics decides."""
    if row["share"] is None or row["by"] == "statics":
        return NOTHING
    return share_cell(row["share"], row["fall"], row["runs"])


def _band(row: Mapping[str, Any]) -> str:
    """Return its interval."""
    if row["low"] is None or row["by"] == "statics":
        return ""
    return prose(ends((row["low"], row["high"])))


def _all_rows(table: ObjectsTable) -> list[Row]:
    """Return a row for each object, the worst first; none where no two are alike."""
    if len(table.kinds) == len(table.rows):
        return []
    several = table.demand is None
    rows = []
    for row in table.worst:
        cells: Row = {"object": named(row["name"], "quarter", quiet(_where(row) or None))}
        if several:
            peaks = ((row["pga_g"], "g"), (row["pgv_m_s"], "m/s"))
            words = ", ".join(f"{number(peak)} {unit}" for peak, unit in peaks if peak is not None)
            cells["demand"] = figure(words)
        cells |= {
            "verdict": badge(*BADGES[row["verdict"]]),
            "falls": figure(_share(row)),
            "90 %": figure(_band(row)),
            "at 1.1 x": figure(NOTHING if row["share_1_1"] is None else share_of(row["share_1_1"])),
            "lifts at [g]": figure(number(row["uplift_pga_g"])),
        }
        rows.append(cells)
    return rows


def _where(row: Mapping[str, Any]) -> str:
    """Return building and floor of an object; empty where none is given."""
    floor = "" if row["floor"] is None else str(row["floor"])
    if floor.isdigit():
        floor = f"floor {floor}" if row["storey"] else "ground"
    return ", ".join(part for part in (row["building"] or "", floor) if part)


def _plan(table: ObjectsTable) -> dict[str, str] | None:
    """Return the picture of the floors, and its words; None where all stand on the ground."""
    if not any(row["storey"] for row in table.rows):
        return None
    floors = floors_of(table)
    names = "; ".join(f"{name}: {', '.join(row['name'] for row in rows)}" for name, rows in floors)
    return picture(
        lambda axes: plot_plan(table, axes),
        1.1 + FLOOR * len(floors),
        cleaned(f"Objects on each floor, the worst first: {names}."),
        rows=True,
    )


def _places(rows: Sequence[Mapping[str, Any]], key: str, descending: bool) -> list[int]:
    """Return the place of each row in an order; rows without a value come last."""

    def rank(place: int) -> tuple[bool, Any]:
        value = rows[place][key]
        if value is None:
            return True, 0.0
        return False, value.casefold() if isinstance(value, str) else (
            -value if descending else value
        )

    order = sorted(range(len(rows)), key=rank)
    places = [0] * len(rows)
    for place, row in enumerate(order):
        places[row] = place
    return places
