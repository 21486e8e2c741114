"""What every answer about a rocking object depends on, to be printed with it."""

CAVEATS = tuple(
    """\
The object is one rigid body that rocks in a plane on a rigid floor: it does not bend, bounce or \
slide while it rocks, and its content does not move.
The outcome of a single record is no prediction: slightly stronger or weaker shaking can turn a \
fall into survival and back. Rely on the share of many records.
An object may fall at one level and survive a higher one. Outcomes are reported as computed; none \
is sorted or smoothed.
Shares belong to these records: another suite, of other durations, gives others. The interval is \
of the records alone, not of doubts about the object.
Vertical motion can change single outcomes and shares: run the records with and without it. In \
runs it has the sign of its file; a peak that is stated counts in the worse direction.
Restitution in tests is often above Housner's value e; by default a band from e to min(0.98, sqrt \
e) is run.
Where friction is near width over height the object slides: rocking alone is then no answer, and \
none is given.
Code formulas stand side by side and are not averaged; each implements the equation that it names, \
and the engineer verifies.
This is no substitute for rules on anchorage.""".splitlines()
)
"""Sentences for the end of every assessment."""
