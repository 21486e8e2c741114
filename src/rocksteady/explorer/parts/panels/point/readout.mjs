// The headline of the point: what the block can do there, what it comes to, and its numbers.

import { classSwatch } from '../../draw/classes.mjs';
import { numeral } from '../../draw/scale.mjs';
import { startOn } from '../../physics/coexisting.mjs';
import { FULL_TURN } from '../../physics/start.mjs';
import { make, say, setOn } from '../../shell/layout.mjs';
import { startText } from '../../shell/state.mjs';
import { NEVER_LIFTS, motionName, motionWords } from '../../words.mjs';
import { FOLLOWED_KEYS, followIn, orbitCourse } from './followed.mjs';
import { statusWords } from './history.mjs';
import {
  askMotions, isAlike, isPresent, motionClass, motionPeak, motionsSentence, presentMotions,
} from './motions.mjs';
import { multiplierText } from './section.mjs';
import { angleWords, topDisplacement } from './units.mjs';

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Coexisting } from '../../physics/coexisting.mjs' */
/** @import { Followed } from './followed.mjs' */
/** @import { Motions } from './motions.mjs' */

const SPARK = { width: 76, height: 30, periods: 6, samples: 16 };
const SWATCH_WIDTH = 9; // [px]

/**
 * Make the read-out.
 * @param {App} app
 * @returns {Panel}
 */
export function makeReadoutPanel(app) {
  /** @type {Followed | null} */
  let followed = null;
  /** @type {ReturnType<typeof readoutElements>} */
  let parts;
  let shownKey = '', dragged = false;

  const sentence = () => {
    const motions = presentMotions(app);
    return followed && motions ? motionsSentence(app, followed.block, motions) : '';
  };

  /** @type {Panel} */
  const panel = {
    name: 'readout',
    title: 'This point',
    uses: [...FOLLOWED_KEYS, 'motions', 'history'],
    placed() {
      parts = readoutElements(/** @type {HTMLElement} */ (panel.body),
        (start) => app.set({ start }));
      panel.body?.querySelector('.from')?.append(/** @type {HTMLElement} */ (panel.bar));
    },
    update(state, { changed, settled }) {
      followed = followIn(app, panel, settled, true);
      askMotions(app);
      if (!followed) return;
      // While the point is dragged what was found last stands for what is found next.
      const exact = presentMotions(app), motions = exact ?? app.shared.motions;
      if (settled || FOLLOWED_KEYS.some((key) => changed.has(key))) dragged = !settled;
      parts.stale(!exact && !dragged);
      if (!motions) parts.sentence('Looking for what it can do here …');
      else {
        const key = `${motions.key} ${state.units}`, { block, attractor } = followed;
        parts.sentence(motionsSentence(app, block, motions));
        if (key !== shownKey) parts.chips(chipsOf(app, followed, motions), app);
        shownKey = key;
        parts.press(motions.found.map((/** @type {Coexisting} */ motion) =>
          (exact ? isPresent : isAlike)(motion, attractor)));
        if (exact && settled) app.say(sentence());
      }
      const [first] = followed.steady;
      parts.starts(state.start, first && first.worth !== 'inadmissible');
      parts.numbers(numbersOf(app, followed), startWords(app, followed));
      panel.root?.setAttribute('data-whole', String(followed.whole));
    },
    sentence,
  };
  return panel;
}

/**
 * What is shown of a motion.
 * @typedef {object} Chip
 * @property {Coexisting} motion
 * @property {string} name
 * @property {string} size
 * @property {string | null} start
 * @property {string} line  of the small picture
 */

/**
 * @param {App} app
 * @param {Followed} followed
 * @param {Motions} motions
 * @returns {Chip[]}
 */
function chipsOf(app, { block }, { found, given }) {
  const largest = Math.max(0.05, ...found.map((motion) => motionPeak(motion) ?? 0));
  return found.map((motion) => {
    const peak = motionPeak(motion), start = startOn(motion);
    const size = motion.kind === 'rest' || peak === null ? '' : angleWords(app, block, peak);
    return {
      motion,
      name: motionName(motion),
      size,
      start: start && startText(start),
      line: sparkLine(app, given, motion, largest),
    };
  });
}

/**
 * Return some periods of a motion as the points of a small line.
 * @param {App} app
 * @param {Followed['given']} given
 * @param {Coexisting} motion
 * @param {number} largest  theta/alpha at the edge
 */
