// "Does it matter how it begins?": a block let go from a tilt, on still ground or on ground that shakes.

/** @import { App } from '../shell/app.mjs' */
/** @import { Question } from './question.mjs' */
import { START_WINDOW } from '../kernels/window.mjs';
import { startOf } from '../shell/state.mjs';
import { degreeText, gText } from '../story/words.mjs';
import { MOTION_NAMES } from '../words.mjs';
import { kindsOf, shakingOf, upTo } from './question.mjs';
import { plain, releasedSentence } from './sentence.mjs';

const DEGREE = Math.PI / 180;
const TILT = 0.8; // theta/alpha where the state has no start
const CURVE = Array.from({ length: 48 }, (_, k) => (k + 1) / 49); // theta/alpha
const LEAST_TIME = 0.2; // [s] of the curve's axis

/**
 * Make the question.
 * @param {App} app
 * @returns {Question}
 */
export function makeStart(app) {
  const shaken = () => app.state.ground === 'shaken';
  /** Where it begins: theta/alpha and du/d(pt). */
  const begin = () => {
    const start = startOf(app.state);
    const { angle, velocity } = start.kind === 'state' ? start : { angle: TILT, velocity: 0 };
    return { angle, velocity: shaken() ? velocity : 0 };
  };
  /** What is let go on what ground, as the jobs take it. */
  const released = () => {
    const { block, amplitude, ratio } = shakingOf(app);
    return { block, amplitude: shaken() ? amplitude : 0, ratio: shaken() ? ratio : 1 };
  };
  /** Degrees, and degrees a second, of the units of the state. */
  const units = () => {
    const { block: { alpha, p } } = shakingOf(app);
    return { tilt: alpha / DEGREE, turning: (alpha * p) / DEGREE };
  };
  const started = (/** @type {number} */ angle, /** @type {number} */ velocity) =>
    ({ start: `${Number(angle.toFixed(4))},${Number(velocity.toFixed(4))}` });
  return {
    title: 'Does it matter how it begins?',
    choice: { key: 'ground', words: 'What the ground does', options: [['still', 'still ground'], ['shaken', 'shaken']] },
    uses: ['ground', 'start', 'A', 'W'],
    act: () => 'Let it go',
    invited: () => ({ words: plain(`Tilt the block by its top, or drag the point on the ${shaken() ? 'map' : 'curve'}.`), facts: '' }),
    plane(_, { run, curve = [] }) {
      const { angle, velocity } = begin(), { tilt, turning } = units();
      if (!shaken()) {
        const highest = Math.max(LEAST_TIME, ...curve.map((/** @type {{ y: number }} */ { y }) => y));
        return {
          x: { from: 0, to: tilt, label: 'tilt at the start, °' },
          y: { from: 0, to: upTo(highest, LEAST_TIME), label: 'time of the first rock, s' },
          point: { x: Math.abs(angle) * tilt, y: run?.rock || 0 }, tag: degreeText(Math.abs(angle) * tilt * DEGREE),
        };
      }
      return {
        x: { from: -START_WINDOW.angle * tilt, to: START_WINDOW.angle * tilt, label: 'tilt at the start, °' },
        y: { from: -START_WINDOW.velocity * turning, to: START_WINDOW.velocity * turning, label: 'turning speed at the start, °/s' },
        point: { x: angle * tilt, y: velocity * turning },
        tag: `${degreeText(angle * tilt * DEGREE)}  ${(velocity * turning).toFixed(0)} °/s`,
      };
    },
    moved({ x, y }) {
      const { tilt, turning } = units();
      return shaken() ? started(x / tilt, y / turning) : started(Math.min(x / tilt, CURVE[CURVE.length - 1]), 0);
    },
    kinds: () => kindsOf(app, { still: MOTION_NAMES.rest, goesOn: MOTION_NAMES.symmetric, falls: true }),
    cells() {
      if (!shaken()) return null;
      const { angle, velocity } = START_WINDOW;
      return { job: 'startCells', args: released(), x: [-angle, angle], y: [-velocity, velocity], whole: true };
    },
    wants() {
      const { block } = released();
      return {
        run: { job: 'releasedRun', args: { ...released(), ...begin() }, priority: 0 },
        ...(shaken() ? {} : { curve: { job: 'rockCurve', args: { block, tilts: CURVE }, priority: 1 } }),
      };
    },
    curve({ curve = [] }) {
      const { tilt } = units();
      return shaken() ? [] : curve.map((/** @type {{ x: number, y: number }} */ { x, y }) => ({ x: x * tilt, y }));
    },
    says({ run }, share) {
      return run ? releasedSentence(run, { alpha: shakingOf(app).block.alpha, shaken: shaken() }, share) : null;
    },
    note() {
      const { g, hz } = shakingOf(app);
      return shaken() ? `Each point of the map is one run. The ground shakes at ${gText(g)}, ${hz.toFixed(2)}\u00a0Hz, as in Shake it.`
        : 'From the first impact to the second.';
    },
    more: () => ({ tab: 'basins', ...started(begin().angle, begin().velocity) }),
    leans: () => begin().angle,
    tilted: (tilt) => started(tilt, 0),
  };
}
