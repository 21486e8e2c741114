"""Check certificates of orbits."""

from rocksteady.certify.proofs.base_checker import (
    MODEL,
    above,
    above_0,
    arb,
    check,
    iv,
    kind,
    need,
    number,
    numbers,
    odd,
    positive,
)


def inside(K, a, x):
    """Return whether an interval lies inside another one, off its ends."""
    return positive(K.ends(a)[0] - K.ends(x)[0], K.ends(x)[1] - K.ends(a)[1])


def factors(K, T, tail=False):
    """Return 1/th T, 1/sh T and th T/2, with tail for all durations from T on."""
    d = K.exp(-T)
    c, q, h = (1 + d * d) / (1 - d * d), 2 * d / (1 - d * d), (1 - d) / (1 + d)
    return (K.hull(1, c), K.hull(0, q), K.hull(h, 1)) if tail else (c, q, h)


def impact(K, M, p, q, s, n, m, tails=(False, False)):
    """Return e, its derivatives by the phases before, at, after an impact, and by A.

    An M holds A, W, r, b. A flight leaves with w = (1 - b sin p)/th T - (1 + b sin q)/sh T
    - b W cos p and lands with V = (1 + b sin q)/th T - (1 - b sin p)/sh T - b W cos q; an impact
    fits its flights where e = (r V - w)/b is 0.
    """
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
    need(positive(T), positive(-T), "a flight lasts no time")
    (sp, cp), (sq, cq), (c, d, _) = K.sin_cos(p), K.sin_cos(q), factors(K, T, tail)
    w = (1 - b * sp) * c - (1 + b * sq) * d - b * W * cp
    V = (1 + b * sq) * c - (1 - b * sp) * d - b * W * cq
    need(positive(w, V), positive(-w) or positive(-V), "a flight begins or ends the wrong way")
    above(K, W, b, (p, q, sp, sq), T, tail, depth)


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


def solved(rows, right, size):
    """Return the solutions of linear equations, by elimination with the pivots of largest size."""
    a, n = [[*row, *v] for row, v in zip(rows, right)], len(rows)
    for i in range(n):
        a[i:] = sorted(a[i:], key=lambda row: -size(row[i]))
        need(positive(abs(a[i][i])))
        a[i] = [v / a[i][i] for v in a[i]]
        for k in set(range(n)) - {i}:
            a[k] = [v - a[k][i] * o for v, o in zip(a[k], a[i])]
    return [row[n:] for row in a]


def inverse(K, J):
    """Return an approximate inverse, on which no proof relies."""
    unit = [[float(i == j) for j in range(len(J))] for i in range(len(J))]
    rows = solved([[float(K.mid(v)) for v in row] for row in J], unit, abs)
    return [[K.num(v) for v in row] for row in rows]


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


def boxes(K, centres, radii):
    """Return the boxes of a certificate."""
    need(True, len(centres) != len(radii), "it has not one radius for each number")
    return [K.num(t) + K.hull(-1, 1) * K.num(r) for t, r in zip(centres, radii)]


def least(K, X, n, W, B=()):
    """Test that no part of a chain is the whole motion; in the boxes B there is one alone.

    A chain of m flights closes after m impacts, or 2 m where m is odd.
    """
    N, total = range(len(n)), lambda d: d * (1 + d % 2)
    T = [(X[k] - X[k - 1] + n[k - 1] * K.pi) / W for k in N]
    for d in (d for d in N[1:] if len(n) % d == 0 and total(d) < total(len(n))):
        apart = [v for k in N for v in (K.sin_cos((X[k] - X[k - d]) / 2)[0], T[k] - T[k - d])]
        same = B and all(n[k] == n[k - d] and inside(K, X[k - d], B[k]) for k in N)
        need(any(positive(v) or positive(-v) for v in apart), same, f"it closes after {total(d)}")


def orbit(K, c):
    """Check existence, uniqueness, least period, first impacts and stability of an orbit."""
    M, X, n = numbers(K, c["model"]), boxes(K, c["phases"], c["radii"]), c["half_periods"]
    need(True, len(n) != len(X), "it has not one flight for each phase")
    B, X = X, krawczyk(K, lambda x: chain(K, M, x, n)[:2], X)
    least(K, X, n, M[1], B)
    for k in range(len(n)):
        flight(K, M, X[k - 1], X[k], n[k - 1])
    t, d = chain(K, M, X, n)[3], 1 + M[2] ** (2 * len(n))
    inner, outer = positive(d - t, d + t), positive(t * t - d * d)
    calm = "stable" if positive(1 - M[2]) else K.ends(M[2])[0] == 1 and "neutral"
    result = "unstable" if outer else inner and calm
    need(result, result and result != c["claim"]["stability"], f"it is {result}")


CHAIN = {"half_periods": [odd], "phases": [number], "radii": [above_0]}
kind("orbit", orbit, model=MODEL, claim={"stability": ("stable", "unstable", "neutral")}, **CHAIN)
