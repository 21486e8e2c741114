"""Signatures for the loader and types for its users, both made from the kernels' annotations."""

import inspect
from collections.abc import Callable, Iterable
from pathlib import Path
from types import NoneType
from typing import Any

from rocksteady.dynamics.basins.basins import MAX_CYCLES
from rocksteady.dynamics.basins.window import CELLS, HALF_WIDTHS
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.types import Leaf, Signature, parts, signature_of
from rocksteady.model.motions._pulse_shapes import (
    MAVROEIDIS_PAPAGEORGIOU,
    RICKER,
    RICKER_ANTISYMMETRIC,
    SHAPES,
    peak_of_unit_velocity,
    pieces_of,
    reach_of,
)
from tools.aot.targets import PAGE, TARGETS

WEB = Path(__file__).parents[3] / "src" / "rocksteady" / "explorer" / "parts" / "kernels"
"""Folder of the loader, a part of the explorer's page."""
REPLAY = Path(__file__).parent / "replay.mjs"
"""Repeats recorded calls in node."""
NOTE = "// Made by `python -m tools.aot.web` from the annotations of the kernels.\n"
NOTE_ON_PULSES = "// Made by `python -m tools.aot.web` from the shapes of pulses in Python.\n"
NOTE_ON_WINDOW = "// Made by `python -m tools.aot.web` from the basins in Python.\n"
PULSE_TYPES = """\
/**
 * Shapes by name; where a Ricker wavelet ends, by the tolerance of its lines.
 * @type {Record<string, { words: string, form: number, pieces: number[][],
 *   reach: Record<number, number>, oscillations: number, phase: number, peak: number }>}
 */
"""
TOLERANCES = (1e-6, 1e-4)
"""Tolerances of lines along a wavelet with which the page works."""
LEGEND = (
    "// Letters: f number, i integer, b truth value, c complex number; f2 an array of rank 2.\n"
)
LETTERS = {float: "f", int: "i", bool: "b", complex: "c"}
SCALARS = {float: "number", int: "number", bool: "boolean", complex: "[number, number]"}
ARRAYS = {float: "Floats", int: "Integers", bool: "Booleans"}
HEAD = """
/** An array in the module's memory, row after row; free it when it is not needed any more. */
interface KernelArray<Kind, Values> {
  readonly kind: Kind;
  readonly shape: readonly number[];
  /** Its elements: take them anew after each call, since the memory may have moved. */
  readonly values: Values;
  free(): void;
}
export type Floats = KernelArray<'f', Float64Array>;
export type Integers = KernelArray<'i', BigInt64Array>;
export type Booleans = KernelArray<'b', Uint8Array>;
"""
ARRAY = """\
  /** Make an array in the module's memory, of zeros where no values are given. */
  array(kind: 'f', shape: readonly number[], values?: ArrayLike<number>): Floats;
  array(kind: 'i', shape: readonly number[], values?: ArrayLike<bigint>): Integers;
  array(kind: 'b', shape: readonly number[], values?: ArrayLike<number>): Booleans;
"""
TAIL = """
/** Load the module from its bytes, or from what has been compiled of them. */
export function load(source: BufferSource | WebAssembly.Module): Promise<Kernels>;

/** Return the kernels of an instance of the module. */
export function kernels(instance: WebAssembly.Instance): Kernels;
"""


def signatures(names: Iterable[str] = ENTRIES) -> str:
    """Return the module that tells the loader what kernels take and give."""
    named: dict[str, str] = {}
    lines = []
    for name in names:
        signature = signature_of(inspect.unwrap(ENTRIES[name]))
        takes = ", ".join(_letters(hint, named) for hint in signature.arguments)
        gives = "null" if signature.result is None else _letters(signature.result, named)
        lines.append(f"  {name}: {{ takes: [{takes}], gives: {gives} }},\n")
    tuples = "".join(f"const {name} = {text};\n" for name, text in named.items())
    return f"{NOTE}{LEGEND}\n{tuples}\nexport const signatures = {{\n{''.join(lines)}}};\n"


