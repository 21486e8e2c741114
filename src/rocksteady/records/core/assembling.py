"""Recording built from a file's numbers: its unit, sampling interval and warnings."""

from dataclasses import dataclass, replace
from datetime import datetime
from typing import TYPE_CHECKING, Final

from rocksteady.errors import InputError, RecordFileError
from rocksteady.model.checks.validation import positive
from rocksteady.model.motions.record import Record
from rocksteady.records.core.directions import (
    Pointing,
    contradiction,
    pointing,
    pointing_of_name,
    tells_nothing,
    without_place,
)
from rocksteady.records.core.positions import position_of
from rocksteady.records.core.recording import Orientation, Position, Recording
from rocksteady.records.core.text import CONTRADICTION, RecordText
from rocksteady.records.core.units import UNITS, acceleration_unit, in_m_s2, quantity_of

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

_LARGEST_PEAK_G: Final = 10.0
_FEWEST: Final = 20
_LAST_STANDS_OUT: Final = 1.5
_NO_RECORD_G: Final = 1000.0
_INTERVALS: Final = (1.0e-4, 0.1)
_PEAK_AGREES: Final = 0.01
_LEAVE_OUT: Final = "leave out {} where the file is right, else read it with ignore_header"
_INSTEAD: Final = {
    "counts": "give the processed file, or convert it to acceleration (ObsPy's remove_response)",
    "spectra": "give the file of acceleration (V1 or V2)",
}
TURNED: Final = "sign changed: {component} is positive downwards, and vertical motion upwards"
"""Note on a vertical channel that has been turned."""


@dataclass(frozen=True, kw_only=True)
class Given:
    """What the caller states about a file that does not state it itself, or states it wrongly.

    Parameters
    ----------
    units
        Unit of its numbers.
    dt_s
        Interval between its samples [s].
    column
        Which column of a table holds the acceleration: its number from 1, or its name.
    resample
        Whether samples at unequal intervals may be brought to equal ones.
    ignore_header
        Whether the numbers are taken as plain columns, whatever stands above them.
    """

    units: str | None = None
    dt_s: float | None = None
    column: str | int | None = None
    resample: bool = False
    ignore_header: bool = False

    def __post_init__(self) -> None:
        """Refuse an unknown unit or an invalid interval, before any file is opened."""
        if self.units is not None:
            in_m_s2(self.units)
        if self.dt_s is not None:
            given = positive("dt_s", self.dt_s, hint="give the time between samples in seconds")
            object.__setattr__(self, "dt_s", given)


@dataclass(frozen=True, kw_only=True)
class Channel:
    """What a reader has found of one channel, in the file's own units.

    Parameters
    ----------
    values
        Shape (samples,), in the unit of the file.
    units
        Unit as stated in the file, or None where it is not stated.
    dt_s
        Interval as stated in the file, or None where it is not stated.
    stated_peak
        Largest absolute value by the header, in the same unit.
    counts
        Whether the file holds an instrument's counts, which the reader has scaled.
    component, orientation, azimuth_deg, position, station, event, start_time, warnings, processing
        As for `~rocksteady.records.core.recording.Recording`; orientation and position are found
        from words where they are None.
    place
        Words about where the sensor stands, beside the component's.
    name
        What tells the channel from those of other files; by default the file's name without its
        suffix.
    directed
        Whether the component is the name of a direction; by default if it tells something.
    down
        Whether a code of the header states positive values to be downwards; None without a code.
    alone
        Whether it is the one channel of its file, whose name may then state its direction.
    """

    values: "Floats"
    units: str | None
    dt_s: float | None
    stated_peak: float | None = None
    units_in_file: str | None = None
    component: str | None = None
    orientation: Orientation | None = None
    azimuth_deg: float | None = None
    down: bool | None = None
    alone: bool = True
    position: Position | None = None
    directed: bool | None = None
    place: str = ""
    name: str | None = None
    station: str | None = None
    event: str | None = None
    start_time: datetime | None = None
    warnings: tuple[str, ...] = ()
    processing: tuple[str, ...] = ()


