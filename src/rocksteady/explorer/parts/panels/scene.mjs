// The block on its moving ground, in true geometry: the formulas of rocksteady.show.film.

/** @import { Theme } from '../draw/theme.mjs' */
import { fillClass } from '../draw/classes.mjs';

/**
 * What is drawn of a homogeneous rectangle, lengths in metres.
 * @typedef {object} Shape
 * @property {number} alpha  slenderness [rad]
 * @property {number} radius  half-diagonal
 * @property {number} halfWidth
 * @property {number} height
 * @property {number} travel  length of alpha g / p^2, the unit of the ground's displacement
 */

/**
 * One moment of a motion.
 * @typedef {object} Pose
 * @property {number} angle  theta / alpha
 * @property {number} side  1 where it stands on its left corner, -1 on its right one, 0 on both
 * @property {number} ground  displacement of the base [alpha g / p^2]
 * @property {number} push  acceleration of the base [alpha g]
 * @property {boolean} fallen  overturned by then
 * @property {{ side: number, age: number, strength: number }[]} flashes  of impacts; age 0 to 1
 */

/**
 * @typedef {object} Camera
 * @property {number} far  largest displacement of the base to either side [alpha g / p^2]
 * @property {number} pushed  largest acceleration of the base [alpha g]
 * @property {number} enlarged  factor of the rotation
 * @property {number} head  room above the block [px]
 */

export const LYING = 0.5 * Math.PI; // |theta| at which a block lies on its side
const GROUND_DEPTH = 0.36; // in half-diagonals; the arrow has to fit in
const GROUND_FAR = 0.5; // half-diagonals that the base may move until the camera goes with it
const STROKE_GAP = 0.11; // between the strokes below the surface, in half-diagonals

/**
 * Return what is drawn of a rectangle.
 * @param {number} width  [m]
 * @param {number} height  [m]
 * @returns {Shape}
 */
export function shapeOf(width, height) {
  const alpha = Math.atan2(width, height), radius = 0.5 * Math.hypot(width, height);
  // g / (p^2 R) of a homogeneous rectangle is 4/3.
  return { alpha, radius, halfWidth: 0.5 * width, height, travel: (alpha * radius * 4) / 3 };
}

/**
 * Return the rotation from the base as it is drawn [rad]: no further than lying on the ground.
 * @param {Shape} shape
 * @param {number} angle  theta / alpha, to the side to which the block leans
 * @param {number} enlarged  factor of the rotation
 */
export function drawnRotation(shape, angle, enlarged) {
  return Math.max(0, Math.min(LYING, angle * shape.alpha * enlarged));
}

/**
 * Return the corners of the block, seen from the ground: bottom left, bottom right, top right,
 * top left. Positive rotation is about the left corner, negative about the right one.
 * @param {Shape} shape
 * @param {number} theta  [rad]
 * @returns {[number, number][]}
 */
export function blockCorners(shape, theta) {
  const { halfWidth: b, height: h } = shape, pivot = theta < 0 ? b : -b;
  const cos = Math.cos(theta), sin = Math.sin(theta);
  return [[-b, 0], [b, 0], [b, h], [-b, h]].map(([x, y]) =>
    [pivot + (x - pivot) * cos - y * sin, (x - pivot) * sin + y * cos]);
}

/**
 * Draw the block on its ground.
 * @param {CanvasRenderingContext2D} pen
 * @param {{ width: number, height: number }} size
 * @param {Theme} theme
 * @param {Shape} shape
 * @param {Pose} pose
 * @param {Camera} camera
 */
export function drawBlockScene(pen, size, theme, shape, pose, camera) {
  const { radius: r, halfWidth: b, height: h } = shape;
  const far = shape.travel * camera.far, follows = far > GROUND_FAR * r;
  // Room for the block lying on either side, so that its size does not change as it falls.
  const reach = Math.max(b + h, 2 * r) + 0.1 * r + (follows ? 0 : far);
  const floor = GROUND_DEPTH * r, top = Math.max(h, 2 * r) + 0.06 * r;
  const unit = Math.min(size.width / (2 * reach), (size.height - camera.head) / (top + floor));
  const moved = shape.travel * pose.ground;
  const middle = size.width / 2, level = size.height - floor * unit;
  const x = (/** @type {number} */ place) => middle + ((follows ? 0 : moved) + place) * unit;
  const y = (/** @type {number} */ place) => level - place * unit;
  const line = (/** @type {[number, number][]} */ points) => {
    pen.beginPath();
    points.forEach(([px, py], k) => (k ? pen.lineTo(px, py) : pen.moveTo(px, py)));
  };
  pen.fillStyle = theme.paper;
  pen.fillRect(0, 0, size.width, size.height);
  drawPosts(pen, size, theme, { unit, middle, level, radius: r, moved: follows ? moved : 0 });

  drawGround(pen, size, theme, { unit, level, radius: r, start: x(0) });

  // A flight begins and ends at 0 only to rounding; its side decides about the pivot.
  const { side } = pose, theta = side * drawnRotation(shape, side * pose.angle, camera.enlarged);
  const corners = blockCorners(shape, theta);
  const outline = () => {
    line(corners.map(([px, py]) => [x(px), y(py)]));
    pen.closePath();
  };
  outline();
  // The block wears its state.
  pen.save();
  pen.clip();
  const state = pose.fallen ? 'overturned' : side === 0 ? 'rest' : 'rocking';
  fillClass(pen, theme, state, { left: 0, top: 0, ...size });
  pen.restore();
  outline(); // a hatch has left another path
  pen.lineWidth = 1.4;
  pen.strokeStyle = pose.fallen ? theme.edge : theme.ink;
  pen.stroke();

  const centre = [(corners[0][0] + corners[2][0]) / 2, (corners[0][1] + corners[2][1]) / 2];
  const pivots = side === 0 ? [-b, b] : [-side * b];
  if (side !== 0) {
    line([[x(pivots[0]), y(0)], [x(centre[0]), y(centre[1])]]);
    pen.lineWidth = 0.9;
    pen.strokeStyle = pose.fallen ? theme.onFalls : theme.ink;
    pen.stroke();
  }
  pen.beginPath();
  pen.arc(x(centre[0]), y(centre[1]), 3.6, 0, 2 * Math.PI);
  pen.fillStyle = theme.paper;
  pen.fill();
  pen.lineWidth = 1.4;
  pen.strokeStyle = theme.ink;
  pen.stroke();
  for (const pivot of pivots) {
    line([[x(pivot), y(0)], [x(pivot) - 5, y(0) + 9], [x(pivot) + 5, y(0) + 9]]);
    pen.closePath();
    pen.fillStyle = theme.ink;
    pen.fill();
  }
  for (const { side, age, strength } of pose.flashes) {
    pen.globalAlpha = (1 - age * age) * strength;
    pen.beginPath();
    pen.arc(x(side * b), y(0), 5 + 14 * age, 0, 2 * Math.PI);
    pen.lineWidth = 3.4 - 2 * age;
    pen.strokeStyle = theme.impact;
    pen.stroke();
  }
  pen.globalAlpha = 1;
  const room = Math.min(reach, 0.9 * (b + 1.1 * r));
  drawPush(pen, theme, { x, y, unit, radius: r, reach: room }, pose, camera);
}

