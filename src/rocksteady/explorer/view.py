"""First view of the explorer: a block, its shaking and the initial state."""

from dataclasses import dataclass
from typing import Final

from rocksteady.dynamics.history.start import HasStart, ImpactState, Rest, Start, Steady, start_of
from rocksteady.errors import InputError, ModelError
from rocksteady.explorer._program import SCENES
from rocksteady.kernels.elementary.arrays import atan2, hypot
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.sides import housner_restitution, rectangle_p
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.model.equations import (
    TOLERANCE,
    Linear,
    Model,
    ModelChoice,
    Nonlinear,
    as_model,
    slender_block,
)
from rocksteady.model.motions.segments import Harmonic

PLACES: Final = (*SCENES, "lab")
TABS: Final = ("shake", "start", "quake", "size", "explore", "basins", "pulse", "design")
"""Questions of the laboratory, and the rooms for researchers behind them."""
FULL: Final = ("shake", "size")
"""Tabs that solve the full equations whatever the model."""
LIMITS: Final = {
    "amplitude": (0.0, 1000.0),
    "frequency_ratio": (0.01, 1000.0),
    "restitution": (0.01, 1.0),
    "width": (0.001, 1000.0),
    "height": (0.001, 1000.0),
    "scale": (0.01, 100.0),
}
"""Ends of what the page takes."""
FARTHEST: Final = 1e6
"""Largest number of a state that the page takes."""
DEFAULT_MOTION: Final = Harmonic(amplitude=2.0, frequency_ratio=3.0)
"""The shaking of a page without a first view."""
WINDOW: Final = {"w0": 0.5, "w1": 8.0, "a0": 0.0, "a1": 6.0}
"""Frequency ratios and amplitudes of its map."""
ROUNDED: Final = 1e-9
"""Relative difference of frequency parameters that are the same."""


@checked
@dataclass(frozen=True, kw_only=True)
class ExplorerView:
    """What the explorer's page shows first.

    Parameters
    ----------
    block
        A homogeneous rectangle under standard gravity, or a `DimensionlessBlock` where only its
        restitution matters; both sides alike.  Default: 0.5 m wide, 2 m high, restitution 0.8.
    motion
        Harmonic shaking of phase 0; default amplitude 2 at the frequency ratio 3.
    start
        `Rest` (default), `State`, `ImpactState`, or `Steady` without further choices.
    model
        ``"linear"`` or ``"nonlinear"``; None (default) for linear in maps of harmonic shaking and
        of a dimensionless block, else nonlinear.
    tab
        A question, "shake", "start", "quake" or "size", or a room for researchers, "explore",
        "basins", "pulse" or "design"; None (default) for "quake" where ground motions are put in,
        else "shake", which has blocks with a size at rest and the full equations, else "explore".
    scale
        Factor of the ground motion that is shown first, from 0.01 to 100; default 1.
    scene
        Where the page opens: "push" (a block on the ground), "swing", "size", "fall", "fates",
        "order" or "quake" (the six scenes), or "lab", the laboratory with the tabs; None (default)
        for "lab" where anything else is given, else "push".

    Raises
    ------
    InputError
        If a number is outside what the page takes, or there is no such tab or scene.
    ModelError
        If the page has no such block, start, phase or tolerance.

    Examples
    --------
    >>> view = ExplorerView(block=Block.rectangle(width=0.5, height=1.8), tab="size")
    >>> view.tab
    'size'
    """

    block: Block | DimensionlessBlock | None = None
    motion: Harmonic | None = None
    start: Start | HasStart | None = None
    model: ModelChoice = None
    tab: str | None = None
    scale: float = 1.0
    scene: str | None = None

    def __post_init__(self) -> None:
        """Validate."""
        _within("scale", self.scale, "give a factor, as 1.5")
        if self.tab is not None and self.tab not in TABS:
            raise InputError("tab", self.tab, f"it must be one of {', '.join(TABS)}", "choose one")
        if self.scene is not None and self.scene not in PLACES:
            raise InputError(
                "scene", self.scene, f"it must be one of {', '.join(PLACES)}", "choose one"
            )
        if self.motion is not None:
            _check_motion(self.motion)
        if self.block is not None:
            _check_block(self.block)
        model = as_model("model", self.model)
        _check_model(model, self.block)
        if self.tab in FULL and isinstance(model or self.block, Linear | DimensionlessBlock):
            valid = "it has blocks with a size, by the full equations"
            raise ModelError("tab", self.tab, valid, "give width and height, or choose explore")
        _ = _start_text(self.start)


