"""The page's drawings: scales, frames, classes and the pen that writes SVG."""

import json
import re
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocksteady.dynamics.maps.cell_classes import CellClass
from rocksteady.explorer._palette import page_theme
from rocksteady.show.style.tokens import DARK, LIGHT, contrast
from tests.explorer.in_node import InNode

ONCE = settings(
    deadline=None, max_examples=3, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
SVG = "{http://www.w3.org/2000/svg}"
IMPORTS = f"""
const {{ scale, numeral }} = await import(parts('draw/scale.mjs'));
const {{ theme }} = await import(parts('draw/theme.mjs'));
const {{ SvgPen, escapedXml }} = await import(parts('draw/svg.mjs'));
const {{ frame, shortenedTo, wrapped }} = await import(parts('draw/frame.mjs'));
const {{ area, curve, edge, legend, lineLabel, note, points }} =
    await import(parts('draw/marks.mjs'));
const {{ MOTION_CLASSES, classLook, fallLook, fillClass, lookTiles }} =
    await import(parts('draw/classes.mjs'));
const light = theme(false, {json.dumps(page_theme())});
"""

# ----------------------------------------------------------------------------------- scales

ends = st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)).filter(
    lambda pair: abs(pair[1] - pair[0]) > 1e-6 * max(map(abs, pair), default=1.0) > 0.0
)
positive = st.tuples(st.floats(1e-8, 1e8), st.floats(1e-8, 1e8)).filter(
    lambda pair: max(pair) > 1.0001 * min(pair)
)
windows = st.lists(
    st.one_of(
        ends.map(lambda pair: {"from": pair[0], "to": pair[1], "log": False}),
        positive.map(lambda pair: {"from": pair[0], "to": pair[1], "log": True}),
    ),
    min_size=100,
    max_size=100,
)
TICKS = """
answer(asked.map((given) => {
    const found = scale({ ...given, start: 10, end: 400 });
    const ticks = found.ticks(6), minor = found.minor(6);
    return { ticks, minor, at: ticks.map(({ value }) => found.at(value)),
        ends: [found.at(given.from), found.at(given.to)],
        back: ticks.map(({ value }) => found.value(found.at(value))) };
}));
"""
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


def number(label: str) -> float:
    """Return the number that a label shows."""
    mantissa, power, exponent = label.replace("−", "-").rpartition("10")
    if power and (not mantissa or mantissa.endswith("×")) and not exponent.isascii():
        lead = float(mantissa.rstrip("×") or 1)
        return lead * 10.0 ** int(exponent.translate(SUPERSCRIPTS))
    return float(label.replace("−", "-"))


