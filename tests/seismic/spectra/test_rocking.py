"""Rocking spectra: against time histories, published values, symmetries, and as sweeps."""

import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from rocksteady import (
    Block,
    Execution,
    Record,
    Status,
    compute_rocking_spectrum,
    open_store,
    read_record,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.pulses import Pulse
from rocksteady.words.spectra import describe_spectrum
from tests.every import every
from tests.records import ABSENT, FOLDER, peer
from tests.records.published import AT_PACOIMA_DAM, PEAKS
from tests.seismic.grounds import ALPHAS, PERIODS, ground, lifting

NAMES = ("status", "peak_angle", "peak_velocity", "impacts")


def same(one: xarray.Dataset, other: xarray.Dataset) -> None:
    for name in NAMES:
        np.testing.assert_array_equal(one[name].values, other[name].values)


# --------------------------------------------------------------------------- time histories


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_each_cell_is_a_time_history(model: Model) -> None:
    found = compute_rocking_spectrum(ground(), alpha=ALPHAS, periods_s=PERIODS, model=model)
    assert found.peak_angle.dims == ("alpha", "period")
    for alpha in ALPHAS:
        for period in PERIODS:
            cell = found.sel(alpha=alpha, period=period)
            run = simulate(Block.from_p(alpha=alpha, p=float(cell.p)), ground(), model=model)
            assert int(cell.status) == run.status
            assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8)
            assert float(cell.peak_velocity) == pytest.approx(run.peak_velocity, rel=1e-8)
    assert {Status.AT_REST, Status.OVERTURNED} <= set(found.status.values.ravel().tolist())


@every("model", [Linear(), Nonlinear()])
@every("ratio", ["housner", ("housner", 0.9), 0.0, 0.6])
def test_each_cell_against_a_wall_is_a_time_history(model: Model, ratio: Any) -> None:
    found = compute_rocking_spectrum(
        [ground(), ground().reversed()],
        alpha=ALPHAS,
        periods_s=PERIODS,
        restitution=("wall", ratio),
        model=model,
    )
    for place, alpha, period in product((0, 1), ALPHAS, PERIODS):
        cell = found.isel(record=place).sel(alpha=alpha, period=period)
        block = Block.from_p(alpha=alpha, p=float(cell.p)).against_wall(ratio)
        run = simulate(block, ground().reversed() if place else ground(), model=model)
        assert int(cell.status) == run.status
        assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8)
        assert float(cell.peak_velocity) == pytest.approx(run.peak_velocity, rel=1e-8)
    assert {Status.AT_REST, Status.OVERTURNED} <= set(found.status.values.ravel().tolist())
    assert not np.array_equal(found.peak_angle[0], found.peak_angle[1])


def test_a_spectrum_against_a_wall_is_named_and_refused_where_no_wall_turns_a_block_back() -> None:
    found = compute_rocking_spectrum(
        ground(), alpha=0.2, periods_s=[2.0, 3.0], restitution=("wall", 0.4)
    )
    assert found.attrs["one_sided"] == 1
    assert "against a wall" in describe_spectrum(found).headline
    assert found.attrs["restitution"] == 0.4
    with pytest.raises(InputError, match="not turned back by a wall"):
        compute_rocking_spectrum(
            ground(), alpha=[0.2, 0.7], periods_s=2.0, restitution=("wall", "housner")
        )
    with pytest.raises(InputError, match="restitution"):
        compute_rocking_spectrum(ground(), alpha=0.2, periods_s=2.0, restitution=("wall", -0.1))


def test_suite_scale_vertical_gravity_and_restitution_reach_the_block() -> None:
    records, verticals = [ground(1), ground(2, name="other")], [None, lifting()]
    found = compute_rocking_spectrum(
        [BaseMotion(*both) for both in zip(records, verticals, strict=True)],
        alpha=[0.2, 0.3],
        periods_s=[math.pi, 2.0 * math.pi / 3.0],
        scales=[0.7, 1.1],
        model=Nonlinear(),
        restitution=0.75,
        gravity=9.0,
    )
    assert dict(found.sizes) == {"record": 2, "scale": 2, "alpha": 2, "period": 2}
    for record, beside in zip(records, verticals, strict=True):
        for factor in (0.7, 1.1):
            for p in (2.0, 3.0):
                run = simulate(
                    Block.from_p(alpha=0.3, p=p, restitution=0.75, gravity=9.0),
                    BaseMotion(
                        record.scaled(factor),
                        None if beside is None else beside.scaled(factor),
                    ),
                    model=Nonlinear(),
                )
                cell = found.sel(record=record.name, scale=factor, alpha=0.3)
                cell = cell.isel(period=[2.0, 3.0].index(p))
                assert int(cell.status) == run.status
                assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8)


# ------------------------------------------------------------------------------- published


@every(("name", "p", "alpha", "theta"), PEAKS)
def test_published_peaks_under_real_records(
    name: str, p: float, alpha: float, theta: float
) -> None:
    found = compute_rocking_spectrum(
        peer(name), alpha=alpha, periods_s=2.0 * math.pi / p, model=Nonlinear()
    )
    assert int(found.status) == Status.AT_REST
    assert alpha * float(found.peak_angle) == pytest.approx(theta, rel=1e-5)


