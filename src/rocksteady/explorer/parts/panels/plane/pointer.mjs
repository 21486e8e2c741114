// Pointer, wheel and keys on a plane: the point, the window, a box.

/** @import { PlaneAxes, PlanePlace } from './axis.mjs' */
import { endedAxis, panned, partOf, placeIn, roundPlace, stepOn, zoomed } from './axis.mjs';

/** @typedef {{ left: number, top: number, width: number, height: number }} PlaneBox */

/**
 * What a plane shows, and what is done to it.
 * @typedef {object} PlaneHandle
 * @property {() => PlaneBox} box  inside the axes [px]
 * @property {() => PlaneAxes} axes
 * @property {() => PlanePlace} point
 * @property {(place: PlanePlace, settled: boolean, push?: boolean) => void} movePoint
 * @property {(axes: PlaneAxes, settled: boolean) => void} show
 * @property {() => void} reset  the window
 * @property {(at: { x: number, y: number } | null) => void} hover  a pixel, or nothing
 * @property {(box: PlaneBox | null) => void} mark  a box that is being drawn
 * @property {number} [arrow]  part of an axis that an arrow key goes; a pixel where it is missing
 */

const GRASP = 22; // [px] around the point: a target of 44 px
const SMALLEST_BOX = 8; // [px]
const TWICE_MS = 400;
const TWICE_PX = 24;
const WHEEL_MS = 400; // after the last turn of the wheel the window is settled
export const ZOOM_STEP = 2;

/**
 * Let pointers act on a plane.
 * @param {HTMLCanvasElement} canvas
 * @param {PlaneHandle} plane
 */
