"""How a sweep is run: what is valid, and what it is refused for."""

from pathlib import Path
from typing import Any

import pytest

from rocksteady.errors import InputError, ModelError
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store.store import Store
from tests.every import every


@every(
    ("arguments", "valid"),
    [
        ({"executor": "cloud"}, "one of threads, gpu, dask, serial"),
        ({"executor": None}, "one of threads, gpu, dask, serial"),
        ({"executor": "tcp://nowhere"}, "executor = 'tcp://nowhere' is not valid"),
        ({"workers": 0}, "from 1 to 1024"),
        ({"workers": 2.0}, "from 1 to 1024"),
        ({"store": 3}, "store = 3 is not valid"),
        ({"progress": 3}, "progress = 3 is not valid"),
    ],
)
def test_arguments_are_validated(arguments: dict[str, Any], valid: str) -> None:
    with pytest.raises(InputError, match=valid):
        Execution(**arguments)


def test_a_path_is_a_new_store() -> None:
    store = Store("a.zarr", resume=True)
    assert Execution(store=store).place is store
    assert (
        Execution(store="a.zarr").place == Execution(store=Path("a.zarr")).place == Store("a.zarr")
    )
    assert Execution().place is None


def test_a_store_is_refused_where_results_stay_in_memory() -> None:
    run = Execution(executor="serial", workers=3)
    assert run.in_memory("it is kept in memory") is run
    assert Execution().in_memory("it is kept in memory") == Execution()
    with pytest.raises(
        ModelError, match="run has a store: it is kept in memory; give a Run without one"
    ):
        Execution(store="a.zarr").in_memory("it is kept in memory")
