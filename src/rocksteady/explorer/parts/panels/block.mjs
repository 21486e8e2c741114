// The block of the tabs Pulse, Earthquake and Design: its run to the ground, played and scrubbed.

/** @import { App, Panel } from '../shell/app.mjs' */
/** @import { State } from '../shell/state.mjs' */
/** @import { FilmAsked, Reel } from '../physics/push/falling.mjs' */
import { feltBy } from '../physics/demand/design.mjs';
import { scaledMotion } from '../physics/motions.mjs';
import { reelAngle } from '../physics/push/falling.mjs';
import { make } from '../shell/layout.mjs';
import { blockNumbers, equationsOf } from '../shell/state.mjs';
import { tableOf } from '../shell/tables.mjs';
import { pageUnits } from '../shell/units.mjs';
import { drawGround, drawLine, write } from '../story/draw.mjs';
import { drawReel } from '../story/scene.mjs';
import { degreeText, gText } from '../story/words.mjs';
import { designOf } from './demand/design.mjs';
import { shakenBy } from './quake/shaken.mjs';
import { shapeOf } from './scene.mjs';

const AFTER = 5; // pivot time after a pulse
const SOIL = 56; // [px] of ground below the block
const MOST_SECONDS = 120, HOLD = 1.5; // [s] of a film, and for which its last picture stays
const TAB_KEYS = /** @type {const} */ ({
  pulse: ['pulse', 'pA', 'pW'],
  quake: ['record', 'scale', 'motions'],
  design: ['demand', 'dg', 'df', 'dn', 'pulse', 'record', 'scale', 'motions'],
});

/**
 * Return what is filmed in a tab; null where nothing can be.
 * @param {App} app
 * @param {State} state
 * @returns {FilmAsked | null}
 */
