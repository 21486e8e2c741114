"""Fragility curves of an ensemble, for each damage state, and of blocks and records at once."""

import json
import re
import time
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import plural
from rocksteady.risk.ensemble.contact_levels import levels_in_contact, words_of_shorter
from rocksteady.risk.ensemble.gates import lowest_gate, uplift_of, which_lift
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.runs import run_ensemble
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.risk.fits.fragility_curve import fit_curve
from rocksteady.risk.fits.two_stages import fit_two_stages
from rocksteady.risk.fits.vector_fit import VectorCurve, fit_vector
from rocksteady.risk.fragility._labels_of_runs import (
    Labels,
    kept_measures,
    labels_of,
    measure_of,
)
from rocksteady.risk.fragility._ranking import rank_measures
from rocksteady.risk.fragility.damage_states import UPLIFT, DamageState
from rocksteady.risk.fragility.fitting import FitOptions
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.seismic.measures.scalar import Measure
from rocksteady.seismic.spectra.many import blocks_of
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

PEAKS = (Measure("pga_g"), Measure("pgv_m_s"))
"""Measures of the surface."""
STAGE = "^(uplift|failure given uplift): "
"""What a sentence on one of two stages begins with."""


@checked
def fit_fragility(ensemble: "xarray.Dataset", *, fitting: FitOptions | None = None) -> Fragility:
    """Fit fragility curves to an ensemble of runs.

    Every run is a trial, and every record a group: runs of one record depend on each other, so
    that the bands draw records.  Labels enter as they are, in any order of the levels.

    Parameters
    ----------
    ensemble
        From `run_ensemble`.
    fitting
        Damage states, family, bands and measures; default `FitOptions()`.

    Returns
    -------
    Fragility
        Over the measure of the levels; of plain factors over PGV.  Over PGV the curves are of the
        runs that lift, of PGA > g tan alpha.

    Raises
    ------
    InputError
        If it is no ensemble, more than 1 % of its runs have no answer, or it does not hold a
        measure.

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import Block, Record, run_ensemble
    >>> from rocksteady.risk import FitOptions, Levels, RestitutionBand, fit_fragility
    >>> t = 0.02 * np.arange(100)
    >>> suite = [
    ...     Record(acceleration_m_s2=np.sin(f * t), dt_s=0.02, name=f"{f} rad/s")
    ...     for f in (4, 6, 9, 12)
    ... ]
    >>> levels = Levels("pgv_m_s", [0.8, 1.2, 1.6, 2.0], beside=())
    >>> block = Block.rectangle(width=0.4, height=1.6)
    >>> runs = run_ensemble(block, suite, levels=levels, restitution=RestitutionBand(draws=1))
    >>> fragility = fit_fragility(runs, fitting=FitOptions(states=["overturned"], bands=None))
    >>> print(f"{fragility.state('overturned').curve.median:.2f}")
    1.55
    """
    began = time.perf_counter()
    options = FitOptions() if fitting is None else fitting
    labels = labels_of(ensemble)
    measure = measure_of(ensemble)
    states = tuple(_fitted(labels, measure, state, options) for state in options.damage_states)
    compared = kept_measures(ensemble) if options.measures is None else options.measures
    return Fragility(
        ensemble=ensemble,
        measure=measure,
        states=states,
        surface=_surface(labels, options.damage_states[-1]),
        ranking=rank_measures(labels, compared, options.damage_states[-1], options.family),
        fitting=options,
        warnings=_warnings(labels, states),
        records=ensemble.sizes["record"],
        runs=int(ensemble.attrs["runs"]),
        scale_factor_max=float(ensemble["scale"].max()),
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
    mass_kg: float | Sequence[float] | None = None,
    fitting: FitOptions | None = None,
    run: Execution | None = None,
) -> Fragility:
    """Compute the fragility of blocks: run the ensemble, fit the curves.

    Runs are of the full equations; `run_ensemble` and `fit_fragility` do the two by themselves.

    Parameters
    ----------
    blocks, motions, levels, restitution, ways, mass_kg, run
        As for `run_ensemble`; several blocks are pooled.  Default levels end where the vertical
        motion of more than 1 % of the runs would leave them without an answer.
    fitting
        As for `fit_fragility`.

    Returns
    -------
    Fragility
        Curves of all damage states, with the runs.

    Raises
    ------
    InputError
        As for the two functions.

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import Block, Record, compute_fragility
    >>> from rocksteady.risk import FitOptions, Levels, RestitutionBand
    >>> t = 0.02 * np.arange(100)
    >>> suite = [Record(acceleration_m_s2=np.sin(f * t), dt_s=0.02) for f in (4, 6, 9, 12)]
    >>> fragility = compute_fragility(
    ...     Block.rectangle(width=0.4, height=1.6),
    ...     suite,
    ...     levels=Levels("pga_g", [0.2, 0.3, 0.6, 1.2], beside=()),
    ...     restitution=RestitutionBand(draws=1),
    ...     fitting=FitOptions(states=["uplift"], bands=None),
    ... )
    >>> fragility.state("uplift").plain.status, fragility.state("uplift").plain.step
    ('separated', (0.25, 0.25))
    """
    began = time.perf_counter()
    bodies, asked = blocks_of(blocks), Levels() if levels is None else levels
    ensemble = run_ensemble(
        bodies,
        motions,
        levels=levels_in_contact(asked, bodies, motions, ways=ways),
        restitution=restitution,
        ways=ways,
        mass_kg=mass_kg,
        run=run,
    )
    fragility = fit_fragility(ensemble, fitting=fitting)
    shorter = words_of_shorter(asked, bodies, float(ensemble["level"].values[-1]))
    return replace(
        fragility,
        warnings=(*shorter, *fragility.warnings),
        seconds=time.perf_counter() - began,
    )


