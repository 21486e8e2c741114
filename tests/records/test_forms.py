"""Files of many networks and tools, whole and with a statement of their header lost or moved."""

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import read_recordings
from tests.every import every
from tests.records.forms import FORMS, Form

OTHERS = (
    *((r"\bgal\b", "g"), (r"\bGal\b", "g"), (r"cm/s\^2", "g"), (r"CM/S\*\*2", "M/S**2")),
    *((r"CM/SEC\*\*2", "G"), (r"cm/s/s", "m/s/s"), (r"UNITS OF G\b", "UNITS OF CM/S2")),
    *((r"cm/sec2", "g"), (r"\bN-S\b", "U-D"), ("HNE", "HNZ"), (": NS", ": UP"), ("HNN", "HNZ")),
    *(("360 DEGREES", "UP"), ("Up", "90 Deg"), ("090", "UP"), (r"acc\b", "vel"), ("=AC", "=VL")),
    *(("ACCELERATION", "VELOCITY"), (r"\b0\.01\b", "0.02"), (r"\b100", "200"), ("400", "401")),
)
"""Statements, and others in their place."""


def outcome(path: Path, form: Form, text: str) -> str:
    """Return whether a file is read right, warned about or refused; silence about a fault fails."""
    path.write_text(text)
    try:
        found = read_recordings(path)
    except RecordFileError:
        return "refused"
    if any(each.warnings for each in found):
        return "warned"
    assert len(found) == len(form.channels)
    for each, (name, values) in zip(found, form.channels.items(), strict=True):
        scale = np.abs(values).max()
        assert each.record.dt_s == pytest.approx(form.dt_s, rel=1e-9)
        np.testing.assert_allclose(each.record.acceleration_m_s2, values, atol=2e-4 * scale)
        assert each.orientation in {form.orientations[name], "unknown"}
    return "right" if found[0].orientation != "unknown" else "open"


@every("name", FORMS)
def test_a_whole_file(tmp_path: Path, name: str) -> None:
    form = FORMS[name]
    assert outcome(tmp_path / "hut.txt", form, form.text) == "right"
    found = read_recordings(tmp_path / "hut.txt")
    assert [each.component for each in found] == list(form.channels)
    assert len({each.record.name for each in found}) == len(found)


def changed(form: Form) -> Iterator[str]:
    """Yield a file with each line of its header lost, doubled, moved and stated otherwise."""
    lines = form.lines
    for at in range(form.head):
        without = [*lines[:at], *lines[at + 1 :]]
        place = (7 * at + 3) % max(form.head - 1, 1)
        yield "\n".join(without)
        yield "\n".join([*lines[:at], lines[at], *lines[at:]])
        yield "\n".join([*without[:place], lines[at], *without[place:]])
        for old, new in OTHERS:
            other = re.sub(old, new, lines[at], count=1)
            if other != lines[at]:
                yield "\n".join([*lines[: at + 1], other, *lines[at + 1 :]])
                yield "\n".join([*lines[:at], other, *lines[at:]])


@every("name", FORMS)
def test_no_statement_is_lost_moved_or_doubled_in_silence(tmp_path: Path, name: str) -> None:
    outcomes = {outcome(tmp_path / "hut.txt", FORMS[name], text) for text in changed(FORMS[name])}
    assert "right" in outcomes
    assert outcomes & {"warned", "refused", "open"}
