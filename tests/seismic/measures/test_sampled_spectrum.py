"""Sampled spectra: beside the exact ones, which are no lower."""

import numpy as np

from rocksteady.measures import compute_response_spectrum
from rocksteady.motions import make_synthetic_suite
from rocksteady.seismic.measures.sampled_spectrum import sample_pseudo_acceleration


def test_they_are_below_the_exact_ones_by_what_lies_between_two_samples() -> None:
    """A sine with n samples in a period is seen within cos(pi/n) of its peak, n is 10 or more."""
    periods = np.geomspace(0.02, 20.0, 25)
    for record in make_synthetic_suite(3, seed=2):
        for damping in (0.02, 0.05):
            exact = compute_response_spectrum(record, periods, damping=damping)
            found = sample_pseudo_acceleration(record, periods, damping=damping)
            ratio = found / exact.pseudo_acceleration_m_s2
            assert ratio.max() < 1.0 + 1e-6
            assert (ratio > np.cos(np.pi / np.clip(periods / record.dt_s, 10.0, 30.0))).all()
            assert ratio.mean() > 0.995
