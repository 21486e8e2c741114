// Fills and marks of the attractors whose basins are shown.

/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { MarkKind } from '../../draw/marks.mjs' */
/** @import { ClassTiles, MotionClass } from '../../draw/classes.mjs' */
/** @import { BasinAttractor } from '../../physics/basins.mjs' */
import { MOTION_CLASSES, classTiles } from '../../draw/classes.mjs';

/** @type {MarkKind[]} */
const BASIN_MARKS = ['dot', 'square', 'diamond', 'triangle'];
// Of attractors that share a fill: show/style/palette.py.
const BASIN_TINTS = [0, 0.6, -0.45, 0.8, -0.25, 0.35];
const MOST_MARKED = 12; // attractors

/**
 * Return class, fill and mark of each attractor: of one class they differ in lightness.
 * @param {Theme} theme
 * @param {BasinAttractor[]} attractors
 * @param {boolean} safe
 */
export function attractorLooks(theme, attractors, safe) {
  /** @type {Map<string, number>} */
  const used = new Map();
  let marked = 0;
  return attractors.map(({ kind, orbit }) => {
    const own = /** @type {MotionClass} */ (orbit && orbit.period > 1 ? 'subharmonic' : kind);
    const name = !safe || kind === 'overturned' ? own : 'rocking', count = used.get(name) ?? 0;
    used.set(name, count + 1);
    const fill = theme.fills[/** @type {keyof Theme['fills']} */ (name)];
    const placed = orbit !== null || kind === 'rest';
    const mark = placed && marked < MOST_MARKED ? BASIN_MARKS[marked++ % BASIN_MARKS.length] : null;
    const tint = safe ? 0 : BASIN_TINTS[count % BASIN_TINTS.length];
    return { name, mark, fill: tintedFill(fill, tint) };
  });
}

/**
 * Return the pixels of the basins, by the numbers of their attractors.
 * @param {Theme} theme
 * @param {BasinAttractor[]} attractors
 * @param {boolean} safe
 * @param {number} ratio
 * @returns {ClassTiles}
 */
export function basinTiles(theme, attractors, safe, ratio) {
  const { size } = classTiles(theme, ratio);
  const pixels = attractorLooks(theme, attractors, safe).map(({ name, fill }) => {
    const tinted = { ...theme, fills: { ...theme.fills, [name]: fill } };
    return classTiles(tinted, ratio).pixels[MOTION_CLASSES.indexOf(name)];
  });
  return { size, pixels };
}

/**
 * Return a colour mixed with a part of white, or of black where the part is below 0.
 * @param {string} colour  as #rrggbb
 * @param {number} part
 */
function tintedFill(colour, part) {
  const end = part > 0 ? 255 : 0;
  const mixed = [1, 3, 5].map((k) => {
    const channel = parseInt(colour.slice(k, k + 2), 16);
    return Math.round(channel + Math.abs(part) * (end - channel)).toString(16).padStart(2, '0');
  });
  return `#${mixed.join('')}`;
}
