"""Failure against several intensities at once: which of them explain most of it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import positive
from rocksteady.results.description import Description, Fact
from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.results.numbers import number, number_or_none, plural
from rocksteady.results.result import Result
from rocksteady.results.words import Label, facts_of
from rocksteady.risk.fits._likelihood import family_of, log_likelihood_of, maximise
from rocksteady.risk.fits._status import ALWAYS, FITTED, NEVER, SEPARATED
from rocksteady.risk.fits._trial_counts import counts_of, values_of
from rocksteady.risk.fits._values import LOG_LIKELIHOOD, intensities

FEW_POINTS = 500
"""How many points are tested for overlap before all are."""
LEAST_INDEPENDENCE = 1e-8
"""Smallest over largest singular value of the standardised ln im of independent intensities."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class VectorCurve(Result):
    """Hold a probit fit in several intensities, from `rocksteady.risk.fit_vector`.

    P = Phi(c_0 + c_1 ln im_1 + c_2 ln im_2 + ...).

    Attributes
    ----------
    names
        Names of the intensities.
    status
        "fitted"; "separated": a plane in ln im parts failures from survivals; "never" and "always":
        without a failure, without a survival.
    coefficients
        c_0, c_1, ...; NaN unless fitted.
    log_likelihood
        Log-likelihood of single trials; of separated ones its supremum, 0 unless points lie on the
        plane.
    explained
        Share of the deviance of a constant probability that the intensities explain; NaN without
        a failure or without a survival.
    trials, failures, records
        Their numbers.
    """

    names: tuple[str, ...]
    status: Annotated[str, Label()]
    coefficients: Annotated[NDArray[np.float64], Label("predictor", plain=number_or_none)]
    log_likelihood: Annotated[float, LOG_LIKELIHOOD]
    explained: Annotated[float, Label("share of the deviance explained", plain=number_or_none)]
    trials: Annotated[int, Label()]
    failures: Annotated[int, Label()]
    records: Annotated[int, Label()]

    @property
    def aic(self) -> Annotated[float, Label("Akaike's criterion")]:
        """Akaike's criterion, 2 q - 2 ln L, with q coefficients, that of the constant included."""
        return 2.0 * len(self.coefficients) - 2.0 * self.log_likelihood

    @property
    def log_likelihood_per_trial(self) -> float:
        """The log-likelihood over the number of trials."""
        return self.log_likelihood / self.trials

    def probability(self, intensity: ArrayLike) -> Floats:
        """Return the probability of failure at points of all intensities.

        Parameters
        ----------
        intensity
            0 or above, one column for each name: shape (..., k).

        Returns
        -------
        ndarray
            Shape (...); NaN unless fitted.

        Raises
        ------
        InputError
            If an intensity is negative or NaN, or there are not k.
        """
        at = intensities(intensity)
        if at.ndim == 0 or at.shape[-1] != len(self.names):
            problem = Words(f"has the shape {at.shape}")
            valid = f"its last axis must have the {len(self.names)} intensities"
            raise InputError("intensity", problem, valid, "give a column for each")
        tiny = np.finfo(np.float64).tiny  # ln 0 times a coefficient of 0 would be NaN
        logs = np.log(np.clip(at, tiny, np.finfo(np.float64).max))
        eta = self.coefficients[0] + logs @ self.coefficients[1:]
        return np.asarray(family_of("lognormal").cdf(eta))

    def along(self, ratio: float) -> tuple[float, float]:
        """Return the lognormal of the second intensity where it is a ratio of the first.

        P = Phi(ln(im_2/median)/beta) with beta = 1/(c_1 + c_2), as im_1 = im_2/ratio.

        Parameters
        ----------
        ratio
            im_2/im_1, above 0, in their units.

        Returns
        -------
        tuple of float
            Median and beta; both NaN unless fitted, or if the probability does not rise.

        Raises
        ------
        InputError
            If the ratio is not above 0, or there are not two intensities.

        Examples
        --------
        >>> from rocksteady.risk import fit_vector
        >>> pairs = [[0.2, 0.3], [0.4, 0.2], [0.4, 0.8], [0.8, 0.5], [1.6, 1.1]]
        >>> fit = fit_vector(pairs, [2, 5, 22, 21, 38], [40] * 5, names=("PGA", "PGV"))
        >>> median, beta = fit.along(0.8)
        >>> print(f"{median:.3f} {beta:.3f} {fit.probability([median / 0.8, median]):.3f}")
        0.506 0.544 0.500
        """
        of_first = positive("ratio", ratio, hint="give the second intensity over the first")
        if len(self.names) != 2:
            problem = Words(f"are {len(self.names)}")
            raise InputError("names", problem, "two intensities have a ratio", "fit two")
        constant, first, second = self.coefficients.tolist()
        if not first + second > 0.0:
            return math.nan, math.nan
        beta = 1.0 / (first + second)
        return math.exp(beta * (first * math.log(of_first) - constant)), beta

    @property
    def _answer(self) -> str:
        """What the intensities explain, in words."""
        if self.status != FITTED:
            return NOT_IDENTIFIED
        return f"{number(100.0 * self.explained)} % of the deviance explained"

    def describe(self) -> Description:
        """Return the coefficients and how much they explain."""
        powers = dict(zip(self.names, self.coefficients[1:].tolist(), strict=True))
        parts = (f"{number(power)} ln({name})" for name, power in powers.items())
        words = ", ".join([number(self.coefficients[0]), *parts])
        if self.status != FITTED:
            words = NOT_IDENTIFIED
        facts = facts_of(
            self,
            Fact("measures", list(self.names), "intensities"),
            "status coefficients log_likelihood aic explained trials failures records",
            coefficients=words,
        )
        return Description(
            headline=f"{' and '.join(self.names)}: {self._answer}, "
            f"{plural(self.records, 'record')}, {self.status}",
            facts=facts,
        )


