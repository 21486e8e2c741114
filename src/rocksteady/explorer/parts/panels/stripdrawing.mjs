// The picture of the bifurcation strip: curves in closed form, dots of both sweeps, lanes of fates.

/** @import { Pen } from '../draw/svg.mjs' */
/** @import { Theme } from '../draw/theme.mjs' */
/** @import { Frame } from '../draw/frame.mjs' */
/** @import { MotionClass } from '../draw/classes.mjs' */
/** @import { StripRun, StripView, Sweep } from './stripline.mjs' */
import { classSwatch, fillClass } from '../draw/classes.mjs';
import { frame } from '../draw/frame.mjs';
import { clipped, curve, drawMark, lineLabel, rule } from '../draw/marks.mjs';
import { mixed } from '../draw/theme.mjs';
import { motionWords } from '../words.mjs';

const STRIP_LANE = 9; // [px]
const STRIP_DOTS = [2.6, 1.7]; // radius [px]: the larger of the upward sweep shows around the other
const CLOUD_PEAKS = 32; // more are drawn as small squares
const STRIP_HANDLE = 9; // [px] above the box
const FLOW_LINE = 16, FLOW_SWATCH = 16;
/** Fates that have no dots of their own, in lanes along the upper edge. @type {MotionClass[]} */
const STRIP_FATES = ['overturned', 'rest', 'undecided'];

/**
 * An entry of a legend in rows.
 * @typedef {object} FlowEntry
 * @property {string} label
 * @property {string} [colour]  of a dot, or of a line with `dash`
 * @property {number[]} [dash]
 * @property {number} [radius]
 * @property {MotionClass} [fill]
 */

/**
 * Draw the strip and return its frame.
 * @param {Pen} pen
 * @param {{ width: number, height: number }} size
 * @param {Theme} theme
 * @param {StripView} view
 * @returns {Frame}
 */
export function drawStrip(pen, size, theme, view) {
  const { run, closed, units, window, stale } = view;
  pen.font = theme.font;
  const indent = pen.measureText(units.angleLabel).width + 24; // behind the label of the axis
  pen.font = theme.small;
  const entries = stripEntries(theme, view);
  const top = FLOW_LINE * flowRows(pen, entries, size.width - 8, indent) + STRIP_HANDLE + 4;
  const highest = highestDrawn(view);
  const inside = Math.max(40, size.height - top - 40);
  const room = Math.min(0.4, (2 * STRIP_LANE + 10) / inside);
  const [low, high] = [-0.03 * highest * units.y, (highest / (1 - room)) * units.y];
  const { from, to, log } = window;
  const onto = frame(pen, size, {
    theme,
    x: { from: from * units.x, to: to * units.x, log, label: units.label },
    y: { from: low, to: high, label: units.angleLabel },
    margin: { top, right: 40 },
  });
  flowLegend(pen, theme, entries, { left: 4, top: 1, width: size.width - 8, indent });
  clipped(pen, onto, () => {
    if (closed) drawClosed(pen, onto, view);
    pen.globalAlpha = stale ? 0.3 : 1;
    if (run && run.by === view.by) {
      run.sweeps.forEach((sweep, k) => drawDots(pen, onto, view, run, sweep, k));
    }
    pen.globalAlpha = 1;
  });
  if (closed) labelClosed(pen, onto, view);
  drawLanes(pen, onto, view);
  drawPoint(pen, onto, view);
  return onto;
}

/** @param {StripView} view */
function highestDrawn({ run, closed, by }) {
  let highest = 0.05;
  for (const sweep of run && run.by === by ? run.sweeps : []) {
    for (const peaks of sweep.peaks) {
      for (const u of peaks) highest = Math.max(highest, Math.abs(u));
    }
  }
  for (const { peaks, stable } of closed?.curves ?? []) {
    peaks.forEach((peak, k) => { if (stable[k]) highest = Math.max(highest, peak); });
  }
  return 1.04 * highest;
}

/** Return the colour of the dots of a sweep: pale beneath, strong above. @param {Theme} theme @param {number} number */
function sweepColour({ motion, paper }, number) {
  return number === 0 ? mixed(motion, paper, 0.5) : motion;
}

/** @param {Theme} theme @param {number} order */
function orderColour(theme, order) {
  return order === 1 ? theme.motion : theme.subharmonicLine;
}

