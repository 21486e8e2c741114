"""Fates of the states of a window under a record or a pulse, as `rocksteady basins` has them."""

from typing import TYPE_CHECKING

import typer

from rocksteady.cli.flags.block_and_shaking import (
    BlockFlags,
    PulseFlags,
    ShakingFlags,
    equations_for,
    refuse_of_linear,
)
from rocksteady.cli.flags.groups import OutputFlags
from rocksteady.cli.flags.options import follow_up
from rocksteady.cli.flags.parsing import axis, single
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags, refuse_beside_record
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.cli.flags.window import WindowFlags
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.base_motion import BaseMotion

PLOT = "--plot basins.png"

if TYPE_CHECKING:
    from rocksteady.model.blocks.dimensionless import DimensionlessBlock


def shaken_by(
    shaking: ShakingFlags,
    pulse: PulseFlags,
    recorded: RecordFlags,
    reading: ReadingFlags,
    block: BlockFlags,
    phase: str,
    model: str | None,
) -> "tuple[Block | DimensionlessBlock, BaseMotion]":
    """Return the block, and the record or the pulse that shakes it."""
    begin = single("--phase", axis("--phase", phase))
    if not recorded.given(reading, pulse=pulse.given, on_floor=pulse.given):
        body = block.described()
        size = shaking.at(body)
        motion = pulse.of(size, phase=begin or None, reverse=recorded.reverse)
        return body, BaseMotion(reading.on_floor(motion, body))
    refuse_beside_record(pulse=pulse, shaking=shaking, phase=begin or None)
    refuse_of_linear(model, "--vertical", recorded.vertical)
    across = recorded.recording(reading)
    lifting = recorded.vertical_recording(reading, across)
    upwards = None if lifting is None else recorded.scaled(lifting.record)
    return recorded.block(block), BaseMotion(across.record, upwards)


def leave_fates(
    context: typer.Context,
    body: "Block | DimensionlessBlock",
    motion: BaseMotion,
    window: WindowFlags,
    model: str | None,
    sweep: SweepFlags,
    output: OutputFlags,
    *asked: object,
) -> None:
    """Compute the fates under a motion that ends, and write the output that the flags request."""
    moment, chosen = window.moment(body), window.axes
    equations = equations_for(model, body)
    from rocksteady.dynamics.basins.fate_basins import compute_fate_basins
    from rocksteady.dynamics.basins.window import POINTS
    from rocksteady.show.figures.single import fate_basins_figure
    from rocksteady.words.windows import FEW

    states = len(chosen.get("angles", range(POINTS))) * len(chosen.get("velocities", range(POINTS)))
    how = sweep.run(force=output.force)
    with sweep.running(context, how, "following states", states) as (run, _):
        fates = compute_fate_basins(
            body, motion, **chosen, time_pt=moment, model=equations, run=run
        )
    description = fates.describe()
    output.write_csv(fates.to_dataframe)
    sweep.write_netcdf(fates.to_dataset)
    output.write_plot(lambda page: fate_basins_figure(fates, description.headline, page))
    named = f"--model {model}" if model else ""
    further = "" if output.plot else follow_up("basins", *asked, window, named, PLOT)
    decided = fates.undecided <= FEW
    output.leave("basins", description, decided=decided, wrap=True, follow_up=further)
