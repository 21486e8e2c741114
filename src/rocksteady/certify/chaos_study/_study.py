"""The whole study: chaos proved at two points and over a map of boxes, and its output folder."""

import math
from dataclasses import dataclass
from functools import partial
from itertools import pairwise, product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady import Execution, __version__
from rocksteady.arrays import Floats, Integers
from rocksteady.formulas import heteroclinic_amplitude, symmetry_breaking_amplitude
from rocksteady.proofs import Certificate, certify_chaos, check_certificate
from rocksteady.results.description import Fact, line
from rocksteady.show.export.files import FORMATS, json_text, picture_files, save_csv, save_text
from rocksteady.show.report import render, twins
from rocksteady.show.study.environment import Done, environment, nothing
from rocksteady.show.study.parts import Parts
from rocksteady.show.study.saving import Saved
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.show.style.palette import LABELS
from rocksteady.show.style.tokens import HATCHES, inks_of
from rocksteady.sweeps import Axis, Grid, Output, evaluate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA = "rocksteady/chaos/1"
OURS = rf"(map|rocking)\.({'|'.join(FORMATS)}|csv)|(hilltop|homoclinic|chaos)\.json|chaos\.html"
"""Names of the files, as a regular expression."""
CASES: dict[Any, tuple[str, str]] = {"hilltop": ("2", "2"), "homoclinic": ("2.698", "2")}
"""Amplitude and frequency ratio of each proof at a point."""
EDGES = np.linspace(0.6, 4.0, 35), np.linspace(1.0, 3.0, 21)
"""Default ends of the boxes of the map: amplitudes, and frequency ratios."""
STRIP = np.linspace(1.16, 1.4, 13), np.linspace(1.5, 2.4, 10)
"""Default amplitudes over that at which symmetry breaks, and frequency ratios, of small boxes."""
AXES: dict[str, Any] = {"xlabel": LABELS["frequency_ratio"], "ylabel": LABELS["amplitude"]}
HALF_WIDTH = 1e-5
"""Half-width of a small box over its centre, in both parameters."""
WORDS = "Lower bound of the entropy over frequency and amplitude"

Edges = tuple[Floats, Floats]
Range = tuple[float, float]


