"""Writing the explorer: one HTML file that needs no other, no server and no network."""

from collections.abc import Sequence
from pathlib import Path

from rocksteady.errors import InputError, OutputError, Words
from rocksteady.explorer._module import page_module
from rocksteady.explorer._motions import motions_of
from rocksteady.explorer._page import document, scene_document
from rocksteady.explorer._program import SCENES
from rocksteady.explorer.view import ExplorerView, is_plain, state_of
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.record import Record
from rocksteady.records.core.recording import Recording
from rocksteady.show.export.files import refuse_read, save_text

ENDINGS = (".html", ".htm")
"""Of a page's file, in any case."""


@checked
def write_explorer(
    path: Path | str,
    view: ExplorerView | None = None,
    *,
    records: Sequence[Record | Recording] | None = None,
    embed: bool = False,
) -> Path:
    """Write the explorer, a page that computes while it is touched, into one HTML file.

    The kernels are inside as WebAssembly, and give the same numbers as here, to the last bit.  A
    browser opens the file without a server: ``webbrowser.open(path.as_uri())``.

    Parameters
    ----------
    path
        The file, .html, which is replaced.
    view
        What it shows first; default a block that rocks under harmonic shaking.
    records
        Ground motions for its earthquake tab, 30 MB at most; none by default.
    embed
        Whether the file holds one scene alone, that of the view, small enough to stand in a frame
        of another page; default False.

    Returns
    -------
    Path
        The file, with its whole path.

    Raises
    ------
    MissingKernelsError
        If this installation has no WebAssembly module of its kernels.
    InputError
        If the records are too large, or what is embedded is no scene alone.
    OutputError
        If the file has another ending, is one of the records, or cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import Block, Harmonic, write_explorer
    >>> from rocksteady.export import ExplorerView
    >>> rack = Block.rectangle(width=0.6, height=2.0)
    >>> shaking = Harmonic.from_si(rack, acceleration_m_s2=4.0, frequency_hz=1.5)
    >>> with TemporaryDirectory() as folder:
    ...     page = write_explorer(f"{folder}/rack.html", ExplorerView(block=rack, motion=shaking))
    ...     page.name, page.read_text(encoding="utf-8")[:15]
    ('rack.html', '<!doctype html>')
    """
    file = Path(path)
    check_ending("path", file)
    refuse_read("path", file, [each.path for each in records or () if isinstance(each, Recording)])
    shown = view or ExplorerView()
    if embed:
        text = scene_document(scene_alone(shown, records), module=page_module().read_bytes())
    else:
        motions = motions_of(records or ())
        state = state_of(shown, on_records=bool(motions))
        text = document(state=state, motions=motions, module=page_module().read_bytes())
    save_text("path", file, text)
    return file.absolute()


def scene_alone(view: ExplorerView, records: Sequence[Record | Recording] | None) -> str:
    """Return the scene of a view that holds nothing else.

    Raises
    ------
    InputError
        If there is none, or a scene takes none of what else is given.
    """
    if view.scene not in SCENES:
        raise InputError(
            "embed",
            Words("is given without a scene") if view.scene is None else view.scene,
            f"one scene stands alone: {', '.join(SCENES)}",
            "give the view a scene, or leave embed out",
        )
    if records or not is_plain(view):
        raise InputError(
            "embed", True, "a scene has its own blocks and motions", "leave the others out"
        )
    return view.scene


def check_ending(name: str, file: Path) -> None:
    """Refuse a file that browsers would not take for a page.

    Raises
    ------
    OutputError
        If its ending is another one.
    """
    if file.suffix.lower() not in ENDINGS:
        raise OutputError(name, file, "browsers need the extension .html", "rename it")
