"""Lower entries, with all that they call, to one module of LLVM's intermediate language.

numba links and optimises each function for the machine that it runs on as soon as it is lowered.
Here it does neither: inside this process each function leaves its raw module, and they are linked
once, so that every function is there once, for any target.  Beside them stands the C function
``int32_t rs_<name>(int64_t *cells)`` of each entry; `machine_code.library` says what is in the
cells.
"""

import functools
import gc
import itertools
import multiprocessing
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from llvmlite import binding, ir
from numba.core import bytecode, cgutils, codegen, cpu, types
from numba.core.registry import cpu_target
from numba.core.runtime.nrt import rtsys
from numba.core.targetconfig import ConfigStack
from numba.np.arrayobj import make_array, populate_array

from tools.aot.dispatch import EXTRA_OPTIONS, compile_kernel

BYTE = ir.IntType(8)
CELL = ir.IntType(64)
STATUS = ir.IntType(32)
SHARING = ("march", "settle_cells")
"""Entries that call most of what kernels in lanes call, too; they are lowered before those."""


def lower(kernels: Mapping[str, Any], progress: Any) -> binding.ModuleRef:
    """Return kernels and what they call as one module, neither optimised nor for a target.

    Those that march in lanes are lowered in a second process, where there are others too.

    Must run in a process of its own: numba compiles nothing for this machine any more.

    Parameters
    ----------
    kernels
        The entries, by name.
    progress
        Called with the name of each entry before it is lowered.
    """
    # numba's own runtime is compiled for real, and before that stops.
    rtsys.initialize(cpu_target.target_context)
    modules = _keep_raw_modules()
    _remember_types()
    gc.disable()  # what numba makes stays until the end: an eighth of the time
    EXTRA_OPTIONS.update(no_cpython_wrapper=True, no_cfunc_wrapper=True)

    def part(names: Collection[str]) -> binding.ModuleRef:
        """Return kernels as one module, with what has been lowered since the last one."""
        lowered = {}
        for name in names:
            progress(name)
            lowered[name] = compile_kernel(kernels[name])
        whole = binding.parse_assembly("")
        for module in modules:
            whole.link_in(module)
        modules.clear()
        whole.link_in(binding.parse_assembly(str(_entries(lowered))))
        return whole

    def apart(file: Path) -> None:
        """Write the lanes into a file, with names that the other process gives to nothing."""
        identity: Any = bytecode.FunctionIdentity
        identity._unique_ids = itertools.count(10**6)
        write(part(lanes), file)

    lanes = [name for name, kernel in kernels.items() if "lanes." in kernel.__module__]
    rest = [name for name in kernels if name not in lanes]
    if not (lanes and rest and "fork" in multiprocessing.get_all_start_methods()):
        return part([*kernels])
    whole = part([name for name in rest if name in SHARING])
    with TemporaryDirectory(prefix="rocksteady-") as scratch:
        file = Path(scratch, "lanes.bc")
        other = multiprocessing.get_context("fork").Process(target=apart, args=(file,))
        other.start()
        whole.link_in(part([name for name in rest if name not in SHARING]))
        other.join()
        whole.link_in(binding.parse_bitcode(file.read_bytes()))
    return whole


def write(module: binding.ModuleRef, file: Path) -> None:
    """Write a module as bitcode."""
    file.write_bytes(module.as_bitcode())


def _keep_raw_modules() -> list[binding.ModuleRef]:
    """Make numba keep what it lowers instead of compiling it; return the list that it fills."""
    kept: list[binding.ModuleRef] = []

    def add_llvm_module(self: Any, module: binding.ModuleRef) -> None:
        for function in module.functions:
            # One that may be merged and that nobody has named yet would be dropped.
            if not function.is_declaration and function.linkage == binding.Linkage.linkonce_odr:
                function.linkage = "weak_odr"
        self._final_module.link_in(module)

    def finalize(self: Any) -> None:
        self._raise_if_finalized()
        kept.append(self._final_module)
        self._finalized = True

    def get_executable(_self: Any, library: Any, _description: Any, _environment: Any) -> object:
        library._ensure_finalized()
        return [].append  # a key that numba looks up, new each time; it is never called

    code_library: Any = codegen.CPUCodeLibrary
    code_library.add_llvm_module = add_llvm_module
    code_library.finalize = finalize
    code_library._get_module_for_linking = lambda self: self._final_module
    context: Any = cpu.CPUContext
    context.get_executable = get_executable
    return kept


