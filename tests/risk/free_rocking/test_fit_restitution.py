"""Restitution from peaks: exact decays, motions that are simulated, noise, scatter, refusals."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block, Harmonic, Linear, Nonlinear, State, Still, fit_restitution, simulate
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import free_rocking_peaks, free_rocking_period
from rocksteady.histories import Release
from rocksteady.model.equations import Model
from rocksteady.risk.free_rocking.restitution_fit import decayed, impacts_until
from tests.every import every
from tests.risk.free_rocking.decays import decay

Floats = NDArray[np.float64]

BLOCK = Block.rectangle(width=0.05, height=0.5)
UNLIKE = Block.asymmetric(left=0.15, right=0.25, height=1.2, restitution=(0.87, 0.93))


@every("linear", [False, True])
@every("e", [0.6, 0.95, 0.999])
def test_closed_form_peaks_give_their_restitution_back(e: float, *, linear: bool) -> None:
    alpha = None if linear else BLOCK.alpha
    peaks = BLOCK.alpha * free_rocking_peaks(0.7, e, 15, alpha=alpha)
    fit = fit_restitution(peaks, BLOCK, model=Linear() if linear else None)
    assert fit.restitution == pytest.approx((e, e), abs=1e-10)
    assert fit.factor == pytest.approx((e / 0.98514851485,) * 2, rel=1e-9)
    assert fit.scatter < 1e-10
    assert fit.warnings == ()
    expected = 1 + int(np.argmax(free_rocking_peaks(0.7, e, 5000, alpha=alpha)[1:] <= 0.05 * 0.7))
    assert fit.to_small == expected


def _turning_points(block: Block, model: Model, impacts: int) -> tuple[Floats, Floats]:
    """Return times [s] and angles [rad] at which a simulated free rocking turns."""
    still = Harmonic(amplitude=0.0, frequency_ratio=1.0)
    run = simulate(block, still, start=State(angle=0.6, velocity=0.0), model=model, cycles=20)
    times, angles = [0.0], [0.6]
    for begin, end in itertools.pairwise(run.impacts.pt[:impacts].tolist()):
        span, found = (begin, end), (0.0, 0.0)
        for _ in range(4):
            at = np.linspace(*span, 401)
            angle = np.abs(run(at).angle)
            top = int(np.argmax(angle))
            span, found = (at[max(top - 1, 0)], at[min(top + 1, 400)]), (at[top], angle[top])
        times.append(float(found[0]))
        angles.append(float(found[1]))
    return np.array(times) / block.p, block.alpha * np.array(angles)


@every(("model", "close"), [(Linear(), 1e-10), (Nonlinear(), 1e-8)])
@every("block", [BLOCK.with_restitution(0.93), UNLIKE])
def test_a_simulated_motion_shows_the_restitution_of_its_block(
    block: Block, model: Model, close: float
) -> None:
    times, peaks = _turning_points(block, model, 9)
    fit = fit_restitution(Release(peaks_rad=peaks, times_s=times), block, model=model)
    own = block.positive.restitution, block.negative.restitution
    assert fit.restitution == pytest.approx(own, abs=close)
    assert fit.half_periods == pytest.approx(1.0, abs=1e-5)
    second = Release(peaks_rad=peaks[::2], times_s=times[::2], sides=1)
    # One factor for both sides, which the times hardly feel.
    assert fit_restitution(second, block, model=model).half_periods == pytest.approx(1.0, abs=0.01)


def test_unlike_sides_have_their_own_energy_and_their_own_restitution() -> None:
    ratios = np.tile([0.87, 0.93], 6)
    peaks = decay(UNLIKE, 0.5 * UNLIKE.alpha, ratios)
    fit = fit_restitution(peaks, UNLIKE)
    assert fit.restitution == pytest.approx((0.87, 0.93), abs=1e-10)
    assert [each.side for each in fit.impacts[:3]] == [1, -1, 1]
    # One factor on both of Housner's values, whichever peaks are there.
    housner = np.array(fit.housner)
    shared = decay(UNLIKE, 0.5 * UNLIKE.alpha, np.tile(0.97 * housner, 6))
    every = fit_restitution(shared, UNLIKE, each_side=False)
    second = fit_restitution(Release(peaks_rad=shared[::2], sides=1), UNLIKE)
    for found in (every, second):
        assert found.restitution == pytest.approx(tuple(0.97 * housner), abs=1e-10)
        assert found.factor == pytest.approx((0.97, 0.97), abs=1e-10)
    assert second.impacts[0].side == 0


def test_peaks_that_follow_from_the_first_are_those_of_bisection() -> None:
    for block, ratios in ((UNLIKE, (0.87, 0.93)), (BLOCK, (0.9, 0.9))):
        peaks = decay(block, 0.5 * block.positive.alpha, np.tile(ratios, 4))
        found = decayed(Release(peaks_rad=peaks), block, Nonlinear(), ratios)
        assert found == pytest.approx(peaks, rel=1e-9)


def test_peaks_of_one_side_are_two_impacts_apart() -> None:
    peaks = BLOCK.alpha * free_rocking_peaks(0.7, 0.95, 16, alpha=BLOCK.alpha)
    one_side = Release(peaks_rad=peaks[::2], sides=-1)
    assert fit_restitution(one_side, BLOCK).restitution[0] == pytest.approx(0.95, abs=1e-10)
    # A peak that was missed leaves two of one side in a row.
    sides = np.delete(np.resize([1, -1], 17), 4).tolist()
    missed = Release(peaks_rad=np.delete(peaks, 4), sides=sides)
    assert fit_restitution(missed, BLOCK).restitution[0] == pytest.approx(0.95, abs=1e-10)


def _drawn(rng: np.random.Generator, tau: float, sigma: float, impacts: int = 20) -> Release:
    ratios = 0.95 * np.exp(tau * rng.standard_normal(impacts))
    peaks = decay(BLOCK, 0.6 * BLOCK.alpha, ratios)
    noisy = np.abs(peaks + sigma * rng.standard_normal(peaks.size))
    return Release(peaks_rad=noisy, sigma_rad=sigma)


@pytest.mark.slow
@pytest.mark.parametrize(("tau", "sigma"), [(0.0, 3e-4), (0.03, 3e-4)])
def test_intervals_of_nine_in_ten_hold_restitution_and_scatter(tau: float, sigma: float) -> None:
    rng = np.random.default_rng(7)
    fits = [fit_restitution(_drawn(rng, tau, sigma), BLOCK) for _ in range(60)]
    held = np.mean([fit.low[0] <= 0.95 <= fit.high[0] for fit in fits])
    # Three standard deviations of 60 trials at 0.9; without any scatter intervals are too wide.
    assert held >= 0.784
    true = 0.95 * tau
    scatters = np.mean([fit.scatter_low <= true <= fit.scatter_high for fit in fits])
    assert scatters >= 0.784
    mean = np.mean([fit.restitution[0] for fit in fits])
    assert mean == pytest.approx(0.95, abs=5e-4)
    if tau == 0.03:
        assert np.mean([fit.scatter for fit in fits]) == pytest.approx(true, rel=0.1)


@pytest.mark.slow
def test_scatter_and_measuring_error_are_told_apart() -> None:
    rng = np.random.default_rng(11)
    bare = [_drawn(rng, 0.03, 4e-4, 24) for _ in range(6)]
    releases = [Release(peaks_rad=each.peaks_rad) for each in bare]
    fit = fit_restitution(releases, BLOCK)
    assert fit.sigma_estimated
    assert fit.sigma_rad == pytest.approx(4e-4, rel=0.5)
    assert fit.scatter_low < 0.95 * 0.03 < fit.scatter_high
    assert fit.scatter == pytest.approx(0.95 * 0.03, rel=0.25)
    known = fit_restitution(bare, BLOCK)
    assert known.restitution == pytest.approx(fit.restitution, abs=2e-3)


def test_what_is_lost_in_the_noise_is_left_out_and_said() -> None:
    peaks = BLOCK.alpha * free_rocking_peaks(0.6, 0.95, 30, alpha=BLOCK.alpha)
    fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=1e-3), BLOCK)
    lost = int((peaks < 6e-3).sum())
    assert lost > 5
    assert fit.left_out == lost
    assert len(fit.impacts) == 30 - lost
    assert f"{lost} peaks left out" in fit.warnings[0]
    assert fit.restitution[0] == pytest.approx(0.95, abs=1e-10)


def test_a_peak_that_grows_is_named() -> None:
    peaks = BLOCK.alpha * free_rocking_peaks(0.6, 0.95, 9, alpha=BLOCK.alpha)
    peaks[5] = 1.05 * peaks[4]
    fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=1e-5, name="third"), BLOCK)
    assert "grow over impact 5 of third, more than the measuring error" in fit.warnings[0]
    noisy = fit_restitution(Release(peaks_rad=peaks, sigma_rad=1e-3, name="third"), BLOCK)
    assert "within the measuring error" in noisy.warnings[0]


def test_a_restitution_that_falls_with_the_amplitude_is_a_trend() -> None:
    peaks = [0.6]
    for _ in range(20):
        e = 0.96 - 0.1 * peaks[-1]
        peaks.append(float(free_rocking_peaks(peaks[-1], e, 1, alpha=BLOCK.alpha)[1]))
    fit = fit_restitution(BLOCK.alpha * np.array(peaks), BLOCK)
    assert fit.trend == pytest.approx(-0.1, rel=0.05)
    assert any("changes with the amplitude" in each for each in fit.warnings)


def test_half_periods_tell_a_block_that_is_another() -> None:
    narrow = Block.rectangle(width=0.04, height=0.5)
    ratio = free_rocking_peaks(0.6, 0.95, 10, alpha=narrow.alpha)
    quarters = free_rocking_period(ratio, alpha=narrow.alpha) / (4.0 * narrow.p)
    times = np.concatenate([[0.0], np.cumsum(quarters[:-1] + quarters[1:])])
    release = Release(peaks_rad=narrow.alpha * ratio, times_s=times)
    own = fit_restitution(release, narrow)
    assert own.half_periods == pytest.approx(1.0, abs=1e-12)
    assert own.warnings == ()
    other = fit_restitution(release, BLOCK)
    assert other.half_periods is not None
    assert other.half_periods > 1.1
    assert any("does not agree with its outline" in each for each in other.warnings)


def test_a_block_too_stocky_for_housner_has_a_restitution_and_no_factor() -> None:
    stocky = Block.from_p(alpha=1.1, p=2.0, restitution=0.5)
    peaks = stocky.alpha * free_rocking_peaks(0.4, 0.5, 6, alpha=stocky.alpha)
    fit = fit_restitution(peaks, stocky)
    assert fit.restitution[0] == pytest.approx(0.5, abs=1e-10)
    assert (fit.housner, fit.factor, fit.to_small_housner) == (None, None, None)
    assert "so stocky a block" in fit.summary(more=True)


@every(
    ("peaks", "words"),
    [
        ([0.05], "needs the peaks before and after it"),
        ([0.11, 0.05], "peak 1 of release is above alpha, 0.0996687 rad"),
        ([0.05, -0.04], r"must lie in \(0"),
        ([0.05, float("nan")], r"must lie in \(0|finite"),
        (
            Release(peaks_rad=[0.05, 0.04], sigma_rad=0.02),
            "2 peaks are lost in the measuring error",
        ),
        ([[0.05, 0.04]], "needs the peaks before and after it"),
    ],
)
def test_what_shows_no_impact_is_refused(peaks: Any, words: str) -> None:
    with pytest.raises(InputError, match=words) as refused:
        fit_restitution(peaks, BLOCK)
    assert "\n" not in str(refused.value)


def test_two_peaks_give_a_value_and_no_error() -> None:
    peaks = BLOCK.alpha * free_rocking_peaks(0.6, 0.95, 1, alpha=BLOCK.alpha)
    fit = fit_restitution(peaks, BLOCK)
    assert fit.restitution[0] == pytest.approx(0.95, abs=1e-10)
    assert (fit.low[0], fit.high[0]) == (0.0, np.inf)
    assert math.isinf(fit.standard_error[0])
    assert math.isnan(fit.scatter)
    assert fit.to_dict()["standard_error"] == [None, None]
    assert fit.summary(more=True).count("not identified: too few impacts") == 3
    assert "cannot be estimated" in fit.warnings[0]


@every(
    ("wrong", "words"),
    [
        ({"sides": [1, -1]}, "there are 3 peaks"),
        ({"sides": [1, 0, 1]}, "must be 1 or -1"),
        ({"sides": 0.5}, "must be 1 or -1"),
        ({"name": 3.0}, "a text that is not empty"),
        ({"times_s": [0.0, 0.2, 0.2]}, "do not rise"),
        ({"sigma_rad": -1e-3}, r"must lie in \[0"),
        ({"sigma_rad": [1e-3, 1e-3]}, "there are 3 peaks"),
        ({"name": " "}, "must be a text"),
    ],
)
def test_what_is_no_release_is_refused(wrong: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        Release(**{"peaks_rad": [0.05, 0.04, 0.03], **wrong})


def test_a_block_against_a_wall_is_sent_to_the_free_one_whose_peaks_are_the_same() -> None:
    block = Block.rectangle(width=0.05, height=0.5)
    with pytest.raises(ModelError, match="without its wall"):
        fit_restitution([0.05, 0.04, 0.03], block.against_wall(0.9))
    # The same: from one height both models fall, turn back and rise alike, on one side or on two.
    start = State(angle=0.6, velocity=0.0)
    free, wall = (
        simulate(each, Still(), start=start, model=Nonlinear())
        for each in (block.with_restitution(0.9), block.against_wall(0.9))
    )
    one, other = (
        np.abs([run(float(pt)).angle for pt in np.linspace(0.0, 8.0, 50)]) for run in (free, wall)
    )
    np.testing.assert_allclose(one, other, atol=1e-9)
    assert one.max() == 0.6


def test_weights_may_vanish_where_a_caller_lets_underflow_raise() -> None:
    peaks, block = [0.08, 0.06, 0.047, 0.036, 0.028], Block.rectangle(width=0.2, height=1.0)
    with np.errstate(all="raise"):
        raised = fit_restitution(peaks, block)
    assert raised.restitution == fit_restitution(peaks, block).restitution


def exact(e: float = 0.95, count: int = 12, block: Block = BLOCK) -> Floats:
    """Return peaks of a block with one restitution from 0.6 alpha."""
    return block.alpha * np.array(free_rocking_peaks(0.6, e, count, alpha=block.alpha))


def counted(block: Block, start: float, side: int, ratios: tuple[float, float]) -> int:
    """Return after how many impacts a peak is 5 % of the first, impact by impact."""
    if side == -1:  # mirrored
        swapped = (block.negative, block.positive)
        ratios = ratios[::-1]
    else:
        swapped = (block.positive, block.negative)
    alpha, p = [each.alpha for each in swapped], [each.p for each in swapped]
    speed = p[0] * math.sqrt(2.0 * (math.cos(alpha[0] - start) - math.cos(alpha[0])))
    for number in range(1, 100_000):
        speed *= ratios[(number - 1) % 2]
        at = number % 2
        aim = math.cos(alpha[at] - 0.05 * start) - math.cos(alpha[at])
        if 0.5 * (speed / p[at]) ** 2 <= aim * (1.0 + 1e-11):
            return number
    raise AssertionError


def test_impacts_until_a_twentieth_are_those_counted_one_by_one() -> None:
    for block, ratios in (
        *((BLOCK, (each, each)) for each in (0.2, 0.5, 0.8, 0.9, 0.95, 0.99, 0.999)),
        *((UNLIKE, each) for each in ((0.87, 0.93), (0.93, 0.87), (0.5, 0.99), (0.3, 1.5))),
    ):
        for side in (1, -1):
            for part in (0.1, 0.5, 0.95):
                alpha = (block.positive if side == 1 else block.negative).alpha
                peaks = [part * alpha, 0.9 * part * alpha]
                sides = [side, -side]
                if max(peaks) > min(block.positive.alpha, block.negative.alpha):
                    continue
                release = Release(peaks_rad=peaks, sides=sides)
                result = impacts_until(release, block, Nonlinear(), ratios)
                assert result == counted(block, part * alpha, side, ratios), (ratios, side, part)
    release = Release(peaks_rad=exact())
    for never in ((1.0, 1.0), (1.2, 0.9), (0.5, 2.0), (1.0 - 1e-9, 1.0 - 1e-9)):
        assert impacts_until(release, BLOCK, Nonlinear(), never) is None, never


def test_measuring_errors_are_those_of_differences_of_the_ratio() -> None:
    """Of the ratio of velocities by its peaks: central differences of the textbook's energy."""
    sigma = 2e-4

    def speed(block: Block, side: int, peak: float) -> float:
        at = block.positive if side == 1 else block.negative
        return at.p * math.sqrt(2.0 * (math.cos(at.alpha - peak) - math.cos(at.alpha)))

    for block, ratios in ((BLOCK, (0.95, 0.95)), (UNLIKE, (0.87, 0.93))):
        peaks = decay(block, 0.6 * block.positive.alpha, np.tile(ratios, 4))
        fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=sigma), block)
        for place, impact in enumerate(fit.impacts):
            sides = (1, -1) if place % 2 == 0 else (-1, 1)
            pair = peaks[place], peaks[place + 1]
            ratio = [
                speed(block, sides[1], pair[1] + after) / speed(block, sides[0], pair[0] + before)
                for before, after in (
                    (0.0, 0.0),
                    (1e-6, 0.0),
                    (-1e-6, 0.0),
                    (0.0, 1e-6),
                    (0.0, -1e-6),
                )
            ]
            by_peaks = (ratio[1] - ratio[2]) / 2e-6, (ratio[3] - ratio[4]) / 2e-6
            assert impact.restitution == pytest.approx(ratio[0], rel=1e-9)
            assert impact.measuring_error == pytest.approx(sigma * math.hypot(*by_peaks), rel=1e-5)
            assert impact.residual == pytest.approx(0.0, abs=1e-6)
            assert (impact.number, impact.side) == (place + 1, sides[0])
            assert (impact.peak_rad, impact.next_rad) == pair
    # Of two impacts at a time the ratio is a geometric mean.
    peaks = exact(count=16)
    fit = fit_restitution(Release(peaks_rad=peaks[::2], sides=1, sigma_rad=sigma), BLOCK)
    first = fit.impacts[0]
    ratio = [speed(BLOCK, 1, peaks[2] + d) / speed(BLOCK, 1, peaks[0]) for d in (0.0, 1e-6, -1e-6)]
    counterpart = [speed(BLOCK, 1, peaks[2]) / speed(BLOCK, 1, peaks[0] + d) for d in (1e-6, -1e-6)]
    by_peaks = (
        (math.sqrt(ratio[1]) - math.sqrt(ratio[2])) / 2e-6,
        (math.sqrt(counterpart[0]) - math.sqrt(counterpart[1])) / 2e-6,
    )
    assert first.restitution == pytest.approx(math.sqrt(ratio[0]), rel=1e-9)
    assert first.measuring_error == pytest.approx(sigma * math.hypot(*by_peaks), rel=1e-5)
    assert (first.side, first.number) == (0, 1)