@checked
def fit_vector(
    intensity: ArrayLike,
    failures: ArrayLike,
    trials: ArrayLike | None = None,
    *,
    groups: ArrayLike | Sequence[str] | None = None,
    names: Sequence[str] | None = None,
) -> VectorCurve:
    """Fit the probability of failure to several intensities by maximum likelihood.

    A probit regression in the logarithms; with one intensity it is the lognormal curve of
    `rocksteady.risk.fit_curve`.

    Parameters
    ----------
    intensity
        Above 0, shape (n, k): k intensities of each observation.
    failures
        Their number in each observation, shape (n,).
    trials
        Their number in each observation, shape (n,); default 1 each.
    groups
        Record of each observation, to be counted; default: each trial is a record of its own.
    names
        Names of the k intensities; default "intensity 1" and so on.

    Returns
    -------
    VectorCurve
        Its status marks data without a maximum.

    Raises
    ------
    InputError
        As for `rocksteady.risk.fit_curve`, and if the logarithms of the intensities depend
        linearly on each other, as those of PGA, PGV and PGV/PGA do.

    Examples
    --------
    >>> from rocksteady.risk import fit_vector
    >>> pairs = [[0.2, 0.3], [0.4, 0.2], [0.4, 0.8], [0.8, 0.5], [1.6, 1.1]]
    >>> fit = fit_vector(pairs, [2, 5, 22, 21, 38], [40] * 5, names=("PGA", "PGV"))
    >>> fit.status, fit.coefficients.round(2).tolist()
    ('fitted', [1.06, 0.85, 0.99])
    """
    at = np.asarray(intensity, dtype=np.float64)
    if at.ndim != 2 or 0 in at.shape:
        problem = Words(f"has the shape {at.shape}")
        raise InputError("intensity", problem, "it must be (n, k)", "give a column for each")
    width = at.shape[1]
    for place in np.flatnonzero(~((at > 0.0) & np.isfinite(at)).all(axis=1))[:1]:
        values_of(f"intensity[{place}]", at[place], positive=True)
    given_names = [f"intensity {k + 1}" for k in range(width)] if names is None else list(names)
    if len(given_names) != width:
        problem = Words(f"has {len(given_names)} names")
        raise InputError("names", problem, f"it must have {width}", "name each column")
    # Rows stand in for the levels of one intensity: the same checks of the counts, the same sums.
    rows, place_of = np.unique(at, axis=0, return_inverse=True)
    row_number = place_of.ravel().astype(np.float64) + 1.0
    (counts,) = counts_of(row_number, (("trials", trials), ("failures", failures)), groups)
    rows = rows[counts.levels.astype(np.intp) - 1]
    totals = counts.totals
    status, coefficients, log_likelihood = _fitted(np.log(rows), *totals)
    failed, tried = (float(total.sum()) for total in totals)
    flat = _flat(failed, tried)
    return VectorCurve(
        names=tuple(given_names),
        status=status,
        coefficients=coefficients,
        log_likelihood=log_likelihood,
        explained=1.0 - log_likelihood / flat if flat < 0.0 else math.nan,
        trials=int(tried),
        failures=int(failed),
        records=counts.records,
    )


