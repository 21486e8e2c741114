// The film: the block on its moving ground, played, paused, stepped and scrubbed.

/** @import { App, Panel } from '../shell/app.mjs' */
/** @import { History } from '../physics/history.mjs' */
/** @import { Case } from '../physics/case.mjs' */
/** @import { Kernels } from '../kernels/loader.mjs' */
import { motionAt } from '../physics/history.mjs';
import { FLIGHT_COLUMNS, FLIGHT_SIDE } from '../physics/run.mjs';
import { make } from '../shell/layout.mjs';
import { blockNumbers, caseOf } from '../shell/state.mjs';
import { tableOf } from '../shell/tables.mjs';
import { pageUnits } from '../shell/units.mjs';
import { LYING, drawBlockScene, shapeOf } from './scene.mjs';

const FILM_SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4]; // of real time
const FILM_FACTORS = [1, 3, 10, 30, 100]; // of the rotation
const SEEN_LEAST = 0.035; // rotation [rad] below which it is enlarged
const FLASH_SECONDS = 0.35;
const HOLD_SECONDS = 1; // for which the last picture stays
const LAID_SECONDS = 0.5; // for which a block that has fallen is seen to lie
const FILM_HEAD = 8; // above the block [px]; texts stand beside it
const FILM_STEP = 1 / 32; // [periods]

/**
 * Return a number with its sign as axes write it, and none where it shows 0.
 * @param {number} value
 * @param {number} digits
 */
export function signedText(value, digits) {
  const text = value.toFixed(digits);
  if (Number(text) === 0) return text.replace('-', '');
  return value < 0 ? text.replace('-', '−') : `+${text}`;
}

/**
 * Return the index of the last time that is not after a given one; -1 where all are.
 * @param {ArrayLike<number>} times
 * @param {number} time
 */
