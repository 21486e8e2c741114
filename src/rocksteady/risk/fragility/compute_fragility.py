"""Fragility from an ensemble of runs, and from blocks and records at once."""

import json
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import FRICTION
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import number
from rocksteady.risk.counted.count import counts_of, outcomes_of, without_mirrors
from rocksteady.risk.counted.curve import Curve
from rocksteady.risk.counted.motions import across, distinct, has_vertical
from rocksteady.risk.counted.reach import MOST_WITHOUT, RATIO, reaching_levels
from rocksteady.risk.counted.sliding import friction_at, sliding_level
from rocksteady.risk.counted.suite import PGA
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.runs import run_ensemble
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.risk.fits.fragility_curve import fit_curve
from rocksteady.risk.fragility.damage_states import DEFAULT_STATES, DamageState, exceeding, state_of
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from rocksteady.seismic.spectra.grounds import grounds_of
from rocksteady.seismic.spectra.many import DIRECTIONS, blocks_of, chosen
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

States = Sequence[DamageState | float | str]


@checked
def count_fragility(ensemble: "xarray.Dataset", *, states: States = DEFAULT_STATES) -> Fragility:
    """Count the runs of an ensemble that reach each damage state at each level.

    Parameters
    ----------
    ensemble
        From `run_ensemble`.
    states
        Damage states, each a `DamageState`, the name of one, or a number for a theta/alpha that is
        exceeded; by default uplift, 0.25, 0.5, 1 and overturned.

    Returns
    -------
    Fragility
        Over the levels of the ensemble, up to the last of which less than 1 % of the runs have no
        answer.

    Raises
    ------
    InputError
        If it is no ensemble, no level has an answer, or a state comes twice.

    Examples
    --------
    >>> from rocksteady import Block, Record, run_ensemble
    >>> from rocksteady.risk import Levels, RestitutionBand, count_fragility
    >>> cabinet = Block.rectangle(width=0.4, height=1.6)
    >>> suite = [Record(acceleration_m_s2=[0.0, 1.0, -1.0, 0.0], dt_s=dt) for dt in (0.1, 0.3)]
    >>> levels = Levels("pga_g", [0.2, 0.5, 2.0], beside=())
    >>> runs = run_ensemble(cabinet, suite, levels=levels, restitution=RestitutionBand(draws=1))
    >>> count_fragility(runs, states=["overturned"]).states[0].curve.shares.tolist()
    [0.0, 0.5, 0.5]
    """
    began = time.perf_counter()
    if ensemble.attrs.get("kind") != "rocking ensemble":
        raise InputError(
            "ensemble",
            Words("is no ensemble"),
            "it must come from run_ensemble",
            "give run_ensemble(blocks, motions, levels=...)",
        )
    asked = damage_states(states)
    ensemble = ensemble.sortby("level")
    status, peaks, answered = outcomes_of(ensemble)
    kept = _levels_with_answers(answered)
    levels = ensemble["level"].values.astype(np.float64)[:kept]
    measure, lifts_at = _measure_of(ensemble), _lifts_at(ensemble)
    warnings = list(json.loads(ensemble.attrs["warnings"]))
    if kept < answered.shape[2]:
        warnings.append(
            f"The levels end at {number(float(levels[-1]))}: above it more than "
            f"{MOST_WITHOUT:.0%} of the runs have no answer."
        )
    shares = []
    for state in asked:
        counts = counts_of(exceeding(state, status, peaks), answered)[:kept]
        lognormal = fit_curve(
            levels,
            [each.falls for each in counts],
            [each.runs for each in counts],
            measure=("factor", "") if measure is None else (measure.label, measure.unit),
        )
        curve = Curve(levels=levels, counts=counts, lifts_at=lifts_at)
        shares.append(
            StateFragility(state=state, measure=measure, curve=curve, lognormal=lognormal)
        )
    return Fragility(
        ensemble=ensemble.isel(level=slice(0, kept)),
        measure=measure,
        states=tuple(shares),
        warnings=tuple(warnings),
        records=ensemble.sizes["record"],
        runs=int(answered.shape[0] * answered.shape[1] * kept),
        seconds=time.perf_counter() - began,
    )


