// What the scenes share: their elements, their sliders, their films and histories.

/** @import { App } from '../shell/app.mjs' */
/** @import { Theme } from '../draw/theme.mjs' */
/** @import { Reel } from '../physics/push/falling.mjs' */
/** @import { Area, Pen } from './draw.mjs' */
/** @import { Shape } from '../panels/scene.mjs' */
/** @import { View } from './view.mjs' */
import { reelAngle } from '../physics/push/falling.mjs';
import { element } from '../shell/app.mjs';
import { say, setOn } from '../shell/layout.mjs';
import { shapeOf } from '../panels/scene.mjs';
import { BACK, drawBlock, drawCurve, drawFlash, drawLine, write } from './draw.mjs';
import { knock } from './sound.mjs';
import { degreeText } from './words.mjs';

const GLOW = 0.3; // [s] of an impact
const SLOWEST_FLASH = 0.02; // du/d(pt) of an impact that is seen
export const NARROW = 600; // [px] below which a picture stacks its parts

/** @typedef {'tilt' | 'length' | 'strength' | 'su' | 'sv' | 'shake' | 'pga'} Value */

/**
 * Return the canvas of a scene, and what writes its answer, which is the picture's name too.
 * @param {string} name
 */
export function sceneOf(name) {
  const root = element(`scene-${name}`);
  const canvas = /** @type {HTMLCanvasElement} */ (root.querySelector('canvas'));
  const title = root.querySelector('h2')?.textContent, place = element(`answer-${name}`);
  return {
    canvas,
    /** @param {string} text */
    answer(text) {
      say(place, text);
      setOn(canvas, 'aria-label', `${title} ${text}`);
    },
  };
}

/**
 * Tie a slider to a value of the state.
 * @param {App} app
 * @param {Value} name
 * @param {{ text: (value: number) => string, change: () => void }} how  change: after the value has
 */
export function tieSlider(app, name, { text, change }) {
  const slider = /** @type {HTMLInputElement} */ (element(`slide-${name}`));
  const show = () => {
    const shown = text(app.state[name]);
    if (Number(slider.value) !== app.state[name]) slider.value = String(app.state[name]);
    say(element(`value-${name}`), shown);
    setOn(slider, 'aria-valuetext', shown);
  };
  slider.addEventListener('input', () =>
    app.set({ [name]: Number(slider.value) }, { settled: false }));
  slider.addEventListener('change', () => app.set({ [name]: Number(slider.value) }, { push: false }));
  document.addEventListener('state', (event) => {
    if (!(/** @type {CustomEvent} */ (event)).detail.changed.includes(name)) return;
    show();
    change();
  });
  show();
}

/**
 * @typedef {object} Player
 * @property {number} time  [s]
 * @property {boolean} playing
 * @property {() => void} play  from the start; to the end at once where less motion is wanted
 * @property {(time: number) => void} seek  stop there
 */

/**
 * Return a clock for films, which runs while its view is in sight.
 * @param {App} app
 * @param {View} view
 * @param {number} seconds
 * @param {() => readonly Reel[]} reels  whose impacts are heard
 * @returns {Player}
 */
export function makePlayer(app, view, seconds, reels) {
  let before = 0;
  const tick = (/** @type {number} */ now) => {
    if (!player.playing) return;
    const from = player.time;
    player.time = Math.min(seconds, from + Math.min(50, now - before) / 1000);
    before = now;
    for (const { impacts } of reels()) {
      impacts.time.forEach((time, k) => {
        if (time > from && time <= player.time) knock(impacts.speed[k]);
      });
    }
    player.playing = player.time < seconds && view.seen;
    view.paint();
    if (player.playing) requestAnimationFrame(tick);
  };
  const player = {
    time: seconds,
    playing: false,
    play() {
      if (app.still) {
        player.seek(seconds);
        return;
      }
      player.time = 0;
      before = performance.now();
      if (player.playing) return;
      player.playing = true;
      requestAnimationFrame(tick);
    },
    /** @param {number} time */
    seek(time) {
      player.playing = false;
      player.time = Math.max(0, Math.min(seconds, time));
      view.ask();
    },
  };
  return player;
}