export function lastBefore(times, time) {
  let low = -1, high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/**
 * Return angle and side of the block at a time; past the end of one that falls, a free fall.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {History} history
 * @param {number} time
 * @returns {{ angle: number, side: number }}
 */
export function filmedState(kernels, given, history, time) {
  const { starts, rows, endTime } = history;
  const row = Math.max(lastBefore(starts, Math.min(time, endTime)), 0), at = row * FLIGHT_COLUMNS;
  const flight = {
    ...history,
    flights: 1,
    starts: starts.subarray(row, row + 1),
    rows: rows.subarray(at, at + FLIGHT_COLUMNS),
  };
  const found = motionAt(kernels, given, flight, [Math.min(time, endTime)]);
  const [[angle], [velocity], side] = [found.angle, found.velocity, rows[at + FLIGHT_SIDE]];
  if (time <= endTime || history.status !== 'overturned') return { angle, side };
  const since = Math.min(time - endTime, 20);
  return { angle: side + (angle - side) * Math.cosh(since) + velocity * Math.sinh(since), side };
}

/**
 * Return how long a block that falls takes from its last state to lie on the ground.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {History} history
 */
export function fallTime(kernels, given, history) {
  const lying = (/** @type {number} */ time) => {
    const { angle, side } = filmedState(kernels, given, history, history.endTime + time);
    return side * angle * given.alpha >= LYING;
  };
  let low = 0, high = 20;
  while (high - low > 1e-3) {
    const middle = 0.5 * (low + high);
    if (lying(middle)) high = middle;
    else low = middle;
  }
  return high;
}

/**
 * Return the factor by which the rotation is drawn enlarged: 1 where it can be seen.
 * @param {number} largest  rotation [rad]
 */
export function enlargement(largest) {
  if (!(largest > 0)) return 1;
  const enough = FILM_FACTORS.find((factor) => factor * largest >= SEEN_LEAST);
  return enough ?? FILM_FACTORS[FILM_FACTORS.length - 1];
}

/**
 * Return the impacts that are seen at a time: a block that falls from its positive side stood on
 * the left corner, and the right one strikes.
 * @param {History} history
 * @param {number} at
 * @param {number} glow  how long one is seen [pivot time]
 */
export function flashesAt({ impacts }, at, glow) {
  const flashes = [];
  let strongest = 0;
  for (const speed of impacts.before) strongest = Math.max(strongest, Math.abs(speed));
  for (let k = lastBefore(impacts.time, at); k >= 0 && impacts.time[k] > at - glow; k -= 1) {
    if (flashes.length === 8) break; // those of chatter lie on one another
    const strength = Math.sqrt(Math.abs(impacts.before[k]) / strongest);
    flashes.push({ side: impacts.side[k], age: (at - impacts.time[k]) / glow, strength });
  }
  return flashes;
}

/**
 * Make the panel; `shared.cursor` is its time [periods], which other panels show too.
 * @param {App} app
 * @returns {Panel}
 */
export function makeFilmPanel(app) {
  /** @type {ReturnType<typeof makeFilmControls>} */
  let controls;
  let playing = !app.still, speed = 1, trueScale = false, inView = true;
  let frame = 0, before = 0, held = 0;

  /** @returns {History | undefined} */
  const filmed = () => app.shared.history;
  const period = () => (2 * Math.PI) / app.state.W; // [pivot time]
  const pace = () => blockNumbers(app.kernels, app.state).p; // pivot time of a second
  const falls = () => filmed()?.status === 'overturned';
  /** @type {WeakMap<History, number>} */
  const ends = new WeakMap();
  const end = () => {
    const history = filmed();
    if (!history || !falls()) return history?.endTime ?? 0;
    let lies = ends.get(history);
    if (lies === undefined) {
      const { kernels, state } = app;
      lies = history.endTime + fallTime(kernels, caseOf(kernels, state), history);
      ends.set(history, lies);
    }
    return lies + LAID_SECONDS * pace();
  };
  const now = () => Math.min((app.shared.cursor ?? 0) * period(), end());
  const fallen = () => falls() && now() >= (filmed()?.overturnTime ?? Infinity);
  const show = (/** @type {number} */ time) => {
    app.shared.cursor = Math.min(Math.max(time, 0), end()) / period();
    app.touch('cursor');
  };

  const tick = (/** @type {number} */ moment) => {
    frame = 0;
    if (!playing || !inView || document.hidden || !filmed()) return;
    const passed = before ? Math.min(moment - before, 100) / 1000 : 0;
    before = moment;
    const last = end(), time = now() + passed * speed * pace();
    held = time < last ? 0 : held + passed;
    if (held > HOLD_SECONDS) held = 0;
    show(time >= last && held === 0 ? 0 : time);
    frame = requestAnimationFrame(tick);
  };
  const wake = () => {
    if (frame) return;
    before = 0;
    frame = requestAnimationFrame(tick);
  };
  const turn = (on = !playing) => {
    playing = on;
    controls.playing(on);
    wake();
  };
  const seek = (/** @type {number} */ time) => {
    turn(false);
    show(time);
  };

  /** @type {Panel} */
  const panel = {
    name: 'film',
    title: 'Block',
    uses: ['model', 'A', 'W', 'r', 'rh', 'b', 'h', 'units', 'start', 'cycles', 'history', 'cursor'],
    placed() {
      controls = makeFilmControls(/** @type {HTMLElement} */ (panel.bar), {
        turn: () => turn(),
        seek: (part) => seek(part * end()),
        pace: (value) => {
          speed = value;
        },
        scale: (on) => {
          trueScale = on;
          app.redraw(panel);
        },
      });
      controls.playing(playing);
      new IntersectionObserver((seen) => {
        inView = seen[seen.length - 1].isIntersecting;
        if (inView) wake();
      }).observe(/** @type {HTMLCanvasElement} */ (panel.canvas));
      document.addEventListener('visibilitychange', wake);
    },
    update: wake,
    draw(pen, size) {
      const history = filmed();
      if (!history) return;
      const { kernels, state } = app, { A, W } = state, shape = shapeOf(state.b, state.h);
      const time = now(), turned = W * time + history.phase;
      const { angle, side } = filmedState(kernels, caseOf(kernels, state), history, time);
      const factor = enlargement((falls() ? 1 : history.peak) * shape.alpha);
      const glow = Math.min(FLASH_SECONDS * speed * pace(), 0.4 * period());
      const pose = {
        angle,
        side,
        ground: (-A / (W * W)) * Math.sin(turned),
        push: A * Math.sin(turned),
        fallen: fallen(),
        flashes: app.still ? [] : flashesAt(history, time, glow),
      };
      const enlarged = trueScale ? 1 : factor;
      const camera = { far: A / (W * W), pushed: A, enlarged, head: FILM_HEAD };
      drawBlockScene(pen, size, app.theme, shape, pose, camera);
      writeAbove(pen, size, pose, time, enlarged);
      controls.at(time / (end() || 1), factor);
    },
    sentence() {
      const history = filmed();
      if (!history) return 'The block on its base.';
      const { kernels, state } = app, given = caseOf(kernels, state);
      const { angle } = filmedState(kernels, given, history, now());
      const how = fallen() ? 'it falls' : `θ = ${angleText(angle)}`;
      const block = `A block of ${state.b} m by ${state.h} m`;
      return `${block} on its moving base: ${how} at ${timeText(now())}.`;
    },
    table() {
      const { time, side, before } = filmed()?.impacts ?? { time: [], side: [], before: [] };
      const units = pageUnits(app);
      return tableOf([units.time, time], ['corner', Array.from(side, (each) => (each === 1 ? 'right' : 'left'))],
        [units.velocity, Array.from(before, Math.abs), 'before the impact: ']);
    },
    keys(event) {
      if (event.key === ' ') turn();
      else if (event.key === ',') seek(now() - FILM_STEP * period());
      else if (event.key === '.') seek(now() + FILM_STEP * period());
      else return false;
      return true;
    },
  };

  const timeText = (/** @type {number} */ time) => (app.state.units === 'si'
    ? `t = ${(time / pace()).toFixed(2)} s`
    : `pt = ${time.toFixed(2)}`);
  const angleText = (/** @type {number} */ angle) => {
    const { alpha } = blockNumbers(app.kernels, app.state);
    const degrees = `${signedText((angle * alpha * 180) / Math.PI, 1)}°`;
    return app.state.units === 'si' ? degrees : `${signedText(angle, 2)} α = ${degrees}`;
  };

  /**
   * Write time, angle and acceleration above the block.
   * @param {CanvasRenderingContext2D} pen
   * @param {{ width: number, height: number }} size
   * @param {{ angle: number, push: number, fallen: boolean, side: number }} pose
   * @param {number} time
   * @param {number} enlarged
   */
  function writeAbove(pen, size, pose, time, enlarged) {
    const { theme, state } = app, { alpha } = blockNumbers(app.kernels, state);
    pen.font = theme.font;
    pen.textBaseline = 'alphabetic';
    /** @param {string} text @param {number} line @param {string} colour @param {boolean} right */
    const put = (text, line, colour, right = false) => {
      pen.fillStyle = colour;
      pen.textAlign = right ? 'right' : 'left';
      pen.fillText(text, right ? size.width - 4 : 4, 14 + 18 * line);
    };
    put(timeText(time), 0, theme.ink);
    const { overturned } = theme.words;
    const tilt = pose.side === 0 ? 'at rest' : `θ = ${angleText(pose.angle)}`;
    put(pose.fallen ? overturned : tilt, 1, pose.fallen || pose.side === 0 ? theme.ink : theme.motion);
    const pushed = state.units === 'si'
      ? `${signedText(pose.push * alpha, 3)} g`
      : `${signedText(pose.push, 2)} αg`;
    put(`base a = ${pushed}`, 1, theme.base, true);
    if (enlarged > 1) put(`tilt × ${enlarged}`, 0, theme.quiet, true);
  }
  return panel;
}

/**
 * Make the buttons of the film.
 * @param {HTMLElement} bar
 * @param {{ turn: () => void, seek: (part: number) => void, pace: (speed: number) => void,
 *   scale: (on: boolean) => void }} does
 */
function makeFilmControls(bar, does) {
  const play = make('button', { type: 'button', title: 'key: Space' });
  const scrub = /** @type {HTMLInputElement} */ (make('input', {
    type: 'range', min: '0', max: '1000', value: '0', 'aria-label': 'time of the film',
  }));
  const options = FILM_SPEEDS.map((speed) =>
    make('option', { value: String(speed) }, speed === 1 ? 'real time' : `${speed} ×`));
  const pace = /** @type {HTMLSelectElement} */ (
    make('select', { 'aria-label': 'speed of the film' }, ...options));
  const scale = make('button', { type: 'button', 'aria-pressed': 'false' }, 'true tilt');
  pace.value = '1';
  play.addEventListener('click', does.turn);
  scrub.addEventListener('input', () => does.seek(Number(scrub.value) / 1000));
  pace.addEventListener('change', () => does.pace(Number(pace.value)));
  scale.addEventListener('click', () => {
    const on = scale.getAttribute('aria-pressed') === 'false';
    scale.setAttribute('aria-pressed', String(on));
    does.scale(on);
  });
  bar.append(play, scrub, pace, scale);
  return {
    playing(/** @type {boolean} */ on) {
      play.textContent = on ? 'Pause' : 'Play';
    },
    at(/** @type {number} */ part, /** @type {number} */ factor) {
      scrub.value = String(Math.round(1000 * part));
      scale.hidden = factor === 1;
    },
  };
}
