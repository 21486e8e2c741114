"""The plane of frequency and amplitude for one restitution: every stable region, drawn and counted.

`atlas` computes it and `Atlas.save` writes it into a folder.
"""

from rocksteady.studies.atlas.study import Atlas, atlas

__all__ = ["Atlas", "atlas"]
