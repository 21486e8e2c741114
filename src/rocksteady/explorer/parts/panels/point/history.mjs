// The time history of the point: angle over time with its impacts, the base beneath.

import { frame } from '../../draw/frame.mjs';
import { curve, drawMark, note, rule } from '../../draw/marks.mjs';
import { numeral } from '../../draw/scale.mjs';
import { FULL_TURN } from '../../physics/start.mjs';
import { make } from '../../shell/layout.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { MOTION_NAMES, NEVER_LIFTS } from '../../words.mjs';
import { FOLLOWED_KEYS, cursorState, followIn } from './followed.mjs';
import { angleWords, panelUnits, roundLimit } from './units.mjs';

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Followed } from './followed.mjs' */
/** @import { Course } from '../../physics/history.mjs' */

const SHOWN_PERIODS = [6, 20, 60, 0]; // 0 for all
const MOST_IMPACT_MARKS = 400;
const BASE_SAMPLES = 24; // a period
const BASE_PART = 0.13; // of the height of the box
const STILL_FOR = 300; // [ms] after which hovering moves the cursor of a film that stands

/**
 * Make the panel of the time history.
 * @param {App} app
 * @returns {Panel}
 */
export function makeHistoryPanel(app) {
  /** @type {Followed | null} */
  let followed = null;
  let shown = 20, moved = 0, scrubbing = false;
  /** @type {Frame | null} */
  let seen = null;

  const periods = () => {
    const count = Math.min(shown || app.state.cycles, app.state.cycles);
    // A fall is over soon.
    return followed?.history.status === 'overturned'
      ? Math.min(count, Math.ceil(1.5 * endOf(followed) + 0.2)) : count;
  };
  /** The first period shown: pages follow the cursor. */
  const first = () => {
    const page = periods(), last = Math.max(0, Math.ceil(endOf(followed)) - 1e-9);
    const at = Math.min(app.shared.cursor ?? 0, last);
    return Math.floor(at / page) * page;
  };
  const scrub = (/** @type {MouseEvent} */ event) => {
    if (!seen || !followed) return;
    const canvas = /** @type {HTMLCanvasElement} */ (panel.canvas);
    const x = event.clientX - canvas.getBoundingClientRect().left;
    const { time } = panelUnits(app, followed.block);
    const at = seen.x.value(x) / time.factor;
    const from = first();
    app.shared.cursor = Math.min(Math.max(at, from), from + periods() - 1e-9, endOf(followed));
    app.touch('cursor');
  };

  /** @type {Panel} */
  const panel = {
    name: 'history',
    title: 'Time history',
    uses: [...FOLLOWED_KEYS, 'cursor', 'history'],
    placed() {
      const canvas = /** @type {HTMLCanvasElement} */ (panel.canvas);
      panel.bar?.append(periodsChoice((value) => {
        shown = value;
        app.redraw(panel);
      }));
      canvas.addEventListener('pointerdown', (event) => {
        scrubbing = true;
        canvas.setPointerCapture(event.pointerId);
        scrub(event);
      });
      canvas.addEventListener('pointermove', (event) => {
        const still = performance.now() - moved > STILL_FOR;
        if (scrubbing || (still && event.pointerType === 'mouse')) {
          scrub(event);
          if (!scrubbing) moved = -Infinity; // this move was no film's
        }
      });
      for (const end of ['pointerup', 'pointercancel']) {
        canvas.addEventListener(end, () => {
          scrubbing = false;
        });
      }
    },
    update(_state, { changed, settled }) {
      if (changed.size === 1 && changed.has('cursor')) {
        moved = moved === -Infinity ? 0 : performance.now();
        return;
      }
      followed = followIn(app, panel, settled);
      if (followed?.history.status === 'undecided') {
        const seenTo = numeral(endOf(followed), 3);
        const { flights } = followed.history;
        app.note(panel, `${flights} flights in ${seenTo} periods: what follows is left out.`);
      }
    },
    draw(pen, size) {
      if (!followed) return;
      const { theme } = app, { angle, time } = panelUnits(app, followed.block);
      const from = first(), to = from + periods();
      const falls = followed.history.status === 'overturned';
      const limit = roundLimit(falls ? 2 : Math.min(followed.history.peak || 1, 2));
      const onto = frame(pen, size, {
        theme,
        x: {
          from: from * time.factor, to: to * time.factor,
          label: `${time.label}; lowest curve: base acceleration`, far: time.far,
        },
        y: { ...angle, from: -limit * angle.factor * 1.35, to: limit * angle.factor },
      });
      seen = onto;
      const scaled = (/** @type {Course} */ course) => ({
        xs: course.periods.map((x) => x * time.factor),
        ys: course.angle.map((y) => y * angle.factor),
      });
      drawBase(pen, onto, followed, from, to, time.factor);
      rule(pen, onto, { y: 0 }, { colour: theme.edge });
      for (const side of [-1, 1]) {
        rule(pen, onto, { y: side * angle.factor }, { colour: theme.limit, dash: [6, 4] });
      }
      const { xs, ys } = scaled(part(followed.course, from, to));
      const settled = followed.settled * time.factor;
      const [before, after] = splitAt(xs, ys, settled);
      curve(pen, onto, ...before, { colour: theme.motion, width: 1.4, alpha: 0.6 });
      curve(pen, onto, ...after, { colour: theme.motion, width: 1.9 });
      drawImpacts(pen, onto, followed, from, to, time.factor);
      drawEvents(pen, onto, followed, time.factor, angle.factor, limit);
      const now = cursorState(app, followed);
      if (now) {
        rule(pen, onto, { x: now.time * time.factor }, { colour: theme.ink, width: 1 });
        const [x, y] = [onto.x.at(now.time * time.factor), onto.y.at(now.angle * angle.factor)];
        if (x >= onto.box.left && x <= onto.box.left + onto.box.width) {
          drawMark(pen, 'dot', x, y, { colour: theme.ink, radius: 4, casing: theme.paper });
        }
      }
    },
    sentence() {
      if (!followed) return 'No time history.';
      const { history, block } = followed, { impactCount } = history;
      const peak = angleWords(app, block, history.peak);
      const count = `${impactCount} impact${impactCount === 1 ? '' : 's'}`;
      return `Angle over ${numeral(endOf(followed), 3)} periods of the shaking: ${count}, peak `
        + `${peak}, ${statusWords(app, followed)}.`;
    },
    table() {
      if (!followed) return { columns: [], rows: [] };
      const { angle, velocity, time } = panelUnits(app, followed.block), { course } = followed;
      return tableOf([time, course.periods], [angle, course.angle], [velocity, course.velocity]);
    },
    keys(event) {
      const step = event.shiftKey ? 1 : 1 / 16;
      const by = { ArrowLeft: -step, ArrowRight: step }[event.key];
      if (by === undefined || !followed) return false;
      const at = (app.shared.cursor ?? 0) + by;
      app.shared.cursor = Math.min(Math.max(at, 0), endOf(followed));
      app.touch('cursor');
      return true;
    },
  };
  return panel;
}

