"""Flags for the block and its shaking, converted to objects of the model."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from rocksteady.cli.console import terminal
from rocksteady.cli.console.refusals import FlagError, both, needs, refuse
from rocksteady.cli.flags import options
from rocksteady.cli.flags.options import FLAG_OF_ARGUMENT
from rocksteady.cli.flags.parsing import MOST_AXIS_POINTS, axis, restitution_from, single
from rocksteady.dynamics.parameters import SIZES
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.examples import SOURCES
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.housner_forms import Impacts, Restitution
from rocksteady.model.blocks.sizes import METRES, TALL
from rocksteady.model.checks.bounds import length
from rocksteady.model.checks.validation import LARGEST, Ends, in_range, non_negative
from rocksteady.model.equations import Model, Nonlinear, as_model, chosen_model
from rocksteady.model.motions.pulses import LISTED_PULSES, Pulse
from rocksteady.model.motions.segments import Harmonic

HARMONIC = ("--width-m 0.6 --height-m 2 --accel-g 0.5 --freq-hz 2", "-r 0.8 -A 2 -W 4")
"""Examples of a block and a harmonic motion."""
FIELDS = {name: FLAG_OF_ARGUMENT[name].removeprefix("--").replace("-", "_") for name in SIZES}
"""Fields of the flags of a block, by the measures that they are."""
FASTER = 5
"""How many times faster long maps and basins are in the linear model, rounded."""
LENGTHS = ("width", "height", "radius")
"""Measures in metres."""
EDGES = ("left", "right", "mass_centre_height", "gyration")
"""Measures of a block with its mass centre off the middle."""


@dataclass(frozen=True, kw_only=True)
class ShakingFlags:
    """Harmonic shaking, dimensionless or, for a block, in g and Hz."""

    amplitude: str | None = options.motion_flag(
        "--amplitude -A A",
        "Set the peak base acceleration over alpha g; 1 just lifts a block at rest.",
    )
    frequency_ratio: str | None = options.motion_flag(
        "--frequency-ratio -W W",
        "Set Omega = omega/p, the circular frequency of the shaking over the block's p.",
    )
    accel_g: str | None = options.motion_flag(
        "--accel-g G",
        "Set the peak base acceleration in g (9.80665 m/s^2), instead of -A; needs a block.",
    )
    accel_m_s2: str | None = options.motion_flag(
        "--accel-m-s2 ACC", "Set the peak base acceleration in m/s^2, instead of -A; needs a block."
    )
    freq_hz: str | None = options.motion_flag(
        "--freq-hz F", "Set the frequency of the shaking in Hz, instead of -W; needs a block."
    )

    @property
    def given(self) -> bool:
        """Whether there is any of them."""
        return bool(options.given_in(self))

    def parameters(self, block: Block | DimensionlessBlock) -> dict[str, list[float]]:
        """Return amplitudes and frequencies in the measures of the flags, g as m/s^2.

        Each is an axis or one value, by its name in `rocksteady.dynamics.parameters.AXES`.

        Raises
        ------
        InputError, ModelError
            If a value is missing, given twice, no number, negative, or needs a block.
        """
        peak = {"--accel-g": self.accel_g, "--accel-m-s2": self.accel_m_s2}
        hertz = {"--freq-hz": self.freq_hz}
        if isinstance(block, DimensionlessBlock):
            refuse(
                peak | hertz,
                "m/s^2, g and Hz need a block with a slenderness and a p",
                "describe a block, or give -A and -W",
            )
        for flags in (
            {"--amplitude/-A": self.amplitude} | peak,
            {"--frequency-ratio/-W": self.frequency_ratio} | hertz,
        ):
            named = [flag for flag, value in flags.items() if value is not None]
            valid = "exactly one of the two is needed"
            if len(named) > 1:
                raise both(*named[:2], valid=valid)
            if not named:
                first, second, *_ = flags
                raise FlagError(
                    finding=f"of {first} and {second}, neither given",
                    valid=valid,
                    hint="give one",
                )
        axes_given: dict[str, list[float]] = {}
        if self.amplitude is not None:
            axes_given["amplitude"] = axis("amplitude", self.amplitude)
        if self.accel_g is not None and isinstance(block, Block):
            peaks = axis("--accel-g", self.accel_g)
            for end in (peaks[0], peaks[-1]):
                non_negative("--accel-g", end, hint="give the peak in g; 0.3 is usual")
            axes_given["acceleration_m_s2"] = [min(g, LARGEST) * STANDARD_GRAVITY for g in peaks]
        if self.accel_m_s2 is not None:
            peaks = axis("--accel-m-s2", self.accel_m_s2)
            for end in (peaks[0], peaks[-1]):
                non_negative("--accel-m-s2", end, hint="give the peak in m/s^2; 3 is usual")
            axes_given["acceleration_m_s2"] = peaks
        if self.frequency_ratio is not None:
            axes_given["frequency_ratio"] = axis("frequency_ratio", self.frequency_ratio)
        if self.freq_hz is not None:
            axes_given["frequency_hz"] = axis("--freq-hz", self.freq_hz)
        return axes_given

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
                "-A and -W",
                f"{len(amplitudes)} amplitudes x {len(ratios)} frequencies",
                f"they may have {MOST_AXIS_POINTS} points together",
                "take fewer points",
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


@dataclass(frozen=True, kw_only=True)
class PulseFlags:
    """A pulse in place of endless shaking."""

    pulse: str | None = options.motion_flag(
        "--pulse NAME",
        "Shake with a single pulse, after which the base stands still; its size and frequency "
        "are those of -A and -W, or --accel-g and --freq-hz. "
        f"{LISTED_PULSES} (whose nu is --phase).",
    )
    oscillations: float | None = options.motion_flag(
        "--oscillations GAMMA", "Set gamma of --pulse mavroeidis-papageorgiou, above 1; default 2."
    )

    @property
    def given(self) -> bool:
        """Whether there is a pulse.

        Raises
        ------
        ModelError
            If there is none, and something that only a pulse has.
        """
        shape = "mavroeidis-papageorgiou"
        needs("--oscillations", self.oscillations, "--pulse", shape, beside=self.pulse)
        return self.pulse is not None

    def of(self, size: Harmonic, *, phase: float | None, reverse: bool = False) -> Pulse:
        """Return the pulse with the amplitude and the frequency of some shaking.

        Raises
        ------
        InputError, ModelError
            If there is no pulse of that name, or it cannot have the oscillations or the phase.
        """
        return Pulse(
            shape=self.pulse or "",
            amplitude=size.amplitude,
            frequency_ratio=size.frequency_ratio,
            oscillations=self.oscillations,
            phase=phase,
            reverse=reverse,
        )


def _felt(
    block: Block | DimensionlessBlock, acceleration_m_s2: float, frequency_hz: float | None = None
) -> Harmonic:
    """Return what a block feels of a ground of which only a part is needed."""
    assert isinstance(block, Block)
    hertz = block.p if frequency_hz is None else frequency_hz  # valid for every block
    return Harmonic.from_si(block, acceleration_m_s2=acceleration_m_s2, frequency_hz=hertz)


def _off_centre(*, width: float, height: float, offset: float = 0.0, **others: Any) -> Block:
    """Return the block of --width-m and --height-m with its mass off the middle."""
    length("give the full width in metres")("width", width)
    half = 0.5 * width
    hint = "give metres from the middle of the base, positive to the right"
    in_range("--offset-m", offset, -half, half, "()", hint=hint)
    return Block.asymmetric(left=half + offset, right=half - offset, height=height, **others)


WAYS: tuple[tuple[set[str], set[str], Callable[..., Block]], ...] = (
    ({"name"}, set(), Block.named),
    ({"width", "height"}, set(), Block.rectangle),
    ({"width", "height", "offset"}, {"mass_centre_height", "gyration"}, _off_centre),
    ({"width", "height", "mass_centre_height"}, {"gyration"}, _off_centre),
    ({"left", "right", "height"}, {"mass_centre_height", "gyration"}, Block.asymmetric),
    ({"alpha", "radius"}, set(), Block.from_radius),
    ({"alpha", "p"}, set(), Block.from_p),
)
"""Ways to describe a block: the measures that one needs, those it may have, and what makes it."""


def _build(name: str | None, measures: dict[str, list[float]], **others: Any) -> Block:
    """Return the block that a name or measures describe.

    Raises
    ------
    InputError
        If a measure is an axis, or outside its range.
    FlagError
        If no way to describe a block has these measures.
    """
    flags = {measure: FLAG_OF_ARGUMENT.get(measure, f"--{measure}-m") for measure in measures}
    values: dict[str, Any] = {
        measure: single(flags[measure], axis) for measure, axis in measures.items()
    }
    if name is not None:
        flags, values = {"name": "--block"} | flags, values | {"name": name}
    for edge in EDGES if name is None else ():
        if edge in values:  # the width that follows has no flag
            in_range(edge, values[edge], 0.0, LARGEST, hint="give a distance in metres, as 0.3")
    for needed, optional, make in WAYS:
        if needed <= values.keys() <= needed | optional:
            return make(**values, **others)
    raise FlagError(
        finding=f"no block is described by {' '.join(flags.values())} alone",
        valid="it is described by --width-m with --height-m (and --offset-m, "
        "--mass-centre-height-m), by --alpha-rad with "
        "--radius-m, by --alpha-rad with --p-rad-s, by --left-m and --right-m with "
        "--height-m, or by --block alone",
        hint="give one of these pairs, or the three",
    )


@dataclass(frozen=True, kw_only=True)
class BlockFlags:
    """A block, or its restitution alone."""

    restitution: str | None = options.restitution()
    one_sided: bool | None = options.one_sided()
    block: str | None = options.block_flag(
        "--block NAME", f"Take a named block: {', '.join(SOURCES)}."
    )
    width_m: str | None = options.block_flag("--width-m M", "Set the full width of the base \\[m].")
    height_m: str | None = options.block_flag("--height-m M", "Set the full height \\[m].")
    offset_m: float | None = options.block_flag(
        "--offset-m M",
        "Move the mass centre off the middle of --width-m \\[m], positive to the right, away from "
        "the left edge, the pivot of positive rotation, as offset_m in files of objects; default "
        "0. The radius of gyration about the mass centre stays that of the homogeneous outline.",
    )
    mass_centre_height_m: float | None = options.block_flag(
        "--mass-centre-height-m M",
        "Set the height of the mass centre above the base \\[m], with --height-m and --width-m "
        "or --left-m and --right-m; default half of --height-m. The radius of gyration about the "
        "mass centre stays that of the homogeneous outline, unless --gyration-m is given.",
    )
    left_m: float | None = options.block_flag(
        "--left-m M",
        "Set the distance from the left edge to the mass centre \\[m], with --right-m and "
        "--height-m: a block whose sides differ. The left edge is the pivot of positive rotation, "
        "and its side the unit of angles and times.",
    )
    right_m: float | None = options.block_flag(
        "--right-m M", "Set the distance from the right edge to the mass centre \\[m]."
    )
    gyration_m: float | None = options.block_flag(
        "--gyration-m M",
        "Set the radius of gyration about the mass centre \\[m], with --left-m, --offset-m or "
        "--mass-centre-height-m; default that of the homogeneous rectangle of this base and "
        "height.",
    )
    alpha_rad: str | None = options.block_flag(
        "--alpha-rad RAD", "Set the slenderness, the tilt at which the block balances \\[rad]."
    )
    radius_m: str | None = options.block_flag(
        "--radius-m M",
        "Set the distance from pivot to mass centre \\[m] of a homogeneous rectangle.",
    )
    p_rad_s: str | None = options.block_flag(
        "--p-rad-s P",
        "Set the frequency parameter sqrt(M g R/I_0) \\[rad/s], instead of --radius-m.",
    )
    columns: int | None = options.block_flag(
        "--columns N",
        "Set the number of equal columns of a rocking frame, each the block that is described, "
        "with --cap-mass-ratio; --restitution is then that of the frame. One column is a single "
        "body with the cap as a point mass on the middle of its top.",
    )
    cap_mass_ratio: float | None = options.block_flag(
        "--cap-mass-ratio GAMMA",
        "Set the mass of the frame's cap over that of all --columns together.",
    )
    gravity_m_s2: float | None = options.gravity_m_s2()

    @property
    def given(self) -> bool:
        """Whether there is any of them."""
        return bool(options.given_in(self))

    def described(self) -> Block | DimensionlessBlock:
        """Return the block that the flags describe; a dimensionless one where none does.

        Raises
        ------
        InputError
            If a number is outside its range.
        ModelError
            If the flags describe a block in two ways, or half of one.
        """
        self._check_lengths()
        if self.one_sided:
            return self._against_wall()
        if self.columns is not None or self.cap_mass_ratio is not None:
            return self._framed()
        if self.block is None and not self._measures:
            refuse(
                {"--gravity-m-s2": self.gravity_m_s2},
                "without a block gravity has no meaning",
                "describe a block, or leave it out",
            )
            first, second = Impacts.of(restitution_from(self.restitution, default=None)).numbers
            return DimensionlessBlock(restitution=first, negative_restitution=second)
        ratio = restitution_from(self.restitution, default="housner")
        pair = Impacts.of(ratio).pair
        gravity = STANDARD_GRAVITY if self.gravity_m_s2 is None else self.gravity_m_s2
        impacts: dict[str, Any] = {"restitution": ratio if pair is None else pair[0]}
        if self.block is not None and self.restitution is None:
            impacts = {}  # those of its source
        block = _build(self.block, self._measures, gravity=gravity, **impacts)
        return block if pair is None else block.with_restitution(pair)

    def _check_lengths(self) -> None:
        """Refuse sizes that are taken for millimetres, in the words of object files.

        Raises
        ------
        InputError
            With the flag, if a size is above 50 m.
        """
        for name in (*LENGTHS, *EDGES):
            values = self._measures.get(name, [])
            for end in values[:1] + values[-1:]:
                if end > TALL:
                    raise InputError(
                        FLAG_OF_ARGUMENT[name],
                        end,
                        f"a size here is at most {TALL:g} m",
                        f"{METRES}, or describe a larger block by --alpha-rad and --p-rad-s",
                    )

    def _against_wall(self) -> Block | DimensionlessBlock:
        """Return the block against a wall, of which the restitution is that."""
        # Impacts on the base alone do not occur, and need no restitution.
        free = replace(self, one_sided=None, restitution="1").described()
        sized = isinstance(free, Block)
        default: Restitution | None = "housner" if sized else None
        ratio = Impacts.of(restitution_from(self.restitution, default=default, wall=True)).of_wall
        if isinstance(free, Block):
            return free.against_wall(ratio)
        assert isinstance(ratio, float)  # without a size no other form is taken
        return DimensionlessBlock(restitution=ratio, one_sided=True)

    def _framed(self) -> Block:
        """Return the frame of the block that the other flags describe."""
        moved = {"--offset-m": self.offset_m, "--mass-centre-height-m": self.mass_centre_height_m}
        refuse(moved, "a frame's columns have their mass in mid-height")
        column = replace(self, columns=None, cap_mass_ratio=None, restitution="1").described()
        if self.columns is None or self.cap_mass_ratio is None or not isinstance(column, Block):
            flags = {"--columns": self.columns, "--cap-mass-ratio": self.cap_mass_ratio}
            given = " and ".join(flag for flag, value in flags.items() if value is not None)
            raise FlagError(
                finding=f"no frame is described by {given} alone",
                valid="it needs --columns, --cap-mass-ratio and the size of one column",
                hint="give them, as --width-m 1.6 --height-m 9.6 --columns 4 --cap-mass-ratio 2",
            )
        return column.capped(
            columns=self.columns,
            cap_mass_ratio=self.cap_mass_ratio,
            restitution=restitution_from(self.restitution, default="housner"),
        )

    def refuse_sides(self, valid: str, hint: str) -> FlagError:
        """Return the error of a block whose sides differ, with the flags that make them differ."""
        if self.one_sided:
            return FlagError(
                finding="--one-sided makes a block that rocks to one side alone",
                valid=valid,
                hint=hint,
            )
        flags_given = "--left-m and --right-m" if self.left_m else "--restitution/-r"
        flags_given = "--offset-m" if self.offset_m else flags_given
        verb = "make" if " and " in flags_given else "makes"
        finding = f"{flags_given} {verb} a block whose sides differ"
        return FlagError(finding=finding, valid=valid, hint=hint)

    @cached_property
    def _measures(self) -> dict[str, list[float]]:
        """All measures that are given, each an axis or one value."""
        numbers = {name: getattr(self, f"{name}_m") for name in (*EDGES, "offset")}
        return self.sizes | {name: [value] for name, value in numbers.items() if value is not None}

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
        bounds: Ends = "[]" if self.one_sided else "(]"
        for end in (values[0], values[-1]):
            hint = f"give an axis inside {bounds[0]}0, 1]"
            in_range("restitution", end, 0.0, 1.0, bounds, hint=hint)
        return values

    def at_first(self) -> "BlockFlags":
        """Return the flags with the first value of each axis in its place."""
        first: dict[str, Any] = {
            FIELDS[name]: repr(values[0]) for name, values in self.sizes.items()
        }
        if self.restitutions:
            first["restitution"] = repr(self.restitutions[0])
        return replace(self, **first)


def equations_for(
    model: str | None,
    body: Block | DimensionlessBlock,
    tolerance: float | None = None,
) -> Model:
    """Return the equations of motion of --model and --tolerance for a block.

    Raises
    ------
    InputError, ModelError
        If the nonlinear model meets a block of which only the restitution is known, or as for
        `named_model`.
    """
    if model == "nonlinear" and not isinstance(body, Block):
        raise FlagError(
            "--model",
            model,
            "the full equations need the block's slenderness",
            "give the block, as --alpha-rad 0.3 --radius-m 1 or --width-m 0.4 --height-m 1.2",
        )
    name = chosen_model(None, body).name if model is None else model
    if model is None and name == "nonlinear":
        terminal.suggest(f"--model linear, if that will do, is about {FASTER} times faster")
    return named_model(name, tolerance)


def named_model(name: str, tolerance: float | None = None) -> Model:
    """Return the equations of motion of a name, to within a tolerance.

    Raises
    ------
    InputError, ModelError
        If there are none of that name, or the linear model meets a tolerance.
    """
    model = as_model("model", name)
    assert model is not None
    refuse_of_linear(name, "--tolerance", tolerance)
    return model if tolerance is None else Nonlinear(tolerance=tolerance)


def refuse_of_linear(model: str | None, name: str, value: object) -> None:
    """Refuse what only the nonlinear model has.

    Raises
    ------
    ModelError
        If it is given with the linear model.
    """
    if model == "linear":
        hint = "leave it out, or take --model nonlinear"
        refuse({name: value}, "only the nonlinear model has it", hint)
