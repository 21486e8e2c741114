"""Check certificates of the fate of a rocking block.

A record's samples are its accelerations in m/s^2, one number a line; a certificate has the SHA-256
of their doubles. A pulse is known by its name and its pieces: duration in quarters of the period,
c, d times the duration, A, W over the frequency and the phase in quarters of a turn, c, d and A
over the amplitude.

A block at rest on a moving base lifts where the acceleration a, over alpha g, leaves [-1, 1]. Seen
from its side s, y'' = y - 1 + s a with y >= 0; at y = 0 it changes sides and keeps r of its speed.
Where a is c + d t + A sin(p + W t), y + y' and y - y' less those of the forced part grow and decay
as e^t and e^-t.
A flight is (time in the span, side, y + y', y - y', whether y is 0, whether it begins at rest).
"""

import hashlib
import struct
from itertools import pairwise

from rocksteady.certify.proofs.base_checker import (
    FIXED,
    MODEL,
    above_0,
    arb,
    between,
    check,
    iv,
    kind,
    need,
    positive,
    share,
    whole,
)

PULSES = {
    "rectangle": ("2 1 0 0 0 0", "2 -1 0 0 0 0"),
    "half-sine": ("2 0 0 1 1 0", "2 0 0 1 1 2"),
    "versed-sine": ("2 1/2 0 1/2 2 -1", "2 -1/2 0 1/2 2 1"),
    "triangle": ("1 0 1 0 0 0, 1 1 -1 0 0 0", "1 0 -1 0 0 0, 1 -1 1 0 0 0"),
    "decaying-ramp": ("2 1 -1 0 0 0", "2 -1 1 0 0 0"),
    "one-sine": ("4 0 0 1 1 0", "4 0 0 1 1 2"),
    "one-cosine": ("4 0 0 1 1 1", "4 0 0 1 1 -1"),
}
"""The pieces of each pulse, and of the reversed one."""


def pieces(name, reverse):
    """Return the pieces of a pulse."""
    return [piece.split() for piece in PULSES[name][reverse].split(", ")]


def base(K, span, t):
    """Return the acceleration of a span and its derivative."""
    _, c, d, A, W, p = span
    if A is None:
        return c + d * t, d
    sine, cosine = K.sin_cos(p + W * t)
    return c + d * t + A * sine, d + A * W * cosine


def forced(K, span, t, side):
    """Return y + y' and y - y' of the forced part of a flight."""
    _, c, d, A, W, p = span
    y, v = 1 - side * (c + d * t), -side * d
    if A is not None:
        b, (sine, cosine) = side * A / (1 + W * W), K.sin_cos(p + W * t)
        y, v = y - b * sine, v - b * W * cosine
    return y + v, y - v


def state(K, span, f, u, growth=None):
    """Return y + y' and y - y' after a time u of a flight."""
    e, p, q = growth or K.exp(u), forced(K, span, f[0], f[1]), forced(K, span, f[0] + u, f[1])
    return e * (f[2] - p[0]) + q[0], (f[3] - p[1]) / e + q[1]


def first_zero(K, curve, ends, rises=None):
    """Return where curves that begin above 0, or rise from it, first fall through 0, if they do."""
    todo = [(K.hull(*ends), rises is not None, 100)]
    while todo:
        u, start, left = todo.pop()
        (y, v), (low, high), m = curve(u), K.ends(u), K.mid(u)
        if positive(y) or (start and rises(u)):
            continue
        last = None if start or not positive(-v) else curve(high)[0]
        if last is not None and positive(-last):  # all of them fall through 0 once in u
            return narrowed(K, curve, u)
        if start or not (
            positive(curve(m)[0] + v * (u - m)) or (last is not None and positive(last))
        ):
            need(left)
            todo += [(K.hull(m, high), False, left - 1), (K.hull(low, m), start, left - 1)]
    return None


