"""What has been done to the records of `rocksteady simulate`."""

from dataclasses import replace

from rocksteady.cli.present.record_values import processing_values
from tests.cli.motion_files import samples
from tests.records import recording


def test_what_was_done_to_both_channels_is_kept() -> None:
    one = recording(9.80665 * samples(), 0.02, processing=("mean taken off",))
    assert processing_values(one, None) == {"record_processing": ["mean taken off"]}
    both = processing_values(one, replace(one, processing=()))
    assert both == {"record_processing": ["mean taken off"], "vertical_processing": []}
