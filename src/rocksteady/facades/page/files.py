"""Files that the folder of a facade holds."""

from rocksteady.show.export.folders import OwnFolder

FACADE = OwnFolder(r"report\.html|(checks|runs)\.csv|(facade|run)\.json", "a facade")
