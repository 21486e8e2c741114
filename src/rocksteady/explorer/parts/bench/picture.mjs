// The picture at the right: what becomes of the block over two quantities, with a point to drag.

/** @import { App } from '../shell/app.mjs' */
/** @import { Box, Cells, Kind } from './areas.mjs' */
/** @import { Pen } from '../story/draw.mjs' */
import { scale } from '../draw/scale.mjs';
import { drawCurve, drawLine, drawRing, write } from '../story/draw.mjs';
import { makeView } from '../story/view.mjs';
import { drawAreas } from './areas.mjs';

/** @typedef {{ x: number, y: number }} Place */
/** @typedef {{ from: number, to: number, label: string }} Axis */

/**
 * What the axes and the point of a picture are.
 * @typedef {object} Plane
 * @property {Axis} x
 * @property {Axis} y
 * @property {Place} point
 * @property {string} tag  of the point
 * @property {{ y: number, words: string }} [limit]
 * @property {Place & { words: string } | null} [dot]
 */

/**
 * What the picture shows: areas, or a curve.
 * @typedef {object} Shown
 * @property {Plane} plane
 * @property {Cells | null} cells
 * @property {readonly Kind[]} kinds
 * @property {readonly Place[]} curve
 */

const ROOM = { left: 52, right: 16, top: 30, bottom: 46 }, NARROW = 500; // [px]
const TAG = { height: 24, room: 14 }; // [px]
const NUDGES = 200; // presses of an arrow along an axis

/**
 * Make the picture.
 * @param {App} app
 * @param {HTMLCanvasElement} canvas
 * @param {() => Shown} shown
 * @param {(place: Place, done: boolean) => void} moved
 */
