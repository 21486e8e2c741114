"""Every command line of a page or a help text runs as it stands, page by page in a fresh folder."""

import itertools
import re
import tempfile
from pathlib import Path

import pytest

from tests.cli.program import rocksteady
from tests.every import every
from tests.manual.lines import (
    EVERY,
    HELP,
    NAMED,
    PAGES,
    blocks,
    of_reader,
    shell_lines,
    shortened,
    shown,
    typed_lines,
    words_module,
    write_files,
)
from tests.outputs import unrendered

ALL = {name: text for name, text in (PAGES | HELP).items() if typed_lines(text)}
NOT_RUN = {
    r"git clone .+|cd \w+": "",  # has no address yet
    r"make( [a-z-]+)?": "checkout|clone",  # tests/test_pages.py has the targets
    r"python3 -m venv \S+( && \. \S+)?": "",  # makes environments, as the next two
    r"(\S+ -m |\S+/)?(pip|uv tool|pipx) install (-e )?(\.|\S+\.whl)": "source|wheels|git clone",
    r"python3 -m pip (download|install) .*\bwheels .*|.* --dest wheels": "make wheels",
    r'python3 -m pip install "rocksteady\[[\w,]+\]"': "extra|executor",
    r"dask (scheduler|worker) .+": "machine",  # serves until it is stopped
    r"rocksteady (paper|study) .+": "",  # takes minutes; tests/studies computes each part of it
}
"""Lines that no test runs, and words by which their page names where what they need comes from."""
EXTRAS = {
    r"\.zarr|--netcdf|--runs": "stores",
    r"^certify|^study chaos": "proof",
    "--executor (dask|tcp:)": "cluster",
    "--executor gpu": "gpu",
}
"""Lines that need an extra."""


def test_what_is_not_run_is_listed_and_its_page_names_where_it_comes_from() -> None:
    for name, text in (PAGES | HELP).items():
        for line in shell_lines(text):
            words = [words for kind, words in NOT_RUN.items() if re.fullmatch(kind, line)]
            assert words or re.match(r"(\.venv/bin/)?rocksteady ", line), (name, line)
            assert all(re.search(word, text) for word in words), (name, line)


def test_a_file_that_no_page_shows_is_called_the_readers_own() -> None:
    for name, text in ALL.items():
        prose = re.sub(r"^```(sh|bash)\n.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
        own = " ".join(each for each in prose.split("\n\n") if "our " in each)
        cells = " ".join(body for kind, body in blocks(text) if "code-cell" in kind)
        for file in of_reader(text) - shown(text).keys():
            made = f'"{file}"' in cells or f"--out {file}" in text
            assert made or re.search(rf"\b{file}\b", own), (name, file)


def test_an_extra_that_a_line_needs_is_named_on_its_page() -> None:
    for name, text in ALL.items():
        for line in typed_lines(text):
            for kind, extra in EXTRAS.items():
                named = re.search(rf"`{extra}`|extra {extra}|[\[,]{extra}\b", text)
                assert named or not re.search(kind, line), (name, line)


@pytest.mark.slow
@pytest.mark.parametrize("name", ALL)
def test_the_lines_of_a_page_run_in_their_order(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = ALL[name]
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    made = set(re.findall(r"--out ([\w.]+)", text))
    write_files(tmp_path, of_reader(text) - made, shown(text))
    for line in typed_lines(text):
        if not any(re.fullmatch(kind, f"rocksteady {line}") for kind in NOT_RUN):
            run(shortened(line))


def run(line: str) -> None:
    """Run a command line, and see that it leaves each file that it names."""
    if "tcp://first" in line:
        from distributed import LocalCluster

        with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
            return run(
                re.sub(r"--executor tcp:\S+", f"--executor={cluster.scheduler_address}", line)
            )
    words = words_module(line) + ["--no-browser"] * (
        line.startswith("explore") and "-b" not in line
    )
    with unrendered():  # tests/show looks at pictures
        ran = rocksteady("", *words)
    if "--executor gpu" in line and ran.code == 2:  # or one line says that there is none
        assert re.search(r"^rocksteady: --executor = 'gpu' is not valid: .+$", ran.err), ran.err
        return None
    assert ran.code in ({0, 1, 3} if "--check" in words else {0, 3}), (line, ran.err)
    for flag, file in itertools.pairwise(words):
        if flag in {"--plot", "--animate", "--csv", "--out"}:
            assert Path(file).exists(), (line, file)
    return None


@pytest.mark.slow
@every("line", [line for line in EVERY if NAMED.fullmatch(line)])
def test_a_command_that_is_named_has_the_flags_that_are_named(line: str) -> None:
    flags = re.findall(r"--[\w-]+", line)
    ran = rocksteady("", *line.partition(" --")[0].replace(" FILE", "").split(), "--help-all")
    assert ran.code == 0, ran.err
    assert set(flags) <= {"--help", *re.findall(r"--[\w-]+", ran.out)}
