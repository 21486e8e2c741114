"""What each instruction does, as a statement in C.

A form names the types of the operands, the result first.  ``u``, ``s``, ``b`` and ``f`` with a
number of bits are PTX's own types; ``p`` is a predicate; ``a64`` is also the name of a variable.  A
``+`` allows a wider register, of which the instruction takes the lower bits, or which it fills by
extension.  `prelude.h` has the functions.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Form:
    """How an instruction is written in C.

    Attributes
    ----------
    kinds
        Types of its operands.
    text
        The statement, with the operands' numbers in braces; ``{line}`` is that of the PTX.
    """

    kinds: tuple[str, ...]
    text: str


WIDTHS = (16, 32, 64)
FUSED, MINUS_TWO = "fma.rn.f64", "0dC000000000000000"
EXACT_FUSED = Form(("f64",) * 4, "{0} = result(__builtin_fma({1}, {2}, {3}));")
"""A remainder of 2 is written so: the product with -2 is exact, so that there is one rounding."""
_TWICE = {16: "int", 32: "long long", 64: "__int128"}
_ORDERED = {"eq": "==", "ne": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">="}
_UNSIGNED = {"lo": "<", "ls": "<=", "hi": ">", "hs": ">="}
_ROUNDED = {"rni": "rint", "rzi": "trunc", "rmi": "floor", "rpi": "ceil"}


def why_refused(opcode: str) -> str:
    """Return why an instruction is not translated."""
    base, *modifiers = opcode.split(".")
    kind = modifiers[-1] if modifiers else ""
    if base in {"fma", "mad"} and kind.startswith("f"):
        return f"{opcode} rounds once where the host rounds twice"
    if {"ftz", "approx", "full"} & set(modifiers):
        return f"{opcode} is not the operation of IEEE 754"
    if kind == "f64" and f"{base}.rn.f64" in FORMS and "rn" not in modifiers:
        return f"{opcode} does not say .rn: the assembler could fuse it, or it rounds otherwise"
    return f"{opcode} is not an instruction that is known"


def _integers() -> dict[str, Form]:
    forms: dict[str, Form] = {}
    for w in WIDTHS:
        for sign in "us":
            t, u = f"{sign}{w}", f"u{w}"
            twice = _TWICE[w] if sign == "s" else f"unsigned {_TWICE[w]}"
            forms |= {
                f"add.{t}": Form((u, u, u), "{0} = {1} + {2};"),
                f"sub.{t}": Form((u, u, u), "{0} = {1} - {2};"),
                f"mul.lo.{t}": Form((u, u, u), "{0} = UINT64_C(1) * {1} * {2};"),
                f"mad.lo.{t}": Form((u, u, u, u), "{0} = UINT64_C(1) * {1} * {2} + {3};"),
                f"mul.hi.{t}": Form((t, t, t), f"{{0}} = (({twice}){{1}} * {{2}}) >> {w};"),
                f"div.{t}": Form((t, t, t), f"{{0}} = div_{t}({{1}}, {{2}}, {{line}});"),
                f"rem.{t}": Form((t, t, t), f"{{0}} = rem_{t}({{1}}, {{2}}, {{line}});"),
                f"min.{t}": Form((t, t, t), "{0} = {1} < {2} ? {1} : {2};"),
                f"max.{t}": Form((t, t, t), "{0} = {1} > {2} ? {1} : {2};"),
            }
            if w < 64:
                wide = f"{sign}{2 * w}"
                forms[f"mul.wide.{t}"] = Form((wide, t, t), f"{{0}} = ({twice}){{1}} * {{2}};")
                forms[f"mad.wide.{t}"] = Form(
                    (wide, t, t, f"u{2 * w}"),
                    f"{{0}} = (uint64_t)(({twice}){{1}} * {{2}}) + {{3}};",
                )
            if w > 16:
                forms[f"bfe.{t}"] = Form(
                    (t, t, "u32", "u32"), f"{{0}} = bfe_{t}({{1}}, {{2}}, {{3}});"
                )
        s, b = f"s{w}", f"b{w}"
        forms |= {
            f"neg.{s}": Form((f"u{w}",) * 2, "{0} = UINT64_C(0) - {1};"),
            f"abs.{s}": Form(
                (f"u{w}", s), "{0} = {1} < 0 ? UINT64_C(0) - (uint64_t){1} : (uint64_t){1};"
            ),
            f"and.{b}": Form((b, b, b), "{0} = {1} & {2};"),
            f"or.{b}": Form((b, b, b), "{0} = {1} | {2};"),
            f"xor.{b}": Form((b, b, b), "{0} = {1} ^ {2};"),
            f"not.{b}": Form((b, b), "{0} = ~{1};"),
            f"shl.{b}": Form((b, b, "u32"), f"{{0}} = {{2}} < {w} ? (uint64_t){{1}} << {{2}} : 0;"),
            f"shr.s{w}": Form((s, s, "u32"), f"{{0}} = {{1}} >> ({{2}} < {w} ? {{2}} : {w - 1});"),
        }
        for t in (f"u{w}", b):
            forms[f"shr.{t}"] = Form((t, t, "u32"), f"{{0}} = {{2}} < {w} ? {{1}} >> {{2}} : 0;")
        if w > 16:
            long = "ll" if w == 64 else ""
            forms |= {
                f"popc.{b}": Form(("u32", b), f"{{0}} = __builtin_popcount{long}({{1}});"),
                f"clz.{b}": Form(("u32", b), f"{{0}} = {{1}} ? __builtin_clz{long}({{1}}) : {w};"),
                f"brev.{b}": Form((b, b), f"{{0}} = brev({{1}}, {w});"),
                f"bfi.{b}": Form(
                    (b, b, b, "u32", "u32"), f"{{0}} = bfi({{1}}, {{2}}, {{3}}, {{4}}, {w});"
                ),
            }
    for name, c in (("and", "&"), ("or", "|"), ("xor", "^")):
        forms[f"{name}.pred"] = Form(("p", "p", "p"), f"{{0}} = {{1}} {c} {{2}};")
    forms["not.pred"] = Form(("p", "p"), "{0} = !{1};")
    for t in ("u32", "s32"):
        vote = "{0} = redux_add({1}, {2}, {line});"
        forms[f"redux.sync.add.{t}"] = Form(("u32", "u32", "b32"), vote)
    forms["prmt.b32"] = Form(("b32",) * 4, "{0} = prmt({1}, {2}, {3});")
    return forms


def _floats() -> dict[str, Form]:
    three, two = ("f64",) * 3, ("f64",) * 2
    pair, one = ("p", "f64", "f64"), ("p", "f64")
    unordered = "({1} != {1} || {2} != {2})"
    forms = {
        "add.rn.f64": Form(three, "{0} = result({1} + {2});"),
        "sub.rn.f64": Form(three, "{0} = result({1} - {2});"),
        "mul.rn.f64": Form(three, "{0} = result({1} * {2});"),
        "div.rn.f64": Form(three, "{0} = result({1} / {2});"),
        "rcp.rn.f64": Form(two, "{0} = result(1.0 / {1});"),
        "sqrt.rn.f64": Form(two, "{0} = result(__builtin_sqrt({1}));"),
        "abs.f64": Form(two, "{0} = result(__builtin_fabs({1}));"),
        "neg.f64": Form(two, "{0} = result(-{1});"),
        "min.f64": Form(three, "{0} = result(min_f64({1}, {2}));"),
        "max.f64": Form(three, "{0} = result(max_f64({1}, {2}));"),
        # The sign of the first operand, the value of the second: not the order of C.
        "copysign.f64": Form(three, "{0} = __builtin_copysign({2}, {1});"),
        "testp.finite.f64": Form(one, "{0} = __builtin_fabs({1}) < __builtin_inf();"),
        "testp.infinite.f64": Form(one, "{0} = __builtin_fabs({1}) == __builtin_inf();"),
        "testp.number.f64": Form(one, "{0} = {1} == {1};"),
        "testp.notanumber.f64": Form(one, "{0} = {1} != {1};"),
        "setp.num.f64": Form(pair, f"{{0}} = !{unordered};"),
        "setp.nan.f64": Form(pair, f"{{0}} = {unordered};"),
        # `!=` of C is true of NaN, `ne` of PTX is not.
        "setp.ne.f64": Form(pair, f"{{0}} = {{1}} != {{2}} && !{unordered};"),
        "setp.neu.f64": Form(pair, "{0} = {1} != {2};"),
    }
    for name, c in _ORDERED.items():
        if name != "ne":
            forms[f"setp.{name}.f64"] = Form(pair, f"{{0}} = {{1}} {c} {{2}};")
            forms[f"setp.{name}u.f64"] = Form(pair, f"{{0}} = {{1}} {c} {{2}} || {unordered};")
    return forms


def _moves() -> dict[str, Form]:
    forms = {
        "mov.pred": Form(("p", "p"), "{0} = {1};"),
        "selp.f64": Form(("b64", "b64", "b64", "p"), "{0} = {3} ? {1} : {2};"),
        "mov.f64": Form(("b64", "b64"), "{0} = {1};"),
    }
    for w in WIDTHS:
        for t in (f"b{w}", f"u{w}", f"s{w}"):
            source = "a64" if w == 64 else t
            forms[f"mov.{t}"] = Form((t, source), "{0} = {1};")
            forms[f"selp.{t}"] = Form((t, t, t, "p"), "{0} = {3} ? {1} : {2};")
            compared = {"b": {}, "u": _ORDERED | _UNSIGNED, "s": _ORDERED}[t[0]]
            for name, c in (compared or {"eq": "==", "ne": "!="}).items():
                forms[f"setp.{name}.{t}"] = Form(("p", t, t), f"{{0}} = {{1}} {c} {{2}};")
    for space in ("global", "local", "const"):
        for way in ("cvta", "cvta.to"):
            forms[f"{way}.{space}.u64"] = Form(("b64", "a64"), "{0} = {1};")
    return forms


def _conversions() -> dict[str, Form]:
    forms = {}
    integers = [(sign, w) for w in (8, *WIDTHS) for sign in "us"]
    for sign, w in integers:
        t = f"{sign}{w}"
        c = ("u" if sign == "u" else "") + f"int{w}_t"
        for source, v in integers:
            name = f"cvt.{t}.{source}{v}"
            forms[name] = Form((f"{t}+", f"{source}{v}+"), f"{{0}} = ({c}){{1}};")
        forms[f"cvt.rn.f64.{t}"] = Form(("f64", f"{t}+"), "{0} = (double){1};")
        for way, rounded in _ROUNDED.items():
            forms[f"cvt.{way}.{t}.f64"] = Form(
                (f"{t}+", "f64"), f"{{0}} = {t}_of(__builtin_{rounded}({{1}}), {{line}});"
            )
    for way, rounded in _ROUNDED.items():
        forms[f"cvt.{way}.f64.f64"] = Form(
            ("f64", "f64"), f"{{0}} = result(__builtin_{rounded}({{1}}));"
        )
    return forms


FORMS = _integers() | _floats() | _moves() | _conversions()
"""By opcode."""
