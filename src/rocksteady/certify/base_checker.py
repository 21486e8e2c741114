"""Check certificates of a rocking block, with this file alone.

Usage: python checker.py [--arithmetic iv] FILE...   Exit code 0 holds, 1 refused, 3 undecided.

Needs Python with python-flint (Arb), or with mpmath (iv, its intervals). Believes no number of
a certificate but the parameters of the claim: what else stands there is tested.

A block of two equal sides rocks under A sin(W t): y'' = y - 1 + A sin(phase + W t), seen from the
side of a flight. At y = 0 it changes sides, which adds pi to the phase, and keeps r of its speed.
Between impact phases p, q a flight lasts T = (q - p + n pi)/W, n odd; with b = A/(1 + W^2) it is
y = 1 - b sin(p + W t) - (1 - b sin p) sh(T - t)/sh T - (1 + b sin q) sh t/sh T.
A K below computes with intervals.
"""

import json
import sys
from fractions import Fraction
from types import SimpleNamespace as K


def exact(t):
    """Return a number or its text as a fraction; a text of too many digits is no number."""
    short = not isinstance(t, str) or (len(t) < 9999 and len(t.lower().partition("e")[2]) < 6)
    return Fraction(t if short else "of too many digits")


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
    from mpmath import iv

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


def numbers(K, model):
    """Return A, W, r and b of a claim, each between its decimals."""
    given = (model[name] for name in ("amplitude", "frequency_ratio", "restitution"))
    A, W, r = (K.hull(K.num(min(t, key=exact)), K.num(max(t, key=exact))) for t in given)
    need(True, not positive(A, W, r) or positive(r - 1), "the parameters are invalid")
    return A, W, r, A / (1 + W * W)


KINDS = {}


def check(text, arithmetic):
    """Return "holds", or why a certificate is refused or undecided."""
    try:
        c = json.loads(text)
        test = {"rocking-certificate/1": KINDS}[c["format"]][c["kind"]]
        test(arithmetic(min(4096, 64 + abs(c["bits"]))), c)
        return "holds"
    except ArithmeticError as unknown:
        return f"undecided: {unknown}"
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as wrong:
        return f"refused: {wrong}"


if __name__ == "__main__":
    names, codes = [name for name in sys.argv[1:] if name not in ("--arithmetic", "iv")], {0}
    for name in names:
        print(name, verdict := check(open(name).read(), iv if "iv" in sys.argv else arb))
        codes.add({"h": 0, "r": 1, "u": 3}[verdict[0]])
    sys.exit(1 if 1 in codes else max(codes))