/** @param {Pen} pen @param {Frame} onto @param {StripView} view */
function drawClosed(pen, onto, { closed, units }) {
  if (!closed) return;
  const xs = closed.values.map((value) => value * units.x);
  for (const { order, peaks, stable } of closed.curves) {
    const colour = orderColour(onto.theme, order);
    for (const holds of [0, 1]) {
      // A part reaches to the first point of the next one.
      const ys = Float64Array.from(peaks, (peak, k) => {
        const joins = holds === 0 && k > 0 && stable[k - 1] === 0;
        return stable[k] === holds || joins ? peak * units.y : NaN;
      });
      curve(pen, onto, xs, ys, { colour, width: holds ? 2 : 1.2, dash: holds ? [] : [5, 4] });
    }
  }
}

/** @param {Pen} pen @param {Frame} onto @param {StripView} view */
function labelClosed(pen, onto, { closed, units }) {
  if (!closed) return;
  const xs = closed.values.map((value) => value * units.x);
  for (const { order, branch, peaks, stable } of closed.curves) {
    if (branch !== 1 || !stable.some((holds) => holds)) continue;
    const ys = Float64Array.from(peaks, (peak, k) => (stable[k] ? peak * units.y : NaN));
    const text = motionWords({ kind: 'symmetric', period: order }).replace(/^rocks,? /, '');
    const part = order === 1 ? 0.3 : 0.6; // apart where the curves are close
    lineLabel(pen, onto, xs, ys, text,
      { colour: orderColour(onto.theme, order), part, above: 12 });
  }
}

/**
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {StripView} view
 * @param {StripRun} run
 * @param {Sweep} sweep
 * @param {number} number
 */
function drawDots(pen, onto, { units }, run, sweep, number) {
  const last = run.values.length - 1, radius = STRIP_DOTS[number];
  pen.fillStyle = sweepColour(onto.theme, number);
  pen.beginPath();
  sweep.kinds.forEach((kind, step) => {
    const place = sweep.way === 'up' ? step : last - step;
    const x = onto.x.at(run.values[place] * units.x);
    const peaks = kind === 'rest' ? [0] : sweep.peaks[step];
    for (const u of peaks) {
      const y = onto.y.at(Math.abs(u) * units.y);
      if (peaks.length > CLOUD_PEAKS) pen.rect(x - 0.7, y - 0.7, 1.4, 1.4);
      else {
        pen.moveTo(x + radius, y);
        pen.arc(x, y, radius, 0, 2 * Math.PI);
      }
    }
  });
  pen.fill();
}

/**
 * Draw a lane a sweep along the upper edge: where it falls, comes to rest, is undecided, or is
 * not computed yet.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {StripView} view
 */
function drawLanes(pen, onto, { run, stale, units, by }) {
  const { box, theme, x } = onto;
  ['up', 'down'].forEach((name, number) => {
    const top = box.top + 3 + number * (STRIP_LANE + 2);
    pen.font = theme.small;
    pen.textAlign = 'left';
    pen.textBaseline = 'middle';
    pen.fillStyle = theme.quiet;
    pen.fillText(name, box.left + box.width + 4, top + STRIP_LANE / 2);
    const sweep = run?.by === by ? run.sweeps[number] : undefined;
    const fates = Array.from(run && sweep ? run.values : [0], (_, place) => {
      const kind = sweep?.kinds[sweep.way === 'up' ? place : (run?.values.length ?? 1) - 1 - place];
      return kind === undefined ? 'not-computed' : kind;
    });
    clipped(pen, onto, () => {
      pen.globalAlpha = stale ? 0.4 : 1;
      for (let first = 0, end = 0; first < fates.length; first = end) {
        while (end < fates.length && fates[end] === fates[first]) end += 1;
        const fate = /** @type {MotionClass} */ (fates[first]);
        if (!STRIP_FATES.includes(fate) && fate !== 'not-computed') continue;
        const edge = (/** @type {number} */ place) => run && place > 0 && place < fates.length
          ? 0.5 * (x.at(run.values[place - 1] * units.x) + x.at(run.values[place] * units.x))
          : box.left + (place ? box.width : 0);
        const [left, right] = [edge(first), edge(end)];
        const area = { left, top, width: Math.max(1, right - left), height: STRIP_LANE };
        fillClass(pen, theme, fate, area);
        pen.strokeStyle = theme.edge;
        pen.lineWidth = 0.7;
        pen.strokeRect(area.left, area.top, area.width, area.height);
      }
    });
  });
}

