"""Reads the files of chunks, and refuses one that is not what was written to its place."""

from zarr.abc.store import ByteRequest
from zarr.core.buffer import Buffer, BufferPrototype
from zarr.storage import LocalStore

from rocksteady.sweep.store._checksums import checksum
from rocksteady.sweep.store._contents import Contents


class ChunkFiles(LocalStore):
    """A folder as zarr reads it, in which each file of a finished chunk has a checksum."""

    _expected: dict[str, tuple[str, int, int]] = {}  # noqa: RUF012 -- replaced, never changed
    _sweep = ""

    def check(self, contents: Contents, sweep: str) -> None:
        """Check from now on the files of the chunks that are finished at this moment."""
        self._sweep = sweep
        sums = contents.sums()
        self._expected = {
            f"{name}/{array.metadata.encode_chunk_key(contents.chunks.place(chunk))}": (
                name,
                chunk,
                int(sums[chunk, number]),
            )
            for number, (name, array) in enumerate(contents.outputs.items())
            for chunk in sums[:, number].nonzero()[0].tolist()
        }

    async def get(
        self,
        key: str,
        prototype: BufferPrototype | None = None,
        byte_range: ByteRequest | None = None,
    ) -> Buffer | None:
        """Return the content of a file, whole where it is checked."""
        found = await super().get(key, prototype, byte_range)
        return self._checked(key, found)

    def get_sync(
        self,
        key: str,
        *,
        prototype: BufferPrototype | None = None,
        byte_range: ByteRequest | None = None,
    ) -> Buffer | None:
        """Return the content of a file, whole where it is checked."""
        return self._checked(key, super().get_sync(key, prototype=prototype, byte_range=byte_range))

    def _checked(self, key: str, found: Buffer | None) -> Buffer | None:
        if key not in self._expected:
            return found
        name, chunk, expected = self._expected[key]
        if found is None or checksum(self._sweep, name, chunk, found.to_bytes()) != expected:
            message = f"its file {key} is damaged, or that of another place"
            raise ValueError(message)
        return found
