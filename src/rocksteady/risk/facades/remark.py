"""Remarks on the checks of a facade: each has a key and values, so that pages can translate it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

TEMPLATES: Final[Mapping[str, str]] = {
    "eta": "eta {0} for {1} % damping",
    "beyond_4_s": "T = {0} s is beyond 4 s, to which NTC 2018 gives its spectrum: the displacement "
    "is kept constant",
    "table_as_given": "table at {0} % damping",
    "table_between": "table interpolated between {0} and {1} % damping to {2} %",
    "table_scaled": "table at {0} % damping scaled to {1} % by {2}, the ratio of eta",
    "records": "mean over the records of the largest S_D up to T, from 0 in place of T0, which "
    "could not be read: on the safe side",
    "peak_of_records": "mean PGA of the records",
    "q": "S_e(0) over q = {0}",
    "no_demand": "no demand is given for {0}: capacity alone",
    "no_runs": "no runs under records",
    "few_records": "a mean needs {0} records or more",
    "beyond_d0": "a run goes beyond d0: {0}",
    "mean_of_runs": "mean of the largest displacements, no run beyond d0",
    "linear_or_displacement": "The linear check compares the peak acceleration over q = 2 with a0, "
    "whatever the size of the wall; the checks of displacement allow more to a thicker wall and "
    "less to a thinner one of the same slenderness.",
    "static_or_dynamic": "The static check takes its displacement from an elastic oscillator that "
    "does not exist, of the secant period {0} s and {1} % damping; the dynamic check follows the "
    "rigid block from uplift through every impact.",
    "transcription": "Formulas of Circolare 2019 n. 7, C8.7.1, pp. 272-277, from an unreviewed "
    "transcription.",
    "second_bullets": "Of d_SLV and d_SLC the second condition of the circular could not be read: "
    "0.4 d0 and 0.6 d0 stand alone.",
    "uplift": "a0 FC is 1/e* = {0} times the acceleration that lifts a rigid block, {1} g: the "
    "dynamic check lets the wall move from {2} g (with FC), the static checks from a0 = {3} g.",
    "in_line": "The equivalent block is exact where all masses lie in line with the hinge and to "
    "the order of theta^2 with loads, ties, thrusts or pushing masses.",
}
"""English of each remark, with its values in turn."""


@dataclass(frozen=True)
class Remark:
    """A remark by its key, with values that are written already.

    Attributes
    ----------
    key
        Of `TEMPLATES`.
    values
        Numbers and names in the remark, as texts.
    """

    key: str
    values: tuple[str, ...] = ()

    def __str__(self) -> str:
        """Return it in English."""
        return TEMPLATES[self.key].format(*self.values)
