"""`rocksteady study atlas`: every steady rocking motion over frequency and amplitude."""

from pathlib import Path
from typing import Any

import typer

from rocksteady.cli.console.progress import progress
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import ScreenFlags, grouped
from rocksteady.cli.flags.parsing import axis, number
from rocksteady.cli.flags.study import leave_study, plane_flag, restitution_flag, resumable_study

HELP = (
    "The plane of frequency and amplitude for one restitution.\n\n"
    "Every stable symmetric, unsymmetric and doubled region of the families n = 1, 3, 5 with exact "
    "borders, how many motions stand side by side, and what a block at rest settles to. Writes "
    "pictures as PNG, SVG and PDF, their data as CSV, atlas.json, and the page atlas.html.\n\n"
    "Takes about 2.5 minutes on two cores. What is finished is kept in the folder, and --resume "
    "continues after whatever ended the run."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady study atlas --out atlas\n\n"
    "rocksteady study atlas -r 0.9 -A 0.1:5:50 -W 0.1:8:80 --out quick"
)


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
    """Run `rocksteady study atlas`; `HELP` is what its users read."""
    from rocksteady.show.export.folders import check_folder
    from rocksteady.studies.atlas import _study as module

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
    leave_study("atlas", result, output, out, files)
