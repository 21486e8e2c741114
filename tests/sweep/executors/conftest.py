"""The cluster that the tests of one module share."""

from collections.abc import Iterator

import pytest

from rocksteady.sweep.executors._local import Local


@pytest.fixture(scope="module")
def there() -> Iterator[Local]:
    """A cluster of two workers."""
    with Local(2) as members:
        members.client.wait_for_workers(2)
        yield members


@pytest.fixture(scope="module")
def address(there: Local) -> str:
    return there.address