def _fitted(
    labels: Labels, measure: Measure, state: DamageState, options: FitOptions
) -> StateFragility:
    """Return the fragility of a damage state."""
    intensity, trials = labels.intensity(measure), labels.trials
    lifted, failures = labels.count(DamageState(UPLIFT)), labels.count(state)
    at, counts = intensity.ravel(), trials.ravel()
    named = (measure.label, measure.unit)
    groups = labels.groups.ravel()
    uplifted = uplift_of(
        labels.ensemble, measure, intensity=at, lifted=lifted.ravel(), trials=counts
    )
    some = 0 < lifted.sum() < trials.sum()
    known = isinstance(uplifted, float) and lifted.any()  # it may lie below the lowest level
    of_uplift, two_stage = state.name == UPLIFT, None
    if known or (some and not of_uplift):
        two_stage = fit_two_stages(
            at,
            uplifted,
            failures.ravel(),
            counts,
            family=options.family,
            groups=groups,
            bands=options.bands,
            measure=named,
        )
        plain = two_stage.uplift if of_uplift else two_stage.plain
    else:
        plain = fit_curve(
            at,
            failures.ravel(),
            counts,
            family=options.family,
            groups=groups,
            bands=options.bands,
            measure=named,
        )
    fitted = StateFragility(
        state=state,
        plain=plain,
        two_stage=None if of_uplift else two_stage,
        given_uplift=measure.given_uplift and not of_uplift,
    )
    points: list[tuple[float, int, int | None, int]] = []
    if labels.ensemble.attrs["measure"] == measure.key:
        for place, level in enumerate(labels.ensemble["level"].values.tolist()):
            sums = (int(each[:, :, place].sum()) for each in (trials, lifted, failures))
            points.append((level, *sums))
    else:
        points += [(level, count, None, fell) for level, count, fell, _ in fitted.curve.stripes]
    return replace(fitted, points=tuple(points))


def _surface(labels: Labels, state: DamageState) -> VectorCurve | None:
    """Return the probability over PGA and PGV of the runs that lift; None where there is none."""
    kept = {labels.ensemble.attrs["measure"], *(x.key for x in kept_measures(labels.ensemble))}
    lifted = labels.count(DamageState(UPLIFT))
    some = lifted > 0
    if state.name == UPLIFT or not some.any() or not kept.issuperset(each.key for each in PEAKS):
        return None
    try:
        return fit_vector(
            _peaks(labels)[some],
            labels.count(state)[some],
            lifted[some],
            groups=labels.groups[some],
            names=[each.label for each in PEAKS],
        )
    except InputError:  # records of one shape: PGA and PGV depend on each other
        return None


def _peaks(labels: Labels) -> Floats:
    """Return PGA and PGV, shape (blocks, records, levels, 2)."""
    return np.stack([labels.intensity(each) for each in PEAKS], axis=-1)


def peaks_and_shares(fragility: Fragility) -> tuple[Floats, Floats]:
    """Return PGA and PGV of each record and level with runs that lift, and how many of them fail.

    Shapes (n, 2) and (n,), of the last damage state; the ensemble must hold both measures.
    """
    labels = labels_of(fragility.ensemble)
    lifted = labels.count(DamageState(UPLIFT))
    some = lifted > 0
    return _peaks(labels)[some], labels.count(fragility.states[-1].state)[some] / lifted[some]


def _warnings(labels: Labels, states: Sequence[StateFragility]) -> tuple[str, ...]:
    """Return what limits the answer: of the runs, then of the curves, each sentence once."""
    warnings = list(json.loads(labels.ensemble.attrs["warnings"]))
    if labels.without:
        warnings.append(f"{labels.without:,} runs without an answer are left out of the fits")
    records = re.compile(rf"\b{plural(labels.ensemble.sizes['record'], 'record')}\b")
    for each in states:
        for sentence in (*each.plain.warnings, *each.curve.warnings):
            # Of the number of records there is one sentence for all curves and stages.
            common = records.search(sentence) is not None
            text = re.sub(STAGE, "", sentence) if common else f"{each.state.name}: {sentence}"
            warnings.append(text)
    single = [each.state.name for each in states if each.two_stage and each.curve is each.plain]
    if any(each.given_uplift for each in states):
        below = ": at a lower PGA the probability is 0" if lowest_gate(labels.ensemble) else ""
        warnings.append(f"The curves are of the runs {which_lift(labels.ensemble)}{below}.")
    if single:
        warnings.append(
            f"{', '.join(single)}: one curve, as two stages, uplift and failure given uplift, are "
            "no more likely (gain not above 0)"
        )
    return tuple(dict.fromkeys(warnings))
