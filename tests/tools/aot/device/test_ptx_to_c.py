"""Translated PTX: memory, calls, jumps, workers of a queue, lanes of a warp, and hazards."""

import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from tests.every import every
from tests.tools.aot.device.ptx.oracles import bits_of
from tests.tools.aot.device.snippets import HEAD, Load, entry, loads_in, run
from tools.aot.device.ptx_to_c import HAZARDS, translation
from tools.aot.link import LinkError


@pytest.fixture(scope="module")
def load(tmp_path_factory: pytest.TempPathFactory) -> Load:
    """Load a text of PTX, its head left out."""
    return loads_in(tmp_path_factory)


# --------------------------------------------------------------------- memory, calls, jumps


def test_memory_is_read_and_written_in_every_width(load: Load) -> None:
    lines = ["ld.global.b64 %rd2, [%rd1];", "ld.global.b64 %rd3, [%rd1+8];"]
    kinds = ["b8", "s8", "u16", "s16", "b32", "s32", "b64", "f64"]
    for n, kind in enumerate(kinds):
        lines.append(f"ld.global.{kind} %rd4, [%rd2+8];")
        lines.append(f"st.b{kind[1:]} [%rd3+{8 * n}], -1;")
        lines.append(f"st.global.b64 [%rd3+{8 * (len(kinds) + n)}], %rd4;")
    lines.append("ld.global.v2.b32 {%r1, %r2}, [%rd2+8];")
    lines.append("st.global.v4.b16 [%rd3+128], {%rs1, 7, %rs1, 8};")
    lines.append("st.v2.b32 [%rd3+136], {%r2, %r1};")
    lines.insert(0, "mov.b16 %rs1, 5;")
    data = np.array([0, 0xFEDCBA9876543281], dtype=np.uint64)
    made = np.zeros(18, dtype=np.uint64)
    run(load(entry("k", "\n".join(lines)))["k"], (data, made))
    stored = [255, 255, 65535, 65535, 2**32 - 1, 2**32 - 1, 2**64 - 1, 2**64 - 1]
    assert made[:8].tolist() == stored
    word = int(data[1])
    read = [0x81, 2**64 - 0x7F, 0x3281, 0x3281, 0x76543281, 0x76543281, word, word]
    assert made[8:16].tolist() == read
    assert made[16] == 0x0008_0005_0007_0005
    assert made[17] == (word >> 32) | (word & 0xFFFFFFFF) << 32


def test_a_vector_is_read_before_its_address_is_overwritten(load: Load) -> None:
    lines = "ld.global.b64 %rd2, [%rd1];\nld.global.v2.b64 {%rd2, %rd3}, [%rd2];\n"
    lines += "st.global.v2.b64 [%rd1+8], {%rd3, %rd2};"
    data = np.array([11, 12], dtype=np.uint64)
    assert run(load(entry("k", lines))["k"], (data,), 2).tolist() == [12, 11]


CALLS = """
.global .align 8 .b8 table[24] = {1, 0, 0, 0, 0, 0, 0, 0, 255, 2};
.global .align 8 .u64 where[2] = {generic(table), -1};
.func (
.param .b64 result
) rounded$up(
.param .b64 a,
.param .b32 b
)
{
.local .align 8 .b8 depot[16];
.reg .b64 %SP;
.reg .b64 %SPL;
.reg .b64 %rd<9>;
mov.b64 %SPL, depot;
cvta.local.u64 %SP, %SPL;
ld.param.b64 %rd1, [a];
ld.param.b8 %rd2, [b];
st.local.b64 [%SPL+8], %rd1;
ld.b64 %rd3, [%SP+8];
add.s64 %rd4, %rd3, %rd2;
st.param.b64 [result], %rd4;
ret;
}
""" + entry(
    "k",
    """
ld.global.b64 %rd2, [%rd1];
{ // callseq 0
.param .b64 p0;
.param .b32 p1;
.param .b64 back;
.reg .b32 part;
st.param.b64 [p0], %rd2;
mov.b64 {_, part}, 4294967299;
st.param.b32 [p1], part;
call.uni (back),
rounded$up,
(
p0,
p1
);
ld.param.b64 %rd3, [back];
} // callseq 0
st.global.b64 [%rd1+8], %rd3;
mov.b64 %rd4, table;
cvta.global.u64 %rd4, %rd4;
ld.global.nc.b64 %rd5, [%rd4+8];
st.global.b64 [%rd1+16], %rd5;
ld.global.b64 %rd6, [where];
ld.global.b8 %rd7, [%rd6+8];
st.global.b64 [%rd1+24], %rd7;
ld.global.b64 %rd8, [where+8];
st.global.b64 [%rd1+32], %rd8;
{ .reg .b32 tmp; mov.b64 {tmp, %r2}, %rd2; }
cvt.u32.u64 %r1, %rd2;
mov.b64 %rd9, {%r2, %r1};
st.global.b64 [%rd1+40], %rd9;""",
)


