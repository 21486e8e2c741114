"""Picture of fates over a window: its cells, its legend, its paper."""

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from rocksteady import DimensionlessBlock, Pulse, Status, compute_fate_basins, plots
from rocksteady.show.figures.single import fate_basins_figure
from rocksteady.show.style.page import Page
from rocksteady.show.style.tokens import HATCHES, LIGHT

WINDOW = 0.1 * (np.arange(28) - 13.5)
FOUND = compute_fate_basins(
    DimensionlessBlock(restitution=0.9),
    Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0),
    angles=WINDOW,
    velocities=WINDOW,
)


def test_cells_have_the_fill_of_their_fate_and_the_legend_its_share() -> None:
    axes = plots.fate_basins(FOUND, Figure().add_subplot())
    (image,) = axes.get_images()
    colours = np.asarray(image.cmap(image.norm(image.get_array())))[..., :3]  # type: ignore[arg-type]
    falls = (np.abs(colours - to_rgb(LIGHT.falls)) < 2e-3).all(axis=2)
    assert (falls == (FOUND.side != 0)).all()
    legend = axes.get_legend()
    assert legend is not None
    texts = [text.get_text() for text in legend.get_texts()]
    share = 100.0 * float((FOUND.side == 1).mean())
    assert f"falls to the positive side  {share:.1f} %" in texts
    hatches = {
        words.partition("  ")[0]: patch.get_hatch()
        for words, patch in zip(texts, legend.get_patches(), strict=False)
    }
    sides = [hatches[f"falls to the {side} side"] for side in ("positive", "negative")]
    assert sides == [HATCHES["falls"], HATCHES["falls_negative"]]
    rest = FOUND.fate == Status.AT_REST
    shares = [float(text.split()[-2]) for text in texts if text.startswith("comes to rest")]
    assert abs(sum(shares) - 100.0 * rest.mean()) < 0.2
    assert texts[-1] == "safe on a still base"


def test_a_narrow_page_and_no_legend() -> None:
    figure = fate_basins_figure(FOUND, "title", Page(width_mm=84))
    assert figure.get_size_inches()[0] * 25.4 == 84.0
    axes = plots.fate_basins(FOUND, Figure().add_subplot(), legend="none")
    assert axes.get_legend() is None
