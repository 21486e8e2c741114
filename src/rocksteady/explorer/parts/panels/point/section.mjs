// The Poincare section of the point: states after impacts, or the state once a period.

import { frame } from '../../draw/frame.mjs';
import { drawMark, points } from '../../draw/marks.mjs';
import { mixed } from '../../draw/theme.mjs';
import { numeral } from '../../draw/scale.mjs';
import { sectionOf } from '../../physics/history.mjs';
import { FULL_TURN } from '../../physics/start.mjs';
import { make } from '../../shell/layout.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { FOLLOWED_KEYS, cursorState, followIn, ghostsOf } from './followed.mjs';
import { otherMotions } from './motions.mjs';
import { GHOST_ALPHAS } from './phase.mjs';
import { panelUnits, roundLimit } from './units.mjs';

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Impact } from '../../physics/start.mjs' */
/** @import { SectionPoints } from '../../physics/history.mjs' */
/** @import { Followed } from './followed.mjs' */

const LONG_SECTION = 1500; // periods of an aperiodic motion
const QUARTERS = ['0', 'π/2', 'π', '3π/2', '2π'];

/**
 * Make the panel of the Poincare section.
 * @param {App} app
 * @returns {Panel}
 */
export function makeSectionPanel(app) {
  /** @type {Followed | null} */
  let followed = null;
  let once = false;
  /** @type {{ of: Followed, points: SectionPoints } | null} */
  let long = null;

  const askLong = (/** @type {Followed} */ asked) => {
    const { kind, orbit, state } = asked.attractor;
    const wanders = kind === 'aperiodic' || (kind === 'undecided' && !orbit);
    if (!wanders || !state || !asked.whole || long?.of === asked) return;
    const start = { kind: 'impact', ...state };
    const args = { given: asked.given, start, cycles: LONG_SECTION };
    app.pool.ask('longSection', args, { key: 'section', priority: 2 }).then((found) => {
      if (!found || followed !== asked) return;
      long = { of: asked, points: found };
      app.redraw(panel);
    }, (error) => console.error(error));
  };

  /** @type {Panel} */
  const panel = {
    name: 'section',
    title: 'Poincaré section',
    uses: [...FOLLOWED_KEYS, 'cursor', 'motions', 'history'],
    placed() {
      const choice = /** @type {HTMLSelectElement} */ (make('select', { 'aria-label': 'section' },
        make('option', { value: '' }, 'after impacts'),
        make('option', { value: 'once' }, 'once a period')));
      choice.addEventListener('change', () => {
        once = choice.value === 'once';
        app.redraw(panel);
      });
      panel.bar?.append(choice);
    },
    update(_state, { changed, settled }) {
      if (changed.size === 1 && changed.has('cursor')) return;
      followed = followIn(app, panel, settled);
      if (followed && settled) askLong(followed);
    },
    draw(pen, size) {
      if (!followed) return;
      if (once) drawStrobe(app, pen, size, followed, long?.of === followed ? long.points : null);
      else drawSection(app, pen, size, followed, long?.of === followed ? long.points : null);
    },
    sentence() {
      if (!followed) return 'No Poincaré section.';
      const { attractor, history } = followed, all = history.impacts.time.length;
      if (attractor.orbit) {
        const count = attractor.orbit.states.length;
        const many = `${count} point${count === 1 ? '' : 's'}`;
        return `States after impacts: the motion returns to ${many}.`;
      }
      return `States after ${all} impact${all === 1 ? '' : 's'}: ${attractor.kind}.`;
    },
    table() {
      if (!followed) return { columns: [], rows: [] };
      const { speed } = panelUnits(app, followed.block), met = sectionOf(followed.history);
      return tableOf(['side', met.map(({ side }) => side)], ['phase [rad]', met.map(({ phase }) => phase)],
        [speed, met.map((each) => each.speed)]);
    },
  };
  return panel;
}

/**
 * Draw the states after impacts: phase of the shaking against speed.
 * @param {App} app
 * @param {CanvasRenderingContext2D} pen
 * @param {{ width: number, height: number }} size
 * @param {Followed} followed
 * @param {SectionPoints | null} long
 */