def _remember_types() -> None:
    """Make numba type a call of its own functions once: elsewhere it takes a quarter of the time.

    An overload may count references, which is an option of the function that calls it.
    """
    function: Any = types.Function
    ask = function.get_call_type

    @functools.cache
    def answer(self: Any, context: Any, arguments: Any, _counts: bool) -> Any:
        return ask(self, context, arguments, {})

    def get_call_type(self: Any, context: Any, arguments: Any, named: Any) -> Any:
        flags: Any = ConfigStack.top_or_none()
        if named or flags is None:
            return ask(self, context, arguments, named)
        return answer(self, context, arguments, flags.nrt)

    function.get_call_type = get_call_type


def _entries(lowered: dict[str, Any]) -> ir.Module:
    """Return the C functions of entries that numba has lowered."""
    module = ir.Module(name="entries")
    for name, result in lowered.items():
        _Entry(module, name, result)
    return module


class _Entry:
    """Builds the C function of one entry."""

    def __init__(self, module: ir.Module, name: str, result: Any) -> None:
        self._context: Any = cpu_target.target_context
        kind = ir.FunctionType(STATUS, [CELL.as_pointer()])
        function = ir.Function(module, kind, f"rs_{name}")
        (self._cells,) = function.args
        self._builder: Any = ir.IRBuilder(function.append_basic_block())
        self._at = 0
        signature = result.signature
        arguments = [self._taken(kind) for kind in signature.args]
        callee = self._context.declare_function(module, result.fndesc)
        status, returned = self._context.call_conv.call_function(
            self._builder, callee, signature.return_type, signature.args, arguments
        )
        if signature.return_type != types.none:
            self._put(returned, signature.return_type)
        self._builder.ret(status.code)

    def _place(self, kind: Any) -> Any:
        """Return the address of the next cell."""
        where = self._builder.gep(self._cells, [ir.Constant(CELL, self._at)])
        self._at += 1
        return self._builder.bitcast(where, kind.as_pointer())

    def _load(self, kind: Any = CELL) -> Any:
        return self._builder.load(self._place(kind))

    def _taken(self, kind: Any) -> Any:
        """Return an argument, read from its cells."""
        if isinstance(kind, types.Array):
            return self._array(kind)
        if kind == types.none:
            return self._context.get_dummy_value()
        if isinstance(kind, types.BaseTuple):
            inner = [self._taken(part) for part in _types_of(kind)]
            return self._context.make_tuple(self._builder, kind, inner)
        if isinstance(kind, types.Boolean):
            return self._builder.icmp_signed("!=", self._load(BYTE), ir.Constant(BYTE, 0))
        return self._load(ir.DoubleType() if isinstance(kind, types.Float) else CELL)

    def _array(self, kind: Any) -> Any:
        """Return a C-contiguous array, of its address and its lengths."""
        builder = self._builder
        array = make_array(kind)(self._context, builder)
        address, shape = self._load(), [self._load() for _ in range(kind.ndim)]
        size = self._context.get_abi_sizeof(self._context.get_data_type(kind.dtype))
        step = item = ir.Constant(CELL, size)
        strides: list[Any] = []
        for length in reversed(shape):
            strides.insert(0, step)
            step = builder.mul(step, length)
        populate_array(
            array,
            data=builder.inttoptr(address, array.data.type),
            shape=cgutils.pack_array(builder, shape, ty=CELL),
            strides=cgutils.pack_array(builder, strides, ty=CELL),
            itemsize=item,
            meminfo=None,
        )
        return array._getvalue()

    def _put(self, value: Any, kind: Any) -> None:
        """Write a result into its cells."""
        builder = self._builder
        if kind == types.none:
            return
        if isinstance(kind, types.BaseTuple):
            for index, part in enumerate(_types_of(kind)):
                self._put(builder.extract_value(value, index), part)
        elif isinstance(kind, types.Complex):
            for index in range(2):
                self._put(builder.extract_value(value, index), kind.underlying_float)
        else:
            if isinstance(kind, types.Boolean):
                value = builder.zext(value, CELL)
            builder.store(value, self._place(value.type))


def _types_of(kind: Any) -> tuple[Any, ...]:
    """Return the types of what a tuple holds."""
    found: tuple[Any, ...] = kind.types
    return found


def externals(module: binding.ModuleRef) -> Iterator[str]:
    """Yield what a module calls and does not define, LLVM's own functions excepted."""
    for function in module.functions:
        if function.is_declaration and not function.name.startswith("llvm."):
            yield function.name
