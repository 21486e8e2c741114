"""The cluster that the tests of one module share."""

from collections.abc import Iterator

import pytest

from rocksteady.sweep.executors._local import Local


@pytest.fixture(scope="module")
def local_cluster() -> Iterator[Local]:
    """A cluster of two workers."""
    with Local(2) as cluster:
        cluster.client.wait_for_workers(2)
        yield cluster


@pytest.fixture(scope="module")
def address(local_cluster: Local) -> str:
    return local_cluster.address
