"""Pictures as text: what is seen counts, and last digits do not."""

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady.show.export.files import figure_bytes
from tests.every import every
from tools.freeze.pictures import drawn

mpl.use("Agg")


def picture(
    *, word: str = "tilt", high: float = 0.5, colour: str = "#112233", pixel: float = 0.2
) -> str:
    """Return a picture of a curve, a text and an image as text."""
    figure = Figure(figsize=(3.0, 2.0))
    axes = figure.add_axes((0.2, 0.2, 0.7, 0.7), xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    axes.plot([0.0, 0.3, 1.0], [0.1, high, 0.2], color=colour)
    axes.text(0.1, 0.8, word)
    axes.imshow(np.array([[0.0, pixel], [0.7, 1.0]]), extent=(0.0, 0.5, 0.0, 0.3), aspect="auto")
    return drawn(figure_bytes(figure, "svg").decode())


@every("high", [0.5 + 1e-12, 0.5 - 1e-12, 0.5 + 3e-9])
def test_last_digits_do_not_count(high: float) -> None:
    assert picture(high=high) == picture()


@pytest.mark.parametrize(
    ("changed", "lines"),
    [
        ({"word": "lean"}, {"words", "forms"}),
        ({"high": 0.501}, {"places"}),
        ({"colour": "#112234"}, {"forms"}),
        ({"pixel": 0.3}, {"forms"}),
    ],
)
def test_what_is_seen_counts(changed: dict[str, float | str], lines: set[str]) -> None:
    before, now = picture().splitlines(), picture(**changed).splitlines()  # type: ignore[arg-type]
    moved = {a.partition(":")[0] for a, b in zip(before, now, strict=True) if a != b}
    assert lines <= moved
    assert ("places" in moved) == ("places" in lines or "word" in changed)


def test_words_can_be_read() -> None:
    assert "tilt" in picture().splitlines()[0].split(" | ")
