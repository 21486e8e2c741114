"""`rocksteady doctor`: its contract, its screen, and its exit codes."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

import rocksteady as rs
from rocksteady.installation import check
from rocksteady.installation.check import Installation, KernelCheck
from tests.cli.program import refused, rocksteady

GOOD = KernelCheck(name="march", calls=16, values=7162, differing=0, first_difference=None)
BAD = KernelCheck(
    name="settle_cells",
    calls=6,
    values=1230,
    differing=2,
    first_difference="call 3 of 6, real[0, 1]: 0.5666704075316477 in place of 0.5666704075316478",
)
HEALTHY = Installation(
    system="Linux x86_64",
    cpu_level="x86-64-v4",
    kernels="library",
    library=Path("/usr/lib/rocksteady-linux-x86-64-v4.so"),
    target="linux-x86-64-v4",
    sources="0123456789abcdef",
    versions={"rocksteady": "1.2", "python": "3.12.1", "numpy": "2.1.0"},
    checks=(GOOD, replace(BAD, differing=0, first_difference=None)),
    gpu="NVIDIA H100, compute capability 9.0",
    no_gpu=None,
)
ILL = replace(
    HEALTHY,
    kernels="python",
    library=None,
    target=None,
    checks=(GOOD, BAD),
    gpu=None,
    no_gpu="cuda-python is not installed",
)


@pytest.fixture
def healthy(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check, "check_installation", lambda: HEALTHY)


@pytest.fixture
def ill(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check, "check_installation", lambda: ILL)


def test_the_command_explains_itself() -> None:
    assert "doctor" in rocksteady("--help").out
    ran = rocksteady("doctor --help")
    assert (ran.code, ran.err) == (0, "")
    for word in ("--json", "--check", "bits"):
        assert word in ran.out


@pytest.mark.usefixtures("healthy")
def test_the_screen_of_a_healthy_installation() -> None:
    ran = rocksteady("doctor --check")
    assert ran.code == 0
    assert ran.out == (
        "All 8,392 recorded values agree bit for bit: this installation is sound.\n"
        "  runs on          Python 3.12.1, NumPy 2.1.0, x86-64-v4\n"
        "  kernels          library, compiled ahead of time\n"
        "  GPU              NVIDIA H100, compute capability 9.0\n"
        "next: rocksteady simulate --width-m 0.6 --height-m 2 --start 0.6,0\n"
    )
    assert rocksteady("doctor --quiet").out == ran.out.splitlines(keepends=True)[0]
    assert rocksteady("doctor --more").out.removeprefix(ran.out) == (
        "all equal, bit for bit\n"
        "rocksteady  1.2\n"
        "runs on     Python 3.12.1, NumPy 2.1.0\n"
        "system      Linux x86_64, CPU level x86-64-v4\n"
        "kernels     library, compiled ahead of time\n"
        "sources     0123456789abcdef\n"
        "target      linux-x86-64-v4\n"
        "library     /usr/lib/rocksteady-linux-x86-64-v4.so\n"
        "GPU         NVIDIA H100, compute capability 9.0\n"
        "repeated    22 recorded calls of 2 kernels, 8,392 values\n"
    )


@pytest.mark.usefixtures("ill")
def test_the_screen_of_an_ill_one_names_each_kernel_that_differs() -> None:
    ran = rocksteady("doctor --more")
    assert ran.code == 0
    assert ran.out.startswith(
        "2 of 8,392 recorded values differ, in 1 kernel: this installation is faulty.\n"
    )
    assert "\n  differing        settle_cells\nnext: rocksteady doctor --more\n" in ran.out
    assert "\n2 values of 1 kernel differ; the other 1 kernel equal\n" in ran.out
    assert "kernels     plain Python, not compiled\n" in ran.out
    assert "GPU         none: cuda-python is not installed\n" in ran.out
    assert ran.out.endswith(
        "repeated    22 recorded calls of 2 kernels, 8,392 values\n"
        "settle_cells: 2 of 1,230 values differ; the first in\n"
        "  call 3 of 6, real[0, 1]: 0.5666704075316477 in place of 0.5666704075316478\n"
    )
    assert max(map(len, ran.out.splitlines())) <= 80


@pytest.mark.usefixtures("ill")
def test_a_difference_is_exit_code_1_with_check_only() -> None:
    assert rocksteady("doctor --json").code == 0
    ran = rocksteady("doctor --check --json")
    assert ran.code == 1
    assert ran.json["equal"] is False
    assert ran.json["differing"] == 2
    assert ran.json["checks"][1] == {
        "kernel": "settle_cells",
        "equal": False,
        "calls": 6,
        "values": 1230,
        "differing": 2,
        "first_difference": BAD.first_difference,
    }


@pytest.mark.usefixtures("healthy")
def test_the_json_keeps_the_contract() -> None:
    values = rocksteady("doctor --json").json
    assert next(iter(values)) == "schema"
    assert values["schema"] == "rocksteady/doctor/1"
    assert values["equal"] is True
    assert values["kernels"] == "library"
    assert values["library"] == "/usr/lib/rocksteady-linux-x86-64-v4.so"
    assert (values["gpu"], values["no_gpu"]) == ("NVIDIA H100, compute capability 9.0", None)
    assert [entry["kernel"] for entry in values["checks"]] == ["march", "settle_cells"]


@pytest.mark.usefixtures("ill")
def test_a_report_has_all_facts_the_dependencies_and_the_variables_but_no_home(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Path, "home", lambda: Path("/home/user"))
    monkeypatch.setenv("ROCKSTEADY_CACHE", "/home/user/kernels")
    file = tmp_path / "report.md"
    ran = rocksteady(f"doctor --report {file}")
    assert (ran.code, ran.out) == (0, rocksteady("doctor").out)
    text = file.read_text(encoding="utf-8")
    assert text.startswith("```text\n")
    assert text.endswith("\n```\n")
    assert rocksteady("doctor --more").out.replace("/home/user", "~") in text
    assert "\nROCKSTEADY_CACHE=~/kernels\n" in text
    assert re.search(r"^numpy +\d+\.\d+", text, re.MULTILINE)
    assert not re.search(r"^(?:ruff|sphinx) ", text, re.MULTILINE)
    assert "/home" not in text


@pytest.mark.usefixtures("healthy")
def test_a_report_overwrites_nothing_and_is_text(tmp_path: Path) -> None:
    file = tmp_path / "report.txt"
    file.write_text("mine", encoding="utf-8")
    assert "add --force" in refused(f"doctor --report {file}")
    assert file.read_text(encoding="utf-8") == "mine"
    assert rocksteady(f"doctor --report {file} --force").code == 0
    assert file.read_text(encoding="utf-8").startswith("```text\n")
    assert ".md, .txt" in refused(f"doctor --report {tmp_path / 'report.pdf'}")


def test_the_real_one_runs_and_takes_no_arguments() -> None:
    found = rocksteady("doctor --json").json
    assert found["versions"]["rocksteady"] == rs.__version__
    assert found["calls"] == sum(entry["calls"] for entry in found["checks"])
    quoted = (Path(__file__).parents[3] / "docs" / "start" / "install.md").read_text("utf-8")
    assert f"All {found['values']:,} recorded values agree bit for bit: this" in quoted
    assert "extra" in refused("doctor extra")
