"""The same bits on every processor, up to the kernels and behind them.

Sines, exponentials and their relatives are the package's own.  Those of the system's library and of
NumPy differ from processor to processor in the last digits, and so do fused products, the order of
sums in linear algebra, and powers.  What computes may name none of them but where a table says why.
Layer `show` draws and is free to.
"""

import ast
import json
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tests.every import every
from tests.trees import tree_of

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "rocksteady"
FREE = {"certify", "kernels", "show"}
"""Layers without this rule: kernels have a stricter one, pictures need not agree, proofs hold."""
STATISTICS = (
    "facades/page/",
    "facades/plots/",
    "dynamics/basins/measures/",
    "risk/back_analysis/",
    "risk/calibration/",
    "risk/fits/",
    "risk/fragility/",
    "risk/free_rocking/",
    "risk/hazard/",
    "risk/screens/",
    "risk/spectra/",
)
"""Folders without it: they count what was run, and all but the last digits of a curve agree."""


def words(text: str) -> set[str]:
    return set(text.split())


EXACT_MATH = words(
    """
    ceil copysign degrees factorial floor fmod frexp fsum gcd inf isclose isfinite isinf isnan ldexp
    nan nextafter pi prod radians remainder sqrt tau trunc ulp
    """
)
"""Names of `math` whose results are rounded once, or are products and quotients in one order."""
EXACT_UFUNCS = words(
    """
    absolute add bitwise_and bitwise_or bitwise_xor ceil conjugate copysign degrees divide equal
    floor floor_divide fmax fmin fmod frexp greater greater_equal invert isfinite isinf isnan ldexp
    left_shift less less_equal logical_and logical_not logical_or logical_xor maximum minimum
    multiply negative nextafter not_equal radians reciprocal remainder right_shift rint sign
    signbit spacing sqrt square subtract trunc
    """
)
"""Functions of NumPy that round each number once; of all others none is allowed."""
INEXACT = words(  # with other functions inside, sums in an unknown order, or fused products
    """
    angle bartlett blackman convolve corrcoef correlate cov cross dot einsum einsum_path emath fft
    geomspace hamming hanning i0 inner interp kaiser kron linalg logspace poly polyfit polynomial
    polyval random roots sinc tensordot unwrap vander vdot
    """
)
"""Other names of NumPy that are not allowed."""
INTEGERS = {"numpy.random.SeedSequence", "numpy.random.Generator"}
"""Exact nevertheless: whole numbers, and the name of a type."""

