"""The mechanism: worked walls, sums over a section cut small, virtual work, the bare block."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.errors import InputError
from rocksteady.facades.checks.actions import Load, Moments, PushingMass, Thrust, Tie, unfavourable
from rocksteady.facades.checks.facade import Facade, Kind
from rocksteady.facades.checks.mechanism import Mechanism
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from tests.every import every


def wall(thickness: float = 0.3, height: float = 3.0, factor: float = 1.0) -> Mechanism:
    return Facade(
        name="wall", thickness_m=thickness, height_m=height, confidence_factor=factor
    ).mechanism


@pytest.mark.parametrize(
    ("factor", "a0", "slv", "slc"),
    [(1.0, 0.133333, 1.685384, 2.347499), (1.35, 0.098765, 1.958239, 2.727547)],
)
def test_the_worked_walls_to_six_digits(factor: float, a0: float, slv: float, slc: float) -> None:
    """Published: a rectangle of 0.3 x 3 m on its edge."""
    found = wall(factor=factor)
    assert [round(value, 6) for value in (found.a0_g, found.t_slv_s, found.t_slc_s)] == [
        a0,
        slv,
        slc,
    ]
    assert found.e_star == pytest.approx(0.75, rel=1e-14)
    assert found.d0_m == pytest.approx(2.0 * 0.3 / 3.0, rel=1e-14)
    assert found.a0_g * factor == pytest.approx(4.0 / 3.0 * 0.1, rel=1e-14)
    assert found.uplift_g == pytest.approx(0.1, rel=1e-14)
    assert found.run_activation_g == pytest.approx(0.1 / factor, rel=1e-14)


def test_a_gable_takes_two_thirds_of_its_mass_and_has_d0_of_half_its_thickness() -> None:
    """By hand: D = W h/3, S = W h^2/6, so e* = (1/9)/(1/6) and d0 = (t/2)/(h/3) h/2 = 3t/4."""
    found = Facade(name="gable", kind="gable", thickness_m=0.4, height_m=2.0).mechanism
    assert found.e_star == pytest.approx(2.0 / 3.0, rel=1e-14)
    assert found.d0_m == pytest.approx(0.75 * 0.4, rel=1e-14)
    assert found.alpha0 == pytest.approx(1.5 * 0.4 / 2.0, rel=1e-14)


def full(kind: Kind = "wall") -> Facade:
    return Facade(
        name="full",
        kind=kind,
        thickness_m=0.45,
        height_m=4.2,
        length_m=3.0,
        unit_weight_kn_m3=19.0,
        hinge_inset_m=0.03,
        loads=(
            Load(name="roof", weight_kn=21.0, x_m=0.3, z_m=4.2),
            Load(name="balcony", weight_kn=4.0, x_m=-0.4, z_m=2.6),
        ),
        masses=(PushingMass(name="vault", weight_kn=9.0, z_m=2.4),),
        ties=(Tie(name="rods", force_kn=7.0, z_m=2.7, until_collapse=True),),
        thrusts=(Thrust(name="vault", force_kn=3.0, z_m=2.4),),
        confidence_factor=1.2,
    )


def points(facade: Facade) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return weight, x from the hinge and z of Gauss points of the section: exact to degree 5."""
    nodes, weights = np.polynomial.legendre.leggauss(3)
    x = 0.5 * facade.thickness_m * (1.0 + nodes)
    z = 0.5 * facade.height_m * (1.0 + nodes)
    breadth = facade.length_m * (
        1.0 - z / facade.height_m if facade.kind == "gable" else np.ones_like(z)
    )
    area = 0.25 * facade.thickness_m * facade.height_m * np.outer(weights * breadth, weights)
    grid_z, grid_x = np.meshgrid(z, x, indexing="ij")
    w = (facade.unit_weight_kn_m3 * area).ravel()
    w = np.append(w, [load.weight_kn for load in facade.loads])
    xs = np.append(grid_x.ravel(), [load.x_m for load in facade.loads]) - facade.hinge_inset_m
    return w, xs, np.append(grid_z.ravel(), [load.z_m for load in facade.loads])


