"""The whole study: chaos proved at two points and over a map of boxes, and its output folder."""

import math
from dataclasses import dataclass
from functools import partial
from itertools import pairwise, product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady import Execution, __version__
from rocksteady.arrays import Floats
from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.proofs import Certificate, certify_chaos, check_certificate
from rocksteady.results.answer import Answer
from rocksteady.show.export.files import figure_bytes, json_text, save_csv, save_text
from rocksteady.show.report import render, twins
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.show.style.tokens import HATCHES, inks_of
from rocksteady.studies.folder import Done, environment, nothing
from rocksteady.studies.parts import Parts
from rocksteady.studies.saving import Saved
from rocksteady.sweeps import Axis, Grid, Output, evaluate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA = "rocksteady/chaos/1"
OURS = r"map\.(png|svg|pdf|csv)|(hilltop|homoclinic|chaos)\.json|chaos\.html"
"""Names of the files, as a regular expression."""
CASES: dict[Any, tuple[str, str]] = {"hilltop": ("2", "2"), "homoclinic": ("2.698", "2")}
"""Amplitude and frequency ratio of each proof at a point."""
AXES = "amplitude", "frequency_ratio"
EDGES = np.linspace(0.6, 4.0, 35), np.linspace(1.0, 3.0, 21)
"""Default ends of the boxes of the map: amplitudes, and frequency ratios."""
WORDS = "Lower bound of the entropy over frequency and amplitude"

Edges = tuple[Floats, Floats]


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
    """

    ours = OURS
    steps = 2
    restitution: str
    points: dict[str, Certificate]
    edges: Edges
    entropy: Floats

    @property
    def sentences(self) -> list[str]:
        """What is proved, and what is not claimed."""
        proved, whole = np.count_nonzero(self.entropy), self.entropy.size
        points = [each.describe().headline for each in self.points.values()]
        boxes = f"Near the hilltops chaos is proved on {proved} of {whole} boxes."
        return [boxes, *points, "That other motions settle on these sets is not claimed."]

    @property
    def answer(self) -> Answer:
        """The share of the map, and both points."""
        first, *others = self.sentences
        return Answer(first, list(zip((*CASES, "not claimed"), others, strict=True)))

    def values(self) -> dict[str, Any]:
        """Return the key numbers as plain values: what ``chaos.json`` holds."""
        return {
            "version": __version__,
            "restitution": self.restitution,
            "points": {name: each.to_dict() for name, each in self.points.items()},
            "edges": [axis.tolist() for axis in self.edges],
            "entropy_per_period": self.entropy.tolist(),
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
            axes.set(xlabel=r"$\Omega=\omega/p$", ylabel="$A$", xlim=across[[0, -1]], ylim=up)
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
        rows = zip(product(*map(pairwise, self.edges)), self.entropy.ravel(), strict=True)
        save_csv("out", stage / "map.csv", header, [(*a, *w, value) for (a, w), value in rows])
        for kind in ("png", "svg", "pdf"):
            (stage / f"map.{kind}").write_bytes(figure_bytes(self.figure(), kind))
        shown = {"study": self, "picture": twins(self.figure, WORDS), "checks": checks}
        done("map")
        save_text("out", stage / "chaos.json", json_text(SCHEMA, self.values(), indent=1) + "\n")
        ran = {"environment": environment(), "version": __version__}
        page = render(__package__, "chaos.html.j2", **shown, **ran)
        save_text("out", stage / "chaos.html", page)
        done("page")


def chaos(
    restitution: str = "0.8",
    edges: Edges = EDGES,
    *,
    parts: Parts | None = None,
    done: Done = nothing,
) -> Chaos:
    """Prove chaos at two points, and near the hilltops over a map of boxes.

    Parameters
    ----------
    restitution
        Its decimal.
    edges
        Ends of the boxes of the map: amplitudes, and frequency ratios.
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

    run = Execution(
        executor="serial",  # the precision of balls is one for all threads
        store=None if parts is None else parts.store("map", len(edges[1]) - 1),
        progress=told,
    )
    cases = partial(entropies, restitution=restitution, edges=[axis.tolist() for axis in edges])
    axes = [Axis(name=name, values=axis[:-1]) for name, axis in zip(AXES, edges, strict=True)]
    boxes = evaluate(cases, Grid(axes=axes), [Output(name="entropy")], run=run)
    entropy = boxes["entropy"].values
    return Chaos(restitution=restitution, points=points, edges=edges, entropy=entropy)


def steps(edges: Edges = EDGES) -> int:
    """Return the number of times that `chaos` reports progress."""
    return 1 + math.prod(len(axis) - 1 for axis in edges)


def entropies(
    amplitude: Floats, frequency_ratio: Floats, *, restitution: str, edges: list[list[float]]
) -> dict[str, Floats]:
    """Return the proved entropy of boxes, 0 where nothing is proved.

    Parameters
    ----------
    amplitude, frequency_ratio
        Lower ends of the boxes.
    restitution
        Its decimal.
    edges
        Ends of all boxes, among which the upper ends are.
    """
    up, across = (dict(pairwise(axis)) for axis in edges)
    lows = zip(amplitude.tolist(), frequency_ratio.tolist(), strict=True)
    proofs = (certify_chaos((a, up[a]), (w, across[w]), restitution) for a, w in lows)
    claims = (each.content["claim"] if each.proved else {} for each in proofs)
    return {"entropy": np.array([float(each.get("entropy_per_period", 0.0)) for each in claims])}


def parts_of(restitution: str, folder: Path | str, *, resume: bool, force: bool) -> Parts:
    """Return the finished parts of the study in its folder; arguments as for `Parts`."""
    inputs = {"study": "chaos", "restitution": restitution}
    return Parts(folder, inputs, resume=resume, force=force)
