"""Reader of miniSEED and SAC, binary formats of seismology, with ObsPy (extra ``records``).

Neither states the unit of its numbers in a way that can be relied upon: miniSEED holds counts of an
instrument as a rule, and SAC's header names a unit that few writers keep to. So the unit is
required, and counts are to be converted beforehand.
"""

import contextlib
import io
import re
import struct
import sys
import warnings
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final, Protocol, cast

from rocksteady.errors import RecordFileError, check_installed
from rocksteady.records.core.assembling import Channel, Given, built, other_quantity
from rocksteady.records.core.recording import Orientation, Recording
from rocksteady.records.core.text import RecordText

if TYPE_CHECKING:
    import numpy as np

MSEED: Final = "mseed"
SAC: Final = "sac"

_MSEED_QUALITY: Final = b"DRQM"
_SAC_HEADER: Final = 632
_SAC_VERSION_AT: Final = 304
_SAC_QUANTITY: Final = {6: "displacement", 7: "velocity"}
_UNSET: Final = -12345


class _Trace(Protocol):
    """What is used of ObsPy's trace."""

    data: "np.ndarray"
    stats: "_Stats"


class _Stats(Protocol):
    """What is used of ObsPy's header."""

    network: str
    station: str
    location: str
    channel: str
    delta: float
    npts: int
    starttime: object
    endtime: object

    def get(self, key: str, default: object = None) -> object:
        """Return a value of the header."""


def recognised(data: bytes) -> str | None:
    """Return which of these formats a file's bytes are in, or None."""
    head = data[:48]
    if head[:2] == b"MS" and head[2:3] == b"\x03":
        return MSEED
    numbered = len(head) == 48 and all(byte in b"0123456789 \x00" for byte in head[:6])
    if numbered and head[6] in _MSEED_QUALITY and head[7] in b" \x00":
        return MSEED
    if len(data) > _SAC_HEADER:
        for order in "<>":
            (version,) = struct.unpack_from(f"{order}i", data, _SAC_VERSION_AT)
            if version in {6, 7}:
                return SAC
    return None


def read(path: Path, data: bytes, format_name: str, given: Given) -> tuple[Recording, ...]:
    """Return the channels of a file, in its order.

    Raises
    ------
    RecordFileError
        If ObsPy is not installed or cannot read the file, a channel has gaps or is not one of
        acceleration, or the unit is not given.
    """
    check_installed(
        lambda valid, hint: RecordFileError(path=path, valid=valid, hint=hint), "records", "obspy"
    )
    with warnings.catch_warnings():
        # Of what ObsPy itself imports, and none of the file's.
        warnings.simplefilter("ignore")
        from obspy import read as read_stream
    with _listening() as doubts:
        try:
            stream = read_stream(
                io.BytesIO(data), format=format_name.upper(), check_compression=False
            )
        except Exception as error:
            # The address in memory of what it was given means nothing, and differs from run to run.
            words = re.sub(r"<[\w.]*BytesIO object at \w+>", "the file", str(error))
            reason = " ".join(words.split()) or type(error).__name__
            hint = "see whether the file is whole"
            raise RecordFileError(
                path=path, valid=f"ObsPy says: {reason[:200]}", hint=hint
            ) from error
    text = RecordText(path=path, lines=())
    traces = cast("list[_Trace]", list(stream))
    if not traces:
        raise text.error("it holds no samples", "see whether the file is whole")
    return tuple(
        _recording(text, format_name, pieces, given, tuple(sorted(doubts)))
        for pieces in _by_channel(traces)
    )


@contextlib.contextmanager
def _listening() -> Iterator[set[str]]:
    """Collect the warnings of ObsPy about a file, which else would go to the screen.

    Its reader of miniSEED calls back from C, where an exception cannot be raised; Python hands it
    to a hook, which prints it.
    """
    doubts: set[str] = set()
    hook = sys.unraisablehook
    sys.unraisablehook = lambda _: doubts.add("ObsPy met a fault that it could not put into words")
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            yield doubts
        doubts |= {" ".join(str(warning.message).split()) for warning in caught}
    finally:
        sys.unraisablehook = hook


def _by_channel(traces: "list[_Trace]") -> "list[list[_Trace]]":
    """Return the pieces of each channel, in the order of the file."""
    groups: dict[tuple[str, ...], list[_Trace]] = {}
    for trace in traces:
        stats = trace.stats
        key = (stats.network, stats.station, stats.location, stats.channel)
        groups.setdefault(key, []).append(trace)
    return list(groups.values())


def _recording(
    text: RecordText,
    format_name: str,
    pieces: "list[_Trace]",
    given: Given,
    doubts: tuple[str, ...],
) -> Recording:
    """Return the recording of one channel."""
    import numpy as np

    stats = pieces[0].stats
    name = f"{stats.network}.{stats.station}.{stats.location}.{stats.channel}"
    if len(pieces) > 1:
        raise text.error(
            f"channel {name} comes in {len(pieces)} pieces, with gaps or overlaps between them",
            "cut out one piece, or merge them with ObsPy as suits the record",
        )
    values = pieces[0].data
    if values.dtype.kind not in "iuf":
        raise text.error(f"channel {name} holds no numbers", "give a file of samples")
    header = stats.get("sac")
    orientation, azimuth, down = (
        _of_sac(text, header) if isinstance(header, Mapping) else (None, None, None)
    )
    if given.units is None:
        kind = (
            "whole numbers, counts of an instrument as a rule"
            if values.dtype.kind in "iu"
            else ("numbers whose unit the file does not state")
        )
        raise text.error(
            f"channel {name} holds {kind}",
            "convert it to acceleration (ObsPy's remove_response) and give units",
        )
    channel = Channel(
        values=np.asarray(values, dtype=np.float64),
        units=None,
        # SAC holds it in single precision: .005 as .00499999989.
        dt_s=float(f"{stats.delta:.7g}") if format_name == SAC else float(stats.delta),
        component=stats.channel or None,
        orientation=orientation,
        azimuth_deg=azimuth,
        down=down,
        alone=False,
        station=".".join(part for part in (stats.network, stats.station) if part) or None,
        start_time=_start(stats.starttime),
        warnings=doubts,
    )
    return built(text, format_name, channel, given)


def _of_sac(
    text: RecordText, header: "Mapping[str, object]"
) -> tuple[Orientation | None, float | None, bool | None]:
    """Return orientation, azimuth and sense that a SAC header states.

    Raises
    ------
    RecordFileError
        If it states that the samples are no acceleration.
    """
    quantity = _SAC_QUANTITY.get(int(_number(header, "idep")))
    if quantity is not None:
        raise other_quantity(text, quantity, "its header states IDEP")
    from_up, azimuth = _number(header, "cmpinc"), _number(header, "cmpaz")
    if from_up in {0.0, 180.0}:
        return "vertical", None, from_up == 180.0
    if from_up == 90.0:
        return "horizontal", None if azimuth == _UNSET else azimuth, None
    return None, None, None


def _number(header: "Mapping[str, object]", key: str) -> float:
    """Return a number of a SAC header."""
    value = header.get(key)
    try:
        return _UNSET if value is None else float(cast("float", value))
    except (TypeError, ValueError):
        return _UNSET


def _start(time: object) -> datetime | None:
    """Return ObsPy's time as Python's (UTC)."""
    try:
        moment = getattr(time, "datetime", None)
    except (ValueError, OverflowError):  # a year that is none
        return None
    return moment.replace(tzinfo=UTC) if isinstance(moment, datetime) else None
