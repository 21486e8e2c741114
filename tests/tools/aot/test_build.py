"""Building for this machine: what is written is whole, and what is there is not built again."""

import subprocess
import sys
from pathlib import Path

import pytest

from rocksteady.kernels.machine_code.library import is_whole, targets
from tests.every import every
from tests.strategies import PLAIN
from tools.aot import __main__ as program
from tools.aot import inputs
from tools.aot.build import publish
from tools.aot.link import LinkError


def test_a_file_is_published_with_its_checksum(tmp_path: Path) -> None:
    file = tmp_path / "library.so"
    publish(file, b"first", "tools")
    assert is_whole(file)
    publish(file, b"second", "tools")
    assert (file.read_bytes(), is_whole(file)) == (b"second", True)


@pytest.mark.parametrize("step", ["write_bytes", "replace"])
def test_an_interrupted_build_leaves_the_old_file_whole_and_nothing_beside_it(
    step: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "library.so"
    publish(file, b"first", "tools")
    before = {each.name: each.read_bytes() for each in tmp_path.iterdir()}

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, step, interrupted)
    with pytest.raises(KeyboardInterrupt):
        publish(file, b"second", "tools")
    monkeypatch.undo()
    assert {each.name: each.read_bytes() for each in tmp_path.iterdir()} == before


@pytest.mark.skipif(PLAIN or not targets(), reason="nothing is compiled")
def test_what_is_there_is_not_built_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(program, "lowered", lambda: pytest.fail("it lowers the kernels"))
    assert program.main(["host"]) == 0
    assert inputs.is_made()


@every(
    ("error", "status"),
    [
        (LinkError("no compiler"), 1),
        (OSError("the disk is full"), 1),
        (subprocess.CalledProcessError(1, "one"), 1),
        (KeyboardInterrupt(), 130),
    ],
)
def test_a_build_that_fails_ends_in_one_line(error: BaseException, status: int) -> None:
    def fails(*_: object) -> None:
        raise error

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(program, "_make_all", fails)
        assert program.main(["host"]) == status


def test_a_platform_without_libraries_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(program, "is_made", lambda: False)
    monkeypatch.setattr(program, "targets", lambda: ())
    assert program.main(["host"]) == 1
    assert capsys.readouterr().err == "python -m tools.aot: no library is made for this platform\n"


def test_tools_find_the_package_whatever_is_on_the_path() -> None:
    """A front end takes an editable installation out of the path of the build's environment."""
    code = (
        f"import sys; sys.path[:0] = [{str(inputs.ROOT)!r}]; import tools.aot; "
        "import importlib.util; print(importlib.util.find_spec('rocksteady').origin)"
    )
    ran = subprocess.run(
        [sys.executable, "-S", "-c", code], capture_output=True, text=True, check=True
    )
    assert ran.stdout.strip() == str(inputs.ROOT / "src/rocksteady/__init__.py")