@every(("degrees", "period", "falls"), AT_PACOIMA_DAM)
def test_where_pacoima_dam_topples_blocks(degrees: float, period: float, falls: bool) -> None:
    alpha = math.radians(degrees)
    found = compute_rocking_spectrum(
        peer("PUL164"), alpha=alpha, periods_s=period, model=Nonlinear()
    )
    assert int(found.status) == (Status.OVERTURNED if falls else Status.AT_REST)


# ------------------------------------------------------------------------------- symmetries


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_symmetric_blocks_do_not_feel_which_way_the_ground_is_reversed(model: Model) -> None:
    one, other = (
        compute_rocking_spectrum(record, alpha=ALPHAS, periods_s=PERIODS, model=model)
        for record in (ground(), ground().reversed())
    )
    same(one, other)


@pytest.mark.parametrize(("model", "up"), [(Linear(), None), (Nonlinear(), lifting())])
def test_a_scale_is_a_scaled_record(model: Model, up: Record | None) -> None:
    factors = [0.5, 1.0, 1.7]
    found = compute_rocking_spectrum(
        BaseMotion(ground(), up), alpha=0.2, periods_s=PERIODS, scales=factors, model=model
    )
    for factor in factors:
        alone = compute_rocking_spectrum(
            BaseMotion(ground().scaled(factor), None if up is None else up.scaled(factor)),
            alpha=0.2,
            periods_s=PERIODS,
            model=model,
        )
        here = found.sel(scale=factor)
        np.testing.assert_array_equal(here.status.values, alone.status.values)
        np.testing.assert_allclose(here.peak_angle.values, alone.peak_angle.values, rtol=1e-8)


def test_in_the_linear_model_a_stronger_record_is_a_more_slender_block() -> None:
    strong = compute_rocking_spectrum(
        ground(), alpha=0.3, periods_s=PERIODS, scales=1.5, restitution=0.8, model=Linear()
    )
    slender = compute_rocking_spectrum(
        ground(), alpha=0.2, periods_s=PERIODS, restitution=0.8, model=Linear()
    )
    np.testing.assert_array_equal(strong.status.values, slender.status.values)
    np.testing.assert_allclose(strong.peak_angle.values, slender.peak_angle.values, rtol=1e-8)


def test_a_slower_record_is_a_larger_block() -> None:
    slow = Record(acceleration_m_s2=ground().acceleration_m_s2, dt_s=2.0 * ground().dt_s)
    one = compute_rocking_spectrum(ground(), alpha=ALPHAS, periods_s=PERIODS, model=Linear())
    other = compute_rocking_spectrum(
        slow, alpha=ALPHAS, periods_s=np.multiply(PERIODS, 2.0), model=Linear()
    )
    np.testing.assert_array_equal(one.status.values, other.status.values)
    np.testing.assert_allclose(one.peak_velocity.values, other.peak_velocity.values, rtol=1e-8)


def test_a_fall_reaches_the_slenderness_and_no_other_motion_rests_beyond_it() -> None:
    found = compute_rocking_spectrum(ground(), alpha=ALPHAS, periods_s=PERIODS, model=Linear())
    fell = (found.status == Status.OVERTURNED).values
    assert (found.peak_angle.values[fell] >= 1.0).all()
    assert fell.any()
    # No record of these shakes a block beyond its slenderness and back.
    assert (found.peak_angle.values[~fell] < 1.0).all()


# ---------------------------------------------------------------------------------- sweeps


def test_who_computes_it_and_where_it_is_kept_change_nothing(tmp_path: Path) -> None:
    grid = {"alpha": ALPHAS, "periods_s": PERIODS, "scales": [0.8, 1.0]}
    records = [BaseMotion(ground(1), lifting()), ground(2), ground(3)]
    given = {**grid, "model": Nonlinear()}
    plain = compute_rocking_spectrum(records, **given, run=Execution(executor="serial"))  # type: ignore[arg-type]
    same(plain, compute_rocking_spectrum(records, **given, run=Execution(workers=3)))  # type: ignore[arg-type]
    path = tmp_path / "suite.zarr"
    kept = compute_rocking_spectrum(records, **given, run=Execution(store=path))  # type: ignore[arg-type]
    same(plain, kept)
    assert plain.equals(kept.load())
    same(plain, open_store(path))
    assert plain.record.values.tolist() == ["noise", "noise (2)", "noise (3)"]


def test_a_part_of_a_grid_has_the_values_of_the_whole() -> None:
    whole = compute_rocking_spectrum(
        [ground(1), ground(2)], alpha=ALPHAS, periods_s=PERIODS, model=Linear()
    )
    part = compute_rocking_spectrum(
        ground(2), alpha=ALPHAS[1], periods_s=PERIODS[::2], model=Linear()
    )
    same(whole.isel(record=1, alpha=1, period=slice(None, None, 2)), part)


