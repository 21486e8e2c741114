"""What instructions of PTX do, in Python's integers and fractions: by NVIDIA's reference alone.

Each function goes through the cases of the reference one by one, and returns where one holds.
"""

# ruff: noqa: PLR0911, PLR0912

import math
import struct
from collections.abc import Callable
from fractions import Fraction

ORDER = {
    "eq": lambda a, b: a == b,
    "ne": lambda a, b: a != b,
    "lt": lambda a, b: a < b,
    "le": lambda a, b: a <= b,
    "gt": lambda a, b: a > b,
    "ge": lambda a, b: a >= b,
}
SAME = {"lo": "lt", "ls": "le", "hi": "gt", "hs": "ge"}
NAN = "NaN"
"""Of any bits."""
Result = int | str


def bits_of(number: float) -> int:
    """Return the bits of a double."""
    (bits,) = struct.unpack("<Q", struct.pack("<d", number))
    return int(bits)


def number_of(bits: int) -> float:
    """Return the double of some bits."""
    (number,) = struct.unpack("<d", struct.pack("<Q", bits))
    return float(number)


def signed(value: int, width: int) -> int:
    """Return bits as a signed integer."""
    value %= 1 << width
    return value - (1 << width) if value >> (width - 1) else value


def expected(opcode: str, operands: list[int], width: int) -> Result:
    """Return what an instruction makes of the bits of its operands, in a result of some width."""
    base, *modifiers = opcode.split(".")
    kind = modifiers[-1]
    if base == "cvt":
        return converted(modifiers, operands[0], width)
    if base in {"mov", "cvta"}:
        return operands[0]
    if base == "selp":
        return operands[0] if operands[2] else operands[1]
    if kind == "f64":
        return floating(opcode, [number_of(each) for each in operands], operands)
    if kind == "pred":
        a, b = (bool(each) for each in (*operands, 0)[:2])
        return int({"and": a and b, "or": a or b, "xor": a != b, "not": not a}[base])
    whole = integral(".".join([base, *modifiers[:-1]]), kind, operands)
    return whole % (1 << width)


def integral(name: str, kind: str, raw: list[int]) -> int:
    """Return what an instruction on integers does, without a limit of width."""
    w = int(kind[1:])
    values = [signed(each, w) if kind[0] == "s" else each for each in raw]
    a, b, c = (*values, 0, 0)[:3]
    if name.startswith("setp."):
        relation = name.split(".")[1]
        return int(ORDER[SAME.get(relation, relation)](a, b))
    if name in {"div", "rem"}:
        if b == 0:
            return -1
        quotient = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
        return quotient if name == "div" else a - quotient * b
    if name == "bfe":
        return field(raw[0], raw[1] & 255, raw[2] & 255, w, is_signed=kind[0] == "s")
    if name == "bfi":
        return inserted(raw[0], raw[1], raw[2] & 255, raw[3] & 255, w)
    if name == "prmt":
        return permuted(*raw[:3])
    if name in {"shl", "shr"}:
        count = min(raw[1], w)
        return a << count if name == "shl" else a >> count
    digits = f"{raw[0]:0{w}b}"
    return {
        "add": lambda: a + b,
        "sub": lambda: a - b,
        "mul.lo": lambda: a * b,
        "mul.hi": lambda: a * b >> w,
        "mul.wide": lambda: a * b,
        "mad.lo": lambda: a * b + c,
        "mad.wide": lambda: a * b + raw[2],
        "min": lambda: min(a, b),
        "max": lambda: max(a, b),
        "neg": lambda: -a,
        "abs": lambda: abs(a),
        "and": lambda: a & b,
        "or": lambda: a | b,
        "xor": lambda: a ^ b,
        "not": lambda: ~a,
        "popc": lambda: digits.count("1"),
        "clz": lambda: len(digits) - len(digits.lstrip("0")),
        "brev": lambda: int(digits[::-1], 2),
        "redux.sync.add": lambda: a,  # of a warp of one lane
    }[name]()


def field(a: int, start: int, count: int, w: int, *, is_signed: bool) -> int:
    """Return a field of bits, as the reference's pseudocode takes it out."""
    sign = a >> min(start + count - 1, w - 1) & 1 if is_signed and count else 0
    return sum(
        (a >> (start + i) & 1 if i < count and start + i < w else sign) << i for i in range(w)
    )


def inserted(a: int, b: int, start: int, count: int, w: int) -> int:
    """Return bits with a field put in."""
    for i in range(count):
        if start + i < w:
            place = start + i
            b = (b & ~(1 << place)) | (a >> i & 1) << place
    return b


def permuted(a: int, b: int, chosen: int) -> int:
    """Return four bytes of eight."""
    both = (a | b << 32).to_bytes(8, "little")
    made = []
    for i in range(4):
        nibble = chosen >> 4 * i & 15
        byte = both[nibble & 7]
        made.append(byte if nibble < 8 else 255 * (byte >> 7))
    return int.from_bytes(bytes(made), "little")


def rounded(exact: Fraction, *, negative_zero: bool = False) -> int:
    """Return the bits of the double nearest to a number, ties to even."""
    if exact == 0:
        return bits_of(-0.0 if negative_zero else 0.0)
    try:
        near = exact.numerator / exact.denominator  # correctly rounded by Python
    except OverflowError:
        near = math.inf if exact > 0 else -math.inf
    return bits_of(math.copysign(near, 1 if exact > 0 else -1))


