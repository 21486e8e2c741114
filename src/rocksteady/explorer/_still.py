"""A still picture for browsers that cannot run the page: the regions of steady rocking."""

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.steady.regions import compute_region_map

RESTITUTION = 0.8
FREQUENCIES = (0.5, 8.0)
"""Frequency ratios, from the left edge to the right one."""
AMPLITUDES = (0.0, 6.0)
"""Amplitudes, from the lower edge to the upper one."""
POINTS = 120
"""Of a curve."""
LEFT, TOP, WIDTH, HEIGHT = 46, 26, 500, 300
"""The axes, inside a picture of 560 x 372."""
CURVES = (
    ("existence", "steady rocking exists above", "12 3"),
    ("kind", "the other solution is out of phase above", "7 3"),
    ("sign", "the in-phase solution ends above", "2 3"),
    ("symmetry_breaking", "symmetric rocking is stable below", "9 3 2 3"),
)
"""Boundaries, what they bound, and their dashes."""


def still_picture() -> str:
    """Return an SVG of the boundaries of the regions, for restitution 0.8."""
    ratios = np.linspace(*FREQUENCIES, POINTS)
    regions = compute_region_map(ratios, RESTITUTION)
    across = LEFT + WIDTH * (ratios - ratios[0]) / (ratios[-1] - ratios[0])
    lines, keys = [], []
    for place, (name, words, dashes) in enumerate(CURVES):
        path = _path(across, getattr(regions, name))
        look = f'fill="none" stroke="currentColor" stroke-dasharray="{dashes}"'
        lines.append(f'<path d="{path}" {look}/>')
        x, y = LEFT + 236, TOP + 50 + 18 * place
        keys.append(f'<path d="M{x - 26} {y - 4}h22" {look}/><text x="{x}" y="{y}">{words}</text>')
    numbers = [
        f'<text x="{_x(ratio):.0f}" y="{TOP + HEIGHT + 16}" text-anchor="middle">{ratio}</text>'
        for ratio in range(1, 9)
    ] + [
        f'<text x="{LEFT - 8}" y="{_y(amplitude) + 4:.0f}" text-anchor="end">{amplitude}</text>'
        for amplitude in range(7)
    ]
    return (
        '<svg viewBox="0 0 560 372" role="img" font-size="12" fill="currentColor" '
        'aria-label="Boundaries of the regions of symmetric steady rocking, restitution 0.8">'
        f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" '
        f'stroke="currentColor"/>{"".join(lines)}{"".join(keys)}{"".join(numbers)}'
        f'<text x="{LEFT + WIDTH / 2:.0f}" y="364" text-anchor="middle">'
        "frequency ratio Ω = ω/p</text>"
        f'<text x="8" y="16">amplitude A = a/(αg), restitution {RESTITUTION}</text></svg>'
    )


def _x(ratio: float) -> float:
    """Return where a frequency ratio stands."""
    return LEFT + WIDTH * (ratio - FREQUENCIES[0]) / (FREQUENCIES[1] - FREQUENCIES[0])


def _y(amplitude: float) -> float:
    """Return where an amplitude stands."""
    return TOP + HEIGHT * (AMPLITUDES[1] - amplitude) / (AMPLITUDES[1] - AMPLITUDES[0])


def _path(across: Floats, amplitudes: Floats) -> str:
    """Return the SVG path of a curve, cut at the axes."""
    steps, drawing = [], False
    for x, amplitude in zip(across, amplitudes, strict=True):
        inside = bool(AMPLITUDES[0] <= amplitude <= AMPLITUDES[1])  # false of nan
        if inside:
            steps.append(f"{'L' if drawing else 'M'}{x:.1f} {_y(float(amplitude)):.1f}")
        drawing = inside
    return "".join(steps)
