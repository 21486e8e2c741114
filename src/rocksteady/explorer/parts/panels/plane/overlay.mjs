// What is drawn over a plane while it is touched: the point, a box, a tip beside the pointer.

/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { PlaneBox } from './pointer.mjs' */
import { clipped, drawHandle, drawMark, rule } from '../../draw/marks.mjs';

const TIP_LINE = 15; // [px]
const EDGE_ROOM = 6; // [px] from an edge to the mark of a point beyond it

/**
 * Draw lines through the point.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {{ x: number, y: number }} point  in the units of the axes
 * @param {'across' | 'up' | 'both'} lines
 */
export function drawPlaneLines(pen, onto, point, lines) {
  for (const along of [lines !== 'up' && { y: point.y }, lines !== 'across' && { x: point.x }]) {
    if (!along) continue;
    rule(pen, onto, along, { colour: onto.theme.paper, width: 1.5, alpha: 0.75 });
    rule(pen, onto, along, { colour: onto.theme.ink, width: 1.5, dash: [1.5, 4], alpha: 0.75 });
  }
}

/**
 * Draw the point; one that is not in the window is a diamond at its edge.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {{ x: number, y: number }} point  in the units of the axes
 */
export function drawPlanePoint(pen, onto, point) {
  const [x, y] = [onto.x.at(point.x), onto.y.at(point.y)], { ink, paper } = onto.theme;
  if (!inPlaneBox(onto.box, x, y, 1)) {
    const { left, top, width, height } = onto.box;
    const across = Math.min(left + width - EDGE_ROOM, Math.max(left + EDGE_ROOM, x));
    // An amplitude of 0 is below every logarithmic axis.
    const down = Math.min(top + height - EDGE_ROOM, Math.max(top + EDGE_ROOM, y || Infinity));
    drawMark(pen, 'diamond', across, down, { colour: ink, radius: 5, casing: paper });
    return;
  }
  drawHandle(pen, onto.theme, x, y);
}

/**
 * @param {PlaneBox} box
 * @param {number} x
 * @param {number} y
 * @param {number} [around]
 */
export function inPlaneBox({ left, top, width, height }, x, y, around = 0) {
  return x >= left - around && x <= left + width + around
    && y >= top - around && y <= top + height + around;
}

/**
 * Draw a box that is being marked.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {PlaneBox} box
 */
export function drawMarkedBox(pen, onto, { left, top, width, height }) {
  clipped(pen, onto, () => {
    const { ink, paper } = onto.theme;
    for (const [colour, thick] of /** @type {const} */ ([[paper, 3.5], [ink, 1.5]])) {
      pen.strokeStyle = colour;
      pen.lineWidth = thick;
      pen.strokeRect(left, top, width, height);
    }
  });
}

/**
 * Draw lines of text on paper beside a pixel, within the width of the panel.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {{ x: number, y: number }} at
 * @param {string[]} lines
 */
export function drawTip(pen, { box, theme, size }, { x, y }, lines) {
  pen.save();
  pen.font = theme.small;
  const width = Math.ceil(Math.max(...lines.map((line) => pen.measureText(line).width))) + 13;
  const height = TIP_LINE * lines.length + 6;
  const fits = x + 16 + width <= size.width - 2;
  const left = Math.round(Math.max(2, fits ? x + 16 : x - 16 - width));
  const over = y - height - 10 >= box.top;
  const top = Math.round(over ? y - height - 10 : Math.min(y + 14, box.top + box.height - height));
  pen.fillStyle = theme.paper;
  pen.fillRect(left, top, width, height);
  pen.strokeStyle = theme.quiet;
  pen.lineWidth = 1;
  pen.strokeRect(left + 0.5, top + 0.5, width - 1, height - 1);
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  pen.fillStyle = theme.ink;
  lines.forEach((line, k) => {
    pen.fillText(line, left + 6, top + 3 + TIP_LINE * (k + 0.5));
  });
  pen.restore();
}