@checked
def compute_fragility(
    blocks: Block | Sequence[Block],
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    levels: Levels | None = None,
    restitution: RestitutionBand | None = None,
    ways: Ways | None = None,
    friction: Annotated[float | None, FRICTION] = None,
    states: States = DEFAULT_STATES,
    run: Execution | None = None,
) -> Fragility:
    """Compute the fragility of blocks: run every record at every level, and count.

    Runs are of the full equations; `run_ensemble` and `count_fragility` do the two by themselves.

    Parameters
    ----------
    blocks, motions, restitution, ways, run
        As for `run_ensemble`; several blocks are pooled.
    levels
        The measure, and levels of it; by default levels that reach from where nothing lifts to
        where 95 % of the runs fall.
    friction
        Coefficient of friction, with which the levels end where a block would slide; None (default)
        where it is not known.
    states
        As for `count_fragility`.

    Returns
    -------
    Fragility
        Counted shares of all damage states, with the runs.

    Raises
    ------
    InputError, ModelError
        As for the two functions, and if a block slides before it lifts.

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import Block, Record, compute_fragility
    >>> from rocksteady.risk import Levels, RestitutionBand
    >>> t = 0.02 * np.arange(100)
    >>> suite = [Record(acceleration_m_s2=np.sin(f * t), dt_s=0.02) for f in (4, 6, 9, 12)]
    >>> fragility = compute_fragility(
    ...     Block.rectangle(width=0.4, height=1.6),
    ...     suite,
    ...     levels=Levels("pga_g", [0.2, 0.3, 0.6, 1.2], beside=()),
    ...     restitution=RestitutionBand(draws=1),
    ... )
    >>> fragility.state("uplift").curve.lifts_at.round(6).tolist()
    [0.25, 0.25, 0.25, 0.25]
    """
    damage_states(states)  # refused before anything runs
    planned = plan_fragility(
        blocks, motions, levels=levels, restitution=restitution, ways=ways, friction=friction
    )
    return planned.count(states, run=run)


