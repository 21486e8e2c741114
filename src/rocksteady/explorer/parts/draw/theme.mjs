// Colours and fonts of the page on light or dark paper, from the palette of plots and reports.

/**
 * Colours of what stands on the paper.
 * @typedef {object} Inks
 * @property {string} paper
 * @property {string} ink  text and outlines
 * @property {string} number  numbers and labels
 * @property {string} faint  thin lines, never text
 * @property {string} grid
 * @property {string[]} lines  six line colours, in the order of their use
 * @property {string[]} subharmonicLines  line colours of subharmonic orbits, by their periods
 * @property {string[]} sweeps  dots of an upward and a downward sweep
 * @property {string} impact
 * @property {string} base  motion of the base
 * @property {string} link
 * @property {string} block
 * @property {string} ground
 */

/**
 * Fills of the classes of motion, the same on any paper.
 * @typedef {{ rest: string, symmetric: string, unsymmetric: string, subharmonic: string,
 *   aperiodic: string, rocking: string, overturned: string, undecided: string }} Fills
 */

/**
 * What Python writes into the page (`explorer/palette.py`).
 * @typedef {{ light: Inks, dark: Inks, fills: Fills,
 *   marks: { light: string, dark: string } }} Palette
 */

/**
 * @typedef {Inks & { dark: boolean, fills: Fills, marks: { light: string, dark: string },
 *   font: string, small: string, strong: string }} Theme
 * `font`, `small` and `strong` are values of `pen.font`: 12 px, 11 px and 12 px bold.
 */

export const FAMILY = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, '
  + '"DejaVu Sans", sans-serif';

/**
 * Return the colours and fonts on light or dark paper.
 * @param {boolean} dark
 * @param {Palette} [palette]  the page's own where it is left out
 * @returns {Theme}
 */
export function theme(dark, palette = pagePalette()) {
  const { fills, marks } = palette;
  const fonts = { font: `12px ${FAMILY}`, small: `11px ${FAMILY}`, strong: `600 12px ${FAMILY}` };
  return { ...(dark ? palette.dark : palette.light), dark, fills, marks, ...fonts };
}

/** @returns {Palette} */
function pagePalette() {
  return JSON.parse(document.getElementById('palette')?.textContent ?? '');
}
