"""The program's entry: it can be interrupted from its first moment, without a traceback."""

import gc
import os
import signal
import sys
from types import FrameType


def main() -> None:
    """Load the program and run it."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _leave)  # until the program has handlers of its own
    gc.set_threshold(50_000, 20, 20)  # hardly ever while modules are loaded, which leave no garbage
    from rocksteady.cli.app import main as run

    run()


def _leave(number: int, _: FrameType | None) -> None:
    """End the process at once: nothing has begun, and an import would report the signal."""
    if sys.stderr is not None:
        os.write(2, b"rocksteady: interrupted\n")
    os._exit(128 + number)
