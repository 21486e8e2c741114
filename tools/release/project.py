"""The project as pyproject.toml and CITATION.cff describe it, and codemeta.json made from them."""

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import msgspec
from packaging.requirements import Requirement

from rocksteady import __version__

ROOT = Path(__file__).parents[2]
CODEMETA = ROOT / "codemeta.json"


def project() -> dict[str, Any]:
    """Return the table `project` of pyproject.toml."""
    found: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    return found


def citation() -> dict[str, Any]:
    """Return what CITATION.cff holds."""
    return msgspec.yaml.decode((ROOT / "CITATION.cff").read_bytes(), type=dict[str, Any])


def address() -> str | None:
    """Return the address of the repository, as pyproject.toml has it; None before it is known."""
    found: str | None = project().get("urls", {}).get("Source")
    return found


def codemeta() -> str:
    """Return the content of codemeta.json, in the terms of CodeMeta 3."""
    described, cited, source = project(), citation(), address()
    systems = [
        each.rpartition(" :: ")[2]
        for each in described["classifiers"]
        if each.startswith("Operating System")
    ]
    found = {
        "@context": "https://w3id.org/codemeta/3.0",
        "@type": "SoftwareSourceCode",
        "name": described["name"],
        "description": described["description"],
        "version": __version__,
        "license": f"https://spdx.org/licenses/{described['license']}",
        "keywords": described["keywords"],
        "author": [
            {"@type": "Organization", "name": each["name"]} for each in described["authors"]
        ],
        "programmingLanguage": "Python",
        "runtimePlatform": f"Python {described['requires-python']}",
        "operatingSystem": systems,
        "softwareRequirements": [
            {"@type": "SoftwareApplication", "name": each.name, "version": str(each.specifier)}
            for each in map(Requirement, described["dependencies"])
        ],
        "referencePublication": [
            {"@type": "ScholarlyArticle", "name": each["title"], "datePublished": str(each["year"])}
            for each in cited["references"]
        ],
    }
    if source:
        found |= {"codeRepository": source, "issueTracker": f"{source}/issues"}
    return json.dumps(found, indent=2, ensure_ascii=False) + "\n"


def faults(tag: str) -> list[str]:
    """Return what is missing before a tag can be released, each with what to do.

    Parameters
    ----------
    tag
        Name of the tag, as ``v0.1.0``.
    """
    changes = (ROOT / "CHANGELOG.md").read_text("utf-8")
    stale = not CODEMETA.is_file() or CODEMETA.read_text("utf-8") != codemeta()
    return [
        fault
        for wrong, fault in (
            (
                tag != f"v{__version__}",
                f"{tag} is not v{__version__}: rename the tag, or set __version__",
            ),
            (address() is None, "pyproject.toml has no [project.urls]: write Source in it"),
            (
                not re.search(rf"^## \[{re.escape(__version__)}\]", changes, re.MULTILINE),
                f"CHANGELOG.md has no section [{__version__}]: rename that of what is unreleased",
            ),
            ("date-released" not in citation(), "CITATION.cff has no date-released: write the day"),
            (stale, "codemeta.json is not up to date: run make metadata"),
        )
        if wrong
    ]
