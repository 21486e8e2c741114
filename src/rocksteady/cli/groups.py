"""Groups of flags that several commands share: a command takes each group as one parameter.

A group is a frozen dataclass whose fields are the flags; its methods turn them into nouns of the
model.  `grouped` spreads the fields over the command's signature, where typer finds them, and
collects them again when the command is called.
"""

import inspect
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from functools import wraps
from pathlib import Path
from typing import Any

from rocksteady.cli import flags
from rocksteady.cli.inputs import MOST_AXIS_POINTS, axis, restitution_from, single
from rocksteady.cli.outputs import check_writable
from rocksteady.errors import InputError, ModelError, OutputError
from rocksteady.model.block import STANDARD_GRAVITY, Block, DimensionlessBlock
from rocksteady.model.examples import example_block
from rocksteady.model.motions import Harmonic
from rocksteady.model.validation import LARGEST, non_negative, positive

FIGURE_FORMATS = (".png", ".svg", ".pdf")


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

    def of(self, block: Block | DimensionlessBlock) -> tuple[list[float], list[float]]:
        """Return amplitudes A and frequency ratios for a block, each an axis or one value.

        Raises
        ------
        InputError, ModelError
            If a value is missing, given twice, outside its range, or needs a block.
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
        if self.amplitude is not None:
            amplitudes = axis("amplitude", self.amplitude)
        else:
            amplitudes = [self._amplitude(block, g) for g in axis("--accel-g", self.accel_g or "")]
        if self.frequency_ratio is not None:
            ratios = axis("frequency_ratio", self.frequency_ratio)
        else:
            ratios = [self._ratio(block, hertz) for hertz in axis("--freq-hz", self.freq_hz or "")]
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

    @staticmethod
    def _amplitude(block: Block | DimensionlessBlock, accel_g: float) -> float:
        """Return A of a peak in g."""
        assert isinstance(block, Block)
        g = non_negative("--accel-g", accel_g, hint="give the peak in g; 0.3 is usual")
        return min(g, LARGEST) * block.gravity / block.uplift_acceleration

    @staticmethod
    def _ratio(block: Block | DimensionlessBlock, hertz: float) -> float:
        """Return Omega of a frequency in Hz."""
        assert isinstance(block, Block)
        shaking = Harmonic.from_si(block, acceleration_m_s2=0.0, frequency_hz=hertz)
        return shaking.frequency_ratio


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
        width, height = self.width_m, self.height_m
        alpha, radius, p = self.alpha_rad, self.radius_m, self.p_rad_s
        given = [flag for flag, value in self._sizes().items() if value is not None]
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

    def _sizes(self) -> dict[str, float | None]:
        return {
            "--width-m": self.width_m,
            "--height-m": self.height_m,
            "--alpha-rad": self.alpha_rad,
            "--radius-m": self.radius_m,
            "--p-rad-s": self.p_rad_s,
        }


@dataclass(frozen=True, kw_only=True)
class OutputFlags:
    """What a command leaves behind."""

    as_json: flags.Json = False
    plot: flags.Plot = None
    csv: flags.Csv = None
    force: flags.Force = False

    def check(self) -> None:
        """Refuse, before anything is computed, what could not be written afterwards.

        Raises
        ------
        OutputError
            If a file exists and --force is off, its folder is missing or not writable, a figure's
            format is unknown, or one file is asked for twice.
        """
        if self.plot is not None and self.plot.suffix.lower() not in FIGURE_FORMATS:
            raise OutputError(
                name="--plot",
                value=self.plot,
                valid="the ending says the format: " + ", ".join(FIGURE_FORMATS),
                hint="rename it",
            )
        if _same_file(self.plot, self.csv):
            raise OutputError(
                name="--csv", value=self.csv, valid="--plot writes the same file", hint="rename one"
            )
        for flag, file in (("--plot", self.plot), ("--csv", self.csv)):
            if file is not None:
                check_writable(flag, file, force=self.force)


@dataclass(frozen=True, kw_only=True)
class AnimationFlags:
    """A film, and how fast it plays."""

    animate: flags.Animate = None
    speed: flags.Speed = None

    def check(self, output: OutputFlags) -> None:
        """Refuse, before anything is computed, what could not be written afterwards.

        Raises
        ------
        OutputError
            If the file is no .gif, exists and --force is off, its folder is missing or not
            writable, or it is asked for by another flag.
        InputError
            If the speed is not positive.
        ModelError
            If there is a speed and no film.
        """
        if self.speed is not None:
            positive("speed", self.speed, hint="give 1 for real time or one period a second")
        if self.animate is None:
            if self.speed is not None:
                raise ModelError(
                    name="speed",
                    value=self.speed,
                    valid="without --animate it has no meaning",
                    hint="add --animate run.gif, or leave it out",
                )
            return
        if self.animate.suffix.lower() != ".gif":
            raise OutputError(
                name="--animate",
                value=self.animate,
                valid="the ending says the format: .gif",
                hint="rename it",
            )
        for flag, file in (("--plot", output.plot), ("--csv", output.csv)):
            if _same_file(self.animate, file):
                raise OutputError(
                    name="--animate",
                    value=self.animate,
                    valid=f"{flag} writes the same file",
                    hint="rename one",
                )
        check_writable("--animate", self.animate, force=output.force)


def _same_file(one: Path | None, other: Path | None) -> bool:
    return one is not None and other is not None and one.absolute() == other.absolute()


def grouped(command: Callable[..., None]) -> Callable[..., None]:
    """Spread a command's parameters that are groups into one parameter for each of their flags."""
    own = inspect.signature(command, eval_str=True)
    groups: dict[str, type[Any]] = {
        name: parameter.annotation
        for name, parameter in own.parameters.items()
        if isinstance(parameter.annotation, type) and is_dataclass(parameter.annotation)
    }
    spread: list[inspect.Parameter] = []
    for name, parameter in own.parameters.items():
        if name in groups:
            spread += inspect.signature(groups[name], eval_str=True).parameters.values()
        else:
            spread.append(parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY))

    @wraps(command)
    def run(**values: Any) -> None:
        collected = {
            name: group(**{field.name: values.pop(field.name) for field in fields(group)})
            for name, group in groups.items()
        }
        command(**collected, **values)

    # typer reads both.
    run.__signature__ = own.replace(parameters=spread)  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in spread}
    return run
