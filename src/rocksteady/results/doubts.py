"""Words and thresholds of estimates that do not exist, or rest on too little.

Fits, posteriors and intervals of the package take their rules from here;
``docs/reference/files/results.md`` lists them.
"""

from typing import Final

NOT_IDENTIFIED: Final = "not identified"
"""Word in place of an estimate that the data do not determine."""
TOO_FEW: Final = "too few"
"""Word in place of an estimate or an interval of too small a sample."""
FEWEST_DRAWS: Final = 50.0
"""Effective draws of a posterior, below which no interval of it is stated."""
ENOUGH_DRAWS: Final = 100.0
"""Effective draws from which on a fold is predicted by reweighted draws."""
ANSWER_DRAWS: Final = 200.0
"""Effective draws below which a calibration has no answer: of so many, ten lie beyond the 95 %
quantile."""
FEWEST_GROUPS: Final = 2
"""Groups of tests below which a score has no interval."""
FEWEST_BOXES: Final = 20
"""Boxes on a boundary below which their mean entropy decides nothing."""
FEWEST_SIZES: Final = 3
"""Points of a fitted line, below which it has no error, and so no slope is stated."""