/**
 * Make the choice of how many periods are seen at once.
 * @param {(periods: number) => void} choose
 */
function periodsChoice(choose) {
  const options = SHOWN_PERIODS.map((count) =>
    make('option', { value: String(count) }, count ? `${count} periods` : 'all'));
  const select = /** @type {HTMLSelectElement} */ (
    make('select', { 'aria-label': 'periods seen at once' }, ...options));
  select.value = '20';
  select.addEventListener('change', () => choose(Number(select.value)));
  return select;
}

/** Return the end of a history in periods. @param {Followed | null} followed */
export function endOf(followed) {
  return followed ? (followed.history.endTime * followed.given.frequencyRatio) / FULL_TURN : 0;
}

/**
 * Return how the run ended, in words.
 * @param {App} app
 * @param {Followed} followed
 */
export function statusWords(app, { history, given, block }) {
  const { time } = panelUnits(app, block);
  const when = (/** @type {number} */ at) => {
    const shown = numeral(((at * given.frequencyRatio) / FULL_TURN) * time.factor, 3);
    return time.unit === 's' ? `${shown} s` : `${shown} periods`;
  };
  if (history.overturnTime !== null) return `falls at ${when(history.overturnTime)}`;
  if (history.restTime !== null) {
    return history.restTime === 0 ? NEVER_LIFTS : `${MOTION_NAMES.rest} at ${when(history.restTime)}`;
  }
  return app.theme.words[history.status === 'rocking' ? 'rocking' : 'undecided'];
}

/**
 * Return the part of a curve between two times, with a point more at either end.
 * @param {Course} course
 * @param {number} from
 * @param {number} to
 * @returns {Course}
 */
