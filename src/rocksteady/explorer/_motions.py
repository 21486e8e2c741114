"""Ground motions as the explorer's page holds them."""

import base64
from collections.abc import Sequence

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.motions.record import Record
from rocksteady.records.core.recording import Recording
from rocksteady.results.rendering import printable

LARGEST = 30_000_000
"""Bytes of the samples of all motions; browsers open larger pages slowly or not at all."""
LONGEST_TEXT = 300
"""Characters of a name or a note."""


def motions_of(records: Sequence[Record | Recording]) -> list[dict[str, object]]:
    """Return ground motions for the page: name, interval, note, and samples to the last bit.

    The samples [m/s^2] are base64 of 64-bit numbers, the low byte first: decimal digits would be
    larger, and parsed by each browser.

    Raises
    ------
    InputError
        If they are too large for a page.
    """
    size = sum(_record(each).acceleration_m_s2.nbytes for each in records)
    if size > LARGEST:
        raise InputError(
            "records",
            f"{len(records)} with {size / 1e6:.0f} MB of samples",
            f"a page holds {LARGEST / 1e6:.0f} MB at most",
            "give fewer or shorter ones, or resample them",
        )
    return [_motion(each, number) for number, each in enumerate(records, 1)]


def _motion(given: Record | Recording, number: int) -> dict[str, object]:
    """Return one ground motion."""
    record = _record(given)
    samples = record.acceleration_m_s2.astype(np.dtype("<f8")).tobytes()
    name, notes = record.name or f"record {number}", []
    if isinstance(given, Recording):
        name = given.name
        notes = [given.title, *given.processing, *given.warnings]
    return {
        "name": _text(name),
        "dt": record.dt_s,
        "note": _text("; ".join(notes)),
        "samples": base64.b64encode(samples).decode("ascii"),
    }


def _record(given: Record | Recording) -> Record:
    """Return the samples and their interval."""
    return given.record if isinstance(given, Recording) else given


def _text(text: str) -> str:
    """Return a text that a line can show."""
    shown = printable(text)
    return shown if len(shown) <= LONGEST_TEXT else f"{shown[: LONGEST_TEXT - 1]}…"
