"""What every answer about a rocking object depends on, to be printed with it."""

CAVEATS = tuple(
    """\
The object is one rigid body that rocks in a plane on a rigid floor: it does not bend, bounce or \
slide while it rocks, and its content does not move.
What one record does is no prediction: a little more or less shaking can change a fall into none \
and back. The share of many records is what can be relied on.
An object can survive shaking stronger than one that it fell under. Outcomes stand here as they \
were computed: none is sorted or smoothed into order.
The answer is of these records: a suite of another PGV/PGA gives another curve.
Vertical motion changes single records a lot and the share of many a little.
Restitution in tests is often above Housner's value, so that a band of it up to min(0.98, sqrt e) \
is covered.
Friction that is near width over height lets the object slide: then rocking alone is no answer, \
and none is given.
Code formulas stand side by side and are not averaged; each implements the equation that it names, \
and the engineer verifies.
This is no substitute for rules on anchorage.""".splitlines()
)
"""Sentences for the end of every assessment."""
