"""``python -m tools.aot.device.lower FILE``: lower the queued kernels, with one lane.

A process of its own: kernels read at import how many cells they follow side by side, and numba
compiles nothing for this machine afterwards.
"""

import os
import sys
from pathlib import Path

from rocksteady.kernels.machine_code import width


def main(file: Path) -> None:
    """Write the lowered kernels into a file."""
    width.ON_DEVICE = True  # before any kernel is imported
    from rocksteady.kernels.devices import FORMS
    from tools.aot.lower import lower, write

    queued = {form.queued.__name__: form.queued for form in FORMS.values()}
    scratch = file.with_name(f"{file.name}.{os.getpid()}.tmp")
    write(lower(queued, lambda _name: None), scratch)
    scratch.replace(file)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