LAPACK = "LAPACK solves for the points of a branch: all but their last digits agree"
PYTHON = "SciPy's is Python code, and calls nothing but the function"
PICTURES = "the last of a fall in a film, to a pixel"
BUILT_IN = "built-in motions: seeded noise, whose last digits may differ"
COUNTS = "the interval or the curve of what was counted"
PLACED = "stretches to a spectrum, which are of a grid: the nearest one may be another"
WORDS = "words of a screen, with three digits"
ALLOWED = {
    ("dynamics/history/fall.py", "**"): PICTURES,
    ("dynamics/history/fall.py", "math.cos"): PICTURES,
    ("dynamics/history/fall.py", "math.sin"): PICTURES,
    ("words/attractors.py", "math.exp"): WORDS,
    ("words/attractors.py", "math.log10"): WORDS,
    ("words/placing.py", "math.exp"): WORDS,
    ("words/spectra.py", "**"): WORDS,
    ("words/spectra.py", "math.cos"): WORDS,
    ("words/spectra.py", "math.sin"): WORDS,
    ("dynamics/basins/_safe.py", "scipy.ndimage"): "distances in a picture of cells",
    ("dynamics/basins/over/shares.py", "numpy.divmod"): "of whole numbers",
    ("dynamics/continuation/chains/chain.py", "numpy.linalg"): LAPACK,
    ("dynamics/continuation/curves/_codimension_two.py", "@"): LAPACK,
    ("dynamics/continuation/curves/_codimension_two.py", "numpy.linalg"): LAPACK,
    ("dynamics/continuation/curves/_curve_starts.py", "numpy.linalg"): LAPACK,
    ("dynamics/continuation/curves/_normal_forms.py", "**"): "powers of whole numbers",
    ("dynamics/continuation/curves/_normal_forms.py", "@"): LAPACK,
    ("dynamics/continuation/curves/_normal_forms.py", "numpy.linalg"): LAPACK,
    ("dynamics/continuation/curves/search_plane.py", "@"): LAPACK,
    ("dynamics/edges/_courses.py", "@"): LAPACK,
    ("dynamics/edges/_courses.py", "numpy.fft"): LAPACK,
    ("dynamics/edges/_courses.py", "numpy.linalg"): LAPACK,
    ("dynamics/edges/_leaving.py", "@"): "products of two by two, for a direction",
    ("words/edges.py", "math.exp"): WORDS,
    ("words/resting.py", "complex"): "two multipliers that are 0",
    ("model/checks/confidence.py", "scipy.special"): "the interval about a share",
    ("model/motions/band_noise.py", "numpy.random"): "seeded, in NumPy's own code",
    ("dynamics/continuation/chains/events.py", "@"): LAPACK,
    ("dynamics/continuation/chains/events.py", "scipy.optimize"): PYTHON,
    ("dynamics/continuation/chains/predictor_corrector.py", "@"): LAPACK,
    ("dynamics/continuation/chains/predictor_corrector.py", "numpy.linalg"): LAPACK,
    ("dynamics/continuation/chains/predictor_corrector.py", "scipy.optimize"): LAPACK,
    ("dynamics/continuation/branch.py", "numpy.linalg"): LAPACK,
    ("model/motions/_pulse_shapes.py", "scipy.optimize"): PYTHON,
    ("risk/observations/spread.py", "scipy.special"): "quantiles of a prior, which are drawn",
    ("risk/observations/synthetic_tests.py", "numpy.random"): "seeded, in NumPy's own code",
    ("model/motions/synthetic.py", "complex"): "poles of SciPy's filters",
    ("model/motions/synthetic.py", "numpy.random"): "noise of NumPy",
    ("model/motions/synthetic.py", "scipy.signal"): "filters of SciPy",
    ("records/processing.py", "scipy.signal"): "the low-pass filter before a coarser sampling",
    ("risk/counted/band.py", "**"): COUNTS,
    ("risk/counted/band.py", "math.log"): COUNTS,
    ("risk/counted/band.py", "math.log1p"): COUNTS,
    ("risk/counted/band.py", "scipy.special"): COUNTS,
    ("risk/counted/built_in.py", "**"): BUILT_IN,
    ("risk/counted/built_in.py", "math.exp"): BUILT_IN,
    ("risk/counted/built_in.py", "math.log"): BUILT_IN,
    ("risk/counted/built_in.py", "numpy.exp"): BUILT_IN,
    ("risk/counted/built_in.py", "numpy.fft"): BUILT_IN,
    ("risk/counted/built_in.py", "numpy.random"): BUILT_IN,
    ("risk/counted/curve.py", "numpy.interp"): COUNTS,
    ("risk/counted/curve.py", "numpy.log"): COUNTS,
    ("risk/counted/curve.py", "scipy.optimize"): COUNTS,
    ("risk/counted/placing.py", "numpy.exp"): PLACED,
    ("risk/counted/placing.py", "numpy.geomspace"): PLACED,
    ("risk/counted/placing.py", "numpy.interp"): PLACED,
    ("risk/counted/placing.py", "numpy.log"): PLACED,
    ("risk/counted/reach.py", "**"): "the ratio of levels, a constant",
    ("risk/ensemble/uplift.py", "numpy.interp"): "vertical samples at times of horizontal ones",
    ("facades/checks/record_demand.py", "numpy.interp"): "a demand read from a spectrum",
    ("seismic/measures/intensity.py", "numpy.fft"): "the spectrum behind the mean period",
    ("seismic/measures/sampled_spectrum.py", "numpy.interp"): PLACED,
    ("seismic/measures/sampled_spectrum.py", "scipy.signal"): PLACED,
    ("seismic/measures/intensity.py", "scipy.fft"): "a whole number",
    ("studies/atlas/pages/pictures.py", "numpy.interp"): "where a drawn line ends",
    ("studies/tso_wong_1989/claims/_regions.py", "numpy.random"): "numbers from 0 to 1: exact",
    ("studies/tso_wong_1989/claims/evidence.py", "numpy.random"): "numbers from 0 to 1: exact",
    ("studies/tso_wong_1989/figures/_fate_plots.py", "math.log10"): "places on an axis",
    ("sweep/refine.py", "scipy.ndimage"): "the larger of whole numbers",
}
"""What is allowed nevertheless: file and name, and why.  The promise ends at each of them."""


