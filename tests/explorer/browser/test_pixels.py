"""The colours of the map: those of the classes that the Python API finds."""

import re
from typing import Any

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_attractor
from rocksteady.outcomes import AttractorKind
from rocksteady.show.style.tokens import LIGHT
from tests.explorer.browser.test_touch import MAP, at
from tests.explorer.browser.watched import Explorer, drawn, turn_to, until

SEED = 7
POINTS = 30
NOTE = "document.querySelector(\"[data-panel='map'] .note\").textContent"
CELLS = """(canvas, places) => {
  const ratio = canvas.width / canvas.clientWidth, pen = canvas.getContext('2d');
  return places.map(([x, y]) => [...pen.getImageData(
    Math.round((x * canvas.clientWidth - 4) * ratio),
    Math.round((y * canvas.clientHeight - 4) * ratio), 9 * ratio, 9 * ratio).data]);
}"""
FILLS = {
    "rest": LIGHT.rest,
    "symmetric": LIGHT.symmetric,
    "unsymmetric": LIGHT.unsymmetric,
    "subharmonic": LIGHT.subharmonic,
    "aperiodic": LIGHT.aperiodic,
    "overturned": LIGHT.falls,
    "undecided": LIGHT.undecided,
}


def class_at(ratio: float, amplitude: float) -> str:
    """Return the class of the motion that a block settles to from rest."""
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    found = find_attractor(DimensionlessBlock(restitution=0.8), motion)
    periodic = found.kind in {AttractorKind.SYMMETRIC, AttractorKind.UNSYMMETRIC}
    if periodic and found.period is not None and found.period > 1:
        return "subharmonic"
    return str(found.kind.value)


def share(cells: list[int], colour: str) -> float:
    """Return the part of some pixels that has a colour."""
    seen = np.array(cells).reshape(-1, 4)[:, :3]
    wanted = [int(part, 16) for part in re.findall("..", colour[1:])]
    return float((np.abs(seen - wanted).max(axis=1) <= 2).mean())


@pytest.mark.slow
def test_pixels_of_the_map_have_the_colours_of_the_classes_of_python(explorer: Explorer) -> None:
    page = explorer.open({"r": 0.8})
    calibrated = [at(page, ratio, amplitude) for ratio, amplitude in ((1.0, 1.0), (7.0, 5.0))]
    turn_to(page, {"r": 0.8, "A": 5.9, "W": 7.9})  # the mark out of the way
    until(page, f"() => /^[\\d,]+ cells/.test({NOTE})", seconds=60.0)
    drawn(page)
    (x0, y0), (x1, y1) = calibrated
    rng = np.random.default_rng(SEED)
    checked: dict[str, int] = {}
    places: list[tuple[float, float]] = []
    wanted: list[str] = []
    while len(places) < POINTS:
        ratio, amplitude = float(rng.uniform(0.8, 7.5)), float(rng.uniform(0.5, 5.5))
        around = {
            class_at(ratio + dw, amplitude + da)
            for dw in (-0.08, 0.0, 0.08)
            for da in (-0.08, 0.0, 0.08)
        }
        if len(around) > 1:  # near an edge
            continue
        wanted.extend(around)
        places.append(
            (x0 + (ratio - 1.0) * (x1 - x0) / 6.0, y0 + (amplitude - 1.0) * (y1 - y0) / 4.0)
        )
    seen: list[Any] = page.locator(MAP).evaluate(CELLS, places)
    for cells, name in zip(seen, wanted, strict=True):
        # Lines, labels and patterns may cover a part.
        best = max(FILLS, key=lambda fill: share(cells, FILLS[fill]))
        if share(cells, FILLS[best]) < 0.3:
            continue
        assert best == name
        checked[name] = checked.get(name, 0) + 1
    assert sum(checked.values()) > POINTS // 2
    assert {"rest", "symmetric", "overturned"} <= set(checked)
