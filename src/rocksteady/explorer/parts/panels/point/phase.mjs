// The phase portrait of the point: velocity over angle, impacts as jumps at angle 0.

import { frame } from '../../draw/frame.mjs';
import { curve, drawMark, note, rule } from '../../draw/marks.mjs';
import { mixed } from '../../draw/theme.mjs';
import { startOn } from '../../physics/coexisting.mjs';
import { startText } from '../../shell/state.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { FOLLOWED_KEYS, cursorState, followIn, ghostsOf } from './followed.mjs';
import { motionName, motionWords } from '../../words.mjs';
import { otherMotions } from './motions.mjs';
import { panelUnits, roundLimit } from './units.mjs';

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Course } from '../../physics/history.mjs' */
/** @import { Followed } from './followed.mjs' */

const NEAR_ORBIT = 14; // [px] at which a click means an orbit
export const GHOST_ALPHAS = [0.5, 0.32, 0.2];

/**
 * Make the panel of the phase portrait.
 * @param {App} app
 * @returns {Panel}
 */
export function makePhasePanel(app) {
  /** @type {Followed | null} */
  let followed = null;
  /** @type {Frame | null} */
  let seen = null;

  const coexisting = () => otherMotions(app, followed);
  /** The start of the motion whose orbit is under the pointer. */
  const startUnder = (/** @type {MouseEvent} */ event) => {
    if (!seen || !followed) return null;
    const box = /** @type {HTMLCanvasElement} */ (panel.canvas).getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const { angle, velocity } = panelUnits(app, followed.block), onto = seen;
    const far = coexisting().map(({ motion, course }) => {
      let nearest = Infinity;
      for (let k = 0; k < course.angle.length; k++) {
        const dx = onto.x.at(course.angle[k] * angle.factor) - x;
        const dy = onto.y.at(course.velocity[k] * velocity.factor) - y;
        nearest = Math.min(nearest, Math.sqrt(dx * dx + dy * dy));
      }
      return { motion, nearest };
    }).sort((one, other) => one.nearest - other.nearest);
    return far.length && far[0].nearest < NEAR_ORBIT ? startOn(far[0].motion) : null;
  };

  /** @type {Panel} */
  const panel = {
    name: 'phase',
    title: 'Phase portrait',
    uses: [...FOLLOWED_KEYS, 'cursor', 'motions', 'history'],
    placed() {
      const canvas = /** @type {HTMLCanvasElement} */ (panel.canvas);
      canvas.addEventListener('click', (event) => {
        const start = startUnder(event);
        if (start) app.set({ start: startText(start) });
      });
      canvas.addEventListener('pointermove', (event) => {
        canvas.style.cursor = startUnder(event) ? 'pointer' : '';
      });
    },
    update(_state, { changed, settled }) {
      if (changed.size === 1 && changed.has('cursor')) return;
      followed = followIn(app, panel, settled);
    },
    draw(pen, size) {
      if (!followed) return;
      const { theme } = app, { angle, velocity } = panelUnits(app, followed.block);
      const curves = coexisting();
      const { across, along } = limitsOf(followed, curves.map(({ course }) => course));
      const onto = frame(pen, size, {
        theme,
        x: { ...angle, from: -across * angle.factor, to: across * angle.factor },
        y: { ...velocity, from: -along * velocity.factor, to: along * velocity.factor },
      });
      seen = onto;
      const put = (/** @type {Course} */ course, /** @type {object} */ style) => curve(pen, onto,
        course.angle.map((u) => u * angle.factor), course.velocity.map((v) => v * velocity.factor),
        style);
      rule(pen, onto, { x: 0 });
      rule(pen, onto, { y: 0 });
      for (const side of [-1, 1]) {
        rule(pen, onto, { x: side * angle.factor }, { colour: theme.limit, dash: [6, 4] });
      }
      ghostsOf(app.shared).forEach(({ orbit }, k) => {
        if (orbit) put(orbit, { colour: theme.quiet, width: 1.2, alpha: GHOST_ALPHAS[k] });
      });
      const settled = followed.orbit !== null;
      put(followed.course, { colour: theme.motion, width: 1, alpha: settled ? 0.3 : 0.75 });
      for (const { motion, course } of curves) {
        const colour = mixed(theme.motion, theme.paper, 0.45);
        put(course, { colour, width: 2.2 });
        if (motion.kind === 'rest') {
          const style = { colour, radius: 5, casing: theme.paper };
          drawMark(pen, 'ring', onto.x.at(0), onto.y.at(0), style);
        }
      }
      if (followed.orbit) {
        put(followed.orbit, { colour: theme.motion, width: 2.2 });
        drawJumps(pen, onto, followed, velocity.factor);
      }
      if (followed.attractor.kind === 'rest') {
        const style = { colour: theme.motion, radius: 5, casing: theme.paper };
        drawMark(pen, 'dot', onto.x.at(0), onto.y.at(0), style);
      }
      if (curves.length) {
        note(pen, onto, 'pale or ○: click another motion', onto.box.left + 4,
          onto.box.top + onto.box.height - 9, { colour: theme.quiet, align: 'left' });
      }
      const now = cursorState(app, followed);
      if (now) {
        const x = onto.x.at(now.angle * angle.factor);
        const y = onto.y.at(now.velocity * velocity.factor);
        drawMark(pen, 'dot', x, y, { colour: theme.ink, radius: 4, casing: theme.paper });
      }
    },
    sentence() {
      if (!followed) return 'No phase portrait.';
      const others = coexisting().map(({ motion }) => motionName(motion)).join(' and ');
      const also = others ? ` From other starts: ${others}.` : '';
      return `Velocity over angle: the block ${motionWords(followed.attractor)}.${also}`;
    },
    table() {
      if (!followed) return { columns: [], rows: [] };
      const { angle, velocity } = panelUnits(app, followed.block);
      const course = followed.orbit ?? followed.course;
      return tableOf([angle, course.angle], [velocity, course.velocity]);
    },
  };
  return panel;
}

/**
 * Return the ends of both axes.
 * @param {Followed} followed
 * @param {Course[]} courses
 */
function limitsOf({ history, orbit, course }, courses) {
  let [across, along] = [Math.min(history.peak, 1.4), Math.min(history.peakVelocity, 2)];
  if (history.status === 'overturned') {
    across = 2;
    for (const v of course.velocity) along = Math.max(along, Math.min(Math.abs(v), 7));
  }
  for (const { angle, velocity } of orbit ? [orbit, ...courses] : courses) {
    for (const u of angle) across = Math.max(across, Math.abs(u));
    for (const v of velocity) along = Math.max(along, Math.abs(v));
  }
  return { across: roundLimit(across), along: roundLimit(along) };
}

/**
 * Draw the impacts of the orbit as jumps.
 * @param {CanvasRenderingContext2D} pen
 * @param {Frame} onto
 * @param {Followed} followed
 * @param {number} factor
 */
function drawJumps(pen, onto, { orbit }, factor) {
  if (!orbit) return;
  const { velocity, periods } = orbit;
  /** @type {number[]} */
  const ys = [];
  for (let k = 1; k < periods.length; k++) {
    if (periods[k] !== periods[k - 1] || velocity[k] === velocity[k - 1]) continue;
    ys.push(velocity[k - 1] * factor, velocity[k] * factor, NaN);
  }
  curve(pen, onto, ys.map((y) => 0 * y), ys,
    { colour: onto.theme.impact, width: 2.2 });
}