def names_in(tree: ast.Module) -> dict[str, str]:
    """Return the dotted name that each name bound by an import stands for."""
    found = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                top = alias.name.partition(".")[0]
                found[alias.asname or top] = alias.name if alias.asname else top
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            for alias in node.names:
                found[alias.asname or alias.name] = f"{node.module}.{alias.name}"
    return found


def dotted(node: ast.expr, names: dict[str, str]) -> str:
    """Return the dotted name of an expression, or an empty text."""
    if isinstance(node, ast.Attribute):
        above = dotted(node.value, names)
        return f"{above}.{node.attr}" if above else ""
    return names.get(node.id, "") if isinstance(node, ast.Name) else ""


def is_exact(name: str) -> bool:
    """Return whether a dotted name gives the same bits everywhere, or is none that computes."""
    library, _, rest = name.partition(".")
    first = rest.partition(".")[0]
    if library == "math":
        return not first or first in EXACT_MATH
    if library == "numpy":
        if isinstance(getattr(np, first, None), np.ufunc):
            return getattr(np, first).__name__ in EXACT_UFUNCS
        return first not in INEXACT or name in INTEGERS
    return library not in {"cmath", "random", "scipy", "statistics"}


def short(name: str) -> str:
    """Return a dotted name without what comes after its second part."""
    return ".".join(name.split(".")[:2])


