"""What runs kernels, and how they are compiled."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from rocksteady.errors import InputError, MissingKernelsError
from rocksteady.kernels.machine_code import compilation
from rocksteady.kernels.machine_code.compilation import CHOICE, PURE, compiled, runner
from rocksteady.kernels.march.march import march
from tests.every import every
from tests.strategies import PLAIN


@pytest.fixture(autouse=True)
def _chosen_anew(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.delenv(CHOICE, raising=False)
    runner.cache_clear()
    yield
    runner.cache_clear()


@pytest.fixture
def without_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An installation without a library; return the folder where it would be."""
    monkeypatch.setattr(compilation, "library", lambda: None)
    monkeypatch.setattr(compilation, "libraries_folder", lambda: tmp_path)
    return tmp_path


def test_the_library_runs_kernels_where_there_is_one() -> None:
    assert runner() == "library"


def test_without_a_library_plain_python_does_and_a_warning_says_why(without_library: Path) -> None:
    with pytest.warns(RuntimeWarning, match=r"\d+ times slower: this installation has no"):
        assert runner() == "python"
    (without_library / PURE).write_text("numba has no wheel for this Python\n", "utf-8")
    runner.cache_clear()
    with pytest.warns(RuntimeWarning, match="slower: numba has no wheel for this Python$") as said:
        assert runner() == "python"
    assert len(said) == 1


@pytest.mark.usefixtures("without_library")
def test_who_asks_for_python_is_not_warned_and_who_asks_for_a_library_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(CHOICE, "python")
    assert runner() == "python"
    runner.cache_clear()
    monkeypatch.setenv(CHOICE, "library")
    with pytest.raises(MissingKernelsError, match=r"is not in this installation.*unset"):
        runner()


@every("word", ["jit", "Library", "0"])
def test_another_word_is_refused(word: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(CHOICE, word)
        with pytest.raises(InputError, match=f"{CHOICE} = '{word}' is not valid"):
            runner()


def test_a_kernel_that_the_library_lacks_runs_as_python() -> None:
    @compiled
    def double(number: float) -> float:
        return 2.0 * number

    assert double(2.0) == 4.0


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_kernels_are_compiled_without_fast_math() -> None:
    from tools.aot.dispatch import dispatcher

    options = dispatcher(march).targetoptions
    assert options["error_model"] == "numpy"
    assert not options.get("fastmath")


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_a_kernel_that_returns_another_type_than_it_says_is_not_compiled() -> None:
    from tools.aot.dispatch import compile_kernel

    @compiled
    def count(number: int) -> float:
        return number

    with pytest.raises(TypeError, match="count returns int64, its annotation says float64"):
        compile_kernel(count)  # type: ignore[arg-type]
