"""Gates of uplift: known of equal blocks in PGA, not where a run, a side or a block disagrees."""

import math

import numpy as np
import pytest
import xarray

from rocksteady import (
    BaseMotion,
    Block,
    Linear,
    Nonlinear,
    Record,
    compute_fragility,
    floor_motion,
    read_record,
    run_ensemble,
)
from rocksteady.export import LossComponent
from rocksteady.risk import FitOptions, Levels, RestitutionBand, fit_curve, fit_fragility
from rocksteady.risk.ensemble.gates import condition_of, lowest_gate
from tests.records import ABSENT, FOLDER
from tests.seismic.grounds import ground

BLOCK = Block.rectangle(width=0.4, height=1.6)
OTHER = Block.asymmetric(left=0.25, right=0.4, height=2.4)
PLAIN = FitOptions(bands=None)
SUITE = tuple(
    Record(
        acceleration_m_s2=ground(seed).acceleration_m_s2,
        dt_s=0.02 * (1.5 + 0.25 * (seed % 6)),
        name=f"ground {seed}",
    )
    for seed in range(12)
)


@pytest.mark.parametrize("gravity", [9.80665, 3.5])
def test_a_known_gate_makes_the_second_stage_one_of_the_excess(gravity: float) -> None:
    gate = gravity / 9.80665 * math.tan(BLOCK.alpha)
    for name, level in (("pga_g", gate), ("pga_per_uplift", 1.0)):
        found = compute_fragility(
            Block.rectangle(width=0.4, height=1.6, gravity=gravity),
            SUITE,
            levels=Levels(name, level * np.array([0.6, 1.3, 1.8, 2.5, 3.5, 5.0]), beside=()),
            restitution=RestitutionBand(draws=1),
            fitting=FitOptions(states=[0.5], bands=None),
        )
        two = found.states[0].two_stage
        assert two is not None
        assert two.gate == pytest.approx(level, rel=1e-12)
        # Both forms by themselves: the likelier is kept.
        lifted = np.array([row for row in found.states[0].points if row[2]], dtype=float)
        at, trials, _, fell = lifted.T
        forms = {
            shift: fit_curve(at - shift, fell, trials).log_likelihood for shift in (0.0, two.gate)
        }
        assert two.offset == max(forms, key=lambda shift: forms[shift])
        assert two.log_likelihood == pytest.approx(max(forms.values()), rel=1e-9)
        rows = {row["stage"]: row for row in found.to_dict()["fits"]}
        assert rows["given-uplift"]["offset"] == two.offset
        assert {rows[stage]["offset"] for stage in ("two-stage", "uplift", "plain")} == {0.0}


def test_a_gate_is_known_below_the_lowest_level_too() -> None:
    gate = math.tan(BLOCK.alpha)
    found = compute_fragility(
        BLOCK,
        SUITE,
        levels=Levels("pga_g", [1.5 * gate, 3.0 * gate, 6.0 * gate], beside=()),
        restitution=RestitutionBand(draws=1),
        fitting=FitOptions(states=["overturned"], bands=None),
    )
    curve = found.states[0].curve
    assert found.states[0].points[0][1] == found.states[0].points[0][2]
    assert float(curve.probability(0.999 * gate)) == 0.0


@pytest.mark.parametrize("blocks", [[OTHER], [BLOCK, Block.rectangle(width=0.4, height=2.4)]])
def test_unequal_sides_and_unequal_blocks_have_no_one_gate(blocks: list[Block]) -> None:
    found = compute_fragility(
        blocks,
        SUITE,
        levels=Levels("pga_g", [0.05, 0.3, 0.6, 1.2], beside=()),
        restitution=RestitutionBand(draws=1),
        fitting=FitOptions(states=["overturned"], bands=None),
    )
    two = found.states[0].two_stage
    assert two is not None
    assert (two.gate, two.offset) == (None, 0.0)


def test_a_block_against_a_wall_has_no_gate_in_the_peak_of_either_sign() -> None:
    gate = math.tan(BLOCK.alpha)
    at = [0.9 * gate, 1.05 * gate, 1.2 * gate, 1.5 * gate, 4.0 * gate]
    levels = Levels("pga_g", at, beside=())
    band = RestitutionBand(draws=1)
    found = compute_fragility(
        BLOCK.against_wall(), SUITE, levels=levels, restitution=band, fitting=PLAIN
    )
    two = found.state("overturned").two_stage
    assert two is not None
    assert (two.gate, two.offset) == (None, 0.0)
    # Each record lifts it in the direction of its peak; in the other only if that peak is enough.
    lifts = [
        sum(
            float((sign * r.acceleration_m_s2).max() / abs(r.peak_acceleration_m_s2)) * level > gate
            for r in SUITE
            for sign in (1.0, -1.0)
        )
        for level in at
    ]
    assert [row[2] for row in found.state("overturned").points] == lifts
    assert len(SUITE) < lifts[1] < 2 * len(SUITE)
    free = compute_fragility(BLOCK, SUITE, levels=levels, restitution=band, fitting=PLAIN)
    assert free.state("overturned").two_stage.gate == pytest.approx(gate)  # type: ignore[union-attr]
    assert free.state("uplift").curve.median != found.state("uplift").curve.median


def test_a_gate_that_a_run_contradicts_is_not_known() -> None:
    gate = math.tan(BLOCK.alpha)
    levels = Levels("pga_g", [0.8 * gate, 2.0 * gate, 4.0 * gate], beside=())
    runs = run_ensemble(BLOCK, SUITE, levels=levels, restitution=RestitutionBand(draws=1))
    runs["peak_angle"].values[..., 0].flat[0] = 0.01
    two = fit_fragility(runs, fitting=PLAIN).state("overturned").two_stage
    assert two is not None
    assert two.gate is None


