"""Check certificates of regions."""

import base64
import math
import zlib

from rocksteady.certify.proofs.base_checker import (
    above,
    above_0,
    exact,
    fits,
    kind,
    need,
    numbers,
    odd,
    positive,
)

MOST = 4 * 10**6
"""Letters of a tree that is read."""


def tree_of(c):
    """Return the letters of a tree, if it is one.

    The letters of a tree, breadth first, are 5 where a box is halved, by turns in A and in W; else
    1 no solution, 2 stable, 3 unstable, 4 through the floor, and 0, of which nothing is claimed.
    """
    try:
        packed = zlib.decompressobj()
        tree = packed.decompress(base64.b64decode(c["tree"], validate=True), MOST).decode()
        need(True, packed.unconsumed_tail, f"its tree has more than {MOST} letters")
    except zlib.error:
        raise ValueError("it is no tree") from None
    good = set(tree) <= set("012345") and len(tree) == 2 * tree.count("5") + 1
    need(good, not good, "it is no tree")
    return tree


def leaves(c):
    """Return the path to each box of a tree, 0 for a lower half and 1 for an upper, and letters."""
    paths, boxes = [""], []
    for k, letter in enumerate(tree_of(c)):
        need(True, k == len(paths) or len(paths[k]) > 200, "it is no tree")
        if letter == "5":
            paths += [paths[k] + "0", paths[k] + "1"]
        else:
            boxes.append((paths[k], letter))
    return boxes


def leaf(K, c, path, letter):
    """Check what is claimed of one box.

    A symmetric motion has all phases p and all flights T = n pi/W: its e is 0 where, with S = b sin
    p, C = b cos p, h = th T/2 and g = (1 - r)/(1 + r), S + g h W C = g h h. Branch 1 is the larger
    S. The trace of half a cycle follows from the derivatives of e. With A sin(p + W t) - 1 at most
    once positive, from the start on, a flight cannot dip: where y is least below 0, y'' = y - 1 +
    ... < 0. So for n = 1 it has no dip if A < 1, A sin p > 1, or p > pi/2, which is b > g h h.
    """
    n, ends = c["order"], [[exact(x) for x in c[k]] for k in ("amplitude", "frequency_ratio")]
    for k, half in enumerate(path):
        low, high = ends[k % 2]
        ends[k % 2] = [low, (low + high) / 2] if half == "0" else [(low + high) / 2, high]
    A, W, r, b = numbers(K, {**c["model"], "amplitude": ends[0], "frequency_ratio": ends[1]})
    T = n * K.pi / W
    d = K.exp(-T)
    h, g, s = (1 - d) / (1 + d), (1 - r) / (1 + r), 1 + W * W
    P, Q, why = g * h * W, g * h * h, "a box is not what its letter says"
    root = b * b * (1 + P * P) - Q * Q
    if letter == "1":
        need(positive(-root), positive(root), why)
        return
    need(positive(root), positive(-root), why)
    R = K.sqrt(root)
    S, C = (Q + P * R) / (1 + P * P), (Q * Q - b * b) / (Q * P + R)
    t = (1 - d) ** 2 / (2 * d) * ((1 - r * r) / (2 * S) - (1 - r) ** 2 * s / 2 - 2 * r) - 2 * r
    inner, outer = positive(1 + r * r - t, 1 + r * r + t), positive(abs(t) - 1 - r * r)
    if letter != "4":
        need(inner if letter == "2" else outer, outer if letter == "2" else inner, why)
    if n == 1 and (positive(1 - A) or positive(S * s - 1) or positive(b - Q)):
        need(True, letter == "4", why)
        return
    near = math.atan2(float(K.mid(S)), float(K.mid(C)))
    (i, j), o = K.sin_cos(K.num(near)), K.hull(0, 1) / 4
    x = (S * j - C * i) / b  # sin(p - near), of an angle from x to x + x^3/4 up to 0.8
    need(positive(C * j + S * i, 0.64 - x * x))
    p = K.num(near) + x * (1 + x * x * o)
    if letter != "4":
        above(K, W, b, (p, p, *[K.sin_cos(p)[0]] * 2), T, False, 12)
        return

    def height(k):
        e, f = (lambda u: K.exp(-u * T / 32)), K.sin_cos(p + n * K.pi * k / 32)[0]
        ends = (1 - S) * (e(k) - e(64 - k)) + (1 + S) * (e(32 - k) - e(32 + k))
        return 1 - b * f - ends / (1 - e(64))

    need(any(positive(-height(k)) for k in range(1, 32)))


def divided(K, c, path, letter, left=4):
    """Check one box, in parts where it is undecided."""
    try:
        leaf(K, c, path, letter)
    except ArithmeticError:
        need(left)
        for half in "01":
            divided(K, c, path + half, letter, left - 1)


def claims(c):
    """Return the path and the letter of each box of which something is claimed."""
    if "path" in c:
        return [(c["path"], c["claim"]["letter"])]
    boxes = [each for each in leaves(c) if each[1] != "0"]
    need(True, not boxes, "it claims nothing")
    return boxes


def region(K, c):
    """Check the box of a path, or each box of a tree of which something is claimed."""
    for path, letter in claims(c):
        divided(K, c, path, letter)


def shares(c):
    """Return the share of the area with each letter, of a tree."""
    boxes = leaves(c) if "tree" in c else ()
    return {x: sum(0.5 ** len(path) for path, y in boxes if x == y) for x in "01234" if boxes}


region.shares = shares


ENDS = lambda v: fits(v, [lambda x: type(x) in (int, float), 2]) and 0 < v[0] < v[1] < 10**6
BELOW_1 = lambda t: above_0(t) and exact(t) < 1
PATH = lambda v: type(v) is str and set(v) <= set("01") and len(v) <= 200
for form in (
    {"tree": lambda v: type(v) is str},
    {"path": PATH, "claim": {"letter": ("1", "2", "3", "4")}},
):
    form |= {"model": {"restitution": [BELOW_1]}, "order": lambda n: odd(n) and n > 0}
    kind("region", region, amplitude=ENDS, frequency_ratio=ENDS, **form)
