// "How hard may the ground shake?": a block of known size, a map beside it, one sentence.

/** @import { App } from '../shell/app.mjs' */
/** @import { State } from '../shell/state.mjs' */
/** @import { Body } from '../stage/stage.mjs' */
/** @import { ShakenRun } from '../physics/shake.mjs' */
/** @import { PulseWindow } from '../physics/demand/windows.mjs' */
/** @import { Cells, Kind } from './areas.mjs' */
/** @import { Place } from './picture.mjs' */
/** @import { Sentence } from './sentence.mjs' */
import { classLook, fallLook } from '../draw/classes.mjs';
import { evaluate } from '../physics/case.mjs';
import { SHAKES } from '../physics/shake.mjs';
import { pulseNumbers } from '../physics/story/pulses.mjs';
import { element } from '../shell/app.mjs';
import { say, setOn } from '../shell/layout.mjs';
import { linkOf } from '../shell/link.mjs';
import { FIELDS, blockNumbers } from '../shell/state.mjs';
import { SIZES, makeStage } from '../stage/stage.mjs';
import { storyWords } from '../story/words.mjs';
import { MOTION_NAMES, NEVER_LIFTS, STANDS, fallName } from '../words.mjs';
import { makeCells } from './cells.mjs';
import { makePicture } from './picture.mjs';
import { INVITED, shakenSentence } from './sentence.mjs';

const USES = ['tab', 'kind', 'b', 'h', 'r', 'rh', 'A', 'W', 'pA', 'pW'];
const LEAST_HZ = 0.2, LEAST_TOP = 0.5; // [Hz], [g] of the axes
const LIFTS = 6, TURNS = 8; // strengths in those that lift it, turns in p
const STEP = { hz: 0.5, g: 0.25 }; // to which the ends of the axes are rounded
const ONE_PUSH = { least: 0.03, top: 0.05 }; // [s], [g] from which a push by hand has a place on the map

/** Return a value rounded up to a multiple. @param {number} value @param {number} step */
const upTo = (value, step) => Math.ceil(value / step - 1e-9) * step;

/**
 * Make the question.
 * @param {App} app
 */
