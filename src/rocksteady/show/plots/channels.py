"""Plot of the channels of a station, one above the other."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.record import Record
from rocksteady.records.core.recording import Recording
from rocksteady.records.pairing import RecordSet
from rocksteady.results.numbers import number
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import line_scale, text_size
from rocksteady.show.style.line_ends import write_beside
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

APART = 2.2
"""Distance of two channels over the largest acceleration of all."""
LONGEST = 22
"""Letters of the name of a channel."""


@checked
def plot_channels(channels: RecordSet | Sequence[Record], ax: "Axes | None" = None) -> "Axes":
    """Draw the accelerations of all channels of a station, one above the other.

    All have one scale, and the peak of each stands beside it. Channels are shifted to their own
    start where all state it.

    Parameters
    ----------
    channels
        From `rocksteady.records.pair_records`; or records, which begin together.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: seconds since the first sample, and a row for each channel; an ordinate is
        acceleration [g], less 2.2 times the largest for each channel above.

    Raises
    ------
    ModelError
        If there is no channel.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record
    >>> east = Record(acceleration_m_s2=[0.0, 3.0, -2.0, 0.0], dt_s=0.1, name="east")
    >>> axes = plot_channels([east, east.scaled(0.5)], Figure().add_subplot())
    >>> [text.get_text() for text in axes.texts]
    ['peak 0.306 g', 'peak 0.153 g']
    """
    rows = list(_rows(channels))
    if not rows:
        valid, hint = "a picture takes one or more", "pair records first"
        raise ModelError("channels", Words("are none"), valid, hint)
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 8.0)
    peaks = [record.peak_acceleration_m_s2 / STANDARD_GRAVITY for _, _, record in rows]
    feet = [-row * APART * max(peaks) for row in range(len(rows))]
    ends = []
    for (_, start, record), foot, peak in zip(rows, feet, peaks, strict=True):
        values = record.acceleration_m_s2 / STANDARD_GRAVITY
        times = start + record.dt_s * np.arange(len(values))
        axes.axhline(foot, color=inks.hair, lw=0.6, zorder=1.0)
        axes.plot(times, values + foot, color=inks.base, lw=0.8 * line_scale(axes))
        write_beside(axes, f"peak {number(peak)} g", foot, inks.ink, small, of_row=True)
        ends.append(float(times[-1]))
    axes.set_yticks(feet, [literal(palette.shortened(name, LONGEST)) for name, _, _ in rows])
    axes.tick_params(axis="y", length=0.0)
    axes.grid(visible=False, axis="y")
    half = 0.5 * APART * max(peaks)
    axes.set(xlabel=palette.LABELS["seconds"], xlim=(0.0, max(ends)), ylim=(feet[-1] - half, half))
    return axes


def _rows(channels: RecordSet | Sequence[Record]) -> Iterator[tuple[str, float, Record]]:
    """Yield name, start [s] and record of each channel."""
    if isinstance(channels, RecordSet):
        for each, start in zip(channels.recordings, channels.starts_s, strict=True):
            yield _direction(each), start, each.record
        return
    for place, record in enumerate(channels):
        yield record.name or f"record {place + 1}", 0.0, record


def _direction(channel: Recording) -> str:
    """Return the direction of a channel in words, else the name of its file."""
    if channel.azimuth_deg is not None:
        way = "azimuth" if channel.orientation == "unknown" else channel.orientation
        return f"{way} {channel.azimuth_deg:g}°"
    words = ("" if channel.orientation == "unknown" else channel.orientation, channel.component)
    return " ".join(word for word in words if word) or channel.path.stem