def narrowed(K, curve, u):
    """Return the zeros of falling curves by Newton's method in intervals."""
    for _ in range(30):
        m, (low, high) = K.mid(u), K.ends(u)
        a, b = K.ends(m - curve(m)[0] / curve(u)[1])
        u = K.hull(max(a, low), min(b, high))
        if not positive((high - low) * 7 - (min(b, high) - max(a, low)) * 10):
            break
    return u


def uplift(K, spans, i, t):
    """Return the next span in which a block at rest lifts, and its flight there."""
    for k, span in enumerate(spans[i:], i):
        (D, c, d, A, _, _), lifts = span, []
        calm = positive(1 - abs(c), 1 - abs(c + d * D)) if A is None else None
        for s in () if calm else (1, -1):
            curve = lambda u, s=s: [
                x - s * y for x, y in zip((1, 0), base(K, span, u), strict=True)
            ]
            above = -curve(t)[0]
            if positive(above):
                need(not positive(K.ends(t)[1]))
                lifts.append((t, s))
            elif A is not None:
                zero = first_zero(K, curve, (K.ends(t)[0], K.ends(D)[1]))
                lifts += [] if zero is None else [(zero, s)]
            elif not positive(curve(D)[0]):
                need(positive(-curve(D)[0], -above))
                lifts.append(((s - c) / d, s))
        lifts.sort(key=lambda each: K.mid(each[0]))
        need(len(lifts) < 2 or positive(lifts[1][0] - lifts[0][0]))
        if lifts:
            return k, (*lifts[0], K.num(0), K.num(0), True, True)
        t = K.num(0)
    return len(spans), None


def landing(K, span, f):
    """Return the time that a flight takes to land in a span, if it does."""
    t, s, P, M, grounded, lifting = f
    left = span[0] - t
    if span[3] is None:  # y stays above a parabola, or the push away from the floor grows
        pull = max(K.num(0), *(K.ends(1 - s * base(K, span, x)[0])[1] for x in (t, span[0])))
        low = (0 if grounded else P + M) / 2 + ((P - M) / 2 - pull * left / 2) * left
        if positive(low, low if grounded else P + M) or (lifting and positive(s * span[2])):
            return None

    def curve(u):
        p, m = state(K, span, f, u)
        return (p + m) / 2, (p - m) / 2

    def rises(u):
        a, b = base(K, span, t + u)
        return positive(s * a - 1) or positive(s * b) if lifting else positive(curve(u)[1])

    u = first_zero(K, curve, (0, K.ends(left)[1]), rises if grounded else None)
    need(u is None or positive(left - u) or positive(u - left))
    return u if u is not None and positive(left - u) else None


def rests(K, spans, i, t, w, r):
    """Return whether all bounces from an impact on die out before an uplift (rest theorem)."""
    now = abs(base(K, spans[i], t)[0])
    if not positive(1 - now, 1 - r, K.num("0.1") - w):
        return False
    window = left = K.ends(4 * w / ((1 - now) * (1 - r)))[1]
    highest = steepest = zero = K.num(0)
    for span in spans[i:]:
        inside = positive(span[0] - t - left)
        part = K.hull(K.ends(t)[0], K.ends(t + left if inside else span[0])[1])
        a, b = (K.ends(abs(x))[1] for x in base(K, span, part))
        highest, steepest = max(highest, a), max(steepest, b)
        pull = K.ends(1 - highest)[0]
        if not positive(pull - w):
            return False
        if inside:
            break
        t, left = zero, K.ends(left - span[0] + t)[1]
    least = K.sqrt(pull * pull - w * w)
    kept = r * K.sqrt(1 + 4 * steepest * w / (pull * least))
    return positive(1 - kept) and positive(window - 2 * w / (least * (1 - kept)))


