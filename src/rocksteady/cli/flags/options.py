"""Flags shared by several commands: one spelling, help text and unit each."""

from dataclasses import dataclass, field, fields
from functools import partial
from typing import Any

import typer

from rocksteady.cli.console.shell import quoted

FLAG = "flag"
"""Key of the typer option in the metadata of a field."""
NAME = "name"
"""Key of the shortest name of the flag there."""


@dataclass(frozen=True)
class Panel:
    """A panel of `--help`, which makes its flags.

    A flag is made from its names and the placeholder of its value, as "--amplitude -A A", and
    from its help.
    """

    name: str

    def __call__(self, words: str, help: str, *, default: Any = None) -> Any:  # noqa: A002 -- as typer
        """Return a flag with its default, for a field of a group or a parameter of a command."""
        names = [each for each in words.split() if each.startswith("-")]
        metavar = next(iter(words.split()[len(names) :]), None)
        option = typer.Option(*names, metavar=metavar, help=help, rich_help_panel=self.name)
        return field(default=default, metadata={FLAG: option, NAME: min(names, key=len)})


def given_in(group: Any) -> dict[str, object]:
    """Return the flags of a group that were given, with their values."""
    return {
        "--" + each.name.replace("_", "-"): getattr(group, each.name)
        for each in fields(group)
        if getattr(group, each.name) != each.default
    }


def follow_up(command: str, *parts: object) -> str:
    """Return a command that takes flags of this run along.

    Parameters
    ----------
    command
        Its name, with what is added to the flags.
    parts
        Groups of flags as they were given, and texts as they are.

    Examples
    --------
    >>> from rocksteady.cli.flags.block_and_shaking import BlockFlags
    >>> follow_up("overturn", BlockFlags(restitution="0.9", one_sided=True), "--more")
    'rocksteady overturn -r 0.9 --one-sided --more'
    """
    words = ["rocksteady", command]
    for part in parts:
        if isinstance(part, str):
            words.append(part)
            continue
        for each in fields(part):  # type: ignore[arg-type]
            value = getattr(part, each.name)
            if value == each.default or value is None or FLAG not in each.metadata:
                continue
            name = each.metadata[NAME]
            values = value if isinstance(value, list | tuple) else [value]
            words += [name if item is True else f"{name} {quoted(item)}" for item in values]
    return " ".join(filter(None, words))


block_flag = Panel("Block")
motion_flag = Panel("Base motion")
start_flag = Panel("Start and length")
output_flag = Panel("Output")
mass_flag = partial(
    block_flag,
    "--mass-kg KG",
    "Set the mass of the block, or of columns and cap of a frame together, for the largest "
    "force on its base.",
)

NAMESAKES = (
    "one_sided phase oscillations cycles start side kick max_period max_impacts max_branches "
    "max_curves length other doublings top seeds seed angles velocities resolution speed model tab "
    "tolerance out only executor workers chunk refine channel format units dt_s column resample "
    "ignore_header baseline damping periods_s scale pga_g pgv_m_s friction spectrum vertical_g "
    "vertical_share vertical by legend scene embed"
)
"""Arguments of the library whose flags have their names."""
FLAG_OF_ARGUMENT = {name: "--" + name.replace("_", "-") for name in NAMESAKES.split()} | {
    "amplitude": "--amplitude/-A",
    "frequency_ratio": "--frequency-ratio/-W",
    "restitution": "--restitution/-r",
    "order": "--order/-n",
    "object_kind": "--kind",
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
    "mass_centre_height": "--mass-centre-height-m",
    "alpha_ratio": "--left-m/--right-m/--offset-m",
    "p_ratio": "--left-m/--right-m/--offset-m",
    "negative_restitution": "--restitution/-r",
    "wall_restitution": "--restitution/-r",
    "acceleration_m_s2": "--accel-g/--accel-m-s2",
    "frequency_hz": "--freq-hz",
    "shape": "--pulse",
    "harmonics": "--harmonic",
    "max_cycles": "--cycles",
    "angle": "--start",
    "velocity": "--start",
    "box": "--entropy",
    "sizes": "--exponent",
    "amplitudes": "--amplitude/-A",
    "frequency_ratios": "--frequency-ratio/-W",
    "name": "--block",
    "per_unit": "--samples",
    "store": "--out",
    "orders": "--order/-n",
    "period": "--periods-s",
    "records": "--record",
    "scales": "--scale",
    "motions": "--record",
    "spectrum_damping": "--damping",
    "columns": "--columns",
    "mass_kg": "--mass-kg",
    "cap_mass_ratio": "--cap-mass-ratio",
    "sa_v_per_sa_h": "--vertical-per-horizontal",
    "width_mm": "--width",
    "filter_hz": "--filter",
    "trim_s": "--trim",
}
"""Which flag an argument of the library is, for error lines."""

