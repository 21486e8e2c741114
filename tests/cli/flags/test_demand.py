"""Flags of a demand: which noun of the library they become."""

import pytest

from rocksteady import Block
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.demand import PeakFlags, SpectrumFlags, share, sized_block
from rocksteady.cli.flags.record_files import ReadingFlags
from rocksteady.errors import InputError
from tests.every import every


def test_a_block_needs_a_size() -> None:
    flags = BlockFlags(width_m="0.3", height_m="1.2")
    assert sized_block(flags) == Block.rectangle(width=0.3, height=1.2)
    with pytest.raises(FlagError, match="--width-m with --height-m"):
        sized_block(BlockFlags())


def test_both_peaks_are_asked_for_by_name() -> None:
    PeakFlags(pga_g=0.3, pgv_m_s=0.4).need_both_peaks()
    with pytest.raises(FlagError, match="--pgv-m-s is not given"):
        PeakFlags(pga_g=0.3).need_both_peaks()


def test_peaks_alone_make_a_demand_without_a_spectrum() -> None:
    demand = SpectrumFlags().demand(PeakFlags(pga_g=0.3), ReadingFlags())
    assert (demand.pga_g, demand.pgv_m_s, demand.spectrum) == (0.3, None, None)


@every("value", [0.0, 1.0, -0.1, float("nan")])
def test_a_target_is_a_share_that_decides_something(value: float) -> None:
    with pytest.raises(InputError, match="--target"):
        share("--target", value)
    assert share("--target", 0.1) == 0.1
