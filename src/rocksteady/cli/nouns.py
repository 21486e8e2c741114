"""What moves and what shakes it: flags that become nouns of the model."""

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

from rocksteady.cli import flags
from rocksteady.cli.flags import FLAG_OF_ARGUMENT
from rocksteady.cli.inputs import MOST_AXIS_POINTS, axis, restitution_from, single
from rocksteady.dynamics.parameters import SIZES
from rocksteady.errors import InputError, ModelError
from rocksteady.model.block import STANDARD_GRAVITY, Block, DimensionlessBlock
from rocksteady.model.examples import example_block
from rocksteady.model.motions import Harmonic
from rocksteady.model.validation import LARGEST, in_range, non_negative

FIELDS = {name: FLAG_OF_ARGUMENT[name].removeprefix("--").replace("-", "_") for name in SIZES}
"""Fields of the flags of a block, by the measures that they are."""


@dataclass(frozen=True, kw_only=True)
class ShakingFlags:
    """Harmonic shaking, dimensionless or, for a block, in g and Hz."""

    amplitude: flags.Amplitude = None
    frequency_ratio: flags.FrequencyRatio = None
    accel_g: flags.AccelG = None
    freq_hz: flags.FreqHz = None

    @property
    def given(self) -> bool:
        """Whether there is any of them."""
        return any(getattr(self, field.name) is not None for field in fields(self))

    def parameters(self, block: Block | DimensionlessBlock) -> dict[str, list[float]]:
        """Return amplitudes and frequencies in the measures of the flags, g as m/s^2.

        Each is an axis or one value, by its name in `rocksteady.dynamics.parameters.AXES`.

        Raises
        ------
        InputError, ModelError
            If a value is missing, given twice, no number, negative, or needs a block.
        """
        for flag, value in (("--accel-g", self.accel_g), ("--freq-hz", self.freq_hz)):
            if value is not None and isinstance(block, DimensionlessBlock):
                raise ModelError(
                    name=flag,
                    value=value,
                    valid="g and Hz need a block with a slenderness and a p",
                    hint="describe a block, or give -A and -W",
                )
        for flag, one, other in (
            ("--amplitude/-A and --accel-g", self.amplitude, self.accel_g),
            ("--frequency-ratio/-W and --freq-hz", self.frequency_ratio, self.freq_hz),
        ):
            if (one is None) == (other is None):
                raise ModelError(
                    name=flag,
                    value="both given" if one is not None else "neither given",
                    valid="exactly one of the two is needed",
                    hint="give one",
                )
        found: dict[str, list[float]] = {}
        if self.amplitude is not None:
            found["amplitude"] = axis("amplitude", self.amplitude)
        if self.accel_g is not None and isinstance(block, Block):
            peaks = axis("--accel-g", self.accel_g)
            for end in (peaks[0], peaks[-1]):
                non_negative("--accel-g", end, hint="give the peak in g; 0.3 is usual")
            found["acceleration_m_s2"] = [min(g, LARGEST) * block.gravity for g in peaks]
        if self.frequency_ratio is not None:
            found["frequency_ratio"] = axis("frequency_ratio", self.frequency_ratio)
        if self.freq_hz is not None:
            found["frequency_hz"] = axis("--freq-hz", self.freq_hz)
        return found

    def of(self, block: Block | DimensionlessBlock) -> tuple[list[float], list[float]]:
        """Return amplitudes A and frequency ratios for a block, each an axis or one value.

        Raises
        ------
        InputError, ModelError
            If a value is missing, given twice, outside its range, or needs a block.
        """
        given = self.parameters(block)
        if "acceleration_m_s2" in given:
            given["amplitude"] = [_felt(block, a).amplitude for a in given["acceleration_m_s2"]]
        if "frequency_hz" in given:
            given["frequency_ratio"] = [
                _felt(block, 0.0, hertz).frequency_ratio for hertz in given["frequency_hz"]
            ]
        amplitudes, ratios = given["amplitude"], given["frequency_ratio"]
        if len(amplitudes) * len(ratios) > MOST_AXIS_POINTS:
            raise InputError(
                name="the axes",
                value=f"{len(amplitudes)} amplitudes x {len(ratios)} frequencies",
                valid=f"they may have {MOST_AXIS_POINTS} points together",
                hint="take fewer points",
            )
        return amplitudes, ratios

    def at(self, block: Block | DimensionlessBlock, *, phase: float = 0.0) -> Harmonic:
        """Return the one motion of flags that are no axes.

        Raises
        ------
        InputError, ModelError
            As for `of`; and if a value is an axis, or the phase is not finite.
        """
        amplitudes, ratios = self.of(block)
        ratio = single("frequency_ratio", ratios)
        amplitude = single("amplitude", amplitudes)
        return Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase)


