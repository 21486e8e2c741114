// What the pictures of the story are made of: the block that wears its state, ground, hand, words.

/** @import { Theme } from '../draw/theme.mjs' */
/** @import { MotionClass } from '../draw/classes.mjs' */
/** @import { Shape } from '../panels/scene.mjs' */
import { fillClass } from '../draw/classes.mjs';
import { FAMILY } from '../draw/theme.mjs';
import { blockCorners } from '../panels/scene.mjs';

/** @typedef {CanvasRenderingContext2D} Pen */
/** @typedef {keyof import('../draw/theme.mjs').Inks & ('ink' | 'quiet' | 'edge' | 'hair' | 'paper'
 *   | 'page' | 'motion' | 'base' | 'impact' | 'onFalls' | 'onRocks' | 'risk' | 'rest' | 'rocks'
 *   | 'falls')} Role */
/** Left, top, width and height [px]. @typedef {readonly [number, number, number, number]} Area */

export const BACK = 0.3; // opacity of what a film has not reached yet
const FLASH_RAYS = [-2.6, -2.0, -1.14, -0.54];

/**
 * Draw a block on its ground: pale at rest, blue while it rocks, near-black and hatched once it falls.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {Shape} shape
 * @param {{ x: number, y: number, unit: number, angle: number, width?: number, fate?: MotionClass }} how
 *   x, y: middle of its base [px]; unit: [px/m]; angle: theta [rad]
 */
export function drawBlock(pen, theme, shape, { x, y, unit, angle, width = 2.5, fate }) {
  const state = fate ?? stateOf(angle / shape.alpha);
  const outline = () => {
    pen.beginPath();
    for (const [across, up] of blockCorners(shape, angle)) pen.lineTo(x + across * unit, y - up * unit);
    pen.closePath();
  };
  const reach = 2 * shape.radius * unit + 2;
  outline();
  pen.save();
  pen.clip();
  fillClass(pen, theme, state, { left: x - 2 * reach, top: y - reach, width: 4 * reach, height: reach });
  pen.restore();
  outline();
  pen.lineWidth = width;
  pen.lineJoin = 'miter';
  pen.strokeStyle = state === 'overturned' ? theme.edge : theme.ink;
  pen.stroke();
}

/**
 * Return what a block does at an angle over its slenderness.
 * @param {number} angle
 * @returns {MotionClass}
 */
export function stateOf(angle) {
  if (angle === 0) return 'rest';
  return Math.abs(angle) > 1 ? 'overturned' : 'rocking';
}

/**
 * Draw the ground with a tick each 10 cm, every fifth one longer.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {{ width: number, height: number, y: number, x: number, unit: number }} at
 *   x: where the place 0 is [px]; height: of the soil below y
 */
export function drawGround(pen, theme, { width, height, y, x, unit }) {
  pen.fillStyle = theme.soil;
  pen.fillRect(0, y, width, height);
  pen.fillStyle = theme.ink;
  pen.fillRect(0, y, width, 2);
  const gap = 0.1 * unit;
  pen.beginPath();
  for (let k = Math.ceil(-x / gap); k * gap + x < width; k++) {
    const px = Math.round(k * gap + x) + 0.5;
    pen.moveTo(px, y + 2);
    pen.lineTo(px, y + (k % 5 ? 8 : 14));
  }
  pen.strokeStyle = theme.quiet;
  pen.lineWidth = 1;
  pen.stroke();
}

/**
 * Draw an impact at a corner, as fresh as `glow`, from 1 to 0.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {number} x
 * @param {number} y
 * @param {number} glow
 */
export function drawFlash(pen, theme, x, y, glow) {
  if (!(glow > 0)) return;
  const near = 9 + 16 * (1 - glow);
  pen.save();
  pen.globalAlpha = Math.min(1, glow);
  pen.lineCap = 'round';
  pen.beginPath();
  for (const ray of FLASH_RAYS) {
    for (const [far, step] of /** @type {const} */ ([[near, 'moveTo'], [near + 11, 'lineTo']])) {
      pen[step](x + far * Math.cos(ray), y + far * Math.sin(ray));
    }
  }
  pen.lineWidth = 3;
  pen.strokeStyle = theme.impact;
  pen.stroke();
  pen.restore();
}

/**
 * Draw what may be dragged. What may be touched has no hue.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {number} x
 * @param {number} y
 * @param {number} [radius]
 */
export function drawRing(pen, theme, x, y, radius = 10) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = theme.paper;
  pen.fill();
  pen.lineWidth = 3;
  pen.strokeStyle = theme.ink;
  pen.stroke();
}

/**
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {readonly [number, number, number, number]} ends  x, y, x, y
 * @param {Role} role
 * @param {number} [width]
 * @param {number[]} [dashes]
 */
export function drawLine(pen, theme, [x0, y0, x1, y1], role, width = 1, dashes = []) {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.setLineDash(dashes);
  pen.lineWidth = width;
  pen.strokeStyle = theme[role];
  pen.stroke();
  pen.setLineDash([]);
}

/**
 * Draw a curve through points.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {number} count
 * @param {(k: number) => readonly [number, number]} place  of a point [px]
 * @param {{ role: Role, width: number, opacity?: number }} look
 */
export function drawCurve(pen, theme, count, place, { role, width, opacity = 1 }) {
  pen.beginPath();
  for (let k = 0; k < count; k++) pen.lineTo(...place(k));
  pen.globalAlpha = opacity;
  pen.lineJoin = 'round';
  pen.lineWidth = width;
  pen.strokeStyle = theme[role];
  pen.stroke();
  pen.globalAlpha = 1;
}

/**
 * Write a text; `over`: the fill that it stands on, which keeps patterns off.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @param {{ role?: Role, align?: CanvasTextAlign, bold?: boolean, size?: number, over?: Role }} [how]
 */
export function write(pen, theme, text, x, y, how = {}) {
  const { role = 'ink', align = 'left', bold = false, size = 12, over } = how;
  pen.font = `${bold ? 600 : 400} ${size}px ${FAMILY}`;
  pen.textAlign = align;
  pen.textBaseline = 'alphabetic';
  if (over) {
    pen.lineJoin = 'round';
    pen.lineWidth = 4;
    pen.strokeStyle = theme[over];
    pen.strokeText(text, x, y);
  }
  pen.fillStyle = theme[role];
  pen.fillText(text, x, y);
}

/** Return whether a point lies in an area, or so near. @param {Area | null} area
 * @param {number} x @param {number} y @param {number} [near] */
export function inArea(area, x, y, near = 0) {
  if (!area) return false;
  const [left, top, width, height] = area;
  return x >= left - near && x <= left + width + near && y >= top - near && y <= top + height + near;
}
