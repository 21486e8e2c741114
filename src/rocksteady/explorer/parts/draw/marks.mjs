// What stands in a frame: curves, points, edges of regions, hatched areas, labels and legends.

import { classSwatch, hatchBox } from './classes.mjs';

/** @typedef {import('./classes.mjs').Box} Box */
/** @typedef {import('./classes.mjs').MotionClass} MotionClass */
/** @typedef {import('./frame.mjs').Frame} Frame */
/** @typedef {import('./svg.mjs').Pen} Pen */
/** @typedef {import('./theme.mjs').Theme} Theme */

/**
 * @typedef {object} LineStyle
 * @property {string} [colour]
 * @property {number} [width]  [px]
 * @property {number[]} [dash]  [px]
 * @property {string} [casing]  colour of a wider line beneath
 * @property {number} [alpha]
 */

/**
 * `step` draws the value of a sample up to the next one.
 * @typedef {LineStyle & { step?: boolean }} CurveStyle
 */

/**
 * @typedef {object} PointStyle
 * @property {string} [colour]
 * @property {number} [radius]  [px]
 * @property {MarkKind} [mark]
 * @property {string} [casing]  colour of an outline
 * @property {number} [alpha]
 */

/**
 * @typedef {object} NoteStyle
 * @property {string} [colour]
 * @property {'left' | 'center' | 'right'} [align]
 * @property {string} [font]
 * @property {boolean} [boxed]  on a box of paper, over fills
 */

/** @typedef {'dot' | 'ring' | 'square' | 'diamond' | 'triangle' | 'cross' | 'plus'} MarkKind */

/**
 * @typedef {object} LegendEntry
 * @property {string} label
 * @property {string} [colour]
 * @property {number[]} [dash]
 * @property {MarkKind} [mark]
 * @property {MotionClass} [fill]
 */

/**
 * Edges of regions: a fold has long dashes, a flip short ones, a grazing dots.
 * @typedef {'fold' | 'flip' | 'grazing'} EdgeKind
 */

/** @type {Readonly<Record<EdgeKind, number[]>>} */
export const EDGE_DASHES = { fold: [12, 3], flip: [7, 4], grazing: [1.5, 3.5] };

const CASING = 2.4; // [px] more than the line
const FAR = 1e5; // [px] no coordinate lies farther out

/**
 * Draw inside the box of a frame only.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {() => void} draw
 */
export function clipped(pen, { box }, draw) {
  pen.save();
  pen.beginPath();
  pen.rect(box.left, box.top, box.width, box.height);
  pen.clip();
  draw();
  pen.restore();
}

/**
 * Draw a curve; it has a gap where a value is not finite.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {ArrayLike<number>} xs
 * @param {ArrayLike<number>} ys
 * @param {CurveStyle} [style]
 */
export function curve(pen, onto, xs, ys, { step = false, ...style } = {}) {
  clipped(pen, onto, () => {
    pen.beginPath();
    traceCurve(pen, onto, xs, ys, step);
    strokePath(pen, { colour: onto.theme.motion, ...style });
  });
}

/**
 * Draw an edge of a region over fills, in the dash of its kind.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {ArrayLike<number>} xs
 * @param {ArrayLike<number>} ys
 * @param {EdgeKind} [kind]
 */
export function edge(pen, onto, xs, ys, kind = 'fold') {
  const { limit, paper } = onto.theme;
  curve(pen, onto, xs, ys, { colour: limit, casing: paper, width: 1.6, dash: EDGE_DASHES[kind] });
}

/**
 * Draw points that have finite coordinates; small dots, as of a sweep, are squares for speed.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {ArrayLike<number>} xs
 * @param {ArrayLike<number>} ys
 * @param {PointStyle} [style]
 */
export function points(pen, onto, xs, ys, style = {}) {
  const { colour = onto.theme.motion, radius = 3, mark = 'dot', casing, alpha = 1 } = style;
  clipped(pen, onto, () => {
    pen.globalAlpha = alpha;
    pen.fillStyle = colour;
    for (let k = 0; k < xs.length; k++) {
      const [x, y] = [onto.x.at(xs[k]), onto.y.at(ys[k])];
      if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
      if (radius < 1.5 && mark === 'dot') {
        pen.fillRect(x - radius, y - radius, 2 * radius, 2 * radius);
      } else drawMark(pen, mark, x, y, { colour, radius, casing });
    }
  });
}

/**
 * Draw one mark at a pixel.
 * @param {Pen} pen
 * @param {MarkKind} mark
 * @param {number} x  [px]
 * @param {number} y  [px]
 * @param {{ colour: string, radius?: number, casing?: string }} style
 */
