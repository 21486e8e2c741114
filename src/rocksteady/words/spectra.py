"""Words of rocking spectra, and of runs of many blocks."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, TypedDict, cast

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.blocks.housner_forms import ratio_words
from rocksteady.outcomes import Status
from rocksteady.results.description import Column, Description, Fact, Table, left_out, line
from rocksteady.results.numbers import angle, length, number, plural, quantity
from rocksteady.seismic.spectra.suite import QUANTILES, compute_suite_spectrum
from rocksteady.sweep.cases.labelled import as_dataset

if TYPE_CHECKING:
    import xarray

    from rocksteady.sweep.cases.cells import Labelled


FALLS = "falls"
Over = Literal["scale", "period_s"]
"""What fates are listed over."""


SHOWN = 4
"""Rows of an answer."""


MOST_COLUMNS, MOST_SUITE_COLUMNS = 5, 3
"""Columns of slendernesses in a text, of one record and of several; of more each run is a row."""


WITH_FALLS = "with falls"
"""Kind of a row of a table with a fall."""


MEASURES = {
    "alpha": "alpha_rad",
    "period": "period_s",
    "p": "p_rad_s",
    "width": "width_m",
    "height": "height_m",
    "restitution": "restitution",
}
"""Coordinates of a block, and their keys."""


class Cell(TypedDict, total=False):
    """Values of one run as in JSON, or of one block in all records."""

    record: str
    direction: str
    block: str
    scale: float
    pga_g: float
    alpha_rad: float
    period_s: float
    p_rad_s: float
    width_m: float
    height_m: float
    restitution: float
    status: str
    peak: float
    peak_rad: float
    peak_velocity: float
    peak_velocity_rad_s: float
    impacts: int
    overturned: float
    peaks: list[float]
    peak_velocities: list[float]


def describe_spectrum(dataset: "Labelled") -> Description:
    """Describe rocking spectra, or the runs of many blocks.

    Parameters
    ----------
    dataset
        From `rocksteady.compute_rocking_spectrum` or `rocksteady.simulate_many`.

    Returns
    -------
    Description
        A row for each cell under ``values``; for several records also one for each block under
        ``suite``, with quantiles of the peaks and the share that overturns.
    """
    dataset = dataset.load()
    levels = "level" in dataset.coords
    status = dataset["status"].values
    counts = {each.label: int((status == each).sum()) for each in Status}
    attributes = dataset.attrs
    of_record = "record" in dataset["scale"].dims  # what brings each record to a level of PGA
    scales = None if of_record else np.atleast_1d(dataset["scale"].values).tolist()
    facts = [
        Fact("model", attributes["model"]),
        *(
            Fact(key, attributes[name])
            for key, name in (("restitution", "restitution"), ("gravity_m_s2", "gravity"))
            if name in attributes
        ),
        Fact("scale", scales[0] if scales and len(scales) == 1 else scales),
        Fact("reversed", attributes.get("direction") == "reversed"),
        Fact("vertical", _vertical(dataset)),
        Fact("cells", int(status.size), "runs", f"{status.size:,}"),
        Fact("counts", counts, "of which", _counts(counts)),
    ]
    rows = _rows(dataset)
    suite: list[Cell] = []
    if dataset.sizes.get("record", 1) > 1:
        summary = compute_suite_spectrum(as_dataset(dataset))
        facts.append(Fact("quantiles", list(QUANTILES)))
        suite = _suite_rows(summary)
    shown = suite or rows
    fits = len({row["alpha_rad"] for row in shown}) <= (
        MOST_SUITE_COLUMNS if suite else MOST_COLUMNS
    )
    grid = fits and not levels and dataset.sizes.get("scale", 1) == 1
    tables = [Table("values", rows)]
    if suite:
        tables.append(Table("suite", suite))
    tables.append(_grid(shown, suite=bool(suite)) if grid else _list(shown, suite=bool(suite)))
    sentence, screen = ("", []) if of_record or not shown else _answer(dataset, shown, counts)
    return Description(
        headline=_headline(dataset), facts=[*screen, *facts], tables=tables, sentence=sentence
    )


def _answer(
    dataset: "Labelled", rows: Sequence[Cell], counts: dict[str, int]
) -> tuple[str, list[Fact]]:
    """Return which blocks fall: of each slenderness up to which size, else at which scales."""
    over_scale = max(dataset.sizes.get(name, 1) for name in ("scale", "level")) > 1
    sizes = not over_scale and "width_m" not in rows[0]
    groups: dict[str, list[Cell]] = {}
    for row in rows:
        name = angle(row["alpha_rad"]) if sizes else _size(row)
        groups.setdefault(name, []).append({"period_s": 2.0 * math.pi / row["p_rad_s"], **row})
    names = np.atleast_1d(dataset["record"].values).tolist()
    where = shortened(names[0]) if len(names) == 1 else plural(len(names), "record")
    order = sorted(groups, key=lambda name: -sum(map(_falls, groups[name])))
    key: Over = "scale" if over_scale else "period_s"
    undecided = counts[Status.UNDECIDED.label]
    lost = counts[Status.LOST_CONTACT.label]
    rest = order[SHOWN:]
    falling = sum(any(map(_falls, groups[name])) for name in rest)
    counted = {"falling": falling, "standing": len(rest) - falling}
    kinds = ", ".join(f"{count} {kind}" for kind, count in counted.items() if count)
    shown = [line(name, _course(groups[name], key, len(names))) for name in order[:SHOWN]]
    facts = [
        *shown,
        left_out(len(rest), kinds),
        line("undecided", f"{undecided:,} runs" if undecided else ""),
        line("lost contact", f"{lost:,} runs leave the base" if lost else ""),
        line(
            "runs", ", ".join(f"{each.plain} {n:,}" for each in Status if (n := counts[each.label]))
        ),
        line("computed", _headline(dataset).partition(": ")[2]),
    ]
    falls = [row for row in groups[order[0]] if _falls(row)]
    least = f"No block falls in {where}."
    if falls:
        worst = max(falls, key=lambda row: (_falls(row), row[key] * (-1 if over_scale else 1)))
        words = f"A block of {_size(worst)} falls in {where}"
        if over_scale:
            words += f" from {number(worst['scale'])} x on"
        elif sizes and len(names) == 1:
            words = f"Blocks of {angle(worst['alpha_rad'])} fall in {where} up to "
            radius = 0.75 * dataset.attrs["gravity"] / worst["p_rad_s"] ** 2
            width, height = (2.0 * radius * f(worst["alpha_rad"]) for f in (math.sin, math.cos))
            size = f"{number(width)} x {number(height)} m"
            words += f"2 pi/p = {quantity(worst['period_s'], 's')} ({size})"
        least = f"{words}."
        if len(names) > 1:
            least = least.replace(where, f"{round(_falls(worst) * len(names))} of {where}")
    return least, facts


def _size(row: Cell) -> str:
    """Return the size of a block: width and height, or slenderness and 2 pi/p."""
    if "width_m" in row:
        return f"{number(row['width_m'])} x {number(row['height_m'])} m"
    return f"{angle(row['alpha_rad'])} and 2 pi/p = {quantity(row['period_s'], 's')}"


def _course(rows: Sequence[Cell], key: Over, of: int) -> str:
    """Return the fates of blocks over their size, or of one block over the scale.

    Parameters
    ----------
    rows
        One for each size or scale.
    key
        What they are over.
    of
        Number of records.
    """
    sign, unit = (1.0, "x") if key == "scale" else (-1.0, "s")
    first = sorted(rows, key=lambda row: sign * row[key])
    falls = [row for row in first if _falls(row)]
    peaks = [row["peaks"][1] if "peaks" in row else row["peak"] for row in first if not _falls(row)]
    tilt = max((peak for peak in peaks if math.isfinite(peak)), default=None)
    words = f"; tilts to {quantity(tilt, 'alpha')}" if tilt else ""
    if not falls:
        return f"stands{words}"
    if len(first) == 1:
        share = _falls(falls[0])
        return FALLS if "peak" in falls[0] else f"falls in {round(share * of)} of {of} records"
    beyond = first[first.index(falls[0]) :]
    stand = sum(not _falls(row) for row in beyond)
    end = "from {} on" if sign > 0.0 else "up to {}"
    but = f", stands at {stand} of {len(beyond)}" if stand else ""
    if "peaks" in falls[0]:
        most = max(map(_falls, falls))
        but = f", in at most {round(most * of)} of {of} records"
    return "falls " + end.format(quantity(falls[0][key], unit)) + but + words


def _headline(dataset: "Labelled") -> str:
    """Return what shakes which blocks, in a line."""
    names = np.atleast_1d(dataset["record"].values).tolist()
    parts = [shortened(names[0]) if len(names) == 1 else plural(len(names), "record")]
    if _vertical(dataset) is not None:
        parts[0] += " and vertical"
    scale = np.unique(dataset["scale"].values)
    if "level" in dataset.sizes:
        parts.append(plural(dataset.sizes["level"], "level"))
    elif len(scale) > 1:
        parts.append(f"scales {number(scale[0])} to {number(scale[-1])}")
    elif scale[0] != 1.0:
        parts.append(f"scaled by {scale[0]:.4g}")
    direction = dataset.attrs.get("direction", "as recorded")
    if direction != "as recorded":
        parts.append("both directions" if direction == "both" else direction)
    ratio = dataset.attrs.get("restitution")
    if ratio is not None:
        parts.append(ratio_words(ratio))
    if "one_sided" in dataset.attrs or "one_sided" in dataset.coords:
        parts.append("against a wall")
    if "level" in dataset.coords:
        parts.insert(0, plural(dataset.sizes.get("block", 1), "block"))
    parts.append(str(dataset.attrs["model"]))
    return ("Runs: " if "level" in dataset.coords else "Rocking spectrum: ") + ", ".join(parts)


def _vertical(dataset: "Labelled") -> str | None:
    """Return the names of the vertical records; None where there are none."""
    vertical = str(dataset.attrs["vertical"])
    return None if vertical == "none" else vertical


def shortened(name: str, most: int = 40) -> str:
    """Return a name of a few words, its middle left out where it is long."""
    return name if len(name) <= most else f"{name[: most // 2]}…{name[-most // 2 + 1 :]}"


def _counts(counts: dict[str, int]) -> str:
    """Return how the runs ended, the ends that occur."""
    return ", ".join(f"{count:,} {label}" for label, count in counts.items() if count)


def _over(dataset: "Labelled") -> list[str]:
    """Return the dimensions of the cells."""
    return [str(name) for name in dataset["status" if "status" in dataset else "overturned"].dims]


def _cells(dataset: "Labelled") -> list[Cell]:
    """Return the coordinates of each cell, in C order."""
    over = _over(dataset)
    names = ["record", "direction", "block", "scale", "pga_g", *MEASURES]
    several = {name: dataset.coords[name] for name in names if name in dataset.coords}
    shape = tuple(dataset.sizes[name] for name in over)
    columns: dict[str, list[object]] = {}
    for name, values in several.items():
        if name in ("direction", "block") and name not in over:
            continue
        along = [dim for dim in over if dim in values.dims]
        ordered = values.transpose(*along).values
        full = ordered[tuple(slice(None) if dim in along else np.newaxis for dim in over)]
        columns[MEASURES.get(name, name)] = np.broadcast_to(full, shape).ravel().tolist()
    rows = [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
    return cast("list[Cell]", rows)


def _values(dataset: "Labelled", name: str) -> Floats:
    """Return a variable of each cell, in the order of `_cells`."""
    over = _over(dataset)
    values: Floats = dataset[name].transpose(*over, ...).values
    return values.reshape(-1, *values.shape[len(over) :])


def _rows(dataset: "Labelled") -> list[Cell]:
    """Return a row for each run."""
    rows = _cells(dataset)
    single = "scale" not in dataset["status"].dims and "level" not in dataset.coords
    names = ("status", "peak_angle", "peak_velocity", "impacts")
    values = zip(*(_values(dataset, name).tolist() for name in names), strict=True)
    for row, (status, peak, velocity, impacts) in zip(rows, values, strict=True):
        alpha, p = row["alpha_rad"], row["p_rad_s"]
        row["status"] = Status(status).label
        row["peak"] = peak
        row["peak_rad"] = peak * alpha
        row["peak_velocity"] = velocity
        row["peak_velocity_rad_s"] = velocity * alpha * p
        row["impacts"] = impacts
        row.setdefault("period_s", 2.0 * math.pi / p)
        if single:
            del row["scale"]
        if "negative_alpha" in dataset.coords:  # each side counts in its own alpha
            del row["peak_rad"]
    return rows


def _suite_rows(summary: "xarray.Dataset") -> list[Cell]:
    """Return a row for each block and level, with a peak for each quantile."""
    last = summary.transpose(..., "quantile")
    rows = _cells(last)
    single = "scale" not in last["overturned"].dims and "level" not in summary.coords
    names = ("overturned", "peak_angle", "peak_velocity")
    values = zip(*(_values(last, name).tolist() for name in names), strict=True)
    for row, (overturned, peaks, velocities) in zip(rows, values, strict=True):
        row.pop("record", None)
        row["overturned"] = overturned
        row["peaks"] = peaks
        row["peak_velocities"] = velocities
        if single:
            row.pop("scale", None)
    return rows


def _text(row: Cell | None, *, suite: bool) -> str:
    """Return what becomes of a block: its peak over alpha, or its fall."""
    if row is None:
        return ""
    if suite:
        median = row["peaks"][1]
        peak = FALLS if math.isinf(median) else number(median)
        return f"{peak}, {number(100.0 * row['overturned'])} %"
    if row["status"] == Status.OVERTURNED.label:
        return FALLS
    if row["status"] in (Status.AT_REST.label, Status.ROCKING.label):
        return number(row["peak"])
    return str(row["status"])


def _severity(cells: Sequence[Cell]) -> tuple[float, float]:
    """Return how many falls there are in cells of a table, then their largest peak."""
    tops = [cell["peaks"][1] if "peaks" in cell else cell["peak"] for cell in cells]
    return sum(map(_falls, cells)), max(math.inf if math.isnan(top) else top for top in tops)


def _falls(cell: Cell) -> float:
    """Return the share of the runs of a block that fall: of one run 0 or 1."""
    if "overturned" in cell:
        return float(cell["overturned"])
    return float(cell["status"] == Status.OVERTURNED.label)


def _kind(cells: Sequence[Cell]) -> str:
    """Return whether there is a fall in cells of a table."""
    return WITH_FALLS if any(map(_falls, cells)) else "without falls"


def _title(*, suite: bool) -> str:
    """Return what a table shows."""
    words = "largest |theta|/alpha"
    return f"median of the {words}, and the share of records that overturn" if suite else words


def _grid(rows: Sequence[Cell], *, suite: bool) -> Table:
    """Return a table with a row for each size 2 pi/p and a column for each slenderness."""
    alphas = list(dict.fromkeys(row["alpha_rad"] for row in rows))
    at = {(row["period_s"], row["alpha_rad"]): row for row in rows}
    periods = list(dict.fromkeys(row["period_s"] for row in rows))
    return Table(
        "",
        [
            {"period": period} | {repr(alpha): at[period, alpha] for alpha in alphas}
            for period in periods
        ],
        [
            Column("period", "2 pi/p [s]", lambda period: f"{period:.4g}"),
            *(
                Column(
                    repr(alpha),
                    f"{angle(alpha)} ({alpha:.3g} rad)" if len(alphas) <= 3 else angle(alpha),
                    lambda row: _text(row, suite=suite),
                )
                for alpha in alphas
            ),
        ],
        title=_title(suite=suite),
        severity=lambda row: _severity([row[repr(alpha)] for alpha in alphas]),
        kind=lambda row: _kind([row[repr(alpha)] for alpha in alphas]),
        alarm=WITH_FALLS,
    )


def _list(rows: Sequence[Cell], *, suite: bool) -> Table:
    """Return a table with a row for each block and level."""
    some = rows[0] if rows else Cell()
    columns = [
        Column("record", "record", shortened, left=True),
        Column("direction", "direction", left=True),
        Column("block", "block", left=True),
        Column("width_m", "width", length),
        Column("height_m", "height", length),
        Column("alpha_rad", "alpha", angle),
        Column("period_s", "2 pi/p [s]", number),
        Column("restitution", "restitution", number),
        Column("pga_g", "PGA [g]", number),
        Column("scale", "scale", number),
    ]
    if "block" in some and len({(row["width_m"], row["height_m"]) for row in rows}) == len(
        {row["block"] for row in rows}
    ):  # the sizes are the name
        columns = [c for c in columns if c.key not in ("block", "period_s", "restitution")]
    sizes = {"width_m", "height_m"} & some.keys()
    varied = [
        column
        for column in columns
        if column.key in sizes or len({row.get(column.key) for row in rows}) > 1
    ]
    cells = [{**row, "cell": row} for row in rows]
    last = Column("cell", "peak", lambda row: _text(row, suite=suite))
    return Table(
        "",
        cells,
        [*varied, last],
        title=_title(suite=suite),
        severity=lambda row: _severity([row["cell"]]),
        kind=lambda row: _kind([row["cell"]]),
        alarm=WITH_FALLS,
    )
