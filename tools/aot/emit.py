"""Optimise the lowered kernels for one target, and emit an object file.

The passes are numba's own three stages: each function, then what inlining needs, then all.  One
plain pipeline makes code that takes two to three times as long.
"""

import re
from collections.abc import Collection
from typing import Any

from llvmlite import binding

from tools.aot.lower import externals
from tools.aot.targets import Target

INTRINSICS = {"sqrt": "llvm.sqrt.f64", "floor": "llvm.floor.f64", "ceil": "llvm.ceil.f64"}
"""Functions of the C library that are one exact instruction, and LLVM's name for it."""
RUNTIME = {
    "NRT_MemInfo_alloc_aligned",
    "NRT_MemInfo_data_fast",
    "NRT_decref",
    "NRT_incref",
    "memcpy",
    "memset",
}
"""What an object file may leave to `runtime.c` and to the C library."""
INLINED = 160
"""Cost up to which a function is compiled into its callers.  The default, 225, makes libraries 2 %
larger, and no kernel faster."""
UNROLLED = ("--unroll-threshold=180", "--unroll-runtime=false")
"""Options of LLVM: which loops are unrolled.  With 80 instructions the lanes of the nonlinear model
take a third longer, with 150 three percent; the default, 300, and loops of unknown length make
libraries a fifth larger, and no kernel faster."""


def emit(bitcode: bytes, target: Target) -> bytes:
    """Return the object file of lowered kernels for a target.

    Raises
    ------
    ValueError
        If it calls what is neither in it nor in the runtime, as a function of the C library.
    """
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    for option in UNROLLED:
        binding.set_option("", option)
    machine = binding.Target.from_triple(target.triple).create_target_machine(
        cpu=target.cpu,
        features=target.features,
        opt=3,
        reloc="static" if target.static else "pic",
        codemodel="default",
    )
    module = binding.parse_assembly(retargeted(str(binding.parse_bitcode(bitcode))))
    module.triple = target.triple
    module.data_layout = str(machine.target_data)
    hide(module)
    if "windows" in target.triple:  # where a library shows only what is marked
        for function in module.functions:
            if function.name.startswith("rs_"):
                function.storage_class = "dllexport"
    optimise(module, machine, unrolled=not target.static)
    missing = set(externals(module)) - RUNTIME
    if missing:
        raise ValueError(f"{target.name}: kernels call {', '.join(sorted(missing))}, of no library")
    found: bytes = machine.emit_object(module)
    return found


def retargeted(text: str) -> str:
    """Return a module's text without the machine that numba ran on."""
    text = re.sub(r'^target (datalayout|triple) = ".*"\n', "", text, flags=re.MULTILINE)
    for name, intrinsic in INTRINSICS.items():
        declaration = rf"^declare double @({name}|{re.escape(intrinsic)})\(.*\n"
        text = re.sub(declaration, "", text, flags=re.MULTILINE)
        text = re.sub(rf"@{name}\(", f"@{intrinsic}(", text)
        text += f"declare double @{intrinsic}(double)\n"
    return text.replace("common global", "internal global")


def hide(module: binding.ModuleRef, keep: Collection[str] = ()) -> None:
    """Make all but the entries internal, or all but those to keep: what nobody calls goes away."""
    for function in module.functions:
        name = function.name
        if not function.is_declaration and not (name in keep if keep else name.startswith("rs_")):
            function.linkage = "internal"
    for variable in module.global_variables:
        if not variable.is_declaration:
            variable.linkage = "internal"


def optimise(module: binding.ModuleRef, machine: Any, *, unrolled: bool) -> None:
    """Run numba's passes over a module; loops stay as they are where size counts."""

    def builder(level: int) -> Any:
        options = binding.create_pipeline_tuning_options(speed_level=level)
        options.loop_vectorization = level > 2
        options.slp_vectorization = False
        options.loop_unrolling = unrolled
        options.inlining_threshold = INLINED
        return binding.create_pass_builder(machine, options)

    for function in module.functions:
        if not function.is_declaration:
            each = builder(3)
            each.getFunctionPassManager().run(function, each)
    cheap = builder(0)
    passes = cheap.getModulePassManager()
    passes.add_loop_rotate_pass()
    passes.add_instruction_combine_pass()
    passes.add_jump_threading_pass()
    passes.add_refprune_pass()
    passes.run(module, cheap)
    full = builder(3)
    passes = full.getModulePassManager()
    passes.add_refprune_pass()
    passes.run(module, full)
