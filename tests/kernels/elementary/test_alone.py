"""Kernels call nothing that a processor or a system library could do otherwise."""

import ast
from collections.abc import Iterator
from pathlib import Path

import rocksteady.kernels
from tests.every import every

KERNELS = Path(rocksteady.kernels.__file__).parent
FORMS = KERNELS / "devices.py"
"""Estimates, by NumPy, in which order cells are taken: no result depends on them."""
SOURCES = [
    path
    for path in sorted(KERNELS.rglob("*.py"))
    if "machine_code" not in path.parts and path != FORMS
]
EXACT = {
    "math": {
        *("ceil", "comb", "copysign", "floor", "inf", "isfinite", "isinf", "isnan", "isqrt", "nan"),
        *("pi", "sqrt", "ulp"),
    },
    "np": {
        *("arange", "array", "ascontiguousarray", "bool_", "broadcast_arrays", "ceil", "empty"),
        *(
            "float64",
            "floating",
            "floor",
            "int64",
            "integer",
            "ndarray",
            "newaxis",
            "sign",
            "zeros",
        ),
    },
}
"""What each machine does alike: each result is exact, or rounded once."""


def inexact(tree: ast.AST) -> Iterator[str]:
    """Yield what is named or computed otherwise, with its line."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            module, name = node.value.id, node.attr
            if module in EXACT and name not in EXACT[module]:
                yield f"{node.lineno}: {module}.{name}"
        elif isinstance(node, ast.ImportFrom) and node.module in {"math", "numpy"}:
            yield f"{node.lineno}: from {node.module} import"
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            constants = [
                ast.unparse(side).lstrip("-(").rstrip(")") for side in (node.left, node.right)
            ]
            if not all(part.replace(".", "").isdigit() for part in constants):
                yield f"{node.lineno}: {ast.unparse(node)}"
        elif isinstance(node, ast.keyword) and node.arg == "fastmath":
            yield f"{node.value.lineno}: fastmath"


def test_the_search_finds_what_it_looks_for() -> None:
    found = list(inexact(ast.parse("a = math.sin(x) + np.hypot(x, y) + x**2 + 2.0**-3")))
    assert len(found) == 3
    assert len(SOURCES) > 40


def test_what_is_left_out_holds_no_kernel() -> None:
    assert "machine_code.compilation" not in FORMS.read_text()


@every("path", SOURCES)
def test_a_kernel_names_only_what_is_exact(path: Path) -> None:
    assert list(inexact(ast.parse(path.read_text()))) == []
