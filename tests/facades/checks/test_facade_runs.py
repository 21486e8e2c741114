"""Runs of a facade: the equivalent block beside `simulate`, Lagrange's equation and its laws."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import BaseMotion, Execution, Linear, Nonlinear, Record, Status, simulate
from rocksteady.codes import Facade, FacadeRuns, RecordDemand, Tie, run_facade
from rocksteady.errors import InputError, ModelError
from rocksteady.motions import make_synthetic_suite
from tests.every import every
from tests.facades.checks.lagrange import largest_tilt
from tests.facades.checks.suites import BARE, LOADED, motion, motions

G = 9.80665
MODELS = (Nonlinear(), Linear())
LOOSE = replace(LOADED, ties=(Tie(name="rod", force_kn=2.0, z_m=2.8),))
PARAPET = Facade(name="parapet", kind="parapet", thickness_m=0.4, height_m=2.0, restitution=0.9)


def simulated(facade: Facade, record: Record, model: Nonlinear | Linear) -> tuple[Status, float]:
    """Return status and peak of the equivalent block under a record times lambda."""
    mechanism = facade.mechanism
    run = simulate(mechanism.block(), record.scaled(mechanism.base_factor), model=model)
    return run.status, run.peak


@every("model", MODELS)
@every("facade", [BARE, LOADED, PARAPET])
def test_cells_are_what_simulate_finds(facade: Facade, model: Nonlinear | Linear) -> None:
    records = [motion(seed, 5.0 * G * facade.mechanism.run_activation_g) for seed in range(8)]
    found = run_facade(facade, records, model=model)
    fell = 0
    for place, record in enumerate(records):
        for sign, own in enumerate((record, record.reversed())):
            status, peak = simulated(facade, own, model)
            assert found.status[place, sign] == status
            if status == Status.OVERTURNED:
                fell += 1
                assert found.share[place, sign] == math.inf
            else:
                assert found.share[place, sign] == pytest.approx(peak, rel=1e-12, abs=0.0)
    assert 0 < fell < found.share.size
    assert found.model.name == model.name


@pytest.mark.slow
@every(("seed", "times"), [(0, 1.2), (1, 2.4), (2, 3.0), (4, 2.0)])
@every("factor", [1.0, 1.35])
def test_a_bare_wall_follows_its_equation_of_motion(seed: int, times: float, factor: float) -> None:
    wall = replace(BARE, confidence_factor=factor)
    record = motion(seed, times * G * wall.mechanism.run_activation_g)
    ratio = wall.mechanism.block().restitution
    tilt = run_facade(wall, record).share[0] * wall.mechanism.theta0_rad
    expected = [largest_tilt(wall, each, ratio) for each in (record, record.reversed())]
    assert min(expected) > 1e-4
    assert tilt.tolist() == pytest.approx(expected, rel=1e-6)


@every(("seed", "times", "near"), [(0, 1.2, 1e-3), (1, 2.4, 2e-3), (2, 3.6, 0.03)])
def test_a_loaded_wall_is_near_its_equation_of_motion(seed: int, times: float, near: float) -> None:
    """Loads, ties and pushing masses are kept to the order of theta^2."""
    record = motion(seed, times * G * LOADED.mechanism.run_activation_g)
    ratio = LOADED.mechanism.block().restitution
    tilt = run_facade(LOADED, record).share[0] * LOADED.mechanism.theta0_rad
    expected = [largest_tilt(LOADED, each, ratio) for each in (record, record.reversed())]
    assert tilt.tolist() == pytest.approx(expected, rel=near)


@pytest.mark.parametrize("model", MODELS, ids=["nonlinear", "linear"])
def test_a_confidence_factor_is_another_clock_and_another_level(
    model: Nonlinear | Linear,
) -> None:
    """theta'' = (1/FC) ... in time t is FC = 1 in t/sqrt(FC), under FC times the acceleration."""
    factor = 1.44
    wall, plain = replace(LOADED, confidence_factor=factor), replace(LOADED, confidence_factor=1.0)
    suite = motions(8, 2.0 * G * wall.mechanism.run_activation_g)
    faster = [
        Record(acceleration_m_s2=factor * each.acceleration_m_s2, dt_s=each.dt_s / 1.2)
        for each in suite
    ]
    found, expected = run_facade(wall, suite, model=model), run_facade(plain, faster, model=model)
    assert (found.status == expected.status).all()
    assert (found.share > 0.0).all()
    assert found.share == pytest.approx(expected.share, rel=1e-8)


def test_displacements_means_and_the_worse_sign_follow_from_the_runs() -> None:
    found = run_facade(BARE, motions(7, 0.2 * G), limit_state="SLC")
    shares, d0 = found.share.tolist(), 2.0 * 0.4 / 3.0
    worst = [d0 * max(pair) for pair in shares]
    assert found.largest_m.tolist() == pytest.approx(worst, rel=1e-14)
    assert found.mean_m == pytest.approx(math.fsum(worst) / 7.0, rel=1e-14)
    assert found.limit_m == pytest.approx(0.6 * d0)
    assert found.mean_m is not None
    assert 0.0 < found.mean_m < found.limit_m
    assert (found.satisfied, found.beyond) == (True, ())
    assert found.pga_g.tolist() == pytest.approx([0.2] * 7)


def test_one_direction_is_a_column_of_both() -> None:
    suite = motions(7, 0.25 * G)
    both = run_facade(BARE, suite)
    for sign, direction in enumerate(both.directions):
        alone = run_facade(BARE, suite, directions=direction)  # type: ignore[arg-type]
        assert alone.directions == (direction,)
        assert (alone.share[:, 0] == both.share[:, sign]).all()


def test_a_mirrored_parapet_has_mirrored_runs() -> None:
    found = run_facade(PARAPET, motions(7, 1.5 * G * PARAPET.mechanism.run_activation_g))
    assert (found.share[:, 0] == found.share[:, 1]).all()
    assert found.share.max() > 0.0


def test_a_fall_makes_the_mean_infinite_and_no_number_is_missing() -> None:
    found = run_facade(BARE, [*motions(6, 0.1 * G), motion(9, 3.0 * G)])
    assert found.beyond == ("motion 9",)
    assert found.mean_m == math.inf
    assert found.satisfied is False
    assert not np.isnan(found.displacement_m).any()
    values = found.to_dict()
    assert (values["mean_m"], values["satisfied"], values["beyond"]) == (None, False, ["motion 9"])
    assert "NaN" not in json.dumps(values, allow_nan=False)
    assert "mean beyond d0" in found.summary()


def test_a_wall_that_comes_back_from_beyond_d0_has_failed() -> None:
    """Pushed past its balance while the base holds it up: it returns, and counts as fallen."""
    found = run_facade(BARE, [*motions(6, 0.1 * G), returning()])
    place = found.records.index("returning")
    beyond = found.share[place, 0]
    assert 1.0 < beyond < math.inf
    assert found.status[place, 0] == Status.AT_REST
    assert found.beyond == ("returning",)
    assert found.satisfied is False
    assert "tilts beyond d0 and comes back" in found.summary()


def returning() -> Record:
    """Return a motion that brings the bare wall past its balance and back."""
    t = 0.01 * np.arange(400)
    push = np.where(t < 0.6, 3.15 * np.sin(np.pi * t / 0.6), 0.0)
    pull = np.where((t > 0.8) & (t < 1.8), -3.0, 0.0)
    return Record(acceleration_m_s2=push + pull, dt_s=0.01, name="returning")


def test_fewer_than_seven_records_have_runs_and_no_mean() -> None:
    found = run_facade(BARE, motions(6, 0.2 * G))
    assert (found.enough, found.mean_m, found.satisfied) == (False, None, None)
    assert len(found.to_dict()["runs"]) == 12
    assert "needs 7 records and there are 6 records" in " ".join(found.describe().notes)
    assert run_facade(BARE, motions(7, 0.2 * G)).enough


def test_levels_are_factors_or_peaks() -> None:
    suite = motions(7, 0.2 * G)
    for pga, scale in ((0.3, 1.5), (0.15, 0.75)):
        by_peak = run_facade(BARE, suite, pga_g=pga)
        by_factor = run_facade(BARE, suite, scale=scale)
        assert by_peak.share == pytest.approx(by_factor.share, rel=1e-9)
        assert by_factor.pga_g.tolist() == pytest.approx([pga] * 7)
    # Stronger is not always farther: that is what both signs and several records are for.
    with pytest.raises(InputError, match="both given"):
        run_facade(BARE, suite, pga_g=0.3, scale=1.5)


@every("value", [0.0, -1.0, math.nan, math.inf])
def test_a_level_is_above_zero(value: float) -> None:
    with pytest.raises(InputError):
        run_facade(BARE, motion(0, 1.0), scale=value)
    with pytest.raises(InputError):
        run_facade(BARE, motion(0, 1.0), pga_g=value)


def test_a_vertical_motion_is_scaled_with_gravity_alone() -> None:
    across, up = motion(1, 0.3 * G), motion(2, 0.4 * G)
    found = run_facade(LOADED, BaseMotion(across, up), scale=2.0)
    mechanism = LOADED.mechanism
    own = BaseMotion(across.scaled(2.0 * mechanism.base_factor), up.scaled(2.0))
    for sign, each in enumerate((own, own.reversed())):
        assert found.share[0, sign] == pytest.approx(
            simulate(mechanism.block(), each).peak, rel=1e-12
        )
    assert found.vertical == (True,)
    assert found.share[0, 0] != run_facade(LOADED, across, scale=2.0).share[0, 0]
    with pytest.raises(ModelError, match="vertical"):
        run_facade(LOADED, BaseMotion(across, up), model=Linear())


def test_a_base_that_falls_away_counts_as_beyond() -> None:
    across, up = motion(1, 0.6 * G), motion(2, 4.0 * G)
    found = run_facade(BARE, BaseMotion(across, up))
    assert (found.status == Status.LOST_CONTACT).any()
    assert found.beyond == ("motion 1",)
    assert "could not be decided" in found.summary()


@every("run", [Execution(executor="serial"), Execution(workers=1), Execution(workers=3)])
def test_the_same_bits_for_any_workers(run: Execution) -> None:
    suite = motions(7, 0.3 * G)
    first, again = run_facade(LOADED, suite), run_facade(LOADED, suite, run=run)
    assert first.share.tobytes() == again.share.tobytes()
    assert first.status.tobytes() == again.status.tobytes()


def test_records_of_one_name_are_told_apart() -> None:
    other = replace(motion(1, 0.3 * G), name="motion 0")
    found = run_facade(BARE, [motion(0, 0.3 * G), other])
    assert found.records == ("motion 0", "motion 0 (2)")


@every("facade", [BARE, LOADED, LOOSE])
def test_a_wall_that_does_not_lift_stands(facade: Facade) -> None:
    start = G * facade.mechanism.run_activation_g
    found: FacadeRuns = run_facade(facade, motions(7, 0.99 * start))
    assert (found.share == 0.0).all()
    assert found.satisfied
    assert not any(row["uplift"] for row in found.to_dict()["runs"])
    assert run_facade(facade, motion(0, 1.01 * start)).share.max() > 0.0


@every("facade", [BARE, LOADED])
def test_the_uplift_acceleration_lifts_where_strength_and_actions_are_certain(
    facade: Facade,
) -> None:
    certain = replace(facade, confidence_factor=1.0)
    for part, lifts in ((0.999, False), (1.001, True)):
        record = motion(0, part * G * facade.mechanism.uplift_g)
        assert bool(run_facade(certain, record).share.any()) is lifts


def test_a_motion_counts_once_whatever_its_name_and_with_a_vertical_one() -> None:
    suite = list(make_synthetic_suite(7))
    with pytest.raises(InputError, match="one motion twice, as synthetic 2 and as copy"):
        run_facade(BARE, [*suite, replace(suite[1], name="copy")])
    with pytest.raises(InputError, match="one motion twice"):
        RecordDemand(records=(*suite[:6], replace(suite[1], name="copy")))
    four = suite[:4]
    paired: list[Record | BaseMotion] = [
        *four,
        *(BaseMotion(each, each.scaled(0.2)) for each in four),
    ]
    found = run_facade(BARE, paired, pga_g=0.01)
    assert (len(found.records), found.motions, found.enough) == (8, 4, False)
    assert "there are 4 different records" in str(found.refusal)
    whole: list[Record | BaseMotion] = [*suite, BaseMotion(suite[0], suite[0].scaled(0.2))]
    assert run_facade(BARE, whole, pga_g=0.01).enough


@every("facade", [BARE, LOADED, PARAPET])
def test_the_restitution_of_the_runs_is_among_the_values(facade: Facade) -> None:
    values = run_facade(facade, motions(2, 1.0)).to_dict()
    assert values["restitution"] == facade.mechanism.block().restitution
