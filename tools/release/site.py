"""The manual with the explorer's page as one folder of files, which any host can show."""

import re
import shutil
from pathlib import Path

LINK = re.compile(r"""(?:href|src)=["']([^"'#?]+)""")
LOADED = re.compile(r"""<(?:script|img|iframe|source)[^>]* src=["'](?:https?:)?//[^"']+""")
PAGE = "_static/explorer.html"
"""The explorer's page, which needs no other file of the folder."""
LEFT = (".buildinfo", ".doctrees", ".built")
"""What a build of the manual leaves that no reader needs."""


def site(manual: Path, out: Path) -> list[str]:
    """Copy the manual, and return what is wrong with it as a site.

    Parameters
    ----------
    manual
        Folder of the built manual.
    out
        Folder of the site; what is in it is removed.

    Returns
    -------
    list of str
        Links to files that are missing, and what a page loads from a host.
    """
    if out.exists():
        shutil.rmtree(out)
    shutil.copytree(manual, out, ignore=shutil.ignore_patterns(*LEFT))
    (out / ".nojekyll").touch()  # else a host may leave out folders with an underscore
    wrong = [] if (out / PAGE).is_file() else [f"{PAGE} is missing"]
    for file in sorted(out.rglob("*.html")):
        name, text = file.relative_to(out), file.read_text("utf-8")
        if name.as_posix() == PAGE:  # one file: its links are made by its script
            continue
        wrong += [f"{name} loads {match[0]}" for match in LOADED.finditer(text)]
        for link in sorted(set(LINK.findall(text))):
            if not re.match(r"[a-z]+:|//", link) and not (file.parent / link).exists():
                wrong.append(f"{name} links to {link}, which is missing")
    return wrong