def test_a_trend_is_the_slope_of_the_restitution_against_the_amplitude() -> None:
    """With closely measured peaks it is ordinary least squares of ln(e) on theta/alpha."""
    rng = np.random.default_rng(5)
    ratios = 0.95 * np.exp(0.02 * rng.standard_normal(14))
    peaks = decay(BLOCK, 0.7 * BLOCK.alpha, ratios)
    fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=1e-9), BLOCK)
    amplitude = peaks[:-1] / BLOCK.alpha
    slope, middle = np.polyfit(amplitude, np.log(ratios), 1)
    mean = math.exp(float(np.log(ratios).mean()))
    assert fit.trend == pytest.approx(mean * slope, rel=1e-4)
    spread = float(np.square(amplitude - amplitude.mean()).sum())
    # Its error has the scatter of the fit without the trend.
    scatter = float(np.log(ratios).std(ddof=1))
    assert fit.trend_error == pytest.approx(mean * scatter / math.sqrt(spread), rel=1e-3)
    assert fit.scatter == pytest.approx(mean * scatter, rel=1e-3)
    assert middle < 0.0
    remarked = any("changes with the amplitude" in each for each in fit.warnings)
    assert remarked == (abs(fit.trend or 0.0) > 2.0 * (fit.trend_error or 0.0))


