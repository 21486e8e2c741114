// How many cells of the map are of each class and period, and where the colours of the peak end.

/** @import { Tile } from '../../physics/tiles.mjs' */
import { MOTION_CLASSES } from '../../draw/classes.mjs';
import { MAP_KIND } from '../../physics/tiles.mjs';
import { cellClass, peakOf, periodGroup } from './words.mjs';

const PEAK_ENDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5];
const PEAK_PART = 0.97; // of the cells whose peaks the colours tell apart

/** Return counts of nothing. */
export function emptyCensus() {
  return { classes: MOTION_CLASSES.map(() => 0), groups: new Array(7).fill(0), count: 0,
    end: PEAK_ENDS[4] };
}

/**
 * Count a cell.
 * @param {ReturnType<typeof emptyCensus>} census
 * @param {Tile} tile
 * @param {number} k
 */
export function counted(census, { kind, period }, k) {
  census.count += 1;
  census.classes[cellClass(kind[k], period[k])] += 1;
  if (kind[k] < 0 || kind[k] > MAP_KIND.unsymmetric) return;
  census.groups[periodGroup(period[k])] += 1;
}

/** Return the upper end of the colours of the peak: few cells are above. @param {Tile} cells */
export function peakEnd({ kind, highest, lowest }) {
  const below = PEAK_ENDS.map(() => 0);
  let count = 0;
  for (let k = 0; k < kind.length; k += 1) {
    if (kind[k] < 0 || kind[k] > MAP_KIND.unsymmetric) continue;
    const peak = peakOf(highest[k], lowest[k]);
    count += 1;
    for (let j = PEAK_ENDS.length - 1; j >= 0 && peak <= PEAK_ENDS[j]; j -= 1) below[j] += 1;
  }
  const found = below.findIndex((cells) => cells >= PEAK_PART * count);
  return PEAK_ENDS[found < 0 || !count ? PEAK_ENDS.length - 1 : found];
}
