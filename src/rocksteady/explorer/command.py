"""`rocksteady explore`: the explorer, a page that computes while it is touched."""

import os
import shutil
import sys
import tempfile
import webbrowser
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rocksteady.cli.commands.record import all_recordings
from rocksteady.cli.console.outputs import announce_file
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import (
    BlockFlags,
    ShakingFlags,
    equations_for,
    named_model,
)
from rocksteady.cli.flags.groups import ScreenFlags, grouped
from rocksteady.cli.flags.parsing import single
from rocksteady.cli.flags.record_files import (
    ReadingFlags,
    RecordFlags,
    scale_flag,
    warn,
    warn_across,
)
from rocksteady.cli.flags.start import StartFlags
from rocksteady.errors import ModelError, OutputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.facts import peak_unit
from rocksteady.results.description import Description, Fact, line
from rocksteady.results.numbers import number, quantity
from rocksteady.show.export.files import check_writable, refuse_read

if TYPE_CHECKING:
    from rocksteady.explorer.view import ExplorerView
    from rocksteady.model.equations import Model
    from rocksteady.model.motions.segments import Harmonic
    from rocksteady.records.core.recording import Recording

HELP = (
    "Write an interactive page, one HTML file.\n\n"
    "The explorer: an interactive page in one HTML file that computes by itself.\n\n"
    "It opens with a block on the ground to push, six scenes of one idea each, and a laboratory. "
    "Drag the point on the map of motions, and time history, phase portrait, sweeps, basins, "
    "pulses, ground motions and design charts follow at once. The page holds the kernels of "
    "this program and gives the same numbers; it needs no server and no network. Without --out "
    "it is written into a temporary folder."
)
MAIN = "width_m height_m restitution amplitude frequency_ratio record tab scene out no_browser"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady explore\n\n"
    "rocksteady explore --scene fall --embed --out fall.html\n\n"
    "rocksteady explore -A 2 -W 6 -r 0.8 --out explorer.html\n\n"
    "rocksteady explore --width-m 0.6 --height-m 2 --accel-g 0.4 --freq-hz 1.5\n\n"
    "rocksteady explore --block server-rack --record example:near-fault --scale 0.8"
)
FILE = "explorer.html"
"""Name of the page in a temporary folder."""


@grouped
def explore(
    block: BlockFlags,
    shaking: ShakingFlags,
    reading: ReadingFlags,
    record: list[Path] | None = options.motion_flag(
        "--record FILE",
        "Put the horizontal channels of a ground-motion file into the page, or the channel "
        "named by --channel; may be repeated. The page then opens on them.",
    ),
    scale: str | None = scale_flag(),
    start: str = options.start(),
    model: str | None = options.model(),
    tab: str | None = options.output_flag(
        "--tab NAME",
        "Open on shake, start, quake or size, or for researchers on explore, basins, pulse or "
        "design; default quake with --record, else shake, or explore with a start, linear "
        "equations or no size.",
    ),
    scene: str | None = options.output_flag(
        "--scene NAME",
        "Open at push, swing, size, fall, fates, order, quake or lab; default lab where a block, "
        "a motion or a tab is given, else push.",
    ),
    embed: bool = options.output_flag(
        "--embed", "Write the scene of --scene alone, for a frame of another page.", default=False
    ),
    out: Path | None = options.output_flag("--out FILE", "Keep the page in this file: .html."),
    no_browser: bool = options.output_flag(
        "--no-browser", "Write the page without opening it, as --json does too.", default=False
    ),
    force: bool = options.force(),
    *,
    output: ScreenFlags,
) -> None:
    """Run `rocksteady explore`; `HELP` is what its users read."""
    files = record or []
    check_file(out, files, force=force)
    recorded = RecordFlags(record=record, scale=scale)
    recorded.given(reading, on_floor=shaking.given)
    from rocksteady.explorer._module import page_module

    page_module()  # refused before anything is read
    body = block.described() if block.given else None
    motion = first_motion(shaking, body)
    if motion is not None:
        motion = replace(reading.on_floor(motion, body), phase=0.0)
    from rocksteady.explorer.view import ExplorerView

    begin = StartFlags(start=start).of(motion.frequency_ratio if motion else None)
    try:
        view = ExplorerView(
            block=body,
            motion=motion,
            start=begin,
            model=equations(model, body),
            tab=tab,
            scene=scene,
            scale=single("--scale", recorded.scales),
        )
    except ModelError as error:
        raise in_flags(error, block, start) from error
    recordings = across(files, reading)
    file = write(out, view, recordings, embed=embed)
    output.leave("explore", described(file, out or file, view, recordings))
    if not (output.as_json or no_browser):
        show(file)


def check_file(out: Path | None, read: Sequence[Path], *, force: bool) -> None:
    """Refuse, before anything is computed, a file that could not be written.

    Raises
    ------
    OutputError
        If it exists and --force is off, its folder is missing or not writable, no browser would
        take it for a page, or the command reads it.
    FlagError
        If there is none, and --force.
    """
    if out is None:
        if force:
            valid = "without --out the page is always a new file"
            raise FlagError("--force", True, valid, "add --out FILE, or leave it out")
        return
    from rocksteady.explorer.write import check_ending

    check_ending("--out", out)
    refuse_read("--out", out, read)
    check_writable("--out", out, force=force)


