"""Films saved as GIF files."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.show.film.animation import Film

if TYPE_CHECKING:
    from PIL.Image import Image

NEARLY = 8
"""Largest difference from the paper, of 255, that counts as paper."""
SAMPLES = 12
"""Frames from which the colours of all are taken."""


def save_gif(film: Film, file: Path, done: Callable[[str], object] = str) -> None:
    """Write a film as a GIF that plays for ever.

    `matplotlib.animation` would draw every tick of every frame again and give each its own colours,
    which takes ten times as long and makes a larger file.

    Parameters
    ----------
    film
        From `rocksteady.show.film.animation.film_of`.
    file
        Where it goes, in whatever ending.
    done
        Called with the name of each frame when it is drawn.

    Raises
    ------
    OSError
        If it cannot be written.
    """
    from matplotlib.colors import to_rgb
    from PIL import Image

    paper = np.round(255.0 * np.array(to_rgb(film.inks.paper)))
    with film.style():
        draw = _painter(film)
        samples = np.unique(np.linspace(0, film.frames - 1, SAMPLES).round()).astype(int)
        flashes = [film.frame_after(s) for s in film.shown_impacts[:SAMPLES]]
        sheet = np.concatenate([np.asarray(draw(int(k))) for k in [*samples, *flashes]])
        colours = Image.fromarray(sheet).quantize(256, method=Image.Quantize.MEDIANCUT)
        # The average of what is nearly paper would tinge it.
        table = np.array(colours.getpalette()).reshape(-1, 3)
        table[(np.abs(table - paper) <= NEARLY).all(axis=1)] = paper
        colours.putpalette(table.ravel().tolist())

        def frames() -> Iterator[Image.Image]:
            for frame in range(film.frames):
                yield draw(frame).quantize(palette=colours, dither=Image.Dither.NONE)
                done(f"frame {frame + 1}")

        pictures = frames()
        next(pictures).save(
            file,
            format="GIF",
            save_all=True,
            append_images=pictures,
            duration=round(1000.0 / film.reel.fps),
            loop=0,
        )


def _painter(film: Film) -> "Callable[[int], Image]":
    """Return a function that draws a frame: what stands still once, what moves each time."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    canvas: Any = FigureCanvasAgg(film.figure)  # its methods have no types
    moving = film.show(0)
    if film.scene.camera == "following":  # the ticks move too
        others = [artist for artist in moving if artist.axes is not film.scene.axes]
        moving = [film.scene.axes, *others]
    moving = sorted(moving, key=lambda artist: artist.get_zorder())
    for artist in moving:
        artist.set_animated(True)
    canvas.draw()
    still = canvas.copy_from_bbox(film.figure.bbox)

    def draw(frame: int) -> Image.Image:
        film.show(frame)
        canvas.restore_region(still)
        for artist in moving:
            film.figure.draw_artist(artist)
        return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])

    return draw
