"""Check certificates of chaos."""

from itertools import combinations, product

from rocksteady.certify.proofs.base_checker import (
    MODEL,
    above_0,
    kind,
    need,
    number,
    numbers,
    odd,
    positive,
)
from rocksteady.certify.proofs.checker import boxes, flight, impact, inside


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
    """Check that each sequence of boxes of phases and of flights n, n + 2, ... is one motion.

    It is a motion where e has two signs on the ends of each box, for all neighbours and flights,
    and one alone where its derivative by the phase of the impact outweighs both others.
    """
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
    """Check that each set of states (two last phases) covers the next one, and the first itself.

    Then each sequence of two words of impacts, round all sets or the first alone, is a motion.
    """
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


BOXES = {"phases": [number], "radius": above_0, "least_half_periods": lambda n: odd(n) and n > 0}
for test, form in ((hilltops, BOXES), (homoclinic, {"frames": [[number, 6]]})):
    kind("chaos", test, model=MODEL, claim={"entropy_per_period": above_0}, **form)