export function filmAsked(app, state) {
  const { alpha, p, radius, restitution } = blockNumbers(app.kernels, state);
  const block = { alpha, p, radius, restitution, nonlinear: equationsOf(state) === 'nonlinear' };
  const most = (/** @type {number} */ seconds) => Math.min(MOST_SECONDS, seconds);
  const quake = () => {
    const { motion: { samples, dt }, scale, refused } = shakenBy(app, state);
    if (refused) return null;
    return { block, seconds: most(samples.length * dt + AFTER / p), motion: scaledMotion({ samples, dt }, scale) };
  };
  const struck = (/** @type {number} */ amplitude, /** @type {number} */ ratio) => ({
    block, seconds: most(((4 * Math.PI) / ratio + AFTER) / p), pulse: { shape: state.pulse, amplitude, ratio },
  });
  if (!(restitution > 0)) return null;
  if (state.tab === 'pulse') return struck(state.pA, state.pW);
  if (state.tab === 'quake' || state.demand === 'record') return quake();
  const { demand } = designOf(app, state);
  const { amplitude, frequencyRatio: ratio } = feltBy(demand, { ...block, housner: restitution });
  if (state.demand === 'pulse') return struck(amplitude, ratio);
  return { block, seconds: most(state.dn / state.df), harmonic: { amplitude, ratio } };
}

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeBlockPanel(app) {
  /** @type {(Reel & { base: Float64Array }) | null} */
  let reel = null;
  let time = 0, playing = !app.still, before = 0, frame = 0, held = 0;
  const play = make('button', { type: 'button', title: 'key: Space' });
  const scrub = /** @type {HTMLInputElement} */ (make('input', {
    type: 'range', min: '0', max: '1000', value: '0', 'aria-label': 'time of the film',
  }));
  const seconds = () => (reel ? (reel.angle.length - 1) * reel.step : 0);
  const tick = (/** @type {number} */ now) => {
    frame = 0;
    if (!playing || !reel || panel.away || panel.root?.hidden || document.hidden) return;
    const passed = before ? Math.min(100, now - before) / 1000 : 0;
    before = now;
    time = Math.min(seconds(), time + passed);
    held = time < seconds() ? 0 : held + passed;
    if (held > HOLD) [time, held] = [0, 0];
    app.redraw(panel);
    frame = requestAnimationFrame(tick);
  };
  const wake = () => {
    if (frame) return;
    before = 0;
    frame = requestAnimationFrame(tick);
  };
  const turn = (on = !playing) => {
    playing = on;
    play.textContent = on ? 'Pause' : 'Play';
    wake();
  };
  const words = () => {
    if (!reel) return '';
    const angle = Math.abs(reelAngle(reel, time)), limit = degreeText(reel.block.alpha);
    if (reel.falls && angle > 1) return 'falls';
    return `${degreeText(angle * reel.block.alpha)} of ${limit}`;
  };

  /** @type {Panel} */
  const panel = {
    name: 'block',
    title: 'Block',
    uses: ['tab', 'b', 'h', 'r', 'rh', 'model', ...new Set(Object.values(TAB_KEYS).flat())],
    placed() {
      play.addEventListener('click', () => turn());
      scrub.addEventListener('input', () => {
        time = (Number(scrub.value) / 1000) * seconds();
        turn(false);
        app.redraw(panel);
      });
      panel.bar?.append(play, scrub);
      turn(playing);
    },
    update(state, { changed }) {
      const keys = TAB_KEYS[/** @type {'pulse'} */ (state.tab)];
      if (!keys) return;
      wake();
      const common = ['tab', 'b', 'h', 'r', 'rh', 'model'];
      if (reel && ![...changed].some((name) => common.includes(name) || keys.some((key) => key === name))) return;
      const asked = filmAsked(app, state);
      if (!asked) {
        reel = null;
        return;
      }
      app.pool.ask('baseReel', asked, { key: 'block', priority: 0 }).then((found) => {
        if (!found) return;
        reel = found;
        time = app.still ? seconds() : Math.min(time, seconds());
        app.redraw(panel);
        wake();
      }, (error) => app.fail(panel, `The block could not be followed: ${error.message}`, 'Move the point'));
    },
    draw(pen, { width, height }) {
      if (!reel) return;
      const { theme, state } = app, shape = shapeOf(state.b, state.h), { b, h } = state;
      const soil = Math.min(SOIL, 0.18 * height), high = Math.max(h, 2 * shape.radius);
      // Room for a block that lies on the side to which it falls.
      const unit = Math.min((height - soil - 40) / high, width / Math.max(1.1 * h + 2 * b, 3.2 * b));
      const x = 0.5 * (width + (reel.falls ? Math.sign(reel.angle[reel.angle.length - 1]) * h * unit : 0));
      const level = Math.round(Math.min(height - soil, 0.55 * height + 0.5 * high * unit));
      drawGround(pen, theme, { width, height: soil, y: level, x, unit });
      drawReel(pen, theme, reel, time, { x, y: level, unit, shape });
      const at = Math.min(reel.base.length - 1, Math.round(time / reel.step)), push = reel.base[at] ?? 0;
      let most = 1;
      for (const value of reel.base) most = Math.max(most, Math.abs(value));
      const to = x + (push / most) * 0.4 * width, y = level + 0.62 * soil, turned = Math.sign(push) * 7;
      drawLine(pen, theme, [x, y, to, y], 'base', 3);
      for (const up of [-5, 5]) drawLine(pen, theme, [to - turned, y + up, to, y], 'base', 3);
      write(pen, theme, `${time.toFixed(2)} s`, 4, 14);
      write(pen, theme, words(), 4, 32, { role: 'motion', bold: true });
      write(pen, theme, `ground ${gText(push * reel.block.alpha)}`, width - 4, 14, { role: 'base', bold: true, align: 'right' });
      scrub.value = String(Math.round((1000 * time) / (seconds() || 1)));
    },
    sentence() {
      const { b, h } = app.state;
      return `A block of ${b} m by ${h} m on its ground: ${words()} at ${time.toFixed(2)} s.`;
    },
    table() {
      const { impacts } = reel ?? { impacts: { time: [], side: [], speed: [] } };
      const corners = Array.from(impacts.side, (each) => (each === 1 ? 'right' : 'left'));
      return tableOf(['time [s]', impacts.time], ['corner', corners],
        [pageUnits(app, app.state, true).velocity, impacts.speed, 'before the impact: ']);
    },
    keys(event) {
      if (event.key !== ' ') return false;
      turn();
      return true;
    },
  };
  return panel;
}