def floating(opcode: str, x: list[float], raw: list[int]) -> Result:
    """Return what an instruction on doubles does."""
    name = opcode.partition(".")[0]
    a, b = (*x, 0.0)[:2]
    if name == "setp":
        return int(compared(opcode.split(".")[1], a, b))
    if name == "testp":
        infinite, nan = math.isinf(a), math.isnan(a)
        what = opcode.split(".")[1]
        return int(
            {
                "finite": not (infinite or nan),
                "infinite": infinite,
                "number": not nan,
                "notanumber": nan,
            }[what]
        )
    if name == "copysign":
        return raw[1] & ~(1 << 63) | raw[0] & 1 << 63
    if name in {"abs", "neg"}:
        mask = 1 << 63
        return NAN if math.isnan(a) else raw[0] & ~mask if name == "abs" else raw[0] ^ mask
    if name in {"min", "max"}:
        numbers = [each for each in (a, b) if not math.isnan(each)]
        if not numbers:
            return NAN
        keys = [(each, math.copysign(1.0, each)) for each in numbers]
        return bits_of((min if name == "min" else max)(keys)[0])
    if name == "rcp":
        name, a, b = "div", 1.0, a
    return arithmetic(name, a, b)


def arithmetic(name: str, a: float, b: float) -> Result:
    """Return a sum, difference, product, quotient or root, rounded once."""
    if math.isnan(a) or (math.isnan(b) and name != "sqrt"):
        return NAN
    if name == "sqrt":
        if a < 0.0:
            return NAN
        return bits_of(a) if a in {0.0, math.inf} else root(Fraction(a))
    if name == "sub":
        name, b = "add", -b
    negative = (math.copysign(1.0, a) < 0.0) != (math.copysign(1.0, b) < 0.0)
    if name == "add":
        if math.isinf(a) or math.isinf(b):
            if math.isinf(a) and math.isinf(b) and a != b:
                return NAN
            return bits_of(a if math.isinf(a) else b)
        minus = math.copysign(1.0, a) < 0.0 and math.copysign(1.0, b) < 0.0
        return rounded(Fraction(a) + Fraction(b), negative_zero=minus)
    if name == "div":
        if (math.isinf(a) and math.isinf(b)) or (a == 0.0 and b == 0.0):
            return NAN
        if math.isinf(a) or b == 0.0:
            return bits_of(-math.inf if negative else math.inf)
        if math.isinf(b):
            return bits_of(-0.0 if negative else 0.0)
        return _signed(Fraction(a) / Fraction(b), negative)
    if math.isinf(a) or math.isinf(b):
        if 0.0 in {a, b}:
            return NAN
        return bits_of(-math.inf if negative else math.inf)
    return _signed(Fraction(a) * Fraction(b), negative)


def _signed(exact: Fraction, negative: bool) -> int:
    bits = rounded(abs(exact))
    return bits | 1 << 63 if negative else bits


def root(exact: Fraction) -> int:
    """Return the bits of the double nearest to a root."""
    shift = 2200  # more bits than any double needs
    scaled = math.isqrt((exact.numerator << 2 * shift) // exact.denominator)
    near = Fraction(scaled, 1 << shift)
    # A root is never midway between two doubles: what is cut off does not decide.
    return rounded(near + Fraction(1, 1 << (shift + 8)))


def compared(relation: str, a: float, b: float) -> bool:
    """Return whether a relation holds; those with a u hold of NaN too."""
    unordered = math.isnan(a) or math.isnan(b)
    if relation in {"num", "nan"}:
        return unordered == (relation == "nan")
    if relation in ORDER:
        return not unordered and ORDER[relation](a, b)
    return unordered or ORDER[relation[:-1]](a, b)


def converted(modifiers: list[str], raw: int, width: int) -> Result:
    """Return a conversion."""
    *how, target, source = modifiers
    if source != "f64":
        w = int(source[1:])
        value = signed(raw, w) if source[0] == "s" else raw % (1 << w)
        if target == "f64":
            return rounded(Fraction(value))
        v = int(target[1:])
        value %= 1 << v
        return (signed(value, v) if target[0] == "s" else value) % (1 << width)
    x = number_of(raw)
    if target == "f64":
        if math.isnan(x):
            return NAN
        if math.isinf(x):
            return raw
        return bits_of(math.copysign(whole(how[0], x), x))
    v = int(target[1:])
    low, high = (-(1 << (v - 1)), (1 << (v - 1)) - 1) if target[0] == "s" else (0, (1 << v) - 1)
    if math.isnan(x):
        value = signed(1 << (v - 1), v) if target[0] == "s" else 1 << (v - 1)
    elif math.isinf(x):
        value = high if x > 0.0 else low
    else:
        value = max(low, min(high, whole(how[0], x)))
    return value % (1 << width)


def whole(way: str, x: float) -> int:
    """Return a number rounded to an integer."""
    ways: dict[str, Callable[[Fraction], int]] = {
        "rni": round,
        "rzi": math.trunc,
        "rmi": math.floor,
        "rpi": math.ceil,
    }
    return int(ways[way](Fraction(x)))
