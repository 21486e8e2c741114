"""HTML page of an atlas."""

import math
from collections.abc import Sequence

from rocksteady.show.report import render
from rocksteady.studies.atlas.analysis.coexistence import (
    CYCLES,
    PHASES,
    REST_PHASES,
    SPEEDS,
    STEADY,
    Coexistence,
)
from rocksteady.studies.atlas.analysis.families import FamilyMap
from rocksteady.studies.atlas.analysis.from_rest import FromRest
from rocksteady.studies.atlas.analysis.lines import Line
from rocksteady.studies.atlas.analysis.plane import Plane
from rocksteady.studies.atlas.analysis.windows import Window
from rocksteady.studies.atlas.pages.findings import (
    BandsAt,
    coexistence_sentences,
    coexistence_values,
    family_sentences,
    rest_sentences,
    rest_values,
)


def report_html(
    *,
    families: Sequence[FamilyMap],
    bands: Sequence[BandsAt],
    lines: Sequence[Line],
    coexisting: Coexistence,
    strips: Sequence[Window],
    rest: FromRest,
    pictures: dict[str, str],
    seconds: float,
    version: str,
    environment: str,
) -> str:
    """Return the page as the text of one HTML file.

    Parameters
    ----------
    families, bands, lines, coexisting, strips, rest
        What it shows; the attributes of `Atlas`.
    pictures
        Data URI of each picture by its name.
    seconds
        Run time of it all [s].
    version
        The package's version.
    environment
        What it ran on, in one line.
    """
    harmonic = next((family for family in families if family.order == 1), None)
    plane = coexisting.plane
    return render(
        __package__,
        "atlas.html.j2",
        bands=[
            band
            for band in bands
            if not math.isnan(band.symmetric_until) and band.ends_with != "not-followed"
        ],
        coexistence=coexistence_values(coexisting),
        coexistence_texts=coexistence_sentences(coexisting),
        command=command(plane),
        cycles=CYCLES,
        environment=environment,
        falls=rest.falls,
        family_texts=family_sentences(families, lines, strips),
        pictures=pictures,
        plane=plane,
        rest=rest_values(rest),
        rest_texts=rest_sentences(rest, harmonic),
        seconds=seconds,
        starts=REST_PHASES + 2 * len(STEADY) + PHASES * SPEEDS,
        steps=(
            float(plane.ratios[1] - plane.ratios[0]),
            float(plane.amplitudes[1] - plane.amplitudes[0]),
        ),
        version=version,
    )


def command(plane: Plane) -> str:
    """Return the command that makes the page of a plane again."""
    axes = " ".join(
        f"{flag} {points[0]:.15g}:{points[-1]:.15g}:{len(points)}"
        for flag, points in (("-A", plane.amplitudes), ("-W", plane.ratios))
    )
    orders = "".join(f" -n {order}" for order in plane.orders)
    return f"rocksteady study atlas -r {plane.restitution:.15g} {axes}{orders} --out DIR"
