"""Three synthetic motions that ship with the package, read as ``example:NAME``.

The name always means the example: a file called so is read by its absolute path.
"""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from rocksteady.errors import RecordFileError

if TYPE_CHECKING:
    from rocksteady.records.core.recording import Recording

PREFIX: Final = "example:"
DIGITS: Final = 5
"""Decimals of the samples in g, as in the file of a network."""


class _Example(NamedTuple):
    """Band noise under an envelope, with a Ricker wavelet at its peak if `pulse_hz` is not 0."""

    pga_g: float
    band_hz: tuple[float, float]
    duration_s: float
    peak: float  # time of the envelope's peak over the duration
    seed: int
    pulse_hz: float = 0.0
    noise: float = 1.0  # peak of the noise over that of the pulse

    @property
    def words(self) -> str:
        """How the motion is made."""
        low, high = self.band_hz
        pulse = f" and a Ricker pulse of {self.pulse_hz:g} Hz" if self.pulse_hz else ""
        return f"synthetic: noise of {low:g} to {high:g} Hz{pulse}, seed {self.seed}"


EXAMPLES: Final = {
    "near-fault": _Example(0.5, (0.5, 10.0), 20.0, 0.25, 1, pulse_hz=0.65, noise=0.4),
    "firm-ground": _Example(0.5, (1.5, 10.0), 12.0, 0.15, 3),
    "soft-soil": _Example(0.4, (0.4, 1.25), 40.0, 0.25, 8),
}
LISTED: Final = ", ".join(PREFIX + name for name in EXAMPLES)


def is_example(path: Path) -> bool:
    """Return whether a path is the name of an example."""
    return str(path).lower().startswith(PREFIX)


def example_named(path: Path) -> _Example:
    """Return the example of a name.

    Raises
    ------
    RecordFileError
        If there is no such example.
    """
    example = EXAMPLES.get(str(path).lower().removeprefix(PREFIX))
    if example is None:
        valid = "there is no example of that name"
        raise RecordFileError(path=path, valid=valid, hint=f"give one of {LISTED}")
    return example


def read_example(path: Path) -> "Recording":
    """Return an example, the same to the last bit on every machine.

    Raises
    ------
    RecordFileError
        As for `example_named`.
    """
    example = example_named(path)
    import numpy as np

    from rocksteady.kernels.elementary.arrays import exp
    from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
    from rocksteady.model.motions.band_noise import BandNoise
    from rocksteady.model.motions.record import Record
    from rocksteady.records.core.recording import Recording

    # Frequencies in rad/s make pivot time seconds. Rounding must not add a sample.
    low, high = (2.0 * math.pi * (1.0 - 1e-9) * hertz for hertz in example.band_hz)
    noise = BandNoise(rms=1.0, band=(low, high), duration=example.duration_s, seed=example.seed)
    time = np.linspace(0.0, 1.0, len(noise.samples)) / example.peak
    envelope = np.square(time * exp(1.0 - time))
    samples = envelope * noise.samples
    samples -= envelope * (math.fsum(samples) / math.fsum(envelope))  # the base ends at rest
    samples /= np.abs(samples).max()
    if example.pulse_hz:
        late = np.square(
            math.pi * example.pulse_hz * example.duration_s * example.peak * (time - 1.0)
        )
        samples = example.noise * samples + (1.0 - 2.0 * late) * exp(-late)
    values_g = np.round(samples * (example.pga_g / np.abs(samples).max()), DIGITS)
    name = str(path).lower().removeprefix(PREFIX)
    return Recording(
        record=Record(
            acceleration_m_s2=values_g * STANDARD_GRAVITY,
            dt_s=noise.step,
            name=f"synthetic {name} motion",
        ),
        format="example",
        path=path,
        units_in_file="g",
        orientation="horizontal",
        position="surface",
        event="synthetic motion, no earthquake's",
        processing=(example.words,),
    )
