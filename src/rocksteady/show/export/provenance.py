"""How a page was made: versions, command and hashes."""

from collections.abc import Mapping
from typing import Any


def provenance(
    manifest: Mapping[str, Any], source: str = "", sha256: str | None = None
) -> dict[str, Any]:
    """Return command, versions and files of a manifest for a page.

    Parameters
    ----------
    manifest
        From `rocksteady.export.make_manifest`.
    source, sha256
        Name and hash of the object's file, which stands first; none of an object without one.
    """
    files = [{"name": each["name"], "sha256": each["sha256"]} for each in manifest["files"]]
    if sha256 is not None and sha256 not in [each["sha256"] for each in files]:
        files.insert(0, {"name": source, "sha256": sha256})
    return {
        "command": manifest["command"],
        "files": files,
        "kernels": manifest["kernels"],
        "numpy": manifest["numpy"],
        "version": manifest["rocksteady"],
    }
