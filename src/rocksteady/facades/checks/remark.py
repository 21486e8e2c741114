"""Remarks on the checks of a facade: each has a key and values, so that pages can translate it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

TEMPLATES: Final[Mapping[str, str]] = {
    "eta": "eta = {0} for {1} % damping",
    "beyond_4_s": "T = {0} s is beyond 4 s, where the spectrum of NTC 2018 ends: the displacement "
    "is kept constant",
    "table_as_given": "table at {0} % damping",
    "table_between": "table interpolated between {0} and {1} % damping to {2} %",
    "table_scaled": "table at {0} % damping scaled to {1} % by {2}, the ratio of eta",
    "records": "mean over the records of the largest S_D from period 0 to T; T0, the lower end, "
    "could not be read: on the safe side",
    "peak_of_records": "mean PGA of the records",
    "q": "S_e(0) divided by q = {0}",
    "no_demand": "no demand is given for {0}: capacity alone",
    "no_runs": "no runs under records",
    "few_records": "a mean needs {0} records or more",
    "beyond_d0": "runs beyond d0 under {0}",
    "weak_records": "no answer: the records have a mean PGA of {0} g, and the demand of {2} {1} g; "
    "scale them with --pga-g",
    "mean_of_runs": "mean of the largest displacements, no run beyond d0",
    "linear_or_displacement": "The linear check compares the peak acceleration divided by q = 2 "
    "with a0, which does not depend on size; the displacement capacity grows with the thickness.",
    "free_or_displacement": "The linear check compares S_e(T0) with alpha_0 g/FC, which does not "
    "depend on size; the displacement capacity grows with the thickness.",
    "static_or_dynamic": "The nonlinear static demand is the displacement of an elastic "
    "oscillator of the secant period {0} s with {1} % damping; the dynamic one is that of a rigid "
    "block that lifts, falls back and loses velocity at each impact.",
    "standard": "Formulas of Circolare 2019 n. 7, C8.7.1, pp. 272-277: not checked against the "
    "printed standard.",
    "second_conditions": "The second conditions on d_SLV and d_SLC could not be read: 0.4 d0 and "
    "0.6 d0 alone are used.",
    "ending": "d0 counts only what is verified to act up to collapse (C8.7.1.2.1.6): not {0}.",
    "e_star": "a0 is {0} g with the mass spread (e* = {1}) and {2} g with the mass of each body "
    "at its centre (e* = {3}): the smaller decides the linear checks.",
    "e_star_free": "a0 would be {0} g with the mass spread (e* = {1}) and {2} g with the mass of "
    "each body at its centre (e* = {3}); alpha_0 g/FC = {4} g decides (C8.7.1.9).",
    "free": "S_e(T0 = {0} s) with 5 % damping, at z = {1} m, without q: the element is free to "
    "vibrate",
    "rigid_runs": "The runs take the element as rigid: its elastic vibration is not in them.",
    "gable_top": "The gable is checked as bound to what stands behind it: a top that is free to "
    "vibrate has one_sided = false.",
    "uplift": "The facade lifts at alpha_0 g = {0} g. In the runs it moves from {1} g on: FC "
    "divides the strength, and what holds it and is not verified up to collapse is left out. "
    "The capacity curve of the rigid facade begins at a0 = {2} g.",
    "in_line": "With loads, ties, thrusts or pushing masses the equivalent block is accurate to "
    "the order of theta^2; it is exact where all masses lie in line with the hinge.",
}
"""English of each remark, with its values in turn."""


@dataclass(frozen=True)
class Remark:
    """A remark by its key, with values that are written already.

    Attributes
    ----------
    key
        Key of `TEMPLATES`.
    values
        Numbers and names in the remark, as texts.
    """

    key: str
    values: tuple[str, ...] = ()

    def __str__(self) -> str:
        """Return it in English."""
        return TEMPLATES[self.key].format(*self.values)