def is_whole(node: ast.expr) -> bool:
    """Return whether an expression is a whole number that is written out."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        node = node.operand
    return isinstance(node, ast.Constant) and isinstance(node.value, int)


def is_exact_power(base: ast.expr, exponent: ast.expr) -> bool:
    """Return whether a power is one of whole numbers or one of 2.0, both written out."""
    two = isinstance(base, ast.Constant) and base.value == 2.0
    return is_whole(exponent) and (two or (is_whole(base) and isinstance(exponent, ast.Constant)))


def inexact_in(tree: ast.Module) -> Iterator[str]:
    """Yield what a module names that gives no same bits."""
    names = names_in(tree)
    inside = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    yield from (short(name) for name in names.values() if not is_exact(name))
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and id(node) not in inside:
            name = dotted(node, names)
            if name and not is_exact(name):
                yield short(name)
            elif node.attr == "dot":
                yield "dot"
        elif isinstance(node, ast.BinOp | ast.AugAssign) and isinstance(node.op, ast.MatMult):
            yield "@"
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            if not is_exact_power(node.left, node.right):
                yield "**"
        elif isinstance(node, ast.AugAssign) and isinstance(node.op, ast.Pow):
            yield "**"
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            if node.func.id == "pow" and len(node.args) < 3:  # of three all are whole numbers
                yield "pow"
        elif isinstance(node, ast.Constant) and isinstance(node.value, complex):
            yield "complex"


def inexact_of_the_package() -> set[tuple[str, str]]:
    files = [
        file
        for file in SOURCE.rglob("*.py")
        if file.relative_to(SOURCE).parts[0] not in FREE
        and not file.relative_to(SOURCE).as_posix().startswith(STATISTICS)
    ]
    assert len(files) > 100
    return {
        (file.relative_to(SOURCE).as_posix(), name)
        for file in files
        for name in inexact_in(tree_of(file))
    }


def test_what_computes_names_nothing_that_differs_between_processors() -> None:
    """And no line of the table is left over."""
    assert inexact_of_the_package() == set(ALLOWED)


@every(
    ("source", "names"),
    [
        ("import math\nmath.sqrt(2.0) + math.pi", []),
        ("import math\nmath.sin(1.0)", ["math.sin"]),
        ("from math import exp as e, floor\ne(1.0)", ["math.exp"]),
        ("import cmath", ["cmath"]),
        ("import numpy as np\nnp.abs(x) + np.sqrt(x) + np.linspace(0, 1) + np.float64(1)", []),
        ("import numpy as np\nnp.arctan2(x, y)", ["numpy.arctan2"]),
        ("import numpy as np\nnp.geomspace(1, 2)", ["numpy.geomspace"]),
        ("import numpy as np\nnp.linalg.norm(x)", ["numpy.linalg"]),
        ("import numpy as np\nnp.maximum.accumulate(x)", []),
        ("import numpy as np\nnp.add.reduce(np.sin(x))", ["numpy.sin"]),
        ("import numpy\nnumpy.matmul(x, y)", ["numpy.matmul"]),
        ("from numpy import log\nlog(x)", ["numpy.log"]),
        ("from numpy.polynomial import Legendre", ["numpy.polynomial"]),
        ("from scipy.special import gamma", ["scipy.special"]),
        (
            "def f(x):\n    from scipy import signal\n    return signal.lfilter(x)",
            ["scipy.signal"] * 2,
        ),
        ("import numpy as np\nnp.random.SeedSequence(1)", []),
        ("import numpy as np\nnp.random.default_rng(1)", ["numpy.random"]),
        ("x @ y", ["@"]),
        ("x @= y", ["@"]),
        ("x.dot(y)", ["dot"]),
        ("2**64 + 10**12 + 2.0**-53 - (2**63)", []),
        ("x**2", ["**"]),
        ("10.0**-3", ["**"]),
        ("10**-3", ["**"]),
        ("x **= 2", ["**"]),
        ("2.0**0.5", ["**"]),
        ("pow(3, n, m)", []),
        ("pow(x, 2)", ["pow"]),
        ("1j * x", ["complex"]),
    ],
)
def test_the_rule_finds_what_it_forbids(source: str, names: list[str]) -> None:
    assert sorted(inexact_in(ast.parse(source))) == sorted(names)


def test_the_tables_name_what_there_is() -> None:
    assert [name for name in EXACT_UFUNCS if not isinstance(getattr(np, name), np.ufunc)] == []
    assert [name for name in EXACT_MATH if not hasattr(math, name)] == []
    assert [name for name in INEXACT if isinstance(getattr(np, name), np.ufunc)] == []


# ------------------------------------------------------------- the same numbers, computed twice

LIKE_AN_OLD_PROCESSOR = {
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4,-AVX512F",
    "OPENBLAS_CORETYPE": "Nehalem",
    "NPY_DISABLE_CPU_FEATURES": " ".join(
        np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    ),
}
"""Makes NumPy, its BLAS and the C library do without fused and wide instructions."""


def digests(environment: dict[str, str]) -> dict[str, list[int | str]]:
    done = subprocess.run(
        [sys.executable, "-m", "tests.digits"],
        cwd=ROOT,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    found: dict[str, list[int | str]] = json.loads(done.stdout)
    return found


@pytest.mark.slow
def test_numbers_are_the_same_where_those_of_the_system_are_not() -> None:
    """On a processor with fused instructions, beside itself without them."""
    here, there = digests({}), digests(LIKE_AN_OLD_PROCESSOR)
    alike = here.pop("of_the_system") == there.pop("of_the_system")
    assert here == there
    assert min(int(count) for count, _ in here.values()) > 100
    if alike:
        pytest.skip("the system computes in one way here")
