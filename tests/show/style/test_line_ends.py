"""Names at the ends of lines: as near as they fit, which is a monotone regression."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from scipy.optimize import isotonic_regression

from rocksteady.show.style.line_ends import LineEnd, name_line_ends, spread_heights
from tests.every import every


@given(
    st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12).map(sorted),
    st.floats(0.001, 0.2),
    st.floats(0.0, 0.3),
)
def test_heights_are_moved_as_little_as_possible(
    wanted: list[float], step: float, lowest: float
) -> None:
    """Least squares of ascending differences, moved in between the ends."""
    count = len(wanted)
    steps = [step * (1.0 + 0.5 * (k % 3)) for k in range(count - 1)]
    offsets = np.concatenate([[0.0], np.cumsum(steps)])
    found = spread_heights(np.array(wanted), steps, lowest=lowest, highest=1.0)
    free = isotonic_regression(np.array(wanted) - offsets).x
    expected = offsets + np.maximum(np.minimum(free, 1.0 - offsets[-1]), lowest)
    assert found == pytest.approx(expected, abs=1e-12)
    assert (np.diff(found) >= np.array(steps) - 1e-12).all()
    assert found[0] >= lowest
    assert found[-1] <= max(1.0, lowest + offsets[-1]) + 1e-12


def named(lines: list[LineEnd], **keys: object) -> dict[str, tuple[float, float]]:
    """Return where the names stand on axes 360 points wide and 160 high, and their sizes."""
    figure = Figure(figsize=(500 / 72, 200 / 72))
    axes = figure.add_axes((0.1, 0.1, 0.72, 0.8))
    axes.set(xlim=(0, 1), ylim=(0, 2))
    name_line_ends(axes, lines, **keys)  # type: ignore[arg-type]
    assert all(text.xyann == (4.0, 0.0) for text in axes.texts)  # type: ignore[attr-defined]
    return {
        text.get_text(): (float(text.xy[1]), float(text.get_fontsize()))  # type: ignore[attr-defined]
        for text in axes.texts
    }


def test_names_stand_at_the_last_finite_ordinate_within_the_axes() -> None:
    found = named(
        [
            LineEnd("low", [0.3, 0.5, math.nan], "k"),
            LineEnd("high", [0.1, 5.0], "k"),
            LineEnd("below", [1.0, -3.0], "k"),
        ]
    )
    assert {name: height for name, (height, _) in found.items()} == pytest.approx(
        {"low": 0.25, "high": 1.0, "below": 0.0}
    )
    assert {size for _, size in found.values()} == {8.0}
    assert named([LineEnd("none", [math.nan], "k")])["none"][0] == 0.0


@every(("lines", "apart"), [(("a", "b"), 1.0), (("a\nb", "c"), 1.5), (("a\nb", "c\nd"), 2.0)])
def test_names_are_apart_by_their_lines(lines: tuple[str, str], apart: float) -> None:
    found = named([LineEnd(name, [1.0], "k") for name in lines])
    low, high = (found[name][0] for name in lines)
    step = 1.25 * 8.0 / 160.0
    assert high - low == pytest.approx(apart * step)
    assert 0.5 * (low + high) == pytest.approx(0.5)


def test_a_title_stands_above_all_names() -> None:
    step = 1.25 * 8.0 / 160.0
    for title, lines in (("of", 0), ("of\ntwo", 1)):
        found = named([LineEnd("a", [0.4], "k")], title=title, most=0.9)
        assert found["a"][0] == pytest.approx(0.2)
        assert found[title][0] == pytest.approx(0.2 + (1.3 + 0.5 * lines) * step)
    crowd = [LineEnd(f"n{k}", [2.0], "k") for k in range(30)]
    heights = [height for name, (height, _) in named(crowd, title="all").items() if name != "all"]
    assert min(heights) == 0.0
    assert named(crowd, title="all")["all"][0] == pytest.approx(max(heights) + 1.3 * step)
    assert max(named(crowd[:3], most=0.8)[name][0] for name in ("n0", "n2")) == pytest.approx(0.8)
