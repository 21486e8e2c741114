// The stage: a block on ground that the reader pushes, on the landing and in the laboratory.

/** @import { App } from '../shell/app.mjs' */
/** @import { Reel } from '../physics/push/falling.mjs' */
/** @import { Pen } from '../story/draw.mjs' */
/** @import { Story } from '../story/words.mjs' */
import { evaluate, GRAVITY, rectangleOf } from '../physics/case.mjs';
import { reelAngle } from '../physics/push/falling.mjs';
import { STANDING, pushOn } from '../physics/push/pushed.mjs';
import { MOST_PUSH, PUSH_STEP, STILL_GROUND, handAt, pulledGround } from '../physics/push/spring.mjs';
import { blockCorners, shapeOf } from '../panels/scene.mjs';
import { drawBlock, drawCurve, drawFlash, drawGround, drawLine, drawRing, write } from '../story/draw.mjs';
import { knock } from '../story/sound.mjs';
import { makeView } from '../story/view.mjs';
import { degreeText } from '../story/words.mjs';

/** @typedef {{ width: number, height: number, restitution?: number }} Body  [m]; by default Housner's */

/**
 * Where the stage has what, in pixels.
 * @typedef {object} Layout
 * @property {number} middle  of the block's column
 * @property {number} level  of the ground
 * @property {number} tall  height of the block
 * @property {number} under  of the hand below the ground
 * @property {{ left: number, right: number, middle: number, size: number }} trace
 * @property {string} ticks  words at the right end of the ground; empty where there is no room
 */

/**
 * A run to be shown, and where the ground then is.
 * @typedef {{ reel: Reel & { base: Float64Array }, places: Float64Array }} Film
 */

/**
 * @typedef {object} Setting
 * @property {Body} body
 * @property {(width: number, height: number, body: Body) => Layout} layout
 * @property {(story: Story & { held: boolean, leaned: boolean }) => void} told  in each frame in which the hand acts
 * @property {() => void} touched  by a hand or a key
 * @property {() => void} [stood]  a key has stood the block up
 * @property {() => void} [ended]  the film has come to its end
 * @property {(push: { top: number, longest: number }) => void} [pushed]  [g], [s] one way; the ground is let go
 * @property {(body: Body, done: boolean) => void} [sized]  by its handles; with this its top is one too, by which it is tilted and let go
 * @property {(tilt: number, done: boolean) => boolean} [tilted]  theta/alpha by its top; whether it then is held there
 * @property {(at: Record<'wide' | 'tall', { x: number, y: number, shown: boolean }>) => void} [placed]
 */

const LAG = 1 / 60; // [s] between a hand and what is made of it: its events are as far apart
const MOST_BEHIND = 0.1; // [s] of a stall that are made up for
const QUIET = { push: 0.02 * GRAVITY, for: 0.6 }; // [m/s2], [s] after which the ground stands still
const KEY_STEP = 0.08, KEY_SPEED = 0.8; // [m] a press of an arrow, [m/s] while it is held
const SPAN = 9; // [s] of the trace
const LONGEST = 600; // [s] of a push that is kept
const GLOW = 0.3; // [s] of an impact
const PUSH = 0.05 * GRAVITY; // [m/s2] that count as a push one way
const REACH = { mouse: 16, touch: 26 }; // [px] of a handle
const BESIDE = { wide: 26, tall: 34 }; // [px] of the size's lines from the block
/** Sizes that handles and fields take [m]; stout: width over height of the widest block. */
export const SIZES = { least: 0.05, widest: 4, tallest: 8, stout: 0.9 };
const TILTED = 1.15; // |theta|/alpha to which the top may be dragged
const EASE = 9; // [1/s] of a size that has changed

/**
 * Make a stage.
 * @param {App} app
 * @param {HTMLCanvasElement} canvas
 * @param {Setting} setting
 */
