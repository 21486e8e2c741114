"""Files for loss models: a component of counted shares for each kind of object."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from rocksteady.errors import InputError
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.assess.rates import sliding_words
from rocksteady.risk.counted.suite import Demanded
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
from rocksteady.show.export.components import LossComponent
from rocksteady.show.export.openquake import write_openquake
from rocksteady.show.export.pelicun import write_pelicun

LONGEST = 60
"""Letters of a name in an identifier."""


def write_loss_files(
    answer: Assessment | ObjectsTable, folder: Path, *, lognormal: bool
) -> list[str]:
    """Write a component for each kind of object, and return the names of those left out.

    A kind that has no shares, as one that slides, or of which no run falls has no component.

    Raises
    ------
    InputError
        If a lognormal is asked for, and is more than 10 points from the counts.
    """
    components: list[LossComponent] = []
    left_out = []
    for name, description, fragility, floor in _kinds(answer):
        if fragility is None or not fragility.states[-1].curve.counts[-1].falls:
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


def _kinds(
    answer: Assessment | ObjectsTable,
) -> Iterator[tuple[str, str, Fragility | None, bool]]:
    """Yield name, description, shares, and whether they are over motion of a floor."""
    if isinstance(answer, ObjectsTable):
        for row, count in answer.kinds:
            curve = answer.curves.get(row["like"])
            where = ", ".join(str(row[key]) for key in ("building", "floor") if row[key])
            words = [f"{plural(count, 'object')} alike", where, _beside(curve)]
            words.append(_kept(answer.demands[row["like"]]) * row["stretched"])
            on_floor = row["floor_pga_g"] is not None
            yield (
                row["name"],
                _sentences(row["name"], words, on_floor),
                curve,
                (row["place"] == "floor"),
            )
        return
    described, shaking = answer.described, answer.judged.shaking
    kept = _kept(shaking.demand) * shaking.stretched if shaking is not None else ""
    words = [described.block.describe().headline, _beside(answer.fragility), kept]
    text = _sentences(described.label, words, described.on_floor)
    yield described.name, text, answer.fragility, described.given.demand.place == "floor"


def _sentences(name: str, words: Sequence[str], on_floor: bool) -> str:
    """Return the description of a component."""
    ground = "The measure is that of the ground, below its floor." * on_floor
    return f"{name}. " + " ".join(f"{each.rstrip('.')}." for each in (*words, ground) if each)


def _beside(fragility: Fragility | None) -> str:
    """Return from where on it slides; empty where it does not."""
    if fragility is None or fragility.slides_above is None:
        return ""
    return sliding_words(f"{number(fragility.slides_above)} {fragility.unit}")


def _kept(demand: Demanded) -> str:
    """Return what is kept over the levels of a demand, as a sentence."""
    words = f"{demand.kept[:1].upper()}{demand.kept[1:]} at all levels." * bool(demand.kept)
    if isinstance(demand, DesignSpectrum):
        words += f" It is that of {demand.words_of_source}, of {quantity(demand.peak_g, 'g')}."
    return words


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
