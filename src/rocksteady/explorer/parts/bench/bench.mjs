// The laboratory's questions: a block of known size at the left, a picture beside it, one sentence above.

/** @import { App } from '../shell/app.mjs' */
/** @import { State } from '../shell/state.mjs' */
/** @import { Body } from '../stage/stage.mjs' */
/** @import { Cells } from './areas.mjs' */
/** @import { Place } from './picture.mjs' */
/** @import { Answers, Question } from './question.mjs' */
/** @import { Sentence } from './sentence.mjs' */
import { element } from '../shell/app.mjs';
import { make, say, setOn } from '../shell/layout.mjs';
import { linkOf } from '../shell/link.mjs';
import { FIELDS, blockNumbers, equationsOf } from '../shell/state.mjs';
import { SIZES, makeStage } from '../stage/stage.mjs';
import { storyWords } from '../story/words.mjs';
import { makeCells, shareOf } from './cells.mjs';
import { makePicture } from './picture.mjs';
import { sizeSet } from './question.mjs';
import { makeShake } from './shake.mjs';
import { makeSize } from './size.mjs';
import { makeStart } from './start.mjs';

const USES = ['tab', 'at', 'b', 'h', 'r', 'rh', 'model'];
const ONE_PUSH = { least: 0.03, top: 0.05 }; // [s], [g] from which a push by hand has a place on the map

/**
 * Make the bench on which the questions are answered.
 * @param {App} app
 */