def plan_fragility(
    blocks: Block | Sequence[Block],
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    levels: Levels | None = None,
    restitution: RestitutionBand | None = None,
    ways: Ways | None = None,
    friction: float | None = None,
) -> "PlannedFragility":
    """Return the runs of a fragility with the levels that they reach; as `compute_fragility`."""
    began = time.perf_counter()
    bodies, asked = blocks_of(blocks), Levels() if levels is None else levels
    several = [motions] if isinstance(motions, Record | BaseMotion) else list(motions)
    grounds_of(several)  # refused where one is no record
    kept = distinct(several)
    places = {id(each) for each in kept}
    most = np.inf
    if friction is not None:
        ones = asked.at_scale_one([across(each) for each in kept], bodies)
        most = sliding_level(bodies, kept, ones, friction)
    reached = reaching_levels(asked, bodies, kept, restitution=restitution, ways=ways, most=most)
    rocking = [level for level in reached.values if level <= most]
    if not rocking:
        raise ModelError(
            "friction",
            friction,
            f"it slides at all levels: above {number(most)} rocking takes more",
            "give lower levels or a higher friction",
        )
    return PlannedFragility(
        blocks=bodies,
        motions=kept,
        levels=replace(reached, levels=rocking),
        restitution=RestitutionBand() if restitution is None else restitution,
        ways=Ways() if ways is None else ways,
        friction=friction,
        slides_above=most if most < max(reached.values) * RATIO else None,
        began=began,
        copies=[across(each).name or "a record" for each in several if id(each) not in places],
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class PlannedFragility:
    """Runs of a fragility before they are computed.

    Attributes
    ----------
    blocks, motions, restitution, ways, friction
        As for `compute_fragility`.
    levels
        Levels that reach, without those at which a block slides.
    slides_above
        Level above which a block slides, where the levels end before it; else None.
    began
        When the search for the levels began, on the clock of `time.perf_counter`.
    copies
        Names of motions that are left out, with the samples of another.
    """

    blocks: Sequence[Block]
    motions: Sequence[Record | BaseMotion]
    levels: Levels
    restitution: RestitutionBand
    ways: Ways
    friction: float | None
    slides_above: float | None
    began: float
    copies: Sequence[str]

    @property
    def cells(self) -> int:
        """How many runs are computed; mirror images are not."""
        signs = len(chosen(self.ways.reverse, DIRECTIONS))
        if all(block.symmetric for block in self.blocks):
            signs = 1
        lifted = sum(map(has_vertical, self.motions))
        grounds = len(self.motions) + lifted * (self.ways.vertical == "both")
        levels = len(self.levels.values)
        return len(self.blocks) * grounds * signs * levels * self.restitution.draws

    def count(
        self,
        states: States = DEFAULT_STATES,
        *,
        mass_kg: float | None = None,
        run: Execution | None = None,
    ) -> Fragility:
        """Run them, and count; `mass_kg` is that of `run_ensemble`."""
        ensemble = run_ensemble(
            self.blocks,
            self.motions,
            levels=self.levels,
            restitution=self.restitution,
            ways=self.ways,
            mass_kg=mass_kg,
            run=run,
        )
        fragility = count_fragility(ensemble, states=states)
        warnings = list(fragility.warnings)
        if self.copies:
            names = ", ".join(self.copies)
            warnings.insert(0, f"Left out, with the samples of other records: {names}.")
        if self.slides_above is not None:
            warnings.append(
                f"Above {number(self.slides_above)} it slides under the strongest record: no share."
            )
        return replace(
            fragility,
            friction=self.friction,
            friction_needed=self._friction_needed(fragility),
            slides_above=self.slides_above,
            warnings=tuple(warnings),
            seconds=time.perf_counter() - self.began,
        )

    def _friction_needed(self, fragility: Fragility) -> float:
        """Return the friction at the level where half reach the last state, or at the last one."""
        levels, half = fragility.ensemble["level"].values, fragility.states[-1].half
        last = len(levels) - 1
        place = min(int(np.searchsorted(levels, half[0])), last) if half else last
        scale = fragility.ensemble["scale"].isel(level=place).transpose("block", "record").values
        peaks = np.array([compute_measure(across(each), PGA) for each in self.motions])
        return friction_at(self.blocks, (scale * peaks).ravel()).largest


def damage_states(states: States) -> tuple[DamageState, ...]:
    """Return damage states, each containing the next.

    Raises
    ------
    InputError
        If there is none, or one comes twice.
    """
    asked = sorted((state_of(state) for state in states), key=lambda state: state.rank)
    names = [state.name for state in asked]
    twice = next((name for name in names if names.count(name) > 1), None)
    if not asked or twice is not None:
        raise InputError(
            "states",
            twice,
            "there is one damage state or more, each once",
            "give states, as ['uplift', 0.5, 'overturned']",
        )
    return tuple(asked)


def _levels_with_answers(answered: NDArray[np.bool_]) -> int:
    """Return how many levels come before one at which too many runs have no answer."""
    without = 1.0 - answered.mean(axis=(0, 1))
    bad = np.flatnonzero(without > MOST_WITHOUT)
    kept = int(bad[0]) if len(bad) else answered.shape[2]
    if not kept:
        raise InputError(
            "ensemble",
            Words(f"has {without[0]:.1%} of its runs without an answer at its lowest level"),
            f"a share is of runs of which at most {MOST_WITHOUT:.0%} have none",
            "take lower levels, or leave the vertical components out",
        )
    return kept


def _measure_of(ensemble: "xarray.Dataset") -> Measure | None:
    """Return the measure of the levels; None of plain factors."""
    values = ensemble.coords.get(f"im_{ensemble.attrs['measure']}")
    return (
        None if values is None else Measure(values.attrs["measure"], values.attrs.get("period_s"))
    )


def _lifts_at(ensemble: "xarray.Dataset") -> Floats:
    """Return the level above which each run lifts, sorted."""
    levels = ensemble["level"].values.astype(np.float64)
    scale = ensemble["scale"].transpose("block", "record", "level").values
    per_scale = levels[0] / scale[:, :, 0]
    scales = without_mirrors(ensemble)["uplift_scale"]
    at = scales.transpose("block", "record", "direction", "vertical").values
    return np.sort((at * per_scale[:, :, np.newaxis, np.newaxis]).ravel())
