"""Numbers in equal ratios: the one place where a logarithmic axis is made."""

from rocksteady.kernels.elementary.arrays import exp, log


def in_equal_ratios(start: float, stop: float, count: int) -> list[float]:
    """Return numbers from `start` to `stop`, each the same multiple of the one before.

    Parameters
    ----------
    start, stop
        The ends, above 0; they are in the list as they are given.
    count
        Number of values, both ends included; at least 2.

    Examples
    --------
    >>> in_equal_ratios(1.0, 8.0, 4)
    [1.0, 2.0, 4.0, 8.0]
    """
    import numpy as np  # not before an axis is needed: flags are read at once

    last = count - 1
    inner = start * exp(log(stop / start) * np.arange(1, last) / last)
    return [start, *inner.tolist(), stop]
