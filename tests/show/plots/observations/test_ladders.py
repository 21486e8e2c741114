"""Ladders of records: every outcome once, at its gain, over the shade of its prediction."""

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from rocksteady import plots
from rocksteady.errors import InputError
from rocksteady.show.style.page import Page
from tests.show.calibrated import calibrated, hostile


def drawn() -> Axes:
    return plots.test_ladders(calibrated(), Figure().add_subplot())


def marks(axes: Axes, label: str) -> list[float]:
    (line,) = (each for each in axes.lines if each.get_label() == label)
    return sorted(np.asarray(line.get_xdata()).tolist())


def test_every_outcome_stands_at_its_gain() -> None:
    axes, tests = drawn(), calibrated().tests.tests
    assert marks(axes, "fell") == sorted(test.gain for test in tests if test.fell)
    assert marks(axes, "stood") == sorted(test.gain for test in tests if test.fell is False)
    assert axes.get_xscale() == "log"
    assert len(axes.get_yticks()) == len({test.record.name for test in tests})


def test_rings_are_about_outcomes_of_less_than_an_even_chance() -> None:
    found = calibrated()
    p = found.validation.predictions.p
    wrong = [
        test.gain
        for test, chance in zip(found.tests.tests, p, strict=True)
        if (chance >= 0.5) != test.fell
    ]
    assert wrong
    assert marks(drawn(), "not expected") == sorted(wrong)


def test_the_likelier_a_fall_the_darker_its_strip() -> None:
    found, axes = calibrated(), drawn()
    (strips,) = (each for each in axes.collections if isinstance(each, PolyCollection))
    shades = [sum(to_rgb(tuple(each))) for each in np.asarray(strips.get_facecolor())]
    order = {text.get_text(): row for row, text in enumerate(axes.get_yticklabels())}
    rows = sorted(
        (order[str(test.record.name)], test.gain, chance)
        for test, chance in zip(found.tests.tests, found.validation.predictions.p, strict=True)
    )
    by_chance = np.array(shades)[np.argsort([chance for *_, chance in rows])]
    assert (np.diff(by_chance) <= 1e-12).all()
    assert by_chance[0] - by_chance[-1] > 1.0


def test_records_are_in_the_order_of_what_it_takes() -> None:
    axes, tests = drawn(), calibrated().tests.tests
    names = [text.get_text() for text in axes.get_yticklabels()]
    middle = [
        np.exp(np.mean([np.log(t.gain) for t in tests if t.record.name == name])) for name in names
    ]
    assert np.corrcoef(middle, np.arange(len(names)))[0, 1] < -0.5
    low, high = axes.get_ylim()
    assert low > high, "the first row is on top"


def test_rows_can_be_parted() -> None:
    axes = plots.test_ladders(calibrated(), Figure().add_subplot(), first=4, most=3)
    assert len(axes.get_yticks()) == 2
    with pytest.raises(InputError, match="first is 6: there are 6 rows"):
        plots.test_ladders(calibrated(), Figure().add_subplot(), first=6)


def test_hostile_names_are_shown_as_they_are() -> None:
    with Page(width_mm=84.0).figure(6.6, 4.0, "") as figure:
        axes = plots.test_ladders(hostile(), figure.add_subplot())
        figure.draw_without_rendering()
    assert all("<script" in text.get_text() for text in axes.get_yticklabels())


def test_strips_reach_half_way_to_the_next_test_and_rings_are_twice_a_mark() -> None:
    found, axes = calibrated(), drawn()
    (strips,) = (each for each in axes.collections if isinstance(each, PolyCollection))
    boxes = [np.asarray(path.vertices) for path in strips.get_paths()]
    order = {text.get_text(): row for row, text in enumerate(axes.get_yticklabels())}
    gains: dict[int, set[float]] = {}
    for test in found.tests.tests:
        gains.setdefault(order[str(test.record.name)], set()).add(test.gain)
    ends = axes.get_xlim()
    for row, levels in gains.items():
        inside = [box for box in boxes if abs(box[:, 1].mean() - row) < 0.5]
        inside = [box[:4] for box in inside]
        at = np.sort(list(levels))
        middles = np.sqrt(at[1:] * at[:-1])
        lefts = np.sort([box[:, 0].min() for box in inside])
        rights = np.sort([box[:, 0].max() for box in inside])
        np.testing.assert_allclose(lefts[1:], middles, rtol=1e-12)
        np.testing.assert_allclose(rights[:-1], middles, rtol=1e-12)
        assert ends[0] <= lefts[0] < at[0]
        assert at[-1] < rights[-1] <= ends[1]
        step = (at[1:] / at[:-1]).min() ** 0.5
        assert lefts[0] == pytest.approx(max(ends[0], at[0] / max(step, 1.03)), rel=1e-12)
        for box in inside:
            assert box[:, 1].min() < row < box[:, 1].max()
            assert row - box[:, 1].min() == pytest.approx(box[:, 1].max() - row)
    sizes = {line.get_label(): line.get_markersize() for line in axes.lines}
    assert sizes["fell"] == sizes["stood"]
    assert sizes["not expected"] == 2.0 * sizes["fell"]
