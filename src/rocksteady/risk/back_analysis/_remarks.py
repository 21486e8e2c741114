"""Sentences on what makes a back-analysis doubtful."""

import numpy as np

from rocksteady.results.numbers import number, plural
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis

FEW_RECORDS = 20
FEW_EFFECTIVE = 3.0
NEAR_LIMIT = 0.05
"""Posterior probability near a limit from which on it is remarked on."""
ERROR = 0.05
"""Monte Carlo error of ln(median) from which on it is remarked on."""
EXTREME = 0.1
"""Share of the records with the lowest ratios, and of those with the highest."""


def remarks_on(result: BackAnalysis) -> tuple[str, ...]:
    """Return the sentences; none where nothing is doubtful."""
    remarks = []
    first, second = result.measures[:2]
    certain = result.bound == "interval"
    if result.bound == "upper bound":
        remarks.append(
            "Nothing fell: there is no lower bound, and above the upper one nothing falls with a "
            "chance below 0.1, the mean over the suite."
        )
    if result.bound == "lower bound":
        remarks.append(
            "Everything fell: there is no upper bound, and below the lower one everything falls "
            "with a chance below 0.1, the mean over the suite."
        )
    if len(result.records) < FEW_RECORDS:
        remarks.append(
            f"{plural(len(result.records), 'record')}: fewer than {FEW_RECORDS} show little of how "
            "shakings of one strength differ."
        )
    if result.effective_records < FEW_EFFECTIVE:
        remarks.append(
            f"{number(result.effective_records)} records carry the result: the others agree with "
            "the survey at no scale."
        )
    low, high = result.limits
    at_nodes = result.weights.sum(axis=0)
    ends = max(1, len(at_nodes) // 20)
    for where, value, near in (("lower", low, at_nodes[:ends]), ("upper", high, at_nodes[-ends:])):
        if certain and near.sum() > NEAR_LIMIT:
            remarks.append(
                f"The result reaches the {where} limit of {first.label}, {number(value)} "
                f"{first.unit}: set other limits."
            )
    ratios = result.values_at_one[:, 1] / result.values_at_one[:, 0]
    few = max(1, round(EXTREME * len(ratios)))
    order = np.argsort(ratios, kind="stable")
    for word, places in (("lowest", order[:few]), ("highest", order[-few:])):
        if result.record_weights[places].sum() > 0.5 > few / len(ratios):
            remarks.append(
                f"Records of the {word} {second.label}/{first.label} carry more than half of the "
                "result: the suite may lack shakings that agree better."
            )
    worst = float(np.max(np.nan_to_num(result.mc_errors)))
    if worst > ERROR:
        remarks.append(
            f"The Monte Carlo error of the result is {number(100.0 * worst)} %: use more draws."
        )
    if certain and not result.held_out_surveys:
        remarks.append("No record was left out: what the region covers was not checked.")
    return tuple(remarks)
