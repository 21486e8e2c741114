"""Base motions as results: summary, rows, picture and HTML of each."""

from typing import TYPE_CHECKING

from rocksteady.errors import with_call_errors
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd


class DescribedMotion(Result):
    """A base motion, whose history is integrated in a higher layer."""

    @with_call_errors
    def to_dataframe(self) -> "pd.DataFrame":
        """Return the history of the base, one row per time.

        Acceleration, velocity and displacement: of a `Record` in m/s^2, m/s and m over s, one row
        per sample; of any other motion in units of alpha g, alpha g/p and alpha g/p^2 over pivot
        time pt, of an endless one for 3 periods.  A vertical component has columns of its own.
        """
        frame: pd.DataFrame = words_module(DescribedMotion).to_dataframe(self)
        return frame
