"""Platforms that libraries are built for, and what compiles and links for each."""

from dataclasses import dataclass

from rocksteady.explorer import _module as module
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.library import file_name


@dataclass(frozen=True)
class Target:
    """A platform.

    Attributes
    ----------
    name
        As ``"linux-x86-64-v3"``; the library's file is named after it.
    triple, cpu, features
        What LLVM compiles for.
    linker
        What zig calls the platform when it links, with the oldest C library that will do.
    static
        Whether code stays where it is linked, as in WebAssembly.
    entries
        Names of the kernels that its library exports, and holds.
    """

    name: str
    triple: str
    cpu: str
    features: str = ""
    linker: str = ""
    static: bool = False
    entries: tuple[str, ...] = tuple(ENTRIES)

    @property
    def file(self) -> str:
        """Return the name of its library's file."""
        return {WASM: "rocksteady.wasm", PAGE: module.NAME}.get(self.name) or file_name(self.name)


WASM, PAGE = "wasm32", "wasm32-page"
_X86_64 = {
    "linux": ("x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17"),
    "windows": ("x86_64-pc-windows-gnu", "x86_64-windows-gnu"),
}
_ARM_LINUX = ("aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17")
_WASM = (
    "wasm32-unknown-unknown",
    "generic",
    "+simd128,+bulk-memory,+nontrapping-fptoint,+sign-ext,+mutable-globals",
    "wasm32-freestanding",
)
_CALLED_BY_PAGES = """
    clock fill_atan2 fill_bounds fill_clocks fill_cos fill_curves fill_exp fill_hypot fill_landings
    fill_lines fill_log fill_log1p fill_next_up fill_peaks fill_pulse fill_sin fill_states
    fill_steady fill_tan half_cycle_jacobian harmonic_segment highest_after is_symmetric
    lane_attractors loss make_system march measured multipliers next_passage polish pulse_fates
    record_fates run_end run_facts segment_start settle settle_cells symmetric_from symmetric_orbit
"""
# `lane_attractors` gains little in a browser, but maps of Python have the last digits of lanes.
# Every processor of these levels runs the fastest forms that they have; no step is fused on any.
_LEVELS = {"v2": "", "v3": "", "v4": "-prefer-256-bit"}

TARGETS = {
    target.name: target
    for target in (
        *(
            Target(f"{system}-x86-64-{level}", triple, f"x86-64-{level}", features, linker)
            for system, (triple, linker) in _X86_64.items()
            for level, features in _LEVELS.items()
        ),
        Target("linux-aarch64", _ARM_LINUX[0], "generic", "+neon", _ARM_LINUX[1]),
        Target("macos-arm64", "arm64-apple-macosx11.0", "apple-m1", "", "aarch64-macos.11.0"),
        Target(WASM, *_WASM, static=True),
        Target(PAGE, *_WASM, static=True, entries=tuple(_CALLED_BY_PAGES.split())),
    )
}
"""By name."""
