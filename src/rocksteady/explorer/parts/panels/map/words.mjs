// What the cells of the map are called, and the classes, colours and legend that show them.

/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { ClassWords, Theme } from '../../draw/theme.mjs' */
/** @import { Look, MotionClass } from '../../draw/classes.mjs' */
/** @import { Tile } from '../../physics/tiles.mjs' */
import { MOTION_CLASSES, classLook, lookSwatch } from '../../draw/classes.mjs';
import { mixed } from '../../draw/theme.mjs';
import { MAP_KIND } from '../../physics/tiles.mjs';
import { motionName } from '../../words.mjs';

/** @typedef {'kind' | 'period' | 'peak'} MapColouring */

/** Which steady states a region holds, in few words (`dynamics/steady/regions.py`). */
export const REGION_WORDS = ['', 'an out-of-phase and an in-phase solution',
  'an out-of-phase solution', 'two in-phase solutions', 'no symmetric solution',
  'two in-phase solutions, one inadmissible'];

const PERIOD_GROUPS = ['1', '2', '3', '4', '5', '6–8', '≥ 9']; // forcing periods
const PEAK_STEPS = 5;
const LEGEND_GAP = 16; // [px]
const PEAK_ENDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5];
const PEAK_PART = 0.97; // of the cells whose peaks the colours tell apart
const LEGEND_LINE = 17;
const LEGEND_SWATCH = 18;

/**
 * Return the class of a cell, a number in MOTION_CLASSES.
 * @param {number} kind
 * @param {number} period
 */
export function cellClass(kind, period) {
  if (period > 1 && kind <= MAP_KIND.unsymmetric) return MOTION_CLASSES.indexOf('subharmonic');
  return CLASS_OF_KIND[kind] ?? MOTION_CLASSES.indexOf('not-computed');
}

/** @type {Record<number, number>} */
const CLASS_OF_KIND = Object.fromEntries([
  ...['symmetric', 'unsymmetric', 'rest', 'overturned', 'aperiodic', 'undecided']
    .map((name, code) => [code, MOTION_CLASSES.indexOf(/** @type {MotionClass} */ (name))]),
  [MAP_KIND.noStart, MOTION_CLASSES.indexOf('no-start')],
]);

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

/**
 * Return the number of a group of periods.
 * @param {number} period  1 or more
 */
function periodGroup(period) {
  return period <= 5 ? period - 1 : period <= 8 ? 5 : 6;
}

/**
 * Return the peak of an orbit; NaN without one.
 * @param {number} highest
 * @param {number} lowest
 */
export function peakOf(highest, lowest) {
  return Math.max(highest, -lowest);
}

/**
 * Return how a group of periods looks: the first as symmetric motion, longer ones as subharmonic.
 * @param {Theme} theme
 * @param {number} group
 * @returns {Look}
 */
function groupLook({ symmetric, subharmonic, paper, onRocks }, group) {
  if (group === 0) return { fill: symmetric };
  const part = (group - 1) / (PERIOD_GROUPS.length - 2); // from pale to dark
  return { fill: part < 0.6 ? mixed(subharmonic, paper, 0.75 - 1.25 * part)
    : mixed(subharmonic, onRocks, 1.6 * (part - 0.6)) };
}

/**
 * Return what cells look like by their numbers: classes, groups of periods, steps of the peak.
 * @param {Theme} theme
 * @returns {Look[]}
 */
export function mapLooks(theme) {
  return [...MOTION_CLASSES.map((name) => classLook(theme, name)),
    ...PERIOD_GROUPS.map((_, group) => groupLook(theme, group)),
    ...theme.rocksRamp.map((fill) => ({ fill }))];
}

/** Return the number of the look of a period. @param {number} period  1 or more */
export function periodLook(period) {
  return MOTION_CLASSES.length + periodGroup(period);
}

/** Return the number of the look of a part of the largest peak. @param {number} part */
export function peakLook(part) {
  const step = Math.min(PEAK_STEPS - 1, Math.max(0, Math.floor(part * PEAK_STEPS)));
  return MOTION_CLASSES.length + PERIOD_GROUPS.length + step;
}

/**
 * Return what a cell settles to, in words.
 * @param {{ kind: number, period: number, impacts: number, highest: number, lowest: number }} cell
 * @param {(peak: number) => string} angle  how an angle is written
 * @param {ClassWords} words
 */