function part({ periods, angle, velocity }, from, to) {
  let first = 0, last = periods.length;
  while (first + 1 < last && periods[first + 1] < from) first++;
  while (last - 1 > first && periods[last - 2] > to) last--;
  const cut = (/** @type {Float64Array} */ values) => values.subarray(first, last);
  return { periods: cut(periods), angle: cut(angle), velocity: cut(velocity) };
}

/**
 * Return a curve in two, before and after a place.
 * @param {Float64Array} xs
 * @param {Float64Array} ys
 * @param {number} place
 * @returns {[[Float64Array, Float64Array], [Float64Array, Float64Array]]}
 */
function splitAt(xs, ys, place) {
  let cut = 0;
  while (cut < xs.length && xs[cut] < place) cut++;
  return [
    [xs.subarray(0, cut + 1), ys.subarray(0, cut + 1)], [xs.subarray(cut), ys.subarray(cut)],
  ];
}

/**
 * Draw the acceleration of the base, in a band at the foot of the box.
 * @param {CanvasRenderingContext2D} pen
 * @param {Frame} onto
 * @param {Followed} followed
 * @param {number} from
 * @param {number} to
 * @param {number} factor
 */
function drawBase(pen, onto, { history }, from, to, factor) {
  const count = Math.min(4000, Math.max(2, Math.ceil((to - from) * BASE_SAMPLES)));
  const { box, theme } = onto, xs = [], ys = [];
  const middle = box.top + box.height * (1 - BASE_PART / 2);
  for (let k = 0; k <= count; k++) {
    const time = from + ((to - from) * k) / count;
    const sine = Math.sin(FULL_TURN * time + history.phase);
    xs.push(time * factor);
    ys.push(onto.y.value(middle - 0.42 * BASE_PART * box.height * sine));
  }
  curve(pen, onto, xs, ys, { colour: theme.base, width: 1, alpha: 0.8 });
}

/**
 * Mark the impacts on the line of no rotation.
 * @param {CanvasRenderingContext2D} pen
 * @param {Frame} onto
 * @param {Followed} followed
 * @param {number} from
 * @param {number} to
 * @param {number} factor
 */
function drawImpacts(pen, onto, { history, given }, from, to, factor) {
  const { time } = history.impacts, { theme } = onto;
  const periods = given.frequencyRatio / FULL_TURN, level = onto.y.at(0);
  let count = 0, last = -Infinity;
  pen.save();
  pen.strokeStyle = theme.impact;
  pen.lineWidth = 1.5;
  pen.beginPath();
  for (let k = 0; k < time.length && count < MOST_IMPACT_MARKS; k++) {
    const at = time[k] * periods;
    if (at < from || at > to) continue;
    const x = onto.x.at(at * factor);
    if (x - last < 1) continue;
    pen.moveTo(x, level - 4);
    pen.lineTo(x, level + 4);
    last = x;
    count++;
  }
  pen.stroke();
  pen.restore();
}

/**
 * Write where the motion has settled, the block falls or comes to rest.
 * @param {CanvasRenderingContext2D} pen
 * @param {Frame} onto
 * @param {Followed} followed
 * @param {number} factor
 * @param {number} degrees
 * @param {number} limit
 */
function drawEvents(pen, onto, followed, factor, degrees, limit) {
  const { history, given } = followed, { theme, box } = onto;
  const periods = given.frequencyRatio / FULL_TURN;
  const put = (/** @type {number} */ at, /** @type {string} */ text, level = box.top + 10) => {
    const x = onto.x.at(at * periods * factor);
    if (x < box.left - 1 || x > box.left + box.width + 1) return;
    rule(pen, onto, { x: at * periods * factor }, { colour: theme.edge, dash: [2, 3] });
    note(pen, onto, text, x + 5, level, { align: 'left' });
  };
  if (history.overturnTime !== null) {
    const side = Math.sign(followed.course.angle[followed.course.angle.length - 1]);
    put(history.overturnTime, theme.words.overturned, onto.y.at(-0.5 * side * degrees)); // clear of the curve
  } else if (history.restTime !== null) put(history.restTime, theme.words.rest);
  else if (followed.attractor.orbit) put(followed.settled / periods, 'settled');
  if (limit >= 1) {
    const right = box.left + box.width - 4;
    note(pen, onto, 'θ = ±α', right, onto.y.at(-degrees) - 8, { align: 'right' });
  }
}