export function listenToPointers(canvas, plane) {
  /** @type {Map<number, { x: number, y: number }>} */
  const down = new Map();
  /** @type {((at: { x: number, y: number }, done: boolean) => void) | null} */
  let drag = null;
  /** @type {(() => void) | null} */
  let undo = null; // what the first finger of a pinch has done
  let last = { time: -Infinity, x: 0, y: 0, point: plane.point(), moved: false };
  let turning = 0;

  const at = (/** @type {PointerEvent | WheelEvent} */ event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  };
  const part = (/** @type {{ x: number, y: number }} */ pixel) => {
    const { left, top, width, height } = plane.box();
    return { x: (pixel.x - left) / width, y: 1 - (pixel.y - top) / height };
  };
  const inside = (/** @type {{ x: number, y: number }} */ pixel) => {
    const { x, y } = part(pixel);
    return x >= 0 && x <= 1 && y >= 0 && y <= 1;
  };
  const within = (/** @type {{ x: number, y: number }} */ { x, y }) =>
    ({ x: Math.min(1, Math.max(0, x)), y: Math.min(1, Math.max(0, y)) });

  const toPoint = (/** @type {{ x: number, y: number }} */ { x, y }) => {
    const { left, top, width, height } = plane.box(), there = partOf(plane.axes(), plane.point());
    return { x: left + there.x * width - x, y: top + (1 - there.y) * height - y };
  };
  const grasped = (/** @type {{ x: number, y: number }} */ { x, y }) => Math.hypot(x, y) <= GRASP;

  /** @param {{ x: number, y: number }} from */
  const dragPoint = (from) => {
    const { width, height } = plane.box(), near = toPoint(from), held = grasped(near);
    const offset = held ? near : { x: 0, y: 0 };
    /** @type {typeof drag} */
    const move = (to, done) => {
      const place = placeIn(plane.axes(), within(part({ x: to.x + offset.x, y: to.y + offset.y })));
      plane.movePoint(roundPlace(plane.axes(), place, { width, height }), done);
    };
    if (!held) move(from, false);
    return move;
  };
  /** @param {{ x: number, y: number }} from */
  const dragBox = (from) => {
    const begin = within(part(from));
    /** @type {typeof drag} */
    const move = (to, done) => {
      const end = within(part(to)), { left, top, width, height } = plane.box();
      const [x0, x1] = [Math.min(begin.x, end.x), Math.max(begin.x, end.x)];
      const [y0, y1] = [Math.min(begin.y, end.y), Math.max(begin.y, end.y)];
      const box = { left: left + x0 * width, top: top + (1 - y1) * height,
        width: (x1 - x0) * width, height: (y1 - y0) * height };
      plane.mark(done ? null : box);
      if (!done || box.width < SMALLEST_BOX || box.height < SMALLEST_BOX) return;
      const seen = plane.axes(), low = placeIn(seen, { x: x0, y: y0 });
      const high = placeIn(seen, { x: x1, y: y1 });
      plane.show({ x: endedAxis(seen.x, low.x, high.x), y: endedAxis(seen.y, low.y, high.y) }, true);
    };
    return move;
  };
  /** @param {{ x: number, y: number }} from */
  const dragWindow = (from) => {
    const begin = plane.axes(), held = placeIn(begin, part(from));
    /** @type {typeof drag} */
    const move = (to, done) => plane.show(panned(begin, held, placeIn(begin, part(to))), done);
    return move;
  };
  const pinch = () => {
    const begin = plane.axes(), first = span();
    const held = placeIn(begin, part(first));
    /** @type {typeof drag} */
    const move = (_, done) => {
      const present = down.size === 2 ? span() : null;
      if (!present) return plane.show(plane.axes(), done);
      const near = zoomed(begin, first.length / Math.max(1, present.length), held);
      plane.show(panned(near, held, placeIn(near, part(present))), done);
    };
    return move;
  };
  const span = () => {
    const [one, other] = [...down.values()];
    return { x: (one.x + other.x) / 2, y: (one.y + other.y) / 2,
      length: Math.hypot(one.x - other.x, one.y - other.y) };
  };

  canvas.addEventListener('pointerdown', (event) => {
    const pixel = at(event);
    if (event.button > 1 || (!inside(pixel) && !grasped(toPoint(pixel)))) return;
    event.preventDefault();
    canvas.focus({ preventScroll: true });
    try {
      canvas.setPointerCapture(event.pointerId);
    } catch {
      // A pointer made by a script has no capture.
    }
    down.set(event.pointerId, pixel);
    plane.hover(null);
    if (down.size === 2) {
      undo?.();
      drag = pinch();
      return;
    }
    if (down.size > 2) return;
    const twice = !last.moved && event.timeStamp - last.time < TWICE_MS
      && Math.hypot(pixel.x - last.x, pixel.y - last.y) < TWICE_PX && event.button === 0;
    if (twice) {
      drag = null;
      plane.movePoint(last.point, true);
      plane.reset();
      last = { ...last, time: -Infinity };
      return;
    }
    const point = plane.point();
    last = { time: event.timeStamp, ...pixel, point, moved: false };
    undo = () => plane.movePoint(point, false);
    drag = event.shiftKey ? dragBox(pixel)
      : event.altKey || event.button === 1 ? dragWindow(pixel) : dragPoint(pixel);
  });
  canvas.addEventListener('pointermove', (event) => {
    const pixel = at(event);
    if (!down.has(event.pointerId)) {
      if (event.pointerType !== 'touch') plane.hover(inside(pixel) ? pixel : null);
      return;
    }
    down.set(event.pointerId, pixel);
    if (Math.hypot(pixel.x - last.x, pixel.y - last.y) > 3) last.moved = true;
    drag?.(pixel, false);
  });
  const end = (/** @type {PointerEvent} */ event) => {
    if (!down.has(event.pointerId)) return;
    if (down.size === 1 || down.size === 2) drag?.(at(event), true);
    if (down.size === 2) last.moved = true;
    down.delete(event.pointerId);
    drag = null; // a finger that is left does nothing until it is lifted
    undo = null;
  };
  canvas.addEventListener('keydown', ({ key }) => {
    if (key !== 'Escape' || !drag) return;
    drag = null;
    plane.mark(null);
  });
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('pointerleave', () => plane.hover(null));
  canvas.addEventListener('wheel', (event) => {
    const pixel = at(event);
    if (!inside(pixel)) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 24 : 1;
    const turn = Math.max(-240, Math.min(240, event.deltaY * lines));
    const factor = Math.exp(turn * (event.ctrlKey ? 0.01 : 0.0016));
    plane.show(zoomed(plane.axes(), factor, placeIn(plane.axes(), part(pixel))), false);
    clearTimeout(turning);
    turning = window.setTimeout(() => plane.show(plane.axes(), true), WHEEL_MS);
  }, { passive: false });
}

/**
 * Act on a key; return whether it means something here.
 * @param {KeyboardEvent} event
 * @param {PlaneHandle} plane
 */
export function planeKey({ key, shiftKey }, plane) {
  const seen = plane.axes(), point = plane.point(), size = plane.box(), many = shiftKey ? 10 : 1;
  /** @type {Record<string, [number, number]>} */
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
  if (key in arrows) {
    const [across, up] = arrows[key], { arrow } = plane, part = partOf(seen, point);
    const to = arrow
      ? placeIn(seen, { x: part.x + across * many * arrow, y: part.y + up * many * arrow })
      : { x: point.x + across * many * stepOn(seen.x, point.x, size.width),
        y: point.y + up * many * stepOn(seen.y, point.y, size.height) };
    plane.movePoint(roundPlace(seen, to, size), true, false);
    return true;
  }
  if (key === '0') plane.reset();
  else if (key === '+' || key === '=') zoomAbout(plane, 1 / ZOOM_STEP);
  else if (key === '-' || key === '_') zoomAbout(plane, ZOOM_STEP);
  else return false;
  return true;
}

/**
 * Zoom about the point where it is seen, else about the middle.
 * @param {PlaneHandle} plane
 * @param {number} factor
 */
export function zoomAbout(plane, factor) {
  const seen = plane.axes(), { x, y } = partOf(seen, plane.point());
  const there = x >= 0 && x <= 1 && y >= 0 && y <= 1;
  const about = there ? plane.point() : placeIn(seen, { x: 0.5, y: 0.5 });
  plane.show(zoomed(seen, factor, about), true);
}
