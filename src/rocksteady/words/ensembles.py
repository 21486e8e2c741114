"""Words of ensembles: how the runs ended, and a row for each level."""

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

from rocksteady.outcomes import Status
from rocksteady.results.description import Column, Description, Fact, Table, shown
from rocksteady.results.numbers import length, number, plural, quantity
from rocksteady.risk.ensemble.qualification import FORCES, OUTPUTS, SHARE, most_of_rocking

if TYPE_CHECKING:
    import xarray


def describe_ensemble(dataset: "xarray.Dataset") -> Description:
    """Describe an ensemble.

    Parameters
    ----------
    dataset
        From `rocksteady.run_ensemble`.

    Returns
    -------
    Description
        How the runs ended, and a row for each level under ``stripes``.
    """
    dataset = dataset.load()
    status, sizes = dataset["status"].values, dataset.sizes
    counts = {each.label: int((status == each).sum()) for each in Status}
    level = dataset["level"]
    unit = "" if level.attrs["units"] == "1" else f" [{level.attrs['units']}]"
    rows = [_row(dataset.isel(level=place)) for place in range(sizes["level"])]
    columns = [
        Column("level", f"{level.attrs['long_name']}{unit}", number),
        Column("runs", "runs"),
        *(
            Column(name, words, lambda part: f"{part:.1%}")
            for name, words in (("uplift", "lift"), ("overturned", "fall"))
        ),
        Column("top_displacement_m", f"top, {SHARE:.0%}", _moved),
        Column("clearance_m", f"gap, {SHARE:.0%}", _moved),
        Column("edge_speed_m_s", f"edge, {SHARE:.0%} [m/s]"),
        *(
            Column(name, f"{word}, {SHARE:.0%} [kN]")
            for name, word in zip(FORCES, ("across", "down"), strict=True)
            if name in dataset
        ),
    ]
    signs = " and ".join(map(str, dataset["direction"].values))
    return Description(
        headline=f"Ensemble: {plural(sizes['block'], 'block')}, "
        f"{plural(sizes['record'], 'record')} at "
        f"{plural(sizes['level'], 'level')} of {level.attrs['long_name']}, "
        f"{plural(sizes['draw'], 'restitution')}, {dataset.attrs['model']}",
        facts=[
            Fact("model", dataset.attrs["model"]),
            Fact("measure", dataset.attrs["measure"]),
            Fact("records", int(sizes["record"])),
            Fact("direction", signs, "records", signs),
            Fact("vertical", list(map(str, dataset["vertical"].values)), "vertical component"),
            Fact("runs", int(dataset.attrs["runs"]), "runs"),
            Fact("cells", int(status.size)),
            Fact(
                "counts",
                counts,
                "cells",
                ", ".join(f"{count:,} {label}" for label, count in counts.items() if count),
            ),
            Fact("scale_max", float(dataset["scale"].max()), "largest factor of a record"),
            Fact("scatter", float(dataset.attrs["scatter"])),
            Fact("seed", int(dataset.attrs["seed"])),
        ],
        tables=[Table("stripes", rows, columns, severity=lambda row: row["overturned"])],
        notes=json.loads(dataset.attrs["warnings"]),
    )


def _moved(top: float | None) -> str:
    """Return how far a top moves, as a cell."""
    return shown(top) if top is None else length(top)


def _row(stripe: "xarray.Dataset") -> dict[str, object]:
    """Return the shares of a level."""
    status = stripe["status"].values
    return {
        "level": float(stripe["level"]),
        "runs": int(status.size),
        "uplift": float((stripe["peak_angle"].values > 0.0).mean()),
        "overturned": float((status == Status.OVERTURNED).mean()),
        **most_of_rocking(stripe),
    }


OF_ROCKING: Final = f"in {100.0 * SHARE:.0f} % of the runs that rock and stand"


def rocking_words(values: Mapping[str, float | None]) -> str:
    """Return values of `most_of_rocking` in words; empty where no run rocks and stands."""
    known = [value for key in OUTPUTS if (value := values[key]) is not None]
    if not known:
        return ""
    top, gap, speed = known
    edge = quantity(speed, "m/s")
    return f"at most {length(top)}, clearance {length(gap)}, its edge at {edge}, {OF_ROCKING}"