def test_steps_that_a_trend_and_a_measuring_error_need() -> None:
    for count, trend in ((3, False), (4, True), (5, True)):
        assert (fit_restitution(exact(count=count), BLOCK).trend is not None) == trend
        joint = decay(UNLIKE, 0.5 * UNLIKE.positive.alpha, np.resize([0.87, 0.93], count))
        assert (fit_restitution(joint, UNLIKE).trend is not None) == (count > 4)
    # Peaks that are all alike have no amplitude to change with.
    level = fit_restitution(np.full(8, 0.05), BLOCK)
    assert level.restitution == pytest.approx((1.0, 1.0), abs=1e-12)
    assert (level.trend, level.trend_error, level.to_small) == (None, None, None)
    rng = np.random.default_rng(3)
    for count, short in ((7, True), (8, False)):
        peaks = exact(count=count) * (1.0 + 0.003 * rng.standard_normal(count + 1))
        fit = fit_restitution(peaks, BLOCK)
        words = f"From {count} steps the measuring error cannot be estimated: the scatter holds it "
        assert (f"{words}too. Give sigma_rad, or more impacts." in fit.warnings) == short
        assert fit.sigma_estimated
        assert (
            fit_restitution(Release(peaks_rad=peaks, sigma_rad=1e-4), BLOCK).sigma_estimated
            is False
        )


