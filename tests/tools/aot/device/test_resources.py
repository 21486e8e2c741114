"""What a kernel takes of a GPU: what the tools say is read right, and residency follows from it."""

import shutil
import sysconfig
from pathlib import Path

import pytest

from tests.every import every
from tools.aot.device import resources
from tools.aot.device.resources import (
    CLASSES,
    HEADINGS,
    Assembled,
    ToolError,
    architecture_of,
    class_of,
    counted,
    parsed,
    resident_threads,
    row,
    table,
    tool,
)

SAID = """\
ptxas info    : 1440 bytes gmem
ptxas info    : Compiling entry function 'rs_queued_lane_fates' for 'sm_90'
ptxas info    : Function properties for rs_queued_lane_fates
    976 bytes stack frame, 1404 bytes spill stores, 1584 bytes spill loads
ptxas info    : Used 255 registers, used 0 barriers, 1016 bytes cumulative stack size
ptxas info    : Compile time = 7778.312 ms
ptxas info    : Function properties for f0_march
    40 bytes stack frame, 92 bytes spill stores, 184 bytes spill loads
ptxas info    : Function properties for f1_clock
    0 bytes stack frame, 0 bytes spill stores, 0 bytes spill loads
"""
FEW = """\
ptxas info    : Compiling entry function 'rs_few' for 'sm_80'
ptxas info    : Function properties for rs_few
    0 bytes stack frame, 0 bytes spill stores, 0 bytes spill loads
ptxas info    : Used 40 registers, 360 bytes cmem[0]
"""
LISTING = """\
\t.target\tsm_90
//--------------------- .text.rs_sum --------------------------
\t.section\t.text.rs_sum,"ax",@progbits
rs_sum:
.text.rs_sum:
        /*0000*/                   LDC R1, c[0x0][0x28] ;
        /*0010*/                   IMAD.MOV.U32 R2, RZ, RZ, RZ ;
.L_x_0:
        /*0020*/                   LDG.E.64 R4, desc[UR4][R2.64] ;
.L_x_1:
        /*0030*/                   DADD R6, R6, R4 ;
        /*0040*/                   MUFU.RCP64H R9, R7 ;
        /*0050*/                   DFMA R8, R6, R8, R8 ;
        /*0060*/                   STL.64 [R1], R8                              (*"SpillRefill"*);
        /*0070*/               @P0 BRA `(.L_x_1) ;
        /*0080*/                   IADD3 R2, R2, 0x1, RZ ;
        /*0090*/                   DSETP.GT.AND P1, PT, R6, RZ, PT ;
        /*00a0*/             @!UP1 BRA P2, `(.L_x_0) ;
        /*00b0*/               @P1 BRA `(.L_x_2) ;
        /*00c0*/                   CALL.REL.NOINC `($rs_sum$slow) ;
.L_x_2:
        /*00d0*/                   EXIT ;
.L_x_3:
        /*00e0*/                   BRA `(.L_x_3);
        /*00f0*/                   NOP;
"""
PTX = """\
.version 7.0
.target sm_80
.address_size 64
.visible .entry rs_sum(.param .u64 rs_sum_param_0)
{
 .reg .pred %p<2>; .reg .b64 %rd<3>; .reg .f64 %fd<4>;
 ld.param.u64 %rd1, [rs_sum_param_0];
 cvta.to.global.u64 %rd2, %rd1;
 mov.f64 %fd1, 0d0000000000000000;
again:
 ld.volatile.global.f64 %fd2, [%rd2];
 add.rn.f64 %fd1, %fd1, %fd2;
 setp.lt.f64 %p1, %fd1, 0d408F400000000000;
 @%p1 bra again;
 st.global.f64 [%rd2], %fd1;
 ret;
}
"""


def test_what_the_assembler_says_is_read_with_what_its_functions_spill() -> None:
    assert parsed(SAID) == [
        Assembled(
            kernel="rs_queued_lane_fates",
            architecture="sm_90",
            registers=255,
            stack=1016,
            spill_stores=1496,
            spill_loads=1768,
        )
    ]


def test_entries_are_told_apart() -> None:
    first, second = parsed(SAID + FEW)
    assert (first.kernel, second.kernel) == ("rs_queued_lane_fates", "rs_few")
    assert second == Assembled(
        kernel="rs_few",
        architecture="sm_80",
        registers=40,
        stack=0,
        spill_stores=0,
        spill_loads=0,
    )
    assert parsed("ptxas info    : 1440 bytes gmem\n") == []


@every(
    ("registers", "block", "threads"),
    [
        # As the occupancy calculator of CUDA has them for 8.0 and 9.0.
        (32, 256, 2048),
        (33, 256, 1536),
        (40, 256, 1536),
        (64, 256, 1024),
        (65, 256, 768),
        (96, 128, 640),
        (128, 128, 512),
        (129, 128, 384),
        (168, 128, 384),
        (255, 128, 256),
        (255, 256, 256),
        (255, 512, 0),
        (255, 32, 256),
        (32, 32, 1024),  # 32 blocks
        (32, 1024, 2048),
        (32, 768, 1536),
        (1, 100, 2048),  # of warps, the last one in part
    ],
)
def test_residency_is_that_of_the_occupancy_calculator(
    registers: int, block: int, threads: int
) -> None:
    assert resident_threads(registers, block) == threads