def state_of(view: ExplorerView, *, on_records: bool) -> dict[str, str]:
    """Return a view as the keys and texts of a link.  Keys left out take the page's defaults.

    Parameters
    ----------
    view
        The view.
    on_records
        Whether ground motions are put in, which the page then opens on.
    """
    slender = isinstance(view.block, DimensionlessBlock)
    model = as_model("model", view.model)
    equations = "linear" if slender else "auto" if model is None else model.name
    state = {
        "at": view.scene or ("push" if is_plain(view) and not on_records else "lab"),
        "tab": view.tab or ("quake" if on_records else _first_tab(view)),
        "model": equations,
        "start": _start_text(view.start),
        "units": "none" if _is_dimensionless(view) and not on_records else "si",
    }
    if view.motion is not None:
        state |= _motion_state(view.motion)
    if view.block is not None:
        state |= _block_state(view.block)
    if view.scale != 1.0:
        state["scale"] = _text(view.scale)
    return state


def _first_tab(view: ExplorerView) -> str:
    """Return the question on which a view opens: the first, where its picture shows all of it."""
    linear = isinstance(as_model("model", view.model), Linear)
    whole = not (linear or _is_dimensionless(view)) and _start_text(view.start) == "rest"
    return "shake" if whole else "explore"


def _is_dimensionless(view: ExplorerView) -> bool:
    """Return whether a view gives amplitudes and ratios, and no size."""
    return isinstance(view.block, DimensionlessBlock) or (
        view.block is None and view.motion is not None
    )


def is_plain(view: ExplorerView) -> bool:
    """Return whether a view gives nothing that the laboratory alone shows."""
    nothing = (view.block, view.motion, view.model, view.tab) == (None, None, None, None)
    return nothing and view.scale == 1.0 and _start_text(view.start) == "rest"


def _motion_state(motion: Harmonic) -> dict[str, str]:
    """Return the shaking, and a window of the map with the point inside."""
    ratio, amplitude = motion.frequency_ratio, motion.amplitude
    state = {"A": _text(amplitude), "W": _text(ratio)}
    if ratio < WINDOW["w0"]:
        state["w0"] = _text(max(0.5 * ratio, LIMITS["frequency_ratio"][0]))
    if ratio > WINDOW["w1"]:
        state["w1"] = _text(min(1.5 * ratio, LIMITS["frequency_ratio"][1]))
    if amplitude > WINDOW["a1"]:
        state["a1"] = _text(min(1.5 * amplitude, LIMITS["amplitude"][1]))
    return state


def _block_state(block: Block | DimensionlessBlock) -> dict[str, str]:
    """Return the block: its restitution, and of one with a size also that."""
    state = {"r": _text(block.restitution)}
    if isinstance(block, Block):
        width, height = _measures(block)
        state |= {"b": _text(width), "h": _text(height)}
        if _is_housner(block):  # the restitution then follows the size
            state["rh"] = "1"
    return state


def _is_housner(block: Block) -> bool:
    """Return whether the restitution is Housner's."""
    try:
        whole = housner_restitution(
            block.alpha, p=block.p, radius=block.radius, gravity=block.gravity
        )
    except InputError:  # so stocky a block has none
        return False
    return block.restitution == whole


def _measures(block: Block) -> tuple[float, float]:
    """Return the full width and height [m] with the fewest digits that reproduce the block.

    A block made of other measures may have none; its own, rounded, then differ in the last digits.
    """
    for digits in range(1, 18):
        width, height = (float(f"{value:.{digits}g}") for value in (block.width, block.height))
        if (atan2(width, height), 0.5 * hypot(width, height)) == (block.alpha, block.radius):
            return width, height
    return block.width, block.height


