"""Compile the kernels ahead of time: lower them once, then build a library for each target."""

import sys
from pathlib import Path

# While the package is being installed it is found here alone: pip takes what an editable
# installation has put on the path out of it, PYTHONPATH included.
SRC = str(Path(__file__).parents[2] / "src")
if SRC not in sys.path:
    sys.path.insert(0, SRC)