def test_single_values_are_no_dimensions_but_stay() -> None:
    found = compute_rocking_spectrum(ground(), alpha=0.2, periods_s=math.pi, model=Linear())
    assert found.sizes == {}
    assert float(found.alpha) == 0.2
    assert float(found.p) == pytest.approx(2.0, rel=1e-15)
    assert (str(found.record.values), float(found.scale)) == ("noise", 1.0)
    assert found.period.attrs["units"] == "s"
    flags = found.status.attrs
    words = dict(zip(flags["flag_values"].tolist(), flags["flag_meanings"].split(), strict=True))
    assert words[Status.OVERTURNED] == "overturned"


# --------------------------------------------------------------------------------- refusals


@every(
    ("given", "words"),
    [
        ({"alpha": 0.2, "periods_s": -2.0}, "periods_s = -2.0"),
        ({"alpha": 0.2, "periods_s": [1.0, 0.0]}, "periods_s = 0.0"),
        ({"alpha": [0.2, 1.7], "periods_s": 3.0}, "alpha = 1.7"),
        ({"alpha": 1.2, "periods_s": 3.0}, "Housner's restitution"),
        ({"alpha": [0.2, 0.2], "periods_s": 3.0}, "each value once"),
        ({"alpha": 0.2, "periods_s": 3.0, "scales": 0.0}, "scales = 0.0"),
        ({"alpha": 0.2, "periods_s": 3.0, "scales": 5e-324}, "scales = 5e-324"),
        ({"alpha": 0.2, "periods_s": 3.0, "restitution": 1.2}, "restitution = 1.2"),
        ({"alpha": 0.2, "periods_s": 3.0, "model": "exact"}, "model = 'exact'"),
        ({"alpha": 0.2, "periods_s": 3.0, "gravity": 0.0}, "gravity = 0.0"),
    ],
)
def test_what_is_not_valid_is_said_in_one_line(given: dict[str, object], words: str) -> None:
    with pytest.raises(InputError) as caught:
        compute_rocking_spectrum(ground(), **given)  # type: ignore[arg-type]
    assert words in str(caught.value)


def test_what_is_no_record_and_what_the_linear_model_has_no_term_for_is_refused() -> None:
    with pytest.raises(InputError, match="motions"):
        compute_rocking_spectrum([], alpha=0.2, periods_s=math.pi)
    with pytest.raises(InputError, match="motions"):
        compute_rocking_spectrum(np.ones(3), alpha=0.2, periods_s=math.pi)  # type: ignore[arg-type]
    pulse = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0)
    for motion in (pulse, BaseMotion(pulse), BaseMotion(ground(), pulse)):
        with pytest.raises(InputError, match="motions"):
            compute_rocking_spectrum([ground(), motion], alpha=0.2, periods_s=math.pi)  # type: ignore[list-item]
    with pytest.raises(ModelError, match="vertical"):
        compute_rocking_spectrum(
            BaseMotion(ground(), lifting()), alpha=0.2, periods_s=math.pi, model=Linear()
        )
    slow = Record(acceleration_m_s2=np.array([1.0, 2.0]), dt_s=1e20)
    with pytest.raises(InputError, match="dt_s"):
        compute_rocking_spectrum(slow, alpha=0.2, periods_s=math.pi)


@pytest.mark.slow
def test_a_suite_of_real_records_is_what_its_time_histories_are() -> None:
    files = sorted((FOLDER / "suite_at2").glob("*.AT2"))[:12]
    if not files:
        pytest.skip(ABSENT)
    suite = [read_record(file) for file in files]
    for model in (Linear(), Nonlinear()):
        found = compute_rocking_spectrum(
            suite,
            alpha=[0.1, 0.2],
            periods_s=[2.0 * math.pi / p for p in (1.5, 3.0, 5.0)],
            model=model,
        )
        for place, record in enumerate(suite):
            for row, alpha in enumerate((0.1, 0.2)):
                for column, p in enumerate((1.5, 3.0, 5.0)):
                    cell = found.isel(record=place, alpha=row, period=column)
                    run = simulate(Block.from_p(alpha=alpha, p=p), record, model=model)
                    assert int(cell.status) == run.status
                    # After a thousand impacts 1e-15 of alpha has become 1e-7 of a peak.
                    assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-6, abs=1e-12)


def test_periods_and_scales_end_where_p_does() -> None:
    """The size 2 pi/p of a p from 1e-6 to 1e6 rad/s."""
    record = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0]), dt_s=0.1)
    ends = 2e-6 * math.pi, 2e6 * math.pi
    for period, inside in (
        (ends[0] * (1.0 + 1e-9), True),
        (ends[0] * (1.0 - 1e-9), False),
        (ends[1] * (1.0 - 1e-9), True),
        (ends[1] * (1.0 + 1e-9), False),
    ):
        if inside:
            found = compute_rocking_spectrum(record, alpha=0.2, periods_s=period)
            assert found.p.item() == pytest.approx(2.0 * math.pi / period, rel=1e-12)
        else:
            with pytest.raises(InputError, match="periods_s"):
                compute_rocking_spectrum(record, alpha=0.2, periods_s=period)