def _felt(
    block: Block | DimensionlessBlock, acceleration_m_s2: float, frequency_hz: float | None = None
) -> Harmonic:
    """Return what a block feels of a ground of which only a part is asked for."""
    assert isinstance(block, Block)
    hertz = block.p if frequency_hz is None else frequency_hz  # valid for every block
    return Harmonic.from_si(block, acceleration_m_s2=acceleration_m_s2, frequency_hz=hertz)


@dataclass(frozen=True, kw_only=True)
class BlockFlags:
    """A block, or its restitution alone."""

    restitution: flags.Restitution = None
    block: flags.NamedBlock = None
    width_m: flags.WidthM = None
    height_m: flags.HeightM = None
    alpha_rad: flags.AlphaRad = None
    radius_m: flags.RadiusM = None
    p_rad_s: flags.PRadS = None
    gravity_m_s2: flags.GravityMS2 = None

    def described(self) -> Block | DimensionlessBlock:
        """Return the block that the flags describe; a dimensionless one where none does.

        Raises
        ------
        InputError
            If a number is outside its range.
        ModelError
            If the flags describe a block in two ways, or half of one.
        """
        gravity = STANDARD_GRAVITY if self.gravity_m_s2 is None else self.gravity_m_s2
        sizes = {name: single(FLAG_OF_ARGUMENT[name], self.sizes[name]) for name in self.sizes}
        width, height, alpha, radius, p = (sizes.get(name) for name in SIZES)
        given = [FLAG_OF_ARGUMENT[name] for name in sizes]
        if self.block is not None and not given:
            own = None
            if self.restitution is not None:
                own = restitution_from(self.restitution, default="housner")
            return example_block(self.block, restitution=own, gravity=gravity)
        if not given:
            if self.gravity_m_s2 is not None:
                raise ModelError(
                    name="--gravity-m-s2",
                    value=self.gravity_m_s2,
                    valid="without a block gravity has no meaning",
                    hint="describe a block, or leave it out",
                )
            ratio = restitution_from(self.restitution, default=None)
            return DimensionlessBlock(restitution=float(ratio))
        if self.block is None and len(given) == 2:
            ratio = restitution_from(self.restitution, default="housner")
            if width is not None and height is not None:
                return Block.rectangle(
                    width=width, height=height, restitution=ratio, gravity=gravity
                )
            if alpha is not None and radius is not None:
                return Block.from_radius(
                    alpha=alpha, radius=radius, restitution=ratio, gravity=gravity
                )
            if alpha is not None and p is not None:
                return Block.from_p(alpha=alpha, p=p, restitution=ratio, gravity=gravity)
        raise ModelError(
            name="the block",
            value=" ".join(["--block", *given] if self.block is not None else given),
            valid="it is described by --width-m with --height-m, by --alpha-rad with --radius-m, "
            "by --alpha-rad with --p-rad-s, or by --block alone",
            hint="give one of these pairs",
        )

    @cached_property
    def sizes(self) -> dict[str, list[float]]:
        """The measures that are given, each an axis or one value.

        Raises
        ------
        InputError
            If one is neither an axis nor a number.
        """
        texts = {name: getattr(self, FIELDS[name]) for name in SIZES}
        return {
            name: axis(FLAG_OF_ARGUMENT[name], text)
            for name, text in texts.items()
            if text is not None
        }

    @cached_property
    def restitutions(self) -> list[float]:
        """The values of the restitution where that is an axis, else none.

        Raises
        ------
        InputError
            If it is no axis, or not inside (0, 1].
        """
        if self.restitution is None or ":" not in self.restitution:
            return []
        values = axis("restitution", self.restitution)
        for end in (values[0], values[-1]):
            in_range("restitution", end, 0.0, 1.0, hint="give an axis inside (0, 1]")
        return values

    def at_first(self) -> "BlockFlags":
        """Return the flags with the first value of each axis in its place."""
        first: dict[str, Any] = {
            FIELDS[name]: repr(values[0]) for name, values in self.sizes.items()
        }
        if self.restitutions:
            first["restitution"] = repr(self.restitutions[0])
        return replace(self, **first)