model = partial(
    block_flag,
    "--model NAME",
    "Choose the equations of motion: nonlinear, the full ones (default for a block of known "
    "slenderness), or linear, those of slender blocks (default for one given by -r alone).",
)
tolerance = partial(
    block_flag, "--tolerance X", "Set the relative error of the nonlinear motion; default 1e-10."
)
restitution = partial(
    block_flag,
    "--restitution -r R",
    "Set the ratio of angular velocities after and before an impact, in (0, 1], "
    "'housner' (default for a block) or a measured factor of it, as 'housner*0.965'; two with "
    "a comma, as 0.8,0.9, for the impact that ends positive rotation and for the other.",
)
one_sided = partial(
    block_flag,
    "--one-sided",
    "Stand the block against a wall, which it leaves on its positive side alone; "
    "--restitution, in \\[0, 1], is then that of the wall: default of a block 'housner', "
    "from angular momentum.",
)
order = partial(
    motion_flag,
    "--order -n N",
    "Set the half periods of the shaking in one half cycle, odd: 1 rocks with the shaking, 3 "
    "alike every third shake.",
    default=1,
)
orders = partial(
    motion_flag,
    "--order -n N",
    "Set the half periods of the shaking in one half cycle, odd: 1 (default) rocks with the "
    "shaking, 3 alike every third shake; may be repeated.",
)
start = partial(
    start_flag,
    "--start START",
    "Set the start: rest (default), U,V (u and du/d(pt)), U,tau=DU (DU = du/d(omega t)), or "
    "steady or steady:2 (branch 1 or 2 of order -n).",
    default="rest",
)
side = partial(
    start_flag,
    "--side +|-",
    "Choose the side of its unstable direction on which an unstable state is left.",
    default="+",
)
kick = partial(
    start_flag,
    "--kick K",
    "Set the distance from an unstable steady state at the start; default 1e-6: length of "
    "(phase \\[rad], velocity over the orbit's).",
)
phase = partial(
    start_flag,
    "--phase RAD",
    "Set the phase of the shaking at the start \\[rad], not with --start steady; default 0.",
)
gravity_m_s2 = partial(
    block_flag, "--gravity-m-s2 G", "Set the acceleration of gravity \\[m/s^2]; default 9.80665."
)
as_json = partial(
    output_flag, "--json", "Print one JSON object on standard output, nothing else.", default=False
)
more = partial(
    output_flag, "--more", "Print all facts, tables and notes below the answer.", default=False
)
quiet = partial(output_flag, "--quiet", "Print the first line of the answer alone.", default=False)
csv = partial(output_flag, "--csv FILE", "Save the data as CSV.")
force = partial(output_flag, "--force", "Overwrite files that exist.", default=False)
out_folder = partial(
    output_flag, "--out DIR", "Write into this folder; made if it does not exist.", default=...
)
resume_study = partial(
    output_flag,
    "--resume",
    "Continue the study in the folder where it stopped; begin it if it does not exist.",
    default=False,
)