@every(("registers", "block"), [(0, 128), (256, 128), (64, 0), (64, 1025)])
def test_what_no_kernel_can_have_is_refused(registers: int, block: int) -> None:
    with pytest.raises(ValueError, match=f"{registers} registers, {block} threads"):
        resident_threads(registers, block)


@every(
    ("name", "kind"),
    [
        ("DADD", "fp64"),
        ("DSETP.GT.AND", "fp64"),
        ("MUFU.RSQ64H", "fp64"),
        ("MUFU.SIN", "other"),
        ("IMAD", "integer"),
        ("IMAD.WIDE.U32", "integer"),
        ("IMAD.MOV.U32", "other"),
        ("LDL.LU.64", "local"),
        ("LDG.E.U8", "memory"),
        ("CALL.REL.NOINC", "branch"),
        ("MOV", "other"),
    ],
)
def test_instructions_have_the_class_of_their_names(name: str, kind: str) -> None:
    assert class_of(name) == kind
    assert kind in {*CLASSES, "other"}


def test_instructions_are_counted_in_all_in_loops_and_in_the_innermost() -> None:
    whole, loops, innermost = counted(LISTING)
    assert whole.total == 16
    assert whole.classes == {
        "fp64": 4,
        "local": 1,
        "memory": 2,
        "branch": 6,
        "integer": 1,
        "other": 2,
    }
    assert loops.total == 9
    assert innermost.total == 5
    assert innermost.names == {
        "DADD": 1,
        "DMUL": 0,
        "DFMA": 1,
        "MUFU.RCP64H": 1,
        "LDL": 0,
        "STL": 1,
        "LDG": 0,
        "STG": 0,
        "BRA": 1,
    }


def test_code_without_a_loop_has_none() -> None:
    _, loops, innermost = counted("        /*0000*/                   EXIT ;\n")
    assert (loops.total, innermost.total) == (0, 0)


def test_the_architecture_is_that_of_the_name_or_of_the_text(tmp_path: Path) -> None:
    named, plain, empty = (tmp_path / f"{stem}.ptx" for stem in ("rocksteady-sm_90-a", "b", "c"))
    for file, text in ((named, PTX), (plain, PTX), (empty, "")):
        file.write_text(text, encoding="utf-8")
    assert [architecture_of(named), architecture_of(plain)] == ["sm_90", "sm_80"]
    with pytest.raises(ToolError, match=r"c\.ptx: no architecture"):
        architecture_of(empty)


def test_without_the_assembler_it_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resources, "tool", lambda _: None)
    file = tmp_path / "sum.ptx"
    file.write_text(PTX, encoding="utf-8")
    with pytest.raises(FileNotFoundError, match="ptxas"):
        table([file])


def test_a_tool_is_the_one_on_the_path_where_no_wheel_brings_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sysconfig, "get_path", lambda _: str(tmp_path))
    monkeypatch.setenv("PATH", str(tmp_path / "path"))
    assert tool("ptxas") is None
    for folder in ("path", "nvidia/cu13/bin"):
        place = tmp_path / folder
        place.mkdir(parents=True)
        shutil.copy(shutil.which("true", path="/bin:/usr/bin") or "/bin/true", place / "ptxas")
        assert tool("ptxas") == place / "ptxas"


@pytest.mark.skipif(tool("ptxas") is None, reason="no ptxas: `make ptx` installs it")
@pytest.mark.parametrize("architecture", resources.ARCHITECTURES)
def test_a_program_is_assembled_and_its_loop_is_counted(architecture: str, tmp_path: Path) -> None:
    file = tmp_path / "sum.ptx"
    file.write_text(PTX, encoding="utf-8")
    got = resources.resources(file, architecture)
    assert (got.assembled.kernel, got.assembled.architecture) == ("rs_sum", architecture)
    assert (got.assembled.stack, got.assembled.spill_stores) == (0, 0)
    assert 1 <= got.assembled.registers <= 32
    assert (got.resident, got.occupancy) == (2048, 1.0)
    assert got.code_bytes > 1000
    if tool("nvdisasm") is not None:
        assert got.whole is not None
        assert got.innermost is not None
        names = got.innermost.names
        assert names["DADD"] == names["LDG"] == names["BRA"] == 1
        assert got.whole.names["STG"] == 1
        assert len(row(got)) == len(HEADINGS)
    written = table([file])
    assert written.splitlines()[2].startswith("| sum | sm_80 | ")
    file.write_text(PTX.replace("add.rn.f64", "add.wrong"), encoding="utf-8")
    with pytest.raises(ToolError, match=r"sum\.ptx: "):
        resources.resources(file, architecture)