export function drawMark(pen, mark, x, y, { colour, radius = 4, casing }) {
  const r = radius;
  pen.save();
  pen.setLineDash([]);
  pen.beginPath();
  if (mark === 'dot' || mark === 'ring') {
    pen.moveTo(x + r, y);
    pen.arc(x, y, r, 0, 2 * Math.PI);
  } else if (mark === 'square') pen.rect(x - r, y - r, 2 * r, 2 * r);
  else {
    const corners = { diamond: [[0, -1.2], [1.2, 0], [0, 1.2], [-1.2, 0]],
      triangle: [[0, -1.2], [1.1, 0.8], [-1.1, 0.8]],
      cross: [[-1, -1], [1, 1], [-1, 1], [1, -1]],
      plus: [[-1.2, 0], [1.2, 0], [0, -1.2], [0, 1.2]] }[mark];
    const open = mark === 'cross' || mark === 'plus';
    corners.forEach(([dx, dy], k) => {
      if (open ? k % 2 === 0 : k === 0) pen.moveTo(x + r * dx, y + r * dy);
      else pen.lineTo(x + r * dx, y + r * dy);
    });
    if (!open) pen.closePath();
  }
  const stroked = mark === 'ring' || mark === 'cross' || mark === 'plus';
  const width = stroked ? 2 : 0;
  if (casing) {
    pen.strokeStyle = casing;
    pen.lineWidth = width + CASING;
    pen.stroke();
  }
  if (stroked) {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.stroke();
  } else {
    pen.fillStyle = colour;
    pen.fill();
  }
  pen.restore();
}

/**
 * Draw what may be dragged: a disc of paper with a ring of ink.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {number} x  [px]
 * @param {number} y  [px]
 */
export function drawHandle(pen, { ink, paper }, x, y) {
  drawMark(pen, 'dot', x, y, { colour: ink, radius: 8.5, casing: paper });
  drawMark(pen, 'dot', x, y, { colour: paper, radius: 5.5 });
}

/**
 * Fill the area between two curves over the same xs, or hatch it.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {ArrayLike<number>} xs
 * @param {ArrayLike<number>} lows
 * @param {ArrayLike<number>} highs
 * @param {{ fill?: string, hatch?: string, every?: number, alpha?: number }} style  `hatch` is the
 *   colour of the lines
 */
export function area(pen, onto, xs, lows, highs, { fill, hatch, every, alpha = 1 }) {
  clipped(pen, onto, () => {
    pen.beginPath();
    // One closed part for each run of finite values.
    for (let k = 0; k < xs.length; k++) {
      const first = k;
      while (k < xs.length && Number.isFinite(xs[k] + lows[k] + highs[k])) k++;
      for (let j = first; j < k; j++) tracePoint(pen, onto, xs[j], lows[j], j === first);
      for (let j = k - 1; j >= first; j--) tracePoint(pen, onto, xs[j], highs[j], false);
      if (k > first) pen.closePath();
    }
    pen.globalAlpha = alpha;
    if (fill) {
      pen.fillStyle = fill;
      pen.fill();
    }
    if (hatch) {
      pen.clip();
      hatchBox(pen, onto.box, { colour: hatch, every });
    }
  });
}

/**
 * Draw a straight line across the box at a value.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {{ x?: number, y?: number }} at
 * @param {LineStyle} [style]
 */
export function rule(pen, onto, { x, y }, style = {}) {
  const { box, theme } = onto;
  clipped(pen, onto, () => {
    pen.beginPath();
    if (x !== undefined) {
      pen.moveTo(onto.x.at(x), box.top);
      pen.lineTo(onto.x.at(x), box.top + box.height);
    }
    if (y !== undefined) {
      pen.moveTo(box.left, onto.y.at(y));
      pen.lineTo(box.left + box.width, onto.y.at(y));
    }
    strokePath(pen, { colour: theme.edge, width: 1, ...style });
  });
}

/**
 * Write a text at a pixel inside the box, on a halo of paper; it is moved to stay inside.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {string} text
 * @param {number} x  [px]
 * @param {number} y  [px]
 * @param {NoteStyle} [style]
 */
export function note(pen, onto, text, x, y, style = {}) {
  const { box, theme } = onto;
  const { colour = theme.ink, align = 'center', font = theme.small } = style;
  pen.save();
  pen.font = font;
  const { width } = pen.measureText(text);
  const wanted = x - { left: 0, center: 0.5, right: 1 }[align] * width;
  const left = Math.max(box.left + 3, Math.min(box.left + box.width - 3 - width, wanted));
  const middle = Math.max(box.top + 8, Math.min(box.top + box.height - 8, y));
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  if (style.boxed) {
    pen.fillStyle = theme.paper;
    pen.fillRect(left - 4, middle - 9, width + 8, 18);
  }
  pen.lineJoin = 'round';
  pen.setLineDash([]);
  pen.lineWidth = 3.5;
  pen.strokeStyle = theme.paper;
  pen.strokeText(text, left, middle);
  pen.fillStyle = colour;
  pen.fillText(text, left, middle);
  pen.restore();
}