@given(given_windows=windows)
@ONCE
def test_ticks_lie_inside_rise_and_say_their_values(
    given_windows: list[dict[str, Any]], in_node: InNode
) -> None:
    for window, found in zip(given_windows, in_node(IMPORTS + TICKS, given_windows), strict=True):
        low, high = sorted((window["from"], window["to"]))
        values = [tick["value"] for tick in found["ticks"]]
        assert 1 <= len(values) <= 7, window
        assert all(low <= value <= high for value in [*values, *found["minor"]])
        assert values == sorted(set(values))
        assert found["minor"] == sorted(set(found["minor"]))
        assert found["ends"] == pytest.approx([10.0, 400.0])
        assert found["back"] == pytest.approx(values, rel=1e-9, abs=1e-9 * (high - low))
        labels = [tick["label"] for tick in found["ticks"]]
        assert len(set(labels)) == len(labels), labels
        shown = [number(label) for label in labels]
        # As exact as the labels: an end that a tick was moved to may differ in its last digits.
        assert shown == pytest.approx(values, rel=1e-6, abs=1e-6 * (high - low)), window
        rising = found["at"] == sorted(found["at"])
        assert rising or found["at"] == sorted(found["at"], reverse=True)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("window", "labels"),
    [
        ({"from": 0, "to": 6}, ["0", "1", "2", "3", "4", "5", "6"]),
        ({"from": -0.45, "to": 0.45}, ["−0.4", "−0.2", "0", "0.2", "0.4"]),
        ({"from": 0, "to": 0.3}, ["0", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30"]),
        ({"from": 0.5, "to": 20, "log": True}, ["0.5", "1", "2", "5", "10", "20"]),
        ({"from": 1e-4, "to": 1, "log": True}, ["10⁻⁴", "0.001", "0.01", "0.1", "1"]),
        ({"from": 2, "to": 3, "log": True}, ["2.0", "2.2", "2.4", "2.6", "2.8", "3.0"]),
        ({"from": 0, "to": 2.5e-5}, ["0", "5×10⁻⁶"]),
        ({"from": 3, "to": 3}, []),
        ({"from": 0, "to": "none"}, []),
        ({"from": 0, "to": 10, "log": True}, []),
    ],
)
def test_labels_are_what_an_engineer_would_write(
    window: dict[str, Any], labels: list[str], in_node: InNode
) -> None:
    lines = """
    const to = Number(asked.to);
    answer(scale({ ...asked, to, start: 0, end: 100 }).ticks(6).map(({ label }) => label));
    """
    found = in_node(IMPORTS + lines, window)
    if labels == ["0", "5×10⁻⁶"]:
        assert found[0] == "0"
        assert [number(label) for label in found[1:]] == pytest.approx(
            [5e-6 * k for k in range(1, 6)]
        )
    else:
        assert found == labels


def test_numbers_have_no_trailing_zeros_and_a_minus_sign(in_node: InNode) -> None:
    asked = [0.3900000001, -2, 1234567, 2.5e-7, 0, 100]
    lines = "answer([...asked.map((value) => numeral(value)), numeral(NaN), numeral(-Infinity)]);"
    expected = ["0.39", "−2", "1.235×10⁶", "2.5×10⁻⁷", "0", "100", "–", "−∞"]
    assert in_node(IMPORTS + lines, asked) == expected


# ------------------------------------------------------------------------------------ frames

FRAMES = """
answer(asked.map(({ width, height, x, y, title }) => {
    const pen = new SvgPen(width, height);
    const found = frame(pen, { width, height }, { theme: light, x, y, title });
    pen.font = width < 420 ? light.small : light.font;
    const each = /<text x="(.*?)" y="(.*?)" text-anchor="(.*?)".*?>(.*?)</g;
    const texts = [...pen.toString().matchAll(each)];
    return { box: found.box, texts: texts.map(([, x, y, anchor, text]) =>
        [Number(x), Number(y), anchor, pen.measureText(text).width, text]) };
}));
"""
LONG = "frequency ratio Ω = ω/p along the row of the map at the amplitude A = 2.000 and further"


@pytest.mark.slow
@pytest.mark.parametrize("width", [200, 304, 360, 700, 1440])
def test_labels_are_not_cut_and_do_not_overlap(width: int, in_node: InNode) -> None:
    windows: list[dict[str, Any]] = [
        {"from": 0.5, "to": 8, "label": "frequency ratio Ω = ω/p"},
        {"from": -1e5, "to": 3e5, "label": LONG},
        {"from": 1.23456, "to": 1.23466, "label": "Ω"},
        {"from": 1e-7, "to": 1e7, "log": True, "label": LONG},
    ]
    asked = [
        {"width": width, "height": height, "x": x, "y": y, "title": title}
        for height in (120, 300)
        for x in windows
        for y in windows
        for title in ("", "Time history")
    ]
    for case, found in zip(asked, in_node(IMPORTS + FRAMES, asked), strict=True):
        box = found["box"]
        assert box["left"] >= 0
        assert box["left"] + box["width"] <= width
        assert box["width"] >= 0.4 * width
        assert box["top"] + box["height"] < case["height"]
        boxes = []
        for x, y, anchor, wide, text in found["texts"]:
            left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor] * wide
            assert left >= -1.0, text
            assert left + wide <= width + 1.0, text
            assert 8.0 < y <= case["height"], text
            boxes.append((left, left + wide, y, text))
        for k, (left, right, y, text) in enumerate(boxes):
            for other in boxes[:k]:
                apart = right <= other[0] or other[1] <= left or abs(y - other[2]) >= 10.0
                assert apart, (text, other)


def test_a_curve_has_a_gap_where_a_value_is_not_finite(in_node: InNode) -> None:
    lines = """
    const pen = new SvgPen(400, 300);
    const onto = frame(pen, pen, { theme: light, x: { from: 0, to: 10 }, y: { from: 0, to: 10 } });
    const before = pen.elements.length;
    curve(pen, onto, [0, 1, NaN, 3, 4, 5], [0, 1, 2, 3, Infinity, 5]);
    answer(pen.elements.slice(before).filter((text) => text.includes('<path')));
    """
    (path,) = in_node(IMPORTS + lines)
    assert re.sub(r"[^ML]", "", path.partition('d="')[2].partition('"')[0]) == "MLMM"


