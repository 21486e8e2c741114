"""PTX of the kernels of a program, one module each, so that a driver compiles what is launched.

No step is fused and every operation names its rounding: a device computes what a processor does.
"""

import re
from typing import Any

from llvmlite import binding

from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.device.program import ENTRY, VERSIONS, ProgramError, machine, parsed
from tools.aot.emit import hide
from tools.aot.lower import externals

THREADS = 128
"""The most threads of a block: with more, each would have fewer registers."""
HEADER = "// rocksteady kernels"
"""What each file begins with, before the hash of the kernels' sources."""
_UNSAFE = re.compile(
    r"\bfma\.rn\.f64(?! .*, 0dC000000000000000,)|\bmad\.\w+\.f64|\b(?:add|sub|mul)\.f64"
    r"|\.(?:approx|full|ftz)\b"
)
"""What would be rounded in another way, or may be: products with -2 are exact, and may be fused."""


def emit(program: str, kernel: str, architecture: str) -> str:
    """Return the PTX of one kernel of a program.

    Parameters
    ----------
    program
        From `tools.aot.device.program.program`.
    kernel
        Name of the kernel; in PTX it begins with `ENTRY`.
    architecture
        One of `VERSIONS`.

    Raises
    ------
    ProgramError
        If something is missing, or an operation could be rounded in another way than here.
    """
    target = machine(architecture)
    binding.set_option("", "-nvptx-fma-level=0")
    module = parsed(_kernel(program, f"{ENTRY}{kernel}"), target)
    hide(module, keep={f"{ENTRY}{kernel}"})
    optimised(module, target)
    module = parsed(_named(module), target)
    if missing := sorted(externals(module)):
        raise ProgramError(f"{kernel} calls {', '.join(missing)}, which no device has")
    text = loaded_by_name(target.emit_assembly(module))
    if unsafe := _UNSAFE.search(text):
        raise ProgramError(f"{kernel}: {unsafe[0]} may be rounded in another way on a device")
    return f"{HEADER} {sources_hash()}\n{text}"


def loaded_by_name(text: str) -> str:
    """Return PTX whose functions load their parameters by name.

    LLVM turns the choice between two parameters into a load from a chosen one, by an address in a
    register, which PTX allows for parameters of kernels only.  Here both are loaded, then chosen.
    """
    functions = re.split(r"(?<=^}$)", text, flags=re.MULTILINE)
    return "".join(_by_value(each) if _CHOSEN.search(each) else each for each in functions)


_CHOSEN = re.compile(r"ld\.param\.b64 (\s*%\w+), \[(%\w+)\];")


def _by_value(function: str) -> str:
    for _, address in _CHOSEN.findall(function):
        chosen = re.search(rf"selp\.b64 \s*{address}, (%\w+), (%\w+), %\w+;", function)
        if chosen is None:
            raise ProgramError(f"a parameter is loaded from {address}, which is not chosen of two")
        for register in chosen.groups():
            if len(re.findall(rf"{register}\b", function)) != 2:
                raise ProgramError(f"{register}, an address of a parameter, is used otherwise too")
            pattern = rf"mov\.b64 (\s*{register}), (\w+);"
            function = re.sub(pattern, r"ld.param.b64 \1, [\2];", function)
    return _CHOSEN.sub(r"mov.b64 \1, \2;", function)


def headed(text: str, architecture: str) -> str:
    """Return the PTX of the oldest architecture as that of another one.

    Nothing in the kernels is of one architecture alone: LLVM writes the same for all but the lines
    that name it.
    """
    version = VERSIONS[architecture].removeprefix("ptx")
    for key, value in (("version", f"{version[0]}.{version[1:]}"), ("target", architecture)):
        text = re.sub(rf"^\.{key} .*$", f".{key} {value}", text, count=1, flags=re.MULTILINE)
    return text


def optimised(module: binding.ModuleRef, target: Any) -> None:
    """Run LLVM's passes over a module; no vectors, which a thread does not have.

    Twice: which model a call is of reaches some functions in the second run only, which then lose
    what is of the other model.
    """
    options = binding.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization = options.slp_vectorization = False
    options.loop_unrolling = True
    for _ in range(2):
        builder = binding.create_pass_builder(target, options)
        builder.getModulePassManager().run(module, builder)


def _kernel(program: str, entry: str) -> str:
    """Return a program in which one entry is a kernel of a device, which returns nothing."""
    before, found, after = program.partition(f"i32 @{entry}(")
    if not found:
        raise ProgramError(f"there is no kernel {entry}")
    body, end, rest = after.partition("\n}\n")
    head, _, start = before.rpartition("\n")
    start = start.replace("define ", "define ptx_kernel ", 1)
    parameters, _, lines = body.partition(" {\n")
    parameters = re.sub(r" #\d+$", "", parameters)
    lines = re.sub(r"\bret i32 \S+", "ret void", lines)
    bound = f' "nvvm.maxntid"="{THREADS}"'
    return f"{head}\n{start}void @{entry}({parameters}{bound} {{\n{lines}{end}{rest}"


def _named(module: binding.ModuleRef) -> str:
    """Return a module's text with names that PTX allows, those of kernels as in Python."""
    things = [*module.functions, *module.global_variables]
    text = str(module)
    for number, name in enumerate(sorted((each.name for each in things), key=len, reverse=True)):
        if re.fullmatch(r"[A-Za-z_][\w$]*", name) and not name.startswith("_ZN"):
            continue
        if name.startswith("llvm."):
            continue
        found = re.match(r"_ZN10rocksteady7kernels(?:\d+[a-z_]+\d*)*?(\d+)([a-z_0-9]+)B\d", name)
        kind = found[2][: int(found[1])] if found else "table"
        new = f"{kind}_{number}"
        text = text.replace(f'@"{name}"', f"@{new}")
        text = re.sub(rf"@{re.escape(name)}(?![\w$.])", f"@{new}", text)
    return text