export function cellWords(cell, angle, words) {
  const { kind, period, impacts, highest, lowest } = cell;
  const name = MOTION_CLASSES[cellClass(kind, period)];
  if (!(period > 0) || kind > MAP_KIND.unsymmetric) {
    return name === 'no-start' ? 'no steady state to start on' : words[name];
  }
  const shape = kind === MAP_KIND.symmetric ? 'symmetric' : 'unsymmetric';
  const many = impacts < 0 ? 'chatter' : `${impacts} impacts`;
  return `${motionName({ kind: shape, period })}, ${many}, peak ${angle(peakOf(highest, lowest))}`;
}

/**
 * @typedef {object} MapEntry
 * @property {string} label
 * @property {Look} look
 */

/**
 * Return the entries of the legend; which and how many does not depend on the cells.
 * @param {Theme} theme
 * @param {MapColouring} by
 * @param {boolean} steady  whether cells may have no start
 * @returns {MapEntry[]}
 */
export function legendEntries(theme, by, steady) {
  /** @type {MotionClass[]} */
  const orbits = ['symmetric', 'unsymmetric', 'subharmonic'];
  const entry = (/** @type {MotionClass} */ name) =>
    ({ look: classLook(theme, name), label: theme.words[name] });
  /** @type {MotionClass[]} */
  const others = ['aperiodic', 'overturned', 'undecided'];
  if (steady) others.push('no-start');
  const middle = by === 'kind' ? orbits.map(entry) : by === 'peak' ? []
    : PERIOD_GROUPS.map((label, k) =>
      ({ label: `period ${label}`, look: groupLook(theme, k) }));
  return [entry('rest'), ...middle, ...others.map(entry)];
}

/**
 * Return how many lines the legend takes.
 * @param {Pen} pen  with the font of the legend
 * @param {MapEntry[]} entries
 * @param {number} width  [px]
 */
export function legendShape(pen, entries, width) {
  const widest = Math.max(...entries.map(({ label }) => pen.measureText(label).width));
  const slot = LEGEND_SWATCH + 5 + widest + LEGEND_GAP;
  const columns = Math.max(1, Math.min(entries.length, Math.floor(width / slot)));
  const rows = Math.ceil(entries.length / columns);
  return { columns: Math.ceil(entries.length / rows), rows, height: rows * LEGEND_LINE + 4 };
}

/**
 * Draw the legend.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {MapEntry[]} entries
 * @param {{ left: number, top: number, width: number }} at
 */
export function drawMapLegend(pen, theme, entries, { left, top, width }) {
  pen.save();
  pen.font = theme.small;
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  const { columns } = legendShape(pen, entries, width);
  const slot = width / columns;
  entries.forEach(({ label, look }, k) => {
    const x = Math.round(left + (k % columns) * slot);
    const y = top + (Math.floor(k / columns) + 0.5) * LEGEND_LINE;
    const box = { left: x, top: Math.round(y) - 6, width: LEGEND_SWATCH, height: 12 };
    lookSwatch(pen, theme, look, box);
    pen.fillStyle = theme.ink;
    pen.fillText(label, x + LEGEND_SWATCH + 5, y);
  });
  pen.restore();
}

/**
 * Draw the bar of the colours of the peak.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {{ left: number, top: number, width: number }} at
 * @param {string} words
 * @param {string[]} ends  at the left and the right
 */
export function drawColourBar(pen, theme, { left, top, width }, words, ends) {
  pen.save();
  pen.font = theme.small;
  pen.textBaseline = 'middle';
  pen.textAlign = 'left';
  pen.fillStyle = theme.ink;
  const y = top + LEGEND_LINE / 2;
  pen.fillText(words, left, y);
  let x = left + pen.measureText(words).width + 8;
  pen.fillText(ends[0], x, y);
  x += pen.measureText(ends[0]).width + 5;
  const last = pen.measureText(ends[1]).width + 5;
  const length = Math.max(24, Math.min(220, left + width - last - x));
  theme.rocksRamp.forEach((fill, k, { length: steps }) => {
    const from = Math.round(x + (length * k) / steps);
    pen.fillStyle = fill;
    pen.fillRect(from, y - 6, Math.round(x + (length * (k + 1)) / steps) - from, 12);
  });
  pen.strokeStyle = theme.edge;
  pen.lineWidth = 1;
  pen.strokeRect(Math.round(x) + 0.5, Math.round(y - 6) + 0.5, Math.round(length) - 1, 11);
  pen.fillStyle = theme.ink;
  pen.fillText(ends[1], x + length + 5, y);
  pen.restore();
}
