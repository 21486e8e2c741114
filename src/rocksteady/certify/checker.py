"""Check certificates of rocking orbits and chaos, with this file alone.

Usage: python checker.py [--arithmetic iv] FILE...   Exit code 0 holds, 1 refused, 3 undecided.

Needs Python with python-flint (Arb), or with mpmath (iv, its intervals). Believes no number of
a certificate but the parameters of the claim: what else stands there is tested.

A block of two equal sides rocks under A sin(W t): y'' = y - 1 + A sin(phase + W t), seen from the
side of a flight. At y = 0 it changes sides, which adds pi to the phase, and keeps r of its speed.
Between impact phases p, q a flight lasts T = (q - p + n pi)/W, n odd; with b = A/(1 + W^2) it is
y = 1 - b sin(p + W t) - (1 - b sin p) sh(T - t)/sh T - (1 + b sin q) sh t/sh T.
It leaves with w = (1 - b sin p)/th T - (1 + b sin q)/sh T - b W cos p and lands with
V = (1 + b sin q)/th T - (1 - b sin p)/sh T - b W cos q; an impact fits its flights where
e = (r V - w)/b is 0. An M below holds A, W, r, b; a K computes with intervals.
"""

import json
import sys
from fractions import Fraction
from itertools import combinations, product
from types import SimpleNamespace as K


def exact(t):
    """Return a number or its text as a fraction; a text of too many digits is no number."""
    short = not isinstance(t, str) or (len(t) < 9999 and len(t.lower().partition("e")[2]) < 6)
    return Fraction(t if short else "of too many digits")


def arb(bits):
    """Return the arithmetic of python-flint."""
    from flint import arb, ctx, fmpq

    ctx.prec = bits
    num = lambda t: arb(fmpq(*exact(t).as_integer_ratio()))
    hull = lambda a, b: arb(a).union(arb(b))
    ends, mid = lambda x: (arb(x.lower()), arb(x.upper())), lambda x: arb(x.mid())
    k = K(pi=arb.pi(), num=num, hull=hull, ends=ends, mid=mid, sqrt=arb.sqrt)
    k.exp, k.sin_cos = arb.exp, arb.sin_cos
    return k


def iv(bits):
    """Return the arithmetic of mpmath."""
    from mpmath import iv

    iv.prec, f = bits, iv.mpf
    num, mid = lambda t: f(exact(t).numerator) / exact(t).denominator, lambda x: f(x.mid.a)
    hull = lambda a, b: f([min(f(a).a, f(b).a), max(f(a).b, f(b).b)])
    k = K(pi=+iv.pi, num=num, hull=hull, ends=lambda x: (f(x.a), f(x.b)), mid=mid, sqrt=iv.sqrt)
    k.exp, k.sin_cos = iv.exp, lambda x: (iv.sin(x), iv.cos(x))
    return k


def positive(*values):
    """Return whether all of each interval is."""
    return all(bool(getattr(x, "a", x) > 0) for x in values)


def inside(K, a, x):
    """Return whether an interval lies inside another one, off its ends."""
    return positive(K.ends(a)[0] - K.ends(x)[0], K.ends(x)[1] - K.ends(a)[1])


def need(ok, wrong=False, why=""):
    """Go on where a test holds; refuse the certificate where the opposite does."""
    if wrong:
        raise ValueError(why)
    if not ok:
        raise ArithmeticError("more bits are needed")


def factors(K, T, tail=False):
    """Return 1/th T, 1/sh T and th T/2, with tail for all durations from T on."""
    d = K.exp(-T)
    c, q, h = (1 + d * d) / (1 - d * d), 2 * d / (1 - d * d), (1 - d) / (1 + d)
    return (K.hull(1, c), K.hull(0, q), K.hull(h, 1)) if tail else (c, q, h)


def impact(K, M, p, q, s, n, m, tails=(False, False)):
    """Return e, its derivatives by the phases before, at, after an impact, and by A."""
    A, W, r, b = M
    f = factors(K, (q - p + n * K.pi) / W, tails[0])
    g = factors(K, (s - q + m * K.pi) / W, tails[1])
    (sp, cp), (sq, cq), (ss, cs) = K.sin_cos(p), K.sin_cos(q), K.sin_cos(s)
    i, j = (1 - b * sp) * f[0] - (1 + b * sq) * f[1], (1 + b * ss) * g[0] - (1 - b * sq) * g[1]
    coths, k, rest = r * f[0] + g[0], 1 / (b * W), (g[2] - r * f[2]) / b
    e = sq * coths + r * sp * f[1] + ss * g[1] + (1 - r) * W * cq - rest
    at = cq * coths - (1 - r) * W * sq + (r * i * f[1] + j * g[1]) * k
    return e, r * (cp - i * k) * f[1], at, (cs - j * k) * g[1], rest / A


