"""Flags shared by several commands: one spelling, help text and unit each."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from rocksteady.model.blocks.examples import SOURCES


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

Amplitude = Annotated[
    str | None,
    motion_flag(
        "--amplitude -A A",
        "Set the peak base acceleration over alpha g; 1 just lifts a block at rest.",
    ),
]
FrequencyRatio = Annotated[
    str | None,
    motion_flag(
        "--frequency-ratio -W W",
        "Set Omega = omega/p, the circular frequency of the shaking over the block's p.",
    ),
]
AccelG = Annotated[
    str | None,
    motion_flag(
        "--accel-g G", "Set the peak base acceleration in g, instead of -A; needs a block."
    ),
]
AccelMS2 = Annotated[
    str | None,
    motion_flag(
        "--accel-m-s2 ACC", "Set the peak base acceleration in m/s^2, instead of -A; needs a block."
    ),
]
FreqHz = Annotated[
    str | None,
    motion_flag(
        "--freq-hz F", "Set the frequency of the shaking in Hz, instead of -W; needs a block."
    ),
]
HarmonicWaves = Annotated[
    list[str] | None,
    motion_flag(
        "--harmonic K,SIZE,PHASE",
        "Add a harmonic of periodic shaking: order K, size relative to -A, phase \\[rad]; may "
        "be repeated. -W is then that of the period. Default: a single sinusoid.",
    ),
]
PulseName = Annotated[
    str | None,
    motion_flag(
        "--pulse NAME",
        "Shake with a single pulse, after which the base stands still; its size and frequency "
        "are those of -A and -W, or --accel-g and --freq-hz. "
        "Half a period: rectangle, half-sine, versed-sine, triangle, decaying-ramp. A period: "
        "one-sine, one-cosine. About n + 1/2 periods: type-c1, type-c2, type-c3, ... Wavelets: "
        "ricker, ricker-antisymmetric, mavroeidis-papageorgiou (whose nu is --phase).",
    ),
]
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
Oscillations = Annotated[
    float | None,
    motion_flag(
        "--oscillations GAMMA", "Set gamma of --pulse mavroeidis-papageorgiou, above 1; default 2."
    ),
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
SweepStart = Annotated[
    str,
    start_flag(
        "--start START",
        "Where a sweep begins, and begins again after a fall: auto (steady where its first "
        "value has that, else rest), rest, steady or steady:2 (branch 1 or 2 of the first -n), "
        "U,DU (u and du/d(pt)), or U,tau=DU (DU = du/d(omega t)). After a rest it goes on from "
        "rest.",
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
NamedBlock = Annotated[
    str | None,
    block_flag("--block NAME", f"Take a named block: {', '.join(SOURCES)}."),
]
WidthM = Annotated[
    str | None,
    block_flag("--width-m M", "Set the full width of the base \\[m]."),
]
HeightM = Annotated[
    str | None,
    block_flag("--height-m M", "Set the full height \\[m]."),
]
OffsetM = Annotated[
    float | None,
    block_flag(
        "--offset-m M",
        "Move the mass centre off the middle of --width-m \\[m], positive to the right, away "
        "from the left edge, the pivot of positive rotation, as offset_m in files of objects; "
        "default 0. The radius of gyration about the mass centre stays that of the homogeneous "
        "outline.",
    ),
]
MassCentreHeightM = Annotated[
    float | None,
    block_flag(
        "--mass-centre-height-m M",
        "Set the height of the mass centre above the base \\[m], with --width-m and "
        "--height-m; default half of --height-m. The radius of gyration about the mass centre "
        "stays that of the homogeneous outline, unless --gyration-m is given.",
    ),
]
LeftM = Annotated[
    float | None,
    block_flag(
        "--left-m M",
        "Set the distance from the left edge to the mass centre \\[m], with --right-m and "
        "--height-m (twice the height of the mass centre): a block whose sides differ. The left "
        "edge is the pivot of positive rotation, and its side the unit of angles and times.",
    ),
]
RightM = Annotated[
    float | None,
    block_flag("--right-m M", "Set the distance from the right edge to the mass centre \\[m]."),
]
GyrationM = Annotated[
    float | None,
    block_flag(
        "--gyration-m M",
        "Set the radius of gyration about the mass centre \\[m], with --left-m, --offset-m or "
        "--mass-centre-height-m; default that of the homogeneous rectangle of this base and "
        "height.",
    ),
]
AlphaRad = Annotated[
    str | None,
    block_flag(
        "--alpha-rad RAD", "Set the slenderness, the tilt at which the block balances \\[rad]."
    ),
]
RadiusM = Annotated[
    str | None,
    block_flag(
        "--radius-m M",
        "Set the distance from pivot to mass centre \\[m] of a homogeneous rectangle.",
    ),
]
PRadS = Annotated[
    str | None,
    block_flag(
        "--p-rad-s P",
        "Set the frequency parameter sqrt(M g R/I_0) \\[rad/s], instead of --radius-m.",
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
Plot = Annotated[
    Path | None,
    output_flag("--plot FILE", "Save a figure: .png, .svg or .pdf."),
]
Width = Annotated[
    str | None,
    output_flag(
        "--width LENGTH",
        "Set the width of --plot with its unit (mm, cm or in), as 84mm for a journal column.",
    ),
]
Legend = Annotated[
    str | None,
    output_flag(
        "--legend PLACE",
        "Place the legends of --plot: inside, right, below or none; default where there is room.",
    ),
]
Csv = Annotated[
    Path | None,
    output_flag("--csv FILE", "Save the data as CSV."),
]
Animate = Annotated[
    Path | None,
    output_flag("--animate FILE", "Save a film of the block on its moving ground, to scale: .gif."),
]
Speed = Annotated[
    float | None,
    output_flag(
        "--speed X",
        "Set the speed of --animate: seconds of a block (1 is real time), else periods of the "
        "shaking, else pt, per second of film; default 1, or what shows the run well.",
    ),
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