def _flat(failures: float, trials: float) -> float:
    """Return the log-likelihood of a constant probability."""
    from scipy.special import xlog1py, xlogy

    share = failures / trials
    return float(xlogy(failures, share) + xlog1py(trials - failures, -share))


def _fitted(logs: Floats, failures: Floats, trials: Floats) -> tuple[str, Floats, float]:
    """Return the status, the coefficients and the log-likelihood."""
    family = family_of("lognormal")
    none = np.full(logs.shape[1] + 1, math.nan)
    total, failed = trials.sum(), failures.sum()
    if failed in (0.0, total):
        return NEVER if failed == 0.0 else ALWAYS, none, 0.0
    centre = trials @ logs / total
    scale = np.sqrt(trials @ np.square(logs - centre) / total)
    z = (logs - centre) / np.where(scale > 0.0, scale, 1.0)
    design = np.column_stack([np.ones(len(z)), z])
    singular = np.linalg.svd(design * np.sqrt(trials)[:, None], compute_uv=False)
    if len(singular) < design.shape[1] or singular[-1] < LEAST_INDEPENDENCE * singular[0]:
        valid = "the logarithms of its columns must not depend linearly on each other"
        problem = Words("has columns that repeat each other")
        raise InputError("intensity", problem, valid, "leave one of them out")
    parted = _parted(design, failures, trials)
    if parted.any():
        rest = ~parted
        # What lies on the plane keeps the largest likelihood that its own points allow.
        _, size, rows = np.linalg.svd(design[rest], full_matrices=False)
        basis = rows[size > LEAST_INDEPENDENCE * singular[0]].T
        kept = _largest(design[rest] @ basis, failures[rest], trials[rest]) if rest.any() else 0.0
        return SEPARATED, none, kept
    start = np.zeros(design.shape[1])
    start[0] = family.quantile(np.array(failed / total))
    at = maximise(family, design, failures, trials, start)
    log_likelihood = log_likelihood_of(family, design @ at, failures, trials)
    slopes = at[1:] / scale
    return FITTED, np.concatenate([[at[0] - slopes @ centre], slopes]), log_likelihood


def _largest(design: Floats, failures: Floats, trials: Floats) -> float:
    """Return the largest log-likelihood of points that overlap."""
    family = family_of("lognormal")
    at = maximise(family, design, failures, trials, np.zeros(design.shape[1]))
    return log_likelihood_of(family, design @ at, failures, trials)


def _parted(design: Floats, failures: Floats, trials: Floats) -> NDArray[np.bool_]:
    """Return which points a plane parts; none of data that overlap.

    Data are separated where a plane has all failures on one side and all survivals on the other,
    points on the plane aside [1].  The linear program finds the plane that leaves fewest on it: the
    sum of min(distance, 1), each distance on the right side and in a free unit.

    References
    ----------
    .. [1] A. Albert and J. A. Anderson, Biometrika 71, 1-10 (1984).
    """
    from scipy.optimize import linprog
    from scipy.sparse import csr_array, eye_array, hstack

    parted = np.zeros(len(design), dtype=np.bool_)
    few = np.arange(0, len(design), len(design) // FEW_POINTS + 1)
    fewer = len(few) < len(design) and np.linalg.matrix_rank(design[few]) == design.shape[1]
    if fewer and not _parted(design[few], failures[few], trials[few]).any():
        return parted  # what overlaps does so with more points too
    failed, stood = np.flatnonzero(failures > 0.0), np.flatnonzero(failures < trials)
    sides = np.concatenate([design[failed], -design[stood]])
    count, width = sides.shape
    result = linprog(
        np.concatenate([np.zeros(width), -np.ones(count)]),
        A_ub=hstack([csr_array(-sides), eye_array(count)], format="csr"),
        b_ub=np.zeros(count),
        bounds=[(None, None)] * width + [(0.0, 1.0)] * count,
        method="highs",
    )
    if result.x is not None:
        away = result.x[width:] > 0.5
        parted[np.concatenate([failed, stood])[away]] = True
        # A point with failures and survivals has both sides and lies on the plane.
        parted[(failures > 0.0) & (failures < trials)] = False
    return parted
