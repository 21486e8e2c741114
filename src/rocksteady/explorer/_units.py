"""Units of the page: words and factors of quantities for a block of known size."""

import math
import re
from typing import Any, Final

from rocksteady.model.blocks.block import Block
from rocksteady.model.units import CONVERSIONS
from rocksteady.show.style.palette import LABELS

QUANTITIES: Final = {
    "amplitude": ("amplitude", "accel_g", "amplitude"),
    "frequency": ("frequency_ratio", "freq_hz", "frequency_ratio"),
    "time": ("pt", "time_s", "pivot_time"),
    "angle": ("angle", "angle_deg", "angle"),
    "velocity": ("velocity", "velocity_deg_s", "velocity"),
    "startAngle": ("angle", "angle_deg_at_start", "angle_at_start"),
    "startVelocity": ("velocity", "velocity_deg_s_at_start", "velocity_at_start"),
    "speed": ("speed_per_pivot_time", "speed_deg_s", "speed"),
    "peak": ("peak", "peak_deg", "peak"),
    "flight": ("peak", "flight_peak_deg", "flight_peak"),
    "base": ("base_acceleration_per_alpha_g", "base_g", "base"),
}
"""Conversion, label in the unit and dimensionless label of each quantity of the page."""
_LETTERS: Final = {
    r"\dot\theta": "dθ/dt",
    r"\alpha g": "αg",
    r"\alpha": "α",
    r"\theta": "θ",
    r"\omega": "ω",
} | {
    r"\Omega": "Ω",
    r"_{\max}": "_max",
    r"|_max": "|",
}


def page_units() -> dict[str, dict[str, Any]]:
    """Return the words and the factor of each quantity, for `shell/units.mjs`.

    A factor is a number and the powers of alpha and p that multiply it.

    Examples
    --------
    >>> page_units()["amplitude"]
    {'near': 'acceleration a_max [g]', 'far': 'amplitude A = a_max/(αg)', 'factor': [1.0, 1, 0]}
    """
    return {
        name: {"near": _plain(near), "far": _plain(far), "factor": _factor(conversion)}
        for name, (conversion, near, far) in QUANTITIES.items()
    }


def _factor(conversion: str) -> list[float | int]:
    """Return the factor of a conversion at alpha = p = 1, and the powers of both."""
    unit, slenderness, rate = (
        float(CONVERSIONS[conversion][1](Block.from_p(alpha=alpha, p=p, restitution=1.0), 1.0))
        for alpha, p in ((1.0, 1.0), (0.5, 1.0), (1.0, 2.0))
    )
    return [unit, _power_of_two(unit / slenderness), _power_of_two(rate / unit)]


def _power_of_two(ratio: float) -> int:
    """Return k of a ratio that is 2^k up to rounding."""
    return math.frexp(math.sqrt(2.0) * ratio)[1] - 1


def _plain(name: str) -> str:
    """Return a label without the marks of mathematics."""
    text = LABELS[name]
    for mark, letter in _LETTERS.items():
        text = text.replace(mark, letter)
    return re.sub(" +", " ", text.replace("$", ""))