/** @param {Pen} pen @param {Frame} onto @param {StripView} view */
function drawPoint(pen, onto, { state, by, units, hovered, run, present }) {
  const { theme } = onto, here = by === 'w' ? state.W : state.A;
  if (hovered !== null && run) {
    rule(pen, onto, { x: run.values[hovered] * units.x }, { colour: theme.edge, dash: [2, 3] });
  }
  rule(pen, onto, { x: here * units.x }, { colour: theme.ink, width: 1.4, casing: theme.paper });
  const left = onto.x.at(here * units.x), { box } = onto;
  if (!(left >= box.left - 1 && left <= box.left + box.width + 1)) return;
  for (const peak of present) {
    const y = onto.y.at(Math.abs(peak) * units.y);
    drawMark(pen, 'ring', left, y, { colour: theme.ink, radius: 5, casing: theme.paper });
  }
  // The handle by which the point is dragged.
  pen.beginPath();
  pen.moveTo(left - 6, box.top - STRIP_HANDLE);
  pen.lineTo(left + 6, box.top - STRIP_HANDLE);
  pen.lineTo(left, box.top);
  pen.closePath();
  pen.fillStyle = theme.ink;
  pen.fill();
}

/** @param {Theme} theme @param {StripView} view @returns {FlowEntry[]} */
function stripEntries(theme, { run, closed }) {
  /** @type {FlowEntry[]} */
  const entries = [
    { label: 'upward, from rest', colour: sweepColour(theme, 0), radius: STRIP_DOTS[0] + 0.6 },
    {
      label: 'downward, from the steady state',
      colour: sweepColour(theme, 1),
      radius: STRIP_DOTS[1] + 0.9,
    },
  ];
  const met = new Set((run?.sweeps ?? []).flatMap(({ kinds }) => kinds));
  for (const fate of STRIP_FATES) {
    if (met.has(fate)) entries.push({ label: theme.words[fate], fill: fate });
  }
  if ((run?.sweeps ?? []).some(({ kinds }) => kinds.length < (run?.values.length ?? 0))) {
    entries.push({ label: theme.words['not-computed'], fill: 'not-computed' });
  }
  if (closed) {
    entries.push({ label: 'closed form, stable', colour: theme.motion, dash: [] },
      { label: 'unstable', colour: theme.motion, dash: [5, 4] });
  }
  return entries;
}

/** @param {Pen} pen @param {FlowEntry[]} entries @param {number} width @param {number} indent */
function flowPlaces(pen, entries, width, indent) {
  let left = indent, row = 0;
  return entries.map(({ label }) => {
    const wide = FLOW_SWATCH + 5 + pen.measureText(label).width + 14;
    if (left && left + wide - 14 > width) [left, row] = [0, row + 1];
    const place = { left, row };
    left += wide;
    return place;
  });
}

/**
 * Return the rows that a legend needs in the present font.
 * @param {Pen} pen
 * @param {FlowEntry[]} entries
 * @param {number} width
 * @param {number} indent  of the first row
 */
function flowRows(pen, entries, width, indent) {
  return Math.max(1, ...flowPlaces(pen, entries, width, indent).map(({ row }) => row + 1));
}

/**
 * Draw a legend in rows.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {FlowEntry[]} entries
 * @param {{ left: number, top: number, width: number, indent: number }} at
 */
function flowLegend(pen, theme, entries, at) {
  pen.save();
  pen.font = theme.small;
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  flowPlaces(pen, entries, at.width, at.indent).forEach(({ left, row }, k) => {
    const { label, colour = theme.ink, dash, radius = 3.5, fill } = entries[k];
    const [x, y] = [at.left + left, at.top + (row + 0.5) * FLOW_LINE];
    const swatch = { left: x, top: y - 5, width: FLOW_SWATCH, height: 10 };
    if (fill) classSwatch(pen, theme, fill, swatch);
    else if (dash) {
      pen.strokeStyle = colour;
      pen.lineWidth = 2;
      pen.setLineDash(dash);
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + FLOW_SWATCH, y);
      pen.stroke();
      pen.setLineDash([]);
    } else drawMark(pen, 'dot', x + FLOW_SWATCH / 2, y, { colour, radius });
    pen.fillStyle = theme.ink;
    pen.fillText(label, x + FLOW_SWATCH + 5, y);
  });
  pen.restore();
}