def built(text: RecordText, format_name: str, channel: Channel, given: Given) -> Recording:
    """Return the recording of a channel.

    Raises
    ------
    RecordFileError
        If neither the file nor the caller states unit and interval, or the numbers are no record.
    """
    import numpy as np

    units = unit(text, channel.units, given)
    dt_s, interval_warnings = interval(text, channel.dt_s, given)
    size = in_m_s2(units)
    component, beside = without_place(channel.component or "")
    channel = replace(channel, component=component or None, place=f"{beside} {channel.place}")
    towards, direction_warnings = _pointing(text, channel)
    values = np.asarray(channel.values, dtype=np.float64) * size
    turned: tuple[str, ...] = ()
    if towards.down:
        values, turned = -values, (TURNED.format(component=channel.component or "file's name"),)
    directed = channel.directed
    if directed is None:
        directed = not tells_nothing(component)
    if directed and towards.orientation is None:
        odd = f"where its channel points, {component!r}, is not understood"
        direction_warnings = (*direction_warnings, odd)
    name = text.path.stem if channel.name is None else channel.name
    try:
        record = Record(acceleration_m_s2=values, dt_s=dt_s, name=name)
    except InputError as error:
        hint = "see whether this is the whole file"
        raise text.error(f"its samples are no record, {error.valid}", hint) from error
    if record.peak_acceleration_m_s2 > _NO_RECORD_G * UNITS["g"]:
        valid = f"a peak of {record.peak_acceleration_m_s2 / UNITS['g']:.3g} g is none of a record"
        raise text.error(valid, f"see whether its numbers are in {units}, and not garbled")
    stated = None if channel.stated_peak is None else abs(channel.stated_peak) * size
    return Recording(
        record=record,
        format=format_name,
        path=text.path,
        units_in_file=channel.units_in_file or units,
        component=channel.component,
        orientation=towards.orientation or "unknown",
        azimuth_deg=towards.azimuth_deg,
        directed=directed,
        position=channel.position or position_of(f"{channel.component or ''} {channel.place}"),
        station=channel.station,
        event=channel.event,
        start_time=channel.start_time,
        stated_peak_m_s2=stated,
        warnings=(
            *channel.warnings,
            *direction_warnings,
            *interval_warnings,
            *_doubts_about_peak(record, stated, units),
        ),
        processing=(*channel.processing, *turned),
    )


def _pointing(text: RecordText, channel: Channel) -> tuple[Pointing, tuple[str, ...]]:
    """Return the direction of a channel, and a warning where codes, words and names contradict.

    A code of the header goes before its words, and both before the name of the file.
    """
    of_words = pointing(channel.component)
    of_code = Pointing(
        orientation=channel.orientation,
        azimuth_deg=None if channel.azimuth_deg is None else channel.azimuth_deg % 360.0,
        down=channel.down,
    )
    doubts = []
    if of_words.unclear and channel.down is None:
        doubts.append(
            f"the channel is called {channel.component!r}, of which the vertical sense is not "
            f"understood: its sign is left as it is"
        )
    result = of_words
    if of_code.orientation is not None:
        result = of_code
        if difference := contradiction(of_words, of_code):
            doubts.append(
                f"the channel is called {channel.component!r}, {difference[0]}, and its code in "
                f"the header states {difference[1]}: the code is taken"
            )
        elif of_code.orientation == "vertical" and of_code.down is None:
            result = of_words if of_words.orientation == "vertical" else of_code
    of_name = pointing_of_name(text.path.stem) if channel.alone else Pointing()
    if result.orientation is not None:
        if difference := contradiction(of_name, result):
            doubts.append(
                f"the file's name states {difference[0]}, and its header {difference[1]}"
                f"{f' ({channel.component})' if channel.component else ''}: the header is taken"
            )
    elif of_name.orientation == "vertical" and tells_nothing(channel.component):
        result = of_name
        if of_name.down:
            doubts.append("the file's name alone states that its values are positive downwards")
    return result, tuple(doubts)


