"""Words of base motions: parameters, largest values, and a table of their history."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np

from rocksteady.dynamics.history import base_motion
from rocksteady.kernels.core import tables as columns
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motion_facts import motion_facts, motion_text
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import number, quantity
from rocksteady.results.result import describes
from rocksteady.seismic.measures.motion_course import motion_course
from rocksteady.seismic.measures.time_course import integrate_record

if TYPE_CHECKING:
    import pandas as pd

BARE = DimensionlessBlock(restitution=1.0)
"""Stands for no block at all, in whose units a motion would be."""


def to_dataframe(motion: Motion | Record | BaseMotion) -> "pd.DataFrame":
    """Return the history of a motion, one row per time, with columns of a vertical component."""
    import pandas as pd

    if isinstance(motion, BaseMotion):
        across = to_dataframe(motion.horizontal)
        if motion.vertical is None:
            return across
        up = to_dataframe(motion.vertical).add_prefix("vertical_")
        shared = across.columns[0]
        up = up.rename(columns={f"vertical_{shared}": shared})
        return across.merge(up, how="outer", on=shared) if shared in up else across.join(up)
    if isinstance(motion, Record):
        return integrate_record(motion).to_dataframe().drop(columns="arias_m_s")
    return pd.DataFrame(motion_course(motion)._asdict())


@describes(DescribedMotion)
def _described(motion: DescribedMotion) -> Description:
    """Return parameters, largest values and duration of a motion."""
    return describe_motion(cast("Motion | Record | BaseMotion", motion))


def describe_motion(motion: Motion | Record | BaseMotion) -> Description:
    """Return parameters, largest values and duration of a motion."""
    if isinstance(motion, Record):
        return integrate_record(motion).describe()
    if isinstance(motion, BaseMotion):
        parts = [describe_motion(motion.horizontal)]
        if motion.vertical is not None:
            parts.append(describe_motion(motion.vertical))
        facts = [
            replace(
                fact,
                key=fact.key and component + fact.key,
                label=fact.label and component.replace("_", " ") + fact.label,
            )
            for component, part in zip(("", "vertical_"), parts, strict=False)
            for fact in part.facts
        ]
        headline = parts[0].headline + (", with a vertical motion" if len(parts) > 1 else "")
        return Description(headline=headline, facts=facts)
    words = motion_text(BARE, motion)
    by_key = {fact.key: fact for fact in (*motion_facts(BARE, motion), *_measured(motion))}
    return Description(headline=words[0].upper() + words[1:], facts=list(by_key.values()))


def _measured(motion: Motion) -> Iterator[Fact]:
    """Yield how long a dimensionless motion lasts, and its largest values until it ends."""
    table = segment_table(motion)
    end = float(base_motion.segment_starts(table)[-1])
    endless = bool(table[-1, [columns.CONSTANT, columns.AMPLITUDE]].any())
    words = "endless" if endless else f"pt = {number(end)}"
    yield Fact("duration_pt", None if endless else end, "duration", words)
    course = motion_course(motion)
    lasting = (course.pt <= end) | endless
    for name, unit in (("acceleration", "g"), ("velocity", "g/p"), ("displacement", "g/p^2")):
        peak = float(np.abs(getattr(course, name)[lasting]).max())
        yield Fact(f"peak_{name}", peak, f"largest {name}", quantity(peak, f"alpha {unit}"))
