"""Reports: what fills a template, pictures inside the page, and colours that one can read."""

import base64
import itertools
import re
import sys
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import pytest
from jinja2 import TemplateNotFound, UndefinedError
from matplotlib.figure import Figure

from rocksteady.show.export.files import figure_bytes
from rocksteady.show.report import (
    ROLES,
    anchor,
    duration,
    prose,
    render,
    svg_data_uri,
)
from rocksteady.show.report import picture as drawn_picture
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT, Inks, inks_of
from tests.every import every

PAGE = """{% extends "house/base.html.j2" %}
{% block title %}{{ title }}{% endblock %}
{% block content %}<p>{{ text }} {{ seconds | duration }} {{ title | anchor }}</p>{% endblock %}
"""

TEXT_ON_GROUND = [
    ("ink", "paper"),
    ("ink", "page"),
    ("quiet", "paper"),
    ("quiet", "page"),
    ("verdict-green", "paper"),
    ("paper", "verdict-amber"),
    ("paper", "verdict-red"),
    ("paper", "ink"),
]


def uri(figure: Figure) -> str:
    return svg_data_uri(figure_bytes(figure, "svg"))


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A package with one report in it, as a later study would be."""
    name = "package_of_one_report"
    folder = tmp_path / name
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "page.html.j2").write_text(PAGE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, name, raising=False)
    return name


@pytest.fixture
def page(package: str) -> str:
    return render(package, "page.html.j2", title="A title", text="text", seconds=1.0)


def wave(phase: float = 0.0) -> Figure:
    with palette.style():
        figure = Figure(figsize=(3.0, 2.0))
        axes = figure.add_subplot()
        axes.plot([0.0, 1.0, 2.0], [phase, 1.0, 0.0], label="wave")
        axes.set_xlabel(r"$\Omega$")
        axes.legend()
    return figure


def picture(uri: str) -> bytes:
    head, _, body = uri.partition(",")
    assert head == "data:image/svg+xml;base64"
    return base64.b64decode(body, validate=True)


def luminance(colour: str) -> float:
    """Relative luminance, WCAG 2.2."""
    parts = [int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    dark, light = sorted((luminance(one), luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def test_text_is_escaped_and_filters_are_there(package: str) -> None:
    text = render(package, "page.html.j2", title="<b>&\"'", text="a < b & c > d", seconds=0.25)
    assert "<title>&lt;b&gt;&amp;&#34;&#39;</title>" in text
    assert "a &lt; b &amp; c &gt; d 250 ms b" in text


def test_a_value_that_is_not_given_is_an_error(package: str) -> None:
    with pytest.raises(UndefinedError, match="'seconds' is undefined"):
        render(package, "page.html.j2", title="A title", text="text")


def test_a_template_that_is_not_there_is_an_error(package: str) -> None:
    with pytest.raises(TemplateNotFound):
        render(package, "base.html.j2")


def test_the_page_may_fetch_and_run_nothing(page: str) -> None:
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page)
    assert policy is not None
    rules = dict(rule.strip().split(" ", 1) for rule in policy[1].split(";"))
    assert rules == {
        "default-src": "'none'",
        "img-src": "data:",
        "style-src": "'unsafe-inline'",
        "base-uri": "'none'",
        "form-action": "'none'",
    }
    assert not re.search(r"<script|url\(|@import|https?:|\son[a-z]+=|\sstyle=", page)


def roles(inks: Inks) -> dict[str, str]:
    """Colours of a page by the names of their properties."""
    return {role.replace("_", "-"): getattr(inks, role) for role in ROLES}


def test_every_colour_of_the_page_is_one_of_the_tokens_on_both_papers(page: str) -> None:
    light, dark = (roles(inks) for inks in (LIGHT, DARK))
    assert set(re.findall(r"#[0-9a-fA-F]{3,8}\b", page)) == {*light.values(), *dark.values()}
    folder = Path(palette.__file__).parents[1] / "templates"
    for file in folder.glob("*.j2"):
        text = file.read_text(encoding="utf-8")
        assert not re.search(r"#[0-9a-fA-F]{3,8}\b", text), file
    used = set(re.findall(r"var\(--([a-z-]+)\)", page)) - {"text", "label", "mono"}
    assert used <= set(light)
    on_dark = re.search(
        r"@media screen and \(prefers-color-scheme: dark\) {\s*:root { (.*?) }", page
    )
    assert on_dark is not None
    assert dict(re.findall(r"--([a-z0-9-]+): (#\w+);", on_dark[1])) == dark


def test_every_text_can_be_read_on_its_ground(page: str) -> None:
    of_text = set(re.findall(r"(?<![a-z-])color: var\(--([a-z-]+)\)", page))
    assert of_text == {text for text, _ in TEXT_ON_GROUND}
    for inks in (LIGHT, DARK):
        colours = roles(inks)
        for text, ground in TEXT_ON_GROUND:
            assert contrast(colours[text], colours[ground]) >= 4.5, (text, ground)


def test_a_picture_is_drawn_on_light_and_dark_paper_without_its_paper() -> None:
    drawn = drawn_picture(lambda axes: axes.plot([0.0, 1.0], color=inks_of(axes).ink), 2.0, "A.")
    light, dark = picture(drawn["source"]).decode(), picture(drawn["source_dark"]).decode()
    assert LIGHT.ink in light
    assert DARK.ink not in light
    assert DARK.ink in dark
    assert LIGHT.ink not in dark
    for svg, inks in ((light, LIGHT), (dark, DARK)):
        assert f"fill: {inks.paper}" not in svg
    assert len({drawn[name] for name in drawn}) == 5


def test_a_picture_has_no_digits_that_nobody_sees() -> None:
    svg = picture(drawn_picture(lambda axes: axes.plot([0.0, 1.0]), 2.0, "A.")["source"]).decode()
    places = re.findall(r"(?<!scale\()\b\d+\.(\d+)", svg.partition("?>")[2])
    assert max(map(len, places)) <= 3
    assert "scale(0.015625)" in svg
    ET.fromstring(svg)


def test_contrast_is_that_of_the_guidelines() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.005)


def test_a_picture_is_an_svg_without_date_or_outside_link() -> None:
    svg = picture(uri(wave()))
    assert ET.fromstring(svg).tag == "{http://www.w3.org/2000/svg}svg"
    text = svg.decode("utf-8")
    assert "dc:date" not in text
    assert "matplotlib.org" not in text
    links = re.findall(r'href="([^"]*)"', text)
    assert links
    assert all(link.startswith("#") for link in links)


def test_an_address_carries_the_bytes_of_its_picture() -> None:
    assert picture(svg_data_uri(b'<svg title="\xce\xa9"/>')) == b'<svg title="\xce\xa9"/>'


@pytest.mark.parametrize("again", [wave, lambda: wave(0.5)], ids=["the same", "another"])
def test_the_same_figure_gives_the_same_bytes(again: Callable[[], Figure]) -> None:
    same = uri(wave()) == uri(again())
    assert same is (again is wave)


def test_a_picture_does_not_depend_on_the_users_settings() -> None:
    expected = uri(wave())
    with mpl.rc_context({"svg.hashsalt": None, "svg.fonttype": "none", "savefig.dpi": 40.0}):
        before = dict(mpl.rcParams)
        assert uri(wave()) == expected
        assert dict(mpl.rcParams) == before


@every(
    ("plain", "printed"),
    [
        ("1e-06 to 0.01", "10⁻⁶ to 0.01"),
        ("2.5e+08, 4.0e-01, 1.1e00", "2.5·10⁸, 4.0·10⁻¹, 1.1·10⁰"),
        ("10^28-fold, 10^-3", "10²⁸-fold, 10⁻³"),
        ("-1.5, (-2), A=-3, -.5", "−1.5, (−2), A=−3, −.5"),
        ("eq-4-5, 89-106, 1/3-2, in-phase", "eq-4-5, 89-106, 1/3-2, in-phase"),
        ("Q > 1 and P < Q", "Q_>_1 and P_<_Q"),
        ("A = 2, <b> = x", "A_=_2, <b>_=_x"),
        ("figure 3e, 8a", "figure 3e, 8a"),
    ],
)
def test_numbers_and_equations_are_set_as_in_print(plain: str, printed: str) -> None:
    assert prose(plain) == printed.replace("_", "\N{NO-BREAK SPACE}")
    assert prose(prose(plain)) == prose(plain)


def test_anchors_are_links_without_escapes() -> None:
    names = [anchor(text) for text in ("3a", "E1", "Fig. 12 b", "α<β>", "a/b")]
    assert names == ["3a", "E1", "Fig.-12-b", "", "a-b"]


def test_durations_grow_with_the_time_and_never_say_sixty_seconds() -> None:
    times = [0.0, 0.0004, 0.2, 0.9994, 0.9996, 9.94, 9.96, 59.4, 59.6, 119.6, 3600.0]
    said = [duration(time) for time in times]
    assert said == [
        *("under 1 ms", "under 1 ms", "200 ms", "999 ms", "1.0 s", "9.9 s", "10 s", "59 s"),
        *("1 min", "2 min", "60 min"),
    ]
    assert all(a != b for a, b in itertools.pairwise(said[1:]))
