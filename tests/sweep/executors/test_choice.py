"""Executors by their names: what is no name and no address of a scheduler is refused."""

from pathlib import Path

import pytest

from rocksteady.errors import InputError
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.executors.choice import EXECUTORS, validated_executor
from rocksteady.sweep.run import Execution
from tests.every import every
from tests.sweep.executors.cases import GRID, OUTPUTS, some


@every(
    ("given_address", "why"),
    [
        ("nowhere://127.0.0.1:1", "dask accepts addresses of the kinds .*tcp, tls"),
        ("://127.0.0.1:1", "dask accepts addresses of the kinds"),
        ("tcp://tcp://127.0.0.1:1", "dask accepts addresses of the kinds"),
        ("tcp://", "it must have a host and a port"),
        ("tcp://:8786", "it must have a host and a port"),
        ("tcp://127.0.0.1", "it must have a host and a port"),
        ("tls://127.0.0.1:abc", "it must have a host and a port"),
        ("tcp://127.0.0.1:0", "it must have a host and a port"),
        ("tcp://127.0.0.1:65536", "it must have a host and a port"),
        ("tcp://[::1:8786", "it must have a host and a port"),
    ],
)
def test_what_is_no_address_is_refused_before_anything_is_written(
    given_address: str, why: str, tmp_path: Path
) -> None:
    store = tmp_path / "a.zarr"
    with pytest.raises(InputError, match=why):
        evaluate(some, GRID, OUTPUTS, run=Execution(executor=given_address, store=store))
    assert not store.exists()


@every("given_address", ["tcp://[::1]:8786", "tls://host:1", "inproc://1/2/3"])
def test_what_may_be_an_address_is_valid(given_address: str) -> None:
    assert validated_executor("executor", given_address) == given_address


def test_a_name_is_one_of_the_executors() -> None:
    for name in EXECUTORS:
        assert validated_executor("executor", name) == name
    for wrong in ("thread", "", "tcp:/host:1", 4, None, b"threads", ["threads"]):
        with pytest.raises(InputError, match=r"it must be one of .*dask scheduler"):
            validated_executor("executor", wrong)
