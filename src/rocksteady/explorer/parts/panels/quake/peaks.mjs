// A chart of peak tilts over sizes or scales, hatched where the block falls.

/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { Axis, Frame } from '../../draw/frame.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { MotionClass } from '../../draw/classes.mjs' */
/** @import { FateSeries } from './shaken.mjs' */
import { fillClass } from '../../draw/classes.mjs';
import { frame, outline } from '../../draw/frame.mjs';
import { clipped, curve, drawHandle, note, rule } from '../../draw/marks.mjs';
import { NOT_COMPUTED } from './shaken.mjs';

const HIGHEST_SHOWN = 1.15; // theta/alpha

/**
 * Draw the chart; return its frame.
 * @param {Pen} pen
 * @param {{ width: number, height: number }} size
 * @param {{ theme: Theme, x: Axis, degrees: number, series: FateSeries | null, at: number,
 *   label: string, peak: number | null }} given  the value and the peak of the block itself
 * @returns {Frame}
 */
export function drawPeaks(pen, size, { theme, x, degrees, series, at, label, peak }) {
  const { near, far } = theme.units.peak, onto = frame(pen, size, {
    theme, x,
    y: { from: 0, to: HIGHEST_SHOWN * degrees, label: `${near}; hatched: ${theme.words.overturned}`, far: { factor: degrees, label: far } },
  });
  const { box } = onto;
  if (series) {
    const { values, status, peak: peaks } = computedOf(series);
    clipped(pen, onto, () => {
      for (const { from, to, name } of bandsOf(values, status)) {
        const left = onto.x.at(from), width = onto.x.at(to) - left;
        fillClass(pen, theme, name, { left, top: box.top, width, height: box.height });
      }
    });
    curve(pen, onto, values, peaks.map((value, k) => (isStanding(status[k]) ? value * degrees : NaN)),
      { width: 2 });
  }
  rule(pen, onto, { y: degrees }, { colour: theme.limit, dash: [6, 4], width: 1.2 });
  note(pen, onto, 'α', box.left + 8, onto.y.at(degrees) - 9);
  rule(pen, onto, { x: at }, { colour: theme.ink, width: 2, casing: theme.paper });
  if (peak !== null) {
    const y = onto.y.at(Math.min(peak, HIGHEST_SHOWN) * degrees);
    drawHandle(pen, theme, onto.x.at(at), y);
  }
  const right = onto.x.at(at) < box.left + 0.6 * box.width;
  note(pen, onto, label, onto.x.at(at) + (right ? 12 : -12), box.top + box.height - 12,
    { align: right ? 'left' : 'right', font: theme.strong, boxed: true });
  outline(pen, onto);
  return onto;
}

/**
 * Return what is computed of a series, where that is enough to be drawn; else all of it.
 * @param {FateSeries} series
 */
function computedOf({ values, status, peak, done }) {
  if (done === values.length || done < values.length / 8) return { values, status, peak };
  const known = Array.from(values.keys()).filter((k) => status[k] !== NOT_COMPUTED);
  return {
    values: Float64Array.from(known, (k) => values[k]), status: Uint8Array.from(known, (k) => status[k]),
    peak: Float64Array.from(known, (k) => peak[k]),
  };
}

/** @param {number} code */
function isStanding(code) {
  return code === 0 || code === 1;
}

/**
 * Return the stretches that are no curve: it falls, is undecided, or not computed yet.
 * @param {Float64Array} values
 * @param {Uint8Array} status
 * @returns {{ from: number, to: number, name: MotionClass }[]}
 */
function bandsOf(values, status) {
  /** @type {{ from: number, to: number, name: MotionClass }[]} */
  const bands = [];
  /** @type {MotionClass | null} */
  let open = null;
  const edgeBefore = (/** @type {number} */ k) => (k === 0 ? values[0] : (values[k - 1] + values[k]) / 2);
  for (let k = 0; k <= values.length; k++) {
    const code = status[k];
    const name = k === values.length || isStanding(code) ? null
      : code === 2 ? 'overturned' : code === NOT_COMPUTED ? 'not-computed' : 'undecided';
    if (open && name !== open) bands[bands.length - 1].to = k < values.length ? edgeBefore(k) : values[k - 1];
    if (name && name !== open) bands.push({ from: edgeBefore(k), to: NaN, name });
    open = name;
  }
  return bands;
}
