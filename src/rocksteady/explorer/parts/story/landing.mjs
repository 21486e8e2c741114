// "Push the ground.": a block, and the ground under the reader's hand.

/** @import { App } from '../shell/app.mjs' */
import { rectangleOf } from '../physics/case.mjs';
import { PUSH_STEP } from '../physics/push/spring.mjs';
import { element } from '../shell/app.mjs';
import { say } from '../shell/layout.mjs';
import { makeStage } from '../stage/stage.mjs';
import { storyWords } from './words.mjs';

const BODY = { width: 0.3, height: 1 }; // [m]
const IDLE_EVERY = 6.5; // [s]
/** A hand that nudges the ground while nobody has touched it: times [s] and places [m]. */
const NUDGE = /** @type {const} */ ([[0, 0], [0.18, 0.15], [0.36, 0]]);
const NARROW_PAGE = 700; // [px]
const PROMPT = 'Push the ground.';

/** Return the block of the landing. @param {import('../kernels/loader.mjs').Kernels} kernels */
export function landingBlock(kernels) {
  const measures = rectangleOf(kernels, BODY);
  return { ...measures, restitution: measures.housner, nonlinear: true };
}

/**
 * Return where the landing has its stage.
 * @param {number} width
 * @param {number} height
 */
function landingLayout(width, height) {
  const narrow = width < NARROW_PAGE, level = Math.round((narrow ? 0.62 : 0.7) * height); // as in story.css
  return {
    middle: 0.5 * width, level, tall: Math.min(0.43 * height, 0.78 * width, 460),
    under: Math.min(42, 0.2 * (height - level)), ticks: narrow ? '' : 'ticks 10 cm',
    trace: {
      left: Math.max(16, width / 2 - 520), right: Math.min(width - 68, width / 2 + 520),
      middle: 24 + 0.075 * height, size: 0.052 * height,
    },
  };
}

/**
 * Make the landing.
 * @param {App} app
 */
export function makeLanding(app) {
  const section = element('push'), canvas = /** @type {HTMLCanvasElement} */ (element('stage'));
  let touched = false;
  const stage = makeStage(app, canvas, {
    body: BODY,
    layout: landingLayout,
    touched() {
      touched = true;
      section.classList.add('touched', 'moved');
    },
    stood: () => reset(),
    told(story) {
      if (!touched) return;
      if (!story.rocks && !story.quiet && !story.held && !story.lies) return; // not done yet
      const { sentence, facts } = storyWords(story);
      if (sentence) say(element('verdict'), sentence);
      say(element('facts'), facts);
    },
  });
  const reset = () => {
    section.classList.remove('moved');
    const keys = matchMedia('(hover: hover)').matches ? ', or use the arrow keys.' : '.';
    say(element('verdict'), touched ? PROMPT : `Drag left or right${keys}`);
    say(element('facts'), '');
  };
  element('again').addEventListener('click', () => {
    stage.stand();
    reset();
    canvas.focus({ preventScroll: true });
  });
  element('take').addEventListener('click', () => {
    const { record } = stage;
    if (record.length < 2) return;
    app.motions.push({
      name: 'your push', dt: PUSH_STEP, acceleration: Float64Array.from(record),
      note: 'made by hand on this page',
    });
    app.set({
      at: 'lab', tab: 'quake', model: 'nonlinear', units: 'si', b: BODY.width, h: BODY.height, rh: 1,
      record: app.motions.length - 1, scale: 1,
    });
  });
  // Nothing moves by itself where less motion is wanted, out of sight, or once it was touched.
  setInterval(() => {
    if (touched || stage.going || app.still || !stage.view.seen || document.hidden) return;
    stage.show(NUDGE);
  }, 1000 * IDLE_EVERY);
  reset();
}
