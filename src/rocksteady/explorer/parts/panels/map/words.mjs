// What the cells of the map are called, and the classes, colours and legend that show them.

/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { MotionClass } from '../../draw/classes.mjs' */
import { CLASS_WORDS, MOTION_CLASSES, classSwatch } from '../../draw/classes.mjs';
import { numeral } from '../../draw/scale.mjs';
import { MAP_KIND } from '../../physics/tiles.mjs';

/** @typedef {'kind' | 'period' | 'peak'} MapColouring */

/** Which steady states a region holds, in few words (`dynamics/steady/regions.py`). */
export const REGION_WORDS = ['', 'an out-of-phase and an in-phase solution',
  'an out-of-phase solution', 'two in-phase solutions', 'no symmetric solution',
  'two in-phase solutions, one inadmissible'];

/** Colours of viridis, from low to high. */
const VIRIDIS = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779',
  '#6ece58', '#b5de2b', '#fde725'];
const PERIOD_GROUPS = ['1', '2', '3', '4', '5', '6–8', '≥ 9']; // forcing periods
const SHARE_WIDTH = 48; // [px] of the widest share
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

/**
 * Return the number of a group of periods.
 * @param {number} period  1 or more
 */
export function periodGroup(period) {
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
 * Return a colour of the field at a part from 0 to 1, as red, green and blue.
 * @param {number} part
 * @returns {[number, number, number]}
 */
export function fieldColour(part) {
  const at = Math.min(1, Math.max(0, part)) * (VIRIDIS.length - 1);
  const k = Math.min(VIRIDIS.length - 2, Math.floor(at));
  const [low, high] = [VIRIDIS[k], VIRIDIS[k + 1]].map((text) =>
    [1, 3, 5].map((place) => parseInt(text.slice(place, place + 2), 16)));
  const mixed = low.map((value, place) => Math.round(value + (at - k) * (high[place] - value)));
  return [mixed[0], mixed[1], mixed[2]];
}

/** Return the colour of a group of periods. @param {number} group */
export function groupColour(group) {
  return fieldColour(group / (PERIOD_GROUPS.length - 1));
}

/**
 * Return what a cell settles to, in words.
 * @param {{ kind: number, period: number, impacts: number, highest: number, lowest: number }} cell
 * @param {(peak: number) => string} angle  how an angle is written
 */
export function cellWords(cell, angle) {
  const { kind, period, impacts, highest, lowest } = cell;
  const name = MOTION_CLASSES[cellClass(kind, period)];
  if (!(period > 0) || kind > MAP_KIND.unsymmetric) {
    return name === 'no-start' ? 'no steady state to start on' : CLASS_WORDS[name];
  }
  const shape = kind === MAP_KIND.symmetric ? 'symmetric' : 'unsymmetric';
  const many = impacts < 0 ? 'chatter' : `${impacts} impacts`;
  return `${shape}, period ${period}, ${many}, peak ${angle(peakOf(highest, lowest))}`;
}

/**
 * @typedef {object} MapEntry
 * @property {string} label
 * @property {MotionClass} [name]  with the pattern of this class
 * @property {[number, number, number]} [colour]
 * @property {number} share  of the cells, from 0 to 1
 */

/**
 * Return the entries of the legend; which and how many does not depend on the cells.
 * @param {MapColouring} by
 * @param {boolean} steady  whether cells may have no start
 * @param {{ classes: number[], groups: number[], count: number }} census
 * @returns {MapEntry[]}
 */
export function legendEntries(by, steady, { classes, groups, count }) {
  const part = (/** @type {number} */ cells) => (count ? cells / count : 0);
  /** @type {MotionClass[]} */
  const orbits = ['symmetric', 'unsymmetric', 'subharmonic'];
  const inClass = (/** @type {MotionClass} */ name) => classes[MOTION_CLASSES.indexOf(name)];
  const entry = (/** @type {MotionClass} */ name) =>
    ({ name, label: CLASS_WORDS[name], share: part(inClass(name)) });
  /** @type {MotionClass[]} */
  const others = ['aperiodic', 'overturned', 'undecided'];
  if (steady) others.push('no-start');
  const middle = by === 'kind' ? orbits.map(entry) : by === 'peak' ? []
    : PERIOD_GROUPS.map((label, k) =>
      ({ label: `period ${label}`, colour: groupColour(k), share: part(groups[k]) }));
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
  const slot = LEGEND_SWATCH + 5 + widest + SHARE_WIDTH;
  const columns = Math.max(1, Math.min(entries.length, Math.floor(width / slot)));
  const rows = Math.ceil(entries.length / columns);
  return { columns: Math.ceil(entries.length / rows), rows, height: rows * LEGEND_LINE + 4 };
}

/**
 * Draw the legend with the shares of the classes.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {MapEntry[]} entries
 * @param {{ left: number, top: number, width: number }} at
 * @param {boolean} known  whether there are shares
 */
export function drawMapLegend(pen, theme, entries, { left, top, width }, known) {
  pen.save();
  pen.font = theme.small;
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  const { columns } = legendShape(pen, entries, width);
  const slot = width / columns;
  entries.forEach(({ label, name, colour, share }, k) => {
    const x = Math.round(left + (k % columns) * slot);
    const y = top + (Math.floor(k / columns) + 0.5) * LEGEND_LINE;
    const box = { left: x, top: Math.round(y) - 6, width: LEGEND_SWATCH, height: 12 };
    if (name) classSwatch(pen, theme, name, box);
    else if (colour) swatch(pen, theme, colour, box);
    pen.fillStyle = theme.ink;
    pen.fillText(label, x + LEGEND_SWATCH + 5, y);
    if (!known) return;
    pen.fillStyle = theme.number;
    pen.fillText(shareWords(share), x + LEGEND_SWATCH + 10 + pen.measureText(label).width, y);
  });
  pen.restore();
}

/** @param {number} share */
export function shareWords(share) {
  if (share === 0) return '0 %';
  return share < 0.001 ? '< 0.1 %' : `${numeral(100 * share, share < 0.0995 ? 2 : 3)} %`;
}

/**
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {[number, number, number]} colour
 * @param {{ left: number, top: number, width: number, height: number }} box
 */
function swatch(pen, theme, colour, { left, top, width, height }) {
  pen.fillStyle = `rgb(${colour.join(' ')})`;
  pen.fillRect(left, top, width, height);
  pen.strokeStyle = theme.faint;
  pen.lineWidth = 1;
  pen.strokeRect(left + 0.5, top + 0.5, width - 1, height - 1);
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
  const steps = 64;
  for (let k = 0; k < steps; k += 1) {
    const from = Math.round(x + (length * k) / steps);
    pen.fillStyle = `rgb(${fieldColour((k + 0.5) / steps).join(' ')})`;
    pen.fillRect(from, y - 6, Math.round(x + (length * (k + 1)) / steps) - from, 12);
  }
  pen.strokeStyle = theme.faint;
  pen.lineWidth = 1;
  pen.strokeRect(Math.round(x) + 0.5, Math.round(y - 6) + 0.5, Math.round(length) - 1, 11);
  pen.fillStyle = theme.ink;
  pen.fillText(ends[1], x + length + 5, y);
  pen.restore();
}
