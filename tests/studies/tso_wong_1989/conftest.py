"""The whole study is computed once in a session, before the first test that looks at it."""

import pytest

from tests.studies.tso_wong_1989.whole import study


@pytest.fixture(scope="session")
def computed() -> None:
    """Compute every figure and every statement; nothing is drawn."""
    study()
