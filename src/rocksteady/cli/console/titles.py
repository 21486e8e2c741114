"""Titles of pictures: block, base motion and restitution in a few words."""

import re
from collections.abc import Sequence
from typing import Any, Final

from rocksteady.results.numbers import angle, quantity
from rocksteady.show.style.palette import shortened

SIGN_CHANGED: Final = re.compile("sign changed: ")
"""Beginning of the notes on a record whose sign is not that of its file."""


def turned_text(processing: Sequence[str]) -> str:
    """Return the words of a title on a changed sign; none where it is as filed."""
    return " (sign changed)" if any(map(SIGN_CHANGED.match, processing)) else ""


def case_text(values: dict[str, Any]) -> str:
    """Return block and shaking in a few words, for a title."""
    parts = [restitution_text(values)]
    if "record" in values:
        up = " and vertical" if "vertical" in values else ""
        # A sign that is not the file's is no detail: the peak may be another one.
        up += turned_text(values.get("vertical_processing", []))
        parts.insert(0, f"{shortened(values['record'])}{up}, PGA {values['pga_g']:.3g} g")
    elif "amplitude" in values:
        shaking = [f"A = {values['amplitude']:.4g}", f"Ω = {values['frequency_ratio']:.4g}"]
        if "accel_g" in values:
            units = [quantity(values["accel_g"], "g"), quantity(values["freq_hz"], "Hz")]
            shaking = [f"{unit} ({bare})" for unit, bare in zip(units, shaking, strict=True)]
        parts.insert(0, ", ".join(shaking))
    else:
        parts.insert(0, "free rocking")
    if "pulse" in values:
        parts.insert(0, f"{values['pulse']} pulse")
    if "block" in values:
        parts.append(block_text(values["block"]))
    if "block" in values and "model" in values:
        parts.append(f"{values['model']} model")
    return ", ".join(parts)


def restitution_text(values: dict[str, Any]) -> str:
    """Return what an impact leaves, of either impact where they differ; for a wall, its own."""
    if values.get("one_sided"):
        return f"against a wall, restitution {values['restitution']:.4g}"
    negative = values.get("negative_restitution")
    if negative is None:
        return f"restitution {values['restitution']:.4g}"
    return f"restitution {values['restitution']:.3g}/{negative:.3g}"


def block_text(block: dict[str, Any]) -> str:
    """Return slenderness and rate of a block; where its sides differ both slendernesses."""
    if "negative" in block:  # four numbers leave no room for the rest of the title
        ends = (block, block["negative"])
        return f"α = {'/'.join(angle(side['alpha_rad']) for side in ends)}"
    return f"α = {angle(block['alpha_rad'])}, p = {block['p_rad_s']:.4g} rad/s"
