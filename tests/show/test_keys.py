"""Keys: what a legend explains is drawn, and lies within the limits of the axes."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import Collection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

from rocksteady.show.style.tokens import LIGHT
from tests.show.seen import form_of
from tests.show.test_visual_language import SHAPES, drawn


def colours_of(artist: Any) -> set[str]:
    """Return the colours of what an artist fills, marks and draws."""
    if isinstance(artist, Line2D):
        return {
            str(to_hex(each))
            for each in (artist.get_color(), artist.get_markerfacecolor())
            if not (isinstance(each, str) and each == "none")
        } | {to_hex(artist.get_markeredgecolor())}
    if isinstance(artist, AxesImage) or (
        isinstance(artist, Collection) and artist.get_array() is not None
    ):
        return {to_hex(each) for each in artist.to_rgba(np.ma.asarray(artist.get_array()).compressed())}
    faces = [*np.atleast_2d(artist.get_facecolor()), *np.atleast_2d(artist.get_edgecolor())]
    return {to_hex(each) for each in faces if len(each)}


def is_in(artist: Artist, axes: Axes) -> bool:
    """Return whether a part of an artist lies within its axes."""
    if isinstance(artist, Line2D):
        places = artist.get_transform().transform(artist.get_xydata())
        places = places[np.isfinite(places).all(axis=1)]
        box = axes.bbox.padded(1.0)
        return len(places) > 0 and bool(
            (places.max(axis=0) >= box.min).all() and (places.min(axis=0) <= box.max).all()
        )
    return artist.get_window_extent().padded(0.5).overlaps(axes.bbox)


def drawn_colours(figure: Figure) -> set[str]:
    """Return all colours that are seen in the axes of a figure."""
    found: set[str] = set()
    for axes in figure.findobj(Axes):
        _ = axes.viewLim  # which settles what is scaled to the data
        for artist in [*axes.lines, *axes.patches, *axes.collections, *axes.images]:
            if artist.get_visible() and is_in(artist, axes):
                found |= colours_of(artist)
    return found


def keys_of(figure: Figure) -> Iterator[tuple[str, str]]:
    """Yield the words of each entry of a legend with its colour."""
    for legend in figure.findobj(Legend):
        for handle, text in zip(legend.legend_handles, legend.get_texts(), strict=True):
            colour = form_of(handle)[1]
            if colour != "none" and text.get_text() not in SHAPES:
                yield text.get_text(), colour


@pytest.mark.slow
def test_what_a_key_explains_is_drawn_within_the_limits() -> None:
    scale = {*LIGHT.risk_ramp, *LIGHT.rocks_ramp}  # whose keys have all steps
    missing = []
    for name, figure in drawn():
        seen = scale | drawn_colours(figure)
        missing += [f"{name}: {words}" for words, colour in keys_of(figure) if colour not in seen]
    assert "\n".join(missing) == ""
