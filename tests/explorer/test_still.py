"""The picture of the page where it cannot compute."""

import re
from xml.etree import ElementTree as ET

import numpy as np

from rocksteady.explorer._still import (
    AMPLITUDES,
    FREQUENCIES,
    HEIGHT,
    LEFT,
    TOP,
    WIDTH,
    still_picture,
)
from rocksteady.orbits import compute_region_map

CURVES = ("existence", "kind", "sign", "symmetry_breaking")


def paths() -> list[str]:
    return [path.attrib["d"] for path in ET.fromstring(still_picture()).iter("path")]


def test_its_curves_are_those_of_the_region_map() -> None:
    for name, path in zip(CURVES, paths(), strict=False):
        points = np.array(re.findall(r"[ML]([\d.]+) ([\d.]+)", path), dtype=float)
        span, rise = FREQUENCIES[1] - FREQUENCIES[0], AMPLITUDES[1] - AMPLITUDES[0]
        ratios = FREQUENCIES[0] + span * (points[:, 0] - LEFT) / WIDTH
        drawn = AMPLITUDES[1] - rise * (points[:, 1] - TOP) / HEIGHT
        expected = getattr(compute_region_map(ratios, 0.8), name)
        assert len(points) > 30
        np.testing.assert_allclose(drawn, expected, atol=0.02, err_msg=name)


def test_it_stays_inside_its_frame_and_has_a_name() -> None:
    picture = ET.fromstring(still_picture())
    assert "regions" in picture.attrib["aria-label"]
    for path in paths()[: len(CURVES)]:
        heights = [float(y) for _, y in re.findall(r"[ML]([\d.]+) ([\d.]+)", path)]
        assert min(heights) >= TOP
        assert max(heights) <= TOP + HEIGHT
