"""Checksums that tie each file to its sweep, output and chunk.

Those of zarr's codecs accept a file that was copied over a sibling.
"""

import hashlib
import re
from collections.abc import Mapping, Sequence
from typing import Any

from rocksteady.sweep.cases.inputs import as_text

HEX = 32
"""Digits of an identity."""
BYTES = 8
"""Of a checksum."""
NAMED = "name the folder that a sweep wrote, as map.zarr"
"""What to do where a folder or a file in it is no sweep's."""


def identity_of(inputs: Mapping[str, Any], box: Sequence[int]) -> str:
    """Return the identity of a sweep that is kept in chunks of a shape."""
    text = f"{as_text(inputs)}\0{list(box)}"
    return hashlib.blake2b(text.encode(), digest_size=HEX // 2).hexdigest()


def is_identity(value: object) -> bool:
    """Return whether a value has the form of an identity."""
    return isinstance(value, str) and re.fullmatch(rf"[0-9a-f]{{{HEX}}}", value) is not None


def checksum(identity: str, output: str, chunk: int, content: bytes) -> int:
    """Return the checksum of a file of a chunk, for this sweep, output and chunk alone; never 0."""
    digest = hashlib.blake2b(digest_size=BYTES, key=bytes.fromhex(identity))
    digest.update(f"{output}\0{chunk}\0".encode())
    digest.update(content)
    return int.from_bytes(digest.digest(), "little") or 1
