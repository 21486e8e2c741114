"""Values of a dataset in parts: they make the whole, and no part is larger than allowed."""

import numpy as np
import pytest
import xarray

from rocksteady.sweep.cases import facts
from rocksteady.sweep.cases.facts import slabs


def test_slabs_make_the_whole_of_any_shape(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(facts, "SLAB", 6)
    for shape, count in (((), 1), ((0,), 1), ((3, 0), 1), ((5,), 1), ((14,), 3), ((5, 4), 5)):
        one = np.arange(np.prod(shape, dtype=int)).reshape(shape)
        dims = [f"d{k}" for k in range(len(shape))]
        dataset = xarray.Dataset({"one": (dims, one), "two": (dims, -one)})
        parts = list(slabs(dataset, "one", "two"))
        assert len(parts) == count, shape
        for index, whole in enumerate((one, -one)):
            values = [part[index] for part in parts]
            joined = np.concatenate(values) if shape else values[0]
            assert joined.tolist() == whole.tolist(), shape
