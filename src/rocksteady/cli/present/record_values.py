"""What has been done to the records of `rocksteady simulate`."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rocksteady.records.core.recording import Recording


def processing_values(horizontal: "Recording", vertical: "Recording | None") -> dict[str, Any]:
    """Return what has been done to the records of a run."""
    values = {"record_processing": list(horizontal.processing)}
    if vertical is not None:
        values["vertical_processing"] = list(vertical.processing)
    return values