export function makePicture(app, canvas, shown, moved) {
  let held = -1;
  const boxOf = (/** @type {number} */ width, /** @type {number} */ height) => {
    const left = width < NARROW ? 40 : ROOM.left;
    return { left, top: ROOM.top, width: width - left - ROOM.right, height: height - ROOM.top - ROOM.bottom };
  };
  /** @param {Box} box @param {Plane} plane */
  const scalesOf = ({ left, top, width, height }, { x, y }) => ({
    x: scale({ ...x, start: left, end: left + width }),
    y: scale({ ...y, start: top + height, end: top }),
  });

  const view = makeView(canvas, (pen, width, height) => {
    const { theme } = app, { plane, cells, kinds, curve } = shown(), { point, tag, dot } = plane;
    const box = boxOf(width, height), { x, y } = scalesOf(box, plane);
    const inside = (/** @type {Place} */ place) => ({
      x: Math.min(Math.max(x.at(place.x), box.left), box.left + box.width),
      y: Math.min(Math.max(y.at(place.y), box.top), box.top + box.height),
    });
    const at = inside(point);
    const right = at.x > box.left + box.width - 170, low = at.y < box.top + 40;
    const tagBox = tagAt(pen, tag, at.x + (right ? -20 : 20), at.y + (low ? 26 : -22), right, width);
    const limit = plane.limit ? y.at(plane.limit.y) : 0, seen = limit > box.top + 20;
    const avoid = [tagBox, { left: at.x - 24, top: at.y - 24, width: 48, height: 48 },
      { left: at.x - 2, top: box.top, width: 4, height: box.height }, { left: box.left, top: at.y - 2, width: box.width, height: 4 },
      ...(seen ? [{ left: box.left + box.width - 150, top: limit, width: 150, height: 24 }] : [])];
    pen.fillStyle = theme.paper;
    pen.fillRect(box.left, box.top, box.width, box.height);
    if (cells) drawAreas(pen, theme, cells, box, kinds, avoid);
    drawCurve(pen, theme, curve.length, (k) => [x.at(curve[k].x), y.at(curve[k].y)], { role: 'motion', width: 2.5 });
    if (plane.limit && seen) {
      drawLine(pen, theme, [box.left, limit, box.left + box.width, limit], 'ink', 1.25, [5, 4]);
      write(pen, theme, plane.limit.words, box.left + box.width - 8, limit + 16, { align: 'right', size: 13 });
    }
    drawAxes(pen, box, x, y, [plane.x.label, plane.y.label]);
    for (const [role, dashes, wide] of /** @type {const} */ ([['paper', [], 2], ['ink', [2, 4], 1]])) {
      drawLine(pen, theme, [box.left, at.y, box.left + box.width, at.y], role, wide, [...dashes]);
      drawLine(pen, theme, [at.x, box.top, at.x, box.top + box.height], role, wide, [...dashes]);
    }
    if (dot) {
      const mine = inside(dot), aside = mine.x > width - 130;
      pen.beginPath();
      pen.arc(mine.x, mine.y, 6, 0, 2 * Math.PI);
      pen.fillStyle = theme.ink;
      pen.fill();
      pen.lineWidth = 2.5;
      pen.strokeStyle = theme.paper;
      pen.stroke();
      drawTag(pen, dot.words, tagAt(pen, dot.words, mine.x + (aside ? -12 : 12), mine.y, aside, width));
    }
    drawRing(pen, theme, at.x, at.y, held < 0 ? 12 : 14);
    drawTag(pen, tag, tagBox);
  });

  /** @param {Pen} pen @param {Box} box @param {import('../draw/scale.mjs').Scale} x
   * @param {import('../draw/scale.mjs').Scale} y @param {readonly [string, string]} labels */
  const drawAxes = (pen, { left, top, width, height }, x, y, labels) => {
    const { theme } = app, foot = top + height;
    drawCurve(pen, theme, 5, (k) => [left + width * (k === 1 || k === 2 ? 1 : 0), top + height * (k === 2 || k === 3 ? 1 : 0)],
      { role: 'edge', width: 1 });
    for (const { value, label } of x.ticks(width < 400 ? 4 : 8)) {
      drawLine(pen, theme, [x.at(value), foot, x.at(value), foot + 5], 'edge');
      write(pen, theme, label, x.at(value), foot + 19, { role: 'quiet', align: 'center', size: 13 });
    }
    for (const { value, label } of y.ticks(6)) {
      drawLine(pen, theme, [left - 5, y.at(value), left, y.at(value)], 'edge');
      write(pen, theme, label, left - 8, y.at(value) + 4, { role: 'quiet', align: 'right', size: 13 });
    }
    write(pen, theme, labels[1], Math.max(2, left - 46), top - 11, { size: 14 });
    write(pen, theme, labels[0], left + width, foot + 39, { size: 14, align: 'right' });
  };
  /** Return where the ground of a tag is. @param {Pen} pen @param {string} words @param {number} x
   * @param {number} y @param {boolean} before  its end is at x @param {number} width  of the picture */
  const tagAt = (pen, words, x, y, before, width) => {
    pen.font = TAG_FONT;
    const wide = pen.measureText(words).width + TAG.room;
    return { left: Math.max(2, Math.min(width - wide - 2, before ? x - wide : x)), top: y - 0.5 * TAG.height, width: wide, height: TAG.height };
  };
  /** @param {Pen} pen @param {string} words @param {Box} box */
  const drawTag = (pen, words, { left, top, width, height }) => {
    const { theme } = app;
    pen.beginPath();
    pen.roundRect(left, top, width, height, 3);
    pen.fillStyle = theme.paper;
    pen.fill();
    pen.lineWidth = 1;
    pen.strokeStyle = theme.edge;
    pen.stroke();
    pen.font = TAG_FONT;
    pen.textAlign = 'left';
    pen.fillStyle = theme.ink;
    pen.fillText(words, left + 0.5 * TAG.room, top + 16.5);
  };

  /** @param {PointerEvent} event @returns {Place} */
  const placeOf = (event) => {
    const { left, top } = canvas.getBoundingClientRect(), box = boxOf(canvas.clientWidth, canvas.clientHeight);
    const { x, y } = scalesOf(box, shown().plane);
    const across = Math.min(Math.max(event.clientX - left, box.left), box.left + box.width);
    const down = Math.min(Math.max(event.clientY - top, box.top), box.top + box.height);
    return { x: x.value(across), y: y.value(down) };
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button || held >= 0) return;
    held = event.pointerId;
    canvas.setPointerCapture(held);
    moved(placeOf(event), false);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerId === held) moved(placeOf(event), false);
  });
  for (const name of /** @type {const} */ (['pointerup', 'pointercancel'])) {
    canvas.addEventListener(name, (event) => {
      if (event.pointerId !== held) return;
      held = -1;
      moved(shown().plane.point, true);
    });
  }
  canvas.addEventListener('keydown', (event) => {
    const [along, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [0, 0];
    if (!along && !up) return;
    event.preventDefault();
    event.stopPropagation();
    const { point, x, y } = shown().plane, far = event.shiftKey ? 10 : 1;
    moved({ x: point.x + (far * along * (x.to - x.from)) / NUDGES, y: point.y + (far * up * (y.to - y.from)) / NUDGES }, true);
  });
  return view;
}

const TAG_FONT = '600 13px ui-monospace, "SF Mono", "DejaVu Sans Mono", monospace';
