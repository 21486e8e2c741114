"""The explorer inside pages of the manual: directives for a state of it, and for a scene alone."""

from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from sphinx.writers.html5 import HTML5Translator

from rocksteady import write_explorer
from rocksteady.explorer.view import PLACES
from rocksteady.export import ExplorerView

FOLDER = Path(__file__).parents[2] / "build" / "manual" / "explorer"
NAME = "explorer.html"
SCENES = PLACES[:-1]


class explorer(nodes.General, nodes.Element):  # noqa: N801 - docutils calls visit_explorer by it
    """The explorer's page in a frame."""


class ExplorerDirective(SphinxDirective):
    """Show the explorer; its content is the sentence below the frame.

    The options are what a link of the explorer has after ``#v=1&``, the height of the frame and
    its name for those who do not see it.
    """

    has_content = True
    option_spec = {  # noqa: RUF012 - docutils reads it from the class
        "state": directives.unchanged,
        "height": directives.unchanged,
        "title": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        """Return the frame, and the sentence with a link to the page alone."""
        state = str(self.options.get("state", ""))
        frame = explorer(
            fragment=f"#v=1&{state}" if state else "",
            height=str(self.options.get("height", "44rem")),
            title=str(self.options.get("title", "The explorer")),
        )
        frame += self.parse_content_to_nodes()
        return [frame]


class SceneDirective(ExplorerDirective):
    """Show a scene of the explorer alone, as ``{scene} fall``, with a sentence below."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the frame, and the sentence with a link to the scene alone.

        Raises
        ------
        DirectiveError
            If there is no such scene.
        """
        name = self.arguments[0]
        if name not in SCENES:
            raise self.error(f"there is no scene {name}: {', '.join(SCENES)}")
        frame = explorer(
            file=f"scene-{name}.html",
            fragment="",
            height=str(self.options.get("height", "34rem")),
            title=str(self.options.get("title", f"A scene of the explorer: {name}")),
        )
        frame += self.parse_content_to_nodes()
        return [frame]


def _visit(translator: HTML5Translator, node: explorer) -> None:
    builder = translator.builder
    root = "../" * builder.get_target_uri(builder.current_docname).count("/")
    name = node.get("file", NAME)
    address = translator.attval(f"{root}_static/{name}{node['fragment']}")
    title = translator.attval(node["title"])
    height = translator.attval(node["height"])
    translator.body.append(
        f'<div class="explorer"><iframe src="{address}" title="{title}" loading="lazy" '
        f'style="height: {height}"></iframe>'
        f'<p class="alone"><a href="{address}">Open it in a page of its own</a></p>'
    )


def _depart(translator: HTML5Translator, _: explorer) -> None:
    translator.body.append("</div>\n")


def static_path() -> list[str]:
    """Write the explorer's page and its scenes, and return the folder that the site takes over."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_explorer(FOLDER / NAME)
    for scene in SCENES:
        view = ExplorerView(scene=scene)
        write_explorer(FOLDER / f"scene-{scene}.html", view, embed=True)
    return [str(FOLDER)]


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the directive."""
    app.add_node(explorer, html=(_visit, _depart))
    app.add_directive("explorer", ExplorerDirective)
    app.add_directive("scene", SceneDirective)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