def test_a_peak_of_six_standard_deviations_still_counts() -> None:
    peaks = exact(count=8)
    for part, kept in ((6.0001, 8), (5.9999, 7)):
        fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=float(peaks[-1]) / part), BLOCK)
        assert (len(fit.impacts), fit.left_out) == (kept, 8 - kept), part
        words = "1 peak left out: from the first one below 6 standard deviations of the measuring "
        assert (f"{words}error on, a release shows nothing of its impacts." in fit.warnings) == (
            kept == 7
        )
    each = np.full(9, 1e-9)
    each[4] = float(peaks[4])  # what comes behind a lost peak is lost too
    fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=each), BLOCK)
    assert (len(fit.impacts), fit.left_out) == (3, 5)
    assert fit.sigma_rad is None
    same = fit_restitution(Release(peaks_rad=peaks, sigma_rad=np.full(9, 1e-6)), BLOCK)
    assert same.sigma_rad == 1e-6


def test_half_periods_are_remarked_on_beyond_a_twentieth() -> None:
    peaks = exact()
    quarters = free_rocking_period(peaks / BLOCK.alpha, alpha=BLOCK.alpha) / (4.0 * BLOCK.p)
    times = np.concatenate([[0.0], np.cumsum(quarters[:-1] + quarters[1:])])
    for share, remarked in ((1.049, False), (1.051, True), (0.951, False), (0.949, True)):
        fit = fit_restitution(Release(peaks_rad=peaks, times_s=share * times), BLOCK)
        assert fit.half_periods == pytest.approx(share, rel=1e-9)
        assert any("Measured half periods are" in each for each in fit.warnings) == remarked
        assert "half periods" in fit.summary(more=True)
    joint = [Release(peaks_rad=peaks), Release(peaks_rad=peaks, times_s=5.0 + 1.02 * times)]
    assert fit_restitution(joint, BLOCK).half_periods == pytest.approx(1.02, rel=1e-9)
    assert fit_restitution(joint[:1], BLOCK).half_periods is None


