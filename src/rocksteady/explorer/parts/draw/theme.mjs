// Colours, fonts and words of the page on light or dark paper: those of all pictures.

/**
 * Colours by role, as `show/style/tokens.py` has them; a fill has a pattern in `classes.mjs`.
 * @typedef {object} Inks
 * @property {boolean} dark
 * @property {string} page  ground of the page
 * @property {string} paper  ground of a panel
 * @property {string} ink  text, and what may be touched
 * @property {string} quiet  numbers and labels
 * @property {string} edge  outlines, never text
 * @property {string} hair  grid
 * @property {string} soil  the ground under a block
 * @property {string} rest
 * @property {string} rocks
 * @property {string} falls
 * @property {string} onFalls
 * @property {string} onRocks
 * @property {string} undecided
 * @property {string} symmetric
 * @property {string} unsymmetric
 * @property {string} subharmonic
 * @property {string} aperiodic
 * @property {string} unsymmetricLine
 * @property {string} subharmonicLine
 * @property {string} aperiodicLine
 * @property {string} motion  the block's own history and orbit
 * @property {string} base  what the base does
 * @property {string} impact
 * @property {string} limit  criteria and boundaries, dashed
 * @property {string} observed
 * @property {string} risk
 * @property {string[]} riskRamp  probability of falling, five steps
 * @property {string[]} rocksRamp  how far it rocks, five steps
 */

/**
 * Words of the classes of motion, by their names.
 * @typedef {Record<import('./classes.mjs').MotionClass, string>} ClassWords
 */

/** @typedef {import('../shell/units.mjs').Quantities} Quantities */

/**
 * What Python writes into the page (`explorer/_palette.py`).
 * @typedef {{ light: Inks, dark: Inks, words: ClassWords, units: Quantities }} Palette
 */

/**
 * @typedef {Inks & { words: ClassWords, units: Quantities, font: string, small: string, strong: string }} Theme
 * `font`, `small` and `strong` are values of `pen.font`: 12 px, 11 px and 12 px bold.
 */

export const FAMILY = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, '
  + '"DejaVu Sans", sans-serif';

/**
 * Return colours, fonts and words on light or dark paper.
 * @param {boolean} dark
 * @param {Palette} [palette]  the page's own where it is left out
 * @returns {Theme}
 */
export function theme(dark, palette = pagePalette()) {
  const fonts = { font: `12px ${FAMILY}`, small: `11px ${FAMILY}`, strong: `600 12px ${FAMILY}` };
  return { ...(dark ? palette.dark : palette.light), words: palette.words, units: palette.units, ...fonts };
}

/**
 * Return a colour between two.
 * @param {string} one  as #rrggbb
 * @param {string} other
 * @param {number} part  of the other, from 0 to 1
 */
export function mixed(one, other, part) {
  const [from, to] = [rgbOf(one), rgbOf(other)];
  const channels = from.map((value, k) => Math.round(value + part * (to[k] - value)));
  return `#${channels.map((value) => value.toString(16).padStart(2, '0')).join('')}`;
}

/** Return red, green and blue. @param {string} colour  as #rrggbb */
export function rgbOf(colour) {
  return [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
}

/** @returns {Palette} */
function pagePalette() {
  return JSON.parse(document.getElementById('palette')?.textContent ?? '');
}
