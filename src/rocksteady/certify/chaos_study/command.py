"""`rocksteady study chaos`: where motions of the block are proved to be chaotic."""

from pathlib import Path

import typer

from rocksteady.cli.console.progress import progress
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import ScreenFlags, grouped
from rocksteady.cli.flags.study import leave_study, restitution_flag, resumable_study

HELP = (
    "Where motions of the block are proved to be chaotic.\n\n"
    "Proves that every sequence of certain flights is a motion, at two points and over boxes of "
    "amplitude and frequency. Writes certificates, checked in balls and in intervals, maps as "
    "PNG, SVG, PDF and CSV, chaos.json, and the page chaos.html.\n\n"
    "Takes some three minutes. What is finished is kept in the folder, and --resume continues "
    "after whatever ended the run. Needs the extra proof (python-flint)."
)
EXAMPLES = "Example:\n\nrocksteady study chaos --out chaos"


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
    """Run `rocksteady study chaos`; `HELP` is what its users read."""
    from rocksteady.certify.chaos_study import _study as module
    from rocksteady.show.export.folders import check_folder

    check_folder(out, module.OURS, force=force or resume)
    parts = module.parts_of(restitution, out, resume=resume, force=force)
    with resumable_study(parts, context):
        with progress("computing", module.steps()) as done:
            result = module.chaos(restitution, parts=parts, done=done)
        with progress("drawing", result.steps) as done:
            files = result.save(out, force=force or resume, parts=parts, done=done)
    leave_study("chaos", result, output, out, files)
