"""The whole study: bare walls checked in three ways, and its output folder."""

import struct
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady import Execution, Record, __version__
from rocksteady.results.answer import Answer
from rocksteady.show.export.files import (
    FORMATS,
    json_text,
    picture_files,
    save_csv,
    save_text,
    schema_of,
)
from rocksteady.show.report import render, twins
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.studies.facade_checks import _tables
from rocksteady.studies.facade_checks._checked_walls import (
    CheckedWalls,
    checked_walls,
    steps,
)
from rocksteady.studies.facade_checks._findings import (
    level_values,
    reasons,
    sentences,
    variant_values,
    worked_values,
)
from rocksteady.studies.facade_checks._pictures import ratio_figure, verdict_figure, worked_figure
from rocksteady.studies.facade_checks._plane import HEIGHTS_M, PGA_G, SLENDERNESS, Plane
from rocksteady.studies.facade_checks._worked_walls import FEW, KINDS, WorkedWall, worked_walls
from rocksteady.studies.folder import Done, environment, nothing
from rocksteady.studies.parts import Parts
from rocksteady.studies.saving import Saved

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TABLES = ("walls", "variants")
OURS = (
    rf"(verdicts|ratios|wall-[12])\.({'|'.join(FORMATS)})"
    rf"|({'|'.join(TABLES)})\.csv|facade-checks\.(json|html)"
)
"""Names of the files, as a regular expression."""
KIND_WORDS = {
    "static refuses": "The static check refuses, the dynamic one accepts",
    "dynamic refuses": "The static check accepts, the dynamic one refuses",
}


@dataclass(frozen=True, kw_only=True, eq=False)
class FacadeChecks(Saved):
    """Linear, nonlinear static and dynamic checks of bare walls over slenderness and height.

    Attributes
    ----------
    walls
        The three checks of every wall at every level.
    worked
        A wall of each kind of disagreement, run again; none of a kind that was not found.
    seconds
        Run time of the computation [s].
    """

    ours = OURS
    walls: CheckedWalls
    worked: tuple[WorkedWall, ...]
    seconds: float

    @property
    def pictures(self) -> tuple[str, ...]:
        """Names of the pictures."""
        numbers = range(1, len(self.worked) + 1)
        return ("verdicts", "ratios", *(f"wall-{number}" for number in numbers))

    @property
    def sentences(self) -> list[str]:
        """What the maps show."""
        return sentences(self.walls)

    @property
    def answer(self) -> Answer:
        """On how many walls the checks agree, and which differ."""
        first, *others = self.sentences
        labels = ("dynamic check", "linear check", "one record")
        return Answer(first, list(zip(labels, others, strict=False)))

    @property
    def steps(self) -> int:
        """Number of times that `save` reports progress."""
        return len(self.pictures) + 1

    def values(self) -> dict[str, Any]:
        """Return the key numbers as plain values: what ``facade-checks.json`` holds."""
        plane = self.walls.plane
        return {
            "version": __version__,
            "confidence_factor": plane.confidence_factor,
            "height_m": plane.heights_m.tolist(),
            "slenderness": plane.slendernesses.tolist(),
            "records": list(plane.names),
            "synthetic": plane.synthetic,
            "levels": level_values(self.walls),
            "variants_pga_g": float(plane.levels_g[plane.middle]),
            "variants": variant_values(self.walls),
            "worked": [worked_values(wall) for wall in self.worked],
            "sentences": self.sentences,
            "figures": [f"{name}.{kind}" for name in self.pictures for kind in FORMATS],
            "tables": [f"{name}.csv" for name in TABLES],
        }

    def figure(self, name: str, page: Page = SCREEN) -> "Figure":
        """Return a picture by its name: "verdicts", "ratios", "wall-1" or "wall-2"."""
        if name == "verdicts":
            return verdict_figure(self.walls, self._shown, page=page)
        if name == "ratios":
            return ratio_figure(self.walls, page=page)
        return worked_figure(self.worked[int(name[-1]) - 1], page=page)

    @property
    def _shown(self) -> tuple[WorkedWall, ...]:
        """Worked walls of the whole suite, which have a place in the maps."""
        return tuple(
            wall for wall in self.worked if len(wall.records) == len(self.walls.plane.records)
        )

    def write(self, stage: Path, done: Done) -> None:
        """Write every file into a hidden folder."""
        began = time.perf_counter()
        save_csv("out", stage / "walls.csv", *_tables.walls_table(self.walls))
        save_csv("out", stage / "variants.csv", *_tables.variants_table(self.walls))
        pictures, command = {}, _command(self.walls.plane)
        for name in self.pictures:
            for kind, data in picture_files(self.figure(name), command=command).items():
                (stage / f"{name}.{kind}").write_bytes(data)
            pictures[name] = twins(partial(self.figure, name), "")
            done(name)
        text = json_text(schema_of("facade-checks"), self.values(), indent=1) + "\n"
        save_text("out", stage / "facade-checks.json", text)
        seconds = self.seconds + time.perf_counter() - began
        save_text("out", stage / "facade-checks.html", self._page(pictures, seconds))
        done("page")

    def _page(self, pictures: dict[str, dict[str, str]], seconds: float) -> str:
        """Return the page as the text of one HTML file."""
        plane = self.walls.plane
        kinds = {wall.kind for wall in self.worked}
        worked = []
        for number, wall in enumerate(self.worked, start=1):
            whole = len(wall.records) == len(plane.records)
            worked.append(
                {
                    "number": number,
                    "picture": f"wall-{number}",
                    "heading": KIND_WORDS[wall.kind],
                    "values": worked_values(wall),
                    "records": wall.runs.records if not whole else (),
                    "reasons": reasons(wall),
                }
            )
        return render(
            __package__,
            "facade_checks.html.j2",
            command=_command(plane),
            environment=environment(),
            few=FEW,
            levels=level_values(self.walls),
            missing=[KIND_WORDS[kind].lower() for kind in KINDS if kind not in kinds],
            pictures=pictures,
            plane=plane,
            seconds=seconds,
            sentences=self.sentences,
            variants=variant_values(self.walls),
            variants_pga_g=float(plane.levels_g[plane.middle]),
            version=__version__,
            worked=worked,
        )