/**
 * Write a label on a curve, at a part of its points inside the box.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {ArrayLike<number>} xs
 * @param {ArrayLike<number>} ys
 * @param {string} text
 * @param {{ colour?: string, part?: number, above?: number }} [style]  `part` from 0 to 1
 */
export function lineLabel(pen, onto, xs, ys, text, { colour, part = 0.5, above = 0 } = {}) {
  const { box } = onto;
  const inside = [];
  for (let k = 0; k < xs.length; k++) {
    const [x, y] = [onto.x.at(xs[k]), onto.y.at(ys[k])];
    if (x >= box.left && x <= box.left + box.width && y >= box.top && y <= box.top + box.height) {
      inside.push([x, y]);
    }
  }
  if (!inside.length) return;
  const at = Math.min(inside.length - 1, Math.floor(part * inside.length)), [x, y] = inside[at];
  const falls = (inside[at + 1] ?? inside[at])[1] > y; // the words stand on the side that is free
  note(pen, onto, text, falls ? x + 4 : x - 4, y - above, { colour, align: falls ? 'left' : 'right' });
}

/**
 * Draw a legend in a corner of the box, on paper.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {LegendEntry[]} entries
 * @param {{ corner?: 'top-left' | 'top-right' | 'bottom-left' | 'bottom-right' }} [options]
 */
export function legend(pen, onto, entries, { corner = 'top-right' } = {}) {
  if (!entries.length) return;
  const { box, theme } = onto;
  const [line, swatch, gap] = [16, 22, 6];
  pen.save();
  pen.setLineDash([]);
  pen.font = theme.small;
  const widest = Math.max(...entries.map(({ label }) => pen.measureText(label).width));
  const [width, height] = [widest + swatch + 3 * gap, entries.length * line + gap];
  const left = corner.endsWith('left') ? box.left + gap : box.left + box.width - width - gap;
  const top = corner.startsWith('top') ? box.top + gap : box.top + box.height - height - gap;
  pen.globalAlpha = 0.88;
  pen.fillStyle = theme.paper;
  pen.fillRect(left, top, width, height);
  pen.globalAlpha = 1;
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  entries.forEach(({ label, colour = theme.ink, dash, mark, fill }, k) => {
    const [x, y] = [left + gap, top + gap / 2 + (k + 0.5) * line];
    if (fill) classSwatch(pen, theme, fill, { left: x, top: y - 6, width: swatch, height: 12 });
    else if (mark) drawMark(pen, mark, x + swatch / 2, y, { colour });
    else {
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + swatch, y);
      strokePath(pen, { colour, width: 2, dash });
    }
    pen.fillStyle = theme.ink;
    pen.fillText(label, x + swatch + gap, y);
  });
  pen.restore();
}

/**
 * Stroke the present path, its casing first.
 * @param {Pen} pen
 * @param {LineStyle & { colour: string }} style
 */
function strokePath(pen, { colour, width = 1.5, dash = [], casing, alpha = 1 }) {
  pen.save();
  pen.lineJoin = 'round';
  pen.globalAlpha = alpha;
  if (casing) {
    pen.setLineDash([]);
    pen.strokeStyle = casing;
    pen.lineWidth = width + CASING;
    pen.stroke();
  }
  pen.setLineDash(dash);
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
  pen.restore();
}

/**
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {ArrayLike<number>} xs
 * @param {ArrayLike<number>} ys
 * @param {boolean} step
 */
function traceCurve(pen, onto, xs, ys, step) {
  let open = false;
  for (let k = 0; k < xs.length; k++) {
    const there = tracePoint(pen, onto, xs[k], ys[k], !open);
    if (there && step && k + 1 < xs.length) tracePoint(pen, onto, xs[k + 1], ys[k], false);
    open = there;
  }
}

/**
 * Move or draw a line to a point; return whether it is finite.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {number} x
 * @param {number} y
 * @param {boolean} first
 */
function tracePoint(pen, onto, x, y, first) {
  const [across, down] = [onto.x.at(x), onto.y.at(y)];
  if (!Number.isFinite(across) || !Number.isFinite(down)) return false;
  const [left, top] = [Math.max(-FAR, Math.min(FAR, across)), Math.max(-FAR, Math.min(FAR, down))];
  if (first) pen.moveTo(left, top);
  else pen.lineTo(left, top);
  return true;
}
