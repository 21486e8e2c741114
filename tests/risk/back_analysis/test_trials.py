"""A few of the trials of the region, with few objects and short records."""

import numpy as np
import pytest

from rocksteady import Execution
from tests.risk.back_analysis.test_back_analyse import RECORDS
from tests.risk.back_analysis.trials import cemetery, report, run_trial, try_all

TRIALS = 30


@pytest.mark.slow
def test_the_truth_lies_in_most_regions() -> None:
    objects = cemetery(10)
    records = [record.scaled(1.0 + 0.1 * k) for k, record in enumerate(RECORDS * 2)]
    tried = try_all(objects, records, levels=12, draws=4, run=Execution())
    done = [
        run_trial(objects, records, tried, count=8, number=number, trials=3)
        for number in range(TRIALS)
    ]
    mixed = [trial for trial in done if trial.mixed]
    assert len(mixed) > TRIALS / 3
    # The chance of fewer than 70 % is 1 in 100 where the coverage is 90 %.
    assert np.mean([trial.covered for trial in mixed]) >= 0.7
    # Regions are no plane: shaking of five times the strength, or of a fifth where that was not
    # searched, is outside most of them.
    wrong = []
    for trial in mixed:
        wrongly = 5.0 if 5.0 * trial.pga_g <= trial.found.first_values[-1] else 0.2
        wrong.append(trial.found.contains(wrongly * trial.pga_g, wrongly * trial.pgv_m_s))
    assert np.mean(wrong) < 0.3
    assert "surveys: the truth lies in the region" in report(done, 8)
