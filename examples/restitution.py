"""First impacts of limestone blocks against Housner's restitution, and what they make of a decay.

Writes restitution.png and restitution-fit.png into the folder that is given, by default the current
one: python examples/restitution.py docs/images
"""

import math
import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.show.figures.observations import restitution_figure
from rocksteady.show.style import palette

MEANS = {
    4: 0.9401, 5: 0.9397, 6: 0.9319, 7: 0.9616, 8: 0.9539, 9: 0.9729,
    10: 0.9827, 11: 0.9677, 12: 0.9960, 13: 0.9964, 14: 0.9466, 15: 0.9712,
}  # fmt: skip
"""Mean restitution of the first impact by H/B: doi.org/10.60756/uminho-jh25, CC BY."""

SCATTER = 0.034
"""Standard deviation from test to test, measuring error included, of the same tests."""

START = 0.5
"""Peak over alpha that the drawn decays begin at."""


def releases(block: rs.Block) -> list[rs.Release]:
    """Three made-up releases: impacts that scatter, angles that are measured with an error."""
    rng = np.random.default_rng(5)
    found = []
    for name, start in (("first", 0.7), ("second", 0.5), ("third", 0.6)):
        ratios = 0.952 + 0.02 * rng.standard_normal(18)
        peaks = [start]
        for ratio in ratios:
            peaks.append(rs.free_rocking_peaks(peaks[-1], ratio, 1, alpha=block.alpha)[1])
        angles = block.alpha * np.array(peaks) + 3e-4 * rng.standard_normal(len(peaks))
        found.append(rs.Release(peaks_rad=angles, sigma_rad=3e-4, name=name))
    return found


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with palette.style():
        figure = Figure(figsize=(9.6, 4.0), layout="constrained")
        left, right = figure.subplots(1, 2)
        slender = np.linspace(3.5, 15.5, 200)
        values = [rs.housner_restitution(math.atan(1.0 / each)) for each in slender]
        left.plot(slender, values, color=palette.INK, label="Housner")
        left.errorbar(
            list(MEANS), list(MEANS.values()), SCATTER, fmt="o", color=palette.LINES[0],
            ecolor=palette.FAINT, elinewidth=0.9, ms=5.0, label="mean of tests, ± 1 sd of one test",
        )  # fmt: skip
        left.set(xlabel="height over width", ylabel="restitution of the first impact")
        left.legend(loc="lower right")
        for series, ratio in enumerate((14, 15)):
            alpha = math.atan(1.0 / ratio)
            for e, dash, name in (
                (MEANS[ratio], palette.DASHES[0], "measured mean"),
                (rs.housner_restitution(alpha), palette.DASHES[1], "Housner"),
            ):
                peaks = rs.free_rocking_peaks(START, e, 210)
                down = peaks[peaks > 0.9 * 0.05 * START]
                right.plot(
                    down, color=palette.LINES[series], ls=dash, label=f"H/B = {ratio}, {name}"
                )
        right.axhline(0.05 * START, color=palette.FAINT, lw=0.9)
        right.set(xlabel="impacts", ylabel=r"peak $\theta/\alpha$", yscale="log")
        right.set_yticks([0.5, 0.2, 0.1, 0.05, 0.025], ["0.5", "0.2", "0.1", "0.05", "0.025"])
        right.minorticks_off()
        right.legend(loc="upper right")
        figure.savefig(folder / "restitution.png", dpi=150)
    block = rs.Block.rectangle(width=0.05, height=0.5)
    fit = rs.fit_restitution(releases(block), block)
    restitution_figure(fit, fit.describe().headline).savefig(
        folder / "restitution-fit.png", dpi=150
    )


if __name__ == "__main__":
    main(Path(*sys.argv[1:2]))