def flight(K, M, p, q, n, tail=False, depth=60):
    """Test that flights leave the floor, stay above it and land; with tail all longer ones too."""
    W, b = M[1], M[3]
    T = (q - p + n * K.pi) / W
    need(positive(T), type(n) is not int or n % 2 == 0, "half periods are odd")
    (sp, cp), (sq, cq), (c, d, _) = K.sin_cos(p), K.sin_cos(q), factors(K, T, tail)
    w = (1 - b * sp) * c - (1 + b * sq) * d - b * W * cp
    V = (1 + b * sq) * c - (1 - b * sp) * d - b * W * cq
    need(positive(w, V), positive(-w) or positive(-V), "a flight begins or ends the wrong way")
    above(K, W, b, (p, q, sp, sq), T, tail, depth)


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


def chain(K, M, x, n, w=1):
    """Return e, its Jacobian, which closes with a factor w, its derivatives by A, and the trace."""
    m, P = len(x), [[1, 0], [0, 1]]
    J = [[K.num(0)] * m for _ in x]
    rows = [impact(K, M, x[k - 1], x[k], x[(k + 1) % m], n[k - 1], n[k]) for k in range(m)]
    for k, (_, a, c, d, _) in enumerate(rows):
        for j, v in ((k - 1, a if k else w * a), (k, c), ((k + 1) % m, d if k + 1 < m else w * d)):
            J[k][j] = J[k][j] + v
        P = [[-(c * P[0][j] + a * P[1][j]) / d for j in (0, 1)], P[0]]
    return [r[0] for r in rows], J, [r[4] for r in rows], P[0][0] + P[1][1]


def inverse(K, J):
    """Return an approximate inverse, on which no proof relies."""
    n = len(J)
    a = [[float(K.mid(v)) for v in J[i]] + [float(i == j) for j in range(n)] for i in range(n)]
    for i in range(n):
        a[i:] = sorted(a[i:], key=lambda row: -abs(row[i]))
        a[i] = [v / a[i][i] for v in a[i]]
        for r in set(range(n)) - {i}:
            a[r] = [v - a[r][i] * o for v, o in zip(a[r], a[i])]
    return [[K.num(v) for v in r[n:]] for r in a]


def krawczyk(K, f, X):
    """Test that f has exactly one zero in a box, and return a smaller one around it."""
    x, (_, Q), N = [K.mid(v) for v in X], f(X), range(len(X))
    r, J = f(x)
    Y = inverse(K, J)
    M = [[(i == j) - sum(Y[i][h] * Q[h][j] for h in N) for j in N] for i in N]
    result = [x[i] + sum(M[i][j] * (X[j] - x[j]) - Y[i][j] * r[j] for j in N) for i in N]
    for a, b in zip(result, X):
        need(inside(K, a, b), positive(a - b) or positive(b - a), "there is no zero in the box")
    return result


def numbers(K, model):
    """Return A, W, r and b of a claim, each between its decimals."""
    given = (model[name] for name in ("amplitude", "frequency_ratio", "restitution"))
    A, W, r = (K.hull(K.num(min(t, key=exact)), K.num(max(t, key=exact))) for t in given)
    need(True, not positive(A, W, r) or positive(r - 1), "the parameters are invalid")
    return A, W, r, A / (1 + W * W)


def boxes(K, centres, radii):
    """Return the boxes of a certificate."""
    return [K.num(t) + K.hull(-1, 1) * K.num(r) for t, r in zip(centres, radii, strict=True)]


def orbit(K, c):
    """Check existence, uniqueness, first impacts and stability of a periodic orbit."""
    M, X, n = numbers(K, c["model"]), boxes(K, c["phases"], c["radii"]), c["half_periods"]
    X = krawczyk(K, lambda x: chain(K, M, x, n)[:2], X)
    for k in range(len(n)):
        flight(K, M, X[k - 1], X[k], n[k - 1])
    t, d = chain(K, M, X, n)[3], 1 + M[2] ** (2 * len(n))
    inner, outer = positive(d - t, d + t), positive(t * t - d * d)
    result = "unstable" if outer else inner and ("stable" if positive(1 - M[2]) else "neutral")
    need(result, result and result != c["claim"]["stability"], f"it is {result}")


def sure(K, test, parts, depth=12):
    """Test boxes, each bisected where it is undecided."""
    try:
        need(test(*parts))
    except ArithmeticError:
        need(depth)
        ends = [K.ends(x) for x in parts]
        w = max(range(len(parts)), key=lambda k: float(K.mid(ends[k][1] - ends[k][0])))
        for half in (K.hull(ends[w][0], K.mid(parts[w])), K.hull(K.mid(parts[w]), ends[w][1])):
            sure(K, test, [*parts[:w], half, *parts[w + 1 :]], depth - 1)


