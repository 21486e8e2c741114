// "Push the ground.": a block, and the ground under the reader's hand.

/** @import { App } from '../shell/app.mjs' */
import { evaluate, GRAVITY, rectangleOf } from '../physics/case.mjs';
import { STANDING, pushOn } from '../physics/push/pushed.mjs';
import { PUSH_STEP, STILL_GROUND, handAt, pulledGround } from '../physics/push/spring.mjs';
import { element } from '../shell/app.mjs';
import { say } from '../shell/layout.mjs';
import { shapeOf } from '../panels/scene.mjs';
import { drawBlock, drawCurve, drawFlash, drawGround, drawLine, drawRing, write } from './draw.mjs';
import { knock } from './sound.mjs';
import { makeView } from './view.mjs';
import { degreeText, storyWords } from './words.mjs';

const WIDTH = 0.3, HEIGHT = 1; // of the block [m]
const LAG = 1 / 60; // [s] between a hand and what is made of it: its events are as far apart
const MOST_BEHIND = 0.1; // [s] of a stall that are made up for
const QUIET = { push: 0.02 * GRAVITY, for: 0.6 }; // [m/s2], [s] after which the ground stands still
const KEY_STEP = 0.08, KEY_SPEED = 0.8; // [m] a press of an arrow, [m/s] while it is held
const SPAN = 9; // [s] of the trace
const LONGEST = 600; // [s] of a push that the laboratory takes over
const IDLE_EVERY = 6.5; // [s]
/** A hand that nudges the ground while nobody has touched it: times [s] and places [m]. */
const NUDGE = /** @type {const} */ ([[0, 0], [0.18, 0.15], [0.36, 0]]);
const GLOW = 0.3; // [s] of an impact
const NARROW_PAGE = 700; // [px]
const PROMPT = 'Push the ground.';

/** Return the block of the landing. @param {import('../kernels/loader.mjs').Kernels} kernels */
export function landingBlock(kernels) {
  const measures = rectangleOf(kernels, { width: WIDTH, height: HEIGHT });
  return { ...measures, restitution: measures.housner, nonlinear: true };
}

/**
 * Make the landing.
 * @param {App} app
 */