@pytest.mark.parametrize("checked", [False, True])
def test_functions_scopes_and_tables(load: Load, checked: bool) -> None:
    program = load(CALLS, checked=checked)["k"]
    if checked:
        program.watch([], 6)
    made = run(program, (40 << 32 | 2,), 5).tolist()
    assert made == [40 << 32 | 3, 0x2FF, 255, 2**64 - 1, 2 << 32 | 40]
    if checked:
        assert program.hazards() == []


def test_jumps_by_a_list_of_labels_and_by_predicates(load: Load) -> None:
    lines = """
ld.global.b32 %r1, [%rd1];
mov.b64 %rd2, 0;
setp.gt.u32 %p1, %r1, 2;
@%p1 bra $far;
$list: .branchtargets
$zero,
$one,
$zero;
brx.idx %r1, $list;
$one:
mov.b64 %rd2, 10;
bra.uni $end;
$zero:
mov.b64 %rd2, 20;
bra.uni $end;
$far:
mov.b64 %rd2, 30;
@!%p1 mov.b64 %rd2, 40;
@%p1 add.s64 %rd2, %rd2, 1;
$end:
st.global.b64 [%rd1+8], %rd2;"""
    program = load(entry("k", lines))["k"]
    assert [int(run(program, (n,), 1)[0]) for n in range(4)] == [20, 10, 20, 31]


def test_parameters_of_which_one_is_loaded_by_its_address(load: Load) -> None:
    function = """
.func (
.param .b64 result
) f(
.param .b64 a,
.param .b64 b
)
{
.reg .pred %p<2>;
.reg .b64 %rd<9>;
ld.param.b64 %rd1, [a];
setp.gt.s64 %p1, %rd1, 5;
mov.b64 %rd2, a;
mov.b64 %rd3, b;
selp.b64 %rd4, %rd2, %rd3, %p1;
ld.param.b64 %rd5, [%rd4];
st.param.b64 [result], %rd5;
ret;
}
"""
    call = "{\n.param .b64 p;\n.param .b64 q;\n.param .b64 r;\n"
    call += "st.param.b64 [p], %rd2;\nst.param.b64 [q], 3;\ncall.uni (r), f, (p, q);\n"
    call += "ld.param.b64 %rd3, [r];\n}\nst.global.b64 [%rd1+8], %rd3;"
    program = load(function + entry("k", f"ld.global.b64 %rd2, [%rd1];\n{call}"))["k"]
    assert [int(run(program, (n,), 1)[0]) for n in (4, 7)] == [3, 7]


# ------------------------------------------------------------------------------- workers

QUEUE = """
ld.global.b64 %rd2, [%rd1];
ld.global.b64 %rd3, [%rd1+8];
$next:
{before}
atom.global.add.u64 %rd4, [%rd2], 1;
setp.ge.s64 %p1, %rd4, 100;
{vote}
shl.b64 %rd5, %rd4, 3;
add.s64 %rd6, %rd3, %rd5;
ld.global.b64 %rd7, [%rd6];
add.s64 %rd7, %rd7, %rd4;
st.global.b64 [%rd6], %rd7;
bra.uni $next;
$end:"""
LEAVE = "@%p1 bra $end;"
VOTE = """
selp.b32 %r1, 0, 1, %p1;
redux.sync.add.s32 %r2, %r1, -1;
setp.eq.b32 %p2, %r2, 0;
@%p2 bra $end;
@%p1 bra $next;"""


def test_workers_on_threads_take_each_cell_once(load: Load) -> None:
    program = load(entry("k", QUEUE.format(before="", vote=LEAVE)))["k"]
    taken, cells = np.zeros(1, dtype=np.int64), np.zeros(100, dtype=np.int64)
    with ThreadPoolExecutor(4) as threads:
        for each in [threads.submit(run, program, (taken, cells)) for _ in range(4)]:
            each.result()
    assert taken[0] == 104
    assert cells.tolist() == list(range(100))


@every("how", [{}, {"checked": True}, {"counted": True}])
def test_a_warp_votes(load: Load, how: dict[str, bool]) -> None:
    program = load(entry("k", QUEUE.format(before="", vote=VOTE)), **how)["k"]
    taken, cells = np.zeros(1, dtype=np.int64), np.zeros(100, dtype=np.int64)
    given = np.array([taken.ctypes.data, cells.ctypes.data], dtype=np.uint64)
    if "checked" in how:
        program.watch([taken, cells], 2)
    assert program.warp(32)(given.ctypes.data) == 0
    assert cells.tolist() == list(range(100))
    assert program.votes() == (5, 0, 0)
    assert taken[0] == 5 * 32
    if "checked" in how:
        assert program.hazards() == []
    if "counted" in how:
        lanes, warps = program.executed(), program.issued()
        assert lanes["redux.sync.add.s32"] == 5 * 32
        assert warps["redux.sync.add.s32"] == 5
        assert (lanes["st.global.b64"], warps["st.global.b64"]) == (100, 4)
        assert program.executed() == {}


