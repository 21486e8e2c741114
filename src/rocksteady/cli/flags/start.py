"""Flags for the initial state of a motion."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rocksteady.cli.console.refusals import FlagError, refuse
from rocksteady.cli.flags import options
from rocksteady.cli.flags.parsing import decimal
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.validation import odd_order

if TYPE_CHECKING:
    from rocksteady.dynamics.history.start import Start, State

STEADY = ("steady", "steady:1", "steady:2")
TAU = "tau="
STATE_HINT = "write U,V (V = du/d(pt)) or U,tau=DU (du/d(omega t)), as 0.4,0"
HINT = "write rest, steady, steady:2, U,V (V = du/d(pt)) or U,tau=DU (du/d(omega t)), as 0.4,0"


@dataclass(frozen=True, kw_only=True)
class StartFlags:
    """A state to begin with, and the side on which an unstable one is left."""

    start: str = options.start()
    order: int = options.order()
    phase: float | None = options.phase()
    side: str = options.side()
    kick: float | None = options.kick()

    @property
    def sign(self) -> int:
        """+1 or -1, of --side."""
        return 1 if self.side == "+" else -1

    @property
    def first_phase(self) -> float:
        """Phase of the shaking at the start, 0 where none is given."""
        return 0.0 if self.phase is None else self.phase

    def values(self, phase: float) -> dict[str, object]:
        """Return what repeats the start; `phase` is the one with which it began."""
        return {
            "start": self.start,
            "order": self.order,
            "side": self.side,
            "kick": self.kick,
            "phase": phase,
        }

    def check(self, *, shaken: bool) -> None:
        """Refuse flags that are none or contradict each other.

        Raises
        ------
        InputError
            If the side is neither +1 nor -1.
        ModelError
            If a steady start has a phase, or something needs shaking and there is none.
        """
        if self.side not in ("+", "-"):
            raise InputError("side", self.side, "it must be + or -", "give + or -")
        if self.start in STEADY and self.phase is not None:
            raise FlagError(
                "--phase",
                self.phase,
                "a steady state decides its phase",
                "leave --phase or --start steady out",
            )
        if shaken:
            return
        if self.start in STEADY:
            raise FlagError(
                "--start",
                self.start,
                "a steady state needs shaking",
                "give shaking with -A and -W, or another start as 0.5,0",
            )
        refuse_without_shaking("--phase", self.phase)

    def of(self, frequency_ratio: float | None) -> "Start":
        """Return the start that the flags name, under shaking of a frequency ratio or none.

        Raises
        ------
        InputError
            If --start is no start, or a number is outside its range.
        ModelError
            If another start than a steady one has an order or a kick.
        """
        from rocksteady.dynamics.history.start import KICK, Rest, Steady

        odd_order("order", self.order)
        if self.start in STEADY:
            branch = 2 if self.start.endswith("2") else 1
            kick = KICK if self.kick is None else self.kick
            return Steady(branch=branch, order=self.order, kick=kick, side=self.sign)
        for name, thing, value, idle in (
            ("order", "an order", self.order, 1),
            ("kick", "a kick", self.kick, None),
        ):
            if value != idle:
                raise FlagError(
                    name,
                    value,
                    f"only a steady start has {thing}",
                    "add --start steady, or leave it out",
                )
        return Rest() if self.start == "rest" else state_from(self.start, frequency_ratio)

    @contextmanager
    def as_typed(self) -> Iterator[None]:
        """Name in errors about the start what was typed, not the object that it has become."""
        try:
            yield
        except ModelError as error:
            if error.name != "start":
                raise
            raise typed_error("start", self.start, error) from error


def typed_error(name: str, text: object, error: ModelError) -> FlagError:
    """Return an error with what was typed, and with the reason where the error has one."""
    given = Words(f"= {text!r} {error.value}") if isinstance(error.value, Words) else text
    return FlagError(name, given, error.valid, error.hint)


def refuse_without_shaking(flag: str, value: object) -> None:
    """Refuse a flag that only shaking gives a meaning.

    Raises
    ------
    ModelError
        If it has a value.
    """
    hint = "leave it out, or give shaking with -A and -W"
    refuse({flag: value}, "without shaking it has no meaning", hint)


def state_from(text: str, frequency_ratio: float | None, name: str = "start") -> "State":
    """Return the state that ``U,V`` or ``U,tau=DU`` names; `name` is the flag for errors.

    Raises
    ------
    InputError
        If the text is neither, or needs shaking and there is none.
    """
    from rocksteady.dynamics.history.start import State

    what, hint = ("known start", HINT) if name == "start" else ("state", STATE_HINT)
    first, comma, second = text.partition(",")
    per_tau = second.startswith(TAU)
    try:
        angle, velocity = decimal(first), decimal(second.removeprefix(TAU))
    except ValueError:
        valid = f"it is no {what}" if not comma else "it is not two numbers"
        raise InputError(name, text, valid, hint) from None
    if not (math.isfinite(angle) and math.isfinite(velocity)):
        raise InputError(name, text, "its numbers must be finite", hint)
    if not per_tau:
        return State(angle=angle, velocity=velocity)
    if frequency_ratio is None:
        valid = "du/d(omega t) needs harmonic shaking"
        raise InputError(name, text, valid, "give du/d(pt) as U,V")
    return State.per_tau(angle=angle, velocity_tau=velocity, frequency_ratio=frequency_ratio)
