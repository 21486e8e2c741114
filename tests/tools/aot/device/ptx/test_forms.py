"""Each instruction of translated PTX against an oracle in Python, and what is refused."""

import itertools
import math

import numpy as np
import pytest

from tests.every import every
from tests.tools.aot.device.ptx.oracles import NAN, bits_of, expected, number_of
from tests.tools.aot.device.snippets import HEAD, Load, entry, loads_in, run
from tools.aot.device.ptx.forms import EXACT_FUSED, FORMS, FUSED, Form
from tools.aot.device.ptx.text import PtxError
from tools.aot.device.ptx_to_c import Program, translated

OPERANDS = 4
ROWS = 400
NAMES = {f"e{n}": opcode for n, opcode in enumerate(FORMS)}
DOUBLES = [
    *(sign * each for sign in (1.0, -1.0) for each in (0.0, 0.5, 1.0, 1.5, 2.5, math.pi, 1e16)),
    *(sign * each for sign in (1.0, -1.0) for each in (math.inf, 5e-324, 2.3e-308, 1.8e308)),
    *(2.0**n + d for n in (7, 8, 15, 16, 31, 32, 53) for d in (-1.0, -0.5, 0.0, 0.5)),
    *(-(2.0**n) for n in (7, 15, 31, 63, 64)),
    2.0**63,
    2.0**64,
    2.0**63 - 1024.0,
]


@pytest.fixture(scope="module")
def load(tmp_path_factory: pytest.TempPathFactory) -> Load:
    """Load a text of PTX, its head left out."""
    return loads_in(tmp_path_factory)


@pytest.fixture(scope="module")
def instructions(load: Load) -> dict[str, Program]:
    """Every instruction that is known, as a kernel over arrays."""
    texts = [over_arrays(name, opcode, FORMS[opcode]) for name, opcode in NAMES.items()]
    return load("\n".join(texts))


def over_arrays(name: str, opcode: str, form: Form) -> str:
    """Return an entry that executes an instruction on each row of (rows, 4) operands of 8 bytes."""
    lines = [
        "ld.global.b64 %rd2, [%rd1];",
        "ld.global.b64 %rd3, [%rd1+8];",
        "ld.global.b64 %rd4, [%rd1+16];",
        "$next:",
        "setp.eq.b64 %p8, %rd4, 0;",
        "@%p8 bra $end;",
    ]
    target, *sources = form.kinds
    for n, kind in enumerate(sources):
        if kind == "p":
            lines.append(f"ld.global.b16 %rs{n}, [%rd2+{8 * n}];")
            lines.append(f"setp.ne.b16 %p{n}, %rs{n}, 0;")
        else:
            lines.append(f"ld.global.b{_bits(kind)} {_named(kind, n)}, [%rd2+{8 * n}];")
    given = ", ".join(_named(kind, n) for n, kind in enumerate(sources))
    lines.append(f"{opcode} {_named(target, 7)}, {given};")
    if target == "p":
        lines.append("selp.b64 %rd17, 1, 0, %p7;")
        lines.append("st.global.b64 [%rd3], %rd17;")
    else:
        lines.append(f"st.global.b{_bits(target)} [%rd3], {_named(target, 7)};")
    lines += [
        f"add.s64 %rd2, %rd2, {8 * OPERANDS};",
        "add.s64 %rd3, %rd3, 8;",
        "sub.s64 %rd4, %rd4, 1;",
        "bra.uni $next;",
        "$end:",
    ]
    return entry(name, "\n".join(lines))


def _bits(kind: str) -> int:
    return max(16, int(kind.strip("+")[1:]))


def _named(kind: str, n: int) -> str:
    """Return the register of an operand, one that is just wide enough."""
    if kind == "p":
        return f"%p{n}"
    return {16: f"%rs{n}", 32: f"%r{n}", 64: f"%rd{n + 10}"}[_bits(kind)]


