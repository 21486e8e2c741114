"""Words of files of ground motions: what they state, and how they were read."""

from pathlib import Path

from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.records.core.recording import Recording
from rocksteady.records.pairing import RecordSet
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.results.result import describes


@describes(Recording)
def describe_recording(recording: Recording) -> Description:
    """Return what the file states, and how it was read."""
    record = recording.record
    count = len(record.acceleration_m_s2)
    stated = recording.stated_peak_m_s2
    facts = [
        Fact("file", str(recording.path), "file", f"{recording.path.name} ({recording.format})"),
        Fact("format", recording.format),
        Fact("component", recording.component),
        Fact("orientation", recording.orientation),
        Fact("azimuth_deg", recording.azimuth_deg),
        Fact("quantity", recording.quantity),
        Fact("position", recording.position),
        Fact("station", recording.station),
        Fact("event", recording.event),
        Fact("start_time", recording.start_time and recording.start_time.isoformat()),
        Fact(
            "npts",
            count,
            "samples",
            f"{count:,} every {record.dt_s:g} s, {record.duration_s:g} s, "
            f"in {recording.units_in_file}",
        ),
        Fact("dt_s", record.dt_s),
        Fact("duration_s", record.duration_s),
        Fact("units_in_file", recording.units_in_file),
        Fact(
            "stated_peak_m_s2",
            stated,
            "" if stated is None else "peak stated",
            "" if stated is None else quantity(stated, "m/s^2"),
        ),
        *(Fact("", done, "processing", done) for done in recording.processing),
        Fact("processing", list(recording.processing)),
        Fact("left_out", [each.to_dict() for each in recording.left_out]),
        Fact("warnings", list(recording.warnings)),
    ]
    return Description(headline=recording.title, facts=facts, notes=recording.warnings)


@describes(RecordSet)
def describe_set(channels: RecordSet) -> Description:
    """Return the channels, and what keeps them from being used together."""
    rows = [
        {
            "place": place,
            "file": str(each.path),
            "component": each.component,
            "azimuth_deg": each.azimuth_deg,
            "npts": len(each.record.acceleration_m_s2),
            "dt_s": each.record.dt_s,
            "pga_m_s2": each.record.peak_acceleration_m_s2,
        }
        for place, channels in (
            ("horizontal", channels.horizontal),
            ("vertical", () if channels.vertical is None else (channels.vertical,)),
            ("other", channels.other),
        )
        for each in channels
    ]
    columns = [
        Column("place", "channel", left=True),
        Column("file", "file", lambda file: Path(file).name, left=True),
        Column("component", "component", left=True),
        Column("npts", "samples"),
        Column("dt_s", "dt [s]", lambda value: f"{value:g}"),
        Column("pga_m_s2", "PGA [g]", lambda value: number(value / STANDARD_GRAVITY)),
    ]
    return Description(
        headline=f"{channels.name}: {plural(len(channels.horizontal), 'horizontal channel')}, "
        + ("no vertical one" if channels.vertical is None else "a vertical one"),
        facts=[Fact("name", channels.name), Fact("warnings", list(channels.warnings))],
        tables=[Table("recordings", rows, columns)],
        notes=channels.warnings,
    )
