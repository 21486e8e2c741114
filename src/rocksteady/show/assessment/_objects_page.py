"""Page of a table of objects, sorted without a script."""

from collections.abc import Mapping, Sequence
from typing import Any

from rocksteady.model.checks.confidence import CONFIDENCE
from rocksteady.results.numbers import chance, interval, number, plural
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.ensemble.qualification import FORCES, OF_ROCKING
from rocksteady.show.export.provenance import provenance
from rocksteady.show.plots.risk.plan import floors_of, plot_plan
from rocksteady.show.report import picture, render
from rocksteady.show.style.markup import badge
from rocksteady.show.style.wording import BADGES, NOTHING, cleaned, greek

FLOOR = 0.8
"""Height of a floor in the plan [inches]."""
ORDERS = (
    ("probability", "probability of falling", True),
    ("uplift_pga_g", "acceleration that lifts it", False),
    ("name", "name", False),
)
"""Column, words, and whether the largest comes first, of each order."""


def objects_html(table: ObjectsTable, manifest: Mapping[str, Any]) -> str:
    """Return the page of a table of objects as the text of one HTML file.

    Rows stand in the order of the probability. Each has its place in every other order, which a
    style sheet applies: nothing runs, and what is printed is what is seen.

    Parameters
    ----------
    table
        From `rocksteady.assess_objects`.
    manifest
        From `rocksteady.export.make_manifest`.
    """
    rows = table.sorted_by("probability")
    places = {key: _places(rows, key, descending) for key, _, descending in ORDERS}
    description = table.describe()
    facts = {fact.key: fact for fact in description.facts}
    shown = [
        {
            "name": row["name"],
            "badge": badge(*BADGES[row["colour"]]),
            "probability": chance(row["probability"], row["tried"] * (row["basis"] == "count")),
            "band": interval((row["band_low"], row["band_high"]), CONFIDENCE).strip(" ()"),
            "uplift": number(row["uplift_pga_g"]),
            "clearance": NOTHING
            if row["clearance_m"] is None
            else f"{1000.0 * row['clearance_m']:.0f}",
            "force": NOTHING
            if row["base_force_down_kn"] is None
            else " / ".join(number(row[key]) for key in FORCES),
            "friction": NOTHING
            if row["friction_needed"] is None
            else number(row["friction_needed"]),
            "sentence": greek(row["sentence"]),
            "places": ";".join(f"--{key}:{places[key][place]}" for key in places),
        }
        for place, row in enumerate(rows)
    ]
    colours: dict[str, int] = facts["colours"].value
    answer = description.answer
    assert answer is not None
    values: dict[str, Any] = {
        "above": answer.sentence,
        "caveats": [greek(sentence) for sentence in CAVEATS],
        "counts": [
            {"badge": badge(*BADGES[each]), "colour": each, "count": f"{count:,}"}
            for each, count in colours.items()
            if count
        ],
        "demand": facts["demand"].words,
        "forces": any(row["base_force_down_kn"] is not None for row in rows),
        "objects": plural(len(rows), "object"),
        "notes": [greek(note) for note in description.notes if note not in CAVEATS],
        "orders": [{"key": key, "words": words} for key, words, _ in ORDERS],
        "provenance": provenance(manifest),
        "records": f"{table.records:,}",
        "rows": shown,
        "share": OF_ROCKING,
        "target": chance(table.target_probability),
    }
    return render(__package__, "objects.html.j2", **cleaned(values), plan=_plan(table))


def _plan(table: ObjectsTable) -> dict[str, str] | None:
    """Return the picture of the floors, and its words; None where all stand on the ground."""
    if not any(row["storey"] for row in table.rows):
        return None
    floors = floors_of(table)
    named = "; ".join(f"{name}: {', '.join(row['name'] for row in rows)}" for name, rows in floors)
    return picture(
        lambda axes: plot_plan(table, axes),
        1.1 + FLOOR * len(floors),
        cleaned(f"Objects on each floor, the worst first: {named}."),
        rows=True,
    )


def _places(rows: Sequence[dict[str, Any]], key: str, descending: bool) -> list[int]:
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
