"""Harmonic sweeps in the nonlinear model, several trajectories at once.

`loop.nonlinear_lane_fates` does what `rocksteady.kernels.batch.harmonic.fates_of_sides` does.
As in `rocksteady.kernels.lanes` every lane carries one trajectory at its own stage, loops over all
lanes have selects in place of branches, and what a lane does never depends on the lanes beside it.
Every pass takes all lanes one Taylor step further; steps of all lanes cost alike.

The parts: `_layout` the fields of a lane and its rows of coefficients, `_two_sides` the constants
of the two sides, `_coefficients` of y, `_steps` the length of a step, `_signs` whether it has an
impact, `_ends` the impact and what follows it, `_leaps` motions that have become periodic,
`_transfer` the way in and out, `loop` what drives them, `settling` motions that are followed to
their orbits.

**Steps.**  Coefficients and step are those of `rocksteady.kernels.nonlinear.series`, but that the
degree is always the highest and the step is shorter, by 7 per cent at most.

**No impact can be missed.**  Let x be the part of the step T, N the `TOP`, q the Taylor polynomial
of y up to x^N, R the sum of the moduli of the terms above: ``|y - q| <= R x^N``.  In Bernstein's
basis of degree N the polynomials ``q - R x^N`` and ``q + R x^N`` differ from q in the last control
point alone, so that all three have the same row of signs where that point is larger than R.

* No change of sign, from plus: ``y >= q - R x^N > 0``, and the step has no impact.
* One change: both polynomials have one zero in the step, and ``|q| <= R x^N`` only between the two.
  y has no zero elsewhere, and one there at least.  Let x_0 be the one that Newton's method finds,
  ``f = -dy/dx`` in it, M the sum of the moduli of the terms of the second derivative, and
  ``w = min(x_0, f/M)``.  Within w of x_0 the polynomial falls, and at both ends of that piece
  ``|y| >= f w/2``.  Where that is more than ``2 R (x_0 + w)^N`` both ends lie outside the two
  zeros, and x_0 is the only zero of the step.
* All else, a sign in doubt among it: the lane takes half of the step instead.  After five halvings
  it is left to the scalar `march` for one flight.

A flight from the floor has ``b_0 = 0``; the other points are those of y/x, each times a positive
number.  A block that lifts off from a rest has ``y' = 0`` and ``y'' >= 0``: b_1 is 0, b_2 not
negative.

**Overturning.**  A block is lost where the march says so, beyond the point of no return and moving
away.  The march looks at the ends of its own steps: where the run ends before it must have come to
such an end, it decides.  So it does where a block that lies on its side may not have been lost
before (``alpha + atan(alpha A) >= pi/2``), and of all of a run on a still base.

**Two sides.**  A lane flies in the units of the side that its block is on: y in that side's alpha,
time by its p.  It holds the constants of both sides, those of the other as differences of bits
(`core.other_side`), and `_two_sides.change_sides` exchanges them in the lanes that have just
landed; phase and half cycles count alike on both.  While all blocks are symmetric nothing is
exchanged.

**Rest.**  After an impact the proof of `rocksteady.kernels.nonlinear.proofs` looks at both sides,
each in its own units: velocity v, pull of now c_0, largest drift D, rate p; delta is the larger
restitution.  Its window is 4/(1 - delta) times the larger ``v/(c_0 p)``.  It asks for ``2 v/(c p)
<= (1 - kappa)`` times that window with ``c <= c_0``, so that ``kappa <= (1 + delta)/2``, and
``kappa^2 >= delta^2 (1 + 4 D v/c_0^2)`` on each side.  Only where ``4 D delta^2 v <= ((1 +
delta)^2/4 - delta^2) c_0^2`` and ``v < c_0`` on both is the proof itself asked; the march waits for
the uplift.

**Periods** are found and leapt over as in `rocksteady.kernels.lanes`, by states just after an
impact: phase seen from the side of the flight to come, and velocity.  The base motion seen from one
side is that seen from the other, half a cycle later.  On a symmetric block both sides obey one
equation, so that equal states, on whichever sides, have equal futures but for the mirror.  On an
unlike one they have equal futures if the side is the same; then equal phases lie whole cycles
apart, an even number of half cycles, and all that follows repeats.  On different sides they prove
nothing: of sides that differ in restitution alone both lift off in equal states, and bounce on in
ways of their own.  So the phases of the two sides of an unlike block are set apart by more than any
two phases differ, 2 pi, and a state is compared with those on its own side alone.

Most are known to settle before that, by the law of their returns: flights of this model conserve
the area ``v dv dpsi`` too.
"""