@pytest.mark.parametrize("kind", ["wall", "gable"])
def test_the_sums_are_those_of_a_section_cut_into_points(kind: Kind) -> None:
    facade = full(kind)
    found, (w, x, z) = facade.mechanism, points(facade)
    (mass,), (tie,), (thrust,) = facade.masses, facade.ties, facade.thrusts
    holding = (w * x).sum() + tie.force_kn * tie.z_m - thrust.force_kn * thrust.z_m
    q, qz = mass.weight_kn, mass.z_m
    assert found.stabilising_kn_m == pytest.approx(holding, rel=1e-13)
    assert found.weight_moment_kn_m == pytest.approx((w * z).sum(), rel=1e-13)
    assert found.push_moment_kn_m == pytest.approx((w * z).sum() + q * qz, rel=1e-13)
    assert found.push_kn == pytest.approx(w.sum() + q, rel=1e-13)
    assert found.second_moment_kn_m2 == pytest.approx((w * z * z).sum() + q * qz**2, rel=1e-13)
    inertia = (w * (x * x + z * z)).sum() + q * qz**2
    assert found.inertia_kn_m2 == pytest.approx(inertia, rel=1e-13)
    centre = ((w * x).sum() ** 2 + (w * z).sum() ** 2) / w.sum()
    assert found.compactness == pytest.approx(centre / inertia, rel=1e-13)
    push = (w * z).sum() + q * qz
    share = push * push / ((w.sum() + q) * ((w * z * z).sum() + q * qz**2))
    assert found.e_star == pytest.approx(share, rel=1e-13)
    assert found.mass_kg == pytest.approx(1e3 * share * (w.sum() + q) / STANDARD_GRAVITY, rel=1e-13)


def energy(facade: Facade, rotation: float, push: float) -> float:
    """Return the potential energy [kN m] of weights, ties and thrusts and of a horizontal push.

    Each point is turned outwards about the hinge; a force does work along its own direction; ties
    and thrusts act at the height of their points on the line above the hinge.
    """
    w, x, z = points(facade)
    cosine, sine = math.cos(rotation), math.sin(rotation)
    lifted = x * sine + z * cosine
    outward = z * sine - x * cosine
    total = (w * lifted).sum() - push * (w * outward).sum()
    held = [(tie.force_kn, tie.z_m) for tie in facade.ties]
    held += [(-thrust.force_kn, thrust.z_m) for thrust in facade.thrusts]
    held += [(-push * mass.weight_kn, mass.z_m) for mass in facade.masses]
    return float(total + sum(force * height * sine for force, height in held))


@pytest.mark.parametrize("kind", ["wall", "gable"])
def test_alpha0_balances_the_work_of_a_small_rotation_and_theta0_that_of_a_finite_one(
    kind: Kind,
) -> None:
    facade = full(kind)
    found, step = facade.mechanism, 1e-4

    def moment(rotation: float, push: float) -> float:
        ends = [energy(facade, rotation + side * step, push) for side in (1.0, -1.0)]
        return (ends[0] - ends[1]) / (2.0 * step)

    scale = found.weight_moment_kn_m
    assert moment(0.0, 0.0) == pytest.approx(found.stabilising_kn_m, abs=1e-6 * scale)
    assert moment(0.0, found.alpha0) == pytest.approx(0.0, abs=1e-6 * scale)
    assert moment(found.theta0_rad, 0.0) == pytest.approx(0.0, abs=1e-6 * scale)