def drawn(kind: str, random: np.random.Generator, count: int) -> list[int]:
    """Return the bits of operands: extreme ones, small ones, and any."""
    width = 16 if kind == "p" else max(16, int(kind.strip("+")[1:]))
    whole = random.integers(0, 2**64, count, dtype=np.uint64).tolist()
    if kind[0] == "p":
        return [each % 2 for each in whole]
    if kind[0] == "f":
        near = (random.normal(size=count) * 2.0 ** random.integers(-3, 66, count)).tolist()
        halves = (random.integers(-(2**20), 2**20, count) / 2.0).tolist()
        nans = [0x7FF8 << 48, 0xFFF8 << 48, 0x7FF8 << 48 | 1]
        special = [*(bits_of(each) for each in DOUBLES), *nans]
        choices = [
            whole,
            [bits_of(each) for each in near],
            [bits_of(each) for each in halves],
            [special[n] for n in random.integers(0, len(special), count)],
        ]
    else:
        extreme = [0, 1, 2**width - 1, 2 ** (width - 1), 2 ** (width - 1) - 1, 127, 128, 255]
        choices = [
            whole,
            [each >> int(n) for each, n in zip(whole, random.integers(0, 64, count), strict=True)],
            random.integers(0, 80, count).tolist(),
            [extreme[n] for n in random.integers(0, len(extreme), count)],
        ]
    which = random.integers(0, len(choices), count)
    return [choices[w][n] % 2**width for n, w in enumerate(which)]


@every("name", NAMES)
def test_an_instruction_does_what_the_reference_says(
    name: str, instructions: dict[str, Program]
) -> None:
    opcode = NAMES[name]
    target, *sources = FORMS[opcode].kinds
    random = np.random.default_rng(len(opcode) + sum(opcode.encode()))
    columns = [drawn(kind, random, ROWS) for kind in sources]
    if opcode.startswith("redux"):
        columns[1] = [2**32 - 1] * ROWS
    for row in range(0, ROWS, 4) if len(sources) > 1 and sources[0] == sources[1] else ():
        sign = 2**63 if sources[0] == "f64" and row % 8 else 0
        columns[1][row] = columns[0][row] ^ sign  # equal operands, and zeros of both signs
    if sources[:2] == ["f64", "f64"]:
        pairs = itertools.product(
            map(bits_of, (0.0, -0.0, 1.0, math.inf, -math.inf, math.nan)), repeat=2
        )
        for row, pair in enumerate(pairs, 200):
            columns[0][row], columns[1][row] = pair
    given = np.zeros((ROWS, OPERANDS), dtype=np.uint64)
    for n, column in enumerate(columns):
        given[:, n] = column
    made = np.zeros(ROWS, dtype=np.uint64)
    run(instructions[name], (given, made, ROWS))
    width = 1 if target == "p" else max(16, int(target.strip("+")[1:]))
    for operands, found in zip(zip(*columns, strict=True), made.tolist(), strict=True):
        wanted = expected(opcode, list(operands), width)
        if wanted == NAN:
            assert math.isnan(number_of(found)), (opcode, operands)
        else:
            assert found == wanted, (opcode, [hex(each) for each in operands])


def test_a_product_with_minus_two_is_the_only_one_that_is_fused(load: Load) -> None:
    lines = "ld.global.b64 %rd2, [%rd1];\nld.global.b64 %rd3, [%rd1+8];\n"
    lines += "{} %rd4, %rd2, {}, %rd3;\nst.global.b64 [%rd1+16], %rd4;"
    program = load(entry("k", lines.format(FUSED, "0dC000000000000000")))["k"]
    for x, y in ((3.0, 0.1), (1e308, 1.0), (math.pi, 2.0 * math.pi)):
        (found,) = run(program, (bits_of(x), bits_of(y)), 1).tolist()
        assert number_of(found) == -2.0 * x + y
    assert EXACT_FUSED.kinds == ("f64",) * 4
    with pytest.raises(PtxError, match="rounds once"):
        translated(HEAD + entry("k", lines.format(FUSED, "0d4008000000000000")))