def fate(K, spans, r):
    """Return whether a block at rest falls or stands, and after how many impacts it is known."""
    zero, impacts = K.num(0), 0
    ahead, growth = [zero], K.exp(spans[0][0])
    for span in reversed(spans):
        still, wave = (*span[:3], None, None, None), abs(zero if span[3] is None else span[3])
        ends = [K.ends(abs(base(K, still, x)[0]) + wave)[1] for x in (zero, span[0])]
        ahead.append(max(ahead[-1], *ends))
    i, f = uplift(K, spans, 0, zero)
    while f:
        if i == len(spans):  # the base stands still: y + y' - 1 grows, or energy is kept
            P, M = f[2:4]
            rise, over = P - 1, r * r * (P + M - P * M) - 1
            need(positive(rise) or (positive(-rise) and (positive(over) or positive(-over))))
            return "falls" if positive(rise) or positive(over) else "stands", impacts
        t, s, (D, *_) = f[0], f[1], spans[i]
        u = landing(K, spans[i], f)
        if u is None:
            same = D is spans[0][0] and not positive(K.ends(t)[1])
            P, M = state(K, spans[i], f, D - t, growth if same else None)
            i, f = i + 1, (zero, s, P, M, False, False)
            if positive(P - M, (P + M) / 2 - 1 - ahead[len(spans) - i]):
                return "falls", impacts
        else:
            P, M = state(K, spans[i], f, u)
            w, impacts = r * (M - P) / 2, impacts + 1
            need(positive(w))
            settled = rests(K, spans, i, t + u, w, r)
            i, f = uplift(K, spans, i, t + u) if settled else (i, (t + u, -s, w, -w, True, False))
    return "stands", impacts


def run(K, c, samples, model):
    """Return the fate of a certificate's block under its motion, for the numbers of a model."""
    n = {k: between(K, t) for k, t in model.items()}
    if "sha256" in c:
        a, D = [K.num(x) / (n["alpha"] * n["gravity"]) for x in samples], n["p"] * n["dt_s"]
        lines = pairwise(a)
        return fate(K, [(D, p, (q - p) / D, None, None, None) for p, q in lines], n["restitution"])
    A, W, spans = n["amplitude"], n["frequency_ratio"], []
    for turn, c0, c1, size, turns, phase in ([K.num(x) for x in piece] for piece in c["pieces"]):
        D = K.pi * turn / (2 * W)
        wave = (A * size, W * turns, K.pi * phase / 2) if abs(size) > 0 else (None, None, None)
        spans.append((D, A * c0, A * c1 / D, *wave))
    return fate(K, spans, n["restitution"])


def claimed(K, c):
    """Check the fate, or both fates of amplitudes between which it changes."""
    given = c["accelerations"]
    if "sha256" in c:
        digest = hashlib.sha256(struct.pack(f"<{len(given)}d", *given)).hexdigest()
        same = (c["samples"], c["sha256"]) == (len(given), digest)
        need(True, not same, "it is one of other samples")
    else:
        choices = [pieces(c["pulse"], reverse) for reverse in (False, True)]
        need(True, c["pieces"] not in choices, "its pieces are not those of the pulse")
    models = [c["model"] | {"amplitude": [A]} for A in c.get("between", ())] or [c["model"]]
    fates = [run(K, c, given, model)[0] for model in models]
    need(True, fates != c["claim"]["outcomes"], f"it {' and '.join(fates)}")
    need(True, fates[1:] == fates[:1], "the fate does not change")


FATE, LIST, TEXT = ("falls", "stands"), lambda v: type(v) is list, lambda v: type(v) is str
PULSE, RECORD = {"pulse": tuple(PULSES), "pieces": LIST}, {"samples": whole, "sha256": TEXT}
SI = {k: [above_0] for k in ("alpha", "p", "gravity", "dt_s")} | {"restitution": [share]}
kind("fate", claimed, model=MODEL, claim={"outcomes": [FATE, 1]}, **PULSE)
kind("fate", claimed, model=SI, claim={"outcomes": [FATE, 1]}, **RECORD)
kind("fate", claimed, model=FIXED, claim={"outcomes": [FATE, 2]}, between=[above_0, 2], **PULSE)
