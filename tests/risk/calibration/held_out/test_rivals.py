"""The logistic curve against statsmodels, base rates by hand, measures against their own module."""

import math
from dataclasses import replace

import numpy as np
import pytest
import statsmodels.api as sm

from rocksteady import compute_measures
from rocksteady.calibration import ObjectPrior, ShakingTest
from rocksteady.risk.calibration.held_out import rivals
from tests.risk.calibration.trials import make_records


def test_without_a_ridge_the_curve_is_that_of_statsmodels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rivals, "RIDGE", 0.0)
    rng = np.random.default_rng(1)
    measures = rng.normal(size=(150, 3)) * [1.0, 5.0, 0.1] + [0.0, 30.0, 1.0]
    fell = (rng.random(150) < 1 / (1 + np.exp(-measures[:, 0]))).astype(float)
    centre, scale, at = rivals.fit_logistic(measures, fell)
    design = sm.add_constant((measures - centre) / scale)
    extra = np.zeros((2, 4))
    extra[:, 0] = 1.0
    model = sm.GLM(
        np.append(fell, [1.0, 0.0]),
        np.vstack([design, extra]),
        family=sm.families.Binomial(),
        freq_weights=np.append(np.ones(150), [0.1, 0.1]),
    )
    assert at == pytest.approx(model.fit(tol=1e-12).params, abs=1e-6)


def test_ridge_maximises_the_penalised_likelihood() -> None:
    rng = np.random.default_rng(2)
    measures = rng.normal(size=(30, 2))
    fell = (measures[:, 0] > 0).astype(float)  # separated: without a ridge the slope is infinite
    centre, scale, at = rivals.fit_logistic(measures, fell)
    design = np.column_stack([np.ones(30), (measures - centre) / scale])

    def penalised(b: np.ndarray) -> float:
        odds = design @ b
        ends = 0.1 * (np.logaddexp(0, -b[0]) + np.logaddexp(0, b[0]))
        own = (np.logaddexp(0, odds) - fell * odds).sum()
        return float(own + ends + 0.5 * rivals.RIDGE * (b[1:] ** 2).sum())

    best = penalised(at)
    for step in 1e-3 * rng.normal(size=(50, 3)):
        assert penalised(at + step) > best


def test_base_rate_is_of_the_object_and_of_the_training() -> None:
    fell = np.array([1.0, 0.0, 1.0, 1.0, np.nan, 0.0])
    objects = np.array([0, 0, 0, 1, 1, 1])
    train = np.array([True, True, False, True, True, True])
    found = rivals.base_rate(fell, objects, train)
    assert found.tolist() == [0.5, 0.5, 0.5, 0.5, 0.5, 0.5]
    assert rivals.base_rate(fell, objects, ~train)[:3].tolist() == [2 / 3] * 3


def test_measures_are_those_of_the_record_and_the_outline() -> None:
    record = make_records(1)[0]
    column = ObjectPrior(name="column", width_m=0.2, height_m=0.8, base="0.6:1.0")
    test = ShakingTest(name="t", record=record, object="column", gain=1.7)
    row = rivals.measures_of([test], {"column": column})[0]
    found = compute_measures(record)
    uplift = 9.80665 * 0.25
    assert row[0] == pytest.approx(math.log(1.7 * found.pga_m_s2 / uplift))
    assert row[2:4] == pytest.approx(np.log([found.pgv_per_pga_s, found.significant_5_95_s]))
    assert len(row) == len(rivals.MEASURES) == 14
    twice = rivals.measures_of([replace(test, gain=3.4)], {"column": column})[0] - row
    assert twice == pytest.approx(np.log(2.0) * np.array([1, 1, 0, 0, 1, 2, 1, 1, 1, *[0] * 5]))
    p = column.block([0.8, 0.5 * (0.85 + 1.1), 0.05]).p
    assert row[1] == pytest.approx(math.log(1.7 * p * found.pgv_m_s / uplift), abs=1e-6)


def test_outcomes_of_one_kind_have_a_curve() -> None:
    measures = np.random.default_rng(3).normal(size=(12, 4))
    found = rivals.logistic(measures, np.ones(12), np.ones(12, dtype=bool))
    assert ((found > 0.9) & (found < 1.0)).all()


def test_a_gain_is_a_record_that_is_so_much_stronger() -> None:
    """Every measure of a test is that of the scaled record without a gain."""
    objects = {
        "a": ObjectPrior(name="a", width_m=0.2, height_m=1.0, base=1.0),
        "b": ObjectPrior(name="b", alpha_rad=0.3, p_rad_s=4.0),
    }
    records = make_records(2)
    gains = (0.5, 1.0, 3.0)
    tests: list[ShakingTest] = []
    scaled: list[ShakingTest] = []
    for name in objects:
        for record in records:
            for gain in gains:
                usual = {"name": f"{len(tests)}", "object": name, "fell": True}
                tests.append(ShakingTest(record=record, gain=gain, **usual))  # type: ignore[arg-type]
                scaled.append(ShakingTest(record=record.scaled(gain), **usual))  # type: ignore[arg-type]
    result, expected = (rivals.measures_of(each, objects) for each in (tests, scaled))
    assert result.shape == (12, len(rivals.MEASURES))
    np.testing.assert_allclose(result, expected, rtol=1e-6, atol=1e-9)
    # What scales with the square of the gain, with the gain, and what does not change.
    grown = np.exp(result[2] - result[1])
    powers = {
        name: (2.0 if "gain^2" in name else 1.0 if "gain" in name else 0.0)
        for name in rivals.MEASURES
    }
    np.testing.assert_allclose(grown, [3.0**power for power in powers.values()], rtol=1e-6)
    # The last two are of the object: g tan alpha of its outline and p of its middle.
    np.testing.assert_allclose(result[0, -2], math.log(9.80665 * 0.2), rtol=1e-9)
    np.testing.assert_allclose(result[-1, -2:], np.log([9.80665 * math.tan(0.3), 4.0]), rtol=1e-9)


def test_a_curve_knows_no_units_of_its_measures() -> None:
    """Measures are counted in their own deviations: other units and zeros change nothing."""
    rng = np.random.default_rng(8)
    measures = rng.normal(size=(60, 3))
    fell = (measures[:, 0] + 0.5 * rng.normal(size=60) > 0.0).astype(float)
    fell[::7] = np.nan
    train = np.arange(60) % 3 != 0
    result = rivals.logistic(measures, fell, train)
    counterpart = rivals.logistic(measures * [100.0, 0.01, 3.0] + [5.0, -2.0, 0.1], fell, train)
    np.testing.assert_allclose(result, counterpart, rtol=1e-7)
    assert np.corrcoef(result, measures[:, 0])[0, 1] > 0.9
    nothing = rivals.logistic(measures, fell, np.zeros(60, dtype=bool))
    assert (nothing == 0.5).all()
    rates, curves = rivals.out_of_group(measures, fell, np.zeros(60, dtype=int), np.arange(60) % 3)
    held = np.arange(60) % 3 == 0
    np.testing.assert_allclose(curves[held], result[held], rtol=1e-12)
    np.testing.assert_allclose(
        rates[held], rivals.base_rate(fell, np.zeros(60, dtype=int), ~held)[held]
    )
