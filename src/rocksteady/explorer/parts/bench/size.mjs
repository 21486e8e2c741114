// "What size stands?": fates over width and height, for one push or for shaking that goes on.

/** @import { App } from '../shell/app.mjs' */
/** @import { Question } from './question.mjs' */
import { SHAKES } from '../physics/shake.mjs';
import { SHAPE } from '../physics/story/pulses.mjs';
import { SIZES } from '../stage/stage.mjs';
import { gText } from '../story/words.mjs';
import { MOTION_NAMES } from '../words.mjs';
import { heldEnds, kindsOf, shakingOf, sizeSet, upTo } from './question.mjs';
import { plain, sizeSentence } from './sentence.mjs';
import { KIND_CHOICE } from './shake.mjs';

const WIDEST = 1, TALLEST = 3; // [m] of the axes, which a larger block makes longer

/**
 * Make the question.
 * @param {App} app
 * @returns {Question}
 */
export function makeSize(app) {
  const shaking = () => {
    const { push, hz, g } = shakingOf(app), { state } = app;
    return { push, hz: Number(hz.toFixed(6)), g: Number(g.toFixed(6)), restitution: state.rh === 1 ? null : state.r };
  };
  const ends = heldEnds(() => ({ b: upTo(Math.max(app.state.b, WIDEST), 0.5), h: upTo(Math.max(app.state.h, TALLEST), 1) }));
  return {
    title: 'What size stands?',
    choice: KIND_CHOICE,
    uses: ['kind', 'A', 'W', 'pA', 'pW'],
    act: () => (shakingOf(app).push ? 'Push it' : 'Shake it'),
    invited: () => ({ words: plain('Drag the edges of the block, or the point on the map.'), facts: '' }),
    plane(sizing) {
      const { b, h } = app.state, to = ends(sizing);
      return {
        x: { from: 0, to: to.b, label: 'width, m' }, y: { from: 0, to: to.h, label: 'height, m' },
        point: { x: b, y: h }, tag: `${b.toFixed(2)} × ${h.toFixed(2)} m`,
      };
    },
    moved({ x, y }) {
      const { least, widest, tallest, stout } = SIZES, round = (/** @type {number} */ value) => Number(value.toFixed(2));
      const h = Math.min(Math.max(round(y), round(least / stout + 0.005)), tallest);
      const b = Math.min(Math.max(round(x), least), widest, Math.floor(100 * stout * h) / 100);
      return sizeSet(app, { b, h });
    },
    kinds: () => kindsOf(app, shakingOf(app).push ? {} : { goesOn: MOTION_NAMES.symmetric, falls: true }),
    cells() {
      const to = ends();
      return { job: 'sizeCells', args: shaking(), x: [0, to.b], y: [0, to.h] };
    },
    wants() {
      const { block, push, hz, g } = shakingOf(app), { b: width, h: height } = app.state;
      const most = Math.min(SIZES.widest, SIZES.stout * height);
      return {
        run: { job: 'shakenRun', args: { block, push, hz, g }, priority: 0 },
        turn: { job: 'widthTurn', args: { ...shaking(), width, height, least: SIZES.least, most }, priority: 1 },
      };
    },
    says({ run, turn }) {
      const { block: { alpha }, push, lift } = shakingOf(app), { b: width } = app.state;
      return run ? sizeSentence(run, turn ?? null, { push, lift, alpha, width }) : null;
    },
    note() {
      const { push, g, hz } = shaking();
      const what = push ? `one push of ${gText(g)}, one sine of ${hz.toFixed(2)}\u00a0Hz` : `${SHAKES} shakes of ${gText(g)} at ${hz.toFixed(2)}\u00a0Hz`;
      return `Each point of the map is one block under ${what}, as in Shake it.`;
    },
    more() {
      const { push, g, hz } = shaking(), demand = push ? { demand: 'pulse', pulse: SHAPE } : { demand: 'harmonic', dn: SHAKES };
      return /** @type {any} */ ({ tab: 'design', ...demand, dg: g, df: hz });
    },
  };
}
