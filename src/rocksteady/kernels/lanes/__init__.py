"""Harmonic sweeps in the linear model, several trajectories at once in vector registers.

`driver.lane_fates` does what `rocksteady.kernels.batch.harmonic.fates_of_sides` does, several times
as fast.  Every lane carries one trajectory at its own stage; a pass is a chain
of short loops over all lanes, written with selects in place of branches, which the compiler turns
into vector instructions.  A lane whose trajectory has ended is given the next; once there is none,
lanes at work move to the front, and loops go over the groups that hold any.  What a lane does never
depends on the lanes beside it, so neither does the result, to the last bit.

The parts: `_fields` the fields and stages of a lane, `_both_sides` the constants of the two sides,
`_exp_sincos` exponential and sine, `_newton` steps towards an impact, `_launching` what a flight
begins with, `_nodes` whether a piece has an impact, `_passes` the order of these loops, `_periods`
motions that have become periodic, `driver` the loop that drives them, `settling` motions that are
followed to their orbits.

**No impact can be missed.**  A lane decides only what the argument of `kernels.linear.zeros`
settles with room to spare; any other flight is left to the scalar `march`, and the lane goes on
after it.

* A flight that starts on the floor has ``y = 0``, ``g = y' >= 0``.  While ``r > 0``, that is from
  the rising node ``sin psi = 1/A`` to the falling one, g stays positive and there is no zero: that
  piece is skipped.
* In a piece with ``r < 0`` there is at most one zero, and it descends.  So a step that has landed
  on a descending zero inside the piece, from whatever guess, has found the first zero of the
  flight, the earlier pieces being done with.  The guess is the length of the last flight
  (`POLISH`).
* Where the guess does not lead there the state at the end of the piece decides (`DOWN`): a zero if
  ``y < -doubt``, none if ``y > doubt``, else the march.
* A later piece with ``r > 0`` (`UP`) has no zero if ``y > doubt`` at its end and it is entered with
  ``g > 2 doubt``, or ``y' < -doubt`` at its end, or the tangents at both ends meet above the floor
  (`rocksteady.kernels.linear.zeros.tangents_meet_below`); it has one if entered with less and
  ``y < -doubt``.  All else, every grazing dip among it, goes to the march.  Mostly there is none:
  its end is looked at together with its start, e^t growing by a constant from one to the other.
* "No return" is the test of the march, after those for zeros.  For ``A <= 1`` the nodes are put to
  ``sin psi = 1``, where r <= 0 touches its largest value: the pieces with r > 0 have no length.
* The end of the run ends a piece as a node does.

**Numbers.**  With ``g = e^t - 1`` and ``d = 1 - e^-t`` the closed form is ``y = G g - H d +
beta (sin psi_0 - sin psi)``, which loses nothing to cancellation down to t = 1/4 or Omega t = 1/4;
shorter flights take Taylor's polynomial, the trivial root divided out (`SHORT`), as in
`kernels.linear.flight`.  Phases stay the truth of the clock: a change of side subtracts an odd
multiple of pi from the phase and adds it, as an integer, to the half cycles.

**Doubt.**  Let u = 2^-53, E = e^t and ``size = y'_0 + 1 + beta (1 + Omega)``, of which G, H and
every term of y and y' at t = 0 are at most 3/2.  A sine or cosine is off by 4u at most, so
``G = (y'_0 + beta (sin + Omega cos) - 1)/2`` by 4.5u size; e^t - 1 by 3u and t by 2ut + 8u/Omega,
the rounding of the phase of a node.  Summed over its terms y is off by no more than
``u size ((7.5 + t + 4/Omega) E + 22.5 + 12/Omega)``, and so is y'.  `doubt` is the simpler and
larger ``16 u size (E + 3) (1 + t + 1/Omega)``.  A test holds it against fifty digits.

**Rest.**  The bound is that of `kernels.march.rest`, sharpened.  Let c be the least of -r on
both sides over the coming ``x = Omega T`` of phase, ``L = A Omega``, v < c the velocity after an
impact and ``w = c - v <= sqrt(c^2 - v^2)``.  A bounce lies below ``v t - w t^2/2``, so that it
lasts 2 v/w at most and its integral is at most ``(2/3) v^3/w^2``; hence the velocity after the next
impact is at most kappa v with ``kappa^2 = delta^2 (1 + (4/3) L v/w^2)``, and ``1 - kappa >=
1 - delta - (2/3) delta L v/w^2``.  With ``T = 3 v/(c_0 (1 - delta))``, c_0 being the pull of now,
all bounces are over within T if ``2 v/(w (1 - kappa)) <= T``, that is if::

    2 c_0 (1 - delta) w <= 3 (w^2 (1 - delta) - (2/3) delta L v).

Over x the largest |sin| is at most that of now or ``|sin psi + x cos psi| + x^2 |sin psi|/2 +
x^3/6``, by Taylor.  Uplift follows at the next node, exactly, and the past is forgotten.  Ending
chatter elsewhere than the march does changes the number of impacts and nothing else.

**Two sides.**  A lane flies in the units of the side that its block is on: y in that side's alpha,
time by its p.  It holds the constants of both sides, those of the other as differences of bits
(`core.other_side`), and `_both_sides.change_sides` exchanges them in the lanes that have just
landed or lifted off on the other side.  A block by a wall keeps its side: the change of side that a
landing makes is taken back.  While all blocks are symmetric nothing is exchanged.  Rest is proved
as above, on both sides at once: with the longer ``v/c_0``, the larger delta, the larger gain of a
bounce; the side whose base lifts the block first lifts it.

**Periods.**  The states after impacts, phase and velocity as seen from the side of the flight, are
those of a map of the plane that shrinks areas, and a motion and its mirror image are the same
there.  A state is kept until one comes back near it, or for 8 impacts and an eighth of all so far;
from then on the state is compared with the one as many impacts earlier.  Once they agree to 1e-11
after having been ten times as far apart, the motion has converged: whole periods are leapt over,
their impacts counted, and the run ends as any other.  A period takes half a cycle at least; chatter
comes back in none.  A motion that merely starts on an unstable orbit does not qualify: its
distances are rounding and grow.  One that came to within 1e-11 of an unstable orbit along its
stable direction would, as would one that passes a fold as slowly; their share of all starts is of
that size.  After a rest the block lifts off at the node with velocity 0, a state without a past:
the second uplift proves the period.  Until then no chatter and no uplift on the other side takes
the place of the first.  Where a period has just doubled, a motion comes near to itself in half of
it, and never nearer: late in a motion every second return is compared then.

Most motions are known to settle before that (`ATTRACTED`).  Near an orbit the differences d of
successive returns follow the linear law ``d_3 = T d_2 - D d_1`` with the trace T and determinant D
of the Jacobian, whatever its directions (Cayley and Hamilton).  D is known: a flight conserves the
area v dv dpsi and an impact takes delta^2 of it, so that ``D = delta^(2m)`` over the m impacts of a
return.  T is fitted to three differences and then held against the next one: where the law
foretells that to within ``1e-12 (1 + D - |T|)`` and to 1e-4 of itself, T is as good.  Both
multipliers are less than 1 if ``D < 1`` and ``|T| < 1 + D`` (Jury); 0.05 is left between them.  So
the fixed point of the law is there, at 40 times the last difference at most, and attracts.  What
the law leaves out was a 10^-4th of the difference; it is of higher order in the distance and falls
faster, while a return takes off a larger part than that: nothing turns the motion back.

That the other direction may be unstable is excluded by D, though a motion on its way along the
stable one shows nothing of it: with the multiplier mu that is seen ``T = mu + D/mu``, beyond
``1 + D`` if D/mu is beyond 1.  At a fold ``T = 1 + D``.  What remains is a grazing dip between the
motion and its orbit, 1e-6 away, which no derivative foretells: the share of such cells is of that
size, and none was met in a million.  The run is not ended there: the state after the periods that
are leapt over follows from the law, differences of 1e-6 to 1e-12, and the rest of the run is flown
from it.

**Orbits.**  `settling.lane_attractors` answers as `kernels.orbits.settle.settle` does.  A lane
remembers its last states and looks, at the same times, for an earlier one within 0.01: m impacts
and n periods ago.  The scalar code then polishes an orbit from the last state and follows the
motion until it has come to within 1e-7 of it.  In the lanes that order is reversed: the motion is
followed first, until the law of its returns is that of a stable orbit, as above, or one of them
differs from the one before by 1e-8 (or for `MOST_RETURNS`).  That costs little side by side, and
the orbit is polished from there, a step or two away.  Of an orbit that is its own mirror image this
is done for one half.  Its stability, its arrival and its symmetry are judged by the same code.

That the scalar code would have found the same orbit at the look is not taken for granted.  With the
orbit O and its Jacobian J at hand, the two states x and x' = P(x) of the look show what bends the
map: ``e = (x' - O) - J (x - O)``.  Where x' is within 0.03 of O and ``(1 - J)^-1 e`` is less than a
tenth of that distance, Newton's method contracts from x' to O.  Elsewhere it is carried out from
x', as the scalar code does, and its orbit is the one that counts.  The scalar code looks for no
orbit where a small difference grows 100-fold over a return: a cell whose |J| is above 80 is left to
it, as are all rests, whose number of bounces depends on the proof that ends them, motions that do
not settle and returns that lead to no stable orbit.  The share on B1 is 0.2 per cent.  So a cell
has the same kind, period, impacts and time of recognition as the scalar code gives it, and the same
orbit to rounding, but for cells where small differences have grown by 1e10 or more on the way.
"""
