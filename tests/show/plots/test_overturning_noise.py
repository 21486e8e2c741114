"""Picture of the shares that overturn under noise: its lines and its axes."""

import numpy as np
from matplotlib.figure import Figure

from rocksteady import Block, DimensionlessBlock, Pulse, compute_noise_fates
from rocksteady.motions import BandNoise
from rocksteady.show.plots.overturning_noise import plot_noise_fates
from rocksteady.show.style.tokens import LIGHT

NOISE = BandNoise(rms=1.0, band=(0.5, 6.0), duration=8.0, seed=3)
PULSE = Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=4.0)


def test_each_scale_has_a_line_over_the_rms() -> None:
    axes_of = {"level": [1.0, 0.0, 0.5], "scale": [0.0, 4.0]}
    found = compute_noise_fates(
        DimensionlessBlock(restitution=0.9), PULSE, NOISE, axes=axes_of, draws=10
    )
    axes = plot_noise_fates(found, Figure().add_subplot())
    assert axes.get_xlabel() == r"rms of the noise [$\alpha g$]"
    for line, share in zip(axes.get_lines(), found.share, strict=True):
        assert np.asarray(line.get_xdata()).tolist() == [0.0, 0.5, 1.0]
        np.testing.assert_allclose(np.asarray(line.get_ydata()), 100.0 * share[[1, 2, 0]])
    assert axes.get_legend() is None
    names = {text.get_text(): text.get_color() for text in axes.texts}
    assert set(names) == {"0", "4", "scale of the motion"}
    colours = [line.get_color() for line in axes.get_lines()]
    assert [names["0"], names["4"]] == colours == LIGHT.series("risk", 2)
    low, high = axes.get_ylim()
    assert low < 0.0
    assert high > 100.0


def test_the_longer_axis_is_to_the_right_and_in_si_where_there_is_a_size() -> None:
    block = Block.rectangle(width=0.8, height=3.0, restitution=0.9)
    scales = np.linspace(0.0, 6.0, 9)
    found = compute_noise_fates(
        block, PULSE, NOISE, axes={"scale": scales, "level": np.linspace(0.1, 0.8, 8)}, draws=2
    )
    axes = plot_noise_fates(found, Figure().add_subplot())
    assert axes.get_xlabel() == "scale of the motion"
    order = np.argsort(-found.share.sum(axis=0), kind="stable")
    worst = np.sort(order[:6])
    for line, level in zip(axes.get_lines(), worst, strict=True):
        np.testing.assert_allclose(np.asarray(line.get_ydata()), 100.0 * found.share[:, level])
    *names, title = (text.get_text() for text in axes.texts)
    assert title == "rms of the noise\n[m/s$^2$]\n2 lower ones left out"
    named = sorted(float(name) for name in names)
    rms = found.level[worst] * block.uplift_acceleration
    np.testing.assert_allclose(named, np.sort(rms), rtol=1e-3)