def test_edges_are_limits_on_paper_and_told_apart_by_their_dashes(in_node: InNode) -> None:
    lines = """
    answer(['fold', 'flip', 'grazing'].map((kind) => {
        const pen = new SvgPen(400, 300);
        const axes = { x: { from: 0, to: 1 }, y: { from: 0, to: 1 } };
        const onto = frame(pen, pen, { theme: light, ...axes });
        const before = pen.elements.length;
        edge(pen, onto, [0, 1], [0, 1], kind);
        return pen.elements.slice(before).filter((text) => text.includes('<path'));
    }));
    """
    dashes = []
    for casing, line in in_node(IMPORTS + lines):
        assert f'stroke="{LIGHT.paper}"' in casing
        assert "dasharray" not in casing
        assert f'stroke="{LIGHT.limit}"' in line
        widths = [float(re.findall(r'stroke-width="(.*?)"', each)[0]) for each in (casing, line)]
        assert widths[0] > widths[1] + 2.0
        dashes += re.findall(r'dasharray="(.*?)"', line)
    assert len(set(dashes)) == 3


# --------------------------------------------------------------------------------------- SVG

HOSTILE = [
    "</text><script>alert(1)</script>",
    '" onload="alert(1)',
    "&lt;&#60;]]>",
    "a\x00b\x0bc\x1f\ufffe",
    "\ud800 alone \udc00",
    "<!--",
    "  spaces  ",
    "Ω = ω/p 🧱",
]
KINDS = ("svg", "title", "desc", "defs", "clipPath", "g", "path", "text", "image")
DRAWN = """
answer(asked.map((name) => {
    const pen = new SvgPen(360, 240, { title: name, description: name });
    const onto = frame(pen, pen, { theme: light, title: name, x: { from: 0, to: 1, label: name },
        y: { from: 0, to: 1, label: name } });
    note(pen, onto, name, 100, 100);
    legend(pen, onto, [{ label: name, colour: name }, { label: name, fill: 'overturned' }]);
    lineLabel(pen, onto, [0, 1], [0, 1], name);
    area(pen, onto, [0, 1], [0, 0.5], [0.2, 1], { hatch: light.ink });
    points(pen, onto, [0.5, NaN], [0.5, 0.5], { mark: 'cross', casing: '#ffffff' });
    pen.save();
    pen.translate(50, 60);
    pen.rotate(0.5);
    pen.scale(2, 3);
    pen.fillText(name, 0, 0);
    const canvas = { width: 4, height: 4, toDataURL: () => 'data:image/png;base64,AA==' };
    pen.drawImage(canvas, 0, 0, 20, 20);
    pen.restore();
    const box = { left: 0, top: 0, width: 20, height: 9 };
    for (const one of MOTION_CLASSES) fillClass(pen, light, one, box);
    return pen.toString();
}));
"""


def test_an_svg_is_well_formed_whatever_its_names(in_node: InNode) -> None:
    hostile = in_node(IMPORTS + DRAWN, HOSTILE)
    elements = []
    for name, text in zip(HOSTILE, hostile, strict=True):
        root = ET.fromstring(text.encode("utf-8"))
        assert root.tag == f"{SVG}svg"
        kinds = {element.tag for element in root.iter()}
        assert kinds <= {f"{SVG}{tag}" for tag in KINDS}
        assert not any(key.startswith("on") for each in root.iter() for key in each.attrib)
        elements.append(sum(1 for _ in root.iter()))
        shown = re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe]", "", name)
        shown = re.sub(r"[\ud800-\udfff]", "\ufffd", shown)
        title = root.find(f"{SVG}title")
        assert title is not None
        assert title.text == shown
        used = set(re.findall(r"url\(#(.*?)\)", text))
        assert used == {each.attrib["id"] for each in root.iter(f"{SVG}clipPath")}
    assert max(elements) - min(elements) < 8  # long names stand in two lines


