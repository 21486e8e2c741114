"""Which level of the x86-64 instruction set this processor and its system offer."""

import ctypes
import re
import sys
from pathlib import Path

_LEVELS = {
    4: "avx512f avx512bw avx512cd avx512dq avx512vl",
    3: "avx avx2 bmi1 bmi2 f16c fma abm movbe",
}
"""Flags of Linux that a level needs beyond those of the levels below it; 2 is taken for granted."""
_AVX2 = 40
"""Feature of Windows: PF_AVX2_INSTRUCTIONS_AVAILABLE, which stands for level 3."""
_NUMPY = "numpy._core._multiarray_umath"
"""Module of NumPy with the features of this processor by name; in capitals, as AVX512F."""


def x86_64_level() -> int:
    """Return 2, 3 or 4; 2 where neither Linux nor Windows tells."""
    if sys.platform == "win32":
        # Windows tells the foundation of AVX-512 alone: NumPy has asked the processor for the rest.
        features = getattr(sys.modules.get(_NUMPY), "__cpu_features__", {})
        flags = {name.lower() for name, found in features.items() if found}
        if ctypes.windll.kernel32.IsProcessorFeaturePresent(_AVX2):
            flags.update(_LEVELS[3].split())
        return _level_of_flags(flags)
    try:
        description = Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace")
    except OSError:
        return 2
    return level_of(description)


def level_of(description: str) -> int:
    """Return the level that a text like /proc/cpuinfo describes: the least of its processors."""
    listed = re.findall(r"^flags\s*:(.*)$", description, re.MULTILINE)
    levels = [_level_of_flags(set(flags.split())) for flags in listed]
    return min(levels, default=2)


def _level_of_flags(flags: set[str]) -> int:
    level = 2
    for higher in sorted(_LEVELS):
        if not flags.issuperset(_LEVELS[higher].split()):
            break
        level = higher
    return level
