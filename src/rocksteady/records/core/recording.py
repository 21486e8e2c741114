"""One channel of a ground-motion file: its record, and the metadata of the file."""

from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Literal

from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.motions.record import Record
from rocksteady.results.result import Result

Orientation = Literal["horizontal", "vertical", "unknown"]
"""Which way a channel points."""

Position = Literal["surface", "borehole", "structure", "unknown"]
"""Where its sensor stands: on the ground, below it, or in or on a building, a bridge or a dam."""


@dataclass(frozen=True, kw_only=True)
class LeftOut:
    """A channel, or a file, that shakes nothing, and why.

    Parameters
    ----------
    file
        The file.
    channel
        The channel, or None where the whole file is meant.
    kind
        Word by which it is counted: ``vertical``, ``velocity``, ``borehole``, ``no record``, ...
    why
        The reason, as a clause.
    """

    file: Path
    channel: str | None = None
    kind: str
    why: str

    def to_dict(self) -> dict[str, str | None]:
        """Return an object of JSON."""
        return {"file": str(self.file), "channel": self.channel, "why": self.why}


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class Recording(Result):
    r"""One acceleration channel of a ground-motion file.

    Made by `~rocksteady.records.read.read_recordings`.

    Parameters
    ----------
    record
        The samples [m/s^2] and their interval.
    format
        Short name of the file's format (``peer-at2``).
    path
        The file.
    units_in_file
        Unit of the file's numbers (``g``, ``counts``).
    component
        The channel's direction as the file names it (``N-S``, ``360``).
    orientation
        Whether the channel is horizontal or vertical, or unknown.
    directed
        Whether the file names a direction, understood or not.
    azimuth_deg
        Direction of positive values of a horizontal channel, clockwise from north [degrees].
    position
        Where the sensor stands, as far as the file states it.
    station, event
        Station and earthquake, as stated in the file.
    start_time
        Time of the first sample (UTC).
    stated_peak_m_s2
        Largest absolute acceleration [m/s^2] as the file's header states it.
    warnings
        Warnings about a file that could still be read, a sentence each.
    processing
        What has been done to the numbers beyond converting their unit, in order: an offset taken
        off, a baseline correction, a new interval.
    left_out
        Channels of the same file that are no acceleration.

    Examples
    --------
    >>> import tempfile
    >>> from rocksteady.records.read import read_recordings
    >>> path = Path(tempfile.mkdtemp()) / "example.AT2"
    >>> head = "PEER\nSomewhere, 1/2/1990, Hut, UP\nACCELERATION IN UNITS OF G\n"
    >>> _ = path.write_text(head + "NPTS= 3, DT= .01 SEC\n .1 -.2 .05\n")
    >>> (recording,) = read_recordings(path)
    >>> recording.format, recording.units_in_file, recording.orientation
    ('peer-at2', 'g', 'vertical')
    >>> recording.record.peak_acceleration_m_s2
    1.96133
    """

    record: Record
    format: str
    path: Path
    units_in_file: str
    component: str | None = None
    orientation: Orientation = "unknown"
    directed: bool = False
    azimuth_deg: float | None = None
    position: Position = "unknown"
    station: str | None = None
    event: str | None = None
    start_time: datetime | None = None
    stated_peak_m_s2: float | None = None
    warnings: tuple[str, ...] = ()
    processing: tuple[str, ...] = ()
    left_out: tuple[LeftOut, ...] = ()

    @property
    def quantity(self) -> str:
        """What the samples are: an acceleration, for no other quantity is read."""
        return "acceleration"

    @property
    def name(self) -> str:
        """The file, with the channel where the file's name does not contain it."""
        stem, component = self.path.name, self.component
        return stem if component is None or component in stem else f"{stem} {component}"

    @property
    def title(self) -> str:
        """Event, station and component, or the file."""
        parts = [part for part in (self.event, self.station, self.component) if part]
        return ", ".join(" ".join(part.split()) for part in parts) or self.path.name

    def processed(self, record: Record, note: str) -> "Recording":
        """Return the recording with another record, and a note on how it came about."""
        return replace(self, record=record, processing=(*self.processing, note))
