"""A running cluster: who else can reach it, and that there is a warning."""

import pytest

from rocksteady.sweep.executors import _remote
from rocksteady.sweep.executors._remote import open_to_others
from tests.every import every


@every(
    ("place", "expected"),
    [
        ("tcp://127.0.0.1:8786", False),
        ("tcp://127.3.2.1:8786", False),
        ("tcp://[::1]:8786", False),
        ("tcp://localhost:8786", False),
        ("127.0.0.1:8786", False),
        ("tls://first:8786", False),
        ("tls://10.0.0.1:8786", False),
        ("wss://first:8786", False),
        ("inproc://1/2/3", False),
        ("tcp://first:8786", True),
        ("first:8786", True),
        ("tcp://10.0.0.1:8786", True),
        ("tcp://[fe80::1%eth0]:8786", True),
        ("tcp://0.0.0.0:8786", True),
        ("ws://first:8786", True),
        ("tcp://localhost.example.org:8786", True),
    ],
)
def test_which_addresses_let_others_in(place: str, expected: bool) -> None:
    assert open_to_others(place) is expected


@pytest.mark.slow
def test_a_cluster_that_lets_others_in_is_announced(
    address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_remote, "open_to_others", lambda _: True)
    with (
        pytest.warns(UserWarning, match=r"has no TLS: everyone who reaches .*; give a tls://"),
        _remote.Remote(address, None) as cluster,
    ):
        assert cluster.most_running() >= 1
