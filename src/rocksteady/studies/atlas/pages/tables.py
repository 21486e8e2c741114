"""Data of an atlas as tables: a header of column names, then rows."""

from collections.abc import Iterator, Sequence

from rocksteady.studies.atlas.analysis.coexistence import Coexistence
from rocksteady.studies.atlas.analysis.families import FamilyMap
from rocksteady.studies.atlas.analysis.from_rest import FATES, FromRest
from rocksteady.studies.atlas.analysis.lines import Line

Table = tuple[tuple[str, ...], list[tuple[object, ...]]]


def bands_table(families: Sequence[FamilyMap]) -> Table:
    """Return where each band of each family begins and ends, column by column."""
    header = (
        "order", "frequency_ratio", "begins",
        "symmetric_until", "unsymmetric_until", "cascade_until",
    )  # fmt: skip
    rows: list[tuple[object, ...]] = []
    for family in families:
        for ratio, ends in zip(family.plane.ratios.tolist(), family.edges.T.tolist(), strict=True):
            rows.append((family.order, ratio, *ends))
    return header, rows


def lines_table(lines: Sequence[Line]) -> Table:
    """Return the points of every border; a number distinguishes pieces of one name."""
    header = ("order", "impacts", "border", "piece", "frequency_ratio", "amplitude")
    rows: list[tuple[object, ...]] = []
    for piece, line in enumerate(lines):
        points = zip(line.frequency_ratio.tolist(), line.amplitude.tolist(), strict=True)
        rows += [(line.order, line.impacts, line.name, piece, *point) for point in points]
    return header, rows


def coexistence_table(result: Coexistence) -> Table:
    """Return the coexisting stable motions, cell by cell."""
    header = (
        "amplitude", "frequency_ratio", "motions", "rest", "aperiodic", "undecided_starts",
        "of_1_period", "of_3_periods", "of_5_periods", "of_other_periods", "with_rests", "orbits",
    )  # fmt: skip
    return header, [*_coexistence_rows(result)]


def _coexistence_rows(result: Coexistence) -> Iterator[tuple[object, ...]]:
    kinds = {kind.code: kind for kind in result.classes}
    for row, amplitude in enumerate(result.plane.amplitudes.tolist()):
        for column, ratio in enumerate(result.plane.ratios.tolist()):
            here = [kinds[code] for code in result.codes[:, row, column].tolist() if code]
            periods = [kind.period for kind in here]
            yield (
                amplitude,
                ratio,
                int(result.motions[row, column]),
                int(result.rest[row, column]),
                int(result.aperiodic[row, column]),
                int(result.undecided[row, column]),
                *(periods.count(period) for period in (1, 3, 5)),
                sum(period not in (1, 3, 5) for period in periods),
                sum(kind.impacts is None for kind in here),
                result.text_at(row, column),
            )


def rest_table(result: FromRest) -> Table:
    """Return the long-term motion of a block initially at rest, cell by cell."""
    header = (
        "amplitude", "frequency_ratio", "fate_at_phase_0", "period", "impacts",
        "phases", "phases_overturned",
    )  # fmt: skip
    phases = 2 * len(result.phases)
    fallen = (result.fate == FATES.index("overturned")).sum(axis=0) * 2
    rows: list[tuple[object, ...]] = [
        (
            amplitude,
            ratio,
            FATES[int(result.fate[0, row, column])],
            int(result.period[0, row, column]),
            int(result.impacts[0, row, column]),
            phases,
            int(fallen[row, column]),
        )
        for row, amplitude in enumerate(result.plane.amplitudes.tolist())
        for column, ratio in enumerate(result.plane.ratios.tolist())
    ]
    return header, rows