def test_paths_lie_where_a_canvas_has_them(in_node: InNode) -> None:
    lines = """
    const pen = new SvgPen(100, 100);
    pen.translate(10, 20);
    pen.rotate(Math.PI / 2);
    pen.scale(2, 2);
    pen.beginPath();
    pen.moveTo(0, 0);
    pen.lineTo(5, 0);
    pen.lineTo(NaN, 1);
    pen.arc(0, 0, 4, 0, Math.PI, true);
    pen.lineWidth = 1.5;
    pen.stroke();
    answer(pen.elements[0]);
    """
    found = in_node(IMPORTS + lines)
    pairs = re.findall(r"(-?[\d.]+) (-?[\d.]+)", found.partition('d="')[2].partition('"')[0])
    places = [(float(x), float(y)) for x, y in pairs]
    assert places[:3] == [(10.0, 20.0), (10.0, 30.0), (10.0, 28.0)]
    # Backward from 0 to pi: over -pi/2, which the turn by 90 degrees has right of the centre.
    assert places[5] == (18.0, 20.0)
    assert places[-1] == (10.0, 12.0)
    assert 'stroke-width="3"' in found


def test_saved_states_come_back_and_clips_lie_inside_each_other(in_node: InNode) -> None:
    lines = """
    const pen = new SvgPen(100, 100);
    pen.fillStyle = '#111111';
    pen.save();
    pen.rect(0, 0, 50, 50);
    pen.clip();
    pen.save();
    pen.beginPath();
    pen.rect(20, 20, 50, 50);
    pen.clip();
    pen.fillStyle = '#222222';
    pen.fillRect(0, 0, 100, 100);
    pen.restore();
    pen.fillRect(0, 0, 100, 100);
    pen.restore();
    pen.fillRect(0, 0, 100, 100);
    answer(pen.toString());
    """
    root = ET.fromstring(in_node(IMPORTS + lines).encode())
    outer, inner = root.iter(f"{SVG}clipPath")
    assert inner.attrib["clip-path"] == f"url(#{outer.attrib['id']})"
    groups = {
        id(path): group.attrib["clip-path"] for group in root.iter(f"{SVG}g") for path in group
    }
    paths = [path for path in root.iter(f"{SVG}path") if "fill" in path.attrib]
    assert [path.attrib["fill"] for path in paths] == ["#222222", "#111111", "#111111"]
    clips = [groups.get(id(path)) for path in paths]
    assert clips == [f"url(#{inner.attrib['id']})", f"url(#{outer.attrib['id']})", None]


# ----------------------------------------------------------------------------------- classes


def test_classes_are_numbered_as_in_plots(in_node: InNode) -> None:
    names = in_node(IMPORTS + "answer(MOTION_CLASSES);")
    assert names == [one.name.lower().replace("_", "-") for one in CellClass]


@pytest.mark.parametrize("ratio", [1, 2, 3])
def test_tiles_have_the_fills_of_plots_beneath_their_patterns(ratio: int, in_node: InNode) -> None:
    lines = """
    const looks = MOTION_CLASSES.map((name) => classLook(light, name));
    const { size, pixels } = lookTiles(looks, asked);
    answer(pixels.map((tile, k) => {
        const fill = parseInt(looks[k].fill.slice(1), 16);
        const plain = [...tile].filter((pixel) => (((pixel & 255) << 16) | (pixel & 0xff00)
            | ((pixel >> 16) & 255)) === fill);
        const opaque = tile.every((pixel) => pixel >>> 24 === 255);
        return [MOTION_CLASSES[k], plain.length / size ** 2, opaque];
    }));
    """
    for name, share, opaque in in_node(IMPORTS + lines, ratio):
        assert opaque
        if name in {"rest", "symmetric", "rocking"}:
            assert share == 1.0, name
        else:
            assert 0.3 < share < 0.99, name  # a pattern, and the fill is seen


@pytest.mark.parametrize("look", ["light", "dark"])
def test_ways_to_fall_are_told_apart_by_their_hatch_alone(look: str, in_node: InNode) -> None:
    lines = f"""
    const inks = theme({json.dumps(look == "dark")}, {json.dumps(page_theme())});
    const looks = [0, 1, 2].map((impacts) => [1, -1].map((side) => fallLook(inks, side, impacts)));
    answer({{ looks, map: classLook(inks, 'overturned') }});
    """
    found = in_node(IMPORTS + lines)
    inks = DARK if look == "dark" else LIGHT
    for left, right in found["looks"]:
        assert left["fill"] == right["fill"] == inks.falls
        assert contrast(left["mark"], inks.falls) > 2.0
        assert (left["kind"], right["kind"]) == ("rising", "falling")
        assert left["every"] == right["every"]
    every = [left["every"] for left, _ in found["looks"]]
    assert every == sorted(set(every), reverse=True)
    assert found["map"] == found["looks"][1][0]
