"""Rocking spectra of a made-up near-fault record and of a suite of such records.

Writes spectrum.png and spectrum-suite.png into the folder that is given, by default the current
one: python examples/spectra.py docs/images
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.show.figures.spectra import suite_figure
from rocksteady.show.style import palette

STEP = 0.01  # s
SAMPLES = 2000


def near_fault(seed: int) -> rs.Record:
    """A pulse of a second or two in shaking that swells and dies away."""
    rng = np.random.default_rng(seed)
    time = STEP * np.arange(SAMPLES)
    frequency = np.fft.rfftfreq(SAMPLES, STEP)
    noise = np.fft.rfft(rng.normal(size=SAMPLES)) * frequency / (frequency**2 + 3.0**2)
    shaking = np.fft.irfft(noise, SAMPLES) * np.minimum(time / 2.0, 1.0)
    shaking *= np.exp(-0.25 * np.maximum(time - 6.0, 0.0))
    period, centre = rng.uniform(0.8, 2.0), rng.uniform(3.0, 6.0)
    phase = np.pi * (time - centre) / period
    pulse = (1.0 - 2.0 * phase**2) * np.exp(-(phase**2))  # Ricker's wavelet
    values = 2.5 * shaking / np.abs(shaking).max() + rng.uniform(2.0, 5.0) * pulse
    return rs.Record(acceleration_m_s2=values, dt_s=STEP, name=f"near fault {seed}")


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    periods = np.linspace(0.5, 8.0, 600)
    record = near_fault(1)
    with palette.style():
        figure = Figure(figsize=(10.4, 4.2))
        left, right = figure.subplots(1, 2)
        curves = rs.compute_rocking_spectrum(
            record, alpha=np.radians([10.0, 15.0, 20.0]), periods_s=periods
        )
        rs.plot_rocking_spectrum(curves, left)
        plane = rs.compute_rocking_spectrum(
            record, alpha=np.linspace(0.08, 0.45, 240), periods_s=periods[::2]
        )
        rs.plot_spectrum_map(plane, right)
        figure.savefig(folder / "spectrum.png", dpi=150)
    suite = rs.compute_rocking_spectrum(
        [near_fault(seed) for seed in range(1, 41)],
        alpha=np.radians([10.0, 15.0, 20.0]),
        periods_s=np.linspace(0.5, 8.0, 200),
    )
    figure = suite_figure(rs.summarise_spectra(suite))
    figure.savefig(folder / "spectrum-suite.png", dpi=150)


if __name__ == "__main__":
    main(Path(*sys.argv[1:2]))
