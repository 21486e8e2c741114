"""The page of an atlas."""

import math
from typing import TYPE_CHECKING

from rocksteady.show.report import render
from rocksteady.studies.atlas.coexistence import CYCLES, PHASES, REST_PHASES, SPEEDS, STEADY
from rocksteady.studies.atlas.pages.findings import (
    coexistence_sentences,
    coexistence_values,
    family_sentences,
    rest_sentences,
    rest_values,
)

if TYPE_CHECKING:
    from rocksteady.studies.atlas.study import Atlas


def report_html(
    atlas: "Atlas", *, pictures: dict[str, str], seconds: float, version: str, environment: str
) -> str:
    """Return the page as the text of one HTML file.

    Parameters
    ----------
    atlas
        What it shows.
    pictures
        Data URI of each picture by its name.
    seconds
        Run time of it all [s].
    version
        The package's version.
    environment
        What it ran on, in one line.
    """
    harmonic = next((family for family in atlas.families if family.order == 1), None)
    plane = atlas.plane
    return render(
        __package__,
        "atlas.html.j2",
        atlas=atlas,
        bands=[
            band
            for band in atlas.bands
            if not math.isnan(band.symmetric_until) and band.ends_with != "not-followed"
        ],
        coexistence=coexistence_values(atlas.found),
        coexistence_texts=coexistence_sentences(atlas.found),
        command=command(atlas),
        cycles=CYCLES,
        environment=environment,
        falls=atlas.rest.falls,
        family_texts=family_sentences(atlas.families, atlas.lines, atlas.strips),
        pictures=pictures,
        plane=plane,
        rest=rest_values(atlas.rest),
        rest_texts=rest_sentences(atlas.rest, harmonic),
        seconds=seconds,
        starts=REST_PHASES + 2 * len(STEADY) + PHASES * SPEEDS,
        steps=(
            float(plane.ratios[1] - plane.ratios[0]),
            float(plane.amplitudes[1] - plane.amplitudes[0]),
        ),
        version=version,
    )


def command(atlas: "Atlas") -> str:
    """Return the command that makes the page again."""
    plane = atlas.plane
    axes = " ".join(
        f"{flag} {points[0]:.15g}:{points[-1]:.15g}:{len(points)}"
        for flag, points in (("-A", plane.amplitudes), ("-W", plane.ratios))
    )
    orders = "".join(f" -n {order}" for order in plane.orders)
    return f"rocksteady study atlas -r {plane.restitution:.15g} {axes}{orders} --out DIR"
