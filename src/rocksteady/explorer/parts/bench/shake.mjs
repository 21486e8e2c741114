// "How hard may the ground shake?": fates over strength and frequency of a push, or of shaking that goes on.

/** @import { App } from '../shell/app.mjs' */
/** @import { PulseWindow } from '../physics/demand/windows.mjs' */
/** @import { Place } from './picture.mjs' */
/** @import { Question } from './question.mjs' */
import { SHAKES } from '../physics/shake.mjs';
import { SHAPE } from '../physics/story/pulses.mjs';
import { MOTION_NAMES } from '../words.mjs';
import { heldEnds, kindsOf, shakingOf, shakingSet, upTo } from './question.mjs';
import { plain, shakenSentence } from './sentence.mjs';

const LEAST_HZ = 0.2, LEAST_TOP = 0.5; // [Hz], [g] of the axes
const LIFTS = 6, TURNS = 8; // strengths in those that lift it, turns in p
const STEP = { hz: 0.5, g: 0.25 }; // to which the ends of the axes are rounded
/** Whether the shaking goes on, as two questions ask. @type {Question['choice']} */
export const KIND_CHOICE = { key: 'kind', words: 'What shakes it', options: [['on', 'goes on'], ['push', 'one push']] };

/**
 * Make the question.
 * @param {App} app
 * @param {() => Place | null} yours  the reader's last push
 * @returns {Question}
 */
export function makeShake(app, yours) {
  const ends = heldEnds(() => {
    const { block, lift } = shakingOf(app);
    return { top: upTo(Math.max(LIFTS * lift, LEAST_TOP), STEP.g), fast: upTo((TURNS * block.p) / (2 * Math.PI), STEP.hz) };
  });
  return {
    title: 'How hard may the ground shake?',
    choice: KIND_CHOICE,
    uses: ['kind', 'A', 'W', 'pA', 'pW'],
    act: () => (shakingOf(app).push ? 'Push it' : 'Shake it'),
    invited: () => ({ words: plain('Push the ground, or drag the point on the map.'), facts: '' }),
    plane(sizing) {
      const { push, lift, g, hz } = shakingOf(app), { top, fast } = ends(sizing), mine = yours();
      return {
        x: { from: LEAST_HZ, to: fast, label: push ? 'frequency of the push, Hz' : 'shakes a second, Hz' },
        y: { from: 0, to: top, label: push ? 'strength of the push, g' : 'strength of the shaking, g' },
        point: { x: hz, y: g }, tag: `${g.toFixed(2)} g  ${hz.toFixed(2)} Hz`,
        limit: { y: lift, words: `lifts above ${lift.toFixed(2)} g` },
        dot: mine && { ...mine, words: 'your push' },
      };
    },
    moved: ({ x, y }) => shakingSet(app, y, x),
    kinds() {
      const { push } = shakingOf(app);
      return kindsOf(app, push ? {} : { goesOn: MOTION_NAMES.symmetric, falls: true });
    },
    cells() {
      const { block, push } = shakingOf(app), { top, fast } = ends();
      return { job: 'shakenCells', args: { block, push }, x: [LEAST_HZ, fast], y: [0, top] };
    },
    wants() {
      const { block, push, hz, g, ratio } = shakingOf(app), { top } = ends();
      const windows = { ...block, shape: SHAPE, ratio, high: (1.5 * top) / block.alpha };
      return {
        run: { job: 'shakenRun', args: { block, push, hz, g }, priority: 0 },
        ...(push ? { windows: { job: 'pulseWindows', args: windows, priority: 1 } } : {}),
      };
    },
    says({ run, windows }) {
      const { block: { alpha }, push, g, lift } = shakingOf(app);
      /** @type {PulseWindow[]} */
      const all = windows?.windows ?? [];
      const inG = all.map((each) => ({ ...each, low: each.low * alpha, high: each.high * alpha }));
      return run ? shakenSentence(run, { push, g, lift, alpha }, inG) : null;
    },
    note: () => `Each point of the map is one run from rest${shakingOf(app).push ? '' : ` of ${SHAKES} shakes`}.`,
    more: () => (app.state.kind === 'push' ? { tab: 'pulse', pulse: SHAPE } : { tab: 'explore', start: 'rest' }),
  };
}
