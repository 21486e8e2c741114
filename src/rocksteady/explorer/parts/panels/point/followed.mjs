// The motion of the point that is chosen: computed once, shown by all panels of the point.

import { attractorOf } from '../../physics/attractor.mjs';
import { courseOf, historyOf, motionAt, periodTimes, sectionOf } from '../../physics/history.mjs';
import { FULL_TURN, NoStart } from '../../physics/start.mjs';
import { steadyStatesAt } from '../../physics/steady.mjs';
import { blockNumbers, caseOf, defaultState, equationsOf, startOf } from '../../shell/state.mjs';

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { Attractor } from '../../physics/attractor.mjs' */
/** @import { Case, Measures, Start } from '../../physics/case.mjs' */
/** @import { Course, History } from '../../physics/history.mjs' */
/** @import { Impact } from '../../physics/start.mjs' */
/** @import { SteadyFacts } from '../../physics/steady.mjs' */

/**
 * The motion from the start that is chosen.
 * @typedef {object} Followed
 * @property {Case} given
 * @property {Start} start
 * @property {Measures} block
 * @property {Attractor} attractor
 * @property {History} history
 * @property {Course} course  of the history
 * @property {Course|null} orbit  one period of the attractor
 * @property {number} settled  periods until the attractor was known
 * @property {{ angle: Float64Array, velocity: Float64Array }} strobe  the state once a period
 * @property {SteadyFacts[]} steady  closed forms of the linear model
 * @property {boolean} whole  whether it was followed as far as a settled view asks
 */

/** @typedef {{ key: string, followed: Followed | null, error: NoStart | null, asked: boolean }} Known */

export const FOLLOWED_KEYS = [
  'model', 'A', 'W', 'r', 'rh', 'b', 'h', 'start', 'cycles', 'units',
];
const MOTION_KEYS = ['model', 'A', 'W', 'r', 'rh', 'b', 'h', 'start', 'cycles'];
const GHOSTS = 3;
const FIRST_CYCLES = 150; // on this thread, at once; what is not known then is left to a worker
const FIRST_FLIGHTS = 4_000;
const COURSE_SAMPLES = 32; // a period of the shaking
const ORBIT_SAMPLES = 64;

/**
 * Return the motion of the present state; a start that there is not leaves the last one.
 * @param {App} app
 * @param {boolean} settled
 * @returns {Known}
 */
export function followedOf(app, settled) {
  const { state, shared } = app;
  const key = MOTION_KEYS.map((name) => state[/** @type {keyof State} */ (name)]).join(' ');
  /** @type {Known | undefined} */
  const known = shared.followed;
  if (known?.key === key) {
    if (settled) goOn(app, known);
    return known;
  }
  /** @type {Known} */
  const next = { key, followed: known?.followed ?? null, error: null, asked: false };
  try {
    next.followed = followFirst(app);
  } catch (error) {
    if (!(error instanceof NoStart)) throw error;
    next.error = error;
  }
  shared.followed = next;
  if (next.followed) shared.history = next.followed.history;
  if (settled) goOn(app, next);
  app.touch('history');
  return next;
}

/**
 * Follow a motion as far as it can be followed at once.
 * @param {App} app
 * @returns {Followed}
 */
function followFirst({ kernels, state }) {
  const given = caseOf(kernels, state), start = startOf(state);
  const history = historyOf(kernels, given, start, state.cycles, FIRST_FLIGHTS);
  // Bounces may come in such numbers that one period takes seconds.
  const periods = (history.endTime * given.frequencyRatio) / FULL_TURN;
  const dense = history.status === 'undecided';
  const cycles = history.status === 'overturned' ? FIRST_CYCLES : Math.min(FIRST_CYCLES,
    Math.floor((FIRST_FLIGHTS * periods) / Math.max(1, history.flights)));
  const attractor = cycles < 1 || dense ? notFollowed(history)
    : attractorOf(kernels, given, start, cycles);
  const decided = attractor.kind !== 'undecided' && attractor.kind !== 'aperiodic';
  const whole = decided && attractor.after < cycles && !dense;
  return assembled(kernels, state, { given, start, attractor, history, whole });
}

/**
 * Have the browser compile, a part a turn, what the first view needs at once: on a plain motion;
 * then follow that of the first view.
 * @param {App} app
 * @param {() => Promise<void>} turn
 */
export async function warmUp(app, turn) {
  const { kernels, state } = app;
  const given = caseOf(kernels, { ...defaultState(), model: equationsOf(state) });
  for (const follow of [historyOf, attractorOf]) {
    follow(kernels, given, { kind: 'rest' }, 1, FIRST_FLIGHTS);
    await turn();
  }
  if (state.tab === 'explore' || state.tab === 'basins') followedOf(app, false);
  await turn();
}

/**
 * Return what is known of the attractor of a motion that has not been followed.
 * @param {History} history
 * @returns {Attractor}
 */
