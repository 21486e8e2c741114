"""Priors of all objects alike, from Python and from TOML."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocksteady.errors import InputError, RocksteadyError
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.prior import OutcomeErrors, Prior, read_prior
from rocksteady.risk.observations.spread import PriorRange
from tests.every import every


def written(tmp_path: Path, text: str | bytes) -> Path:
    file = tmp_path / "prior.toml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


def test_a_file_gives_noise_and_defaults_and_its_hash(tmp_path: Path) -> None:
    text = (
        '[noise]\nsigma_ln = "0.1+-0.02"\noutliers = 0\n[object]\nbase = "0.7:0.9"\nscatter = 0\n'
    )
    prior = read_prior(written(tmp_path, "\ufeff" + text))
    assert prior.noise.sigma_ln == PriorRange.around(0.1, 0.02, low=0.0, high=3.0)
    assert prior.noise.outliers == PriorRange.exactly(0.0)
    assert list(prior.sources) == ["prior.toml"]
    stone = prior.object_prior(ObjectPrior(name="a", width_m=0.2, height_m=1, scatter=0.05))
    assert stone.spreads["base"] == PriorRange.between(0.7, 0.9)
    assert stone.spreads["scatter"] == PriorRange.exactly(0.05)  # its own
    assert stone.defaults == ("offset", "housner_factor")


def test_an_empty_file_is_the_default_prior(tmp_path: Path) -> None:
    prior = read_prior(written(tmp_path, ""))
    assert prior.noise == OutcomeErrors() == Prior().noise
    assert [str(prior.noise.sigma_ln), str(prior.noise.outliers)] == ["0.05:0.2", "0.01:0.05"]
    assert dict(prior.defaults) == {}


@every(
    ("text", "line"),
    [
        ("[nois]\n", "prior.toml: nois is unknown: the tables are [noise] and [object]"),
        ("[[noise]]\n", "prior.toml: noise is no table: "),
        ("[noise]\nsigma = 0.1\n", "[noise] sigma is unknown: the keys of [noise] are sigma_ln"),
        ("[object]\nbas = 0.1\n", "did you mean base?"),
        ("[object]\nbase = true\n", "prior.toml: [object] base = True is not valid"),
        ("[object]\nbase = [0.6, 1.0]\n", "[object] base = [0.6, 1.0] is not valid"),
        ("[object]\nbase = nan\n", "[object] base = nan is not valid"),
        (
            "[object]\nbase = 1.6\n",
            "prior.toml: [object] base = 1.6 is not valid: it must lie in [0.01, 1.5",
        ),
        ("[noise]\noutliers = 0.6\n", "prior.toml: [noise] outliers = 0.6 is not valid"),
        ("[noise]\nsigma_ln = -0.1\n", "prior.toml: [noise] sigma_ln = -0.1 is not valid"),
        (
            "[object]\nrestitution = 0.9\nhousner_factor = 1\n",
            "housner_factor are both given",
        ),
        ("[object]\nbase = .6\n", "it is not TOML"),
        ("[object]\nbase = " + "9" * 5000, "its numbers are long beyond reason"),
        (b"\xff", "byte 1 is not UTF-8, as TOML must be"),
        (b"a\0", "line 1 has a zero byte"),
    ],
)
def test_a_fault_is_one_line(text: str | bytes, line: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as refusal:
        read_prior(written(tmp_path, text))
    assert line in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("name", ["missing.toml", "."])
def test_a_file_that_is_none_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"prior = .* is not valid"):
        read_prior(tmp_path / name)


@pytest.mark.parametrize(
    ("given", "line"),
    [({"bass": 1}, "did you mean base?"), ({"width_m": 1}, "sizes in the table of objects")],
)
def test_only_what_all_objects_share_is_a_default(given: dict[str, Any], line: str) -> None:
    with pytest.raises(InputError, match=r"^defaults = ") as refusal:
        Prior(defaults=given)
    assert line in str(refusal.value)


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.binary(max_size=60) | st.text(max_size=60).map(str.encode))
def test_whatever_a_file_holds_it_is_read_or_refused(content: bytes, tmp_path: Path) -> None:
    try:
        read_prior(written(tmp_path, content))
    except RocksteadyError as error:
        assert "\n" not in str(error)  # noqa: PT017
