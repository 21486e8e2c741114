"""Reader of number tables: CSV or plain columns, with times or samples alone.

What a file does not state must be given: the unit of its numbers, and the interval where it has no
times. Names are understood with their unit, as in ``time [s]``, ``Acc (g)`` or ``accel_cm/s2``.
"""

import re
from dataclasses import replace
from datetime import datetime
from functools import partial
from itertools import groupby
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, RecordFileError
from rocksteady.records.core.assembling import Channel, Given, built, other_quantity
from rocksteady.records.core.blocks import blocks, numeric, plain
from rocksteady.records.core.column_names import OTHER, column_name, quantity_in, quantity_named
from rocksteady.records.core.consistency import Lines, agreed, layout, timing
from rocksteady.records.core.directions import tells_nothing
from rocksteady.records.core.header_statements import (
    refuse_factors,
    stated_count,
    stated_duration,
    stated_interval,
    stated_time_unit,
    stated_unit,
    unless_given,
)
from rocksteady.records.core.numbers import number
from rocksteady.records.core.recording import LeftOut, Recording
from rocksteady.records.core.sampling import Spaced, evenly_spaced, places
from rocksteady.records.core.stated_words import (
    stated_direction,
    stated_start,
    stated_station,
    unit_of_peaks,
)
from rocksteady.records.core.table import Table, table
from rocksteady.records.core.text import CONTRADICTION, CORRECT, FETCH, NO_RECORD, RecordText
from rocksteady.records.core.units import in_m_s2
from rocksteady.results.numbers import plural

CSV: Final = "csv"
COLUMNS: Final = "columns"

_DATA_TYPE: Final = re.compile(r"\bdata[ _]type\s*[:=]\s*([A-Za-z]+)", re.IGNORECASE)
_SPECTRA: Final = re.compile(
    r"(?!.*(?:compatib|match|histor|record|accelerogram))"
    r".*(?:\bspectr(?:a|um)\b|\bspettro\b|\benvelope\b|autocorrelation|\bangular\s+acc|rad/s)",
    re.IGNORECASE,
)
_LONGEST_INTERVAL: Final = 0.1
_POWER: Final = re.compile("[eEdD].*")
_BEGINS: Final = re.compile(r"""\s*["']?[+-]?\.?\d""")
_SAYS_ACC: Final = re.compile(r"(?<![A-Z])(?:A|ACC\w*|ACEL\w*|BESCHL\w*)(?![A-Z])")
_AGAINST: Final = re.compile(r"(?:freq|period|f\b|natural)", re.IGNORECASE)
"""What a column begins with against which spectra are drawn."""
_LONGEST_HEADER: Final = 40
_SHORTEST: Final = 20
"""Rows of a column of which it is told that it counts, or never moves."""
_NO_ROWS: Final = "it holds no rows of numbers"
_AS_CHANNELS: Final = 4
"""Columns without names that may be channels as well as consecutive samples."""


def recognises(text: RecordText) -> bool:
    """Return whether a file has a line that begins with a number."""
    return any(_BEGINS.match(line) for line in text.heads)


