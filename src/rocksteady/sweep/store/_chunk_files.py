"""Reader of chunk files that refuses any file with a wrong checksum.

zarr itself gives the fill value in place of a missing file, without an error.
"""

from collections.abc import Mapping

from zarr.abc.store import ByteRequest
from zarr.core.buffer import Buffer, BufferPrototype
from zarr.storage import LocalStore

from rocksteady.small_files import refuse_device
from rocksteady.sweep.store._checksums import NAMED, checksum


class ChunkFiles(LocalStore):
    """A folder as zarr reads it, in which each file of a finished chunk has a checksum."""

    _expected: Mapping[str, tuple[str, int, int]] = {}
    _sweep = ""

    def check(self, expected: Mapping[str, tuple[str, int, int]], sweep: str) -> None:
        """Check files from now on.

        Parameters
        ----------
        expected
            Output, number of the chunk and checksum of each file, by its relative path.
        sweep
            Identity of the sweep.
        """
        self._expected = expected
        self._sweep = sweep

    async def get(
        self,
        key: str,
        prototype: BufferPrototype | None = None,
        byte_range: ByteRequest | None = None,
    ) -> Buffer | None:
        """Return the content of a file, whole where it is checked."""
        refuse_device(self.root / key, "store", NAMED)
        data = await super().get(key, prototype, byte_range)
        return self._checked(key, data)

    def get_sync(
        self,
        key: str,
        *,
        prototype: BufferPrototype | None = None,
        byte_range: ByteRequest | None = None,
    ) -> Buffer | None:
        """Return the content of a file, whole where it is checked."""
        refuse_device(self.root / key, "store", NAMED)
        return self._checked(key, super().get_sync(key, prototype=prototype, byte_range=byte_range))

    def _checked(self, key: str, data: Buffer | None) -> Buffer | None:
        if key not in self._expected:
            return data
        name, chunk, expected = self._expected[key]
        if data is None or checksum(self._sweep, name, chunk, data.to_bytes()) != expected:
            message = f"its file {key} is damaged, or that of another place"
            raise ValueError(message)
        return data