export function makeShake(app) {
  const { kernels } = app;
  const stageAt = /** @type {HTMLCanvasElement} */ (element('shake-stage'));
  const pictureAt = /** @type {HTMLCanvasElement} */ (element('shake-picture'));
  const fields = { b: /** @type {HTMLInputElement} */ (element('shake-b')), h: /** @type {HTMLInputElement} */ (element('shake-h')) };
  let opened = /[&#](A|W|pA|pW|b|h|kind)=/.test(location.hash), byHand = false, sizing = false, plays = false;
  /** @type {{ key: string, run: ShakenRun } | null} */
  let found = null;
  /** @type {{ key: string, windows: PulseWindow[] } | null} */
  let swept = null;
  /** @type {Cells | null} */
  let cells = null;
  /** @type {Place | null} */
  let yours = null;
  /** @type {{ top: number, fast: number } | null} */
  let frozen = null;
  /** @type {Sentence} */
  let told = INVITED;
  let mapOf = '';

  const given = () => {
    const { state } = app, { alpha, p, radius, restitution } = blockNumbers(kernels, state), push = state.kind === 'push';
    const block = { alpha, p, radius, restitution, nonlinear: true };
    const [amplitude, ratio] = push ? [state.pA, state.pW] : [state.A, state.W];
    const lift = evaluate(kernels, 'tan', alpha);
    return { block, push, lift, g: amplitude * alpha, hz: (ratio * p) / (2 * Math.PI) };
  };
  /** The ends of the axes, which hold while a size is dragged. */
  const ends = () => {
    const { block, lift } = given();
    const now = { top: upTo(Math.max(LIFTS * lift, LEAST_TOP), STEP.g), fast: upTo((TURNS * block.p) / (2 * Math.PI), STEP.hz) };
    const { top, fast } = sizing ? (frozen ??= now) : now;
    if (!sizing) frozen = null;
    return { hz: /** @type {const} */ ([LEAST_HZ, fast]), g: /** @type {const} */ ([0, top]) };
  };
  /** @returns {Kind[]} */
  const kinds = () => {
    const { theme } = app, push = app.state.kind === 'push';
    const fell = (/** @type {number} */ impacts) => /** @type {const} */ ({ look: fallLook(theme, 1, impacts), ink: 'onFalls', over: 'falls' });
    const falls = { ...fell(1), name: MOTION_NAMES.overturned };
    return [
      { look: classLook(theme, 'rest'), name: NEVER_LIFTS, ink: 'ink', over: 'rest' },
      { look: classLook(theme, 'rocking'), name: push ? STANDS : MOTION_NAMES.symmetric, ink: 'onRocks', over: 'rocks' },
      push ? { ...fell(0), name: fallName(0) } : falls,
      push ? { ...fell(1), name: fallName(1).replace('after ', 'after|') } : falls,
      { look: classLook(theme, 'undecided'), name: MOTION_NAMES.undecided, ink: 'ink', over: 'paper' },
    ];
  };

  const stage = makeStage(app, stageAt, {
    body: bodyOf(app),
    layout: (width, height, body) => shakeLayout(width, height, body),
    touched() {
      byHand = true;
      plays = false;
    },
    stood() {
      byHand = true;
      tell();
    },
    told(story) {
      if (!byHand) return;
      const { sentence, facts } = storyWords(story), done = story.rocks || story.quiet || story.lies || story.held;
      if (!done) return;
      const dot = story.quiet && !story.held && yours ? 'the dot on the map is your push' : '';
      const words = story.leaned && story.angle <= 1 ? 'Let it go.' : sentence || 'It has not lifted yet.';
      told = { words: [words, '', ''], facts: [facts, dot].filter(Boolean).join(' · ') };
      tell();
    },
    pushed({ top, longest }) {
      if (top < ONE_PUSH.top || longest < ONE_PUSH.least) return;
      yours = { hz: 0.5 / longest, g: top };
      picture.ask();
    },
    sized({ width, height }, done) {
      byHand = false;
      opened = true;
      sizing = !done;
      resize({ b: width, h: height }, done);
    },
    placed({ wide, tall }) {
      const room = stageAt.clientWidth;
      for (const [field, at, dx, dy, most] of /** @type {const} */ ([[fields.b, wide, 12, -15, 96], [fields.h, tall, 10, -15, 88]])) {
        const label = /** @type {HTMLElement} */ (field.parentElement);
        field.style.width = `${field.value.length + 1.5}ch`;
        label.style.visibility = at.shown ? 'visible' : 'hidden';
        label.style.transform = `translate(${Math.round(Math.min(Math.max(at.x + dx, 4), room - most))}px, ${Math.round(at.y + dy)}px)`;
      }
    },
  });
  const picture = makePicture(app, pictureAt, () => {
    const { push, lift, g, hz } = given();
    return {
      cells, kinds: kinds(), ends: ends(), lift, point: { hz, g }, yours,
      labels: ['shakes a second, Hz', push ? 'strength of the push, g' : 'strength of the shaking, g'],
    };
  }, (place, done) => {
    byHand = false;
    opened = true;
    move(place, done);
    plays = done;
    if (done) play();
  });
  const map = makeCells(app.pool, (next) => {
    cells = next;
    picture.ask();
  }, (fault) => say(element('shake-note'), `The map could not be computed: ${fault.message}. Reload the page.`));

  /** @param {Place} place @param {boolean} settled */
  const move = ({ hz, g }, settled) => {
    const { block, push } = given(), { hz: [slow, fast], g: [, top] } = ends();
    const at = { g: Number(Math.min(Math.max(g, 0), top).toFixed(3)), hz: Number(Math.min(Math.max(hz, slow), fast).toFixed(3)) };
    const { amplitude, ratio } = pulseNumbers(block, at.g, at.hz);
    app.set(push ? { pA: amplitude, pW: ratio } : { A: amplitude, W: ratio }, { settled, push: false });
  };
  /** Change the size; the shakings stay as they are in g and Hz. @param {{ b: number, h: number }} size
   * @param {boolean} settled */
  const resize = (size, settled) => {
    const { state } = app, before = blockNumbers(kernels, state), after = blockNumbers(kernels, { ...state, ...size });
    const [lean, pace] = [before.alpha / after.alpha, before.p / after.p];
    app.set({ ...size, A: state.A * lean, W: state.W * pace, pA: state.pA * lean, pW: state.pW * pace }, { settled, push: false });
  };
  const keyOf = () => {
    const { block, push, g, hz } = given();
    return [block.alpha, block.p, block.restitution, push, g, hz].join(' ');
  };
  const play = () => {
    if (!plays || found?.key !== keyOf()) return; // it comes with the run
    plays = false;
    stage.play(found.run);
  };

  const ask = () => {
    const { block, push, g, hz } = given(), key = keyOf(), axes = ends();
    const mapKey = [block.alpha, block.p, block.restitution, push, axes.hz[1], axes.g[1]].join(' ');
    if (mapKey !== mapOf) {
      mapOf = mapKey;
      const span = (/** @type {readonly [number, number]} */ [from, to], /** @type {Float64Array} */ parts) => parts.map((part) => from + part * (to - from));
      map.ask(mapKey, (x, y) => ({ block, push, hz: span(axes.hz, x), g: span(axes.g, y) }));
    }
    if (found?.key !== key) {
      app.pool.ask('shakenRun', { block, push, hz, g }, { key: 'shaken run', priority: 0 }).then((run) => {
        if (!run) return;
        found = { key, run };
        tell();
        play();
      }, (fault) => say(element('shake-facts'), `This could not be computed: ${fault.message}.`));
    }
    const column = push ? [block.alpha, block.restitution, block.p, hz].join(' ') : '';
    if (column && swept?.key !== column) {
      const ratio = (2 * Math.PI * hz) / block.p;
      app.pool.ask('pulseWindows', { ...block, shape: 'one-sine', ratio, high: (1.5 * axes.g[1]) / block.alpha },
        { key: 'shaken windows', priority: 1 }).then((all) => {
        if (!all) return;
        swept = { key: column, windows: all.windows.map((/** @type {PulseWindow} */ one) => ({ ...one, low: one.low * block.alpha, high: one.high * block.alpha })) };
        tell();
      }, () => {});
    }
  };

  const tell = () => {
    const { block, push, g, hz, lift } = given();
    if (!byHand && !opened) told = INVITED;
    if (!byHand && opened && found?.key === keyOf()) {
      const column = [block.alpha, block.restitution, block.p, hz].join(' ');
      told = shakenSentence(found.run, { push, g, lift, alpha: block.alpha }, swept?.key === column ? swept.windows : []);
    }
    const [before, value, after] = told.words, says = element('shake-says');
    if (says.textContent !== before + value + after) {
      const number = document.createElement('b');
      number.textContent = value;
      says.replaceChildren(before, ...(value ? [number] : []), after);
    }
    say(element('shake-facts'), told.facts);
    const size = `${app.state.b.toFixed(2)} by ${app.state.h.toFixed(2)} metres`;
    setOn(stageAt, 'aria-label', `Your block, ${size}. ${says.textContent} The left and right arrow keys push the ground; R stands the block up.`);
    setOn(pictureAt, 'aria-label', `${element('shake-title').textContent} ${g.toFixed(2)} g, ${hz.toFixed(2)} Hz. The arrow keys move the point.`);
  };
  const refresh = () => {
    const { state } = app, { block } = given(), push = state.kind === 'push';
    stage.resize(bodyOf(app));
    for (const name of /** @type {const} */ (['b', 'h'])) {
      if (document.activeElement !== fields[name]) fields[name].value = String(Number(state[name].toFixed(3)));
    }
    for (const button of element('shake-switch').children) {
      const on = button.getAttribute('data-kind') === state.kind;
      setOn(button, 'aria-checked', String(on));
      setOn(button, 'tabindex', on ? '0' : '-1');
    }
    say(element('shake-act'), push ? 'Push it' : 'Shake it');
    setOn(element('shake-more'), 'href', linkOf({ ...state, ...roomOf(state.kind) }));
    say(element('shake-note'), `Each point of the map is one run from rest${push ? '' : ` of ${SHAKES} shakes`}. Full equations, restitution\u00a0${block.restitution.toFixed(2)}.`);
    ask();
    tell();
    picture.ask();
  };

  element('shake-act').addEventListener('click', () => {
    [byHand, opened, plays] = [false, true, true];
    tell();
    play();
  });
  element('shake-more').addEventListener('click', (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    app.set(roomOf(app.state.kind));
  });
  const turn = (/** @type {string} */ kind) => {
    [byHand, opened] = [false, true];
    stage.stand();
    app.set({ kind });
  };
  element('shake-switch').addEventListener('click', ({ target }) => {
    const kind = target instanceof Element ? target.getAttribute('data-kind') : null;
    if (kind) turn(kind);
  });
  element('shake-switch').addEventListener('keydown', (event) => {
    if (!event.key.startsWith('Arrow')) return;
    event.preventDefault();
    event.stopPropagation();
    turn(app.state.kind === 'push' ? 'on' : 'push');
    /** @type {HTMLElement | null} */ (element('shake-switch').querySelector('[aria-checked="true"]'))?.focus();
  });
  for (const name of /** @type {const} */ (['b', 'h'])) {
    fields[name].addEventListener('change', () => {
      const { state } = app, value = FIELDS[name].parse(fields[name].value.replace(',', '.'));
      const { least, widest, tallest, stout } = SIZES;
      const [from, to] = name === 'b' ? [least, Math.min(widest, stout * state.h)] : [state.b / stout, tallest];
      if (typeof value === 'number' && value >= from - 1e-9 && value <= to + 1e-9) {
        [byHand, opened] = [false, true];
        fields[name].value = String(value);
        resize({ b: state.b, h: state.h, [name]: value }, true);
        return;
      }
      fields[name].value = String(state[name]);
      say(element('shake-facts'), `${name === 'b' ? 'Width' : 'Height'}: ${from.toFixed(2)} to ${to.toFixed(2)} m.`);
    });
  }
  document.addEventListener('state', (event) => {
    const { changed } = /** @type {CustomEvent<{ changed: string[] }>} */ (event).detail;
    if (app.state.tab === 'shake' && app.state.at === 'lab' && changed.some((key) => USES.includes(key) || key === 'at')) refresh();
  });
  refresh();
}

/** Return what of the state leads to the researchers' room. @param {string} kind @returns {Partial<State>} */
function roomOf(kind) {
  const room = kind === 'push' ? { tab: 'pulse', pulse: 'one-sine' } : { tab: 'explore' };
  return { ...room, units: 'si', model: 'nonlinear', start: 'rest' };
}

/** Return the block of the state. @param {App} app @returns {Body} */
function bodyOf({ kernels, state }) {
  return { width: state.b, height: state.h, restitution: blockNumbers(kernels, state).restitution };
}

/**
 * Return where the laboratory has its stage: the block at the left, the ground across the window.
 * @param {number} width
 * @param {number} height
 * @param {Body} body
 */
function shakeLayout(width, height, body) {
  const aside = element('shake-right').offsetLeft, beside = aside > 0.25 * width ? aside - 16 : width, roomy = height > 420;
  const level = height - (roomy ? 112 : 104), head = roomy ? 150 : 70, column = Math.min(beside, width);
  const tall = Math.min((level - head) * 0.93, column * 0.84, (column * 0.42 * body.height) / body.width);
  return {
    middle: 0.5 * column, level, tall, under: roomy ? 68 : 62, ticks: '',
    trace: { left: column < width ? 32 : 12, right: column - 62, middle: roomy ? 52 : 28, size: roomy ? 26 : 13 },
  };
}