@every(("thickness", "height"), [(0.3, 3.0), (0.05, 8.0), (2.0, 3.5), (1.1, 50)])
def test_a_bare_wall_is_the_rectangle(thickness: float, height: float) -> None:
    found = wall(thickness, height)
    block, same = found.block(), Block.rectangle(width=thickness, height=height).against_wall()
    assert block.alpha == pytest.approx(same.alpha, rel=1e-14)
    assert block.p == pytest.approx(same.p, rel=1e-14)
    assert block.restitution == pytest.approx(same.restitution, rel=1e-12)
    assert block.one_sided
    assert found.base_factor == pytest.approx(1.0, rel=1e-14)


def test_a_parapet_rocks_to_both_sides_with_the_restitution_of_its_base() -> None:
    free = Facade(name="top", kind="parapet", thickness_m=0.3, height_m=1.2, confidence_factor=1.0)
    same = Block.rectangle(width=0.3, height=1.2)
    block = free.mechanism.block()
    assert not block.one_sided
    assert block.restitution == pytest.approx(same.restitution, rel=1e-13)
    assert block.p == pytest.approx(same.p, rel=1e-14)


def test_confidence_divides_the_strength_and_leaves_the_inertia() -> None:
    """The block of FC has p^2/FC and a base FC times as strong: it moves from 1/FC on."""
    one, other = wall(factor=1.0), wall(factor=1.35)
    assert other.p_rad_s**2 * 1.35 == pytest.approx(one.p_rad_s**2, rel=1e-14)
    assert other.p_rad_s**2 * other.base_factor == pytest.approx(one.p_rad_s**2, rel=1e-14)
    start = math.tan(other.theta0_rad) / other.base_factor
    assert start == pytest.approx(other.run_activation_g)
    assert other.uplift_g == one.uplift_g == pytest.approx(1.35 * start)


def test_a_restitution_is_that_of_the_wall_and_a_stocky_facade_names_itself() -> None:
    bouncy = Facade(name="f", thickness_m=0.3, height_m=3.0, restitution=0.0)
    assert bouncy.mechanism.block().restitution == 0.0
    tied = Facade(
        name="pier",
        thickness_m=1.0,
        height_m=2.0,
        ties=(Tie(name="t", force_kn=90.0, z_m=2.0, until_collapse=True),),
    )
    with pytest.raises(InputError, match=r"pier has theta0 = .* degrees"):
        tied.mechanism.block()


def test_the_capacity_falls_in_a_line_from_a0_to_nothing_at_d0() -> None:
    found = wall()
    assert found.capacity_g(0.0) == found.a0_g
    assert found.capacity_g(found.d0_m) == 0.0
    assert found.capacity_g(0.5 * found.d0_m) == pytest.approx(0.5 * found.a0_g)
    with pytest.raises(InputError, match="displacement_m"):
        found.capacity_g(-0.01)
    with pytest.raises(InputError, match="share"):
        found.period_s(1.0, 1.68)


THICKNESSES = st.floats(0.1, 1.2)
HEIGHTS = st.floats(1.5, 12.0)


@given(THICKNESSES, HEIGHTS, st.floats(1.1, 3.0))
def test_of_one_shape_periods_grow_as_the_root_of_the_size(
    thickness: float, height: float, factor: float
) -> None:
    one, other = wall(thickness, height), wall(thickness * factor, height * factor)
    assert other.a0_g == pytest.approx(one.a0_g, rel=1e-12)
    assert other.d0_m == pytest.approx(factor * one.d0_m, rel=1e-12)
    for key in ("t_slv_s", "t_slc_s"):
        grown = math.sqrt(factor) * getattr(one, key)
        assert getattr(other, key) == pytest.approx(grown, rel=1e-12)


