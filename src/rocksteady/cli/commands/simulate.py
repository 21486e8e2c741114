"""`rocksteady simulate`: time history of one block."""

from dataclasses import replace
from typing import TYPE_CHECKING

from rocksteady.cli.console.outputs import write_film
from rocksteady.cli.console.refusals import FlagError, refuse, require
from rocksteady.cli.console.titles import case_text
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import (
    BlockFlags,
    PulseFlags,
    ShakingFlags,
    equations_for,
    refuse_of_linear,
)
from rocksteady.cli.flags.groups import AnimationFlags, OutputFlags, grouped
from rocksteady.cli.flags.range import SeriesFlags
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags, refuse_beside_record
from rocksteady.cli.flags.start import StartFlags, refuse_without_shaking
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.segments import Motion, Still
from rocksteady.outcomes import Status
from rocksteady.results.description import Description, Fact

if TYPE_CHECKING:
    from rocksteady.dynamics.history.trajectory import Trajectory
    from rocksteady.model.motions.record import Record
    from rocksteady.show.film.animation import Film

HELP = (
    "Follow one block through one motion.\n\n"
    "One time history: every flight, every impact, overturning proved.\n\n"
    "Without shaking (-A and -W, or --accel-g and --freq-hz) a block that is let go rocks "
    "freely until it rests or overturns. After a pulse (--pulse) and a recorded motion "
    "(--record) too it is followed until then."
)
MAIN = "width_m height_m restitution record scale pulse accel_g freq_hz start plot"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady simulate -A 2 -W 1.9 -r 0.8 --start steady --cycles 40 --plot run.png\n\n"
    "rocksteady simulate --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 1 --csv run.csv\n\n"
    "rocksteady simulate --block zhang-makris-2001 --pulse one-sine --accel-g 2 --freq-hz 1.7\n\n"
    "rocksteady simulate --block zhang-makris-2001 --start 0.6,0 --json\n\n"
    "rocksteady simulate --width-m 0.3 --height-m 3 --one-sided --pulse one-sine --accel-g 0.15 "
    "--freq-hz 1\n\n"
    "rocksteady simulate --width-m 0.4 --height-m 0.8 -A 2 -W 4\n\n"
    "rocksteady simulate --width-m 1.6 --height-m 9.6 --columns 4 --cap-mass-ratio 2 --mass-kg "
    "4e5 --pulse one-sine --accel-g 0.2 --freq-hz 0.5\n\n"
    "rocksteady simulate --width-m 0.5 --height-m 2 --record example:near-fault --friction 0.4\n\n"
    "rocksteady simulate --block tso-wong-1989 -A 4 -W 1.5 --animate fall.gif"
)

MOST_ROWS = 50_000_000
"""Of --csv: some gigabytes."""


