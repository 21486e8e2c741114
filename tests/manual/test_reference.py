"""The reference of the Python interface: every public name once, and docstrings that link."""

import ast
import inspect
import re
import textwrap
from collections import Counter
from collections.abc import Iterator
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from sphinx.application import Sphinx

from tests.every import every
from tools.manual import docstrings, reference
from tools.manual.types_in_words import in_words, types_of
from tools.namespace import PLACES, THINGS

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
API = DOCS / "reference" / "api"
PAGES = {page.stem: page.read_text(encoding="utf-8") for page in sorted(API.glob("*.md"))}
TABLE = "```{api-table}"
LINK = re.compile(r"\]\(([^)#]+\.md)(?:#[\w-]+)?\)")
EXPLAINING = ("guides", "how-to", "theory")
ROLE = re.compile(r"\{py:\w+\}`(?:[^`<]*<)?~?(rocksteady(?:\.\w+)+)")
SINGLE = re.compile(r"(?<!`)`([A-Za-z_][\w.]*)(?:\(\))?`(?!`)")


# --------------------------------------------------------------------------------------- the pages


def test_every_public_name_is_on_exactly_one_page() -> None:
    count = Counter(name for page in PAGES.values() for name in reference.names_of(page))
    assert {name for name, times in count.items() if times > 1} == set()
    assert set(count) == set(PLACES.values())


@every("name", PAGES)
def test_a_page_begins_with_its_task_where_to_begin_and_what_explains_it(name: str) -> None:
    introduction, table, rest = PAGES[name].partition(TABLE)
    assert table
    assert reference.BLOCK.search(introduction) is None
    assert reference.BLOCK.search(rest)
    title, text = introduction.split("\n\n", 2)[:2]
    assert title.startswith("# ")
    sentences = re.findall(r"[.:](?=\s|$)", text)
    assert 2 <= len(sentences) <= 5
    begin = ROLE.findall(text[text.index("Begin with") :]) if name != "pictures" else ["plot()"]
    assert begin
    if name != "pictures":  # where a function to begin with is another page's, a link leads there
        assert begin[0].removeprefix("rocksteady.") in reference.names_of(PAGES[name])
    targets = [(API / link).resolve() for link in LINK.findall(introduction)]
    assert [link for link in targets if not link.exists()] == []
    assert any(link.parent.name in EXPLAINING for link in targets)


def test_the_entry_page_leads_to_every_page() -> None:
    text = (DOCS / "reference" / "index.md").read_text(encoding="utf-8")
    listed = re.findall(r"^api/([\w-]+)$", text, re.MULTILINE)
    assert sorted(listed) == sorted(PAGES)
    assert {Path(link).stem for link in LINK.findall(text) if link.startswith("api/")} == set(PAGES)


@every(
    "page", [path for path in sorted(DOCS.rglob("*.md")) if ROLE.search(path.read_text("utf-8"))]
)
def test_a_page_names_public_things(page: Path) -> None:
    names = ROLE.findall(page.read_text(encoding="utf-8"))
    assert [name for name in names if docstrings.resolve(name) is None] == []


def test_a_page_becomes_tables_and_directives() -> None:
    page = "# T\n\n```{api-table}\n```\n\n## A\n\n```{api}\nsimulate\nState\n```\n\n## B\n\n"
    page += "```{api}\nsweeps.NO_START\nerrors.InputError\n```\n"
    expanded = reference.expand(page)
    assert reference.names_of(page) == ["simulate", "State", "sweeps.NO_START", "errors.InputError"]
    assert expanded.count("```{eval-rst}\n") == 3
    assert ".. list-table:: A\n" in expanded
    assert ".. list-table:: B\n" in expanded
    assert "* - :py:obj:`simulate() <rocksteady.simulate>`\n     - Compute the time" in expanded
    assert "* - :py:obj:`State <rocksteady.State>`" in expanded
    assert ".. autofunction:: rocksteady.simulate\n" in expanded
    assert ".. autoclass:: rocksteady.State\n" in expanded
    assert ".. autoexception:: rocksteady.errors.InputError\n" in expanded
    assert (
        ".. py:data:: NO_START\n   :module: rocksteady.sweeps\n   :value: -1\n\n   Code of a cell"
        in expanded
    )


