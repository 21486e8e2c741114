"""Words of neighbours: the scale at which none falls, and how many end otherwise."""

import pytest

from rocksteady import check_neighbours
from rocksteady.dynamics.history.neighbours import Neighbours
from tests.cli.program import rocksteady
from tests.words.test_trajectory import shaken


@pytest.mark.parametrize("accel_g", [0.75, 0.9, 1.5])
def test_no_neighbour_falls_where_it_is_said_to_stand_and_one_falls_just_above(
    accel_g: float,
) -> None:
    found = check_neighbours(shaken(accel_g))
    scale = found.stands_at
    assert (scale is None) == (found.agree and not found.fall)
    if scale is None:
        return
    for factor, stands in ((scale, True), (scale + 0.02, False)):
        case = shaken(factor * accel_g)
        fall = check_neighbours(case).fall + (case.status == "overturned")
        assert (fall == 0) == stands
    assert f"{scale:.2f} x this motion ({scale * accel_g:.3g} g)" in found.summary()


class SearchedError(Exception):
    """The scale at which no neighbour falls was searched."""


def refused(_: Neighbours) -> float:
    raise SearchedError


def test_the_scale_is_searched_where_the_screen_is_printed_and_nowhere_else(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It takes up to 1,300 runs."""
    monkeypatch.setattr(Neighbours, "stands_at", property(refused))
    found = check_neighbours(shaken(0.9))
    assert f"{found.fall} of {found.runs} neighbours" in repr(found)
    assert found.to_dict()["status"] == "overturned"
    assert len(found.to_dataframe()) == found.runs
    line = "simulate --width-m 0.4 --height-m 0.8 --pulse one-sine --accel-g 0.9 --freq-hz 1"
    assert '"overturned"' in rocksteady(line, "--json").out
    assert rocksteady(line, "--quiet").out.startswith("It falls ")
    for screen in (found.summary, found._repr_html_):
        with pytest.raises(SearchedError):
            screen()
    assert "SearchedError" in rocksteady(line).err


def test_the_sentence_counts_the_neighbours_that_end_otherwise() -> None:
    found = check_neighbours(shaken(0.9))
    assert 0 < found.fall < found.runs
    assert f"but {found.runs - found.fall} of {found.runs} neighbours stand." in found.summary()
    assert "all 26 neighbours stand" in check_neighbours(shaken(0.4)).summary()
