"""Check certificates of a rocking block, with this file alone.

Usage: python checker.py [--arithmetic iv] [--samples FILE] FILE...   Exit code 0 holds, 1 refused,
3 undecided.

Needs Python with python-flint (Arb), or with mpmath (iv, its intervals). Believes no number of
a certificate but the parameters of the claim: what else stands there is tested.

A block of two equal sides rocks under A sin(W t): y'' = y - 1 + A sin(phase + W t), seen from the
side of a flight. At y = 0 it changes sides, which adds pi to the phase, and keeps r of its speed.
Between impact phases p, q a flight lasts T = (q - p + n pi)/W, n odd; with b = A/(1 + W^2) it is
y = 1 - b sin(p + W t) - (1 - b sin p) sh(T - t)/sh T - (1 + b sin q) sh t/sh T.
A K below computes with intervals.
"""

import argparse
import json
import os
import re
import sys
from fractions import Fraction
from types import SimpleNamespace as K


def exact(t):
    """Return a number, or the text of one, as a fraction; a text of too many digits is none."""
    written = r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d{1,4})?|[-+]?\d+/[1-9]\d*"
    if isinstance(t, str) and not (len(t) < 9999 and re.fullmatch(written, t, re.ASCII)):
        raise ValueError(f"{t[:30]!r} is no decimal")
    return Fraction(t)


def arb(bits):
    """Return the arithmetic of python-flint."""
    from flint import arb, ctx, fmpq

    ctx.prec, k = bits, K(exp=arb.exp, sin_cos=arb.sin_cos, sqrt=arb.sqrt)
    k.pi, k.num = arb.pi(), lambda t: arb(fmpq(*exact(t).as_integer_ratio()))
    k.hull, k.mid = lambda a, b: arb(a).union(arb(b)), lambda x: arb(x.mid())
    k.ends = lambda x: (arb(x.lower()), arb(x.upper()))
    return k


def iv(bits):
    """Return the arithmetic of mpmath."""
    from mpmath.ctx_iv import MPIntervalContext

    iv = MPIntervalContext()
    iv.prec, f = bits, iv.mpf
    k = K(pi=+iv.pi, exp=iv.exp, sin_cos=lambda x: (iv.sin(x), iv.cos(x)), sqrt=iv.sqrt)
    k.num, k.mid = lambda t: f(exact(t).numerator) / exact(t).denominator, lambda x: f(x.mid.a)
    k.hull = lambda a, b: f([min(f(a).a, f(b).a), max(f(a).b, f(b).b)])
    k.ends = lambda x: (f(x.a), f(x.b))
    return k


def positive(*values):
    """Return whether all of each interval is."""
    return all(bool(getattr(x, "a", x) > 0) for x in values)


def need(ok, wrong=False, why=""):
    """Go on where a test holds; refuse the certificate where the opposite does."""
    if wrong:
        raise ValueError(why)
    if not ok:
        raise ArithmeticError("more bits are needed")


def above(K, W, b, phases, T, tail, depth):
    """Test that flights which leave the floor and land on it are above it in between."""
    p, q, sp, sq = phases
    z = (lambda v: K.hull(0, v)) if tail else (lambda v: v)
    near, far, span, half = 1 - b * sp, 1 + b * sq, 1 - K.exp(-2 * T), K.ends(T)[not tail] / 2
    if tail:  # the middle of long flights
        need(positive(1 - b - 2 * K.hull(near, far) * K.exp(-half) / span))
        span = K.hull(span, 1)
    for s, S, x, y in ((p, W, near, far), (q - K.pi, -W, far, near)):  # from both ends
        todo = [(K.hull(0, half), True, depth)]
        while todo:
            u, first, left = todo.pop()

            def state(u):
                o, e = (K.exp(-u), z(K.exp(u - 2 * T))), (K.exp(u - T), K.exp(-u - T))
                i, j = K.sin_cos(s + S * u)
                slope = (x * (o[0] + o[1]) - y * z(e[0] + e[1])) / span - b * S * j
                return 1 - b * i - (x * (o[0] - o[1]) + y * z(e[0] - e[1])) / span, slope

            (a, v), m, (lo, hi) = state(u), K.mid(u), K.ends(u)
            if not positive(a) and not positive(v if first else state(m)[0] + v * (u - m)):
                need(left, not tail and positive(-state(m)[0]), "it passes through the floor")
                todo += [(K.hull(m, hi), False, left - 1), (K.hull(lo, m), first, left - 1)]


