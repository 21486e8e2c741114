"""Many cases in one test: which fail is said, a skip ends no other case, and nothing is shared."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.every import every


def run(check: Any, **fixtures: Any) -> None:
    """Run a made test."""
    check(**fixtures)


def test_each_case_that_fails_is_named_and_the_others_are_checked() -> None:
    seen = []

    @every(("a", "b"), [(1, 1), (1, 2), pytest.param(2, 2, id="two"), (3, 1)])
    def check(a: int, b: int) -> None:
        seen.append(a)
        assert a == b

    with pytest.raises(AssertionError, match=r"2 of 4 cases fail\n1, 2: .*(\n.*)*\n3, 1: "):
        run(check)
    assert seen == [1, 1, 2, 3]


def test_errors_and_missing_errors_are_failures_of_their_case() -> None:
    @every("divisor", [1, 0])
    def check(divisor: int) -> None:
        with pytest.raises(ValueError, match="none"):
            assert 1 / divisor

    with pytest.raises(AssertionError, match="2 of 2 cases fail"):
        run(check)


def test_a_case_that_is_skipped_ends_no_other() -> None:
    @every("name", ["skipped", "fails"])
    def one(name: str) -> None:
        if name == "skipped":
            pytest.skip("not here")
        raise AssertionError(name)

    with pytest.raises(AssertionError, match="1 of 2 cases fail"):
        run(one)
    for cases in (["skipped"], []):

        @every("name", cases)
        def none(name: str) -> None:
            pytest.skip(name)

        with pytest.raises(pytest.skip.Exception, match=r"skipped|no case"):
            run(none)


def test_cases_share_neither_folder_nor_patches_nor_output(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    thing, folders = SimpleNamespace(value=0), set()

    @every("first", [1, 2])
    @every("second", [3, 4])
    def check(
        first: int,
        second: int,
        tmp_path: Path,
        monkeypatch: pytest.MonkeyPatch,
        capsys: pytest.CaptureFixture[str],
    ) -> None:
        assert thing.value == 0
        assert list(tmp_path.iterdir()) == []
        monkeypatch.setattr(thing, "value", first + second)
        (tmp_path / "file").touch()
        folders.add(tmp_path)
        print(first)  # noqa: T201
        assert capsys.readouterr().out == f"{first}\n"
        print("left over")  # noqa: T201

    run(check, tmp_path=tmp_path, monkeypatch=monkeypatch, capsys=capsys)
    assert (thing.value, len(folders)) == (0, 4)


def test_a_marked_case_and_a_parameter_that_there_is_not_are_refused() -> None:
    with pytest.raises(AssertionError, match="stays one of its own"):
        every("a", [pytest.param(1, marks=pytest.mark.slow)])
    with pytest.raises(AssertionError, match="no parameters"):
        every("b", [1])(run)