def read(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the channels of a table, or of several one below the other.

    Raises
    ------
    RecordFileError
        If it is no table, a row of it is no row of numbers, or what it does not state is not given.
    InputError
        If the file has no such column.
    """
    refuse_spectra(text)
    refuse_geonet(text)
    text, start = plain(text)
    recordings: list[Recording] = []
    others: list[RecordFileError] = []
    for block in blocks(text):
        try:
            recordings += _read(block, given, start)
        except RecordFileError as error:
            if error.kind not in {"velocity", "displacement"}:
                raise
            others.append(error)
    if not recordings:
        raise others[0]
    left = tuple(
        LeftOut(file=text.path, channel="a block", kind=error.kind, why=error.clause)
        for error in others
    )
    return tuple(replace(each, left_out=(*each.left_out, *left)) for each in recordings)


def read_samples(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the numbers below the header by the options alone.

    Raises
    ------
    RecordFileError
        If unit or interval are not given, or the file has several blocks of numbers.
    """
    runs = [
        list(lines)
        for of_numbers, lines in groupby(
            (at for at, line in enumerate(text.lines) if line.strip(" \t,;")),
            key=lambda at: numeric(text.lines[at]),
        )
        if of_numbers
    ]
    longest = max(runs, key=len, default=[])
    if not longest:
        raise text.error(_NO_ROWS, "give a record as text", kind=NO_RECORD)
    if sum(2 * len(lines) > len(longest) for lines in runs) > 1:
        valid = "it holds several blocks of numbers, of which its header alone tells which is which"
        raise text.error(valid, "give a file of one block")
    samples = range(longest[0], longest[-1] + 1)
    lines = tuple(line if at in samples else "" for at, line in enumerate(text.lines))
    plain = replace(text, lines=lines)
    note = (
        f"header ignored: the numbers from line {longest[0] + 1} on are read by the options alone"
    )
    return tuple(
        replace(each, processing=(note, *each.processing)) for each in _read(plain, given, None)
    )


def _read(text: RecordText, given: Given, start: datetime | None) -> tuple[Recording, ...]:
    """Return the channels of one table."""
    data_table = table(text)
    if data_table is None:
        raise text.error(_NO_ROWS, "give a record as text", kind=NO_RECORD)
    if len(data_table.values) < 2:
        raise text.error("it holds one number, which is no record", "see whether it is whole")
    at = int(data_table.lines[0])
    count, interval, data_table = _without_counts(text, data_table, given)
    _refuse_other_quantities(text, data_table)
    if count is None:
        _refuse_short_rows(text, data_table)
    header = list(data_table.header_lines) if data_table.columns == 1 else _words(data_table)
    timed = data_table.columns > 1 and _time_column(data_table) is not None
    stated, unread = _interval(text, header, given, timed=timed)
    if count is None and (of_words := stated_count(text, header)) is not None:
        count, at = of_words
        # Of all channels together.
        wide = bool(data_table.names) and count == len(data_table.values)
        count = len(data_table.lines) if wide else count
    spaced, picked = _values(text, data_table, given, interval or stated, count)
    values, interval, warnings = spaced.values, spaced.dt_s, (*unread, *spaced.warnings)
    if len(picked) == 1 and not picked[0] and 1 < data_table.columns <= _AS_CHANNELS:
        what = f"{data_table.columns} numbers a line are taken as samples that follow each other"
        warnings += (f"{what}; give column where they are channels",)
    blank = int(data_table.lines[-1] - data_table.lines[0]) + 1 - len(data_table.lines)
    if blank and not timed:
        warnings += (f"{plural(blank, 'blank line')} among its samples passed over",)
    where = Lines(stated=at, start=int(data_table.lines[0]), end=len(text.lines))
    if count is not None:
        values, doubts = agreed(text, values, count, where)
        warnings = (*warnings, *doubts)
    else:
        warnings += layout(
            text, data_table.lines, separator=data_table.separator, comma=data_table.comma
        )
    lasts = stated_duration(text, header)
    warnings += timing(values[:, 0], given.dt_s or interval, duration=lasts)
    labels = [column_name(name).label or name or None for name in picked]
    direction = None
    if len(picked) == 1 and tells_nothing(labels[0]):
        direction = stated_direction(text, header)
        labels = [direction or labels[0]]
    if data_table.trailing is not None:
        after = f"what stands after the last sample, from line {data_table.trailing + 1}"
        warnings += (f"{after}, is left out",)
    channels = Channel(
        values=values,
        units=None,
        dt_s=interval,
        directed=direction is not None,
        alone=len(picked) == 1,
        place="\n".join(text.heads[at] for at in header),
        station=stated_station(text, header),
        start_time=start or stated_start(text, header),
        warnings=warnings,
        processing=spaced.notes,
    )
    return _recordings(text, data_table, given, channels, [*zip(picked, labels, strict=True)])


def _recordings(
    text: RecordText,
    data_table: Table,
    given: Given,
    channels: Channel,
    labels: list[tuple[str, str | None]],
) -> tuple[Recording, ...]:
    """Return the channels of a table; columns of which the unit is not understood are left out.

    Parameters
    ----------
    text, data_table, given
        As above.
    channels
        What the channels share, with their values, shape (samples, channels).
    labels
        Name of each one's column, and what it is called.

    Raises
    ------
    RecordFileError
        If no unit is understood, or as for `built`.
    """
    named = data_table.columns > 1 and bool(data_table.names)
    format_name = CSV if named or data_table.separator is not None else COLUMNS
    turned = re.search(r"\b[xy]\b.{0,12}\b(?:up|vertical)", channels.place, re.IGNORECASE)
    level = set() if turned else _three_axes([label for _, label in labels])
    peaks = [float(abs(column).max()) for column in channels.values.T]
    spans = [float(column.max() - column.min()) for column in channels.values.T]
    recordings: list[Recording] = []
    odd: list[str] = []
    still: list[str] = []
    faults: list[RecordFileError] = []
    for index, (name, label) in enumerate(labels):
        if len(channels.values) >= _SHORTEST and spans[index] == 0.0 < max(spans):
            still.append(name)
            continue
        try:
            of_name = partial(_unit_of, text, name, data_table)
            known, unread = unless_given(given.units, of_name)
            units, doubts = known or (None, unread)
        except RecordFileError as error:
            if error.kind:
                raise
            faults.append(error)
            odd.append(name)
            continue
        channel = replace(
            channels,
            values=channels.values[:, index],
            units=units or unit_of_peaks(text, [*data_table.header_lines], peaks),
            component=label,
            orientation="horizontal" if index in level else None,
            warnings=(*channels.warnings, *doubts),
        )
        recordings.append(built(text, format_name, channel, given))
    if not recordings:
        raise faults[0]
    left = _left_out(text, data_table, given, [name for name, _ in labels if name not in odd])
    left += tuple(
        LeftOut(file=text.path, channel=name, kind="still", why="all its samples are equal")
        for name in still
    )
    return tuple(replace(each, left_out=left) for each in recordings)


def _three_axes(labels: list[str | None]) -> set[int]:
    """Return which of three channels called after x, y and z are the level ones, x and y."""
    axes = [
        re.search(r"(?:^|[^a-z]|a|acc)([xyz])(?:$|[^a-z])", (name or "").lower()) for name in labels
    ]
    letters = [match[1] if match else "" for match in axes]
    return {letters.index("x"), letters.index("y")} if sorted(letters) == ["x", "y", "z"] else set()


def _left_out(
    text: RecordText, data_table: Table, given: Given, picked: list[str]
) -> tuple[LeftOut, ...]:
    """Return the named columns that are another quantity, or are not understood."""
    if given.column is not None or data_table.columns == 1:
        return ()
    named = [(column_name(name), name) for name in data_table.names]
    return tuple(
        LeftOut(file=text.path, channel=name, kind=kind, why=kind)
        for column, name in named
        if name not in picked and column.kind != "time"
        for kind in (column.quantity or "not understood",)
    )


def refuse_without_rows(text: RecordText) -> None:
    """Raise where a file has the names of a table's columns, and no rows.

    Raises
    ------
    RecordFileError
        As above.
    """
    for at, line in enumerate(text.heads[:_LONGEST_HEADER]):
        fields = re.split(r"[;,\t]|\s{2,}", line.strip().lstrip("#%!*/ "))
        if {"time", "acceleration"} <= {column_name(field.strip(" \"'")).kind for field in fields}:
            valid = "it holds the names of columns and no rows of numbers"
            raise text.error(valid, f"{FETCH}: it is cut after its header", at=at)


def _interval(
    text: RecordText, header: list[int], given: Given, *, timed: bool
) -> tuple[float | None, tuple[str, ...]]:
    """Return the interval that words state [s], and a warning where only the times are understood.

    Raises
    ------
    RecordFileError
        If it is not understood as a whole, and the table has no times.
    """
    try:
        words = None if given.dt_s is None else f"{given.dt_s:g} s"
        return unless_given(words, lambda: stated_interval(text, header))
    except RecordFileError as error:
        if not timed or error.kind:
            raise
        return None, (f"{error.valid}: the times of the table are taken",)


def _values(
    text: RecordText, data_table: Table, given: Given, stated: float | None, count: int | None
) -> tuple[Spaced, tuple[str, ...]]:
    """Return the samples (samples, channels) with their interval, and the channels' names."""
    width = data_table.columns
    in_a_row = not data_table.names and given.column is None and not _has_times(data_table)
    in_a_row = in_a_row and count != len(data_table.lines) and not _side_by_side(data_table)
    if width == 1 or in_a_row:
        if (
            data_table.names
            and column_name(data_table.names[0]).kind == "other"
            and given.column is None
        ):
            raise _no_acceleration(text, data_table)
        if given.column is not None:
            _asked_for(data_table, given.column)
        return Spaced(values=data_table.values[:, None], dt_s=stated), data_table.names[:1] or ("",)
    _refuse_short_rows(text, data_table, last=True)
    numbers = data_table.values.reshape(-1, width)
    time = _time_column(data_table)
    columns = _columns(text, data_table, given, time)
    names = tuple(
        data_table.names[column] if data_table.names else f"column {column + 1}"
        for column in columns
    )
    chosen = numbers[:, list(columns)]
    if time is None:
        return Spaced(values=chosen, dt_s=stated), names
    size = _seconds(text, data_table, time)
    spaced = evenly_spaced(
        text,
        numbers[:, time] * size,
        chosen,
        given,
        rounding=size * _places(text, data_table, time),
        line_of=lambda row: int(data_table.lines[row]),
    )
    doubts = spaced.warnings
    apart = spaced.dt_s or 0.0
    if stated is not None and abs(stated - apart) > 0.005 * apart:
        words = f"the words above the table state {stated:g} s between samples"
        doubts += (f"{words}, and its times are {apart:g} s apart: the times are taken",)
    return replace(spaced, warnings=doubts), names


def _side_by_side(data_table: Table) -> bool:
    """Return whether rows of numbers are channels: smoother downwards than along the rows."""
    whole = data_table.widths[:-1]
    if len(whole) < 2 or data_table.columns < 2 or (whole != whole[0]).any():
        return False
    values = data_table.values[: whole.sum()].reshape(len(whole), -1)
    downwards = np.abs(np.diff(values, axis=0)).mean()
    return bool(2.0 * downwards < np.abs(np.diff(values.ravel())).mean())


def _has_times(data_table: Table) -> bool:
    """Return whether a table without names has times in its first column."""
    if (data_table.widths[:-1] < 2).any() or len(data_table.widths) < 3:
        return False
    times = data_table.column(0)
    steps = np.sort(np.diff(times))
    # Times grow, and nearly all by the same; samples of a record do neither to the end.
    usual = steps[len(steps) // 2]
    near = np.count_nonzero(np.abs(steps - usual) <= 0.5 * usual)
    grows = np.count_nonzero(steps >= 0.0) >= 0.9 * len(steps) and times[-1] == times.max()
    return bool(usual > 0.0 and (steps[0] >= 0.0 or (near >= 0.9 * len(steps) and grows)))


def _beside(data_table: Table, others: list[int]) -> list[int]:
    """Return the columns of one letter that are no directions: of velocity, of anything.

    ``t, a, v, d`` are quantities; and beside an acceleration with its unit a bare ``N`` counts.
    """
    names = {at: data_table.names[at].strip().upper() for at in others}
    known = {at: column_name(data_table.names[at]) for at in others}
    quantities = {"V", "D"} <= {*names.values()} or {"V", "U"} <= {*names.values()}
    lettered = [at for at, name in names.items() if quantities and name in {"V", "D", "U"}]
    bare = [at for at in others if known[at].unit is None and not _SAYS_ACC.search(names[at])]
    named = any(known[at].unit and _SAYS_ACC.search(names[at]) for at in others)
    return [*lettered, *(bare if named else [])]


def _grows(data_table: Table, column: int) -> bool:
    """Return whether the numbers of a column grow from row to row."""
    values = data_table.column(column)
    return bool((values[1:] > values[:-1]).all())


def _counts_rows(data_table: Table, column: int) -> bool:
    """Return whether a column holds the numbers of its rows."""
    values = data_table.column(column)
    return len(values) >= _SHORTEST and bool((values[1:] == values[:-1] + 1.0).all())


def _time_column(data_table: Table) -> int | None:
    """Return which column holds the times, or None."""
    names = [name.upper() for name in data_table.names]
    across = {"L", "V"} & set(names)  # T is then transverse
    named = [
        at
        for at, name in enumerate(names)
        if column_name(name).kind == "time"
        and not (name == "T" and across and not _grows(data_table, at))
    ]
    if named:
        return named[0]
    return 0 if not data_table.names and _has_times(data_table) else None


def _seconds(text: RecordText, data_table: Table, time: int) -> float:
    """Return the size of the unit of the times [s].

    Raises
    ------
    RecordFileError
        If the name of their column states a unit that is not understood.
    """
    of_words = stated_time_unit(text, _words(data_table))
    if not data_table.names:
        return of_words or 1.0
    named = column_name(data_table.names[time])
    if of_words is not None and named.seconds not in {None, of_words}:
        valid = f"the words above its column {data_table.names[time]!r} state another unit of time"
        raise text.error(valid, CORRECT, at=data_table.names_at, kind=CONTRADICTION)
    if named.uncertain:
        valid = f"its unit of time, {named.uncertain!r}, is not understood"
        hint = "name the column time (s), time (ms), time (us) or time (min)"
        raise text.error(valid, hint, at=data_table.names_at)
    return named.seconds or of_words or 1.0


def _columns(
    text: RecordText, data_table: Table, given: Given, time: int | None
) -> tuple[int, ...]:
    """Return the columns of acceleration."""
    if given.column is not None:
        chosen = _asked_for(data_table, given.column)
        named = column_name(data_table.names[chosen]) if data_table.names else None
        if named is not None and named.kind == "other":
            valid = f"its column is {data_table.names[chosen]}"
            raise other_quantity(text, named.quantity, valid, at=data_table.names_at)
        return (chosen,)
    others = [at for at in range(data_table.columns) if at != time]
    if not data_table.names:
        return tuple(others)
    if any(_AGAINST.match(name) for name in data_table.names):
        valid = f"its columns are {', '.join(data_table.names)}"
        raise other_quantity(text, "spectra", valid, at=data_table.names_at)
    kinds = {at: column_name(data_table.names[at]).kind for at in others}
    kinds |= {at: "acceleration" for at in others if data_table.names[at].upper() == "T"}
    if any(kinds[at] == "time" and time is not None and _grows(data_table, at) for at in others):
        raise text.error(
            "it has two columns of times",
            "give each motion with its times as a file of its own",
            at=data_table.names_at,
        )
    kinds |= {at: "other" for at in others if _counts_rows(data_table, at)}
    kinds |= dict.fromkeys(_beside(data_table, others), "other")
    for wanted in ("acceleration", "unknown"):
        of_kind = tuple(at for at in others if kinds[at] == wanted)
        if wanted == "unknown" and len(of_kind) > 1:
            # Of several, what the words above or mere numbers show to be channels.
            numbered = all(data_table.names[at].isdecimal() for at in of_kind)
            of_kind = of_kind if numbered or stated_unit(text, _words(data_table)) else ()
        if of_kind:
            return of_kind
    raise _no_acceleration(text, data_table)


def _no_acceleration(text: RecordText, data_table: Table) -> RecordFileError:
    """Return the error that no column is one of acceleration."""
    listed = ", ".join(data_table.names)
    columns = [each for each in map(column_name, data_table.names) if each.kind != "time"]
    quantities = {each.quantity for each in columns if each.kind == "other"} - {OTHER}
    if columns and all(each.kind == "other" for each in columns):
        quantity = quantities.pop() if len(quantities) == 1 else OTHER
        return other_quantity(text, quantity, f"its columns are {listed}", at=data_table.names_at)
    return text.error(
        f"none of its columns is called an acceleration: {listed}",
        "give column, by its name or its number from 1",
    )


def _asked_for(data_table: Table, column: str | int) -> int:
    """Return the index of the column that the caller names.

    Raises
    ------
    InputError
        If there is none.
    """
    lowered = [name.lower() for name in data_table.names]
    wanted = str(column).strip().lower()
    if wanted in lowered:
        return lowered.index(wanted)
    if len(wanted) < 10 and wanted.isdecimal() and 1 <= int(wanted) <= data_table.columns:
        return int(wanted) - 1
    listed = ", ".join(data_table.names) or f"1 to {data_table.columns}"
    raise InputError(
        "column", column, "the table has no such column", f"choose one of these: {listed}"
    )


def _words(data_table: Table) -> list[int]:
    """Return the index of each line of words above the samples that is no row of names."""
    return [
        at for at in data_table.header_lines if not data_table.names or at != data_table.names_at
    ]


def _unit_of(text: RecordText, name: str, data_table: Table) -> tuple[str | None, tuple[str, ...]]:
    """Return the unit of a column: by its name, else by the words above the table; and warnings.

    Raises
    ------
    RecordFileError
        If one of them is not understood as a whole, or they contradict each other.
    """
    names = data_table.names_at if data_table.names and data_table.columns > 1 else None
    refuse_factors(text, list(data_table.header_lines), names=names)
    words = _words(data_table)
    named = column_name(name)
    title = data_table.columns == 1 and bool(data_table.names)
    if title and re.search(r"[:=]|\bunits?\b|\bin\b", name, re.IGNORECASE):
        # A line of words above one column is a title rather than a name.
        return stated_unit(text, [*words, data_table.names_at]), ()
    odd = named.uncertain
    if data_table.columns > 1 or named.unit is not None:
        odd = odd or named.leftover
    coded = named.kind == "unknown" and re.fullmatch(r"[A-Za-z]{2,}\d+\w*", name)
    if odd and data_table.names and named.kind != "other" and not coded:
        valid = f"its column {name!r} is not understood: {odd!r}"
        raise text.error(valid, "name the acceleration itself, as acc (g)", at=data_table.names_at)
    of_words = stated_unit(text, words, explicit=named.unit is not None)
    if named.unit is None:
        beside = {column_name(label).unit for label in data_table.names} - {None}
        if of_words is not None or len(beside) != 1:
            return of_words, ()
        return beside.pop(), (
            f"its column {name!r} states no unit: that of its neighbour is taken",
        )
    doubts: tuple[str, ...] = ()
    try:
        of_words = of_words or stated_unit(text, words)
    except RecordFileError as error:
        doubts = (f"{error.valid}: the unit of its column {name!r} is taken",)
    if of_words is not None and in_m_s2(of_words) != in_m_s2(named.unit):
        valid = f"its column {name!r} is in {named.unit}, and the words above it state {of_words}"
        raise text.error(valid, CORRECT, at=data_table.names_at, kind=CONTRADICTION)
    return named.unit, doubts


def _without_counts(
    text: RecordText, data_table: Table, given: Given
) -> tuple[int | None, float | None, Table]:
    """Return what rows of count and interval above the samples state, and the table without them.

    Some programs write such a row: a whole number, and mostly the interval after it, or below it. A
    1 in place of the count is a scale.

    Raises
    ------
    RecordFileError
        If it may be scale and interval, and neither a count nor the caller shows which.
    """
    rest, width = data_table.below(1), int(data_table.widths[0])
    count = len(rest.lines)
    if width > 3 or count < 2 or given.ignore_header:
        return None, None, data_table
    first: list[float] = data_table.values[:width].tolist()
    words, next_words = (text.lines[at].replace(",", " ").split() for at in data_table.lines[:2])
    whole = words[0].isdecimal() and all("." in word for word in next_words)
    below = float(rest.values[0]) if data_table.columns == 1 and count > 2 and whole else None
    if below is not None and 0.0 < below <= _LONGEST_INTERVAL:
        counted = first[0] == count - 1
        if counted or (first[0] == 1.0 and below == given.dt_s):
            return int(first[0]) if counted else None, below, rest.below(1)
        if first[0] == 1.0:
            valid = f"this line and the next, {below:g}, may be a scale and the interval"
            hint = f"give dt_s {below:g} where they are, else ignore_header with dt_s"
            raise text.error(valid, hint, at=int(data_table.lines[0]))
    whole = whole and first[0] >= 2.0
    unlike = width != rest.widths[0] or (width == 1 and first[0] > 99.0)
    # Above times and samples the row is as wide as theirs, and counts them.
    unlike = unlike or (width == 2 and first[0] == count)
    if not (whole and unlike and all(0.0 < value <= 1.0 for value in first[1:2])):
        return None, None, data_table
    names = rest.names if len(rest.names) == rest.columns else ()
    return int(first[0]), first[1] if width > 1 else None, replace(rest, names=names)


def _refuse_short_rows(text: RecordText, data_table: Table, *, last: bool = False) -> None:
    """Raise where a row has fewer numbers than others; the last one may, unless `last` is true."""
    columns = data_table.columns
    widths = data_table.widths if last else data_table.widths[:-1]
    for row in (widths != columns).nonzero()[0].tolist()[:1]:
        count = plural(int(widths[row]), "number")
        valid = f"it has {count}, and the table has {plural(columns, 'column')}"
        hint = "complete the row, or take out what is no sample"
        raise text.error(valid, hint, at=int(data_table.lines[row]))


def refuse_geonet(text: RecordText) -> None:
    """Raise where the numbers of a header would pass for samples, as in New Zealand's files."""
    if re.match(r"\s*(?:un)?corrected accelerogram", text.first, re.IGNORECASE) and any(
        re.match(r"\s*number of points\s+\d", line, re.IGNORECASE) for line in text.heads[:20]
    ):
        raise text.error(
            "it is one of GeoNet's files (V1A, V2A), which are not read",
            "give its samples of acceleration as a table",
        )


def refuse_spectra(text: RecordText) -> None:
    """Raise where the first line is that of a file of spectra.

    Raises
    ------
    RecordFileError
        As above.
    """
    if _SPECTRA.match(text.first) is not None:
        raise other_quantity(text, "spectra", "its first line names another quantity")


def _refuse_other_quantities(text: RecordText, data_table: Table) -> None:
    """Raise where the words above name counts, or another quantity and no acceleration."""
    words = " ".join(data_table.header)
    if re.search(r"\(\s*gal\s*\)\s*/\s*\d", words, re.IGNORECASE):
        valid = "its header states the scale of an instrument's counts, which is not applied here"
        hint = "give the file as its network publishes it (K-NET, KiK-net)"
        raise text.error(valid, hint, kind="counts")
    types = _DATA_TYPE.findall(words)
    named_columns = data_table.columns > 1 and data_table.names
    if not types and (named_columns or re.search(r"acc|acel|beschl", words, re.IGNORECASE)):
        return
    named = {"VL": "velocity", "DS": "displacement"}
    quantities = {named.get(each.upper()) or quantity_named(each) for each in types}
    quantities = quantities or {quantity_in(words)}
    if len(quantities) > 1:
        raise text.error(
            f"it states data of two types, {', '.join(types)}", CORRECT, kind=CONTRADICTION
        )
    quantity = quantities.pop()
    if quantity:
        raise other_quantity(text, quantity, "its header names another quantity")


def _places(text: RecordText, data_table: Table, column: int) -> Floats:
    """Return half a unit of the last digit that each number of a column may be written with."""

    def field(line: str) -> str:
        line = line.replace(",", ".") if data_table.comma else line
        fields = line.split(data_table.separator)
        return fields[column].strip().strip('"') if column < len(fields) else "0"

    layouts, of_lines = text.layouts
    known = text.by_layout(lambda line: number(field(line)) is not None)[data_table.lines]
    values = np.abs(data_table.column(column))
    # Of a layout the largest number has the most digits, if all have the same power of ten.
    ascending = data_table.lines[np.argsort(values, kind="stable")]
    keys: list[object] = of_lines[ascending].tolist()
    lines = ascending.tolist()
    if any(_POWER.search(field(layouts[at])) for at in {*of_lines[data_table.lines].tolist()}):
        keys = [(of_lines[at], *_POWER.findall(field(text.lines[at]))) for at in lines]
    largest = dict(zip(keys, lines, strict=True)).values()
    return places([field(text.lines[at]) for at in largest], values * known)