@given(THICKNESSES, HEIGHTS, st.floats(0.1, 5.0))
def test_ties_hold_thrusts_push_and_pushing_masses_weaken(
    thickness: float, height: float, force: float
) -> None:
    def mechanism(**acting: Any) -> Mechanism:
        return Facade(name="f", thickness_m=thickness, height_m=height, **acting).mechanism

    at: dict[str, Any] = {"name": "x", "z_m": 0.9 * height}
    bare = mechanism()
    tied = mechanism(ties=(Tie(force_kn=force, until_collapse=True, **at),))
    loose = mechanism(ties=(Tie(force_kn=force, **at),))
    pushed = mechanism(masses=(PushingMass(weight_kn=force, **at),))
    both = mechanism(
        ties=(Tie(force_kn=force, until_collapse=True, **at),),
        thrusts=(Thrust(force_kn=force, **at),),
    )
    assert tied.alpha0 > bare.alpha0 > pushed.alpha0
    assert tied.d0_m > bare.d0_m
    assert loose.alpha0 == tied.alpha0
    assert loose.d0_m == pytest.approx(bare.d0_m, rel=1e-12)
    assert both.alpha0 == pytest.approx(bare.alpha0, rel=1e-9)
    for found in (bare, tied, pushed):
        assert 0.0 < found.e_star <= 1.0
        assert 0.0 < found.compactness <= 1.0


@given(st.floats(0.5, 40.0), THICKNESSES, HEIGHTS)
def test_all_loads_per_length_the_mechanism_does_not_know_the_length(
    length: float, thickness: float, height: float
) -> None:
    def of(metres: float) -> Mechanism:
        roof = Load(name="roof", weight_kn=6.0 * metres, x_m=0.05, z_m=height)
        return Facade(
            name="f", thickness_m=thickness, height_m=height, length_m=metres, loads=(roof,)
        ).mechanism

    for key in ("a0_g", "d0_m", "theta0_rad", "p_rad_s", "base_factor"):
        assert getattr(of(length), key) == pytest.approx(getattr(of(1.0), key), rel=1e-12)


def test_the_description_has_the_numbers_under_their_names() -> None:
    found = wall(factor=1.35)
    values = found.to_dict()
    for key in ("a0_g", "d0_m", "t_slv_s", "t_slc_s", "alpha0", "e_star", "p_rad_s"):
        assert values[key] == getattr(found, key)
    assert "200 mm" in found.summary()


def test_a_factor_of_housner_is_refused_as_a_person_writes_it() -> None:
    wall = Facade(name="f", thickness_m=0.3, height_m=3.0, restitution=("housner", 3.0))
    with pytest.raises(InputError, match=r"'housner\*3\.0'"):
        wall.mechanism.block()


ROOF = Load(name="roof", weight_kn=60.0, x_m=0.3, z_m=6.0)


def held(*acting: Load | Tie | Thrust) -> Facade:
    """Return a wall of .6 x 6 x 10 m, FC 1, with its roof and what else acts."""
    return Facade(
        name="held", thickness_m=0.6, height_m=6.0, length_m=10.0, confidence_factor=1.0,
        loads=(ROOF, *(each for each in acting if isinstance(each, Load))),
        ties=tuple(each for each in acting if isinstance(each, Tie)),
        thrusts=tuple(each for each in acting if isinstance(each, Thrust)),
    )  # fmt: skip


def rod(**until: Any) -> Tie:
    return Tie(name="rod", force_kn=50.0, z_m=5.4, **until)


