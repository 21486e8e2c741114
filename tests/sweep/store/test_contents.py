"""What lies in a store: its arrays, its files, and which chunks are finished."""

import json
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import InputError, OutputError, RocksteadyError
from rocksteady.sweep.store._checksums import checksum, identity_of
from rocksteady.sweep.store._contents import (
    Contents,
    attributes_in,
    contents_of,
    refuse_taken,
    said,
)
from tests.sweep.executors.cases import GRID, OUTPUTS
from tests.sweep.store.faults import CHUNKS


def refused(valid: str) -> RocksteadyError:
    return OutputError("store", "a.zarr", valid, "name another")


def contents(folder: Path) -> Contents:
    return contents_of(folder, refused)


def test_the_arrays_come_in_the_order_of_the_sweep(undisturbed: Path) -> None:
    found = contents(undisturbed)
    assert list(found.outputs) == [output.name for output in OUTPUTS]
    assert list(found.axes) == list(GRID.names)
    for axis in GRID.axes:
        np.testing.assert_array_equal(np.asarray(found.axes[axis.name][:]), axis.points)
    assert found.chunks.shape == GRID.shape
    assert len(found.chunks) == CHUNKS
    assert found.inputs["axes"].keys() == set(GRID.names)


def test_every_file_has_the_checksum_of_its_place_and_content(undisturbed: Path) -> None:
    found = contents(undisturbed)
    assert found.flagged().all()
    assert found.complete(found.flagged()).all()
    identity = identity_of(found.inputs, found.chunks.box)
    checked = found.checked_files()
    assert len(checked) == CHUNKS * len(OUTPUTS)
    for path, (name, chunk, expected) in checked.items():
        content = (undisturbed / path).read_bytes()
        assert checksum(identity, name, chunk, content) == expected
        assert undisturbed / path in found.files(chunk)
    # All files of chunks are those of one chunk, and nothing else lies beside the descriptions.
    files = [file for chunk in range(CHUNKS) for file in found.files(chunk)]
    assert len(files) == len(set(files)) == CHUNKS * (1 + len(OUTPUTS))
    assert all(file.is_file() for file in files)


def test_a_chunk_is_finished_with_its_checksums_and_complete_with_its_files(begun: Path) -> None:
    whole = contents(begun)
    whole.files(1)[0].unlink()
    whole.files(2)[1].unlink()
    flag = whole.files(3)[0]
    flag.write_bytes(flag.read_bytes()[:-1])
    found = contents(begun)
    assert np.flatnonzero(~found.flagged()).tolist() == [1, 3]
    assert np.flatnonzero(~found.complete(found.flagged())).tolist() == [1, 2, 3]
    assert (found.sums()[[1, 3]] == 0).all()
    np.testing.assert_array_equal(found.sums()[2], whole.sums()[2])
    assert {chunk for _, chunk, _ in found.checked_files().values()} == {0, 2, 4, 5}


def test_attributes_that_cannot_be_read_are_none(begun: Path) -> None:
    there = attributes_in(begun)
    assert there is not None
    assert json.loads(there["inputs"]) == contents(begun).inputs
    group = begun / "zarr.json"
    for text in ("{", "[]", "{}", '{"attributes": {}}', '{"attributes": {"inputs": "{"}}'):
        group.write_text(text)
        assert attributes_in(begun) is None
    group.unlink()
    assert attributes_in(begun) is None


def test_values_of_an_axis_that_were_not_written_are_refused(begun: Path) -> None:
    axis = contents(begun).axes["b"]
    file = begun / "b" / axis.metadata.encode_chunk_key((0,))
    other = begun / "a" / axis.metadata.encode_chunk_key((0,))
    file.write_bytes(other.read_bytes())
    with pytest.raises(OutputError, match="it cannot be read: ") as caught:
        contents(begun)
    assert "\n" not in str(caught.value)


def test_the_names_of_the_store_itself_are_taken() -> None:
    refuse_taken(["amplitude", "kind", "done2"])
    for name in ("done", "chunk", "computed"):
        with pytest.raises(InputError, match=f"{name}' is not valid: a store has done, chunk"):
            refuse_taken(["amplitude", name])


def test_an_error_is_said_in_one_line() -> None:
    assert said(ValueError("one\n  two")) == "one two"
    assert said(OSError(28, "No space\nleft")) == "No space left"
    assert said(KeyError()) == "KeyError"
