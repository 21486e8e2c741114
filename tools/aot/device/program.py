"""The program of a device: the lowered kernels, with what a device does not have replaced.

A device has no heap: an array that a kernel makes becomes memory of its stack, for which its size
must be a constant once helpers are inlined.  Nobody counts references then.  And cells are counted
by an atomic addition, because all workers take them from the same queue.

The program is text of LLVM's intermediate language, the same for PTX and for the emulation.
"""

import re
from collections.abc import Collection
from typing import Any

from llvmlite import binding

from tools.aot.emit import hide, retargeted

TRIPLE, OLDEST = "nvptx64-nvidia-cuda", "sm_80"
ENTRY = "rs_"
"""What the names of entries begin with."""
_PACKAGE = "rocksteady"
_MADE = re.compile(r"\s*(%\S+) = [^@]*@NRT_MemInfo_alloc_aligned\(i64 (\S+), i32 (\S+)\)")
_DATA = re.compile(r"\s*(%\S+) = [^@]*@NRT_MemInfo_data_fast\(.*?(%[^\s)]+)\)")
_COUNTED = re.compile(r"call void @NRT_(incref|decref)\(|^declare .*@NRT_")
_FUNCTION = re.compile(r"^define [^@]*@\"?([^\"(]+)")


class ProgramError(Exception):
    """A kernel needs what a device does not have."""


def program(bitcode: bytes, cold: Collection[str] = ()) -> str:
    """Return the program of lowered kernels.

    Parameters
    ----------
    bitcode
        From `tools.aot.device.lower`.
    cold
        Names of kernels that are called rarely: they are not inlined, so that what is called often
        keeps the registers.

    Raises
    ------
    ProgramError
        If a kernel makes an array whose size is known at run time only, or no kernel counts cells.
    """
    text = counting(retargeted(str(binding.parse_bitcode(bitcode))))
    module = parsed(text, machine(OLDEST))
    hide(module)
    _drop_unused(module)
    # numba's own helpers hide the sizes of arrays from the kernels that make them.
    for function in module.functions:
        if not function.is_declaration:
            name = function.name
            function.add_function_attribute("convergent")
            if any(re.search(rf"\d{each}B\d", name) for each in cold):
                function.add_function_attribute("noinline")
            elif _PACKAGE not in name and not name.startswith(ENTRY):
                function.add_function_attribute("alwaysinline")
    cheap = _builder(0)
    passes = cheap.getModulePassManager()
    passes.add_always_inliner_pass()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, cheap)
    for function in module.functions:
        if not function.is_declaration:
            full = _builder(3)
            full.getFunctionPassManager().run(function, full)
    return stacked(str(module))


def machine(architecture: str) -> Any:
    """Return what emits PTX for an architecture, as ``"sm_90"``."""
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    return binding.Target.from_triple(TRIPLE).create_target_machine(
        cpu=architecture, features=f"+{VERSIONS[architecture]}", opt=3
    )


VERSIONS = {"sm_80": "ptx70", "sm_90": "ptx78"}
"""Architectures, and the oldest version of PTX that names each: older drivers read no newer one."""


def parsed(text: str, target: Any) -> binding.ModuleRef:
    """Return a module of a text for a target."""
    module = binding.parse_assembly(retargeted(text))
    module.triple = target.triple
    module.data_layout = str(target.target_data)
    return module


def _builder(level: int) -> Any:
    options = binding.create_pipeline_tuning_options(speed_level=level)
    options.loop_vectorization = options.slp_vectorization = options.loop_unrolling = False
    return binding.create_pass_builder(machine(OLDEST), options)


def _drop_unused(module: binding.ModuleRef) -> None:
    cheap = _builder(0)
    passes = cheap.getModulePassManager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, cheap)


def counting(text: str) -> str:
    """Return a program in which the kernel that counts cells does it by an atomic addition.

    Raises
    ------
    ProgramError
        If none counts them.
    """
    return _rewritten(text, "core5queue7add_one", _ATOMIC)


def voting(text: str) -> str:
    """Return a program whose workers run in step, 32 at a time, and add up a number over all.

    On a device they are the threads of a warp, which take one branch together or both one after
    the other.

    Raises
    ------
    ProgramError
        If none adds up.
    """
    declared = "declare i32 @llvm.nvvm.redux.sync.add(i32, i32) convergent\n"
    return _rewritten(text, "core5queue8together", _VOTE) + "\n" + declared


_ATOMIC = """\
  %at = getelementptr i64, ptr %arg.queue.4, i64 %arg.place
  %before = atomicrmw add ptr %at, i64 1 syncscope("device") monotonic, align 8
  store i64 %before, ptr %retptr, align 8
  ret i32 0
}"""
_VOTE = """\
  %low = trunc i64 %arg.number to i32
  %shifted = lshr i64 %arg.number, 32
  %high = trunc i64 %shifted to i32
  %lows = call i32 @llvm.nvvm.redux.sync.add(i32 %low, i32 -1) convergent
  %highs = call i32 @llvm.nvvm.redux.sync.add(i32 %high, i32 -1) convergent
  %wide = zext i32 %highs to i64
  %moved = shl i64 %wide, 32
  %narrow = zext i32 %lows to i64
  %sum = or i64 %moved, %narrow
  store i64 %sum, ptr %retptr, align 8
  ret i32 0
}"""


def _rewritten(text: str, name: str, body: str) -> str:
    """Return a program with another body of a function, however often it was lowered."""
    lines = iter(text.splitlines())
    kept, count = [], 0
    for line in lines:
        kept.append(line)
        if line.startswith("define ") and name in line:
            count += 1
            while next(lines) != "}":
                pass
            kept.append(body)
    if count == 0:
        raise ProgramError(f"no function is named {name}")
    return "\n".join(kept)


def stacked(text: str) -> str:
    """Return a program whose kernels make their arrays in the memory of their stack.

    It is reserved where the function begins, so that a loop does not take it again: an array made
    in a loop lives as long as a turn of it.
    """
    kept: list[str] = []
    entry, name = 0, ""
    for line in text.splitlines():
        if function := _FUNCTION.match(line):
            name, entry = function[1], len(kept) + 1
        elif entry == len(kept) and re.match(r"^[^\s:]+:", line):
            entry += 1  # after the label of the first block
        if made := _MADE.match(line):
            where, size, align = made.groups()
            if not size.isdigit():
                raise ProgramError(f"{name} makes an array whose size only a run tells")
            kept.insert(entry, f"  {where} = alloca [{max(int(size), 8)} x i8], align {align}")
        elif data := _DATA.match(line):
            kept.append(f"  {data[1]} = getelementptr i8, ptr {data[2]}, i64 0")
        elif _COUNTED.search(line) is None:
            kept.append(line)
    whole = "\n".join(kept)
    if "@NRT_" in whole:
        raise ProgramError("a call of numba's runtime is left")
    return whole