def test_a_tie_that_is_not_verified_leaves_the_displacements_of_the_wall_without_it() -> None:
    """By hand (Circolare C8.7.1.2.1.6), wall 18 x .6 x 6 x 10 = 648 kN, roof 60 kN.

    Without tie: M = 648 x .3 + 60 x .3 = 212.4, K = D = 648 x 3 + 60 x 6 = 2304,
    S = 648 x 12 + 60 x 36 = 9936, so d0 = (212.4/2304) 9936/2304 = .397559 m, .4 d0 = .159023 m.
    With it M = 212.4 + 50 x 5.4 = 482.4, alpha_0 = 482.4/2304 = .209375, d0 = .902930 m.
    """
    firmly = rod(until_collapse=True)
    loose, bare, firm = (held(*each).mechanism for each in ((rod(),), (), (firmly,)))
    assert loose.alpha0 == firm.alpha0 == pytest.approx(0.209375, rel=1e-12)
    assert loose.a0_g == firm.a0_g
    assert bare.alpha0 == pytest.approx(212.4 / 2304.0, rel=1e-12)
    assert loose.d0_m == pytest.approx(0.397559, abs=5e-7)
    assert loose.d_slv_m == pytest.approx(0.159023, abs=1e-6)
    assert firm.d0_m == pytest.approx(0.902930, abs=5e-7)
    for key in (
        "d0_m", "t_slv_s", "t_slc_s", "p_rad_s", "theta0_rad", "run_activation_g", "base_factor",
    ):  # fmt: skip
        assert getattr(loose, key) == pytest.approx(getattr(bare, key), rel=1e-14), key
    assert loose.uplift_g == pytest.approx(0.209375, rel=1e-12)
    assert loose.run_activation_g == pytest.approx(212.4 / 2304.0, rel=1e-12)
    for part in (0.01, 0.4, 0.99, 1.5):
        distance = part * bare.d0_m
        assert loose.capacity_g(distance) == pytest.approx(bare.capacity_g(distance), rel=1e-13)
    assert loose.capacity_g(0.0) == firm.capacity_g(0.0)
    assert loose.block() == bare.block()
    assert "rod" in [each.name for each in held(rod()).ending]


def test_the_capacity_curve_drops_where_a_tie_ends() -> None:
    """By hand, e* = 2304^2/(708 x 9936) = .754606, a = (M - K d 2304/9936)/(2304 e*).

    At d = .1 m: with the tie (482.4 - 53.4261)/1738.61 = .246734 g, without (212.4 - 53.4261)/
    1738.61 = .091437 g; d0 = .397559 m all the same.  At .2 m, later than d_SLV, T_SLV is longer.
    """
    found = held(rod(lost_at_m=0.1)).mechanism
    assert found.e_star == pytest.approx(0.754606, abs=5e-7)
    assert found.capacity_g(math.nextafter(0.1, 0.0)) == pytest.approx(0.246734, abs=5e-7)
    assert found.capacity_g(0.1) == pytest.approx(0.091437, abs=5e-7)
    assert found.d0_m == pytest.approx(0.397559, abs=5e-7)
    corners = [(0.0, found.a0_g), (0.1, 0.246734), (0.1, 0.091437), (found.d0_m, 0.0)]
    assert np.array(found.curve) == pytest.approx(np.array(corners), abs=5e-7)
    assert held(rod(lost_at_m=0.2)).mechanism.t_slv_s < found.t_slv_s
    late = held(rod(lost_at_m=5.0)).mechanism
    assert late.d0_m == found.d0_m  # d0: up to collapse alone
    # Beyond d0 what lasts counts, whatever would act there still.
    assert late.capacity_g(1.5 * found.d0_m) == pytest.approx(-0.5 * late.lasting.a0_g, rel=1e-12)
    assert late.capacity_g(0.99 * found.d0_m) > 0.0


