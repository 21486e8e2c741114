"""What is said of PTX that is not run."""

import pytest

from tests.tools.aot.device.snippets import HEAD, entry
from tools.aot.device.ptx.hazards import MOST_STACK, Facts, Unset, facts
from tools.aot.device.ptx.text import PtxError, parsed


def known(ptx: str) -> Facts:
    return facts(parsed(HEAD + ptx))


def line_of(ptx: str, text: str) -> int:
    return (HEAD + ptx).splitlines().index(text) + 1


def function(name: str, lines: str) -> str:
    return f".func {name}(\n.param .b64 {name}_a\n)\n{{\n.reg .b64 %rd<9>;\n{lines}\nret;\n}}\n"


CALL = "{{\n.param .b64 p;\nst.param.b64 [p], 1;\ncall.uni {}, (p);\n}}"


def test_stack_is_that_of_the_deepest_calls() -> None:
    memory = ".local .align 8 .b8 depot[{}];"
    ptx = function("low", memory.format(100))
    ptx += function("lower", memory.format(20) + "\n" + CALL.format("low"))
    ptx += entry("k", "\n".join((memory.format(8), CALL.format("low"), CALL.format("lower"))))
    assert known(ptx).stack == 128


def test_too_much_stack_is_refused() -> None:
    room = entry("k", f".local .align 8 .b8 depot[{MOST_STACK}];")
    assert known(room).stack == MOST_STACK
    with pytest.raises(PtxError, match="bytes of stack"):
        known(room.replace(str(MOST_STACK), str(MOST_STACK + 8)))


def test_a_function_that_calls_itself_is_refused() -> None:
    ptx = function("even", CALL.format("odd")) + function("odd", CALL.format("even"))
    with pytest.raises(PtxError, match="calls itself"):
        known(ptx + entry("k", CALL.format("even")))


BRANCH = """setp.eq.b64 %p1, %rd1, 0;
@%p1 bra $set;
{before}
bra.uni $both;
$set:
mov.b64 %rd5, 1;
$both:
add.s64 %rd6, %rd5, 1;"""


def test_a_register_that_one_way_leaves_unset_is_named() -> None:
    ptx = entry("k", BRANCH.format(before="mov.b64 %rd4, 1;"))
    line = line_of(ptx, "add.s64 %rd6, %rd5, 1;")
    assert known(ptx).unset == (Unset("k", "%rd5", line),)
    assert known(entry("k", BRANCH.format(before="mov.b64 %rd5, 1;"))).unset == ()


def test_what_a_predicate_guards_need_not_be_set() -> None:
    ptx = entry("k", BRANCH.format(before="@%p1 mov.b64 %rd5, 1;"))
    assert [each.register for each in known(ptx).unset] == ["%rd5"]


def test_registers_of_a_loop_are_set_before_it() -> None:
    loop = "{}$next:\nadd.s64 %rd5, %rd5, 1;\nsetp.lt.s64 %p1, %rd5, 9;\n@%p1 bra $next;"
    assert known(entry("k", loop.format("mov.b64 %rd5, 0;\n"))).unset == ()
    assert len(known(entry("k", loop.format(""))).unset) == 1


def test_a_loop_without_an_end_is_named() -> None:
    ptx = entry("k", "setp.eq.b64 %p1, %rd1, 0;\n@%p1 bra $end;\n$on:\nbra.uni $on;\n$end:")
    assert known(ptx).endless == (line_of(ptx, "$on:"),)
    assert known(ptx.replace("bra.uni $on", "@%p1 bra $on")).endless == ()


def test_a_list_of_labels_leads_on() -> None:
    lines = "mov.b32 %r1, 0;\n$list: .branchtargets\n$a,\n$b;\nbrx.idx %r1, $list;\n"
    lines += "$a:\nmov.b64 %rd5, 1;\nbra.uni $c;\n$b:\nmov.b64 %rd4, 1;\n$c:\nmov.b64 %rd6, %rd5;"
    ptx = entry("k", lines)
    assert known(ptx).endless == ()
    assert known(ptx).unset == (Unset("k", "%rd5", line_of(ptx, "mov.b64 %rd6, %rd5;")),)


def test_lines_that_need_a_second_look() -> None:
    address = "mov.b64 %rd1, f_a;\nld.param.b64 %rd2, [%rd1];"
    votes = "atom.global.add.u64 %rd5, [%rd1], 1;\nredux.sync.add.s32 %r1, 1, -1;"
    ptx = function("f", address) + entry("k", votes)
    found = known(ptx)
    assert found.parameters == (line_of(ptx, "ld.param.b64 %rd2, [%rd1];"),)
    assert found.atomics == (line_of(ptx, "atom.global.add.u64 %rd5, [%rd1], 1;"),)
    assert found.votes == (line_of(ptx, "redux.sync.add.s32 %r1, 1, -1;"),)
