"""What a release has beside its wheels: made from the project's files, complete, the same twice."""

import hashlib
import json
import re
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path
from typing import Any

import msgspec
import pytest
from packaging.requirements import Requirement

from rocksteady import __version__
from tests.every import every
from tools.release import __main__ as program
from tools.release import project, site
from tools.release.recipe import recipe

ROOT = Path(__file__).parents[2]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
TARGETS = set(
    re.findall(r"^\.PHONY: ([\w.-]+)$", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE)
)


def yaml(file: Path) -> dict[str, Any]:
    found: dict[str, Any] = msgspec.yaml.decode(file.read_bytes())  # "on" is a truth value
    return found


# ------------------------------------------------------------------------------ what is made


def test_codemeta_is_up_to_date() -> None:
    assert project.CODEMETA.read_text("utf-8") == project.codemeta(), "run make metadata"


def test_classifiers_name_each_python_that_the_workflows_test_from_the_oldest_one() -> None:
    described = project.project()
    tested = yaml(ROOT / ".github" / "workflows" / "checks.yml")["jobs"]["installed"]
    pythons = tested["strategy"]["matrix"]["python"]
    named = [each.rpartition(" ")[2] for each in described["classifiers"] if "3." in each]
    assert named == pythons
    assert described["requires-python"] == f">={pythons[0]}"


@pytest.mark.slow
def test_a_bill_has_the_package_and_what_it_needs_and_nothing_of_the_machine(
    tmp_path: Path,
) -> None:
    """By the options of the Makefile, of this environment, which holds more than is needed."""
    makefile = (ROOT / "Makefile").read_text("utf-8")
    options = re.search(r"cyclonedx-py environment --pyproject \S+ ([^$]*)--output-f", makefile)
    assert options is not None
    texts = set()
    for name in ("one.json", "two.json"):
        command = [sys.executable, "-m", "cyclonedx_py", "environment", "--pyproject"]
        command += [str(ROOT / "pyproject.toml"), *options[1].replace("\\\n", " ").split()]
        subprocess.run([*command, "--output-file", tmp_path / name, sys.prefix], check=True)
        texts.add((tmp_path / name).read_text("utf-8"))
    (text,) = texts
    assert not [each for each in ("file:", str(ROOT), str(tmp_path), sys.prefix) if each in text]
    found = json.loads(text)
    assert "serialNumber" not in found
    assert "timestamp" not in found["metadata"]
    own = found["metadata"]["component"]
    assert own["name"] == "rocksteady"
    graph = {each["ref"]: each.get("dependsOn", []) for each in found["dependencies"]}
    needed = {Requirement(each).name for each in project.project()["dependencies"]}
    assert needed <= {each.partition("==")[0].lower() for each in graph[own["bom-ref"]]}


@pytest.mark.slow
def test_two_source_distributions_have_the_same_bytes_and_what_a_build_needs(
    tmp_path: Path,
) -> None:
    for folder in ("one", "two"):
        assert program.main(["sdist", "--out", str(tmp_path / folder)]) == 0
    one, two = sorted(tmp_path.glob("*/*.tar.gz"))
    assert one.read_bytes() == two.read_bytes()
    with tarfile.open(one) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert {"PKG-INFO", "LICENSE", "Makefile", "constraints.txt", "pyproject.toml"} <= names
    assert {name.partition("/")[0] for name in names} >= {
        "docs",
        "examples",
        "src",
        "tests",
        "tools",
    }
    assert not [name for name in names if name.startswith(("build/", "dist/", "out/", ".venv"))]


def test_the_recipe_has_the_bounds_of_the_project_and_the_hash_of_the_sources(
    tmp_path: Path,
) -> None:
    sdist = tmp_path / "a.tar.gz"
    sdist.write_bytes(b"sources")
    text = recipe(sdist, "https://a/b.tar.gz", "https://a", ["one", "two"], "hatchling >= 1.27")
    found = msgspec.yaml.decode(text.encode(), type=dict[str, Any])
    assert found["source"]["sha256"] == hashlib.sha256(b"sources").hexdigest()
    assert found["context"] == {"version": __version__, "python_min": "3.11"}
    described = project.project()
    asked = described["dependencies"]
    bounds = {str(Requirement(each).specifier) for each in asked}
    run = found["requirements"]["run"][1:]
    assert len(run) == len(asked)
    assert {each.partition(" ")[2] for each in run} == bounds
    assert "matplotlib-base >=3.10" in run
    assert found["extra"]["recipe-maintainers"] == ["one", "two"]
    assert found["about"]["license_file"] == "LICENSE"


SECTIONS = ("schema_version", "context", "package", "source", "build", "requirements", "tests")
"""Of a recipe, in the order that the linter of conda-forge wants; `about` and `extra` follow."""


