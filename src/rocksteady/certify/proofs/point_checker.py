"""Check certificates of bifurcation points."""

from types import SimpleNamespace as K

from rocksteady.certify.proofs.base_checker import FIXED, above_0, kind, need, numbers, positive
from rocksteady.certify.proofs.checker import (
    CHAIN,
    boxes,
    chain,
    flight,
    impact,
    krawczyk,
    least,
    solved,
)


def terms(x):
    """Return the terms of a series, or of a number."""
    return x.c if isinstance(x, Series) else (x, 0, 0, 0)


class Series:
    """A power series of intervals, up to the third."""

    def __init__(self, *c):
        self.c = (*c, 0, 0, 0)[:4]

    def __add__(self, o):
        return Series(*(x + y for x, y in zip(self.c, terms(o))))

    def __mul__(self, o):
        d = terms(o)
        return Series(*(sum(self.c[i] * d[k - i] for i in range(k + 1)) for k in range(4)))

    def __truediv__(self, o):
        c, d = [], terms(o)
        for k in range(4):
            c.append((self.c[k] - sum(c[i] * d[k - i] for i in range(k))) / d[0])
        return Series(*c)

    __radd__, __rmul__, __neg__ = __add__, __mul__, lambda self: self * -1
    __sub__, __rsub__ = lambda self, o: self + -o, lambda self, o: -self + o
    __rtruediv__ = lambda self, o: Series(o) / self


def series(L):
    """Return an arithmetic of power series, by Taylor's formula."""

    def taylor(x, a, b, c, d):
        s = Series(0, *x.c[1:])
        return ((s * (d / L.num(6)) + c / L.num(2)) * s + b) * s + a

    def sin_cos(x):
        s, c = L.sin_cos(x.c[0])
        return taylor(x, s, c, -s, -c), taylor(x, c, -s, -c, s)

    return K(pi=Series(L.pi), exp=lambda x: taylor(x, *[L.exp(x.c[0])] * 4), sin_cos=sin_cos)


def opening(L, M, x, n, s):
    """Return a of the branch A + a s^2 that turns (s = 1) or begins (-1) at a point.

    The phases on it are x + t v + t^2 u + ..., with v[0] = 1; where s is -1, t becomes -t when the
    chain has closed. At 1 the second order of e gives a; at -1 it gives u for each a, and the third
    order a.
    """
    m, S, zero, size = len(x), series(L), L.num(0), lambda v: abs(float(L.mid(v)))
    solve = lambda rows, right: [y for (y,) in solved(rows, [[v] for v in right], size)]
    whole, by_A = chain(L, M, x, n)[1:3]
    turned = chain(L, M, x, n, s)[1]
    edge = lambda column: [[*row[1:], y] for row, y in zip(turned, column)]
    v = solve(edge(by_A if s == 1 else [L.num(1), *[zero] * (m - 1)]), [-r[0] for r in turned])
    v = [L.num(1), *v[:-1]]

    def term(k, u, a):
        p = [Series(*c) for c in zip(x, v, u)]
        turn = lambda q: Series(*(c * s**i for i, c in enumerate(q.c)))
        p, A, W = [turn(p[-1]), *p, turn(p[0])], Series(M[0], 0, a), Series(M[1])
        N = (A, W, Series(M[2]), A / (1 + W * W))
        return [impact(S, N, *p[j : j + 3], n[j - 1], n[j])[0].c[k] for j in range(m)]

    bent = term(2, [zero] * m, zero)
    if s == 1:
        return -solve(edge(by_A), bent)[-1]
    u, z = ([-y for y in solve(whole, column)] for column in (bent, by_A))
    still, moved = term(3, u, zero), term(3, [i + j for i, j in zip(u, z)], L.num(1))
    return -solve(edge([i - j for i, j in zip(moved, still)]), still)[-1]


def point(L, c):
    """Check that the trace passes its value at a point, and what turns or begins there.

    One phase moves over its box, and the others and A follow. The branch opens to larger A where a
    is above 0. What begins at -1 is stable (supercritical) where a times the derivative of the
    trace by A, along the orbit from which it begins, is below 0: there that orbit is unstable.
    """
    n, s, signs, ends = c["half_periods"], c["claim"]["sign"], [], []
    _, W, r, _ = numbers(L, {**c["model"], "amplitude": ["1"]})
    X, m = boxes(L, [*c["phases"], c["amplitude"]], c["radii"]), len(n)
    need(True, m != len(X) - 1, "it has not one flight for each phase")
    for value in (X[0], *L.ends(X[0])):

        def system(x, value=value):
            *x, A = [value, *x]
            e, J, by_A, t = chain(L, (A, W, r, A / (1 + W * W)), x, n)
            return e, [[*row[1:], a] for row, a in zip(J, by_A)], t

        x = krawczyk(L, lambda x, f=system: f(x)[:2], X[1:])
        x = krawczyk(L, lambda x, f=system: f(x)[:2], x) if value is not X[0] else x
        signs.append(positive(g := system(x)[2] - s * (1 + r ** (2 * m))) - positive(-g))
        ends.append(x[-1])
    M = (X[m], W, r, X[m] / (1 + W * W))
    least(L, X[:m], n, W)
    for k in range(m):
        flight(L, M, X[(k or m) - 1], X[k], n[k - 1])
    need((way := signs[1] * signs[2]) == -1, way == 1, "the trace passes nothing")
    a, rise = opening(L, M, X[:m], n, s), ends[2] - ends[1]
    opens = positive(a) - positive(-a)
    passing = signs[2] * (positive(rise) - positive(-rise))
    need(opens, opens and opens != c["claim"]["opens"], "it opens to the other side")
    if s == -1:
        need(passing)
        result = "supercritical" if opens * passing < 0 else "subcritical"
        need(True, result != c["claim"]["criticality"], f"it is {result}")


AT_1, AT_MINUS_1 = {"sign": 1, "opens": (1, -1)}, {"sign": -1, "opens": (1, -1)}
AT_MINUS_1["criticality"] = "supercritical", "subcritical"
kind("point", point, model=FIXED, amplitude=above_0, claim=(AT_1, AT_MINUS_1), **CHAIN)
