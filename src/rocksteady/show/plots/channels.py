"""Plot of the channels of a station, one above the other."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.block import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
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
def plot_channels(channels: RecordSet, ax: "Axes | None" = None) -> "Axes":
    """Draw the accelerations of all channels of a station, one above the other.

    All have one scale, and the peak of each stands beside it. Channels are shifted to their own
    start where all state it.

    Parameters
    ----------
    channels
        From `rocksteady.records.pair_records`.
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
    >>> from pathlib import Path
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record
    >>> from rocksteady.records import Recording, RecordSet
    >>> east = Recording(
    ...     record=Record(acceleration_m_s2=[0.0, 3.0, -2.0, 0.0], dt_s=0.1),
    ...     format="csv",
    ...     path=Path("hut.csv"),
    ...     units_in_file="m/s2",
    ...     component="E",
    ... )
    >>> axes = plot_channels(RecordSet(name="hut", horizontal=(east,)), Figure().add_subplot())
    >>> [name.get_text() for name in axes.get_yticklabels()], axes.texts[0].get_text()
    (['E'], 'peak 0.306 g')
    """
    recordings = channels.recordings
    if not recordings:
        raise ModelError(
            "channels",
            Words("are none"),
            "a picture takes one or more",
            "pair records first",
        )
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 8.0)
    peaks = [each.record.peak_acceleration_m_s2 / STANDARD_GRAVITY for each in recordings]
    step = APART * max(peaks)
    end = 0.0
    for row, (each, start, peak) in enumerate(
        zip(recordings, channels.starts_s, peaks, strict=True)
    ):
        foot = -row * step
        values = each.record.acceleration_m_s2 / STANDARD_GRAVITY
        times = start + each.record.dt_s * np.arange(len(values))
        axes.axhline(foot, color=inks.hair, lw=0.6, zorder=1.0)
        axes.plot(times, values + foot, color=inks.base, lw=0.8 * line_scale(axes))
        write_beside(axes, f"peak {number(peak)} g", foot, inks.ink, small, of_row=True)
        end = max(end, float(times[-1]))
    names = [literal(palette.shortened(_name(each), LONGEST)) for each in recordings]
    axes.set_yticks([-row * step for row in range(len(names))], names)
    axes.tick_params(axis="y", length=0.0)
    axes.grid(visible=False, axis="y")
    axes.set(
        xlabel=palette.LABELS["seconds"],
        xlim=(0.0, end),
        ylim=(-(len(names) - 0.5) * step, 0.5 * step),
    )
    return axes


def _name(channel: Recording) -> str:
    """Return the direction of a channel in words, else the name of its file."""
    words = (channel.orientation, channel.component)
    return " ".join(word for word in words if word) or channel.path.stem