def test_votes_at_different_places_are_counted(load: Load) -> None:
    apart = "@%p1 bra $other;\nredux.sync.add.s32 %r2, 1, -1;\nbra.uni $both;\n"
    apart += "$other:\nredux.sync.add.s32 %r2, 1, -1;\n$both:"
    lines = "ld.global.b64 %rd2, [%rd1];\natom.global.add.u64 %rd4, [%rd2], 1;\n"
    lines += f"setp.ge.s64 %p1, %rd4, 2;\n{apart}"
    program = load(entry("k", lines), checked=True)["k"]
    taken = np.zeros(1, dtype=np.int64)
    given = np.array([taken.ctypes.data], dtype=np.uint64)
    program.watch([taken], 1)
    program.warp(4)(given.ctypes.data)
    assert program.votes() == (1, 1, 0)


# ------------------------------------------------------------------------------- hazards

DEPOT = ".local .align 8 .b8 depot[16];\nmov.b64 %rd9, depot;\n"
MET = {
    "ld.global.b64 %rd3, [%rd2+4];": 1,
    "ld.global.v2.b32 {%r1, %r2}, [%rd2+4];": 1,
    "ld.global.b64 %rd3, [%rd2+16];": 2,
    "st.global.b64 [%rd2+-8], 1;": 2,
    "ld.local.b64 %rd3, [%rd9];": 3,
    "ld.global.nc.b64 %rd3, [%rd2];": 4,
    "st.global.b64 [fixed], 1;": 4,
    "ld.global.b64 %rd3, [%rd9];": 5,
    "st.local.b64 [%rd2], 1;": 5,
    "div.s64 %rd3, 1, 0;": 6,
    "rem.u32 %r3, 1, 0;": 6,
    "cvt.rzi.s64.f64 %rd3, 0d43E0000000000000;": 7,
    "cvt.rzi.s32.f64 %r3, 0d7FF8000000000000;": 7,
    "redux.sync.add.s32 %r2, 1, 3;": 8,
}
SOUND = [
    "ld.global.v2.b64 {%rd3, %rd4}, [%rd5];",
    "st.local.b64 [%rd9], 1;\nld.b64 %rd3, [%rd9];",
    "ld.global.nc.b64 %rd3, [fixed];",
    "ld.global.b8 %rd3, [%rd2+15];",
    "cvt.rzi.s64.f64 %rd3, 0dC3E0000000000000;",
]


def _hazards(load: Load, line: str) -> Iterator[tuple[str, int, int]]:
    table = ".global .align 8 .b8 fixed[8] = {1};\n"
    first = "ld.global.b64 %rd2, [%rd1];\nadd.s64 %rd5, %rd2, 15;\nand.b64 %rd5, %rd5, -16;\n"
    ptx = table + entry("k", DEPOT + first + line)
    program = load(ptx, checked=True)["k"]
    room = np.zeros(8, dtype=np.uint64)
    at = room[1 if room[1:].ctypes.data % 16 == 0 else 2 :][:2]
    program.watch([at], 1)
    run(program, (at,))
    number = (HEAD + ptx).splitlines().index(line.splitlines()[-1]) + 1
    return ((each.kind, each.line, number) for each in program.hazards())


@pytest.mark.slow
@every("line", MET)
def test_a_hazard_is_met(load: Load, line: str) -> None:
    (kind, found, number), *more = _hazards(load, line)
    assert kind == HAZARDS[MET[line]]
    assert found == number
    assert not more or MET[line] == 5  # memory of another space may be no array either


@every("line", SOUND)
def test_sound_accesses_are_no_hazards(load: Load, line: str) -> None:
    assert list(_hazards(load, line)) == []


def test_the_nan_of_arithmetic_can_be_chosen(load: Load) -> None:
    lines = "ld.global.b64 %rd2, [%rd1];\nsub.rn.f64 %rd3, %rd2, %rd2;\n"
    lines += "st.global.b64 [%rd1+8], %rd3;"
    bits = 0x7FF8000000001234
    program = load(entry("k", lines), nan=bits)["k"]
    assert run(program, (bits_of(math.inf),), 1)[0] == bits
    assert run(program, (bits_of(1.0),), 1)[0] == 0


def test_blocks_hold_each_instruction_once() -> None:
    found = translation(HEAD + entry("k", QUEUE.format(before="", vote=VOTE)))
    assert found.entries == ("k",)
    assert sum(block["redux.sync.add.s32"] for block in found.blocks) == 1
    assert sum(block["bra"] for block in found.blocks) == 3


def test_without_a_compiler_the_error_says_what_is_needed(
    load: Load, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tools.aot.device.ptx_to_c.compilers", lambda _: {})
    with pytest.raises(LinkError, match="it needs a C compiler"):
        load(entry("k", ""))
