"""Flags shared by several commands: one spelling, help text and unit each."""

from pathlib import Path
from typing import Annotated

import typer

from rocksteady.model.blocks.examples import SOURCES

BLOCK = "Block"
MOTION = "Base motion"
START = "Start and length"
OUTPUT = "Output"

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
    typer.Option(
        "--amplitude",
        "-A",
        metavar="A",
        help="Set the peak base acceleration over alpha g; 1 just lifts a block at rest.",
        rich_help_panel=MOTION,
    ),
]
FrequencyRatio = Annotated[
    str | None,
    typer.Option(
        "--frequency-ratio",
        "-W",
        metavar="W",
        help="Set Omega = omega/p, the circular frequency of the shaking over the block's p.",
        rich_help_panel=MOTION,
    ),
]
AccelG = Annotated[
    str | None,
    typer.Option(
        "--accel-g",
        metavar="G",
        help="Set the peak base acceleration in g, instead of -A; needs a block.",
        rich_help_panel=MOTION,
    ),
]
AccelMS2 = Annotated[
    str | None,
    typer.Option(
        "--accel-m-s2",
        metavar="ACC",
        help="Set the peak base acceleration in m/s^2, instead of -A; needs a block.",
        rich_help_panel=MOTION,
    ),
]
FreqHz = Annotated[
    str | None,
    typer.Option(
        "--freq-hz",
        metavar="F",
        help="Set the frequency of the shaking in Hz, instead of -W; needs a block.",
        rich_help_panel=MOTION,
    ),
]
HarmonicWaves = Annotated[
    list[str] | None,
    typer.Option(
        "--harmonic",
        metavar="K,SIZE,PHASE",
        help="Add a harmonic of periodic shaking: order K, size relative to -A, phase \\[rad]; may "
        "be repeated. -W is then that of the period. Default: a single sinusoid.",
        rich_help_panel=MOTION,
    ),
]
PulseName = Annotated[
    str | None,
    typer.Option(
        "--pulse",
        metavar="NAME",
        help="Shake with a single pulse, after which the base stands still; its size and frequency "
        "are those of -A and -W, or --accel-g and --freq-hz. "
        "Half a period: rectangle, half-sine, versed-sine, triangle, decaying-ramp. A period: "
        "one-sine, one-cosine. About n + 1/2 periods: type-c1, type-c2, type-c3, ... Wavelets: "
        "ricker, ricker-antisymmetric, mavroeidis-papageorgiou (whose nu is --phase).",
        rich_help_panel=MOTION,
    ),
]
Model = Annotated[
    str | None,
    typer.Option(
        "--model",
        metavar="NAME",
        help="Choose the equations of motion: linear (slender blocks, in closed form) or nonlinear "
        "(the full equations, which need a block). Default: nonlinear for a block under a pulse or "
        "a record, or rocking freely; else linear.",
        rich_help_panel=BLOCK,
    ),
]
Tolerance = Annotated[
    float | None,
    typer.Option(
        "--tolerance",
        metavar="X",
        help="Set the relative error of the nonlinear motion; default 1e-10.",
        rich_help_panel=BLOCK,
    ),
]
Oscillations = Annotated[
    float | None,
    typer.Option(
        "--oscillations",
        metavar="GAMMA",
        help="Set gamma of --pulse mavroeidis-papageorgiou, above 1; default 2.",
        rich_help_panel=MOTION,
    ),
]
Restitution = Annotated[
    str | None,
    typer.Option(
        "--restitution",
        "-r",
        metavar="R",
        help="Set the ratio of angular velocities after and before an impact, in (0, 1], "
        "'housner' (default for a block) or a measured factor of it, as 'housner*0.965'; two with "
        "a comma, as 0.8,0.9, for the impact that ends positive rotation and for the other.",
        rich_help_panel=BLOCK,
    ),
]
OneSided = Annotated[
    bool | None,
    typer.Option(
        "--one-sided",
        help="Stand the block against a wall, which it leaves on its positive side alone; "
        "--restitution, in \\[0, 1], is then that of the wall: default of a block 'housner', "
        "from angular momentum.",
        rich_help_panel=BLOCK,
    ),
]
Order = Annotated[
    int,
    typer.Option(
        "--order",
        "-n",
        metavar="N",
        help="Set the half periods of the shaking in one half cycle, odd: 1 harmonic, 3 the 1/3 "
        "subharmonic.",
        rich_help_panel=MOTION,
    ),
]
Orders = Annotated[
    list[int] | None,
    typer.Option(
        "--order",
        "-n",
        metavar="N",
        help="Set the half periods of the shaking in one half cycle, odd: 1 harmonic (default), 3 "
        "the 1/3 subharmonic; may be repeated.",
        rich_help_panel=MOTION,
    ),
]
Start = Annotated[
    str,
    typer.Option(
        "--start",
        metavar="START",
        help="Start at rest; on steady or steady:2 (branch 1 or 2 of order -n); at U,V (u and "
        "du/d(pt)); or at U,tau=DU (DU = du/d(omega t)).",
        rich_help_panel=START,
    ),
]
SweepStart = Annotated[
    str,
    typer.Option(
        "--start",
        metavar="START",
        help="Where a sweep begins, and begins again after a fall: auto (steady where its first "
        "value has that, else rest), rest, steady or steady:2 (branch 1 or 2 of the first -n), "
        "U,DU (u and du/d(pt)), or U,tau=DU (DU = du/d(omega t)). After a rest it goes on from "
        "rest.",
        rich_help_panel=START,
    ),
]
Side = Annotated[
    str,
    typer.Option(
        "--side",
        metavar="+|-",
        help="Choose the side of its unstable direction on which an unstable state is left.",
        rich_help_panel=START,
    ),
]
Kick = Annotated[
    float | None,
    typer.Option(
        "--kick",
        metavar="K",
        help="Set the distance from an unstable steady state at the start; default 1e-6: length of "
        "(phase \\[rad], velocity over the orbit's).",
        rich_help_panel=START,
    ),
]
Phase = Annotated[
    float | None,
    typer.Option(
        "--phase",
        metavar="RAD",
        help="Set the phase of the shaking at the start \\[rad], not with --start steady; default "
        "0.",
        rich_help_panel=START,
    ),
]
NamedBlock = Annotated[
    str | None,
    typer.Option(
        "--block",
        metavar="NAME",
        help=f"Take a named block: {', '.join(SOURCES)}.",
        rich_help_panel=BLOCK,
    ),
]
WidthM = Annotated[
    str | None,
    typer.Option(
        "--width-m",
        metavar="M",
        help="Set the full width of the base \\[m].",
        rich_help_panel=BLOCK,
    ),
]
HeightM = Annotated[
    str | None,
    typer.Option(
        "--height-m", metavar="M", help="Set the full height \\[m].", rich_help_panel=BLOCK
    ),
]
OffsetM = Annotated[
    float | None,
    typer.Option(
        "--offset-m",
        metavar="M",
        help="Move the mass centre off the middle of --width-m \\[m], positive to the right, away "
        "from the left edge, the pivot of positive rotation, as offset_m in files of objects; "
        "default 0. The radius of gyration about the mass centre stays that of the homogeneous "
        "outline.",
        rich_help_panel=BLOCK,
    ),
]
MassCentreHeightM = Annotated[
    float | None,
    typer.Option(
        "--mass-centre-height-m",
        metavar="M",
        help="Set the height of the mass centre above the base \\[m], with --width-m and "
        "--height-m; default half of --height-m. The radius of gyration about the mass centre "
        "stays that of the homogeneous outline, unless --gyration-m is given.",
        rich_help_panel=BLOCK,
    ),
]
LeftM = Annotated[
    float | None,
    typer.Option(
        "--left-m",
        metavar="M",
        help="Set the distance from the left edge to the mass centre \\[m], with --right-m and "
        "--height-m (twice the height of the mass centre): a block whose sides differ. The left "
        "edge is the pivot of positive rotation, and its side the unit of angles and times.",
        rich_help_panel=BLOCK,
    ),
]
RightM = Annotated[
    float | None,
    typer.Option(
        "--right-m",
        metavar="M",
        help="Set the distance from the right edge to the mass centre \\[m].",
        rich_help_panel=BLOCK,
    ),
]
GyrationM = Annotated[
    float | None,
    typer.Option(
        "--gyration-m",
        metavar="M",
        help="Set the radius of gyration about the mass centre \\[m], with --left-m, --offset-m or "
        "--mass-centre-height-m; default that of the homogeneous rectangle of this base and "
        "height.",
        rich_help_panel=BLOCK,
    ),
]
AlphaRad = Annotated[
    str | None,
    typer.Option(
        "--alpha-rad",
        metavar="RAD",
        help="Set the slenderness, the tilt at which the block balances \\[rad].",
        rich_help_panel=BLOCK,
    ),
]
RadiusM = Annotated[
    str | None,
    typer.Option(
        "--radius-m",
        metavar="M",
        help="Set the distance from pivot to mass centre \\[m] of a homogeneous rectangle.",
        rich_help_panel=BLOCK,
    ),
]
PRadS = Annotated[
    str | None,
    typer.Option(
        "--p-rad-s",
        metavar="P",
        help="Set the frequency parameter sqrt(M g R/I_0) \\[rad/s], instead of --radius-m.",
        rich_help_panel=BLOCK,
    ),
]
GravityMS2 = Annotated[
    float | None,
    typer.Option(
        "--gravity-m-s2",
        metavar="G",
        help="Set the acceleration of gravity \\[m/s^2]; default 9.80665.",
        rich_help_panel=BLOCK,
    ),
]
Json = Annotated[
    bool,
    typer.Option(
        "--json",
        help="Print one JSON object on standard output, nothing else.",
        rich_help_panel=OUTPUT,
    ),
]
Plot = Annotated[
    Path | None,
    typer.Option(
        "--plot", metavar="FILE", help="Save a figure: .png, .svg or .pdf.", rich_help_panel=OUTPUT
    ),
]
Width = Annotated[
    str | None,
    typer.Option(
        "--width",
        metavar="LENGTH",
        help="Set the width of --plot with its unit (mm, cm or in), as 84mm for a journal column.",
        rich_help_panel=OUTPUT,
    ),
]
Legend = Annotated[
    str | None,
    typer.Option(
        "--legend",
        metavar="PLACE",
        help="Place the legends of --plot: inside, right, below or none; default where there is "
        "room.",
        rich_help_panel=OUTPUT,
    ),
]
Csv = Annotated[
    Path | None,
    typer.Option("--csv", metavar="FILE", help="Save the data as CSV.", rich_help_panel=OUTPUT),
]
Animate = Annotated[
    Path | None,
    typer.Option(
        "--animate",
        metavar="FILE",
        help="Save a film of the block on its moving ground, to scale: .gif.",
        rich_help_panel=OUTPUT,
    ),
]
Speed = Annotated[
    float | None,
    typer.Option(
        "--speed",
        metavar="X",
        help="Set the speed of --animate: seconds of a block (1 is real time), else periods of the "
        "shaking, else pt, per second of film; default 1, or what shows the run well.",
        rich_help_panel=OUTPUT,
    ),
]
Force = Annotated[
    bool,
    typer.Option("--force", help="Overwrite files that exist.", rich_help_panel=OUTPUT),
]
OutFolder = Annotated[
    Path,
    typer.Option(
        "--out",
        metavar="DIR",
        help="Write into this folder; made if it does not exist.",
        rich_help_panel=OUTPUT,
    ),
]
ResumeStudy = Annotated[
    bool,
    typer.Option(
        "--resume",
        help="Continue the study in the folder where it stopped; begin it if it does not exist.",
        rich_help_panel=OUTPUT,
    ),
]
