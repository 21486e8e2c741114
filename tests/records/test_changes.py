"""Changed files: each is read right, warned about or refused, by the kind of its change."""

from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.records import Recording, read_recordings
from tests.records.changes import Change, change
from tests.records.test_mutations import GIVEN, WRITTEN, values
from tests.records.writers import samples

FILES = {
    **{name: text.encode() for name, text in WRITTEN.items()},
    "columns with words": (
        "NUMBER OF DATA : 403\nSAMPLING INTERVAL (sec): 0.01\nacceleration, units: g\n"
        + "".join(f"{value:10.6f}\n" for value in samples(403))
    ).encode(),
}


def read(path: Path, name: str, data: bytes) -> tuple[Recording, ...]:
    path.write_bytes(data)
    return read_recordings(path, **GIVEN.get(name, {}))  # type: ignore[arg-type]


def judge(path: Path, name: str, changed: Change, whole: tuple[Recording, ...]) -> str:
    """Read a changed file, and return what came of it."""
    where = f"{name}, {changed.kind}, {changed.verdict}"
    refused = ""
    found: tuple[Recording, ...] = ()
    try:
        found = read(path, name, changed.data)
    except InputError as error:
        refused = str(error)
    if refused:
        assert "\n" not in refused, where
        assert "cannot be read" in refused, where
        # A unit stated in other words is no reason to refuse, unless its code contradicts it.
        if changed.verdict == "scaled" and name != "cosmos-v2":
            assert "is none of a record" in refused, f"{where}: {refused}"
        assert changed.verdict != "turned", f"{where}: {refused}"
        return "refused"
    known = {words for one in whole for words in one.warnings}
    if any(words not in known for one in found for words in one.warnings):
        return "warned"
    assert changed.verdict != "not same", f"{where}: read without a word"
    assert len(found) == len(whole), where
    for one, other in zip(found, whole, strict=True):
        assert one.record.dt_s == other.record.dt_s, where
        new, old = values(one), values(other)
        if changed.verdict == "prefix":
            least = min(len(new), len(old))
            np.testing.assert_array_equal(new[:least], old[:least], err_msg=where)
            continue
        if changed.verdict == "same numbers":
            new, old = np.sort(new), np.sort(old)
        if changed.verdict == "turned":
            assert any(note.startswith("sign changed") for note in one.processing), where
            old = -old
        # The other channel of a file has its own unit.
        if changed.verdict == "scaled" and one is not found[0]:
            continue
        np.testing.assert_allclose(new, changed.factor * old, rtol=1e-12, err_msg=where)
    return "read"


def run(tmp_path: Path, count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    whole = {name: read(tmp_path / "whole.txt", name, data) for name, data in FILES.items()}
    names = sorted(FILES)
    outcomes: dict[str, int] = dict.fromkeys(("read", "warned", "refused"), 0)
    kinds: set[str] = set()
    while sum(outcomes.values()) < count:
        name = names[rng.integers(len(names))]
        changed = change(name, FILES[name], rng)
        if changed is not None:
            outcomes[judge(tmp_path / "changed.txt", name, changed, whole[name])] += 1
            kinds.add(changed.kind)
    assert len(kinds) == 12
    assert min(outcomes.values()) > count // 20


@pytest.mark.slow
def test_three_hundred_changes(tmp_path: Path) -> None:
    run(tmp_path, 300, seed=1971)
