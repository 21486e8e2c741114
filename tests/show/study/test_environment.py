"""What a study runs on, in its own words."""

import platform
from dataclasses import replace
from importlib.metadata import version

import pytest

from rocksteady.installation import check_installation
from rocksteady.show.study import environment
from tests.every import every


@every("target", [None, "linux-aarch64"])
def test_a_study_says_what_it_runs_on(target: str | None) -> None:
    here = replace(check_installation(repeat_calls=False), target=target)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(environment, "check_installation", lambda **_: here)
        said = environment.environment().split(", ")
    assert said == [
        f"Python {platform.python_version()}",
        f"numpy {version('numpy')}",
        "kernels compiled for linux-aarch64" if target else "kernels not compiled",
        f"matplotlib {version('matplotlib')}",
        f"{platform.system()} on {platform.machine()}",
    ]