/** Return what is drawn of the block of a film. @param {Reel} reel */
export function reelShape({ block: { alpha, radius } }) {
  return shapeOf(2 * radius * Math.sin(alpha), 2 * radius * Math.cos(alpha));
}

/**
 * Draw the block of a film at a time, with its impacts.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {Reel} reel
 * @param {number} time
 * @param {{ x: number, y: number, unit: number, shape: Shape, width?: number, flashes?: boolean }} at
 */
export function drawReel(pen, theme, reel, time, { flashes = true, ...at }) {
  const angle = reelAngle(reel, time), { alpha } = reel.block, { impacts } = reel;
  const down = reel.overturns !== null && time >= reel.overturns;
  const fate = down && Math.abs(angle) > 0 ? 'overturned' : undefined;
  drawBlock(pen, theme, at.shape, { ...at, angle: angle * alpha, fate });
  if (!flashes) return;
  for (let k = impacts.time.length - 1; k >= 0; k--) {
    const age = time - impacts.time[k];
    if (age > GLOW) break;
    if (age < 0 || impacts.speed[k] < SLOWEST_FLASH) continue;
    const corner = at.x + impacts.side[k] * at.shape.halfWidth * at.unit;
    drawFlash(pen, theme, corner, at.y, 1 - age / GLOW);
  }
}

/**
 * Draw the history of a film, bold up to a time; return where it stands, to be dragged.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {Reel} reel
 * @param {number} time
 * @param {{ area: Area, seconds: number, base?: (time: number) => number }} how  base: from -1 to 1
 * @returns {Area}
 */
export function drawHistory(pen, theme, reel, time, { area, seconds, base }) {
  const [left, top, width, height] = area, middle = top + 0.5 * height;
  const across = (/** @type {number} */ at) => left + (at / seconds) * width;
  const up = (/** @type {number} */ angle) => middle - Math.max(-1.25, Math.min(1.25, angle)) * 0.27 * height;
  drawLine(pen, theme, [left, middle, left + width, middle], 'hair');
  for (const edge of [-1, 1]) drawLine(pen, theme, [left, up(edge), left + width, up(edge)], 'ink', 1, [5, 4]);
  write(pen, theme, `tipping angle ${degreeText(reel.block.alpha)}`, left, up(1) - 5);
  write(pen, theme, 'tilt', left + width, up(1) - 5, { role: 'motion', bold: true, align: 'right' });
  if (base) {
    const low = top + 0.98 * height, points = 240;
    drawCurve(pen, theme, points, (k) => {
      const at = (k / (points - 1)) * seconds;
      return [across(at), low - base(at) * 0.06 * height];
    }, { role: 'base', width: 1.25 });
    write(pen, theme, 'ground', left + 0.2 * width, low - 6, { role: 'base', bold: true, over: 'page' });
  }
  const { angle, step, impacts } = reel, count = Math.min(angle.length, Math.ceil(seconds / step) + 1);
  const place = (/** @type {number} */ k) => /** @type {const} */ ([across(k * step), up(angle[k])]);
  pen.save();
  pen.beginPath();
  pen.rect(left - 2, middle - 0.42 * height, width + 4, 0.84 * height);
  pen.clip();
  drawCurve(pen, theme, count, place, { role: 'motion', width: 1.25, opacity: BACK });
  drawCurve(pen, theme, Math.min(count, Math.floor(time / step) + 1), place, { role: 'motion', width: 2.75 });
  pen.restore();
  impacts.time.forEach((at, k) => {
    if (at > time || impacts.speed[k] < SLOWEST_FLASH) return;
    drawLine(pen, theme, [across(at), middle - 6, across(at), middle + 6], 'impact', 2);
  });
  for (let at = 0; at <= seconds; at++) {
    const text = at ? String(at) : '0 s';
    write(pen, theme, text, across(at), top + height + 15, { role: 'quiet', align: at ? 'center' : 'left' });
  }
  pen.beginPath();
  pen.arc(across(Math.min(time, seconds)), up(reelAngle(reel, time)), 5, 0, 2 * Math.PI);
  pen.fillStyle = theme.motion;
  pen.fill();
  return area;
}