def types(names: Iterable[str] = ENTRIES) -> str:
    """Return the types of the loader and of kernels, for TypeScript."""
    named: dict[str, str] = {}
    methods = []
    for name in names:
        function = inspect.unwrap(ENTRIES[name])
        signature: Signature = signature_of(function)
        pairs = zip(signature.names, signature.arguments, strict=True)
        arguments = ", ".join(f"{argument}: {_type(hint, named)}" for argument, hint in pairs)
        result = "void" if signature.result is None else _type(signature.result, named)
        methods.append(f"  /** {_summary(function)} */\n  {name}({arguments}): {result};\n")
    interfaces = "".join(f"\n{text}" for text in named.values())
    kernels = "\nexport interface Kernels {\n" + ARRAY + "".join(methods) + "}\n"
    return NOTE + HEAD + interfaces + kernels + TAIL


def pulses() -> str:
    """Return the shapes of single pulses for the page: words, and the numbers of `fill_pulse`."""
    lines = []
    for name, shape in SHAPES.items():
        pieces = [list(piece) for piece in pieces_of(name)]
        sampled = shape.form in (RICKER, RICKER_ANTISYMMETRIC)
        reach = {part: reach_of(shape.form, part) for part in TOLERANCES if sampled}
        gamma, nu = (2.0, 0.0) if shape.form == MAVROEIDIS_PAPAGEORGIOU else (1.0, 0.0)
        peak = peak_of_unit_velocity(gamma, nu) if gamma > 1.0 else 1.0
        numbers = f"pieces: {pieces}, reach: {reach}"
        numbers += f", oscillations: {gamma}, phase: {nu}, peak: {peak}"
        lines.append(f"  '{name}': {{ words: '{shape.words}', form: {shape.form}, {numbers} }},\n")
    return f"{NOTE_ON_PULSES}\n{PULSE_TYPES}export const PULSES = {{\n{''.join(lines)}}};\n"


def window() -> str:
    """Return the window of starts for the page: its reach, its cells, and the periods followed."""
    (angle, velocity), (columns, rows) = HALF_WIDTHS, CELLS
    numbers = f"angle: {angle}, velocity: {velocity}, columns: {columns}, rows: {rows}"
    return (
        f"{NOTE_ON_WINDOW}\n/** Angle in units of alpha, velocity of alpha p, on either side. */\n"
        f"export const START_WINDOW = {{ {numbers}, cycles: {MAX_CYCLES} }};\n"
    )


_CALLED = TARGETS[PAGE].entries
FILES: dict[Path, Callable[[], str]] = {
    WEB / "signatures.mjs": lambda: signatures(_CALLED),
    WEB / "loader.d.mts": lambda: types(_CALLED),
    WEB / "pulses.mjs": pulses,
    WEB / "window.mjs": window,
    REPLAY.with_name("signatures.mjs"): signatures,
}
"""What makes each file: the page's know the kernels that it calls, the last one knows all."""


def _letters(hint: Any, named: dict[str, str]) -> str:
    """Return an annotation in the letters of the loader; named tuples are added to `named`."""
    inner = parts(hint)
    if inner is None:
        leaf = _leaf(hint)
        return f"'{LETTERS[leaf.kind]}{leaf.dimensions or ''}'"
    if not isinstance(hint, type):
        return f"[{', '.join(_letters(part, named) for _, part in inner)}]"
    if hint.__name__ not in named:
        pairs = [(name, part) for name, part in inner if part is not NoneType]
        fields = ", ".join(f"{name}: {_letters(part, named)}" for name, part in pairs)
        named[hint.__name__] = f"{{ {fields} }}"
    return hint.__name__


def _type(hint: Any, named: dict[str, str]) -> str:
    """Return an annotation as a type; the interfaces of named tuples are added to `named`."""
    inner = parts(hint)
    if inner is None:
        leaf = _leaf(hint)
        return ARRAYS[leaf.kind] if leaf.dimensions else SCALARS[leaf.kind]
    if not isinstance(hint, type):
        return f"[{', '.join(_type(part, named) for _, part in inner)}]"
    if hint.__name__ not in named:
        pairs = [(name, part) for name, part in inner if part is not NoneType]
        fields = "".join(f"  {name}: {_type(part, named)};\n" for name, part in pairs)
        named[hint.__name__] = (
            f"/** {_summary(hint)} */\nexport interface {hint.__name__} {{\n{fields}}}\n"
        )
    return hint.__name__


def _leaf(hint: Any) -> Leaf:
    """Return what an annotation of one number or array says."""
    (leaf,) = Signature(("",), (hint,), None).leaves
    return leaf


def _summary(thing: Any) -> str:
    """Return the first line of what a kernel or a tuple says of itself."""
    return (inspect.getdoc(thing) or "").partition("\n")[0]