def first_motion(
    shaking: ShakingFlags, body: Block | DimensionlessBlock | None
) -> "Harmonic | None":
    """Return the shaking of the first view, with the page's default for a missing value.

    Raises
    ------
    InputError, ModelError
        As for `ShakingFlags.at`.
    """
    from rocksteady.explorer.view import DEFAULT_MOTION

    if not shaking.given:
        return None
    if (shaking.amplitude, shaking.accel_g, shaking.accel_m_s2) == (None, None, None):
        shaking = replace(shaking, amplitude=repr(DEFAULT_MOTION.amplitude))
    if (shaking.frequency_ratio, shaking.freq_hz) == (None, None):
        shaking = replace(shaking, frequency_ratio=repr(DEFAULT_MOTION.frequency_ratio))
    return shaking.at(DimensionlessBlock(restitution=1.0) if body is None else body)


def equations(model: str | None, body: Block | DimensionlessBlock | None) -> "Model | None":
    """Return the equations of motion of --model; None where it is not given.

    Raises
    ------
    InputError, ModelError
        As for `equations_for`.
    """
    if model is None:
        return None
    return named_model(model) if body is None else equations_for(model, body)


def in_flags(error: ModelError, block: BlockFlags, start: str) -> ModelError:
    """Return the error of a view in the words of the flags that made it."""
    if error.name == "start":
        return FlagError("--start", start, error.valid, "give --start steady without further flags")
    if error.name != "block":
        return error
    if block.block is not None:
        return FlagError("--block", block.block, error.valid, error.hint)
    if error.value in ("asymmetric", "against a wall"):
        return block.refuse_sides(error.valid, "give a free block of equal sides")
    flags = [
        flag
        for flag, value in (
            ("--gyration-m", block.gyration_m),
            ("--mass-centre-height-m", block.mass_centre_height_m),
            ("--columns", block.columns),
            ("--cap-mass-ratio", block.cap_mass_ratio),
        )
        if value is not None
    ]
    return FlagError(
        finding=f"{' and '.join(flags)} make a block with {error.value}",
        valid=error.valid,
        hint="leave them out",
    )


def across(files: Sequence[Path], reading: ReadingFlags) -> "list[Recording]":
    """Return the horizontal channels of each file; of one that has none, its other channels.

    Raises
    ------
    InputError
        If a file cannot be read.
    """
    from rocksteady.records.suite import INCLUDABLE, select, suite_words

    channels_across: list[Recording] = []
    for file in files:
        channels = all_recordings([file], reading)
        level, others = select(channels, INCLUDABLE if reading.channel else ())
        if level and others:
            warn(file, f"{suite_words(level, others)}; --channel takes one")
        level = level or select(channels, INCLUDABLE)[0] or tuple(channels)
        for each in level:
            warn_across(each)
        channels_across += level
    return channels_across


def write(
    out: Path | None, view: "ExplorerView", recordings: "Sequence[Recording]", *, embed: bool
) -> Path:
    """Write the page and return its file, in a new private folder by default."""
    from rocksteady.explorer.write import write_explorer

    if out is not None:
        try:
            file = write_explorer(out, view, records=recordings, embed=embed)
        except OutputError as error:
            raise OutputError("--out", out, error.valid, error.hint) from error
        announce_file(out)
        return file
    folder = Path(tempfile.mkdtemp(prefix="rocksteady-"))  # this user alone can enter it
    try:
        return write_explorer(folder / FILE, view, records=recordings, embed=embed)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise


def described(
    file: Path, given: Path, view: "ExplorerView", recordings: "Sequence[Recording]"
) -> Description:
    """Return where the page is and what it shows first."""
    from rocksteady.explorer.view import state_of

    size = file.stat().st_size
    state = state_of(view, on_records=bool(recordings))
    names = [each.name for each in recordings]
    facts = [
        line("opens on", opening(view, state)),
        line("records", ", ".join(names)),
        Fact("file", str(file), "file"),
        Fact("bytes", size, "size", f"{size / 1e3:.0f} kB"),
        Fact("scene", state["at"], "opens at"),
        Fact("tab", state["tab"], "tab" if state["at"] == "lab" else ""),
        Fact("model", state["model"], "model"),
        Fact("view", state),
        Fact("records", names, "records" if names else "", ", ".join(names)),
    ]
    return Description(
        "the explorer, in one file for any browser",
        facts,
        sentence=f"Wrote {given} ({size / 1e3:.0f} kB): open it in any browser; it computes by "
        "itself, offline.",
        follow_up=f"python3 -m webbrowser {quoted(given)}",
    )


def opening(view: "ExplorerView", state: dict[str, str]) -> str:
    """Return the initial view of the page: block, shaking in its units, and tab; or the scene."""
    if state["at"] != "lab":
        return f"scene {state['at']}"
    block = view.block or DimensionlessBlock(restitution=1.0)
    words = [] if view.block is None else [block.describe().headline]
    if view.motion is not None:
        ratio = f"W = {number(view.motion.frequency_ratio)}"
        if isinstance(block, Block):
            ratio = quantity(view.motion.frequency_hz(block), "Hz")
        words.append(f"{peak_unit(block, view.motion.amplitude)} and {ratio}")
    return ", ".join([*words, f"tab {state['tab']}"])


def show(file: Path) -> bool:
    """Open a file in the browser; return whether there was one.

    Without a window system nothing is opened: a browser in the terminal shows no page with a
    script, and would hold the program.
    """
    if not has_window():
        return False
    try:
        return webbrowser.open(file.as_uri())
    except (webbrowser.Error, OSError):
        return False


def has_window() -> bool:
    """Return whether there is a window system, or a browser that the user has named."""
    named = ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY")
    return sys.platform in {"win32", "darwin"} or any(map(os.environ.get, named))
