"""The whole atlas: its computations in order, and its output folder."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from rocksteady import Execution, __version__
from rocksteady.results.description import Fact
from rocksteady.show.export.files import FORMATS, json_text, picture_files, save_csv, save_text
from rocksteady.show.report import svg_data_uri
from rocksteady.show.study.environment import Done, environment, nothing
from rocksteady.show.study.parts import Parts
from rocksteady.show.study.saving import Saved
from rocksteady.studies.atlas.analysis.coexistence import Coexistence, coexistence
from rocksteady.studies.atlas.analysis.columns import columns
from rocksteady.studies.atlas.analysis.families import FamilyMap, family_map
from rocksteady.studies.atlas.analysis.from_rest import MARKED, PARTS, FromRest, from_rest, in_steps
from rocksteady.studies.atlas.analysis.lines import Line, family_lines
from rocksteady.studies.atlas.analysis.plane import AMPLITUDES, FREQUENCY_RATIOS, ORDERS, Plane
from rocksteady.studies.atlas.analysis.windows import Window, windows
from rocksteady.studies.atlas.pages import tables
from rocksteady.studies.atlas.pages.findings import (
    BandsAt,
    atlas_answer,
    bands_at,
    coexistence_sentences,
    coexistence_values,
    family_values,
    rest_sentences,
    rest_values,
    window_values,
)
from rocksteady.studies.atlas.pages.pictures import draw_coexistence, draw_families, draw_from_rest
from rocksteady.studies.atlas.pages.report import command, report_html

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA = "rocksteady/atlas/1"
PICTURES = ("families", "coexistence", "from-rest")
CELLS = 64
"""Of the search for coexisting motions that take about as long as another step."""
COLUMNS = 8
"""Of a family that are kept at once."""
TABLES = ("bands", "borders", "coexistence", "from-rest")
OURS = (
    rf"({'|'.join(PICTURES)})\.({'|'.join(FORMATS)})|({'|'.join(TABLES)})\.csv|atlas\.(json|html)"
)
"""Names of the files, as a regular expression."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Atlas(Saved):
    """The plane of frequency and amplitude for one restitution.

    Attributes
    ----------
    plane
        Where.
    families
        The bands of each family, with exact ends.
    bands
        The bands at some frequencies, as the page's table has them.
    lines
        The borders of the bands as curves.
    found
        What stands side by side, by a search.
    strips
        Windows of stable motions with more impacts that the search has come upon.
    rest
        What a block at rest settles to.
    seconds
        Run time of the computation [s].
    """

    ours = OURS
    plane: Plane
    families: tuple[FamilyMap, ...]
    bands: tuple[BandsAt, ...]
    lines: tuple[Line, ...]
    found: Coexistence
    strips: tuple[Window, ...]
    rest: FromRest
    seconds: float

    @property
    def sentences(self) -> list[str]:
        """What the search shows."""
        return [*coexistence_sentences(self.found), *rest_sentences(self.rest, None)[:1]]

    @property
    def answer(self) -> tuple[str, list[Fact]]:
        """Share of the plane with several motions, and the fates of a block at rest."""
        return atlas_answer(self.found, self.rest)

    @property
    def steps(self) -> int:
        """Number of times that `save` reports progress."""
        return len(PICTURES) + 1

    def values(self) -> dict[str, Any]:
        """Return the key numbers as plain values: what ``atlas.json`` holds."""
        plane = self.plane
        ends = ("frequency_ratio_from", "frequency_ratio_to", "amplitude_from", "amplitude_to")
        return {
            "version": __version__,
            "restitution": plane.restitution,
            "orders": list(plane.orders),
            "window": dict(zip(ends, plane.window, strict=True)),
            "cells": {"amplitude": len(plane.amplitudes), "frequency_ratio": len(plane.ratios)},
            "families": [family_values(family, self.lines) for family in self.families],
            "bands": [vars(band) for band in self.bands],
            "windows": [window_values(window) for window in self.strips],
            "coexistence": coexistence_values(self.found),
            "from_rest": rest_values(self.rest),
            "figures": [f"{name}.{kind}" for name in PICTURES for kind in FORMATS],
            "tables": [f"{name}.csv" for name in TABLES],
        }

    def write(self, stage: Path, done: Done) -> None:
        """Write every file into a hidden folder."""
        began = time.perf_counter()
        every = (*self.lines, *(line for window in self.strips for line in window.lines))
        for name, table in (
            ("bands", tables.bands_table(self.families)),
            ("borders", tables.lines_table(every)),
            ("coexistence", tables.coexistence_table(self.found)),
            ("from-rest", tables.rest_table(self.rest)),
        ):
            save_csv("out", stage / f"{name}.csv", *table)
        pictures, made_by = {}, command(self.plane)
        drawings: tuple[Callable[[], Figure], ...] = (
            lambda: draw_families(self.families, self.lines, self.strips),
            lambda: draw_coexistence(self.found, self.families, self.lines),
            lambda: draw_from_rest(self.rest, self.lines),
        )
        for name, draw in zip(PICTURES, drawings, strict=True):
            files = picture_files(draw(), command=made_by)
            for kind, data in files.items():
                (stage / f"{name}.{kind}").write_bytes(data)
            pictures[name] = svg_data_uri(files["svg"])
            done(name)
        save_text("out", stage / "atlas.json", json_text(SCHEMA, self.values(), indent=1) + "\n")
        page = report_html(
            families=self.families,
            bands=self.bands,
            lines=self.lines,
            coexisting=self.found,
            strips=self.strips,
            rest=self.rest,
            pictures=pictures,
            seconds=self.seconds + time.perf_counter() - began,
            version=__version__,
            environment=environment(),
        )
        save_text("out", stage / "atlas.html", page)
        done("page")


