"""Colours on light and dark paper: legible, and told apart by the colour-blind."""

import itertools
import math
import re

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from numpy.typing import NDArray

from rocksteady import DimensionlessBlock, Harmonic, compute_response_curve, find_orbits, plots
from rocksteady.measures import compute_response_spectrum
from rocksteady.seismic.measures.time_course import integrate_record
from rocksteady.show.style import tokens
from rocksteady.show.style.tokens import DARK, LIGHT, Inks, contrast, inks_of, luminance
from tests.every import every
from tests.show.drawn_figures import resting, rocking, shock, vertical_too
from tests.show.drawn_maps import found
from tests.show.plots.branches.test_bifurcations import over_frequency, sweeps

Floats = NDArray[np.float64]

# Machado, Oliveira and Fernandes 2009, severity 1, for linear RGB
SIGHTS: dict[str, Floats] = {
    "normal": np.eye(3),
    "protanopia": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deuteranopia": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "tritanopia": np.array(
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ]
    ),
}
XYZ = np.array(
    [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ]
)
LEAST = 9.0
"""CIEDE2000 between any two colours that meet in a picture."""
MEET = {
    "map of fates": ("rest", "rocks", "falls", "undecided"),
    "map of kinds": (
        *("rest", "symmetric", "unsymmetric", "subharmonic", "aperiodic", "falls", "undecided"),
    ),
    "history": ("motion", "base", "impact", "ink"),
    "branches": ("motion", "unsymmetric_line", "subharmonic_line", "aperiodic_line", "ink"),
    "block on its ground": ("rest", "rocks", "falls", "soil", "impact", "base"),
    "fragility": ("risk", "ink", "paper"),
    "earthquake": ("risk", "motion", "base", "impact", "ink"),
}
"""Roles that meet in one picture."""
TEXT = ("ink", "quiet", "motion", "base", "impact", "risk", "limit", "observed")
LINES = (*TEXT, "edge", "unsymmetric_line", "subharmonic_line", "aperiodic_line")
UPON = {
    "on_falls": ("falls",),
    "on_rocks": ("rocks", "symmetric", "unsymmetric"),
    "ink": ("rest", "soil"),
}
"""Labels, and the areas on which they stand."""


