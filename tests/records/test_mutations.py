"""Hundreds of files that are not as they should be: each is read right, or refused in one line."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.records import Recording, read_recordings
from tests.every import every
from tests.records import FOLDER
from tests.records.mutations import KINDS, Mutation, mutation
from tests.records.writers import (
    at2,
    cosmos_channel,
    csmip_v2_channel,
    csv,
    esm,
    knet,
    samples,
    smc,
)

CM = samples(403, peak=150.0)
COUNTS = np.rint(1e5 * samples(800)).astype(np.int64) - 12085
WRITTEN = {
    "peer-at2": at2(samples(403)),
    "peer-at2, old": at2(samples(403), counts="{count} {dt:.4f} NPTS, DT"),
    "esm-ascii": esm(CM),
    "knet": knet(COUNTS),
    "cosmos-v2": cosmos_channel(CM) + cosmos_channel(CM / 2, channel=2, azimuth=400),
    "csmip-v2": csmip_v2_channel(CM) + csmip_v2_channel(CM / 2, channel=2, name="Up"),
    "smc": smc(CM),
    "csv": csv(samples(403)),
    "columns": "".join(f"{value:.6f}\n" for value in samples(403)),
}
CHANGING_COUNTS = {"number replaced", "garbled", "garbled header", "inserted"}
"""What may make another number of samples the right one."""
GIVEN = {"columns": {"units": "g", "dt_s": 0.01}}


def bases() -> dict[str, bytes]:
    """Files as they should be: one of each format, and short real ones where they are at hand."""
    found = {name: text.encode() for name, text in WRITTEN.items()}
    for path in sorted(FOLDER.glob("formats/*")) + sorted(FOLDER.glob("suite_at2/?Z*")):
        if path.stat().st_size < 200_000:
            found[path.name] = path.read_bytes().replace(b"\r\n", b"\n")
    return found


def mutations(count: int, seed: int) -> Iterator[tuple[str, Mutation]]:
    rng = np.random.default_rng(seed)
    files = bases()
    names = sorted(files)
    for _ in range(count):
        name = names[rng.integers(len(names))]
        yield name, mutation(files[name], rng)


def judge(path: Path, name: str, wrong: Mutation, whole: tuple[Recording, ...]) -> str:
    """Read a file that is not as it should be, and return what came of it."""
    path.write_bytes(wrong.data)
    where = f"{name}, {wrong.kind}"
    try:
        found = read_recordings(path, **GIVEN.get(name, {}))  # type: ignore[arg-type]
    except InputError as error:
        message = str(error)
        assert wrong.outcome != "same", f"{where}: {message}"
        assert "\n" not in message, where
        assert "cannot be read" in message, where
        assert len(message) < 700, where
        return "refused"
    assert wrong.outcome != "refused", where
    assert found, where
    if wrong.outcome == "same":
        for one, other in zip(found, whole, strict=True):
            assert one.record.dt_s == other.record.dt_s, where
            np.testing.assert_array_equal(values(one), values(other), err_msg=where)
    if name not in {"columns", "csv"} and wrong.kind not in CHANGING_COUNTS:
        for one, other in zip(found, whole, strict=False):
            assert len(values(one)) == len(values(other)) or one.warnings, where
            if wrong.kind.startswith("cut") and one.warnings == other.warnings:
                np.testing.assert_array_equal(values(one), values(other), err_msg=where)
    tables = {"csv", "columns"}
    for one in found:
        # A damaged file of a network is no table.
        assert one.format not in tables or whole[0].format in tables, where
        assert np.isfinite(values(one)).all(), where
        assert one.record.dt_s > 0.0, where
    return "read"


def values(recording: Recording) -> NDArray[np.float64]:
    return recording.record.acceleration_m_s2


def run(tmp_path: Path, count: int, seed: int) -> None:
    whole: dict[str, tuple[Recording, ...]] = {}
    kinds: set[str] = set()
    outcomes: dict[str, int] = {"read": 0, "refused": 0}
    path = tmp_path / "whole.txt"
    for name, data in bases().items():
        path.write_bytes(data)
        whole[name] = read_recordings(path, **GIVEN.get(name, {}))  # type: ignore[arg-type]
    for name, wrong in mutations(count, seed):
        outcomes[judge(tmp_path / "mutated.txt", name, wrong, whole[name])] += 1
        kinds.add(wrong.kind)
    assert kinds == set(KINDS)
    assert min(outcomes.values()) > count // 6


def test_eighty_files(tmp_path: Path) -> None:
    run(tmp_path, 80, seed=1995)


@pytest.mark.slow
def test_hundred_and_fifty_files(tmp_path: Path) -> None:
    run(tmp_path, 150, seed=1989)


@every("name", sorted(WRITTEN))
def test_no_prefix_of_a_file_is_taken_for_the_whole(tmp_path: Path, name: str) -> None:
    if name in {"columns", "csv"}:
        pytest.skip("a table does not state how many rows it has")
    data = WRITTEN[name].encode()
    path = tmp_path / "cut.txt"
    path.write_bytes(data)
    whole = read_recordings(path)
    for at in range(7, len(data), 997):
        path.write_bytes(data[:at])
        try:
            found = read_recordings(path)
        except InputError:
            continue
        for one, other in zip(found, whole, strict=False):
            assert len(values(one)) == len(values(other))
