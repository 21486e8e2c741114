"""What tests of assessments share."""

import pytest

from rocksteady.risk.assess import assessment


@pytest.fixture
def no_remedies(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out the search for remedies, half of an assessment, where no test looks at them."""
    monkeypatch.setattr(assessment, "find_remedies", lambda _: ())
