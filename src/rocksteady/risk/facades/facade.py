"""A facade: wall, parapet or gable with its loads, pushing masses, ties and thrusts."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.housner_forms import housner_factor
from rocksteady.model.blocks.sides import Restitution, restitution_value, wall_restitution_value
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import Ends, in_range
from rocksteady.results.numbers import number
from rocksteady.risk.facades.mechanism import Mechanism

Kind = Literal["wall", "parapet", "gable"]

KNOWLEDGE_LEVELS: Final[Mapping[str, float]] = {"LC1": 1.35, "LC2": 1.2, "LC3": 1.0}
"""Confidence factor of each level of knowledge (Circolare 2019 n. 7, C8.5.4)."""

METRES: Final = "sizes are in metres: write 0.3 for 300 mm"
KILONEWTONS: Final = "give it in kN, for the whole length of the facade"

BOUNDS: Final[Mapping[str, tuple[float, float, Ends, str]]] = {
    "thickness_m": (0.05, 5.0, "[]", METRES),
    "height_m": (0.1, 50.0, "[]", METRES),
    "length_m": (0.1, 200.0, "[]", METRES),
    "unit_weight_kn_m3": (8.0, 30.0, "[]", "give it in kN/m^3, as 18: 1800 kg/m^3 are 17.7"),
    "hinge_inset_m": (0.0, 5.0, "[]", METRES),
    "confidence_factor": (1.0, 2.0, "[]", "give 1.35, 1.2 or 1.0, for LC1, LC2 or LC3"),
    "weight_kn": (0.0, 1e6, "(]", KILONEWTONS),
    "force_kn": (0.0, 1e6, "(]", KILONEWTONS),
    "x_m": (-5.0, 10.0, "[]", f"give the distance inwards of the outer face; {METRES}"),
    "z_m": (0.0, 100.0, "(]", f"give the height above the hinge; {METRES}"),
}
"""Lowest and highest number of each quantity, whether they belong to it, and what to do."""

MOST_HELD: Final = 10.0
"""M/K above which the forces of ties are taken for ones in another unit."""

MOST_KN_M2: Final = 1e4
"""Mean stress at the base [kN/m^2] above which weights are taken for ones in another unit."""


@checked
@dataclass(frozen=True, kw_only=True)
class Load:
    """A weight on the facade that moves with it [kN].

    Parameters
    ----------
    name
        What it is, as "roof".
    weight_kn
        Weight on the whole length of the facade [kN].
    x_m
        Distance inwards from the outer face [m]; below 0 outside, as of a balcony.
    z_m
        Height above the hinge [m].

    Raises
    ------
    InputError
        If a number is outside its range.
    """

    name: str
    weight_kn: float
    x_m: float
    z_m: float

    def __post_init__(self) -> None:
        """Validate."""
        _check_numbers(self, "load", ("weight_kn", "x_m", "z_m"))


@checked
@dataclass(frozen=True, kw_only=True)
class PushingMass:
    """A mass that pushes the facade in an earthquake but does not load it [kN].

    Parameters
    ----------
    name
        What it is, as "vault".
    weight_kn
        Its weight on the whole length of the facade [kN].
    z_m
        Height above the hinge at which it pushes [m].

    Raises
    ------
    InputError
        If a number is outside its range.
    """

    name: str
    weight_kn: float
    z_m: float

    def __post_init__(self) -> None:
        """Validate."""
        _check_numbers(self, "mass", ("weight_kn", "z_m"))


@checked
@dataclass(frozen=True, kw_only=True)
class Tie:
    """A tie that pulls the facade inwards with a constant force [kN].

    Parameters
    ----------
    name
        What it is, as "tie rods of floor 1".
    force_kn
        Its strength on the whole length of the facade [kN]: the least of steel, anchor and wall.
    z_m
        Height above the hinge [m].

    Raises
    ------
    InputError
        If a number is outside its range.
    """

    name: str
    force_kn: float
    z_m: float

    def __post_init__(self) -> None:
        """Validate."""
        _check_numbers(self, "tie", ("force_kn", "z_m"))


@checked
@dataclass(frozen=True, kw_only=True)
class Thrust:
    """A static outward thrust on the facade [kN], as of an arch or a roof.

    Parameters
    ----------
    name
        What it is, as "vault".
    force_kn
        Its force on the whole length of the facade [kN].
    z_m
        Height above the hinge [m].

    Raises
    ------
    InputError
        If a number is outside its range.
    """

    name: str
    force_kn: float
    z_m: float

    def __post_init__(self) -> None:
        """Validate."""
        _check_numbers(self, "thrust", ("force_kn", "z_m"))


@checked
@dataclass(frozen=True, kw_only=True)
class Facade:
    """A wall, parapet or gable that may overturn outwards about a horizontal hinge.

    Parameters
    ----------
    name
        Name of the facade.
    kind
        "wall" (default), "parapet" or "gable", a triangle on its base.
    thickness_m, height_m
        Thickness and height above the hinge [m].
    length_m
        Length of the facade, of a gable its base [m]; default 1.
    unit_weight_kn_m3
        Weight of the masonry [kN/m^3]; default 18.
    hinge_inset_m
        Distance of the hinge inwards from the outer face [m], where masonry crushes; default 0.
    loads, masses, ties, thrusts
        Weights on the facade, masses that push it in an earthquake, ties that hold it and static
        thrusts on it, each on the whole length; default none.
    confidence_factor
        FC from 1 to 2: 1.35 (default) of knowledge level LC1, 1.2 of LC2, 1.0 of LC3.
    one_sided
        Whether the building behind stops it; default None: True, of a parapet False.
    restitution
        Restitution of the impacts on the building behind, in [0, 1], or of two-sided rocking, in
        (0, 1]; "housner" (default) for conservation of angular momentum.

    Raises
    ------
    InputError
        If a number is outside its range.
    ModelError
        If the facade falls by itself, is held beyond reason, or rocks to both sides with loads,
        ties or thrusts.

    Examples
    --------
    >>> wall = Facade(name="front", thickness_m=0.3, height_m=3.0)
    >>> print(f"{wall.weight_kn:.1f} kN, a0 {wall.mechanism.a0_g:.6f} g")
    16.2 kN, a0 0.098765 g
    >>> roof = Load(name="roof", weight_kn=5.0, x_m=0.2, z_m=3.0)
    >>> tied = Facade(
    ...     name="front",
    ...     thickness_m=0.3,
    ...     height_m=3.0,
    ...     loads=(roof,),
    ...     ties=(Tie(name="rods", force_kn=4.0, z_m=2.8),),
    ... )
    >>> print(f"a0 {tied.mechanism.a0_g:.4f} g")
    a0 0.3543 g
    """

    name: str
    kind: Kind = "wall"
    thickness_m: float
    height_m: float
    length_m: float = 1.0
    unit_weight_kn_m3: float = 18.0
    hinge_inset_m: float = 0.0
    loads: tuple[Load, ...] = ()
    masses: tuple[PushingMass, ...] = ()
    ties: tuple[Tie, ...] = ()
    thrusts: tuple[Thrust, ...] = ()
    confidence_factor: float = KNOWLEDGE_LEVELS["LC1"]
    one_sided: bool | None = None
    restitution: Restitution = "housner"

    def __post_init__(self) -> None:
        """Validate."""
        names = ("thickness_m", "height_m", "length_m", "unit_weight_kn_m3", "hinge_inset_m")
        _check_numbers(self, "", (*names, "confidence_factor"))
        for group in ("loads", "masses", "ties", "thrusts"):
            object.__setattr__(self, group, tuple(getattr(self, group)))
        if self.one_sided is None:
            object.__setattr__(self, "one_sided", self.kind != "parapet")
        self._check_restitution()
        self._check_places()
        self._check_sides()
        self._check_stress()
        self._check_stands()

    @property
    def knowledge_level(self) -> str | None:
        """Knowledge level of the confidence factor; None of any other factor."""
        levels = {factor: level for level, factor in KNOWLEDGE_LEVELS.items()}
        return levels.get(self.confidence_factor)

    @property
    def weight_kn(self) -> float:
        """Weight of the facade itself [kN]."""
        full = self.unit_weight_kn_m3 * self.thickness_m * self.height_m * self.length_m
        return 0.5 * full if self.kind == "gable" else full

    @functools.cached_property
    def mechanism(self) -> Mechanism:
        """Overturning about the hinge."""
        weight, height = self.weight_kn, self.height_m
        centre, square = (1.0 / 3.0, 1.0 / 6.0) if self.kind == "gable" else (0.5, 1.0 / 3.0)
        inner = 0.5 * self.thickness_m - self.hinge_inset_m
        across = self.thickness_m * self.thickness_m / 12.0 + inner * inner
        carried = [(load.weight_kn, load.x_m - self.hinge_inset_m, load.z_m) for load in self.loads]
        pushing = [(mass.weight_kn, mass.z_m) for mass in self.masses]
        own_moment, own_second = weight * (height * centre), weight * (height * height * square)
        weight_lever = weight * inner + math.fsum(w * x for w, x, _ in carried)
        weight_moment = own_moment + math.fsum(w * z for w, _, z in carried)
        push_second = math.fsum(w * z * z for w, z in pushing)
        weight_second = own_second + math.fsum(w * z * z for w, _, z in carried)
        inertia = weight_second + weight * across + math.fsum(w * x * x for w, x, _ in carried)
        inertia += push_second
        weights = weight + math.fsum(w for w, _, _ in carried)
        reach = (weight_lever * weight_lever + weight_moment * weight_moment) / weights
        return Mechanism(
            name=self.name,
            stabilising_kn_m=weight_lever + _moment(self.ties) - _moment(self.thrusts),
            weight_moment_kn_m=weight_moment,
            push_moment_kn_m=weight_moment + math.fsum(w * z for w, z in pushing),
            push_kn=weights + math.fsum(w for w, _ in pushing),
            second_moment_kn_m2=weight_second + push_second,
            inertia_kn_m2=inertia,
            compactness=reach / inertia,
            confidence_factor=self.confidence_factor,
            one_sided=bool(self.one_sided),
            restitution=self.restitution,
        )

    def _check_restitution(self) -> None:
        """Refuse a restitution outside the range of one-sided or of two-sided rocking."""
        if housner_factor(self.restitution) is None:
            fit = wall_restitution_value if self.one_sided else restitution_value
            object.__setattr__(self, "restitution", fit(self.restitution))

    def _check_places(self) -> None:
        """Refuse a hinge outside the wall, and what acts above it."""
        if self.hinge_inset_m >= self.thickness_m:
            raise InputError(
                "hinge_inset_m",
                self.hinge_inset_m,
                f"the hinge lies inside the wall, below thickness_m = {self.thickness_m:g}",
                "give the distance inwards from the outer face; 0 where nothing crushes",
            )
        for load in self.loads:
            if load.x_m > 2.0 * self.thickness_m:
                raise InputError(
                    f"x_m of {load.name}",
                    load.x_m,
                    f"it is at most twice thickness_m = {self.thickness_m:g}",
                    "give the distance of the load inwards from the outer face in metres",
                )
        for group, most in (("loads", 2.0), ("masses", 2.0), ("ties", 1.0), ("thrusts", 1.0)):
            for each in getattr(self, group):
                if each.z_m > most * self.height_m:
                    raise InputError(
                        f"z_m of {each.name}",
                        each.z_m,
                        f"it is at most {'twice ' if most > 1.0 else ''}height_m = "
                        f"{self.height_m:g}",
                        "give the height above the hinge in metres",
                    )

    def _check_sides(self) -> None:
        """Refuse what acts on one side only where the facade rocks to both."""
        if self.one_sided:
            return
        for group in ("loads", "ties", "thrusts"):
            if getattr(self, group):
                raise ModelError(
                    group,
                    Words(f"do not go with a {self.kind} that rocks to both sides"),
                    "they hold or push one side otherwise than the other",
                    f"leave {group} out, or set one_sided = true",
                )

    def _check_stress(self) -> None:
        """Refuse weights that no masonry carries, as those in N are."""
        carried = math.fsum(load.weight_kn for load in self.loads)
        stress = (self.weight_kn + carried) / (self.thickness_m * self.length_m)
        if carried and stress > MOST_KN_M2:
            heaviest = max(self.loads, key=lambda load: load.weight_kn)
            raise InputError(
                f"weight_kn of {heaviest.name}",
                heaviest.weight_kn,
                f"weights on the base make {number(stress / 1e3)} MPa, and masonry bears less than "
                f"{MOST_KN_M2 / 1e3:g} MPa",
                KILONEWTONS,
            )

    def _check_stands(self) -> None:
        """Refuse a facade that falls without an earthquake, or that ties hold in any."""
        mechanism = self.mechanism
        held = mechanism.stabilising_kn_m
        if self.ties and held > MOST_HELD * mechanism.weight_moment_kn_m:
            raise ModelError(
                "force_kn of the ties",
                Words(f"hold {number(held)} kN m about the hinge, with the weights"),
                f"a facade is held by at most {MOST_HELD:g} times its weights times their heights, "
                f"which are {number(mechanism.weight_moment_kn_m)} kN m",
                KILONEWTONS,
            )
        if held > 0.0:
            return
        pushed = _moment(self.thrusts)
        top = max((each.z_m for each in self.ties), default=self.height_m)
        raise ModelError(
            self.name,
            Words("falls by itself"),
            f"weights and ties hold {number(held + pushed)} kN m about the hinge against "
            f"{number(pushed)} kN m of thrusts",
            f"add ties of more than {number(-held / top)} kN at {number(top)} m, or check "
            "hinge_inset_m, loads and thrusts",
        )


def _moment(forces: tuple[Tie, ...] | tuple[Thrust, ...]) -> float:
    """Return the moment of horizontal forces about the hinge [kN m]."""
    return math.fsum(each.force_kn * each.z_m for each in forces)


def _check_numbers(
    thing: Facade | Load | PushingMass | Tie | Thrust, kind: str, keys: tuple[str, ...]
) -> None:
    """Validate the name and the numbers of a thing, and keep them as floats."""
    name: object = thing.name
    if not isinstance(name, str) or not name.strip() or not name.isprintable():
        # Others break lines, move the cursor of a terminal or turn the text around.
        valid = "it must be a text of printable characters in one line"
        raise InputError("name", name, valid, "give a name, as 'roof'")
    place = f" of {kind} {thing.name}" if kind else ""
    for key in keys:
        low, high, ends, hint = BOUNDS[key]
        value = in_range(f"{key}{place}", getattr(thing, key), low, high, ends, hint=hint)
        object.__setattr__(thing, key, value)