def test_pictures_of_the_gallery_that_use_a_name_are_linked(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(reference, "EXAMPLES", tmp_path)
    reference.uses.cache_clear()
    (tmp_path / "maps").mkdir()
    for name in "abcde":
        (tmp_path / "maps" / f"{name}.py").write_text("rs.simulate(rs.State)\n", "utf-8")
    pages = {f"gallery/maps/{name}" for name in "bcde"}
    linked = " · ".join(f":doc:`/gallery/maps/{name}`" for name in "bcd")
    assert reference.pictures("simulate", pages) == f"\n   In the gallery: {linked}\n"
    assert reference.directive("State", pages).endswith(f"State\n\n   In the gallery: {linked}\n\n")
    assert reference.pictures("Rest", pages) == reference.pictures("State", ()) == ""
    reference.uses.cache_clear()


# --------------------------------------------------------------------------------------- docstrings


def documented(name: str) -> Iterator[tuple[str, Any]]:
    """Yield a public thing and its public members that are written in the package."""
    thing = THINGS[name]
    if PLACES[name] in reference.NUMBERS:
        return
    yield name, thing
    for base in thing.__mro__ if isinstance(thing, type) else ():
        for member, value in vars(base).items() if base.__module__.startswith("rocksteady") else ():
            inner = getattr(value, "fget", None) or getattr(value, "func", None) or value
            inner = getattr(inner, "__func__", inner)
            if inspect.isfunction(inner) and (not member.startswith("_") or member == "__call__"):
                yield f"{name}.{member}", inner


def stale(text: str, inside: str, module: str) -> list[str]:
    """Return what a docstring has between single backticks that looks public and is not there."""
    names = vars(__import__(module, fromlist=["__name__"]))
    found = []
    for name in SINGLE.findall(text):
        first, *rest = name.removeprefix("rocksteady.").split(".")
        if docstrings.resolve(name, inside) or (first in names and not rest):
            continue
        if (rest and first in THINGS) or (first[0].isupper() and "_" not in first and not rest):
            found.append(name)
    return found


@every("name", THINGS)
def test_public_names_in_docstrings_are_there(name: str) -> None:
    for place, thing in documented(name):
        text = inspect.getdoc(thing) or ""
        assert stale(text, name, thing.__module__) == [], place


@pytest.mark.slow
@every("name", THINGS)
def test_what_a_docstring_lists_is_a_parameter_or_field_with_a_type(name: str) -> None:
    for place, thing in documented(name):
        lines = (inspect.getdoc(thing) or "").splitlines()
        known = types_of(thing)
        for title, first, end in docstrings.sections(lines):
            if title in {"Parameters", "Attributes"}:
                listed = [line for line in lines[first:end] if line[:1].strip()]
                names = [each.lstrip("*") for line in listed for each in line.split(", ")]
                assert names, place
                assert [each for each in names if each not in known] == [], place


def test_a_name_that_is_gone_would_be_noticed() -> None:
    module = "rocksteady.dynamics.history.simulate"
    text = "`Block`, `Nothing`, `Trajectory.peak`, `Trajectory.top`, `peak`, ``Code`` and `cycles`."
    assert stale(text, "Trajectory", module) == ["Nothing", "Trajectory.top"]


@every(
    ("text", "inside", "target"),
    [
        ("State", None, "rocksteady.State"),
        ("simulate()", None, "rocksteady.simulate"),
        ("rocksteady.histories.Trajectory.peak", None, "rocksteady.histories.Trajectory.peak"),
        (
            "Trajectory.status",
            None,
            "rocksteady.histories.Trajectory.status",
        ),  # a field without default
        ("rocksteady.outcomes.Status", None, "rocksteady.Status"),
        ("at_time", "Trajectory", "rocksteady.histories.Trajectory.at_time"),
        ("at_time", "Block", None),
        ("status", "Trajectory", None),  # a field stands in the list of the class itself
        ("Trajectory._energy", None, None),
        ("Trajectory.nothing", None, None),
        ("alpha", None, None),
        ("rocksteady.outcomes", None, None),
        ("kernels.march.march", None, None),
    ],
)
def test_a_name_between_backticks_links_to_what_is_public(
    text: str, inside: str | None, target: str | None
) -> None:
    assert docstrings.resolve(text, inside) == target


@every(
    ("annotation", "words"),
    [
        ("float | None", "float or None"),
        ("Block | DimensionlessBlock", "`Block` or `DimensionlessBlock`"),
        ("Start | None", "`Rest` or `State` or `Steady` or `ImpactState` or None"),
        ("ArrayLike", "ArrayLike"),
        ("NDArray[np.float64]", "array of float"),
        ("tuple[float, float]", "pair of float"),
        ("tuple[int, float]", "(int, float)"),
        ("tuple[Segment, ...]", "tuple of `Segment`"),
        ("Sequence[Record | BaseMotion]", "sequence of (`Record` or `BaseMotion`)"),
        ("Mapping[str, float]", "mapping of str to float"),
        ("Literal['a', 'b']", "``'a'`` or ``'b'``"),
        ("'xarray.Dataset'", "xarray.Dataset"),
    ],
)
def test_types_are_written_in_words(annotation: str, words: str) -> None:
    node = ast.parse(annotation, mode="eval").body
    assert in_words(node, "rocksteady.dynamics.history.simulate") == words


def test_a_docstring_gets_types_numbers_and_bars() -> None:
    lines = textwrap.dedent("""\
        Sum |u| of `size` and ``|v|`` [1]_.

        Parameters
        ----------
        size, height
            Full `size` [m].
        other
            Unknown.

        Returns
        -------
        list of Record
            Text.

        References
        ----------
        .. [1] A book of many
           pages.

        G. Author, a paper.

        Examples
        --------
        >>> print("|x|")
        |x|""").splitlines()
    docstrings.number_references(lines)
    docstrings.escape_bars(lines)
    docstrings.add_types(lines, {"size": "float", "height": "float"})
    docstrings.unlink_parameters(lines, {"size": "float"})
    assert lines[0] == r"Sum \|u\| of ``size`` and ``|v|`` [1]."
    assert lines[4:8] == ["size, height : float", "    Full ``size`` [m].", "other", "    Unknown."]
    assert lines[11] == "list of `Record`"
    assert lines[16:20] == ["* [1] A book of many", "  pages.", "", r"\G. Author, a paper."]
    assert lines[-1] == "|x|"


# --------------------------------------------------------------------------------------- the build


def settings() -> dict[str, Any]:
    """Return what `docs/conf.py` sets for docstrings."""
    text = (DOCS / "conf.py").read_text(encoding="utf-8")
    [part] = re.findall(r"^# -+ docstrings\n(.*?)^# ---", text, re.DOTALL | re.MULTILINE)
    found: dict[str, Any] = {}
    exec(part, found)
    return {name: value for name, value in found.items() if not name.startswith("__")}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_page_is_built_without_warnings_and_its_members_are_targets(tmp_path: Path) -> None:
    source = tmp_path / "reference" / "api"
    source.mkdir(parents=True)
    known = ["simulate", "Status", "NO_START", "State", "Rest", "Trajectory", "plot_trajectory"]
    known += ["Flights", "Impacts", "Samples", "InputError", "ModelError", "Steady", "ImpactState"]
    names = [PLACES[name] for name in known]
    body = "```{api-table}\n```\n\n```{api}\n" + "\n".join(names) + "\n```\n"
    text = f"(every-result)=\n# Page\n\n{body}"
    (source / "page.md").write_text(text, encoding="utf-8")
    (tmp_path / "index.md").write_text("# Top\n\n```{toctree}\nreference/api/page\n```\n", "utf-8")
    warnings = StringIO()
    extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon", "myst_parser"]
    extensions += ["tools.manual.reference", "tools.manual.docstrings"]
    app = Sphinx(
        tmp_path,
        None,
        tmp_path / "out",
        tmp_path / "trees",
        "html",
        # Defaults as they are written would be left behind in the signatures of the package.
        {"extensions": extensions, **settings(), "autodoc_preserve_defaults": False},
        status=None,
        warning=warnings,
    )
    app.build()
    elsewhere = re.compile(r"reference target not found: rocksteady\.((?:[a-z]+\.)?\w+)")
    for line in warnings.getvalue().splitlines():
        if "already registered" in line:
            continue  # of Sphinx itself, where another test of this process has built a site
        missing = elsewhere.search(line)
        assert missing, line
        assert missing[1] in set(PLACES.values()) - set(names)
    page = (tmp_path / "out" / "reference" / "api" / "page.html").read_text(encoding="utf-8")
    for target in (
        "simulate",
        "sweeps.NO_START",
        "Status.ROCKING",
        "State.angle",
        "histories.Trajectory.status",
    ):
        assert f'id="rocksteady.{target}"' in page
    assert 'href="#rocksteady.histories.Trajectory.at_time"' in page
    objects = app.env.domains.python_domain.objects
    assert objects["rocksteady.histories.Trajectory.summary"].aliased
    contents = app.env.tocs["reference/api/page"].astext()
    assert "Trajectory" in contents
    assert "at_time" not in contents
