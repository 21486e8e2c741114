"""Quantile of the normal distribution.

Algorithm AS 241 (Wichura, The percentage points of the normal distribution, Applied Statistics 37,
1988): ratios of polynomials of degree 7 around the median, on the flanks and in the tails.  Its
relative error is about 1e-16.
"""

import math

from rocksteady.kernels.elementary.logarithm import log
from rocksteady.kernels.machine_code.compilation import compiled, inlined

Eight = tuple[float, float, float, float, float, float, float, float]

HALF_CENTRE = 0.425
HALF_CENTRE_SQUARED = 0.180625
FLANK_END = 5.0
# From the highest power down; ABOVE the fraction bar and BELOW it.
CENTRE_ABOVE = (
    2.5090809287301226727e3,
    3.3430575583588128105e4,
    6.7265770927008700853e4,
    4.5921953931549871457e4,
    1.3731693765509461125e4,
    1.9715909503065514427e3,
    1.3314166789178437745e2,
    3.3871328727963666080e0,
)
CENTRE_BELOW = (
    5.2264952788528545610e3,
    2.8729085735721942674e4,
    3.9307895800092710610e4,
    2.1213794301586595867e4,
    5.3941960214247511077e3,
    6.8718700749205790830e2,
    4.2313330701600911252e1,
    1.0,
)
FLANK_ABOVE = (
    7.74545014278341407640e-4,
    2.27238449892691845833e-2,
    2.41780725177450611770e-1,
    1.27045825245236838258e0,
    3.64784832476320460504e0,
    5.76949722146069140550e0,
    4.63033784615654529590e0,
    1.42343711074968357734e0,
)
FLANK_BELOW = (
    1.05075007164441684324e-9,
    5.47593808499534494600e-4,
    1.51986665636164571966e-2,
    1.48103976427480074590e-1,
    6.89767334985100004550e-1,
    1.67638483018380384940e0,
    2.05319162663775882187e0,
    1.0,
)
TAIL_ABOVE = (
    2.01033439929228813265e-7,
    2.71155556874348757815e-5,
    1.24266094738807843860e-3,
    2.65321895265761230930e-2,
    2.96560571828504891230e-1,
    1.78482653991729133580e0,
    5.46378491116411436990e0,
    6.65790464350110377720e0,
)
TAIL_BELOW = (
    2.04426310338993978564e-15,
    1.42151175831644588870e-7,
    1.84631831751005468180e-5,
    7.86869131145613259100e-4,
    1.48753612908506148525e-2,
    1.36929880922735805310e-1,
    5.99832206555887937690e-1,
    1.0,
)


@compiled
def normal_quantile(share: float) -> float:
    """Return the number that a standard normal one stays below with a probability in (0, 1)."""
    from_median = share - 0.5
    if abs(from_median) <= HALF_CENTRE:
        r = HALF_CENTRE_SQUARED - from_median * from_median
        return _polynomial(CENTRE_ABOVE, r) * from_median / _polynomial(CENTRE_BELOW, r)
    r = math.sqrt(-log(share if from_median < 0.0 else 1.0 - share))
    if r <= FLANK_END:
        r -= 1.6
        size = _polynomial(FLANK_ABOVE, r) / _polynomial(FLANK_BELOW, r)
    else:
        r -= FLANK_END
        size = _polynomial(TAIL_ABOVE, r) / _polynomial(TAIL_BELOW, r)
    return -size if from_median < 0.0 else size


@inlined
def _polynomial(factors: Eight, x: float) -> float:
    value = factors[0]
    for power in range(1, 8):
        value = value * x + factors[power]
    return value