def between(K, t):
    """Return all numbers between those of a list."""
    return K.hull(K.num(min(t, key=exact)), K.num(max(t, key=exact)))


def numbers(K, model):
    """Return A, W, r and b of a claim, each between its decimals."""
    A, W, r = (between(K, model[k]) for k in ("amplitude", "frequency_ratio", "restitution"))
    return A, W, r, A / (1 + W * W)


number = lambda t: type(t) is str and "/" not in t and exact(t) is not None
above_0, share = lambda t: number(t) and exact(t) > 0, lambda t: above_0(t) and exact(t) <= 1
whole = lambda n: type(n) is int and 0 <= n < 10**9
odd = lambda n: type(n) is int and n % 2 == 1 and abs(n) < 9999
MODEL = {"amplitude": [above_0], "frequency_ratio": [above_0], "restitution": [share]}
FIXED = {k: MODEL[k] for k in ("frequency_ratio", "restitution")}
KINDS = []


def kind(name, test, **form):
    """Let certificates of a kind be read in a form, and tested."""
    head = {"format": "rocking-certificate/1", "kind": name, "bits": whole}
    KINDS.append((head | form, test))


def fits(v, form):
    """Return whether a value has a form: a test, a constant, one of several, a list, or keys."""
    if isinstance(form, tuple):
        return any(fits(v, each) for each in form)
    if isinstance(form, dict):
        return type(v) is dict and v.keys() == form.keys() and all(fits(v[k], form[k]) for k in v)
    if isinstance(form, list):  # of any number, or of a number that is given
        counts = form[1:] or range(1, 10**6)
        return type(v) is list and len(v) in counts and all(fits(x, form[0]) for x in v)
    return form(v) if callable(form) else type(v) is type(form) and v == form


def once(pairs):
    """Return an object of JSON, of which no key is repeated."""
    need(True, len(dict(pairs)) < len(pairs), "a key is repeated")
    return dict(pairs)


def read(text):
    """Return a certificate and its test; it has the keys of its kind, no other, in their forms."""
    c = json.loads(text, object_pairs_hook=once)
    for form, test in KINDS:
        if type(c) is dict and c.keys() == form.keys() and c["kind"] == form["kind"]:
            for k in form:
                need(True, not fits(c[k], form[k]), f"{k} is not in its form: {c[k]!r:.40}")
            return c, test
    raise ValueError("it has no kind that is checked here, or not the keys of its kind")


def check(text, arithmetic, samples=()):
    """Return "holds", or why a certificate is refused or undecided."""
    try:
        c, test = read(text)
        need(True, samples and "sha256" not in c, "it takes no samples")
        test(arithmetic(min(8192, 64 + c["bits"])), c | {"accelerations": samples})
        return "holds"
    except ArithmeticError as unknown:
        return f"undecided: {unknown}"
    except (ValueError, LookupError, TypeError, RuntimeError, AssertionError) as wrong:
        return f"refused: {wrong}"


if __name__ == "__main__":
    flags, codes = argparse.ArgumentParser(), []
    flags.add_argument("--arithmetic", choices=("arb", "iv"), default="arb")
    flags.add_argument("--samples")
    flags.add_argument("files", nargs="+")
    given = flags.parse_args()
    try:
        samples = [float(x) for x in open(given.samples).read().split()] if given.samples else ()
        for name in (name for name in given.files if not os.path.isfile(name)):
            flags.error(f"{name} is no file")
        texts = {name: open(name, "rb").read(10**8) for name in given.files}
    except (OSError, ValueError) as wrong:
        flags.error(str(wrong))
    for name, text in texts.items():
        verdict = check(text, {"arb": arb, "iv": iv}[given.arithmetic], samples)
        claim, test = read(text) if verdict == "holds" else ({}, check)
        claim |= getattr(test, "shares", dict)(claim)
        print(name, verdict, *(f"{k} {v}" for k, v in claim.items() if len(str(v)) < 300))
        codes.append({"h": 0, "r": 1, "u": 3}[verdict[0]])
    sys.exit(1 if 1 in codes else max(codes))
