"""Make what a release needs: ``python -m tools.release sdist|metadata|recipe|site|check``.

Exit codes: 0 done, 1 where something is missing or wrong.
"""

import argparse
import sys
import tomllib
from pathlib import Path

from hatchling.builders.sdist import SdistBuilder

from rocksteady import __version__
from tools.release.project import CODEMETA, ROOT, address, codemeta, faults
from tools.release.recipe import recipe
from tools.release.site import site

NAME = f"rocksteady-{__version__}"


def main(arguments: list[str]) -> int:
    """Run one of them."""
    parser = argparse.ArgumentParser(prog="python -m tools.release", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("metadata", help="write codemeta.json")
    sources = commands.add_parser("sdist", help="the source distribution")
    sources.add_argument("--out", type=Path, required=True)
    conda = commands.add_parser("recipe", help="the recipe for conda-forge")
    conda.add_argument("--out", type=Path, required=True, help="folder of the source distribution")
    conda.add_argument("--url", help="address from which conda-forge fetches it")
    conda.add_argument("--maintainer", action="append", help="name of an account; repeat it")
    hosted = commands.add_parser("site", help="the manual and the page for any host")
    hosted.add_argument("--manual", type=Path, required=True, help="folder of the built manual")
    hosted.add_argument("--out", type=Path, required=True, help="folder of the site")
    checking = commands.add_parser("check", help="whether a tag can be released")
    checking.add_argument("--tag", default=f"v{__version__}")
    given = parser.parse_args(arguments)
    if given.command in {"check", "site"}:
        of_tag = given.command == "check"
        wrong = faults(given.tag) if of_tag else site(given.manual, given.out)
        done = f"{given.tag} can be released" if of_tag else f"wrote {given.out}"
        print("\n".join(wrong) or done)
        return 1 if wrong else 0
    if given.command == "metadata":
        file, text = CODEMETA, codemeta()
    elif given.command == "recipe":
        requires = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["build-system"]
        sdist = given.out / f"{NAME}.tar.gz"
        url, source = given.url or sdist.absolute().as_uri(), address() or "https://example.org"
        (builder,) = requires["requires"]
        text = recipe(sdist, url, source, given.maintainer or ["rocksteady"], builder)
        file = given.out / "recipe.yaml"
    else:
        (built,) = SdistBuilder(str(ROOT)).build(directory=str(given.out), versions=["standard"])
        print(f"wrote {built}")
        return 0
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, "utf-8")
    print(f"wrote {file}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
