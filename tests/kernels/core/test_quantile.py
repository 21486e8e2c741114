"""The normal quantile: in agreement with many digits, symmetric, and rising."""

import numpy as np
from mpmath import mp

from rocksteady.kernels.core._quantile import normal_quantile
from tests.every import every
from tests.strategies import inner_sample_size


def test_it_is_the_quantile_to_rounding() -> None:
    rng = np.random.default_rng(3)
    count = inner_sample_size(2_000, 200)
    tails = 10.0 ** rng.uniform(-15.9, -1.0, count)
    with mp.workdps(40):
        for share in [*tails, *(1.0 - tails), *rng.uniform(0.01, 0.99, count), 2.0**-53]:
            found = normal_quantile(float(share))
            # One step of Newton's method from there says what is missing.
            missing = (mp.ncdf(found) - mp.mpf(float(share))) / mp.npdf(found)
            assert abs(missing) <= 1e-15 * max(abs(found), 1e-2)


@every("share", [0.075, 0.925, 0.5 - 0.425, 2.0**-36, 2.0**-37])
def test_its_parts_meet(share: float) -> None:
    near = [normal_quantile(float(value)) for value in share * (1.0 + 1e-13 * np.arange(-50, 51))]
    assert (np.diff(near) >= -1e-15 * abs(near[0])).all()


def test_it_is_odd_about_the_median() -> None:
    assert normal_quantile(0.5) == 0.0
    for share in (2.0**-40, 0.03125, 0.25, 0.4375):
        assert normal_quantile(1.0 - share) == -normal_quantile(share)
