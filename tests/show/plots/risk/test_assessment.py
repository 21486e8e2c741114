"""Pictures of assessments and tables: the answer, its interval, 1.1 times it, the target."""

from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rocksteady import assess_object, assess_objects
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Assessment, DescribedObject, ObjectsTable
from rocksteady.show.style.tokens import LIGHT
from tests.every import every

SUITE = make_synthetic_suite(14)
BOTH = {"pga_g": 0.3, "pgv_m_s": 0.6}


def axes() -> Axes:
    return Figure(figsize=(6.4, 4.2)).add_subplot()


def described(width: float, height: float, **values: Any) -> DescribedObject:
    geometry = {"width_m": width, "height_m": height}
    given = {"name": f"{width} m", "geometry": geometry, "demand": BOTH, "friction": 0.9}
    return DescribedObject(values={**given, "assessment": {"draws": 2}, **values})


@pytest.fixture(scope="module", name="found")
def _found() -> Assessment:
    return assess_object(described(0.4, 1.8), SUITE)


def upright(drawn: Axes) -> list[float]:
    """Return where the lines from the lower to the upper edge stand."""
    return [
        float(np.asarray(line.get_xdata())[0])
        for line in drawn.lines
        if line.get_transform() == drawn.get_xaxis_transform()
    ]


def test_the_demand_stands_with_its_share_its_interval_and_1_1_times_it(found: Assessment) -> None:
    drawn = found.plot(axes())
    assert upright(drawn) == pytest.approx([0.3, 0.33])
    judged = found.judged
    assert judged.count is not None
    assert judged.beyond is not None
    assert 0.0 < judged.count.share < judged.beyond.share
    dots = [line for line in drawn.lines if len(line.get_path().vertices) == 1]
    bars = [each for each in drawn.collections if isinstance(each, LineCollection)][-2:]
    counted = {0.3: judged.count, 0.33: judged.beyond}
    for (at, count), dot, bar in zip(counted.items(), dots, bars, strict=True):
        np.testing.assert_allclose(np.asarray(dot.get_path().vertices), [[at, count.share]])
        (path,) = bar.get_paths()
        ends = [[at, count.band[0]], [at, count.band[1]]]
        np.testing.assert_allclose(np.asarray(path.vertices), ends)
    # The curve goes through the answer.
    fragility = found.fragility
    assert fragility is not None
    counts = dict(
        zip(fragility.states[-1].curve.levels, fragility.states[-1].curve.counts, strict=True)
    )
    assert counts[0.3].falls == judged.count.falls
    assert f"demand 0.3 g\n{100.0 * judged.count.share:.0f} % fall" in [
        text.get_text() for text in drawn.texts
    ]
    assert drawn.get_xlabel() == "PGA [g]: PGV over PGA is kept at 2 m/s per g"


def test_one_peak_has_its_own_axis() -> None:
    found = assess_object(described(0.4, 1.8, demand={"pgv_m_s": 0.5}), SUITE)
    drawn = found.plot(axes())
    assert drawn.get_xlabel() == "PGV [m/s]"
    assert upright(drawn) == pytest.approx([0.5, 0.55])


@every(
    ("values", "records", "words"),
    [
        ({"demand": {"pga_g": 0.1, "pgv_m_s": 0.3}}, 14, "It stands at 0.1 g"),
        ({"friction": 0.1}, 14, "It slides at 0.3 g"),
        ({}, 6, "No answer at 0.3 g"),
    ],
)
def test_without_counted_shares_there_is_no_picture(
    values: dict[str, Any], records: int, words: str
) -> None:
    found = assess_object(described(0.4, 1.8, **values), SUITE[:records])
    with pytest.raises(InputError, match=words):
        found.plot(axes())


# ------------------------------------------------------------------------------------- tables


@pytest.fixture(scope="module", name="table")
def _table() -> ObjectsTable:
    bodies = [
        described(0.2, 1.8),
        *(described(0.4, 1.8, name=name) for name in ("shelf", "rack", "case")),
        described(0.9, 1.1),
        described(0.21, 1.0, friction=0.1),
    ]
    return assess_objects(bodies, SUITE)


def test_a_row_is_a_kind_of_object_with_its_share_and_its_interval(table: ObjectsTable) -> None:
    drawn = table.plot(axes())
    kinds = table.kinds
    names = [label.get_text() for label in drawn.get_yticklabels()]
    assert names == [
        f"{count} × {row['name']}" if count > 1 else row["name"] for row, count in kinds
    ]
    assert "3 × shelf" in names
    counted = {place: row for place, (row, _) in enumerate(kinds) if row["by"] == "runs"}
    assert 0 < len(counted) < len(kinds)
    bars = [patch for patch in drawn.patches if isinstance(patch, Rectangle)]
    spans = [line for line in drawn.lines if line.get_path_effects()]
    for (place, row), bar, span in zip(counted.items(), bars, spans, strict=True):
        assert bar.get_y() + 0.5 * bar.get_height() == pytest.approx(place)
        assert bar.get_width() == row["share"]
        assert to_hex(bar.get_facecolor()) == LIGHT.risk_step(row["share"])
        assert np.asarray(span.get_xdata()).tolist() == [row["low"], row["high"]]


def test_the_verdict_stands_beside_each_row(table: ObjectsTable) -> None:
    drawn = table.plot(axes())
    said = {text.get_text(): to_hex(text.get_color()) for text in drawn.texts}
    assert said["stands"] == said["slides"] == LIGHT.ink
    (red,) = {f"{100.0 * row['share']:.0f} %, red" for row in table.rows if row["name"] == "shelf"}
    assert said[red] == LIGHT.verdict_red
    assert "target 10 %" in said


def test_of_many_kinds_the_worst_are_drawn_and_the_others_counted(table: ObjectsTable) -> None:
    drawn = table.plot(axes(), most=2)
    assert len(drawn.get_yticklabels()) == 2
    assert "target 10 %; 2 more below" in [text.get_text() for text in drawn.texts]
    with pytest.raises(InputError, match="most"):
        table.plot(axes(), most=0)


@pytest.mark.parametrize("width", [3.3, 6.4])
def test_no_text_is_cut_off(table: ObjectsTable, found: Assessment, width: float) -> None:
    for drawing in (table.plot, found.plot):
        figure = Figure(figsize=(width, 2.6), layout="constrained")
        drawn = drawing(figure.add_subplot())
        figure.draw_without_rendering()
        for text in (*drawn.texts, *drawn.get_yticklabels()):
            if text.get_text():
                extent = text.get_window_extent()
                assert extent.x0 >= figure.bbox.x0 - 1.0, text
                assert extent.x1 <= figure.bbox.x1 + 1.0, text