def test_peaks_that_grow_are_named_up_to_three() -> None:
    for grown, more in ((1, ""), (3, ""), (4, " and 1 more"), (5, " and 2 more")):
        peaks = exact(count=14)
        for at in range(grown):
            peaks[2 + 2 * at] = 1.02 * peaks[1 + 2 * at]
        fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=1e-6, name="third"), BLOCK)
        named = ", ".join(f"impact {2 + 2 * at} of third" for at in range(min(grown, 3)))
        assert fit.warnings[0] == (
            f"The peaks grow over {named}{more}, more than the measuring error explains: check "
            "their order and sides, and whether the base was still."
        )
    fit = fit_restitution(decay(BLOCK, 0.3 * BLOCK.alpha, np.full(6, 1.02)), BLOCK)
    assert fit.restitution[0] > 1.0
    assert "A restitution above 1 is that of no impact: blocks take at most 1." in fit.warnings
    assert fit.measured.restitution == 1.0
    assert fit_restitution(exact(), BLOCK).measured.restitution == pytest.approx(0.95)


def test_peaks_that_a_fit_computes() -> None:
    fit = fit_restitution(exact(), BLOCK)
    release = Release(peaks_rad=exact())
    np.testing.assert_allclose(fit.peaks_of(release), exact(), rtol=1e-8)
    np.testing.assert_allclose(fit.peaks_of(release, (0.9, 0.9)), exact(e=0.9), rtol=1e-8)
    assert fit.peaks_of(release, (2.0, 2.0))[1] == pytest.approx(BLOCK.alpha)
    for wrong in ((0.9,), (0.9, 0.9, 0.9), (0.0, 0.9), (0.9, 2.01), (-0.1, 0.9)):
        with pytest.raises(InputError, match=r"^ratios = "):
            fit.peaks_of(release, wrong)
    with pytest.raises(
        InputError, match="no impact of one side was measured alone; give the peaks"
    ):
        fit_restitution(Release(peaks_rad=exact()[::2], sides=1), BLOCK, each_side=True)
    with pytest.raises(InputError, match="no impact of one side was measured alone"):
        fit_restitution(exact(count=1), BLOCK, each_side=True)
    twice = fit_restitution(exact(), BLOCK, each_side=True)
    assert twice.restitution == pytest.approx((0.95, 0.95))