REFUSED = {
    "add.f64 %rd2, %rd3, %rd4;": "does not say .rn",
    "mul.f64 %rd2, %rd3, %rd4;": "does not say .rn",
    "sub.rz.f64 %rd2, %rd3, %rd4;": "does not say .rn",
    "div.rm.f64 %rd2, %rd3, %rd4;": "does not say .rn",
    "sqrt.rp.f64 %rd2, %rd3;": "does not say .rn",
    "fma.rn.f64 %rd2, %rd3, %rd4, %rd5;": "rounds once",
    "mad.rn.f64 %rd2, %rd3, %rd4, %rd5;": "rounds once",
    "rcp.approx.ftz.f64 %rd2, %rd3;": "not the operation of IEEE 754",
    "div.full.f32 %r2, %r3, %r4;": "not the operation of IEEE 754",
    "add.rn.f32 %r2, %r3, %r4;": "not an instruction that is known",
    "ex2.approx.ftz.f32 %r2, %r3;": "not the operation of IEEE 754",
    "cvt.rn.f32.f64 %r2, %rd3;": "not an instruction that is known",
    "cvt.rz.f64.s64 %rd2, %rd3;": "not an instruction that is known",
    "atom.global.add.f64 %rd2, [%rd3], %rd4;": "not an instruction that is known",
    "atom.global.cas.b64 %rd2, [%rd3], %rd4, %rd5;": "not an instruction that is known",
    "ld.shared.b64 %rd2, [%rd3];": "not an instruction that is known",
    "ld.volatile.global.b64 %rd2, [%rd3];": "not an instruction that is known",
    "st.global.nc.b64 [%rd3], %rd2;": "only read",
    "shfl.sync.idx.b32 %r2, %r3, 0, 31, -1;": "not an instruction that is known",
    "bar.sync 0;": "not an instruction that is known",
    "trap;": "not an instruction that is known",
    "mov.u32 %r1, %tid.x;": "%tid.x is not a register",
    "mov.b64 %rd2, elsewhere;": "elsewhere is not a value",
    "add.s64 %rd2, %rd3, %r4;": "has 32 bits, the instruction takes 64",
    "add.rn.f64 %rd2, %rd3, 1;": "not a double",
    "add.s32 %r2, %r3, 4294967296;": "more than 32 bits",
    "add.s64 %rd2, %rd3;": "has 2 operands, it takes 3",
    "add.s64 %rd99, %rd3, %rd4;": "not a register of this function",
    "mov.b64 {%r1, %r2, %r3}, %rd4;": "3 parts",
    "call.uni missing, (%rd2);": "no function of this file",
    "call (%rd2), %rd3, (%rd2);": "no function of this file",
    "add.s64 %rd2, %rd3, %rd4; add.s64 %rd2, %rd3, %rd4;": "not one statement",
    "ld.param.b64 %rd2, [cells+8];": "not inside",
    "brx.idx %r1, $nowhere;": "no list of labels",
}


@every("line", REFUSED)
def test_what_is_not_known_is_refused_with_its_line(line: str) -> None:
    ptx = HEAD + entry("k", line)
    number = ptx.splitlines().index(line) + 1
    with pytest.raises(PtxError, match=REFUSED[line]) as raised:
        translated(ptx)
    assert raised.value.line == number
    assert str(number) in str(raised.value)


@every(
    ("ptx", "why"),
    [
        (".extern .func f(\n.param .b64 x\n);", "another module"),
        (".shared .align 8 .b8 s[64];", "not a declaration"),
        (".global .align 8 .f64 g[1] = {0d3FF0000000000000};", "not an element"),
        (".global .align 8 .b8 g[1] = {1, 2};", "more values than room"),
        (
            ".visible .entry k(\n.param .u64 a,\n.param .u64 b\n)\n{\nret;\n}",
            "must take one address",
        ),
        (".visible .entry k(\n.param .u64 a\n)\n{\n.reg .f32 %f<3>;\nret;\n}", "other precision"),
        (".visible .entry k(\n.param .u64 a\n)\n{\nret;", "does not end"),
    ],
)
def test_modules_that_are_not_known_are_refused(ptx: str, why: str) -> None:
    with pytest.raises(PtxError, match=why):
        translated(HEAD + ptx)
