// Fills and marks of the attractors whose basins are shown.

/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { MarkKind } from '../../draw/marks.mjs' */
/** @import { Look, MotionClass } from '../../draw/classes.mjs' */
/** @import { BasinAttractor } from '../../physics/basins.mjs' */
import { classLook } from '../../draw/classes.mjs';
import { mixed } from '../../draw/theme.mjs';

/** @type {MarkKind[]} */
const BASIN_MARKS = ['dot', 'square', 'diamond', 'triangle'];
// Of attractors of one kind: parts of paper, or of ink below 0.
const BASIN_TINTS = [0, 0.6, -0.4, 0.8, -0.2, 0.35];
const MOST_MARKED = 12; // attractors

/**
 * Return look and mark of each attractor: of one class they differ in lightness.
 * @param {Theme} theme
 * @param {BasinAttractor[]} attractors
 * @param {boolean} safe
 * @returns {{ look: Look, mark: MarkKind | null }[]}
 */
export function attractorLooks(theme, attractors, safe) {
  /** @type {Map<string, number>} */
  const used = new Map();
  let marked = 0;
  return attractors.map(({ kind, orbit }) => {
    const own = /** @type {MotionClass} */ (orbit && orbit.period > 1 ? 'subharmonic' : kind);
    const name = !safe || kind === 'overturned' || kind === 'undecided' ? own : 'rocking', count = used.get(name) ?? 0;
    used.set(name, count + 1);
    const placed = orbit !== null || kind === 'rest';
    const mark = placed && marked < MOST_MARKED ? BASIN_MARKS[marked++ % BASIN_MARKS.length] : null;
    const tint = safe ? 0 : BASIN_TINTS[count % BASIN_TINTS.length], look = classLook(theme, name);
    const fill = mixed(look.fill, tint > 0 ? theme.paper : theme.ink, Math.abs(tint));
    return { look: { ...look, fill }, mark };
  });
}