function drawSection(app, pen, size, followed, long) {
  const { theme } = app, { velocity, speed } = panelUnits(app, followed.block);
  const { orbit } = followed.attractor;
  const since = (followed.settled * FULL_TURN) / followed.given.frequencyRatio;
  const states = sectionOf(followed.history);
  const late = orbit ? sectionOf(followed.history, since) : states;
  const others = otherMotions(app, followed).flatMap((other) => other.states);
  let fastest = 0;
  for (const { speed } of [...states, ...others, ...(orbit ? orbit.states : [])]) {
    fastest = Math.max(fastest, speed);
  }
  const onto = frame(pen, size, {
    theme,
    x: { from: 0, to: FULL_TURN, label: 'phase of the shaking at the impact [rad]',
      ticks: QUARTERS.map((label, k) => ({ value: (k * Math.PI) / 2, label })) },
    y: { from: 0, to: roundLimit(fastest || 1) * velocity.factor,
      label: `${speed.label}  ● to the left  ○ to the right`, far: speed.far },
  });
  const put = (/** @type {Impact[]} */ some, /** @type {object} */ style) => {
    for (const side of [1, -1]) {
      const these = some.filter((each) => each.side === side);
      points(pen, onto, these.map(({ phase }) => phase),
        these.map(({ speed }) => speed * velocity.factor),
        { ...style, mark: side > 0 ? 'dot' : 'ring' });
    }
  };
  ghostsOf(app.shared).forEach(({ attractor }, k) => {
    if (!attractor.orbit) return;
    const style = { colour: theme.quiet, radius: 3.5, alpha: GHOST_ALPHAS[k] };
    put(attractor.orbit.states.slice(0, 200), style);
  });
  put(others.slice(0, 400), { colour: mixed(theme.motion, theme.paper, 0.45), radius: 4 });
  if (long) {
    points(pen, onto, long.phase, long.speed.map((speed) => speed * velocity.factor),
      { colour: theme.aperiodicLine, radius: 0.8 });
  }
  put(states.slice(0, 2000), { colour: theme.motion, radius: 1.6, alpha: 0.45 });
  put(late.slice(0, 2000), { colour: theme.motion, radius: 1.6 });
  if (orbit) {
    const style = { colour: theme.motion, radius: 5, casing: theme.paper };
    put(orbit.states.slice(0, 200), style);
  }
  markPassed(app, pen, onto, followed, states, velocity.factor);
}

/**
 * Mark the last impact before the shared cursor.
 * @param {App} app
 * @param {CanvasRenderingContext2D} pen
 * @param {Frame} onto
 * @param {Followed} followed
 * @param {Impact[]} states
 * @param {number} factor
 */
function markPassed(app, pen, onto, { history, given }, states, factor) {
  const at = ((app.shared.cursor ?? 0) * FULL_TURN) / given.frequencyRatio;
  let last = -1;
  while (last + 1 < states.length && history.impacts.time[last + 1] <= at) last++;
  if (last < 0) return;
  const [x, y] = [onto.x.at(states[last].phase), onto.y.at(states[last].speed * factor)];
  drawMark(pen, 'ring', x, y, { colour: onto.theme.ink, radius: 7, casing: onto.theme.paper });
}

/**
 * Draw the state of the block once a period of the shaking.
 * @param {App} app
 * @param {CanvasRenderingContext2D} pen
 * @param {{ width: number, height: number }} size
 * @param {Followed} followed
 * @param {SectionPoints | null} long
 */
function drawStrobe(app, pen, size, followed, long) {
  const { theme } = app, { angle, velocity } = panelUnits(app, followed.block);
  const { strobe, history, attractor } = followed;
  const across = roundLimit(Math.min(history.peak, 1.4));
  const along = roundLimit(Math.min(history.peakVelocity, 2));
  const onto = frame(pen, size, {
    theme,
    x: { ...angle, from: -across * angle.factor, to: across * angle.factor },
    y: { ...velocity, from: -along * velocity.factor, to: along * velocity.factor },
  });
  const us = strobe.angle.map((u) => u * angle.factor);
  const vs = strobe.velocity.map((v) => v * velocity.factor);
  if (long) {
    points(pen, onto, long.angle.map((u) => u * angle.factor),
      long.velocity.map((v) => v * velocity.factor), { colour: theme.aperiodicLine, radius: 0.8 });
  }
  points(pen, onto, us, vs, { colour: theme.motion, radius: 2, alpha: 0.6 });
  const { period } = attractor;
  if (period && us.length > period) {
    points(pen, onto, us.subarray(-period), vs.subarray(-period),
      { colour: theme.motion, radius: 5, casing: theme.paper });
  }
  const now = cursorState(app, followed);
  if (!now) return;
  const k = Math.min(Math.floor(now.time + 1e-9), us.length - 1);
  drawMark(pen, 'ring', onto.x.at(us[k]), onto.y.at(vs[k]),
    { colour: theme.ink, radius: 7, casing: theme.paper });
}

/** Return a multiplier as people write it. @param {[number, number]} multiplier */
export function multiplierText([real, imaginary]) {
  if (imaginary === 0) return numeral(real, 3);
  return `${numeral(real, 3)} ${imaginary < 0 ? '−' : '+'} ${numeral(Math.abs(imaginary), 3)}i`;
}
