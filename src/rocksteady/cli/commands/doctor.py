"""`rocksteady doctor`: what runs the kernels here, and whether it computes the right bits."""

from rocksteady.cli.console.outputs import NEGATIVE, announce_compilation
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import ScreenFlags, grouped

HELP = (
    "Check that this installation computes the right bits.\n\n"
    "Check this installation: repeat recorded calls of every kernel, and compare all bits.\n\n"
    "Prints what runs the kernels (a library compiled ahead of time, or numba), for which "
    "processor, the versions, the GPU of --executor gpu or why there is none, and for each "
    "kernel that differs how many values do. The results are the same to the last bit on every "
    "processor and system."
)
EXAMPLES = "Examples:\n\nrocksteady doctor\n\nrocksteady doctor --check --json"


@grouped
def doctor(
    check: bool = options.output_flag(
        "--check", "Leave with exit code 1 where a value differs.", default=False
    ),
    *,
    output: ScreenFlags,
) -> int:
    """Run `rocksteady doctor`; `HELP` is what its users read."""
    announce_compilation("attractors.settle_cells")
    from rocksteady.installation.check import check_installation

    report = check_installation()
    output.leave("doctor", report.describe())
    return NEGATIVE if check and not report.equal else 0
