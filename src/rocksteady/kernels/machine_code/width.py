"""Number of cells that a kernel follows side by side: many on a processor, one on a device.

On a processor the loops over lanes are vectors.  On a device each thread follows one cell, and
threads are what runs side by side: the build of a device sets `ON_DEVICE` before it imports any
kernel, and every loop over lanes then has one pass.
"""

ON_DEVICE = False
"""Whether the kernels imported from now on are for a device."""


def side_by_side(cells: int) -> int:
    """Return how many cells a kernel made for so many is to follow at a time.

    Examples
    --------
    >>> from rocksteady.kernels.machine_code.width import side_by_side
    >>> side_by_side(48)
    48
    """
    return 1 if ON_DEVICE else cells
