"""The recipe for conda-forge in format 1, from pyproject.toml and a source distribution."""

import hashlib
from collections.abc import Sequence
from pathlib import Path

from packaging.requirements import Requirement

from rocksteady import __version__
from tools.release.project import citation, project

NAMES = {"matplotlib": "matplotlib-base"}
"""Packages that have another name there: the one without the libraries of a desktop."""
TEMPLATE = """\
schema_version: 1

context:
  version: {version}
  python_min: "{oldest}"

package:
  name: {name}
  version: ${{{{ version }}}}

source:
  url: {url}
  sha256: {sha256}

build:
  number: 0
  script: ${{{{ PYTHON }}}} -m pip install . -vv --no-deps --no-build-isolation
  python:
    entry_points:
      - {entry}

requirements:
  build:
    - ${{{{ compiler("c") }}}}
  host:
    - python
    - pip
    - {builder}
    - {compiler}
    - filelock
    - lazy-loader
    - zig
  run:
    - python
{needed}

tests:
  - python:
      imports:
        - rocksteady
      pip_check: true
      python_version:
        - ${{{{ python_min }}}}.*
        - "*"
  - requirements:
      run:
        - python ${{{{ python_min }}}}.*
    script:
      - rocksteady simulate --width-m 0.6 --height-m 2 --start 0.6,0

about:
  homepage: {address}
  repository: {address}
  license: {licence}
  license_file: LICENSE
  summary: {summary}
  description: >-
    {description}

extra:
  recipe-maintainers:
{maintainers}
"""


def recipe(sdist: Path, url: str, address: str, maintainers: Sequence[str], builder: str) -> str:
    """Return the recipe: a package whose build compiles the kernels for each system.

    Parameters
    ----------
    sdist
        The source distribution.
    url
        Address from which conda-forge fetches it.
    address
        Address of the repository.
    maintainers
        Names of their accounts.
    builder
        Requirement of what builds the package, as `build-system` has it.
    """
    described = project()
    build = map(Requirement, described["optional-dependencies"]["build"])
    (compiler,) = (str(each) for each in build if each.name == "numba")
    oldest = described["requires-python"].removeprefix(">=")
    return TEMPLATE.format(
        version=__version__,
        oldest=oldest,
        name=described["name"],
        url=url,
        sha256=hashlib.sha256(sdist.read_bytes()).hexdigest(),
        entry=f"rocksteady = {described['scripts']['rocksteady']}",
        builder=_conda(builder),
        compiler=_conda(compiler),
        needed="\n".join(f"    - {_conda(each)}" for each in sorted(described["dependencies"])),
        address=address,
        licence=described["license"],
        summary=f'"{described["description"]}"',
        description=citation()["abstract"],
        maintainers="\n".join(f"    - {each}" for each in maintainers),
    )


def _conda(requirement: str) -> str:
    """Return a requirement under its name at conda-forge."""
    found = Requirement(requirement)
    return f"{NAMES.get(found.name, found.name)} {found.specifier}"