@dataclass(frozen=True, kw_only=True, eq=False)
class Chaos(Saved):
    """Chaos proved near the hilltops and of the rocking itself.

    Attributes
    ----------
    restitution
        Its decimal.
    points
        The certificates at two points, by kind.
    edges
        Ends of the boxes of the map: amplitudes, and frequency ratios.
    entropy
        Proved entropy per period of each box, a row for each amplitude; 0 where nothing is proved.
    strip
        Centres of small boxes: amplitudes over that at which symmetry breaks, and frequency ratios.
    rocking
        Proved entropy per period of the rocking itself on these, likewise.
    """

    ours = OURS
    steps = 3
    restitution: str
    points: dict[str, Certificate]
    edges: Edges
    entropy: Floats
    strip: Edges
    rocking: Floats

    @property
    def sentences(self) -> list[str]:
        """What is proved, and what is not claimed."""
        proved, whole = np.count_nonzero(self.entropy), self.entropy.size
        points = [each.describe().headline for each in self.points.values()]
        boxes = f"Near the hilltops chaos is proved on {proved} of {whole} boxes."
        proved, whole = np.count_nonzero(self.rocking), self.rocking.size
        small = f"Chaos of the rocking itself is proved on {proved} of {whole} small boxes."
        return [boxes, *points, small, "That other motions settle on these sets is not claimed."]

    @property
    def answer(self) -> tuple[str, list[Fact]]:
        """The share of the map, and both points."""
        first, *others = self.sentences
        labels = (*CASES, "rocking", "not claimed")
        return first, [line(*pair) for pair in zip(labels, others, strict=True)]

    def values(self) -> dict[str, Any]:
        """Return the key numbers as plain values: what ``chaos.json`` holds."""
        return {
            "version": __version__,
            "restitution": self.restitution,
            "points": {name: each.to_dict() for name, each in self.points.items()},
            "edges": [axis.tolist() for axis in self.edges],
            "entropy_per_period": self.entropy.tolist(),
            "strip": [axis.tolist() for axis in self.strip],
            "rocking_per_period": self.rocking.tolist(),
            "sentences": self.sentences,
        }

    def figure(self, page: Page = SCREEN) -> "Figure":
        """Return the map: what is proved, hatched where nothing is, and A_het."""
        (first, *_, last), up = self.edges[1], self.edges[0][[0, -1]]
        across = np.linspace(first, last, 200)
        level = heteroclinic_amplitude(across, float(self.restitution))
        with page.figure(7.2, 4.6, "") as figure:
            axes = figure.subplots()
            axes.axhspan(*up, fill=False, hatch=HATCHES["undecided"], ec=inks_of(axes).edge, lw=0)
            shown = np.ma.masked_equal(self.entropy, 0.0)
            drawn = axes.pcolormesh(*self.edges[::-1], shown, cmap="cividis", rasterized=True)
            axes.plot(across, level, c=inks_of(axes).ink, label="$A_{het}$")
            figure.colorbar(drawn, label="entropy per period, at least")
            axes.set(**AXES, xlim=across[[0, -1]], ylim=up)
            axes.legend(loc="upper left", frameon=True)
        return figure

    def rocking_figure(self, page: Page = SCREEN) -> "Figure":
        """Return the small boxes: filled where chaos is proved, and where symmetry breaks."""
        levels, ratios = self.strip
        across = np.linspace(ratios[0], ratios[-1], 200)
        breaks = partial(symmetry_breaking_amplitude, restitution=float(self.restitution))
        amplitudes = (levels[:, np.newaxis] * breaks(ratios)).ravel()
        places, shown = np.tile(ratios, len(levels)), self.rocking.ravel()
        with page.figure(7.2, 4.6, "") as figure:
            axes = figure.subplots()
            ink, proved = inks_of(axes).ink, shown > 0.0
            open_, filled = ((places[each], amplitudes[each]) for each in (~proved, proved))
            axes.scatter(*open_, s=9, fc="none", ec=ink, lw=0.5, label="nothing proved")
            drawn = axes.scatter(*filled, c=shown[proved], marker="s", s=12, cmap="cividis")
            drawn.set_label("chaos proved")
            axes.plot(across, breaks(across), c=ink, label="symmetry breaks")
            figure.colorbar(drawn, label="entropy per period, at least")
            axes.set(**AXES)
            axes.legend(loc="upper left", frameon=True)
        return figure

    def write(self, stage: Path, done: Done) -> None:
        """Write every file into a hidden folder, the certificates checked from their files."""
        checks = []
        for name, each in self.points.items():
            if each.proved:
                save_text("out", file := stage / f"{name}.json", each.to_json())
                for arithmetic in ("arb", "iv"):
                    verdict = check_certificate(file, arithmetic=arithmetic).verdict
                    checks.append((file.name, arithmetic, verdict))
        header = ("amplitude_low", "amplitude_high", "ratio_low", "ratio_high", "entropy")
        restitution, pictures = self.restitution, {}
        for name, draw, boxes, entropy in (
            ("map", self.figure, product(*map(pairwise, self.edges)), self.entropy),
            ("rocking", self.rocking_figure, small_boxes(self.strip, restitution), self.rocking),
        ):
            rows = [(*a, *w, value) for (a, w), value in zip(boxes, entropy.ravel(), strict=True)]
            save_csv("out", stage / f"{name}.csv", header, rows)
            for kind, data in picture_files(draw()).items():
                (stage / f"{name}.{kind}").write_bytes(data)
            pictures[name] = twins(draw, WORDS)
            done(name)
        shown = {"study": self, "pictures": pictures, "checks": checks}
        save_text("out", stage / "chaos.json", json_text(SCHEMA, self.values(), indent=1) + "\n")
        ran = {"environment": environment(), "version": __version__}
        page = render(__package__, "chaos.html.j2", **shown, **ran)
        save_text("out", stage / "chaos.html", page)
        done("page")


