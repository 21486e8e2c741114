"""Output of `rocksteady record`: values, tables, rows."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.present.shared import turned_text
from rocksteady.model.blocks.block import STANDARD_GRAVITY
from rocksteady.show.style.escaping import printable
from rocksteady.show.style.palette import shortened

if TYPE_CHECKING:
    from rocksteady.records.core.recording import Recording
    from rocksteady.seismic.measures.intensity import IntensityMeasures
    from rocksteady.seismic.measures.response_spectrum import ResponseSpectrum
    from rocksteady.seismic.measures.time_course import IntegratedRecord


@dataclass(frozen=True, kw_only=True)
class Description:
    """A channel of a file with all that is computed of it."""

    recording: "Recording"
    course: "IntegratedRecord"
    measures: "IntensityMeasures"
    spectrum: "ResponseSpectrum | None"

    @property
    def warnings(self) -> list[str]:
        """Warnings about the file, then about the record."""
        words = list(self.recording.warnings)
        if self.measures.drifts:
            last, largest = self.measures.final_velocity_m_s, self.measures.pgv_m_s
            words.append(
                f"PGD = {self.measures.pgd_m:.3g} m is that of an error of the baseline, not of a "
                f"ground: it is {self.measures.pgd_m / largest:.2g} s times PGV, and the record "
                f"ends with {abs(last) / largest:.0%} of PGV; --baseline linear may help"
            )
        return words

    @property
    def name(self) -> str:
        """The file, with the channel where the file's name does not say it."""
        stem, component = self.recording.path.name, self.recording.component
        return stem if component is None or component in stem else f"{stem} {component}"

    @property
    def title(self) -> str:
        """Event, station and component, or the file."""
        one = self.recording
        parts = [part for part in (one.event, one.station, one.component) if part]
        return ", ".join(" ".join(part.split()) for part in parts) or one.path.name


def title_of(found: Sequence[Description]) -> str:
    """Return what a figure shows in a few words."""
    if len(found) > 1:
        return f"{len(found)} records"
    turned = turned_text(found[0].recording.processing)
    return shortened(found[0].title, 110 - len(turned)) + turned


def processing_values(horizontal: "Recording", vertical: "Recording | None") -> dict[str, Any]:
    """Return what has been done to the records of a run."""
    values = {"record_processing": list(horizontal.processing)}
    if vertical is not None:
        values["vertical_processing"] = list(vertical.processing)
    return values


def record_values(one: Description, *, spectrum: bool) -> dict[str, Any]:
    """Return what the contract promises, and the rest."""
    recording, measures = one.recording, one.measures
    record = recording.record
    values: dict[str, Any] = {
        "file": str(recording.path),
        "format": recording.format,
        "component": recording.component,
        "orientation": recording.orientation,
        "azimuth_deg": recording.azimuth_deg,
        "station": recording.station,
        "event": recording.event,
        "start_time": recording.start_time and recording.start_time.isoformat(),
        "npts": len(record.acceleration_m_s2),
        "dt_s": record.dt_s,
        "duration_s": record.duration_s,
        "units_in_file": recording.units_in_file,
        "stated_peak_m_s2": recording.stated_peak_m_s2,
        **measures.values(),
        "processing": list(recording.processing),
        "warnings": one.warnings,
    }
    if spectrum and one.spectrum is not None:
        found = one.spectrum
        values["spectrum"] = {
            "periods_s": found.periods_s,
            "displacement_m": found.displacement_m,
            "velocity_m_s": found.velocity_m_s,
            "acceleration_m_s2": found.acceleration_m_s2,
            "pseudo_velocity_m_s": found.pseudo_velocity_m_s,
            "pseudo_acceleration_m_s2": found.pseudo_acceleration_m_s2,
        }
    return values


def course_header(unit: str) -> list[str]:
    """Return the columns of a record, its acceleration in a unit."""
    name = unit.replace("/s^2", "_s2").replace("/", "_")
    return ["time_s", f"acceleration_{name}", "velocity_m_s", "displacement_m"]


def course_rows(course: "IntegratedRecord", unit: str) -> Iterator[list[float]]:
    """Yield a record sample by sample, its acceleration in a unit."""
    from rocksteady.records.core.units import UNITS

    columns = (
        course.t_s,
        course.acceleration_m_s2 / UNITS[unit],
        course.velocity_m_s,
        course.displacement_m,
    )
    for row in zip(*columns, strict=True):
        yield [float(value) for value in row]


def print_one(one: Description) -> None:
    """Print a record: its metadata, its warnings and its measures."""
    from rich.table import Table
    from rich.text import Text

    console = terminal.console()
    recording, record = one.recording, one.recording.record
    about = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    about.add_column(no_wrap=True)
    about.add_column(overflow="fold")
    about.add_row("record", Text(printable(one.title), style="bold"))
    about.add_row("file", f"{printable(recording.path.name)} ({recording.format})")
    about.add_row(
        "samples",
        f"{len(record.acceleration_m_s2)} every {record.dt_s:g} s, {record.duration_s:g} s, in "
        f"{recording.units_in_file}",
    )
    if recording.stated_peak_m_s2 is not None:
        about.add_row("peak stated", f"{recording.stated_peak_m_s2:.5g} m/s^2")
    for done in recording.processing:
        about.add_row("processing", done)
    console.print(about)
    console.print()
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(no_wrap=True)
    table.add_column(justify="right", no_wrap=True)
    table.add_column(no_wrap=True)
    for words, value, unit in one.measures.rows():
        table.add_row(words, f"{value:.5g}", unit)
    console.print(table)
    console.print(
        f"The ground begins at rest; 1 g is {STANDARD_GRAVITY} m/s^2; bracketed and uniform above "
        f"{one.measures.threshold_m_s2 / STANDARD_GRAVITY:g} g; Housner intensity at "
        f"{one.measures.damping:.3g} of critical damping.",
        style="dim",
    )


def print_spectrum(spectrum: "ResponseSpectrum") -> None:
    """Print a row a period."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for heading in ("T s", "PSA g", "Sa g", "PSV m/s", "Sv m/s", "Sd m"):
        table.add_column(heading, justify="right", no_wrap=True)
    columns = (
        spectrum.periods_s,
        spectrum.pseudo_acceleration_m_s2 / STANDARD_GRAVITY,
        spectrum.acceleration_m_s2 / STANDARD_GRAVITY,
        spectrum.pseudo_velocity_m_s,
        spectrum.velocity_m_s,
        spectrum.displacement_m,
    )
    for row in zip(*(column.tolist() for column in columns), strict=True):
        table.add_row(*(f"{value:.5g}" for value in row))
    console = terminal.console()
    console.print()
    console.print(table)
    console.print(f"Damping {spectrum.damping:.3g} of critical.", style="dim")


def print_table(found: Sequence[Description]) -> None:
    """Print a row a record."""
    from rich.table import Table

    console = terminal.console()
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("record", overflow="fold")
    headings = ("samples", "dt s", "PGA g", "PGV m/s", "Arias m/s", "D5-95 s")
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    for one in found:
        record, measures = one.recording.record, one.measures
        table.add_row(
            printable(one.name),
            str(len(record.acceleration_m_s2)),
            f"{record.dt_s:g}",
            f"{measures.pga_g:.4f}",
            f"{measures.pgv_m_s:.4f}",
            f"{measures.arias_m_s:.4f}",
            f"{measures.significant_5_95_s:.2f}",
        )
    console.print(table)