function sparkLine({ kernels }, given, motion, largest) {
  const { width, height, periods } = SPARK, middle = height / 2, points = [];
  if (motion.kind === 'overturned') {
    for (let k = 0; k <= 20; k++) {
      points.push([(k / 20) * width * 0.8, middle - (middle - 1) * (k / 20) ** 4]);
    }
  } else {
    const found = orbitCourse(kernels, given, startOn(motion), periods, SPARK.samples);
    found?.course.periods.forEach((time, k, { length }) => {
      if (k === length - 1) return; // it closes the curve
      points.push([(time / periods) * width,
        middle - (found.course.angle[k] / largest) * (middle - 2)]);
    });
  }
  return points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ');
}

/**
 * Return the fill of the class of a motion, and room for its line.
 * @param {App} app
 * @param {Coexisting} motion
 * @returns {Element[]}
 */
function pictureOf({ theme }, motion) {
  const ratio = Math.min(3, devicePixelRatio || 1), { width, height } = SPARK;
  const swatch = /** @type {HTMLCanvasElement} */ (make('canvas', { 'aria-hidden': 'true' }));
  swatch.width = Math.round(SWATCH_WIDTH * ratio);
  swatch.height = Math.round(height * ratio);
  const pen = /** @type {CanvasRenderingContext2D} */ (swatch.getContext('2d'));
  pen.scale(ratio, ratio);
  classSwatch(pen, theme, motionClass(motion), { left: 0, top: 0, width: SWATCH_WIDTH, height });
  const drawing = svgElement('svg', { viewBox: `0 0 ${width} ${height}`, 'aria-hidden': 'true' });
  drawing.append(svgElement('path', { class: 'zero', d: `M0 ${height / 2}H${width}` }),
    svgElement('polyline', {}));
  return [swatch, drawing];
}

/**
 * @param {string} tag
 * @param {Record<string, string>} attributes
 */
function svgElement(tag, attributes) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

/**
 * Return what the block comes to from the start that is chosen.
 * @param {App} app
 * @param {Followed} followed
 */
function startWords(app, followed) {
  const { attractor, start, block, history } = followed;
  const from = { rest: 'From rest', steady: 'From the steady state',
    state: 'From the chosen state', impact: 'From the chosen motion' }[start.kind];
  if (history.overturnTime !== null) return `${from}: it ${statusWords(app, followed)}.`;
  if (attractor.kind === 'undecided') {
    return followed.whole ? `${from}: undecided, ${attractor.reason}.`
      : `${from}: not known yet, followed for ${attractor.after} periods so far.`;
  }
  if (attractor.kind === 'rest' && history.restTime === 0) return `${from}: it ${NEVER_LIFTS}.`;
  const peak = attractor.kind === 'rest' ? null : motionPeak(attractor);
  const size = peak === null ? '' : `, peak ${angleWords(app, block, peak)}`;
  const followedFor = attractor.kind === 'aperiodic' ? 'followed for' : 'known after';
  const known = attractor.after === 0 ? ''
    : `, ${followedFor} ${attractor.after} period${attractor.after === 1 ? '' : 's'}`;
  return `${from}: it ${motionWords(attractor)}${size}${known}.`;
}

/**
 * A number with its float as it is.
 * @typedef {{ name: string, label: string, value: number | string, text: string }} Shown
 */

/**
 * Return the numbers of the point.
 * @param {App} app
 * @param {Followed} followed
 * @returns {Shown[]}
 */
function numbersOf(app, { attractor, history, given, block }) {
  const si = app.state.units === 'si', { orbit } = attractor;
  /** @type {Shown[]} */
  const shown = [];
  const put = (/** @type {string} */ name, /** @type {string} */ label,
    /** @type {number | string | null} */ value, text = '') => {
    if (value === null || (typeof value === 'number' && Number.isNaN(value))) return;
    const plain = typeof value === 'number' ? numeral(value) : value;
    shown.push({ name, label, value, text: text || plain });
  };
  const degrees = (/** @type {number} */ u) =>
    (si ? `${numeral((u * block.alpha * 180) / Math.PI, 4)}°` : `${numeral(u)} α`);
  put('kind', 'motion', attractor.kind, motionName(attractor));
  put('period', 'period', attractor.period, si && attractor.period
    ? `${numeral((attractor.period * FULL_TURN) / (given.frequencyRatio * block.p))} s` : '');
  put('highest', 'highest', attractor.highest, degrees(attractor.highest ?? 0));
  put('lowest', 'lowest', attractor.lowest, degrees(attractor.lowest ?? 0));
  if (si && orbit) {
    const top = topDisplacement(app, block, Math.max(orbit.highest, -orbit.lowest));
    put('top', 'top of the block', top, `${numeral(1000 * top)} mm`);
  }
  put('impacts', 'impacts a period', orbit && orbit.rests ? '∞' : attractor.impacts);
  if (orbit) {
    const pair = orbit.multipliers.map(multiplierText).join(', ');
    put('multiplier', 'multipliers', orbit.largest, pair);
  }
  if (Number.isFinite(attractor.lyapunov)) {
    const exponent = `${numeral(attractor.lyapunov, 3)} a period`;
    put('lyapunov', 'Lyapunov exponent', attractor.lyapunov, exponent);
  }
  put('peak', 'peak of the run', history.peak, degrees(history.peak));
  if (history.overturnTime !== null) {
    const { overturnTime: at } = history;
    put('overturn', 'falls at', at, si ? `${numeral(at / block.p)} s` : `pt = ${numeral(at)}`);
  }
  put('after', 'known after', attractor.after,
    attractor.after > 0 ? `${attractor.after} periods` : 'less than 1 period');
  return shown;
}