@grouped
def simulate(
    shaking: ShakingFlags,
    series: SeriesFlags,
    pulse: PulseFlags,
    recorded: RecordFlags,
    reading: ReadingFlags,
    block: BlockFlags,
    output: OutputFlags,
    film: AnimationFlags,
    start: StartFlags,
    cycles: float | None = options.start_flag(
        "--cycles N", "Periods of the shaking to follow, default 50."
    ),
    samples: int = options.output_flag(
        "--samples N",
        "Rows of --csv per period of the shaking (per pt = 1 without shaking, around "
        "a pulse and under a record); impacts are always rows.",
        default=100,
    ),
    mass_kg: float | None = options.mass_flag(),
    friction: float | None = options.block_flag(
        "--friction MU",
        "Set the coefficient of friction between block and base: a run that needs more slides, "
        "and the answer says so.",
    ),
    model: str | None = options.model(),
    tolerance: float | None = options.tolerance(),
) -> None:
    """Run `rocksteady simulate`; `HELP` is what its users read."""
    output.check(recorded.files)
    film.check(output, recorded.files)
    on_floor = pulse.given or shaking.given
    of_record = recorded.given(reading, pulse=pulse.given, on_floor=on_floor)
    require(
        "simulate",
        {"block": block.given, "motion": of_record or on_floor or start.start != "rest"},
        "--width-m 0.6 --height-m 2 --pulse one-sine --accel-g 0.5 --freq-hz 1",
        "--width-m 0.6 --height-m 2 --record example:near-fault",
    )
    body = recorded.block(block) if of_record else block.described()
    check_friction(friction, body)
    motion: Motion | Record = Still()
    if series.given and (of_record or pulse.given or not shaking.given):
        raise FlagError(
            "harmonics",
            ", ".join(series.harmonic or ()),
            "it goes with endless shaking alone",
            "give -A and -W, and neither a pulse nor a record",
        )
    beside = None
    notes: dict[str, list[str]] = {}
    if of_record:
        refuse_beside_record(pulse=pulse, shaking=shaking, phase=start.phase)
        refuse_cycles(cycles, "a recorded motion")
        refuse_of_linear(model, "--vertical", recorded.vertical)
        across = recorded.recording(reading)
        lifting = recorded.vertical_recording(reading, across)
        motion = across.record
        beside = None if lifting is None else recorded.scaled(lifting.record)
        notes = {"record_processing": list(across.processing)}
        if lifting is not None:
            notes["vertical_processing"] = list(lifting.processing)
    elif pulse.given:
        size = shaking.at(body)
        motion = pulse.of(size, phase=start.phase, reverse=recorded.reverse)
        motion = reading.on_floor(motion, body)
        refuse_cycles(cycles, "a pulse")
    elif shaking.given:
        motion = reading.on_floor(series.of(shaking.at(body, phase=start.first_phase)), body)
    start.check(shaken=not isinstance(motion, Still))
    if isinstance(motion, Still):
        refuse_without_shaking("--cycles", cycles)
    refuse_long_table(samples, cycles if output.csv is not None else None)
    equations = equations_for(model, body, tolerance)

    from rocksteady.dynamics.history.simulate import simulate as run

    begin = start.of(motion.frequency_ratio if isinstance(motion, PeriodicMotion) else None)
    with start.as_typed():
        trajectory = run(
            body,
            BaseMotion(motion, beside),
            start=begin,
            cycles=50.0 if cycles is None else cycles,
            model=equations,
        )
    description = with_neighbours(trajectory, notes, mass_kg, friction)
    write_files(trajectory, description, output, film, samples)
    output.leave(
        "simulate",
        description,
        decided=trajectory.status is not Status.UNDECIDED,
        follow_up=next_command(
            motion, shaking, series, pulse, recorded, reading, block, start, model
        ),
    )


def next_command(
    motion: "Motion | Record",
    shaking: ShakingFlags,
    series: SeriesFlags,
    pulse: PulseFlags,
    recorded: RecordFlags,
    reading: ReadingFlags,
    block: BlockFlags,
    start: StartFlags,
    model: str | None,
) -> str:
    """Return what to run next: all strengths of a record or a pulse, the attractor of shaking."""
    full = "" if model is None else f"--model {model}"
    if recorded.record:
        whole = replace(recorded, scale=None, pga_g=None)
        return options.follow_up("overturn", whole, reading, block, full)
    if pulse.given:
        phase = "" if start.phase is None else f"--phase {start.phase!r}"
        frequency = replace(shaking, amplitude=None, accel_g=None, accel_m_s2=None)
        return options.follow_up(
            "overturn", pulse, frequency, recorded, reading, phase, block, full
        )
    if isinstance(motion, Still):
        begin = start.start if "," in start.start else "0,0"
        return options.follow_up("overturn --kick", f"--start {begin}", block, full)
    return options.follow_up("attractor", shaking, series, reading, block)


def check_friction(friction: float | None, body: Block | DimensionlessBlock) -> None:
    """Refuse a coefficient of friction outside its range, or of a block without a size.

    Raises
    ------
    InputError, FlagError
        If it is.
    """
    if friction is None:
        return
    from rocksteady.model.checks.bounds import FRICTION

    FRICTION("--friction", friction)
    if not isinstance(body, Block):
        raise FlagError(
            "--friction",
            friction,
            "friction is compared with forces, which need a block with a size",
            "describe it, as --width-m 0.32 --height-m 1.8, or leave it out",
        )