def test_the_recipe_has_what_the_linter_of_conda_forge_wants(tmp_path: Path) -> None:
    sdist = tmp_path / "a.tar.gz"
    sdist.write_bytes(b"sources")
    text = recipe(sdist, "https://a/b.tar.gz", "https://a", ["one"], "hatchling >= 1.27")
    found = msgspec.yaml.decode(text.encode(), type=dict[str, Any])
    assert tuple(found) == (*SECTIONS, "about", "extra")
    assert {"homepage", "license", "license_file", "summary"} <= found["about"].keys()
    assert "license" not in found["about"]["license"].lower()
    assert found["build"]["number"] == 0
    assert "--no-deps --no-build-isolation" in found["build"]["script"]
    oldest = "${{ python_min }}"
    needs = found["requirements"]
    assert needs["build"] == ['${{ compiler("c") }}']
    assert needs["host"][0] == needs["run"][0] == "python"
    assert any(each.startswith("numba ") for each in needs["host"])
    assert not [each for each in needs["run"] if each != each.lower()]
    checked, started = found["tests"]
    assert checked["python"]["pip_check"]
    assert f"{oldest}.*" in checked["python"]["python_version"]
    assert f"python {oldest}.*" in started["requirements"]["run"]


def test_what_is_missing_for_a_release_is_named_with_what_to_do() -> None:
    found = project.faults("v9.9")
    assert found[0] == f"v9.9 is not v{__version__}: rename the tag, or set __version__"
    assert all(": " in fault for fault in found)
    assert not any("codemeta" in fault for fault in found)


# ------------------------------------------------------------------------------ the site


@every(
    ("page", "fault"),
    [
        ('<a href="b/c.html#x">', None),
        ('<a href="missing.html">', "index.html links to missing.html, which is missing"),
        ('<a href="https://example.org/x">', None),
        ('<script src="https://example.org/x.js">', "index.html loads <script src="),
    ],
)
def test_a_site_has_what_it_links_to_and_loads_nothing_from_a_host(
    page: str, fault: str | None, tmp_path: Path
) -> None:
    manual, out = tmp_path / "manual", tmp_path / "site"
    for name, text in {"index.html": page, "b/c.html": "", site.PAGE: "", ".buildinfo": ""}.items():
        (manual / name).parent.mkdir(parents=True, exist_ok=True)
        (manual / name).write_text(text, "utf-8")
    wrong = site.site(manual, out)
    assert [each[: len(fault or "")] for each in wrong] == ([fault] if fault else [])
    assert (out / ".nojekyll").exists()
    assert not (out / ".buildinfo").exists()


# ------------------------------------------------------------------------------ workflows


@every("file", WORKFLOWS)
def test_a_workflow_calls_targets_that_there_are_and_gets_no_more_rights_than_it_names(
    file: Path,
) -> None:
    text = file.read_text("utf-8")
    called = set(re.findall(r"run: make ([a-z-]+)", text))
    lists = re.findall(r"^ +target: \[(.*)\]$", text, re.MULTILINE)
    called |= {name for each in lists for name in each.split(", ")}
    assert called <= TARGETS
    assert called
    found = yaml(file)
    assert found["permissions"] == {"contents": "read"}
    for job in found["jobs"].values():
        assert "uses" in job or job["timeout-minutes"] <= 60
    assert text.count("persist-credentials: false") + text.count("ignore[artipacked]") == (
        text.count("actions/checkout@")
    )


def test_no_file_of_the_project_names_the_host_of_an_index() -> None:
    folders = [ROOT / ".github", ROOT / "tools" / "release", ROOT / "docs"]
    files = [file for folder in folders for file in folder.rglob("*") if file.is_file()]
    texts = {
        file: file.read_text("utf-8")
        for file in [*files, *ROOT.glob("*.md"), ROOT / "pyproject.toml", ROOT / "Makefile"]
        if file.suffix in {".md", ".yml", ".py", ".toml", ".json", ""}
    }
    hosts = re.compile(r"\b(?:[a-z]+\.)*(?:pypi|pythonhosted|anaconda|conda-forge)\.(?:org|io|com)")
    assert [str(file) for file, text in texts.items() if hosts.search(text)] == []


def test_the_forms_of_issues_want_the_report_of_the_doctor() -> None:
    forms = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("[!c]*.yml"))
    assert len(forms) >= 3
    for form in forms:
        found = yaml(form)
        assert {"name", "description", "body"} <= found.keys()
        ids = [each["id"] for each in found["body"] if each["type"] != "markdown"]
        assert len(ids) == len(set(ids))
    fault = forms[0].read_text("utf-8")
    assert "rocksteady doctor --report" in fault
    assert tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["scripts"]
