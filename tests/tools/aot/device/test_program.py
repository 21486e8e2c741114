"""The program of a device: arrays in the memory of stacks, an atomic counter, no runtime."""

import re

import pytest

from rocksteady.kernels.machine_code.sources import sources_hash
from tests.strategies import PLAIN
from tools.aot.device.build import device_program, ptx, queued
from tools.aot.device.emit import HEADER, emit, headed, loaded_by_name
from tools.aot.device.program import ENTRY, VERSIONS, ProgramError, counting, stacked, voting

ARRAY = """
define i32 @_ZN10rocksteady7kernels4made(i64 %n) {
entry:
  br label %turn
turn:
  %made = tail call ptr @NRT_MemInfo_alloc_aligned(i64 SIZE, i32 32), !noalias !1
  %data = tail call ptr @NRT_MemInfo_data_fast(ptr nonnull %made)
  store double 1.0, ptr %data
  tail call void @NRT_decref(ptr %made)
  br i1 true, label %turn, label %end
end:
  ret i32 0
}
declare ptr @NRT_MemInfo_alloc_aligned(i64, i32)
"""
HALF = r"{ .reg .b32 tmp; mov.b64 {tmp, \1}, \2; }"
"""How PTX 7.0 takes the upper half of a number."""
COUNTER = """
define i32 @_ZN4core5queue7add_oneB2v1Ex(ptr %retptr, ptr %arg.queue.4, i64 %arg.place) {
entry:
  %old = load i64, ptr %arg.queue.4
  ret i32 0
}
"""


def test_an_array_of_constant_size_is_made_once_where_its_function_begins() -> None:
    lines = stacked(ARRAY.replace("SIZE", "1152")).splitlines()
    first = lines.index("entry:")
    assert lines[first + 1] == "  %made = alloca [1152 x i8], align 32"
    assert "  %data = getelementptr i8, ptr %made, i64 0" in lines
    assert not [line for line in lines if "NRT" in line]


def test_an_array_without_elements_has_an_address_too() -> None:
    assert "alloca [8 x i8], align 32" in stacked(ARRAY.replace("SIZE", "0"))


def test_an_array_whose_size_only_a_run_tells_is_refused() -> None:
    with pytest.raises(ProgramError, match="kernels4made makes an array whose size only a run"):
        stacked(ARRAY.replace("SIZE", "%n"))


def test_what_else_of_the_runtime_is_called_is_refused() -> None:
    with pytest.raises(ProgramError, match="numba's runtime"):
        stacked("define i32 @f() {\n  %a = call ptr @NRT_MemInfo_new(i64 8)\n  ret i32 0\n}")


def test_cells_are_counted_atomically() -> None:
    text = counting(COUNTER)
    assert text.count("atomicrmw add ptr %at, i64 1") == 1
    assert "%old" not in text


def test_a_program_that_counts_no_cells_is_refused() -> None:
    with pytest.raises(ProgramError, match="no function is named core5queue7add_one"):
        counting("define i32 @rs_one() {\n  ret i32 0\n}")


def test_workers_that_run_in_step_add_up_both_halves_of_a_number() -> None:
    text = voting(COUNTER.replace("7add_one", "8together"))
    assert text.count("call i32 @llvm.nvvm.redux.sync.add(i32") == 2


@pytest.mark.skipif(PLAIN, reason="kernels are not lowered")
@pytest.mark.slow
def test_the_program_holds_every_queued_kernel_and_one_atomic_addition_of_each() -> None:
    program = device_program()
    entries = re.findall(rf"^define [^@]*@{ENTRY}(\w+)\(", program, flags=re.MULTILINE)
    assert sorted(entries) == queued()
    assert len(entries) >= 6
    assert "@NRT_" not in program
    assert "atomicrmw" in program


@pytest.mark.skipif(PLAIN, reason="kernels are not lowered")
@pytest.mark.slow
def test_the_ptx_of_both_architectures_differs_in_its_header_alone() -> None:
    name = "queued_lane_fates"
    text = ptx(name)
    assert text.startswith(f"{HEADER} {sources_hash()}\n")
    for architecture in VERSIONS:
        emitted = emit(voting(device_program()), name, architecture)
        # From 7.1 on PTX has a name for what is not wanted.
        older = re.sub(r"mov\.b64 \s*\{_, (\S+)\}, (\S+);", HALF, emitted)
        assert older == headed(text, architecture)
    differ = [
        pair
        for pair in zip(text.splitlines(), headed(text, "sm_90").splitlines(), strict=True)
        if pair[0] != pair[1]
    ]
    assert differ == [(".version 7.0", ".version 7.8"), (".target sm_80", ".target sm_90")]


@pytest.mark.skipif(PLAIN, reason="kernels are not lowered")
@pytest.mark.slow
def test_parameters_of_functions_are_loaded_by_name() -> None:
    """LLVM loads eight of this kernel from a chosen address, as PTX allows in entries only."""
    assert re.findall(r"ld\.param\.\w+\s+%\w+, \[%.*", ptx("queued_settle_cells")) == []


@pytest.mark.parametrize(
    ("operation", "refused"),
    [
        ("call double @llvm.fma.f64(double %x, double %x, double 1.0)", "fma.rn.f64"),
        ("call double @sin(double %x)", "sin, which no device has"),
    ],
)
def test_ptx_that_could_be_rounded_in_another_way_is_refused(operation: str, refused: str) -> None:
    program = f"""
declare double @llvm.fma.f64(double, double, double)
declare double @sin(double)
define i32 @rs_one(ptr %cells) {{
  %x = load double, ptr %cells
  %y = {operation}
  store double %y, ptr %cells
  ret i32 0
}}
"""
    with pytest.raises(ProgramError, match=refused):
        emit(program, "one", "sm_90")


def test_a_kernel_of_a_device_returns_nothing() -> None:
    program = "define i32 @rs_one(ptr %cells) {\n  store i64 7, ptr %cells\n  ret i32 0\n}\n"
    text = emit(program, "one", "sm_80")
    assert ".visible .entry rs_one(" in text
    assert ".maxntid 128" in text


def test_a_kernel_that_is_not_there_is_refused() -> None:
    with pytest.raises(ProgramError, match="no kernel rs_two"):
        emit("define i32 @rs_one(ptr %cells) {\n  ret i32 0\n}\n", "two", "sm_90")


CHOSEN = """\
.func f(
{
	mov.b64 	%rd1, f_param_0;
	mov.b64 	%rd2, f_param_1;
	selp.b64 	%rd3, %rd1, %rd2, %p1;
	ld.param.b64 	%rd4, [%rd3];
	ret;
}
"""


def test_the_choice_between_two_parameters_is_one_of_their_values() -> None:
    lines = [line.split() for line in loaded_by_name(CHOSEN).splitlines()]
    assert lines[2:6] == [
        ["ld.param.b64", "%rd1,", "[f_param_0];"],
        ["ld.param.b64", "%rd2,", "[f_param_1];"],
        ["selp.b64", "%rd3,", "%rd1,", "%rd2,", "%p1;"],
        ["mov.b64", "%rd4,", "%rd3;"],
    ]


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("	add.s64 	%rd3, %rd1, 8;", "which is not chosen of two"),
        (
            "	selp.b64 	%rd3, %rd1, %rd2, %p1;\n	mov.b64 	%rd5, %rd1;",
            "is used otherwise too",
        ),
    ],
)
def test_another_address_of_a_parameter_is_refused(line: str, reason: str) -> None:
    with pytest.raises(ProgramError, match=reason):
        loaded_by_name(CHOSEN.replace("	selp.b64 	%rd3, %rd1, %rd2, %p1;", line))
