"""Classes of the cells of maps, and how many cells each has: the one way in which shares count."""

from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.outcomes import NO_START_LABEL, AttractorKind, Status
from rocksteady.sweep.cases.facts import slabs

if TYPE_CHECKING:
    import xarray

    from rocksteady.sweep.cases.cells import Labelled, Variable

Classes = NDArray[np.int8]

BLANK = -128
"""Kind or fate of a cell that has not been computed, in a map that is not finished."""


class CellClass(IntEnum):
    """What a cell of a map is, in the order of a legend."""

    REST = 0
    SYMMETRIC = 1
    UNSYMMETRIC = 2
    SUBHARMONIC = 3
    APERIODIC = 4
    ROCKING = 5
    OVERTURNED = 6
    UNDECIDED = 7
    NO_START = 8
    NOT_COMPUTED = 9


MEANINGS = {
    AttractorKind.REST.value: CellClass.REST,
    AttractorKind.SYMMETRIC.value: CellClass.SYMMETRIC,
    AttractorKind.UNSYMMETRIC.value: CellClass.UNSYMMETRIC,
    AttractorKind.APERIODIC.value: CellClass.APERIODIC,
    AttractorKind.OVERTURNED.value: CellClass.OVERTURNED,
    AttractorKind.UNDECIDED.value: CellClass.UNDECIDED,
    NO_START_LABEL: CellClass.NO_START,
    Status.ROCKING.label: CellClass.ROCKING,
    Status.AT_REST.label: CellClass.REST,
    Status.OVERTURNED.label: CellClass.OVERTURNED,
}
"""The class of each of a map's ``flag_meanings``; subharmonic motions differ by their period."""


def flags_of_cells(kind: "Variable | xarray.DataArray") -> dict[int, CellClass]:
    """Return the class of each value that the kinds or fates of a map may have.

    Raises
    ------
    InputError
        If it is no variable of a map.
    """
    words = str(kind.attrs.get("flag_meanings", "")).split()
    unknown = [word for word in words if word not in MEANINGS]
    if unknown or not words:
        raise InputError(
            "dataset",
            unknown[0] if unknown else "kind without flag_meanings",
            f"the kinds of a map are {', '.join(MEANINGS)}",
            "give what the map returned, attributes included",
        )
    codes = np.ravel(kind.attrs.get("flag_values", range(len(words)))).tolist()
    return {int(code): MEANINGS[word] for code, word in zip(codes, words, strict=True)}


def classes_of(
    kind: NDArray[Any], period: NDArray[Any] | None, flags: dict[int, CellClass]
) -> Classes:
    """Return the class of each cell; a large map holds no more than bytes and truth values.

    Parameters
    ----------
    kind
        Kinds or fates.
    period
        Forcing periods of the orbits, shape of the kinds; None of a map of fates.
    flags
        From `flags_of_cells`.

    Raises
    ------
    InputError
        If there is a kind without a flag.
    """
    classes = np.full(kind.shape, CellClass.NOT_COMPUTED, dtype=np.int8)
    for code, cell_class in flags.items():
        classes[kind == code] = cell_class
    left = kind[classes == CellClass.NOT_COMPUTED]
    strange = left[(left != BLANK) & ~np.isnan(left)]
    if strange.size:
        raise InputError(
            "dataset",
            strange[0].item(),
            f"a kind is one of {', '.join(map(str, flags))}, and {BLANK} where none is known",
            "give what the map returned, unchanged",
        )
    if period is not None:
        again = period > 1
        again &= (classes == CellClass.SYMMETRIC) | (classes == CellClass.UNSYMMETRIC)
        classes[again] = CellClass.SUBHARMONIC
    return classes


def counts_of(classes: Classes) -> dict[CellClass, int]:
    """Return how many cells each class has, zeros included.

    A share is such a number over the number of all cells, which includes cells that are not
    computed, undecided or without a start.
    """
    counts = np.bincount(classes.ravel(), minlength=len(CellClass))
    return {cell_class: int(counts[cell_class]) for cell_class in CellClass}


def map_counts(dataset: "Labelled") -> tuple[dict[str, int], dict[str, int]]:
    """Return how many cells of a map each class has, by the words of the map.

    Parameters
    ----------
    dataset
        A map of attractors or fates; it is read in parts that fit into memory.

    Returns
    -------
    counts
        By word, in the order of a legend, zeros included; together all cells.
    subharmonic
        Number of subharmonic cells of each kind that occurs.
    """
    name, periods = ("fate", ()) if "fate" in dataset else ("kind", ("period",))
    flags = flags_of_cells(dataset[name])
    words = dict(
        zip(flags.values(), str(dataset[name].attrs["flag_meanings"]).split(), strict=True)
    )
    if periods:
        words[CellClass.SUBHARMONIC] = "subharmonic"
    words[CellClass.NOT_COMPUTED] = "not-computed"
    counts = dict.fromkeys((cell_class for cell_class in CellClass if cell_class in words), 0)
    longer = dict.fromkeys(flags, 0)
    for kind, *rest in slabs(dataset, name, *periods):
        classes = classes_of(np.asarray(kind), np.asarray(rest[0]) if rest else None, flags)
        for cell_class, count in counts_of(classes).items():
            if cell_class in counts:
                counts[cell_class] += count
        again = kind[classes == CellClass.SUBHARMONIC]
        for code in longer:
            longer[code] += int(np.count_nonzero(again == code))
    long_counts = {words[flags[code]]: count for code, count in longer.items() if count}
    return {words[cell_class]: count for cell_class, count in counts.items()}, long_counts