def test_what_weakens_counts_by_default_and_what_strengthens_does_not() -> None:
    arch: dict[str, Any] = {"name": "arch", "force_kn": 10.0, "z_m": 4.0}
    bare, pushed, relieved = (
        held(*each).mechanism for each in ((), (Thrust(**arch),), (Thrust(**arch, lost_at_m=1e-3),))
    )
    assert pushed.d0_m < bare.d0_m
    # A thrust that is not verified to last is no thrust that is known to end.
    assert held(Thrust(**arch, until_collapse=False)).mechanism == pushed
    assert pushed.alpha0 == relieved.alpha0 < bare.alpha0
    assert relieved.d0_m == pytest.approx(bare.d0_m)
    assert relieved.theta0_rad == pushed.theta0_rad  # runs never gain from what ends
    assert relieved.run_activation_g == pushed.run_activation_g
    # A thrust that ends later than the wall has fallen under it does not help.
    late = held(Thrust(**arch, lost_at_m=0.39)).mechanism
    assert late.d0_m == pytest.approx(pushed.stabilising_kn_m / 2304.0 * 9936.0 / 2304.0)
    for x, counted in ((0.6, False), (0.1, True)):  # x/z of .2 and .03, M/K of .092
        floor: dict[str, Any] = {"name": "floor", "weight_kn": 30.0, "x_m": x, "z_m": 3.0}
        loads = [held(Load(**floor, until_collapse=until)) for until in (None, True, False)]
        silent, there, unverified = (each.mechanism for each in loads)
        assert silent == unverified
        assert silent.theta0_rad == min(there.theta0_rad, bare.theta0_rad)
        # One that is lost at once leaves the bare wall.
        lost = held(Load(**floor, lost_at_m=1e-3))
        assert "floor" in [each.name for each in lost.ending]
        assert lost.mechanism.d0_m == pytest.approx(bare.d0_m)
        assert [each.name for each in loads[0].ending] == ([] if counted else ["floor"])
        assert silent.alpha0 == there.alpha0


@given(
    st.lists(st.tuples(st.floats(-0.3, 0.9), st.floats(1.0, 90.0), st.floats(0.5, 8.0)), max_size=6)
)
def test_no_choice_among_silent_loads_is_worse_than_the_one_taken(
    loads: list[tuple[float, float, float]],
) -> None:
    """Against all subsets: the smallest rotation of zero moment."""
    parts = [Moments.of_weight(weight, x, z) for x, weight, z in loads]
    base = [Moments.of_weight(648.0, 0.3, 3.0)]
    least = min(
        Moments.total([*base, *some]).slope
        for count in range(len(parts) + 1)
        for some in itertools.combinations(parts, count)
    )
    taken = Moments.total([*base, *unfavourable(base, parts)]).slope
    assert taken == pytest.approx(least, rel=1e-12, abs=1e-15)


def test_the_mass_at_the_centres_lowers_a0_and_leaves_the_periods() -> None:
    """e* lumped is never below e* spread: S is least with each mass at its centre."""
    for facade in (full("wall"), full("gable"), held()):
        found = facade.mechanism
        assert found.e_star < found.e_star_lumped <= 1.0
        assert found.linear_g == found.a0_lumped_g < found.a0_g
    bare = wall()
    assert bare.e_star_lumped == pytest.approx(1.0, rel=1e-14)
    assert bare.a0_g / bare.a0_lumped_g == pytest.approx(4.0 / 3.0, rel=1e-14)
    assert bare.a0_lumped_g == pytest.approx(bare.uplift_g, rel=1e-14)  # of FC 1


def test_the_curve_of_an_element_free_to_vibrate_begins_elastic() -> None:
    top = Facade(
        name="top", kind="parapet", thickness_m=0.3, height_m=2.0, elastic_period_s=0.2,
        confidence_factor=1.0,
    )  # fmt: skip
    found, rate = top.mechanism, (2.0 * math.pi / 0.2) ** 2 / STANDARD_GRAVITY
    (first, peak, last) = found.curve
    assert (first, last) == ((0.0, 0.0), (found.d0_m, 0.0))
    assert peak[1] == pytest.approx(rate * peak[0], rel=1e-12)
    assert peak[1] == pytest.approx(found.a0_g * (1.0 - peak[0] / found.d0_m), rel=1e-12)
    assert found.capacity_g(0.5 * peak[0]) == pytest.approx(0.5 * peak[1], rel=1e-12)
    bare = Facade(name="top", kind="parapet", thickness_m=0.3, height_m=2.0, confidence_factor=1.0)
    assert found.t_slv_s == bare.mechanism.t_slv_s