export function makeBench(app) {
  const { kernels } = app;
  const stageAt = /** @type {HTMLCanvasElement} */ (element('bench-stage'));
  const pictureAt = /** @type {HTMLCanvasElement} */ (element('bench-picture'));
  const fields = { b: /** @type {HTMLInputElement} */ (element('bench-b')), h: /** @type {HTMLInputElement} */ (element('bench-h')) };
  let opened = /[&#](A|W|pA|pW|b|h|kind|ground|start)=/.test(location.hash), byHand = false, sizing = false, plays = false;
  /** What has been asked, and what has come of it, by its name. @type {Map<string, { key: string, value?: any }>} */
  const asked = new Map();
  /** @type {Cells | null} */
  let cells = null;
  let whole = false, refused = ''; // what a field does not take: said until something changes
  /** @type {Place | null} */
  let yours = null;
  /** @type {Sentence | null} */
  let told = null;

  /** @type {Record<string, Question>} */
  const questions = { shake: makeShake(app, () => yours), start: makeStart(app), size: makeSize(app) };
  const question = () => questions[app.state.tab] ?? questions.shake;
  const seen = () => app.state.at === 'lab' && app.state.tab in questions;
  /** What the jobs have said of the present state. @returns {Answers} */
  const answers = () => Object.fromEntries(Object.entries(question().wants())
    .map(([name, wanted]) => [name, asked.get(name)?.key === JSON.stringify(wanted) ? asked.get(name)?.value : undefined]));

  const stage = makeStage(app, stageAt, {
    body: bodyOf(app),
    layout: (width, height, body) => benchLayout(width, height, body),
    touched() {
      [byHand, plays, refused] = [true, false, ''];
    },
    stood() {
      byHand = true;
      tell();
    },
    told(story) {
      if (!byHand) return;
      const { sentence, facts } = storyWords(story), done = story.rocks || story.quiet || story.lies || story.held;
      if (!done) return;
      const dot = story.quiet && !story.held && yours && app.state.tab === 'shake' ? 'the dot on the map is your push' : '';
      const words = story.leaned && story.angle <= 1 ? 'Let it go.' : sentence || 'It has not lifted yet.';
      told = { words: [words, '', ''], facts: [facts, dot].filter(Boolean).join(' · ') };
      tell();
    },
    pushed({ top, longest }) {
      if (top < ONE_PUSH.top || longest < ONE_PUSH.least) return;
      yours = { x: 0.5 / longest, y: top };
      picture.ask();
    },
    sized({ width, height }, done) {
      [byHand, opened, sizing] = [false, true, !done];
      app.set(sizeSet(app, { b: width, h: height }), { settled: done, push: false });
    },
    tilted(tilt, done) {
      const set = question().tilted?.(tilt);
      if (!set) return false;
      [byHand, opened, plays] = [false, true, done];
      app.set(set, { settled: done, push: false });
      if (done) play();
      return true;
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
    const now = answers();
    return { plane: question().plane(sizing, now), cells, kinds: question().kinds(), curve: question().curve?.(now) ?? [] };
  }, (place, done) => {
    [byHand, opened, plays] = [false, true, done];
    sizing = !done && app.state.tab === 'size';
    app.set(question().moved(place), { settled: done, push: false });
    play();
  });
  const map = makeCells(app.pool, (next, last) => {
    [cells, whole] = [next, last];
    tell();
    picture.ask();
  }, (fault) => say(element('bench-note'), `The map could not be computed: ${fault.message}. Reload the page.`));

  const play = () => {
    const { run } = answers();
    if (!plays || !run) return; // it comes with the run
    plays = false;
    stage.play(run);
  };
  const ask = () => {
    const wanted = question().cells();
    if (map.ask(wanted)) whole = false;
    for (const [name, { job, args, priority }] of Object.entries(question().wants())) {
      const key = JSON.stringify({ job, args, priority });
      if (asked.get(name)?.key === key) continue;
      asked.set(name, { key });
      app.pool.ask(job, args, { key: `bench ${name}`, priority }).then((value) => {
        if (!value || asked.get(name)?.key !== key) return;
        asked.set(name, { key, value });
        tell();
        play();
        picture.ask();
      }, (fault) => say(element('bench-facts'), `This could not be computed: ${fault.message}.`));
    }
  };

  const tell = () => {
    const share = whole && cells ? shareOf(cells) : null;
    if (!byHand) told = opened ? question().says(answers(), share) ?? told : question().invited();
    const [before, value, after] = (told ?? question().invited()).words, says = element('bench-says');
    if (says.textContent !== before + value + after) {
      const number = document.createElement('b');
      number.textContent = value;
      says.replaceChildren(before, ...(value ? [number] : []), after);
    }
    say(element('bench-facts'), refused || (told?.facts ?? ''));
    const size = `${app.state.b.toFixed(2)} by ${app.state.h.toFixed(2)} metres`;
    setOn(stageAt, 'aria-label', `Your block, ${size}. ${says.textContent} The left and right arrow keys push the ground; R stands the block up.`);
    setOn(pictureAt, 'aria-label', `${question().title} ${question().plane(sizing, answers()).tag.replace('  ', ', ')}. The arrow keys move the point.`);
  };
  /** What leads to the researchers' room. @returns {Partial<State>} */
  const roomOf = () => ({ units: 'si', model: equationsOf(app.state), ...question().more() });
  const refresh = () => {
    const { state } = app, { title, choice, act, note } = question();
    refused = '';
    stage.resize(bodyOf(app));
    if (!plays) stage.lean(question().leans?.() ?? null);
    for (const name of /** @type {const} */ (['b', 'h'])) {
      if (document.activeElement !== fields[name]) fields[name].value = String(Number(state[name].toFixed(3)));
    }
    const bar = element('bench-switch');
    if (bar.dataset.key !== choice.key) {
      bar.dataset.key = choice.key;
      setOn(bar, 'aria-label', choice.words);
      bar.replaceChildren(...choice.options.map(([value, words]) => make('button', { type: 'button', role: 'radio', 'data-value': value }, words)));
    }
    for (const button of bar.children) {
      const on = button.getAttribute('data-value') === state[choice.key];
      setOn(button, 'aria-checked', String(on));
      setOn(button, 'tabindex', on ? '0' : '-1');
    }
    say(element('bench-title'), title);
    say(element('bench-act'), act());
    setOn(element('bench-more'), 'href', linkOf({ ...state, ...roomOf() }));
    say(element('bench-note'), `${note()} ${equationsOf(state) === 'linear' ? 'Linear' : 'Full'} equations, restitution\u00a0${blockNumbers(kernels, state).restitution.toFixed(2)}.`);
    ask();
    tell();
    picture.ask();
  };

  element('bench-act').addEventListener('click', () => {
    [byHand, opened, plays, refused] = [false, true, true, ''];
    tell();
    play();
  });
  element('bench-more').addEventListener('click', (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    app.set(roomOf());
  });
  const turn = (/** @type {string} */ value) => {
    [byHand, opened, plays] = [false, true, false];
    stage.stand();
    app.set({ [question().choice.key]: value });
  };
  element('bench-switch').addEventListener('click', ({ target }) => {
    const value = target instanceof Element ? target.getAttribute('data-value') : null;
    if (value) turn(value);
  });
  element('bench-switch').addEventListener('keydown', (event) => {
    if (!event.key.startsWith('Arrow')) return;
    event.preventDefault();
    event.stopPropagation();
    const { key, options } = question().choice;
    turn(options[options[0][0] === app.state[key] ? 1 : 0][0]);
    /** @type {HTMLElement | null} */ (element('bench-switch').querySelector('[aria-checked="true"]'))?.focus();
  });
  for (const name of /** @type {const} */ (['b', 'h'])) {
    fields[name].addEventListener('change', () => {
      const { state } = app, value = FIELDS[name].parse(fields[name].value.replace(',', '.'));
      const { least, widest, tallest, stout } = SIZES;
      const [from, to] = name === 'b' ? [least, Math.min(widest, stout * state.h)] : [state.b / stout, tallest];
      if (typeof value === 'number' && value >= from - 1e-9 && value <= to + 1e-9) {
        [byHand, opened] = [false, true];
        fields[name].value = String(value);
        app.set(sizeSet(app, { b: state.b, h: state.h, [name]: value }), { push: false });
        return;
      }
      fields[name].value = String(state[name]);
      refused = `${name === 'b' ? 'Width' : 'Height'}: ${from.toFixed(2)} to ${to.toFixed(2)} m.`;
      tell();
    });
  }
  document.addEventListener('state', (event) => {
    const { changed } = /** @type {CustomEvent<{ changed: string[] }>} */ (event).detail;
    if (!seen() || !changed.some((key) => USES.includes(key) || question().uses.includes(key))) return;
    if (changed.includes('tab') || changed.includes('at')) {
      [byHand, plays, told] = [false, false, null];
      stage.stand();
    }
    if (changed.includes('tab') || changed.includes(question().choice.key)) [cells, whole] = [null, false];
    refresh();
  });
  if (seen()) refresh();
}

/** Return the block of the state. @param {App} app @returns {Body} */
function bodyOf({ kernels, state }) {
  return { width: state.b, height: state.h, restitution: blockNumbers(kernels, state).restitution };
}

/**
 * Return where the bench has its stage: the block at the left, the ground across the window.
 * @param {number} width
 * @param {number} height
 * @param {Body} body
 */
function benchLayout(width, height, body) {
  const aside = element('bench-right').offsetLeft, beside = aside > 0.25 * width ? aside - 16 : width, roomy = height > 420;
  const level = height - (roomy ? 112 : 104), head = roomy ? 150 : 70, column = Math.min(beside, width);
  const tall = Math.min((level - head) * 0.93, column * 0.84, (column * 0.42 * body.height) / body.width);
  return {
    middle: 0.5 * column, level, tall, under: roomy ? 68 : 62, ticks: '',
    trace: { left: column < width ? 32 : 12, right: column - 62, middle: roomy ? 52 : 28, size: roomy ? 26 : 13 },
  };
}