def test_few_records_are_a_whole_sentence_and_come_once() -> None:
    runs = run_ensemble(
        BLOCK,
        SUITE[:7],
        levels=Levels("pga_g", [0.1, 0.3, 0.6, 1.2], beside=()),
        restitution=RestitutionBand(draws=1),
    )
    sentences = [text for text in fit_fragility(runs).warnings if "7 records" in text]
    assert sorted(sentences) == [
        "7 records, fewer than 22: another suite may give another curve",
        "there is no confidence band: 7 records, and it needs 11",
    ]


@pytest.mark.slow
def test_a_statue_in_pga_is_described_by_two_stages() -> None:
    """Lognormals in PGA miss the shares by .2: at .30 g none falls, at .50 g 64 %."""
    files = sorted((FOLDER / "suite_at2").glob("*.AT2"))
    if not files:
        pytest.skip(ABSENT)
    found = compute_fragility(
        Block.from_radius(alpha=0.27, radius=0.9),
        [read_record(file) for file in files],
        levels=Levels("pga_g", np.linspace(0.1, 1.5, 29), beside=()),
        restitution=RestitutionBand(draws=3),
        fitting=PLAIN,
    )
    state = found.state("overturned")
    two = state.two_stage
    assert two is not None
    assert two.offset == pytest.approx(math.tan(0.27), rel=1e-12)
    shares = {round(level, 2): fell / trials for level, trials, _, fell in state.points}
    assert shares[0.3] == 0.0
    assert shares[0.5] == pytest.approx(0.64, abs=0.02)
    for each in found.states[1:]:
        assert each.two_stage is not None
        assert each.two_stage.misfit < each.plain.misfit - 0.08
        assert each.gain is not None
        assert each.gain > 100.0  # a trial is a run, not also its mirror image
    gaps = [abs(share - float(two.probability(level))) for level, share in shares.items()]
    assert two.misfit == pytest.approx(max(gaps), abs=1e-6)
    assert two.misfit < 0.12
    assert state.plain.misfit > 0.2


BELOW_ALL = 0.98


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
@pytest.mark.parametrize(
    "block",
    [
        BLOCK,
        OTHER,
        BLOCK.against_wall(),
        Block.rectangle(width=0.4, height=1.6, gravity=3.71),
        Block.rectangle(width=0.4, height=1.6, gravity=50.0 * 9.80665),
    ],
)
def test_no_run_lifts_up_to_the_lowest_gate(block: Block, model: Linear | Nonlinear) -> None:
    band = RestitutionBand(draws=1)

    def lifted(at: float) -> float:
        levels = Levels("pga_g", [at], beside=())
        runs = run_ensemble(block, SUITE, levels=levels, restitution=band, model=model)
        assert lowest_gate(runs) == gate
        words = "given PGA > g tan alpha" if model == Nonlinear() else "given PGA > g alpha"
        assert condition_of(runs) == words
        return float((runs["peak_angle"] > 0.0).mean())

    levels = Levels("pga_g", [1.0], beside=())
    gate = lowest_gate(run_ensemble(block, SUITE, levels=levels, restitution=band, model=model))
    assert gate is not None
    assert lifted(BELOW_ALL * gate) == 0.0
    assert lifted(gate / BELOW_ALL) > 0.0


@pytest.mark.slow
def test_on_a_floor_or_with_vertical_motion_no_peak_of_the_ground_is_a_gate() -> None:
    gate = math.tan(BLOCK.alpha)
    floors = [floor_motion(each, frequencies_hz=2.0, shapes=1.4) for each in SUITE]
    both = [BaseMotion(each, SUITE[0].scaled(0.2)) for each in SUITE]
    for motions in (floors, both):
        for measure in ("pga_g", "pgv_m_s"):
            levels = Levels(measure, np.linspace(0.1, 1.0, 7))
            found = compute_fragility(
                BLOCK, motions, levels=levels, restitution=RestitutionBand(draws=1), fitting=PLAIN
            )
            runs = found.ensemble
            assert (lowest_gate(runs), condition_of(runs)) == (None, "given uplift")
            said = str(found.describe())
            assert "given uplift" in said
            assert "tan alpha" not in said
            assert "lower PGA" not in said
            assert LossComponent.from_fragility(found, "A").no_damage is None
            if found.surface is not None:
                along = LossComponent.from_fragility(found, "A", pgv_per_pga_s=0.1)
                assert along.no_damage is None
            if measure == "pga_g" and motions is floors:
                lifts = found.state("uplift").points
                assert any(count for level, _, count, *_ in lifts if level < gate)


def test_blocks_of_an_ensemble_keep_their_gravity_when_some_are_taken() -> None:
    """Of the Moon and of the Earth: each is fitted and exported as it is alone."""
    bodies = [Block.rectangle(width=0.4, height=1.6, gravity=each) for each in (1.62, 9.80665)]
    levels = Levels("pga_per_uplift", (0.5, 1.3, 1.8, 2.5, 4.0), beside=())
    together = run_ensemble(bodies, SUITE, levels=levels)
    for place, body in enumerate(bodies):
        alone = fit_fragility(run_ensemble(body, SUITE, levels=levels), fitting=PLAIN)
        taken = fit_fragility(together.isel(block=[place]), fitting=PLAIN)
        assert float(taken.ensemble["gravity"].item()) == body.gravity
        at = np.geomspace(0.02, 2.0, 9)
        one, two = (
            LossComponent.from_fragility(each, "block").states[-1].probability(at)
            for each in (taken, alone)
        )
        np.testing.assert_array_equal(one, two)
    joined = xarray.concat([together.isel(block=[place]) for place in (1, 0)], "block")
    assert fit_fragility(joined, fitting=PLAIN).states[-1].curve.median > 0.0