def hilltops(K, c):
    """Check that each sequence of boxes of phases and of flights n, n + 2, ... is one motion."""
    M, n, S = numbers(K, c["model"]), c["least_half_periods"], len(c["phases"])
    B = boxes(K, c["phases"], [c["radius"]] * S)
    apart = lambda x, y: positive(x - y, 2 * K.pi - x + y) or positive(y - x, 2 * K.pi - y + x)
    need(all(apart(*pair) for pair in combinations(B, 2)))
    links = [(i, j, *k) for i in range(S) for j in range(S) for k in ((n, False), (n + 2, True))]
    for (a, i, k, t), (_, j, m, u) in (p for p in product(links, links) if p[0][1] == p[1][0]):
        e = lambda *x: impact(K, M, *x, k, m, (t, u))
        s = -1 if positive(e(K.mid(B[a]), K.ends(B[i])[0], K.mid(B[j]))[0]) else 1
        for y, way in zip(K.ends(B[i]), (-s, s)):
            sure(K, lambda x, z: positive(way * e(x, y, z)[0]), [B[a], B[j]], 9)
        ruled = lambda o: positive(abs(o[2]) - abs(o[1]) - abs(o[3]))
        sure(K, lambda *x: ruled(e(*x)), [B[a], B[i], B[j]])
    for i, j, k, t in links:
        sure(K, lambda x, y: flight(K, M, x, y, k, t, 14) or True, [B[i], B[j]])
    entropy(K, c, lambda z: S * z**n - 1 + z * z)


def entropy(K, c, excess):
    """Check that words of the lengths of a claim grow in number as its entropy does, or faster."""
    over = excess(K.exp(-K.num(c["claim"]["entropy_per_period"]) / 2))
    need(positive(over), positive(-over), "the entropy proved is smaller")


def homoclinic(K, c):
    """Check that each set of states (two last phases) covers the next one, and the first itself."""
    M, sets = numbers(K, c["model"]), [[K.num(t) for t in f] for f in c["frames"]]
    parts, N = [K.hull(k, k + 2) / 6 for k in range(-6, 6, 2)], len(c["frames"])
    at = lambda f, u, s: (f[0] + f[2] * u + f[4] * s, f[1] + f[3] * u + f[5] * s)
    det = lambda a, b, c, d: a * d - b * c
    within = lambda f, *x: [det(*x, *f[4:]) / det(*f[2:]), det(*f[2:4], *x) / det(*f[2:])]

    def image(f, g, u, s):
        (x, y), (a, b), z = at(f, u, s), at(f, K.mid(u), K.mid(s)), K.mid(g[1])
        e, r = impact(K, M, a, b, z, 1, 1)[0], impact(K, M, x, y, z, 1, 1)
        Z = z + 2 * K.hull(-1, 1) * (e - r[1] * (x - a) - r[2] * (y - b)) / r[3]
        r = impact(K, M, x, y, Z, 1, 1)
        new = z - (e + r[1] * (x - a) + r[2] * (y - b)) / r[3]
        need(inside(K, new, Z))
        o, d = within(g, b - g[0], z - e / r[3] - g[1]), (u - K.mid(u), s - K.mid(s))
        p, q = (within(g, f[k + 1], -(r[1] * f[k] + r[2] * f[k + 1]) / r[3]) for k in (2, 4))
        return [o[k] + p[k] * d[0] + q[k] * d[1] for k in (0, 1)]

    for k, f in enumerate(sets):
        flight(K, M, *at(f, K.hull(-1, 1), K.hull(-1, 1)), 1)
        for g in (sets[(k + 1) % N], *sets[: k == 0]):
            ends = [(u, image(f, g, K.hull(u, u), s)[0]) for u in (-1, 1) for s in parts]
            need(any(all(positive(way * u * v - 1) for u, v in ends) for way in (1, -1)))
            whole = [image(f, g, u, s) for u, s in product(parts, parts)]
            need(all(positive(1 - abs(w)) or positive(abs(v) - 1) for v, w in whole))
    bounds = [at(f, K.hull(-1, 1), K.hull(-1, 1)) for f in sets]
    apart = lambda p, q: any(positive(x - y) or positive(y - x) for x, y in zip(p, q))
    need(any(all(k == j or apart(bounds[k], bounds[j]) for j in range(N)) for k in range(1, N)))
    entropy(K, c, lambda z: z + z**N - 1)


def chaos(K, c):
    """Check either kind of chaos."""
    (homoclinic if "frames" in c else hilltops)(K, c)


KINDS = {"orbit": orbit, "chaos": chaos}


def check(text, arithmetic):
    """Return "holds", or why a certificate is refused or undecided."""
    try:
        c = json.loads(text)
        test = {"rocking-certificate/1": KINDS}[c["format"]][c["kind"]]
        test(arithmetic(min(4096, 64 + c["bits"])), c)
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