def plane_of(
    records: Sequence[Record] = (),
    *,
    height_m: ArrayLike | None = None,
    slenderness: ArrayLike | None = None,
    pga_g: ArrayLike | None = None,
    confidence_factor: float = 1.0,
) -> Plane:
    """Return the walls of a study and their shaking; arguments as for `facade_checks`."""
    return Plane(
        height_m=HEIGHTS_M if height_m is None else height_m,
        slenderness=SLENDERNESS if slenderness is None else slenderness,
        pga_g=PGA_G if pga_g is None else pga_g,
        confidence_factor=confidence_factor,
        records=records,
    )


def facade_checks(
    plane: Plane,
    *,
    run: Execution | None = None,
    parts: Parts | None = None,
    done: Done = nothing,
) -> FacadeChecks:
    """Check bare walls by the linear, nonlinear static and dynamic methods of C8.7.1.

    Parameters
    ----------
    plane
        Walls, records and levels, from `plane_of`.
    run
        Executor and number of workers; by default `Execution()`.  `parts` and `done` are in the
        place of its store and its progress.
    parts
        Where what is finished is kept, to go on with after an interruption.
    done
        Called with the name of each step.

    Returns
    -------
    FacadeChecks
        Nothing is drawn or written yet; see `FacadeChecks.save`.

    Raises
    ------
    InputError
        If a record has too large accelerations, or too many samples.
    ModelError
        If the run has a store.
    """
    how = (run or Execution()).in_memory("a study of facades keeps its cells in its parts")
    how = replace(how, progress=None)
    began = time.perf_counter()
    if parts is not None:
        parts.begin()

    def kept(name: str) -> Execution:
        return how if parts is None else replace(how, store=parts.store(name))

    walls = checked_walls(plane, kept=kept, done=done)
    worked = worked_walls(walls)
    done("worked walls")
    return FacadeChecks(walls=walls, worked=worked, seconds=time.perf_counter() - began)


def study_steps() -> int:
    """Return the number of times that `facade_checks` reports progress."""
    return steps() + 1


def parts_of(plane: Plane, folder: Path | str, *, resume: bool, force: bool) -> Parts:
    """Return the finished parts of a study in its folder; arguments as for `Parts`."""
    inputs = {
        "study": "facade-checks",
        "height_m": plane.heights_m,
        "slenderness": plane.slendernesses,
        "pga_g": plane.levels_g,
        "confidence_factor": plane.confidence_factor,
        "records": [
            [name, _hash(each)] for name, each in zip(plane.names, plane.records, strict=True)
        ],
    }
    return Parts(folder, inputs, resume=resume, force=force)


def _hash(record: Record) -> str:
    """Return a hash of the samples of records, the same in every process."""
    samples = record.acceleration_m_s2.astype("<f8").tobytes()
    return sha256(samples + struct.pack("<d", record.dt_s)).hexdigest()


def _command(plane: Plane) -> str:
    """Return the command that makes the page of a plane again."""
    axes = [f"--height-m {_axis(plane.heights_m)}", f"--slenderness {_axis(plane.slendernesses)}"]
    levels = ",".join(f"{each:.15g}" for each in plane.levels_g.tolist())
    records = [] if plane.synthetic else ["--records FOLDER"]
    return " ".join(
        [
            "rocksteady study facade-checks",
            *records,
            *axes,
            f"--pga-g {levels} --confidence-factor {plane.confidence_factor:.15g} --out DIR",
        ]
    )


def _axis(points: NDArray[np.float64]) -> str:
    """Return an axis as on the command line."""
    first, last, count = float(points[0]), float(points[-1]), len(points)
    if np.allclose(points, np.linspace(first, last, count), rtol=1e-12):
        return f"{first:.15g}:{last:.15g}:{count}"
    return ",".join(f"{each:.15g}" for each in points.tolist())
