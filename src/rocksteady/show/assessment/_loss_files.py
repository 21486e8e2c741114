"""Files for loss models: a component of counted shares for each kind of object."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from rocksteady.errors import InputError
from rocksteady.results.numbers import number, plural
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.counted.suite import Peaks
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.show.export.components import LossComponent
from rocksteady.show.export.openquake import write_openquake
from rocksteady.show.export.pelicun import write_pelicun

LONGEST = 60
"""Letters of a name in an identifier."""


def write_loss_files(
    answer: Assessment | ObjectsTable, folder: Path, *, lognormal: bool
) -> list[str]:
    """Write a component for each kind of object, and return the names of those left out.

    A kind of which no run falls has no component.

    Raises
    ------
    InputError
        If a lognormal is asked for, and is more than 10 points from the counts.
    """
    components: list[LossComponent] = []
    left_out = []
    for name, description, fragility, floor in _kinds(answer):
        if not fragility.states[-1].curve.counts[-1].falls:
            left_out.append(name)
            continue
        taken = {each.identifier for each in components}
        try:
            made = LossComponent.from_fragility(
                _identifier(name, taken),
                fragility,
                floor=floor,
                lognormal=lognormal,
                description=description,
            )
        except InputError as error:
            raise InputError(name, error.value, error.valid, error.hint) from error
        components.append(made)
    if components:
        write_pelicun(folder / "fragility.csv", components)
        write_openquake(folder / "fragility.xml", components)
    return left_out


def _kinds(answer: Assessment | ObjectsTable) -> Iterator[tuple[str, str, Fragility, bool]]:
    """Yield name, description, shares, and whether they are over motion of a floor."""
    if isinstance(answer, ObjectsTable):
        for row, count in answer.kinds:
            if row["like"] in answer.curves:
                peaks = Peaks(pga_g=row["pga_g"], pgv_m_s=row["pgv_m_s"])
                words = f"{row['name']}, {plural(count, 'object')} alike. {_kept(peaks)}"
                curve = answer.curves[row["like"]]
                yield row["name"], words.strip(), curve, row["place"] == "floor"
        return
    described, shaking = answer.described, answer.judged.shaking
    if answer.fragility is not None and shaking is not None:
        words = f"{described.describe().headline}. {_kept(shaking.demand) * shaking.stretched}"
        floor = described.given.demand.place == "floor"
        yield described.name, words.strip(), answer.fragility, floor


def _kept(demand: Peaks) -> str:
    """Return what is kept over the levels of a demand with both peaks."""
    if demand.pga_g is None or demand.pgv_m_s is None:
        return ""
    return f"PGV over PGA is {number(demand.pgv_m_s / demand.pga_g)} m/s per g at all levels."


def _identifier(name: str, taken: Sequence[str] | set[str]) -> str:
    """Return an identifier of a component that is not taken yet.

    Examples
    --------
    >>> _identifier("rack 6/7", set()), _identifier("rack 6/7", {"RS.rack_6_7"})
    ('RS.rack_6_7', 'RS.rack_6_7.2')
    """
    plain = re.sub(r"[^A-Za-z0-9_]+", "_", name).strip("_")[:LONGEST] or "object"
    first = f"RS.{plain}"
    if first not in taken:
        return first
    count = 2
    while f"{first}.{count}" in taken:
        count += 1
    return f"{first}.{count}"