def lab(colour: str, sight: str) -> Floats:
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(SIGHTS[sight] @ linear, 0.0, 1.0)
    ratio = XYZ @ seen / XYZ.sum(axis=1)
    f = np.where(ratio > 216 / 24389, np.cbrt(ratio), (24389 / 27 * ratio + 16) / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def ciede2000(one: Floats, other: Floats) -> float:
    """Sharma, Wu and Dalal 2005."""
    l1, a1, b1 = one.tolist()
    l2, a2, b2 = other.tolist()
    mean = (math.hypot(a1, b1) + math.hypot(a2, b2)) / 2
    g = 0.5 * (1 - math.sqrt(mean**7 / (mean**7 + 25**7)))
    a1, a2 = a1 * (1 + g), a2 * (1 + g)
    c1, c2 = math.hypot(a1, b1), math.hypot(a2, b2)
    h1, h2 = (math.degrees(math.atan2(b, a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    turn = 0.0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    big = 2 * math.sqrt(c1 * c2) * math.sin(math.radians(turn / 2))
    light, chroma = (l1 + l2) / 2, (c1 + c2) / 2
    hue = h1 + h2 if c1 * c2 == 0 else (h1 + turn / 2) % 360
    t = (
        1
        - 0.17 * math.cos(math.radians(hue - 30))
        + 0.24 * math.cos(math.radians(2 * hue))
        + 0.32 * math.cos(math.radians(3 * hue + 6))
        - 0.20 * math.cos(math.radians(4 * hue - 63))
    )
    sl = 1 + 0.015 * (light - 50) ** 2 / math.sqrt(20 + (light - 50) ** 2)
    sc, sh = 1 + 0.045 * chroma, 1 + 0.015 * chroma * t
    rotation = -math.sin(math.radians(60 * math.exp(-(((hue - 275) / 25) ** 2))))
    rotation *= 2 * math.sqrt(chroma**7 / (chroma**7 + 25**7))
    parts = (l2 - l1) / sl, (c2 - c1) / sc, big / sh
    return math.sqrt(sum(part**2 for part in parts) + rotation * parts[1] * parts[2])


def test_the_difference_of_colours_is_that_of_its_authors() -> None:
    one, other = np.array([50.0, 2.6772, -79.7751]), np.array([50.0, 0.0, -82.7485])
    assert ciede2000(one, other) == pytest.approx(2.0425, abs=5e-5)
    one, other = np.array([60.2574, -34.0099, 36.2677]), np.array([60.4626, -34.1751, 39.4387])
    assert ciede2000(one, other) == pytest.approx(1.2644, abs=5e-5)


@every("inks", [LIGHT, DARK])
@every("sight", SIGHTS)
@every("picture", MEET)
def test_colours_that_meet_are_told_apart_by_any_sight(
    inks: Inks, sight: str, picture: str
) -> None:
    for one, other in itertools.combinations(MEET[picture], 2):
        far = ciede2000(lab(getattr(inks, one), sight), lab(getattr(inks, other), sight))
        assert far >= LEAST, (one, other, far)


@every("inks", [LIGHT, DARK])
@every("sight", SIGHTS)
@every("ramp", ["risk_ramp", "rocks_ramp"])
def test_neighbouring_steps_of_a_ramp_are_told_apart_by_any_sight(
    inks: Inks, sight: str, ramp: str
) -> None:
    colours = getattr(inks, ramp)
    lightness = [lab(colour, sight)[0] for colour in colours]
    assert lightness == sorted(lightness, reverse=not inks.dark)
    for one, other in itertools.pairwise(colours):
        assert ciede2000(lab(one, sight), lab(other, sight)) >= LEAST, (one, other)


@every("inks", [LIGHT, DARK])
def test_roles_stand_out_from_page_and_paper(inks: Inks) -> None:
    for paper in (inks.page, inks.paper):
        assert all(contrast(getattr(inks, role), paper) >= 4.5 for role in TEXT)
        assert all(contrast(getattr(inks, role), paper) >= 3.0 for role in LINES)
    for label, areas in UPON.items():
        for area in areas:
            assert contrast(getattr(inks, label), getattr(inks, area)) >= 4.5, (label, area)


@every("inks", [LIGHT, DARK])
@every("role", ["motion", "base", "risk", "subharmonic_line"])
@every("count", [1, 2, 3, 6, 9])
def test_series_are_steps_of_lightness_that_stand_out(inks: Inks, role: str, count: int) -> None:
    colours = inks.series(role, count)
    steps = [contrast(colour, inks.paper) for colour in colours]
    assert len(set(colours)) == count
    assert steps == sorted(steps, reverse=True)
    assert steps[-1] >= 3.0


def test_every_colour_is_a_token() -> None:
    from pathlib import Path

    sources = Path(tokens.__file__).parents[2]
    own = {"tokens.py", "svg.mjs"}  # the latter has the colours with which any canvas begins
    for file in sorted(sources.rglob("*")):
        if file.suffix in {".py", ".j2", ".css", ".html", ".mjs"} and file.name not in own:
            found = re.findall(r"#[0-9a-fA-F]{6}\b", file.read_text(encoding="utf-8"))
            assert not found, (file.relative_to(sources), found)


def drawings() -> dict[str, object]:
    """Return what draws each kind of picture whose paper shows."""
    block = DimensionlessBlock(restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    some = find_orbits(block, shaking, seeds=8)
    course = integrate_record(shock("one"))
    spectra = [compute_response_spectrum(shock(name), [0.1, 0.3, 1.0]) for name in ("one", "two")]
    curves = [
        compute_response_curve(block, a, frequency_ratio=np.linspace(1, 8, 50)) for a in (1.0, 2.0)
    ]
    return {
        "trajectory": lambda axes: plots.trajectory(rocking(), axes),
        "base": lambda axes: plots.base(vertical_too(), axes),
        "portrait": lambda axes: plots.phase_portrait(rocking(), axes),
        "rest": lambda axes: plots.phase_portrait(resting(), axes),
        "block": lambda axes: plots.block(rocking(), axes, pt=1.0),
        "section": lambda axes: plots.poincare_section(some, axes),
        "multipliers": lambda axes: plots.multipliers(some, axes),
        "bifurcations": lambda axes: plots.bifurcations(over_frequency(), sweeps(), axes),
        "response": lambda axes: plots.response(curves, axes),
        "free": lambda axes: plots.free_rocking([0.9, 0.8], axes),
        "course": lambda axes: plots.integrated_record(course, axes),
        "husid": lambda axes: plots.husid(course, axes),
        "spectra": lambda axes: plots.response_spectra(spectra, axes),
        "map": lambda axes: plots.outcomes(found(), axes),
    }


@pytest.mark.slow
@every("name", list(drawings()))
@every("paper", ["black", "#fdf6e3"])
def test_lines_and_text_are_legible_on_anybodys_paper(name: str, paper: str) -> None:
    dark = luminance(to_hex(paper)) < 0.18
    with plt.style.context("dark_background" if dark else "default"):
        figure = Figure(facecolor=paper, layout="constrained")
        axes = figure.add_subplot(facecolor=paper)
        draw = drawings()[name]
        assert callable(draw)
        draw(axes)
    for text in axes.texts:
        if text.get_text() and name != "map":  # whose words lie on fills
            assert contrast(to_hex(text.get_color()), to_hex(paper)) > 2.9, text.get_text()
    legend = axes.get_legend()
    if legend is not None:
        for text in legend.get_texts():
            assert contrast(to_hex(text.get_color()), to_hex(paper)) > 4.5, text.get_text()
    if name in ("block", "map"):  # lines on the fill of a block, dots over a strip
        return
    wanted = 2.0 if name == "bifurcations" else 2.4
    for line in axes.lines:
        marker = line.get_marker() not in (None, "None", "none", "")
        colour = line.get_color()
        if marker and line.get_linestyle() == "None":
            colour = line.get_markeredgecolor() if line.get_fillstyle() == "none" else colour
        if line.get_zorder() == 0.5:
            continue  # a grid
        assert contrast(to_hex(colour), to_hex(paper)) > wanted, (line.get_label(), colour)


def test_unstable_has_its_key_on_dark_paper() -> None:
    figure = Figure(facecolor="black")
    axes = plots.bifurcations(over_frequency(), ax=figure.add_subplot(facecolor="black"))
    legend = axes.get_legend()
    assert legend is not None
    words = [legend.get_title(), *legend.get_texts()]
    assert any("unstable" in text.get_text() for text in words)
    for text in words:
        assert contrast(to_hex(text.get_color()), "#000000") > 10.0, text.get_text()


def test_the_paper_is_what_is_seen_behind_the_axes() -> None:
    def paper(figure: str, axes: str) -> tuple[bool, str]:
        inks = inks_of(Figure(facecolor=figure).add_subplot(facecolor=axes))
        return inks.dark, inks.paper

    assert paper("white", "black") == (True, "#000000")
    assert paper("black", "white") == (False, "#ffffff")
    assert paper("black", "none") == (True, "#000000")
    assert paper("white", "#00000010")[0] is False
    axes: Axes = Figure(facecolor="black").add_subplot()
    axes.patch.set_visible(False)
    assert inks_of(axes).dark
