"""Classes of cells: every cell is counted once, and the picture has the same shares as the JSON."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from rocksteady import DimensionlessBlock, map_attractors, map_fates, plots
from rocksteady.dynamics.maps.cell_classes import (
    BLANK,
    MEANINGS,
    CellClass,
    classes_of,
    counts_of,
    map_counts,
)
from rocksteady.errors import InputError
from rocksteady.show.plots.map_classes import LOOKS, share_text
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)
CLASS_OF = MEANINGS | {
    "subharmonic": CellClass.SUBHARMONIC,
    "not-computed": CellClass.NOT_COMPUTED,
}
AXES = {"amplitude": np.linspace(0.5, 6.0, 12), "frequency_ratio": np.linspace(0.5, 12.0, 11)}


def unfinished(found: xr.Dataset, name: str) -> xr.Dataset:
    """The same with a row of cells that are not computed."""
    part = found.copy(deep=True)
    part[name][0] = BLANK
    return part


@every("fates", [False, True])
@every("whole", [True, False])
def test_legend_table_and_json_have_the_same_shares(fates: bool, whole: bool) -> None:
    found = map_fates(BLOCK, axes=AXES) if fates else map_attractors(BLOCK, axes=AXES)
    shown = found if whole else unfinished(found, "fate" if fates else "kind")
    values = shown.rocksteady.to_dict()
    assert sum(values["counts"].values()) == values["cells"] == 12 * 11
    assert sum(values["shares"].values()) == pytest.approx(1.0)
    assert values["counts"]["not-computed"] == (0 if whole else 11)
    drawn = plots.outcomes(shown, Figure().add_subplot()).get_legend()
    assert drawn is not None
    legend = [text.get_text() for text in drawn.get_texts()]
    assert legend == [
        f"{LOOKS[CLASS_OF[word]].words}  {share_text(values['shares'][word])}"
        for word, count in values["counts"].items()
        if count
    ]
    table = [line.split() for line in shown.rocksteady.summary(more=True).splitlines()]
    for word, count in values["counts"].items():
        row = [word, str(count), f"{100.0 * values['shares'][word]:.2f}", "%"]
        assert (row in table) == (count > 0)


@given(st.lists(st.sampled_from(list(CellClass)), max_size=60))
def test_every_cell_is_counted_once(classes: list[CellClass]) -> None:
    counts = counts_of(np.array(classes, dtype=np.int8))
    assert counts == {one: classes.count(one) for one in CellClass}


def test_steady_motions_of_more_than_one_period_are_subharmonic_and_no_others_are() -> None:
    kinds = list(MEANINGS.values())
    kind = np.repeat(np.arange(len(kinds)), 3)
    period = np.tile([-1, 1, 2], len(kinds))
    flags = dict(enumerate(kinds))
    alone = classes_of(kind, None, flags)
    assert alone.tolist() == np.repeat(kinds, 3).tolist()
    steady = (CellClass.SYMMETRIC, CellClass.UNSYMMETRIC)
    again = [
        CellClass.SUBHARMONIC if cell in steady and count == 2 else cell
        for cell, count in zip(alone.tolist(), period.tolist(), strict=True)
    ]
    assert again.count(CellClass.SUBHARMONIC) == 2
    assert classes_of(kind, period, flags).tolist() == again


def test_a_kind_without_a_flag_is_refused() -> None:
    found = map_attractors(BLOCK, axes=AXES).copy(deep=True)
    found["kind"][0, 0] = 77
    with pytest.raises(InputError, match="77"):
        map_counts(found)