export function makeStage(app, canvas, setting) {
  const { kernels } = app;
  let { body } = setting, block = measured(body), shape = shapeOf(body.width, body.height);
  let ground = STILL_GROUND, state = STANDING, lies = false;
  let clock = 0, time = 0; // of the page, and since the block was stood up [s]
  let hand = 0, camera = 0, unit = 0, wanted = 0, room = '';
  /** @type {{ time: number, place: number }[]} */
  let events = [];
  /** @type {{ id: number, what: 'push' | 'wide' | 'tall' | 'top', x: number, hand: number } | null} */
  let held = null;
  /** @type {{ film: Film, time: number, seconds: number, struck: number } | null} */
  let film = null;
  let keys = 0, going = false, shows = false, leaned = false;
  /** @type {number[]} */
  let record = [0];
  /** @type {{ time: number, angle: number, push: number }[]} */
  let trace = [];
  /** @type {{ time: number, side: number }[]} */
  let hits = [];
  let pushed = -9; // when the ground last moved
  const tale = { from: 0, reach: 0, top: 0, impacts: 0, peak: 0, way: 0, since: 0, longest: 0 };

  /** @param {Body} given */
  function measured({ width, height, restitution }) {
    const measures = rectangleOf(kernels, { width, height });
    return { ...measures, restitution: restitution ?? measures.housner, nonlinear: true };
  }
  const begin = () => {
    Object.assign(tale, { from: ground.place, reach: 0, top: 0, impacts: 0, peak: 0, way: 0, longest: 0 });
    record = [ground.push];
  };
  const stand = () => {
    [ground, state, lies, film, leaned] = [STILL_GROUND, STANDING, false, null, false];
    [hand, camera, time, pushed] = [0, 0, 0, -9];
    [events, trace, hits] = [[], [], []];
    begin();
    wake();
  };

  /** Bring ground and block to the present. @param {number} now  [s] */
  const advance = (now) => {
    if (now - clock > MOST_BEHIND) clock = now - MOST_BEHIND;
    const count = Math.floor((now - clock) / PUSH_STEP), passed = count * PUSH_STEP;
    if (count < 1) return;
    unit += (wanted - unit) * Math.min(1, EASE * passed);
    if (film) unreel(passed);
    else pull(now, count);
    clock += passed;
    time += passed;
    trace.push({ time, angle: state.angle, push: ground.push });
    while (trace[0].time < time - SPAN) trace.shift();
    while (hits.length && hits[0].time < time - SPAN) hits.shift();
    if (held || keys || shows) return;
    // A body that lies is brought to the middle of its column.
    const aside = lies ? Math.sign(state.angle) * 0.5 * (body.width + body.height) : 0;
    camera += (ground.place - aside - camera) * (app.still ? 1 : Math.min(1, 3 * passed));
  };
  /** Move the ground after the hand. @param {number} now @param {number} count  of steps */
  const pull = (now, count) => {
    if (keys) {
      hand += keys * KEY_SPEED * count * PUSH_STEP;
      events.push({ time: now, place: hand });
    }
    const samples = [ground.push];
    for (let k = 1; k <= count; k++) {
      const at = clock + k * PUSH_STEP - LAG;
      ground = pulledGround(ground, events.length ? handAt(events, at) : hand);
      samples.push(ground.push);
      if (!lies) note(time + k * PUSH_STEP);
      if (Math.abs(ground.push) > QUIET.push) pushed = time + k * PUSH_STEP;
    }
    if (shows) hand = handAt(events, clock + count * PUSH_STEP - LAG);
    if (!lies && !leaned) march(samples);
  };
  /** Note how far and how hard the ground has gone. @param {number} now */
  const note = (now) => {
    tale.top = Math.max(tale.top, Math.abs(ground.push) / GRAVITY);
    tale.reach = Math.max(tale.reach, Math.abs(ground.place - tale.from));
    const way = Math.abs(ground.push) < PUSH ? 0 : Math.sign(ground.push);
    if (way !== tale.way) Object.assign(tale, { way, since: now });
    if (way) tale.longest = Math.max(tale.longest, now - tale.since);
  };
  /** @param {number[]} samples  of the ground [m/s2] */
  const march = (samples) => {
    if (record.length < LONGEST / PUSH_STEP) record.push(...samples.slice(1));
    const found = pushOn(kernels, block, state, Float64Array.from(samples));
    ({ state, lies } = found);
    tale.peak = Math.max(tale.peak, found.peak);
    for (const { time: after, side, speed } of found.impacts) strike(time + after, side, speed);
    if (lies) state = { ...state, angle: (Math.sign(state.angle) * 0.5 * Math.PI) / block.alpha };
  };
  /** @param {number} at @param {number} side @param {number} speed */
  const strike = (at, side, speed) => {
    tale.impacts += 1;
    hits.push({ time: at, side });
    knock(speed);
  };
  /** Show the film some time later; the ground is the hand's again where it ends. @param {number} passed */
  const unreel = (passed) => {
    if (!film) return;
    const { film: { reel, places }, seconds } = film, at = Math.min(film.time + passed, seconds);
    const k = Math.min(Math.round(at / reel.step), places.length - 1), before = Math.max(k - 1, 0);
    const angle = reelAngle(reel, at), flat = (0.5 * Math.PI) / block.alpha;
    ground = {
      place: places[k], push: reel.base[k] * block.alpha * GRAVITY,
      speed: (places[k] - places[before]) / reel.step,
    };
    state = { ...STANDING, side: Math.sign(angle), angle, velocity: reel.velocity[k] };
    const { impacts } = reel;
    for (; film.struck < impacts.time.length && impacts.time[film.struck] <= at; film.struck++) {
      strike(time + impacts.time[film.struck] - film.time, impacts.side[film.struck], impacts.speed[film.struck]);
    }
    film.time = at;
    lies = Math.abs(angle) >= flat * (1 - 1e-9);
    if (at >= seconds || lies) {
      release();
      setting.ended?.();
    }
  };
  /** Leave the ground to the hand where the film has it. */
  const release = () => {
    film = null;
    hand = ground.place;
    events = [];
    if (lies) ground = { ...STILL_GROUND, place: hand };
  };

  const story = () => ({
    ...tale, alpha: block.alpha, lift: evaluate(kernels, 'tan', block.alpha), lies, rocks: state.side !== 0,
    angle: Math.abs(state.angle), quiet: time - pushed > QUIET.for, held: held !== null || keys !== 0, leaned,
  });
  /** Whether the block can be measured and tilted: it stands, or is held at a tilt. */
  const waits = () => !lies && (state.side === 0 || leaned);
  /** Whether its height is beside it, and not behind it where it leans. */
  const tallShown = () => waits() && state.side >= 0;
  /** Whether no ground that a hand makes brings the block back. */
  const lost = () => lies || Math.abs(state.angle) * block.alpha >= block.alpha + Math.atan(MOST_PUSH / GRAVITY);

  const spots = (/** @type {Layout} */ { middle, level, under }) => {
    const x = middle + (ground.place - camera) * unit, right = x + shape.halfWidth * unit;
    const theta = state.angle * block.alpha, [, , a, b] = blockCorners(shape, theta);
    return {
      x,
      push: { x: lies ? middle : middle + (hand - camera) * unit, y: level + under },
      wide: { x: right, y: level + BESIDE.wide },
      tall: { x: right + BESIDE.tall, y: level - body.height * unit },
      top: { x: x + 0.5 * (a[0] + b[0]) * unit, y: level - 0.5 * (a[1] + b[1]) * unit },
    };
  };
  const layout = () => setting.layout(canvas.clientWidth, canvas.clientHeight, body);

  const view = makeView(canvas, (pen, width, height) => {
    const { theme } = app, given = setting.layout(width, height, body), { level } = given;
    if (held?.what !== 'wide' && held?.what !== 'tall') wanted = given.tall / body.height;
    if (app.still || room !== `${width} ${height}`) unit = wanted;
    room = `${width} ${height}`;
    const at = spots(given);
    if (shows || time > 0 && (trace.length > 2)) drawTrace(pen, given);
    drawGround(pen, theme, { width, height: height - level, y: level, x: at.x, unit });
    drawBlock(pen, theme, shape, {
      x: at.x, y: level, unit, angle: state.angle * block.alpha,
      fate: lost() ? 'overturned' : state.side ? 'rocking' : 'rest',
    });
    if (!lost() && Math.abs(state.angle) > 1) drawPlumb(pen, at.x, level);
    for (const { time: hit, side } of hits.slice(-4)) {
      drawFlash(pen, theme, at.x + side * shape.halfWidth * unit, level, 1 - (time - hit) / GLOW);
    }
    if (setting.sized && waits()) {
      drawSizes(pen, at, level);
      drawRing(pen, theme, at.top.x, at.top.y, leaned ? 12 : 9);
    }
    for (const to of [-1, 1]) {
      const { x, y } = at.push;
      drawLine(pen, theme, [x + 20 * to, y, x + 38 * to, y], 'ink', 2.5);
      for (const up of [-7, 7]) drawLine(pen, theme, [x + 31 * to, y + up, x + 38 * to, y], 'ink', 2.5);
    }
    drawRing(pen, theme, at.push.x, at.push.y, held?.what === 'push' ? 14 : 11);
    if (given.ticks) write(pen, theme, given.ticks, given.trace.right, level + 28, { align: 'right' });
    setting.placed?.({
      wide: { x: at.wide.x, y: at.wide.y, shown: waits() },
      tall: { x: at.tall.x, y: level - 0.5 * body.height * unit, shown: tallShown() },
    });
  });

  /** Draw width and height with their handles. @param {Pen} pen @param {ReturnType<typeof spots>} at
   * @param {number} level */
  const drawSizes = (pen, { x, wide, tall }, level) => {
    const { theme } = app, left = x - shape.halfWidth * unit;
    drawLine(pen, theme, [left, wide.y, wide.x, wide.y], 'ink', 1.25);
    for (const edge of [left, wide.x]) drawLine(pen, theme, [edge, level + 16, edge, wide.y + 6], 'ink');
    drawRing(pen, theme, wide.x, wide.y, held?.what === 'wide' ? 9 : 7);
    if (!tallShown()) return;
    drawLine(pen, theme, [tall.x, tall.y, tall.x, level], 'ink', 1.25);
    drawLine(pen, theme, [wide.x + 6, tall.y, tall.x + 6, tall.y], 'ink');
    drawRing(pen, theme, tall.x, tall.y, held?.what === 'tall' ? 9 : 7);
  };
  /** Draw the plumb line through the mass centre, which stands outside its corner. @param {Pen} pen
   * @param {number} x @param {number} level */
  const drawPlumb = (pen, x, level) => {
    const { theme } = app, [a, , b] = blockCorners(shape, state.angle * block.alpha);
    const at = x + 0.5 * (a[0] + b[0]) * unit, up = level - 0.5 * (a[1] + b[1]) * unit;
    drawLine(pen, theme, [at, up, at, level + 12], 'ink', 1.25, [5, 4]);
    pen.beginPath();
    pen.arc(at, up, 4, 0, 2 * Math.PI);
    pen.fillStyle = theme.ink;
    pen.fill();
  };
  /** @param {Pen} pen @param {Layout} given */
  const drawTrace = (pen, { trace: { left, right, middle, size } }) => {
    const { theme } = app, low = middle + 2.1 * size;
    const across = (/** @type {number} */ at) => right - ((time - at) / SPAN) * (right - left);
    const up = (/** @type {number} */ angle) => middle - Math.max(-1.35, Math.min(1.35, angle)) * size;
    const most = Math.max(GRAVITY, ...trace.map(({ push }) => Math.abs(push)));
    drawLine(pen, theme, [left, middle, right, middle], 'hair');
    for (const edge of [-1, 1]) drawLine(pen, theme, [left, up(edge), right, up(edge)], 'ink', 1, [5, 4]);
    write(pen, theme, `tipping angle ${degreeText(block.alpha)}`, left, up(1) - 5);
    pen.save();
    pen.beginPath();
    pen.rect(left, 0, right - left, low + 2 * size);
    pen.clip();
    drawCurve(pen, theme, trace.length,
      (k) => [across(trace[k].time), low - (0.55 * size * trace[k].push) / most],
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
    if (hits.length) write(pen, theme, 'impacts', left, size < 18 ? middle - 2 : middle + 18, { role: 'impact', bold: true });
  };

  const busy = () => held !== null || keys !== 0 || film !== null || (shows && events.length > 1)
    || (state.side !== 0 && !lies && !leaned)
    || Math.abs(ground.speed) > 1e-4 || Math.abs(hand - ground.place) > 1e-4
    || (!lies && Math.abs(camera - ground.place) > 2e-3) || time - pushed < QUIET.for + 0.1
    || Math.abs(unit - wanted) > 0.3
    || (lies && Math.abs(camera - ground.place + Math.sign(state.angle) * 0.5 * (body.width + body.height)) > 4e-3)
    || (hits.length > 0 && time - hits[hits.length - 1].time < GLOW);
  const frame = () => {
    advance(performance.now() / 1000);
    if (!film) setting.told(story());
    view.paint();
    going = view.seen && busy();
    if (going) requestAnimationFrame(frame);
    else if (shows) {
      shows = false;
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
    if (film) release();
    if (shows) { // the reader's hand takes over where the ground is
      shows = false;
      hand = ground.place;
      events = [];
    }
    if (leaned) leaned = false;
    if (lies && setting.sized) stand();
    if (!state.side && !lies) begin();
    setting.touched();
    wake();
  };
  /** Have the top follow the pointer: nothing moves until it is let go. */
  const tilt = () => {
    leaned = true;
    begin();
    setting.touched();
  };
  /** Hold the block at a tilt. @param {number} angle */
  const hold = (angle) => {
    state = Math.abs(angle) < 0.01 ? STANDING : { ...STANDING, side: Math.sign(angle), angle };
  };
  const place = (/** @type {PointerEvent} */ event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  /** Return what lies at a place. @param {{ x: number, y: number }} place @param {number} reach */
  const under = ({ x, y }, reach) => {
    const at = spots(layout()), near = (/** @type {{ x: number, y: number }} */ spot) =>
      Math.hypot(spot.x - x, spot.y - y) < reach;
    if (setting.sized && waits()) {
      for (const what of /** @type {const} */ (['top', 'wide', 'tall'])) {
        if (near(at[what]) && (what !== 'tall' || tallShown())) return what;
      }
    }
    return 'push';
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button || held) return;
    const what = under(place(event), event.pointerType === 'touch' ? REACH.touch : REACH.mouse);
    canvas.setPointerCapture(event.pointerId);
    if (what === 'push') touch();
    else if (what === 'top') tilt();
    held = { id: event.pointerId, what, x: event.clientX, hand };
    if (what === 'push') events = [{ time: event.timeStamp / 1000, place: hand }];
    wake();
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!held) {
      const what = under(place(event), REACH.mouse);
      canvas.style.cursor = { push: '', top: 'grab', wide: 'ew-resize', tall: 'ns-resize' }[what];
    }
    if (event.pointerId !== held?.id) return;
    if (held.what !== 'push') return drag(place(event));
    const all = event.getCoalescedEvents?.() ?? [];
    for (const each of all.length ? all : [event]) {
      hand = held.hand + (each.clientX - held.x) / unit;
      events.push({ time: each.timeStamp / 1000, place: hand });
    }
    wake();
  });
  /** Have a handle follow the pointer. @param {{ x: number, y: number }} to */
  const drag = ({ x, y }) => {
    const at = spots(layout()), { level } = layout(), { width, height } = body;
    const size = (/** @type {number} */ value, /** @type {number} */ least, /** @type {number} */ most) =>
      Number(Math.min(Math.max(value, least), most).toFixed(2));
    if (held?.what === 'wide') {
      setting.sized?.({ width: size((2 * (x - at.x)) / unit, SIZES.least, Math.min(SIZES.widest, SIZES.stout * height)), height }, false);
    } else if (held?.what === 'tall') {
      setting.sized?.({ width, height: size((level - y) / unit, width / SIZES.stout, SIZES.tallest) }, false);
    } else {
      const theta = Math.atan2(at.x - x, level - y), most = TILTED * block.alpha;
      const angle = Math.min(Math.max(theta, -most), most) / block.alpha;
      hold(angle);
      setting.tilted?.(state.angle, false);
    }
    wake();
  };
  for (const name of /** @type {const} */ (['pointerup', 'pointercancel'])) {
    canvas.addEventListener(name, (event) => {
      if (event.pointerId !== held?.id) return;
      const { what } = held;
      held = null;
      if (what === 'push') setting.pushed?.({ top: tale.top, longest: tale.longest });
      else if (what === 'top') leaned = setting.tilted?.(state.angle, true) ?? false;
      else setting.sized?.(body, true);
      wake();
    });
  }
  canvas.addEventListener('keydown', (event) => {
    const to = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (to) {
      event.preventDefault();
      event.stopPropagation();
      if (event.repeat || keys === to) return;
      touch();
      if (!events.length) events = [{ time: performance.now() / 1000, place: hand }];
      hand += to * KEY_STEP;
      keys = to;
      events.push({ time: performance.now() / 1000 + PUSH_STEP, place: hand });
    } else if (event.key === 'Escape' || event.key.toLowerCase() === 'r') {
      event.stopPropagation();
      stand();
      setting.stood?.();
    }
  });
  for (const name of ['keyup', 'blur']) {
    canvas.addEventListener(name, () => {
      if (keys) setting.pushed?.({ top: tale.top, longest: tale.longest });
      keys = 0;
    });
  }
  return {
    view,
    stand,
    /** @param {Body} next */
    resize(next) {
      const same = next.width === body.width && next.height === body.height && next.restitution === body.restitution;
      if (same) return;
      body = next;
      [block, shape] = [measured(body), shapeOf(body.width, body.height)];
      if (!held || held.what === 'push') stand();
      else view.ask();
    },
    /** Hold the block at a tilt until it is let go; null stands it up where it was held. @param {number | null} angle */
    lean(angle) {
      if (held) return;
      if (angle === null && !leaned) return;
      stand();
      if (angle !== null) {
        leaned = true;
        hold(angle);
      }
      wake();
    },
    /** @param {Film} next */
    play(next) {
      stand();
      film = { film: next, time: 0, seconds: next.reel.step * (next.places.length - 1), struck: 0 };
      if (app.still) unreel(film.seconds);
      wake();
    },
    /** Move the ground as a hand would that has not touched it. @param {readonly (readonly [number, number])[]} nudge */
    show(nudge) {
      const now = performance.now() / 1000;
      state = STANDING;
      begin();
      shows = true;
      hand = ground.place;
      events = nudge.map(([at, by]) => ({ time: now + at, place: ground.place + by }));
      wake();
    },
    get going() { return going; },
    get record() { return record; },
  };
}