def chaos(
    restitution: str = "0.8",
    edges: Edges = EDGES,
    strip: Edges = STRIP,
    *,
    parts: Parts | None = None,
    done: Done = nothing,
) -> Chaos:
    """Prove chaos at two points, near the hilltops over a map of boxes, and on small boxes.

    Parameters
    ----------
    restitution
        Its decimal.
    edges
        Ends of the boxes of the map: amplitudes, and frequency ratios.
    strip
        Centres of small boxes: amplitudes over that at which symmetry breaks, and frequency ratios.
    parts
        Where finished boxes are kept, to go on with after an interruption.
    done
        Called with the name of each step.
    """
    if parts is not None:
        parts.begin()
    points = {kind: certify_chaos(*at, restitution, kind=kind) for kind, at in CASES.items()}
    done("points")

    def told(boxes: int) -> None:
        for _ in range(boxes):
            done("box")

    def entropy(kind: str, boxes: list[tuple[Range, Range]], columns: int) -> Floats:
        run = Execution(
            executor="serial",  # the precision of balls is one for all threads
            store=None if parts is None else parts.store(kind, columns),
            progress=told,
        )
        cases = partial(entropies, restitution=restitution, kind=kind, boxes=boxes)
        grid = Grid(axes=[Axis(name="box", values=np.arange(len(boxes)))])
        values = evaluate(cases, grid, [Output(name="entropy")], run=run)["entropy"].values
        return np.reshape(values, (-1, columns))

    up, across = (list(pairwise(axis.tolist())) for axis in edges)
    pairs = list(product(up, across))
    return Chaos(
        restitution=restitution,
        points=points,
        edges=edges,
        entropy=entropy("hilltop", pairs, len(edges[1]) - 1),
        strip=strip,
        rocking=entropy("homoclinic", small_boxes(strip, restitution), len(strip[1])),
    )


def small_boxes(strip: Edges, restitution: str) -> list[tuple[Range, Range]]:
    """Return small boxes around centres, a row for each level: their amplitudes and ratios."""
    breaks = symmetry_breaking_amplitude(strip[1], float(restitution)).tolist()

    def around(centre: float) -> Range:
        return centre * (1.0 - HALF_WIDTH), centre * (1.0 + HALF_WIDTH)

    columns = list(zip(breaks, strip[1].tolist(), strict=True))
    return [(around(level * at), around(w)) for level in strip[0].tolist() for at, w in columns]


def steps(edges: Edges = EDGES, strip: Edges = STRIP) -> int:
    """Return the number of times that `chaos` reports progress."""
    return 1 + math.prod(len(axis) - 1 for axis in edges) + math.prod(map(len, strip))


def entropies(
    box: Integers, *, restitution: str, kind: Any, boxes: list[tuple[Range, Range]]
) -> dict[str, Floats]:
    """Return the proved entropy of boxes, 0 where nothing is proved.

    Parameters
    ----------
    box
        Their numbers.
    restitution, kind
        As for `certify_chaos`.
    boxes
        Ends of the amplitudes and of the frequency ratios of all boxes.
    """
    each = (boxes[number] for number in box.astype(int).tolist())
    proofs = (certify_chaos(a, w, restitution, kind=kind) for a, w in each)
    claims = (proof.content["claim"] if proof.proved else {} for proof in proofs)
    return {"entropy": np.array([float(claim.get("entropy_per_period", 0)) for claim in claims])}


def parts_of(restitution: str, folder: Path | str, *, resume: bool, force: bool) -> Parts:
    """Return the finished parts of the study in its folder; arguments as for `Parts`."""
    inputs = {"study": "chaos", "restitution": restitution}
    return Parts(folder, inputs, resume=resume, force=force)