export function makeLanding(app) {
  const { kernels } = app, block = landingBlock(kernels), shape = shapeOf(WIDTH, HEIGHT);
  const lift = evaluate(kernels, 'tan', block.alpha);
  const section = element('push'), canvas = /** @type {HTMLCanvasElement} */ (element('stage'));
  let ground = STILL_GROUND, state = STANDING, lies = false;
  let clock = 0, time = 0; // of the page, and since the block was stood up [s]
  let hand = 0, camera = 0, unit = 300;
  /** @type {{ time: number, place: number }[]} */
  let events = [];
  /** @type {{ id: number, x: number, hand: number } | null} */
  let held = null;
  let keys = 0, touched = false, going = false, idle = false;
  /** @type {number[]} */
  let record = [0];
  /** @type {{ time: number, angle: number, push: number }[]} */
  let trace = [];
  /** @type {{ time: number, side: number }[]} */
  let hits = [];
  let pushed = -9; // when the ground last moved
  const tale = { from: 0, reach: 0, top: 0, impacts: 0, peak: 0 };

  const begin = () => {
    Object.assign(tale, { from: ground.place, reach: 0, top: 0, impacts: 0, peak: 0 });
    record = [ground.push];
  };
  const stand = () => {
    [ground, state, lies, hand, camera, time, pushed] = [STILL_GROUND, STANDING, false, 0, 0, 0, -9];
    [events, trace, hits] = [[], [], []];
    begin();
    section.classList.remove('moved');
    const keys = matchMedia('(hover: hover)').matches ? ', or use the arrow keys.' : '.';
    say(element('verdict'), touched ? PROMPT : `Drag left or right${keys}`);
    say(element('facts'), '');
    wake();
  };

  /** Bring ground and block to the present. @param {number} now  [s] */
  const advance = (now) => {
    if (now - clock > MOST_BEHIND) clock = now - MOST_BEHIND;
    const count = Math.floor((now - clock) / PUSH_STEP);
    if (count < 1) return;
    if (keys) {
      hand += keys * KEY_SPEED * count * PUSH_STEP;
      events.push({ time: now, place: hand });
    }
    const samples = [ground.push];
    for (let k = 1; k <= count; k++) {
      const at = clock + k * PUSH_STEP - LAG;
      ground = pulledGround(ground, events.length ? handAt(events, at) : hand);
      samples.push(ground.push);
      if (!lies) {
        tale.top = Math.max(tale.top, Math.abs(ground.push) / GRAVITY);
        tale.reach = Math.max(tale.reach, Math.abs(ground.place - tale.from));
      }
      if (Math.abs(ground.push) > QUIET.push) pushed = time + k * PUSH_STEP;
    }
    clock += count * PUSH_STEP;
    if (idle) hand = handAt(events, clock - LAG);
    if (!lies) march(samples);
    time += count * PUSH_STEP;
    trace.push({ time, angle: state.angle, push: ground.push });
    while (trace[0].time < time - SPAN) trace.shift();
    while (hits.length && hits[0].time < time - SPAN) hits.shift();
    if (!held && !keys && !idle) camera += (ground.place - camera) * Math.min(1, 3 * count * PUSH_STEP);
  };
  /** @param {number[]} samples  of the ground [m/s2] */
  const march = (samples) => {
    if (record.length < LONGEST / PUSH_STEP) record.push(...samples.slice(1));
    const found = pushOn(kernels, block, state, Float64Array.from(samples));
    ({ state, lies } = found);
    tale.peak = Math.max(tale.peak, found.peak);
    for (const { time: after, side, speed } of found.impacts) {
      tale.impacts += 1;
      hits.push({ time: time + after, side });
      knock(speed);
    }
    if (lies) state = { ...state, angle: (Math.sign(state.angle) * 0.5 * Math.PI) / block.alpha };
  };

  const tell = () => {
    if (!touched) return;
    const story = {
      ...tale, alpha: block.alpha, lift, lies, rocks: state.side !== 0, angle: Math.abs(state.angle),
      quiet: time - pushed > QUIET.for,
    };
    if (!story.rocks && !story.quiet && !held && !lies) return; // not done yet
    const { sentence, facts } = storyWords(story);
    if (sentence) say(element('verdict'), sentence);
    say(element('facts'), facts);
  };

  const view = makeView(canvas, (pen, width, height) => {
    const { theme } = app, narrow = width < NARROW_PAGE;
    const size = Math.min(0.43 * height, 0.78 * width, 460);
    const level = Math.round((narrow ? 0.62 : 0.7) * height); // as in story.css
    unit = size / HEIGHT;
    const x = width / 2 + (ground.place - camera) * unit;
    if (touched) drawTrace(pen, width, height);
    drawGround(pen, theme, { width, height: height - level, y: level, x, unit });
    drawBlock(pen, theme, shape, { x, y: level, unit, angle: state.angle * block.alpha });
    for (const { time: at, side } of hits.slice(-4)) {
      drawFlash(pen, theme, x + side * shape.halfWidth * unit, level, 1 - (time - at) / GLOW);
    }
    const handX = width / 2 + (hand - camera) * unit, handY = level + Math.min(42, 0.2 * (height - level));
    for (const to of [-1, 1]) {
      drawLine(pen, theme, [handX + 20 * to, handY, handX + 38 * to, handY], 'ink', 2.5);
      for (const up of [-7, 7]) {
        drawLine(pen, theme, [handX + 31 * to, handY + up, handX + 38 * to, handY], 'ink', 2.5);
      }
    }
    drawRing(pen, theme, handX, handY, held ? 14 : 11);
    if (!narrow) write(pen, theme, 'ticks 10 cm', width - 32, level + 28, { align: 'right' });
  });

  /** @param {CanvasRenderingContext2D} pen @param {number} width @param {number} height */
  const drawTrace = (pen, width, height) => {
    const { theme } = app, left = Math.max(16, width / 2 - 520);
    const right = Math.min(width - 68, width / 2 + 520), middle = 24 + 0.075 * height;
    const size = 0.052 * height, low = middle + 2.1 * size;
    const across = (/** @type {number} */ at) => right - ((time - at) / SPAN) * (right - left);
    const up = (/** @type {number} */ angle) => middle - Math.max(-1.35, Math.min(1.35, angle)) * size;
    drawLine(pen, theme, [left, middle, right, middle], 'hair');
    for (const edge of [-1, 1]) drawLine(pen, theme, [left, up(edge), right, up(edge)], 'ink', 1, [5, 4]);
    write(pen, theme, `tipping angle ${degreeText(block.alpha)}`, left, up(1) - 5);
    pen.save();
    pen.beginPath();
    pen.rect(left, 0, right - left, height);
    pen.clip();
    drawCurve(pen, theme, trace.length,
      (k) => [across(trace[k].time), low - (0.55 * size * trace[k].push) / GRAVITY],
      { role: 'base', width: 1.25 });
    drawCurve(pen, theme, trace.length, (k) => [across(trace[k].time), up(trace[k].angle)],
      { role: 'motion', width: 2.75 });
    for (const { time: at } of hits) {
      drawLine(pen, theme, [across(at), middle - 6, across(at), middle + 6], 'impact', 2);
    }
    pen.restore();
    const tip = Math.max(-1.2, Math.min(1.2, state.angle));
    write(pen, theme, 'tilt', right + 8, up(tip) + 4, { role: 'motion', bold: true });
    write(pen, theme, 'ground', right + 8, low + 4, { role: 'base', bold: true });
    if (hits.length) write(pen, theme, 'impacts', left, middle + 18, { role: 'impact', bold: true });
  };

  const busy = () => held !== null || keys !== 0 || (idle && events.length > 1) || (state.side !== 0 && !lies)
    || Math.abs(ground.speed) > 1e-4 || Math.abs(hand - ground.place) > 1e-4
    || Math.abs(camera - ground.place) > 2e-3 || time - pushed < QUIET.for + 0.1
    || (hits.length > 0 && time - hits[hits.length - 1].time < GLOW);
  const frame = () => {
    advance(performance.now() / 1000);
    tell();
    view.paint();
    going = view.seen && busy();
    if (going) requestAnimationFrame(frame);
    else if (idle && !touched) {
      idle = false;
      begin();
    }
  };
  const wake = () => {
    if (going) return;
    going = true;
    clock = performance.now() / 1000;
    requestAnimationFrame(frame);
  };

  const touch = () => {
    if (idle) { // the reader's hand takes over where the ground is
      idle = false;
      hand = ground.place;
      events = [];
    }
    if (!state.side && !lies) begin();
    touched = true;
    section.classList.add('touched', 'moved');
    wake();
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button || held) return;
    canvas.setPointerCapture(event.pointerId);
    touch();
    held = { id: event.pointerId, x: event.clientX, hand };
    events = [{ time: event.timeStamp / 1000, place: hand }];
  });
  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerId !== held?.id) return;
    const all = event.getCoalescedEvents?.() ?? [];
    for (const each of all.length ? all : [event]) {
      hand = held.hand + (each.clientX - held.x) / unit;
      events.push({ time: each.timeStamp / 1000, place: hand });
    }
    wake();
  });
  for (const name of /** @type {const} */ (['pointerup', 'pointercancel'])) {
    canvas.addEventListener(name, (event) => {
      if (event.pointerId === held?.id) held = null;
    });
  }
  canvas.addEventListener('keydown', (event) => {
    const to = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (to) {
      event.preventDefault();
      if (event.repeat || keys === to) return;
      touch();
      if (!events.length) events = [{ time: performance.now() / 1000, place: hand }];
      hand += to * KEY_STEP;
      keys = to;
      events.push({ time: performance.now() / 1000 + PUSH_STEP, place: hand });
    } else if (event.key === 'Escape' || event.key.toLowerCase() === 'r') stand();
  });
  for (const name of ['keyup', 'blur']) canvas.addEventListener(name, () => { keys = 0; });
  element('again').addEventListener('click', () => {
    stand();
    canvas.focus({ preventScroll: true });
  });
  element('take').addEventListener('click', () => {
    if (record.length < 2) return;
    app.motions.push({
      name: 'your push', dt: PUSH_STEP, acceleration: Float64Array.from(record),
      note: 'made by hand on this page',
    });
    app.set({
      at: 'lab', tab: 'quake', model: 'nonlinear', units: 'si', b: WIDTH, h: HEIGHT, rh: 1,
      record: app.motions.length - 1, scale: 1,
    });
  });
  // Nothing moves by itself where less motion is wanted, out of sight, or once it was touched.
  setInterval(() => {
    if (touched || going || app.still || !view.seen || document.hidden) return;
    const now = performance.now() / 1000;
    state = STANDING;
    begin();
    idle = true;
    hand = ground.place;
    events = NUDGE.map(([at, place]) => ({ time: now + at, place: ground.place + place }));
    wake();
  }, 1000 * IDLE_EVERY);
  stand();
}
