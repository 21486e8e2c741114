"""Check also certificates of bifurcation points: that the multiplier passes 1 or -1, and how.

One phase moves over its box, the others and A follow, and the trace passes its value. Near the
point the phases on the branch that turns (1) or begins (-1, where s becomes -s when the chain has
closed) are x + s v + s^2 u + ..., with v[0] = 1 and A + a s^2: it opens to larger A where a > 0.
At 1 the second order of e gives a; at -1 it gives u for each a, and the third order a. What begins
at -1 is stable (supercritical) where a times the derivative of the trace by A, along the orbit
from which it begins, is below 0: there that orbit is unstable.
"""

from types import SimpleNamespace as K

from rocksteady.certify.checker import KINDS, boxes, chain, flight, impact, krawczyk

# isort: split
from rocksteady.certify.checker import need, numbers, positive


class Series:
    """A power series of intervals in s, up to s^3."""

    def __init__(self, *c):
        self.c = (*c, 0, 0, 0)[:4]

    def __add__(self, o):
        return Series(
            *(x + y for x, y in zip(self.c, o.c if isinstance(o, Series) else (o, 0, 0, 0)))
        )

    def __mul__(self, o):
        c, d = self.c, o.c if isinstance(o, Series) else (o, 0, 0, 0)
        return Series(*(sum(c[i] * d[k - i] for i in range(k + 1)) for k in range(4)))

    def __truediv__(self, o):
        if not isinstance(o, Series):
            return self * (1 / o)
        c = []
        for k in range(4):
            c.append((self.c[k] - sum(c[i] * o.c[k - i] for i in range(k))) / o.c[0])
        return Series(*c)

    __radd__, __rmul__, __neg__ = __add__, __mul__, lambda self: self * -1
    __sub__, __rsub__ = lambda self, o: self + -o, lambda self, o: -self + o
    __rtruediv__ = lambda self, o: Series(o) / self


def series(L):
    """Return an arithmetic of power series."""

    def powers(x):
        d = Series(0, *x.c[1:])
        return d, d * d, d * d * d

    def exp(x):
        d, e, f = powers(x)
        return (1 + d + e / L.num(2) + f / L.num(6)) * L.exp(x.c[0])

    def sin_cos(x):
        (d, e, f), (s, c) = powers(x), L.sin_cos(x.c[0])
        i, j = d - f / L.num(6), 1 - e / L.num(2)
        return j * s + i * c, j * c - i * s

    return K(pi=Series(L.pi), exp=exp, sin_cos=sin_cos)


def solved(L, rows, right):
    """Return the solution of linear equations, by elimination."""
    a, n = [[*row, v] for row, v in zip(rows, right)], len(rows)
    for i in range(n):
        a[i:] = sorted(a[i:], key=lambda row: -abs(float(L.mid(row[i]))))
        need(positive(abs(a[i][i])))
        a[i] = [v / a[i][i] for v in a[i]]
        for k in set(range(n)) - {i}:
            a[k] = [v - a[k][i] * o for v, o in zip(a[k], a[i])]
    return [row[n] for row in a]


def opening(L, M, x, n, s):
    """Return a of the branch A + a s^2 that turns or begins at a point."""
    m, S, zero = len(x), series(L), L.num(0)
    whole, by_A = chain(L, M, x, n)[1:3]
    turned = chain(L, M, x, n, s)[1]
    edge = lambda column: [[*row[1:], y] for row, y in zip(turned, column)]
    v = solved(L, edge(by_A if s == 1 else [L.num(1), *[zero] * (m - 1)]), [-r[0] for r in turned])
    v = [L.num(1), *v[:-1]]

    def term(k, u, a):
        p = [Series(*c) for c in zip(x, v, u)]
        turn = lambda q: Series(*(c * s**i for i, c in enumerate(q.c)))
        p, A, W = [turn(p[-1]), *p, turn(p[0])], Series(M[0], 0, a), Series(M[1])
        N = (A, W, Series(M[2]), A / (1 + W * W))
        return [impact(S, N, *p[j : j + 3], n[j - 1], n[j])[0].c[k] for j in range(m)]

    bent = term(2, [zero] * m, zero)
    if s == 1:
        return -solved(L, edge(by_A), bent)[-1]
    u, z = ([-y for y in solved(L, whole, column)] for column in (bent, by_A))
    still, moved = term(3, u, zero), term(3, [i + j for i, j in zip(u, z)], L.num(1))
    return -solved(L, edge([i - j for i, j in zip(moved, still)]), still)[-1]


def point(L, c):
    """Check that the trace passes its value at a point, and what turns or begins there."""
    n, s, signs, ends = c["half_periods"], c["claim"]["sign"], [], []
    need(True, s not in (1, -1), "it is no multiplier")
    _, W, r, _ = numbers(L, {**c["model"], "amplitude": "1"})
    X, m = boxes(L, [*c["phases"], c["amplitude"]], c["radii"]), len(n)
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


KINDS["point"] = point