def plane_of(
    restitution: float = 0.8,
    *,
    amplitude: ArrayLike | None = None,
    frequency_ratio: ArrayLike | None = None,
    orders: tuple[int, ...] = ORDERS,
) -> Plane:
    """Return the plane of an atlas; arguments as for `atlas`."""
    return Plane(
        restitution=restitution,
        amplitude=AMPLITUDES if amplitude is None else amplitude,
        frequency_ratio=FREQUENCY_RATIOS if frequency_ratio is None else frequency_ratio,
        orders=orders,
    )


def atlas(
    restitution: float = 0.8,
    *,
    amplitude: ArrayLike | None = None,
    frequency_ratio: ArrayLike | None = None,
    orders: tuple[int, ...] = ORDERS,
    run: Execution | None = None,
    parts: Parts | None = None,
    done: Done = nothing,
) -> Atlas:
    """Compute the plane of frequency and amplitude: stable regions, coexistence, fates from rest.

    Parameters
    ----------
    restitution
        Ratio of angular velocities, in (0, 1).
    amplitude
        A = a_max/(alpha g), the rows: evenly spaced, above 0; without, .08 to 8 in 100 steps.
    frequency_ratio
        Omega = omega/p, the columns: likewise; without, .075 to 12 in 160 steps.
    orders
        n of the families whose regions are followed, odd.
    run
        Executor and number of workers; by default `Execution()`.  `parts` and `done` are in the
        place of its store and its progress.
    parts
        Where what is finished is kept, to go on with after an interruption.
    done
        Called with the name of each step.

    Returns
    -------
    Atlas
        Nothing is drawn or written yet; see `Atlas.save`.

    Raises
    ------
    InputError
        If a value is outside its range, or an axis is not evenly spaced.
    ModelError
        If the run has a store.

    Examples
    --------
    >>> result = atlas(0.8, amplitude=[1.5, 2.5, 3.5], frequency_ratio=[2.0, 4.0, 6.0], orders=(1,))
    >>> print(result.found.motions)
    [[1 2 1]
     [1 2 2]
     [0 1 2]]
    """
    plane = plane_of(
        restitution, amplitude=amplitude, frequency_ratio=frequency_ratio, orders=orders
    )
    how = replace(
        (run or Execution()).in_memory("an atlas keeps its cells in its parts"), progress=None
    )
    began = time.perf_counter()
    if parts is not None:
        parts.begin()

    def kept(name: str, chunk: int) -> Execution:
        return how if parts is None else replace(how, store=parts.store(name, chunk))

    families = tuple(
        family_map(plane, order, run=kept(f"columns-{order}", COLUMNS), done=done)
        for order in plane.orders
    )
    lines: list[Line] = []
    bands: list[BandsAt] = []
    for family in families:
        order = family.order
        lines += family_lines(family)
        if marked(plane):
            at_marks = columns(plane, order, marked(plane), run=kept(f"marked-{order}", COLUMNS))
            bands += [bands_at(column, order) for column in at_marks]
        done(f"borders, n = {order}")
    beside = in_steps(1, CELLS, lambda _: done("side by side"))
    coexisting = coexistence(plane, run=replace(kept("coexistence", CELLS), progress=beside))
    strips = windows(coexisting)
    done("windows")
    rest = from_rest(plane, run=how, parts=parts, done=done)
    return Atlas(
        plane=plane,
        families=families,
        bands=tuple(bands),
        lines=tuple(lines),
        found=coexisting,
        strips=strips,
        rest=rest,
        seconds=time.perf_counter() - began,
    )


def parts_of(plane: Plane, folder: Path | str, *, resume: bool, force: bool) -> Parts:
    """Return the finished parts of an atlas in its folder; arguments as for `Parts`."""
    inputs = {
        "study": "atlas",
        "restitution": plane.restitution,
        "amplitude": plane.amplitudes,
        "frequency_ratio": plane.ratios,
        "orders": plane.orders,
    }
    return Parts(folder, inputs, resume=resume, force=force)


def marked(plane: Plane) -> list[float]:
    """Return the frequency ratios of the page's tables that lie in the plane."""
    left, right = plane.window[:2]
    return [ratio for ratio in MARKED if left <= ratio <= right]


def steps(plane: Plane) -> int:
    """Return the number of times that `atlas` reports progress."""
    searched = len(plane.amplitudes) * len(plane.ratios) // CELLS
    return len(plane.orders) * (len(plane.ratios) + 1) + searched + 1 + PARTS