/**
 * Make the elements of the read-out; return what changes them.
 * @param {HTMLElement} body
 * @param {(start: string) => void} choose
 */
function readoutElements(body, choose) {
  const sentence = make('p', { class: 'headline', 'data-name': 'motions' });
  const group = { class: 'chips', role: 'group', 'aria-label': 'what it can do here' };
  const chips = make('div', group);
  const words = make('summary', { 'data-name': 'outcome' });
  const list = make('dl', { class: 'numbers' });
  const starts = ['rest', 'steady'].map((start) => {
    const text = start === 'rest' ? 'start at rest' : 'start on the steady state';
    const button = /** @type {HTMLButtonElement} */ (
      make('button', { type: 'button', 'data-start': start }, text));
    button.addEventListener('click', () => choose(start));
    return button;
  });
  const details = make('details', {}, words, list);
  body.append(sentence, chips, details, make('div', { class: 'from' }, ...starts));
  let shown = '';
  /** @type {Chip[]} */
  let offered = [];
  return {
    /** @param {boolean} stale */
    stale: (stale) => body.classList.toggle('stale', stale),
    /** @param {string} text */
    sentence(text) {
      say(sentence, text);
    },
    /**
     * Show chips; those of the same kinds stay where they are.
     * @param {Chip[]} all
     * @param {App} app
     */
    chips(all, app) {
      const kinds = all.map(({ motion }) => motionClass(motion)).join(' ')
        + (app.theme.dark ? ' dark' : '');
      if (kinds !== chips.dataset.kinds) {
        chips.dataset.kinds = kinds;
        chips.replaceChildren(...all.map(({ motion }, k) => {
          const chip = make('button', { type: 'button', class: 'chip' }, ...pictureOf(app, motion),
            make('span', { class: 'name' }), make('span', { class: 'size' }));
          chip.addEventListener('click', () => {
            const { start } = offered[k];
            if (start) choose(start);
          });
          return chip;
        }));
      }
      offered = all;
      all.forEach(({ motion, name, size, start, line }, k) => {
        const chip = /** @type {HTMLButtonElement} */ (chips.children[k]);
        for (const key of /** @type {const} */ (['kind', 'period', 'highest'])) {
          setOn(chip, `data-${key}`, String(motion[key]));
        }
        chip.disabled = start === null;
        say(/** @type {Element} */ (chip.querySelector('.name')), name);
        say(/** @type {Element} */ (chip.querySelector('.size')), size);
        chip.querySelector('polyline')?.setAttribute('points', line);
      });
    },
    /** @param {boolean[]} pressed */
    press(pressed) {
      pressed.forEach((on, k) => {
        if (chips.children[k]) setOn(chips.children[k], 'aria-pressed', String(on));
      });
    },
    /** @param {string} start @param {boolean} steady  whether there is a steady state */
    starts(start, steady) {
      for (const button of starts) {
        setOn(button, 'aria-pressed', String(button.dataset.start === start));
        button.disabled = button.dataset.start === 'steady' && !steady;
      }
    },
    /** @param {Shown[]} numbers @param {string} text */
    numbers(numbers, text) {
      say(words, text);
      const key = numbers.map(({ name }) => name).join(' ');
      if (key !== shown) {
        list.replaceChildren(...numbers.map(({ name, label }) =>
          make('div', {}, make('dt', {}, label),
            make('dd', {}, make('output', { 'data-name': name })))));
        shown = key;
      }
      const outputs = list.querySelectorAll('output');
      numbers.forEach(({ value, text: seen }, k) => {
        say(outputs[k], seen);
        setOn(outputs[k], 'data-value', String(value));
        setOn(outputs[k], 'title', String(value));
      });
    },
  };
}