def unit(text: RecordText, stated: str | None, given: Given) -> str:
    """Return the unit of a file's numbers.

    Raises
    ------
    RecordFileError
        If neither the file nor the caller states it, they differ, or it is one of another quantity.
    """
    if (quantity := quantity_of(stated or "")) not in {None, "acceleration"}:
        raise other_quantity(text, quantity or "", f"its numbers are in {stated}")
    of_file = None if stated is None else acceleration_unit(stated)
    if given.units is not None:
        chosen = acceleration_unit(given.units) or given.units
        if of_file is not None and in_m_s2(of_file) != in_m_s2(chosen):
            valid = f"the file states that its numbers are in {of_file}, and units in {chosen}"
            raise text.error(valid, _LEAVE_OUT.format("units"), kind=CONTRADICTION)
        return chosen
    if of_file is None:
        valid = "the file does not state the unit of its numbers"
        if stated is not None:
            valid = f"the unit that the file states, {stated!r}, is not understood"
        raise text.error(valid, f"give units: {', '.join(UNITS)}")
    return of_file


def other_quantity(
    text: RecordText, quantity: str, valid: str, *, at: int | None = None
) -> RecordFileError:
    """Return the error that a file, or a line of it, is of no acceleration.

    Parameters
    ----------
    text
        The file.
    quantity
        Velocity, displacement, spectra, counts or another one.
    valid
        What shows it, as a clause.
    at
        Index of the line.
    """
    hint = _INSTEAD.get(quantity, "give the file of acceleration")
    clause = f"{valid}: {quantity}, and the base moves by its acceleration"
    return text.error(clause, hint, at=at, kind=quantity)


def interval(text: RecordText, stated: float | None, given: Given) -> tuple[float, tuple[str, ...]]:
    """Return the interval between samples [s], and a warning where it is unusual.

    Raises
    ------
    RecordFileError
        If neither the file nor the caller states it, they differ, or it is not above 0.
    """
    if given.dt_s is not None:
        if stated is not None and abs(stated - given.dt_s) > 1.0e-6 * given.dt_s:
            valid = f"the file states {stated:g} s between samples, and dt_s {given.dt_s:g} s"
            raise text.error(valid, _LEAVE_OUT.format("dt_s"), kind=CONTRADICTION)
        return given.dt_s, ()
    if stated is None:
        raise text.error(
            "the file does not state the interval between samples", "give dt_s, in seconds"
        )
    if not stated > 0.0:
        raise text.error(
            f"the interval between samples that it states, {stated:g} s, is not above 0",
            "correct it in the file",
        )
    if not _INTERVALS[0] <= stated <= _INTERVALS[1]:
        return stated, (f"samples {stated:g} s apart are unusual: see whether the header is right",)
    return stated, ()


def _doubts_about_peak(record: Record, stated: float | None, units: str) -> tuple[str, ...]:
    """Return a sentence on a peak that is not the header's, or larger than any ever recorded."""
    peak = record.peak_acceleration_m_s2
    doubts = []
    if peak > _LARGEST_PEAK_G * UNITS["g"]:
        doubts.append(
            f"its peak is {peak / UNITS['g']:.3g} g, more than any earthquake has caused: see "
            f"whether its numbers are in {units}"
        )
    values = abs(record.acceleration_m_s2)
    if len(values) >= _FEWEST and values[-1] > _LAST_STANDS_OUT * float(values[:-1].max()):
        doubts.append("its last sample is its peak by far: see whether the file is cut inside it")
    if stated is not None and abs(peak - stated) > _PEAK_AGREES * stated:
        doubts.append(f"its peak is {peak:.6g} m/s^2, and the header states {stated:.6g} m/s^2")
    return tuple(doubts)