/**
 * Draw verticals that stand still, half a metre or so apart, past which the ground moves.
 * @param {CanvasRenderingContext2D} pen
 * @param {{ width: number, height: number }} size
 * @param {Theme} theme
 * @param {{ unit: number, middle: number, level: number, radius: number, moved: number }} at
 */
function drawPosts(pen, size, theme, { unit, middle, level, radius, moved }) {
  const decade = 10 ** Math.floor(Math.log10(radius)), step = [1, 2, 5, 10].map((k) => k * decade)
    .find((length) => length >= 0.6 * radius) ?? decade;
  const half = size.width / 2 / unit;
  pen.strokeStyle = theme.hair;
  pen.lineWidth = 1;
  pen.beginPath();
  for (let k = Math.ceil((moved - half) / step); k * step <= moved + half; k += 1) {
    const px = Math.round(middle + (k * step - moved) * unit) + 0.5;
    pen.moveTo(px, 0);
    pen.lineTo(px, level);
  }
  pen.stroke();
  pen.fillStyle = theme.quiet;
  pen.font = theme.small;
  pen.textAlign = 'right';
  pen.textBaseline = 'alphabetic';
  pen.fillText(`lines ${Number(step.toPrecision(1))} m apart`, size.width - 6, level - 6);
}

/**
 * @param {CanvasRenderingContext2D} pen
 * @param {{ width: number, height: number }} size
 * @param {Theme} theme
 * @param {{ unit: number, level: number, radius: number, start: number }} at
 */
function drawGround(pen, size, theme, { unit, level, radius, start }) {
  pen.fillStyle = theme.soil;
  pen.fillRect(0, level, size.width, size.height - level);
  const gap = STROKE_GAP * radius * unit, deep = 0.07 * radius * unit;
  pen.strokeStyle = theme.edge;
  pen.lineWidth = 0.8;
  pen.beginPath();
  for (let px = start - Math.ceil(start / gap) * gap; px < size.width + deep; px += gap) {
    pen.moveTo(px, level);
    pen.lineTo(px - deep, level + deep);
  }
  pen.stroke();
  pen.strokeStyle = theme.ink;
  pen.lineWidth = 1.4;
  pen.beginPath();
  pen.moveTo(0, level);
  pen.lineTo(size.width, level);
  pen.stroke();
}

/**
 * Draw the arrow of the base acceleration between the marks at alpha g, which lifts the block.
 * @param {CanvasRenderingContext2D} pen
 * @param {Theme} theme
 * @param {{ x: (place: number) => number, y: (place: number) => number, unit: number,
 *   radius: number, reach: number }} at
 * @param {Pose} pose
 * @param {Camera} camera
 */
function drawPush(pen, theme, { x, y, unit, radius, reach }, pose, camera) {
  if (!(camera.pushed > 0)) return;
  const level = y(-0.22 * radius), most = Math.max(1, camera.pushed);
  const end = (/** @type {number} */ push) => x(0) + ((push / most) * reach) * unit;
  pen.strokeStyle = theme.quiet;
  pen.lineWidth = 1;
  pen.beginPath();
  for (const [mark, half] of [[0, 0.09], [-1, 0.055], [1, 0.055]]) {
    pen.moveTo(end(mark), level - half * radius * unit);
    pen.lineTo(end(mark), level + half * radius * unit);
  }
  pen.stroke();
  const from = x(0), tip = end(pose.push), long = tip - from;
  const head = Math.sign(long) * Math.min(Math.abs(long), 0.15 * radius * unit);
  const thin = Math.max(1.5, 0.024 * radius * unit), thick = Math.max(4, 0.075 * radius * unit);
  pen.beginPath();
  pen.moveTo(from, level - thin);
  const neck = tip - head;
  for (const [px, py] of [
    [neck, -thin], [neck, -thick], [tip, 0], [neck, thick], [neck, thin], [from, thin],
  ]) {
    pen.lineTo(px, level + py);
  }
  pen.closePath();
  pen.fillStyle = theme.base;
  pen.fill();
}
