"""`rocksteady study`: studies of the block itself, each a folder of pictures, data and a page."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import typer

from rocksteady.cli.console.help import HelpfulGroup
from rocksteady.cli.console.progress import progress
from rocksteady.cli.console.refusals import OncePerFlag
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags import options
from rocksteady.cli.flags.ensemble import Suite, SuiteFlags
from rocksteady.cli.flags.groups import ScreenFlags, grouped
from rocksteady.cli.flags.parsing import axis, number, values_of
from rocksteady.cli.flags.record_files import ReadingFlags
from rocksteady.cli.flags.sweep import resumable_study, workers_flag
from rocksteady.results.description import Description

HELP = "Run a study into a folder: atlas, chaos, facade-checks."
ATLAS_HELP = (
    "The plane of frequency and amplitude for one restitution.\n\n"
    "Every stable symmetric, unsymmetric and doubled region of the families n = 1, 3, 5 with exact "
    "borders, how many motions stand side by side, and what a block at rest settles to. Writes "
    "pictures as PNG, SVG and PDF, their data as CSV, atlas.json, and the page atlas.html.\n\n"
    "Takes about 2.5 minutes on two cores. What is finished is kept in the folder, and --resume "
    "continues after whatever ended the run."
)
ATLAS_EXAMPLES = (
    "Examples:\n\n"
    "rocksteady study atlas --out atlas\n\n"
    "rocksteady study atlas -r 0.9 -A 0.1:5:50 -W 0.1:8:80 --out quick"
)
FACADE_HELP = (
    "Where linear, nonlinear static and dynamic checks of a facade disagree.\n\n"
    "Bare walls over slenderness and height, checked in the three ways of Circolare 2019 n. 7, "
    "with the demand of all three from the same records. Writes maps of the verdicts and of demand "
    "over capacity, two walls on which the checks disagree with the reasons, the data as CSV, "
    "facade-checks.json, and the page facade-checks.html.\n\n"
    "Takes a minute or two with the default of 10 synthetic motions, some five with 50 records. "
    "What is finished is kept in the folder, and --resume continues after whatever ended the run."
)
FACADE_EXAMPLES = (
    "Examples:\n\n"
    "rocksteady study facade-checks --out checks\n\n"
    "rocksteady study facade-checks --records suite --pga-g 0.2,0.3 --height-m 3:9:4 "
    "--out own\n\n"
    "Your folder of records: suite."
)

CHAOS_HELP = (
    "Where motions of the block are proved to be chaotic.\n\n"
    "Proves that every sequence of certain flights is a motion, at two points and over boxes of "
    "amplitude and frequency. Writes certificates, checked in balls and in intervals, maps as "
    "PNG, SVG, PDF and CSV, chaos.json, and the page chaos.html.\n\n"
    "Takes some three minutes. What is finished is kept in the folder, and --resume continues "
    "after whatever ended the run. Needs the extra proof (python-flint)."
)
CHAOS_EXAMPLES = "Example:\n\nrocksteady study chaos --out chaos"

app = typer.Typer(cls=HelpfulGroup, no_args_is_help=True, rich_markup_mode="rich")

plane_flag = options.Panel("Plane")
wall_flag = options.Panel("Walls and records")
restitution_flag = plane_flag(
    "--restitution -r R",
    "Ratio of angular velocities after and before an impact, in (0, 1).",
    default="0.8",
)


@app.callback()
def study() -> None:
    """Run a study; `HELP` is what its users read."""


@app.command("atlas", cls=OncePerFlag, help=ATLAS_HELP, epilog=ATLAS_EXAMPLES)
@grouped
def atlas(
    context: typer.Context,
    out: Path = options.out_folder(),
    restitution: str = restitution_flag,
    amplitude: str | None = plane_flag(
        "--amplitude -A AXIS",
        "Rows of the maps, a_max over alpha g, as start:stop:count; default 0.08:8:100.",
    ),
    frequency_ratio: str | None = plane_flag(
        "--frequency-ratio -W AXIS",
        "Columns of the maps, omega/p, as start:stop:count; default 0.075:12:160. The time "
        "goes with rows times columns.",
    ),
    order: list[int] | None = plane_flag(
        "--order -n N",
        "Family whose regions are followed, odd; may be repeated; default 1, 3 and 5.",
    ),
    force: bool = options.force(),
    resume: bool = options.resume_study(),
    *,
    output: ScreenFlags,
) -> None:
    """Run `rocksteady study atlas`; `ATLAS_HELP` is what its users read."""
    from rocksteady.show.export.folders import check_folder
    from rocksteady.studies.atlas import study as module

    arguments: dict[str, Any] = {"restitution": number("restitution", restitution)}
    for name, text in (("amplitude", amplitude), ("frequency_ratio", frequency_ratio)):
        if text is not None:
            arguments[name] = axis(name, text)
    if order:
        arguments["orders"] = tuple(order)
    plane = module.plane_of(**arguments)
    check_folder(out, module.OURS, force=force or resume)
    parts = module.parts_of(plane, out, resume=resume, force=force)
    with resumable_study(parts, context):
        with progress("computing", module.steps(plane)) as done:
            result = module.atlas(**arguments, parts=parts, done=done)
        with progress("drawing", result.steps) as done:
            files = result.save(out, force=force or resume, parts=parts, done=done)
    _leave("atlas", result, output, out, files)


@app.command("chaos", cls=OncePerFlag, help=CHAOS_HELP, epilog=CHAOS_EXAMPLES)
@grouped
def chaos(
    context: typer.Context,
    out: Path = options.out_folder(),
    restitution: str = restitution_flag,
    force: bool = options.force(),
    resume: bool = options.resume_study(),
    *,
    output: ScreenFlags,
) -> None:
    """Run `rocksteady study chaos`; `CHAOS_HELP` is what its users read."""
    from rocksteady.show.export.folders import check_folder
    from rocksteady.studies.chaos import study as module

    check_folder(out, module.OURS, force=force or resume)
    parts = module.parts_of(restitution, out, resume=resume, force=force)
    with resumable_study(parts, context):
        with progress("computing", module.steps()) as done:
            result = module.chaos(restitution, parts=parts, done=done)
        with progress("drawing", result.steps) as done:
            files = result.save(out, force=force or resume, parts=parts, done=done)
    _leave("chaos", result, output, out, files)


@app.command("facade-checks", cls=OncePerFlag, help=FACADE_HELP, epilog=FACADE_EXAMPLES)
@grouped
def facade_checks(
    context: typer.Context,
    out: Path = options.out_folder(),
    records: list[Path] | None = wall_flag(
        "--records DIR|FILE",
        "Read ground motions, 7 or more: every file of a folder, or a file; several times for "
        "more. Default: 10 synthetic motions.",
    ),
    height_m: str | None = wall_flag(
        "--height-m AXIS", "Rows of the maps: heights \\[m] as start:stop:count; default 2:12:11."
    ),
    slenderness: str | None = wall_flag(
        "--slenderness AXIS",
        "Columns of the maps: height over thickness as start:stop:count; default 5:25:21.",
    ),
    pga_g: str | None = wall_flag(
        "--pga-g LIST", "Scale each record to these PGA in g, one map each; default 0.15,0.25,0.35."
    ),
    confidence_factor: str = wall_flag(
        "--confidence-factor FC",
        "Set the confidence factor of all walls, from 1 to 2.",
        default="1",
    ),
    workers: int | None = workers_flag(),
    force: bool = options.force(),
    resume: bool = options.resume_study(),
    *,
    output: ScreenFlags,
) -> None:
    """Run `rocksteady study facade-checks`; `FACADE_HELP` is what its users read."""
    from rocksteady.seismic.spectra.grounds import grounds_of
    from rocksteady.show.export.folders import check_folder
    from rocksteady.studies.facade_checks import study as module
    from rocksteady.sweep.run import Execution

    axes = {
        name: values_of(f"--{name.replace('_', '-')}", text)
        for name, text in (
            ("height_m", height_m),
            ("slenderness", slenderness),
            ("pga_g", pga_g),
        )
        if text is not None
    }
    how = Execution(workers=workers)
    suite = SuiteFlags(records=records).suite(ReadingFlags()) if records else None
    read = [] if suite is None else suite.read
    check_folder(out, module.OURS, force=force or resume, read=read)
    plane = module.plane_of(
        [] if suite is None else [ground.record for ground in grounds_of(suite.motions)],
        **axes,
        confidence_factor=number("--confidence-factor", confidence_factor),
    )
    parts = module.parts_of(plane, out, resume=resume, force=force)
    with resumable_study(parts, context):
        with progress("computing", module.study_steps()) as done:
            result = module.facade_checks(plane, run=how, parts=parts, done=done)
        with progress("drawing", result.steps) as done:
            files = result.save(out, force=force or resume, parts=parts, done=done)
    _leave("facade-checks", result, output, out, files, suite=suite)


def _leave(
    name: str,
    result: Any,
    output: ScreenFlags,
    out: Path,
    files: list[Path],
    *,
    suite: Suite | None = None,
) -> None:
    """Print what came out, how many files there are, and how to open the page."""
    values = {**result.values(), "out": str(out), "files": [file.name for file in files]}
    page = quoted(out / f"{name}.html")
    answer = replace(
        result.answer,
        facts=[*result.answer.facts, ("files", f"{len(files)} in {out}")],
        follow_up=f"python3 -m webbrowser {page}",
    )
    first, *texts = (
        text.replace("\N{NO-BREAK SPACE}", " ") for text in (answer.sentence, *result.sentences)
    )
    description = Description(first, notes=texts, answer=replace(answer, sentence=first))
    output.leave(name, description, values=values, suite=suite)
