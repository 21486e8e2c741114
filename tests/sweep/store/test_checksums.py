"""Checksums: a file of another sweep, output, chunk or content has another."""

import hashlib
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.sweep.store._checksums import checksum, identity_of, is_identity
from tests.every import every

INPUTS: dict[str, Any] = {"case": "some", "axes": {"a": {"points": 3}}, "factor": 1.0}
IDENTITY = identity_of(INPUTS, (1, 3))
identities = st.binary(min_size=16, max_size=16).map(bytes.hex)


def test_an_identity_is_that_of_the_inputs_and_the_chunks_alone() -> None:
    assert is_identity(IDENTITY)
    assert identity_of(dict(INPUTS), [1, 3]) == IDENTITY
    others = [
        identity_of({**INPUTS, "factor": 1.0 + 2.0**-52}, (1, 3)),
        identity_of({**INPUTS, "axes": {"a": {"points": 4}}}, (1, 3)),
        identity_of({**INPUTS, "more": None}, (1, 3)),
        identity_of(INPUTS, (3, 1)),
        identity_of(INPUTS, (1, 3, 1)),
    ]
    assert len({IDENTITY, *others}) == 1 + len(others)


@every("value", [None, 7, "", "0" * 31, "0" * 33, "G" * 32, "A" * 32, f"{'0' * 32}\n", b"0" * 32])
def test_anything_else_is_no_identity(value: object) -> None:
    assert not is_identity(value)


@given(identities, st.text(max_size=5), st.integers(0, 10**6), st.binary(max_size=20))
def test_a_checksum_is_the_keyed_hash_of_place_and_content(
    identity: str, output: str, chunk: int, content: bytes
) -> None:
    # Stores on disk hold it: it may never change.
    text = output.encode() + b"\0" + str(chunk).encode() + b"\0" + content
    expected = hashlib.blake2b(text, digest_size=8, key=bytes.fromhex(identity)).digest()
    assert checksum(identity, output, chunk, content).to_bytes(8, "little") == expected


@given(st.binary(max_size=20), st.binary(max_size=20))
def test_other_places_and_contents_have_other_checksums(content: bytes, more: bytes) -> None:
    found = [
        checksum(IDENTITY, "value", 12, content),
        checksum(identity_of(INPUTS, (3, 1)), "value", 12, content),
        checksum(IDENTITY, "values", 12, content),
        checksum(IDENTITY, "value", 1, content),
        checksum(IDENTITY, "value", 1, b"2" + content),
        checksum(IDENTITY, "value", 12, content + b"0" + more),
    ]
    assert len(set(found)) == len(found)


def test_no_checksum_is_that_of_an_unfinished_chunk(monkeypatch: pytest.MonkeyPatch) -> None:
    class Zero:
        def __init__(self, **_: object) -> None: ...

        def update(self, content: bytes) -> None: ...

        def digest(self) -> bytes:
            return bytes(8)

    monkeypatch.setattr(hashlib, "blake2b", Zero)
    assert checksum(IDENTITY, "value", 0, b"") == 1