def with_neighbours(
    trajectory: "Trajectory",
    notes: dict[str, list[str]],
    mass_kg: float | None = None,
    friction: float | None = None,
) -> Description:
    """Return the description of a run with its neighbours, and with notes on its record.

    Parameters
    ----------
    trajectory
        The run.
    notes
        What was done to its record, by the key of JSON.
    mass_kg
        Mass of the block, for the force on its base; without one there is none.
    friction
        Coefficient of friction, with which the run may slide; None where it is not known.
    """
    from rocksteady.dynamics.history.neighbours import check_neighbours
    from rocksteady.words.neighbours import neighbours_answer, neighbours_fact, neighbours_notes

    description = trajectory.describe(mass_kg=mass_kg, friction=friction)
    facts, remarks, sentence = [*description.facts], [*description.notes], description.sentence
    if isinstance(trajectory.block, Block) and not isinstance(
        trajectory.motion, PeriodicMotion | Still
    ):
        neighbours = check_neighbours(trajectory)
        sentence, screen = neighbours_answer(neighbours, friction)
        further = (fact for fact in facts if not fact.first)
        facts = [*screen, *further, neighbours_fact(neighbours)]
        remarks = [*neighbours_notes(neighbours), *remarks]
    for key, lines in notes.items():
        label = key.partition("_")[0] if lines else ""
        facts.append(Fact(key, lines, label, "; ".join(lines)))
    return replace(description, facts=facts, notes=remarks, sentence=sentence)


def write_files(
    trajectory: "Trajectory",
    description: Description,
    output: OutputFlags,
    film: AnimationFlags,
    samples: int,
) -> None:
    """Write the table, the picture and the film."""
    from rocksteady.show.figures.single import simulation_figure

    # Made before any file is written: a run that is too long to be shown is refused here.
    moving = None if film.animate is None else film_of_run(trajectory, film)
    if output.csv is not None:
        table = trajectory.to_columns(samples)
        rows = zip(*(column.tolist() for column in table.values()), strict=True)
        output.write_csv(lambda: (list(table), rows))
    output.write_plot(lambda page: simulation_figure(trajectory, title_of(description), page))
    if moving is not None and film.animate is not None:
        write_film(film.animate, moving)


def title_of(description: Description) -> str:
    """Return the title of a picture: the name of a record leaves no room for more."""
    values = description.to_dict()
    return case_text(values) if "record" in values else f"Rocking block: {case_text(values)}"


def refuse_long_table(samples: int, cycles: float | None) -> None:
    """Refuse --samples that is no number of rows, or with --cycles too many of them.

    Raises
    ------
    InputError, FlagError
        If it is.
    """
    whole_number("per_unit", samples, at_least=1, at_most=100_000, hint="give rows per period")
    if cycles is not None and samples * cycles > MOST_ROWS:
        raise FlagError(
            finding=f"--samples {samples} with --cycles {cycles:g}",
            valid=f"--csv has at most {MOST_ROWS:,} rows",
            hint="give fewer of them",
        )


def refuse_cycles(cycles: float | None, thing: str) -> None:
    """Refuse a number of cycles for a motion that ends.

    Raises
    ------
    InputError
        If there is one.
    """
    refuse({"--cycles": cycles}, f"{thing} ends, and the block is followed to rest or overturning")


def film_of_run(trajectory: "Trajectory", flags_of_film: AnimationFlags) -> "Film":
    """Return the film of a whole run.

    Raises
    ------
    InputError
        If it would have too many frames, or too few to show each period.
    """
    from rocksteady.show.film.animation import film_of

    try:
        return film_of(trajectory, speed=flags_of_film.speed)
    except InputError as error:
        if error.name != "span":
            raise
        # The command has no part of a run to offer, but the run can be made shorter.
        shaken = isinstance(trajectory.motion, PeriodicMotion)
        raise InputError(
            "--animate",
            flags_of_film.animate,
            error.valid,
            "follow fewer periods with --cycles" if shaken else "give a --speed",
        ) from error
