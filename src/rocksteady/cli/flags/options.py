"""Flags shared by several commands: one spelling, help text and unit each."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer


def flags_in(panel: str) -> Callable[[str, str], Any]:
    """Return what makes the flags of a panel of `--help`.

    Its arguments are the names of a flag with what stands for its value, as "--amplitude -A A",
    and the help.
    """

    def flag(words: str, help: str) -> Any:  # noqa: A002 -- the name that typer has for it
        names = [each for each in words.split() if each.startswith("-")]
        metavar = next(iter(words.split()[len(names) :]), None)
        return typer.Option(*names, metavar=metavar, help=help, rich_help_panel=panel)

    return flag


block_flag = flags_in("Block")
motion_flag = flags_in("Base motion")
start_flag = flags_in("Start and length")
output_flag = flags_in("Output")

FLAG_OF_ARGUMENT = {
    "amplitude": "--amplitude/-A",
    "frequency_ratio": "--frequency-ratio/-W",
    "restitution": "--restitution/-r",
    "order": "--order/-n",
    "width": "--width-m",
    "height": "--height-m",
    "alpha": "--alpha-rad",
    "radius": "--radius-m",
    "p": "--p-rad-s",
    "gravity": "--gravity-m-s2",
    "time_pt": "--at-pt",
    "left": "--left-m",
    "right": "--right-m",
    "gyration": "--gyration-m",
    "alpha_ratio": "--left-m/--right-m/--offset-m",
    "p_ratio": "--left-m/--right-m/--offset-m",
    "negative_restitution": "--restitution/-r",
    "one_sided": "--one-sided",
    "wall_restitution": "--restitution/-r",
    "acceleration_m_s2": "--accel-g/--accel-m-s2",
    "frequency_hz": "--freq-hz",
    "phase": "--phase",
    "shape": "--pulse",
    "harmonics": "--harmonic",
    "oscillations": "--oscillations",
    "cycles": "--cycles",
    "max_cycles": "--cycles",
    "start": "--start",
    "angle": "--start",
    "velocity": "--start",
    "side": "--side",
    "kick": "--kick",
    "max_period": "--max-period",
    "max_impacts": "--max-impacts",
    "max_branches": "--max-branches",
    "max_curves": "--max-curves",
    "length": "--length",
    "other": "--other",
    "doublings": "--doublings",
    "top": "--top",
    "seeds": "--seeds",
    "seed": "--seed",
    "angles": "--angles",
    "velocities": "--velocities",
    "box": "--entropy",
    "sizes": "--exponent",
    "amplitudes": "--amplitude/-A",
    "frequency_ratios": "--frequency-ratio/-W",
    "resolution": "--resolution",
    "name": "--block",
    "per_unit": "--samples",
    "speed": "--speed",
    "model": "--model",
    "tab": "--tab",
    "tolerance": "--tolerance",
    "out": "--out",
    "only": "--only",
    "store": "--out",
    "executor": "--executor",
    "workers": "--workers",
    "chunk": "--chunk",
    "refine": "--refine",
    "orders": "--order/-n",
    "channel": "--channel",
    "format": "--format",
    "units": "--units",
    "dt_s": "--dt-s",
    "column": "--column",
    "resample": "--resample",
    "baseline": "--baseline",
    "damping": "--damping",
    "period": "--periods-s",
    "periods_s": "--periods-s",
    "records": "--record",
    "scale": "--scale",
    "scales": "--scale",
    "pga_g": "--pga-g",
    "motions": "--record",
    "pgv_m_s": "--pgv-m-s",
    "friction": "--friction",
    "spectrum": "--spectrum",
    "spectrum_damping": "--damping",
    "sa_v_per_sa_h": "--vertical-per-horizontal",
    "vertical_g": "--vertical-g",
    "vertical_share": "--vertical-share",
    "vertical": "--vertical",
    "by": "--by",
    "legend": "--legend",
    "width_mm": "--width",
}
"""Which flag an argument of the library is, for error lines."""

Model = Annotated[
    str | None,
    block_flag(
        "--model NAME",
        "Choose the equations of motion: linear (slender blocks, in closed form) or nonlinear "
        "(the full equations, which need a block). Default: nonlinear for a block under a pulse or "
        "a record, or rocking freely; else linear.",
    ),
]
Tolerance = Annotated[
    float | None,
    block_flag("--tolerance X", "Set the relative error of the nonlinear motion; default 1e-10."),
]
Restitution = Annotated[
    str | None,
    block_flag(
        "--restitution -r R",
        "Set the ratio of angular velocities after and before an impact, in (0, 1], "
        "'housner' (default for a block) or a measured factor of it, as 'housner*0.965'; two with "
        "a comma, as 0.8,0.9, for the impact that ends positive rotation and for the other.",
    ),
]
OneSided = Annotated[
    bool | None,
    block_flag(
        "--one-sided",
        "Stand the block against a wall, which it leaves on its positive side alone; "
        "--restitution, in \\[0, 1], is then that of the wall: default of a block 'housner', "
        "from angular momentum.",
    ),
]
Order = Annotated[
    int,
    motion_flag(
        "--order -n N",
        "Set the half periods of the shaking in one half cycle, odd: 1 harmonic, 3 the 1/3 "
        "subharmonic.",
    ),
]
Orders = Annotated[
    list[int] | None,
    motion_flag(
        "--order -n N",
        "Set the half periods of the shaking in one half cycle, odd: 1 harmonic (default), 3 "
        "the 1/3 subharmonic; may be repeated.",
    ),
]
Start = Annotated[
    str,
    start_flag(
        "--start START",
        "Start at rest; on steady or steady:2 (branch 1 or 2 of order -n); at U,V (u and "
        "du/d(pt)); or at U,tau=DU (DU = du/d(omega t)).",
    ),
]
Side = Annotated[
    str,
    start_flag(
        "--side +|-",
        "Choose the side of its unstable direction on which an unstable state is left.",
    ),
]
Kick = Annotated[
    float | None,
    start_flag(
        "--kick K",
        "Set the distance from an unstable steady state at the start; default 1e-6: length of "
        "(phase \\[rad], velocity over the orbit's).",
    ),
]
Phase = Annotated[
    float | None,
    start_flag(
        "--phase RAD",
        "Set the phase of the shaking at the start \\[rad], not with --start steady; default 0.",
    ),
]
GravityMS2 = Annotated[
    float | None,
    block_flag("--gravity-m-s2 G", "Set the acceleration of gravity \\[m/s^2]; default 9.80665."),
]
Json = Annotated[
    bool,
    output_flag("--json", "Print one JSON object on standard output, nothing else."),
]
Csv = Annotated[
    Path | None,
    output_flag("--csv FILE", "Save the data as CSV."),
]
Force = Annotated[
    bool,
    output_flag("--force", "Overwrite files that exist."),
]
OutFolder = Annotated[
    Path,
    output_flag("--out DIR", "Write into this folder; made if it does not exist."),
]
ResumeStudy = Annotated[
    bool,
    output_flag(
        "--resume",
        "Continue the study in the folder where it stopped; begin it if it does not exist.",
    ),
]
