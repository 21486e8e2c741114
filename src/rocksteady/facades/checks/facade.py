"""A facade: wall, parapet or gable with its loads, pushing masses, ties and thrusts."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.facades.checks.actions import (
    KILONEWTONS,
    Load,
    Moments,
    PushingMass,
    Thrust,
    Tie,
    check_numbers,
    unfavourable,
)
from rocksteady.facades.checks.mechanism import Mechanism
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.housner_forms import Impacts, Restitution
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import RESTITUTION, restitution_of_wall
from rocksteady.results.numbers import number

Kind = Literal["wall", "parapet", "pinnacle", "gable"]
FREE: Final = ("parapet", "pinnacle")
"""Kinds that are free to vibrate, whatever stands behind."""

KNOWLEDGE_LEVELS: Final[Mapping[str, float]] = {"LC1": 1.35, "LC2": 1.2, "LC3": 1.0}
"""Confidence factor of each level of knowledge (Circolare 2019 n. 7, C8.5.4)."""

KAPPA: Final = 6.2
"""Factor of T0 of a cantilever of one section (C8.7.1.9); 2 pi sqrt(12)/3.516 = 6.19."""
KAPPA_GABLE: Final = 3.042
"""That of a triangle on its base, 2 pi sqrt(12)/7.155: of beam theory, not of the circular."""

MOST_HELD: Final = 10.0
"""M/K above which the forces of ties are taken for ones in another unit."""

MOST_KN_M2: Final = 1e4
"""Mean stress at the base [kN/m^2] above which weights are taken for ones in another unit."""


@checked
@dataclass(frozen=True, kw_only=True)
class Facade:
    """A wall, parapet or gable that may overturn outwards about a horizontal hinge.

    Parameters
    ----------
    name
        Name of the facade.
    kind
        "wall" (default), "parapet", "pinnacle" or "gable", a triangle on its base.
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
        Whether the building behind stops it; default None: True, of a parapet or pinnacle False.
    restitution
        Restitution of the impacts on the building behind, in [0, 1], or of two-sided rocking, in
        (0, 1]; "housner" (default) for conservation of angular momentum.
    base_height_m
        Height of the hinge above the ground z [m]; default None.  The checks of all but a wall
        against a building need it.
    elastic_modulus_mpa
        Modulus of the masonry E [MPa]; default None.  The checks of an element free to vibrate need
        it, or `elastic_period_s`.
    elastic_period_s
        Period of its elastic vibration T0 [s]; default None: that of `elastic_modulus_mpa`.

    Raises
    ------
    InputError
        If a number is outside its range.
    ModelError
        If the facade falls by itself, also once ties have ended; is held beyond reason; or rocks to
        both sides with loads, ties or thrusts.

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
    base_height_m: float | None = None
    elastic_modulus_mpa: float | None = None
    elastic_period_s: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        names = ("thickness_m", "height_m", "length_m", "unit_weight_kn_m3", "hinge_inset_m")
        options = ("base_height_m", "elastic_modulus_mpa", "elastic_period_s")
        given = [key for key in options if getattr(self, key) is not None]
        check_numbers(self, "", (*names, "confidence_factor", *given))
        for group in ("loads", "masses", "ties", "thrusts"):
            object.__setattr__(self, group, tuple(getattr(self, group)))
        if self.one_sided is None:
            object.__setattr__(self, "one_sided", self.kind not in FREE)
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

    @property
    def free(self) -> bool:
        """Whether it is free to vibrate: a parapet, a pinnacle, or nothing stands behind it."""
        return self.kind in FREE or not self.one_sided

    @property
    def t0_s(self) -> float | None:
        """Period T0 of an element free to vibrate [s] (C8.7.1.9); None of others, or unknown.

        ``T0 = kappa lambda L sqrt(W/(g E))``, lambda = L/t: a cantilever of one section, without
        what it carries.
        """
        if not self.free or self.elastic_period_s is not None:
            return self.elastic_period_s if self.free else None
        if self.elastic_modulus_mpa is None or self.loads or self.masses:
            return None
        kappa = KAPPA_GABLE if self.kind == "gable" else KAPPA
        slow = self.unit_weight_kn_m3 / (STANDARD_GRAVITY * 1e3 * self.elastic_modulus_mpa)
        return kappa * self.height_m / self.thickness_m * self.height_m * math.sqrt(slow)

    @property
    def ending(self) -> tuple[Load | Tie | Thrust, ...]:
        """What acts at rest and is not counted in d0."""
        return tuple(each for each, _, lasts in self._actions if not lasts)

    @functools.cached_property
    def _body(self) -> list[Moments]:
        """Moments of the facade itself and of the pushing masses, which always act."""
        weight, height = self.weight_kn, self.height_m
        centre, square = (1.0 / 3.0, 1.0 / 6.0) if self.kind == "gable" else (0.5, 1.0 / 3.0)
        inner = 0.5 * self.thickness_m - self.hinge_inset_m
        across = self.thickness_m * self.thickness_m / 12.0 + inner * inner
        second = weight * (height * height * square)
        wall = Moments(
            weight_kn=weight,
            weight_lever_kn_m=weight * inner,
            weight_moment_kn_m=weight * (height * centre),
            push_kn=weight,
            push_moment_kn_m=weight * (height * centre),
            second_moment_kn_m2=second,
            lumped_moment_kn_m2=weight * (height * centre) * (height * centre),
            inertia_kn_m2=second + weight * across,
        )
        return [wall, *(Moments.of_mass(each.weight_kn, each.z_m) for each in self.masses)]

    @functools.cached_property
    def _actions(self) -> list[tuple[Load | Tie | Thrust, Moments, bool]]:
        """Loads, ties and thrusts, their moments, and whether each counts up to collapse.

        A tie counts where it is verified, a thrust unless it ends.  A load that is not verified
        counts where it lowers the rotation of zero moment: what is not known to last does not make
        the facade safer, whether it holds or pushes.
        """
        actions: list[tuple[Load | Tie | Thrust, Moments, bool | None]] = []
        for load in self.loads:
            lever = load.x_m - self.hinge_inset_m
            moments = Moments.of_weight(load.weight_kn, lever, load.z_m)
            lasts = None if load.lost_at_m is None else False
            actions.append((load, moments, load.until_collapse or lasts))
        for tie in self.ties:
            moments = Moments.of_force(tie.force_kn, tie.z_m)
            actions.append((tie, moments, bool(tie.until_collapse)))
        for thrust in self.thrusts:
            moments = Moments.of_force(-thrust.force_kn, thrust.z_m)
            actions.append((thrust, moments, thrust.lost_at_m is None))
        certain = [*self._body, *(moments for _, moments, lasts in actions if lasts)]
        taken = unfavourable(certain, (each for _, each, lasts in actions if lasts is None))
        return [
            (action, moments, any(moments is each for each in taken) if lasts is None else lasts)
            for action, moments, lasts in actions
        ]

    @functools.cached_property
    def mechanism(self) -> Mechanism:
        """Overturning about the hinge."""
        lasting = [*self._body, *(moments for _, moments, lasts in self._actions if lasts)]
        ending = [
            (action.lost_at_m or 0.0, moments)
            for action, moments, lasts in self._actions
            if not lasts
        ]
        if not ending:
            return self._mechanism(lasting)
        after = [
            (end, self._mechanism([*lasting, *(each for lost, each in ending if lost > end)]))
            for end in sorted({lost for lost, _ in ending})
        ]
        worse = unfavourable(lasting, (moments for _, moments in ending))
        return self._mechanism(
            [*lasting, *(moments for _, moments in ending)],
            after=tuple(after),
            in_runs=self._mechanism([*lasting, *worse]),
        )

    def _mechanism(
        self,
        parts: list[Moments],
        after: tuple[tuple[float, Mechanism], ...] = (),
        in_runs: Mechanism | None = None,
    ) -> Mechanism:
        """Return the mechanism of what acts."""
        sums = Moments.total(parts)
        lever, moment = sums.weight_lever_kn_m, sums.weight_moment_kn_m
        reach = (lever * lever + moment * moment) / sums.weight_kn
        return Mechanism(
            name=self.name,
            stabilising_kn_m=sums.stabilising_kn_m,
            weight_moment_kn_m=moment,
            push_moment_kn_m=sums.push_moment_kn_m,
            push_kn=sums.push_kn,
            second_moment_kn_m2=sums.second_moment_kn_m2,
            lumped_moment_kn_m2=sums.lumped_moment_kn_m2,
            inertia_kn_m2=sums.inertia_kn_m2,
            compactness=reach / sums.inertia_kn_m2,
            confidence_factor=self.confidence_factor,
            one_sided=bool(self.one_sided),
            restitution=self.restitution,
            free=self.free,
            elastic_period_s=self.t0_s,
            after=after,
            in_runs=in_runs,
        )

    def _check_restitution(self) -> None:
        """Refuse a restitution outside the range of one-sided or of two-sided rocking."""
        if Impacts.of(self.restitution).factor is None:
            rule = restitution_of_wall if self.one_sided else RESTITUTION
            object.__setattr__(self, "restitution", rule("restitution", self.restitution))

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
        pushed = _moment(self.thrusts)
        if held <= 0.0:
            top = max((each.z_m for each in self.ties), default=self.height_m)
            raise ModelError(
                self.name,
                Words("falls by itself"),
                f"weights and ties hold {number(held + pushed)} kN m about the hinge against "
                f"{number(pushed)} kN m of thrusts",
                f"add ties of more than {number(-held / top)} kN at {number(top)} m, or check "
                "hinge_inset_m, loads and thrusts",
            )
        for each in (*(each for _, each in mechanism.after), mechanism.rocking):
            if each.stabilising_kn_m <= 0.0:
                names = ", ".join(action.name for action in self.ending)
                raise ModelError(
                    self.name,
                    Words(f"falls by itself without {names}"),
                    f"{number(-each.stabilising_kn_m)} kN m about the hinge are missing, and d0 "
                    "counts only what is verified to act up to collapse",
                    "set until_collapse = true where that is verified, or add ties",
                )


def _moment(forces: tuple[Tie, ...] | tuple[Thrust, ...]) -> float:
    """Return the moment of horizontal forces about the hinge [kN m]."""
    return math.fsum(each.force_kn * each.z_m for each in forces)
