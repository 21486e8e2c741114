"""Facts of base motions, as results put them into JSON and into words."""

from collections.abc import Iterator

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.facts import AnyBlock
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Harmonic, Motion, Still
from rocksteady.results.description import Fact
from rocksteady.results.numbers import number, quantity

_NAMES = {
    "BandNoise": "band noise",
    "Impulses": "impulses",
    "Piecewise": "a piecewise motion",
    "SyntheticMotion": "a synthetic motion",
}
"""Words for a motion that has no amplitude, by its class."""


def motion_text(
    block: AnyBlock, motion: Motion | Record | BaseMotion, vertical: Motion | Record | None = None
) -> str:
    """Return a base motion in a few words.

    Parameters
    ----------
    block
        That is shaken.
    motion, vertical
        Both components, or both in one.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Pulse
    >>> bare = DimensionlessBlock(restitution=0.9)
    >>> motion_text(bare, Pulse(shape="one-sine", amplitude=3.0, frequency_ratio=2.0))
    'a one-sine pulse (A = 3, Ω = 2)'
    """
    if isinstance(motion, BaseMotion):
        vertical, motion = motion.vertical, motion.horizontal
    if isinstance(motion, Record):
        peak = quantity(in_g(motion.reference.peak_acceleration_m_s2), "g")
        if motion.ground:
            peak += f", of the floor {quantity(in_g(motion.peak_acceleration_m_s2), 'g')}"
        words = f"{motion.name or 'a record'} (PGA {peak})"
    elif isinstance(motion, PeriodicMotion | Pulse):
        words = "harmonic shaking" if isinstance(motion, Harmonic) else "periodic shaking"
        if isinstance(motion, Pulse):
            words = f"a {'reversed ' if motion.reverse else ''}{motion.shape} pulse"
        ratios = f"A = {number(motion.amplitude)}, Ω = {number(motion.frequency_ratio)}"
        if isinstance(block, Block):
            level = quantity(in_g(motion.acceleration_m_s2(block)), "g")
            ratios = f"{level} at {quantity(motion.frequency_hz(block), 'Hz')}, {ratios}"
        words += f" ({ratios})"
    elif isinstance(motion, Still):
        words = "a still base"
    else:
        name = type(motion).__name__
        article = "an" if name[0] in "AEIOU" else "a"
        words = _NAMES.get(name, f"{article} {name} motion")
    return words if vertical is None else f"{words} with a vertical motion"


def motion_facts(
    block: AnyBlock, motion: Motion | Record | BaseMotion, vertical: Motion | Record | None = None
) -> Iterator[Fact]:
    """Yield the base motion of a result, as the block feels it; arguments as for `motion_text`."""
    if isinstance(motion, BaseMotion):
        vertical, motion = motion.vertical, motion.horizontal
    if isinstance(motion, PeriodicMotion | Pulse):
        if isinstance(motion, Pulse):
            yield Fact("pulse", motion.shape)
        yield Fact("amplitude", motion.amplitude)
        yield Fact("frequency_ratio", motion.frequency_ratio)
        if isinstance(block, Block):
            yield Fact("accel_g", in_g(motion.acceleration_m_s2(block)))
            yield Fact("freq_hz", motion.frequency_hz(block))
        if isinstance(motion, FourierSeries):
            yield Fact("harmonics", [list(wave) for wave in motion.harmonics])
        if isinstance(motion, PeriodicMotion):
            yield Fact("phase", motion.phase)
        else:
            yield Fact("reversed", motion.reverse)
            yield Fact("duration_pt", motion.duration)
            if isinstance(block, Block):
                yield Fact("duration_s", motion.duration / block.p)
    elif isinstance(motion, Record):
        yield Fact("record", motion.name)
        yield Fact("npts", len(motion.acceleration_m_s2))
        yield Fact("dt_s", motion.dt_s)
        yield Fact("duration_s", motion.duration_s)
        if isinstance(vertical, Record):
            peak = in_g(vertical.peak_acceleration_m_s2)
            words = f"{vertical.name or 'a record'} ({quantity(peak, 'g')})"
            yield Fact("vertical", vertical.name, "vertical motion", words)
            yield Fact("vertical_pga_g", peak)