function notFollowed({ phase }) {
  const unknown = { orbit: null, period: null, highest: null, lowest: null, impacts: null };
  return { kind: 'undecided', ...unknown, lyapunov: NaN, after: 0, growth: 1,
    reason: 'it has too many impacts', state: null, start: null, phase };
}

/**
 * Have a worker follow a motion as far as a settled view asks, unless that is known already.
 * @param {App} app
 * @param {Known} known
 */
function goOn(app, known) {
  const { followed } = known;
  keepGhost(app, known);
  if (known.asked || known.error || !followed || followed.whole) return;
  known.asked = true;
  const { given, start } = followed, { kernels, shared, state } = app;
  /** @param {Pick<Followed, 'attractor' | 'history'>} found */
  const complete = ({ attractor, history }) => {
    if (shared.followed !== known) return;
    known.followed = assembled(kernels, state, { given, start, attractor, history, whole: true });
    shared.history = history;
    if (shared.present?.key === known.key) shared.present.followed = known.followed;
    app.touch('history');
  };
  const asked = { given, start, cycles: state.cycles };
  app.pool.ask('followMotion', asked, { key: 'followed', priority: -2 }).then(
    (found) => found && complete(found),
    ({ message }) => complete({
      attractor: { ...followed.attractor, kind: 'undecided', reason: message },
      history: followed.history,
    }),
  );
}

/**
 * Return a motion with what is drawn of it.
 * @param {App['kernels']} kernels
 * @param {State} state
 * @param {Pick<Followed, 'given' | 'start' | 'attractor' | 'history' | 'whole'>} found
 * @returns {Followed}
 */
function assembled(kernels, state, { given, start, attractor, history, whole }) {
  return {
    given,
    start,
    block: blockNumbers(kernels, state),
    attractor,
    history,
    course: courseOf(kernels, given, history, COURSE_SAMPLES, 4000),
    orbit: orbitCourse(kernels, given, attractor.orbit ? attractor.start : null,
      attractor.period ?? 1)?.course ?? null,
    settled: attractor.after,
    strobe: motionAt(kernels, given, history, periodTimes(given, history)),
    steady: steadyStatesAt(kernels, given, [1]),
    whole,
  };
}

/**
 * Return some periods of a periodic motion as a closed curve.
 * @param {App['kernels']} kernels
 * @param {Case} given
 * @param {Start | null} start
 * @param {number} periods
 * @param {number} [samples]  a period of the shaking
 * @returns {{ course: Course, states: Impact[] } | null}  with the states after its impacts
 */
export function orbitCourse(kernels, given, start, periods, samples = ORBIT_SAMPLES) {
  if (!start) return null;
  const run = historyOf(kernels, given, start, periods, FIRST_FLIGHTS);
  const course = courseOf(kernels, given, run, samples, 3000);
  // Back at the first state: after the last impact.
  const closed = (/** @type {Float64Array} */ values, /** @type {number} */ end) =>
    Float64Array.of(...values, end);
  return {
    course: {
      periods: closed(course.periods, course.periods[course.periods.length - 1]),
      angle: closed(course.angle, course.angle[0]),
      velocity: closed(course.velocity, course.velocity[0]),
    },
    states: start.kind === 'impact' ? [start, ...sectionOf(run)] : [],
  };
}

/**
 * Keep the motion that was seen before: the last ones stay as ghosts.
 * @param {App} app
 * @param {{ key: string, followed: Followed | null }} next
 */
function keepGhost({ shared }, { key, followed }) {
  const { present } = shared;
  if (present && present.key !== key) {
    shared.ghosts = [present.followed, ...ghostsOf(shared)].slice(0, GHOSTS);
  }
  if (followed) shared.present = { key, followed };
}

/**
 * Return the motions of the last points, the newest first.
 * @param {App['shared']} shared
 * @returns {Followed[]}
 */
export function ghostsOf(shared) {
  return shared.ghosts ?? [];
}

/**
 * Update a panel of the point; return its motion, null where there is none.
 * @param {App} app
 * @param {Panel} panel
 * @param {boolean} settled
 * @param {boolean} [full]  whether it says in full why there is no such start
 * @returns {Followed | null}
 */
export function followIn(app, panel, settled, full = false) {
  const { followed, error } = followedOf(app, settled);
  if (!error) app.note(panel, '');
  else if (!full) app.fail(panel, 'There is no such start here', 'Start at rest, or move the point');
  else {
    const fix = `${error.fix[0].toUpperCase()}${error.fix.slice(1)}`;
    app.fail(panel, `There is no such start: ${error.cause}`, fix);
  }
  return followed;
}

/**
 * Return the state at the time of the shared cursor, null past the end.
 * @param {App} app
 * @param {Followed} followed
 * @returns {{ time: number, angle: number, velocity: number } | null}  the time in periods
 */
export function cursorState(app, { given, history }) {
  const time = app.shared.cursor ?? 0;
  const at = (time * FULL_TURN) / given.frequencyRatio;
  if (at > history.endTime) return null;
  const { angle, velocity } = motionAt(app.kernels, given, history, [at]);
  return { time, angle: angle[0], velocity: velocity[0] };
}