def _text(value: float) -> str:
    """Return a number in the digits from which JavaScript reads the same."""
    return repr(int(value) if value.is_integer() else value)


def _within(name: str, value: float, hint: str) -> float:
    """Return a number that the page takes."""
    return in_range(name, value, *LIMITS[name], "[]", hint=hint)


def _check_motion(motion: Harmonic) -> None:
    """Refuse shaking that the page does not take."""
    if not isinstance(motion, Harmonic):
        raise ModelError(
            "motion",
            motion,
            "the first view is of a single sinusoid",
            "give a Harmonic(amplitude=..., frequency_ratio=...)",
        )
    _within("amplitude", motion.amplitude, "give a_max/(alpha g), as 2")
    _within("frequency_ratio", motion.frequency_ratio, "give omega/p, as 3")
    if motion.phase != 0.0:
        valid = "on the page shaking begins with phase 0"
        raise ModelError("phase", motion.phase, valid, "leave it out")


def _check_block(block: Block | DimensionlessBlock) -> None:
    """Refuse a block that the page does not take."""
    if not block.symmetric:
        raise ModelError(
            "block",
            "against a wall" if block.one_sided else "asymmetric",
            "the page has blocks whose sides are alike",
            "give a symmetric one",
        )
    _within("restitution", block.restitution, "give a ratio of angular velocities, as 0.8")
    if isinstance(block, DimensionlessBlock):
        return
    if block.gravity != STANDARD_GRAVITY:
        valid = f"the page computes with {STANDARD_GRAVITY} m/s^2"
        raise ModelError("gravity", block.gravity, valid, "leave it out")
    _within("width", block.width, "give the full width in metres")
    _within("height", block.height, "give the full height in metres")
    rate = rectangle_p(block.radius, block.gravity)
    if abs(block.p / rate - 1.0) > ROUNDED or not block.fills_outline:
        raise ModelError(
            "block",
            f"p {block.p:.6g} rad/s and its mass centre {block.positive.centre_height:.6g} m up in "
            f"{block.width + sum(block.overhangs):.6g} x {block.height:.6g} m",
            "the page has homogeneous rectangles, with the mass centre in the middle, of which one "
            f"of this alpha and R has {rate:.6g} rad/s",
            "give a block by its width and height",
        )


def _check_model(model: Model | None, block: Block | DimensionlessBlock | None) -> None:
    """Refuse equations of motion that the page does not solve."""
    if isinstance(model, Nonlinear):
        if isinstance(block, DimensionlessBlock):
            slender_block(block)
        if model.tolerance != TOLERANCE:
            valid = f"the page computes with {TOLERANCE:g}"
            raise ModelError("tolerance", model.tolerance, valid, "leave it out")


def _start_text(given: Start | HasStart | None) -> str:
    """Return a start as in the link of the page."""
    start = start_of(given)
    if isinstance(start, Rest):
        return "rest"
    if isinstance(start, Steady):
        if start != Steady():
            valid = "the page starts on the first branch of order 1"
            raise ModelError("start", start, valid, "give Steady() without further choices")
        return "steady"
    if isinstance(start, ImpactState):
        _check_far("speed", start.speed)
        return f"{start.side}:{_text(start.phase)}:{_text(start.speed)}"
    if start.phase is not None:
        valid = "on the page a state has the phase 0"
        raise ModelError("phase", start.phase, valid, "leave it out, or give an ImpactState")
    _check_far("angle", start.angle)
    _check_far("velocity", start.velocity)
    return f"{_text(start.angle)},{_text(start.velocity)}"


def _check_far(name: str, value: float) -> None:
    """Refuse a number of a state that the page does not take."""
    in_range(
        name, value, -FARTHEST, FARTHEST, "[]", hint="give theta/alpha and d(theta/alpha)/d(pt)"
    )
