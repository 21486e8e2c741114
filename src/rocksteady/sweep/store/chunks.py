"""Chunks of a store: boxes of consecutively numbered cells."""

import math
from dataclasses import dataclass
from functools import cached_property

from rocksteady.sweep.cases.task import CellRange

FEWEST = 4096
USUAL = 65_536
IN_ALL = 64
"""A store has about so many chunks, of so few or so many cells: what is lost with an unfinished
chunk is a small part of the work, and what it costs to write one (some milliseconds) as well."""
MOST = 2**22
AT_MOST = 4096
"""A store of more than 4096 chunks of the usual size has larger ones, up to this: each is a file
for every output, and looked at when the store is opened."""


@dataclass(frozen=True, kw_only=True)
class Chunks:
    """A grid in boxes: the last axes whole, one axis in parts, the others point by point.

    So the cells of a chunk are a range in C order, and chunks are ranges one after another.

    Attributes
    ----------
    shape
        Shape of the grid.
    box
        Shape of a chunk; the last along an axis may be smaller.

    Examples
    --------
    >>> chunks = Chunks.of((3, 100, 50), 1000)
    >>> chunks.box, len(chunks)
    ((1, 20, 50), 15)
    >>> chunks.cells(6), chunks.place(6)
    ((6000, 7000), (1, 1, 0))
    """

    shape: tuple[int, ...]
    box: tuple[int, ...]

    @classmethod
    def of(
        cls, shape: tuple[int, ...], cells: int | None = None, *, batch: int = FEWEST
    ) -> "Chunks":
        """Return chunks of up to a number of cells; for None, of a number that suits the grid.

        `batch` is the most cells of one call: of slow cells fewer are lost with a chunk.
        """
        most = suitable(math.prod(shape), batch) if cells is None else cells
        box = [1] * len(shape)
        for axis in reversed(range(len(shape))):
            box[axis] = min(shape[axis], most)
            most //= box[axis]
            if box[axis] < shape[axis]:
                break
        return cls(shape=shape, box=tuple(box))

    @cached_property
    def counts(self) -> tuple[int, ...]:
        """Number of chunks along each axis."""
        return tuple(-(-n // b) for n, b in zip(self.shape, self.box, strict=True))

    @property
    def size(self) -> int:
        """Number of cells."""
        return math.prod(self.shape)

    def __len__(self) -> int:
        return math.prod(self.counts)

    def place(self, chunk: int) -> tuple[int, ...]:
        """Return which one along each axis a chunk is."""
        place = []
        for count in reversed(self.counts):
            chunk, index = divmod(chunk, count)
            place.append(index)
        return tuple(reversed(place))

    def region(self, chunk: int) -> tuple[slice, ...]:
        """Return where a chunk is in an array over the grid."""
        ends = zip(self.place(chunk), self.box, self.shape, strict=True)
        return tuple(slice(i * b, min((i + 1) * b, n)) for i, b, n in ends)

    def cells(self, chunk: int) -> CellRange:
        """Return the range of cells of a chunk."""
        region = self.region(chunk)
        first = 0
        for part, length in zip(region, self.shape, strict=True):
            first = first * length + part.start
        return first, first + math.prod(part.stop - part.start for part in region)

    def containing(self, cell: int) -> int:
        """Return the chunk of a cell."""
        index = []
        for length in reversed(self.shape):
            cell, here = divmod(cell, length)
            index.append(here)
        chunk = 0
        for here, b, count in zip(reversed(index), self.box, self.counts, strict=True):
            chunk = chunk * count + here // b
        return chunk


def suitable(cells: int, batch: int = FEWEST) -> int:
    """Return the default number of cells in a chunk."""
    return max(min(FEWEST, batch), min(USUAL, -(-cells // IN_ALL)), min(MOST, -(-cells // AT_MOST)))
