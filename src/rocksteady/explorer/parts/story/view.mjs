// Canvases of the story: crisp, as large as their boxes, drawn when asked and while in sight.

/**
 * @typedef {object} View
 * @property {HTMLCanvasElement} canvas
 * @property {boolean} seen  whether it is in the window
 * @property {() => void} ask  has it drawn in the next frame
 * @property {() => void} paint  draws it at once
 */

const SHEET = 3; // pixels of a canvas that is printed, each way
let firstAt = 0; // the frame in which a canvas was last drawn for the first time: it takes long, another waits

/**
 * Return a view that draws on a canvas.
 * @param {HTMLCanvasElement} canvas
 * @param {(pen: CanvasRenderingContext2D, width: number, height: number) => void} draw
 * @returns {View}
 */
export function makeView(canvas, draw) {
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  let asked = false, drawn = false;
  const view = {
    canvas,
    seen: false,
    ask() {
      if (asked || !view.seen) return;
      asked = true;
      requestAnimationFrame(function frame(now) {
        if (!drawn && firstAt === now) {
          requestAnimationFrame(frame);
          return;
        }
        if (!drawn) firstAt = now;
        [asked, drawn] = [false, true];
        view.paint();
      });
    },
    paint() {
      const { clientWidth: width, clientHeight: height } = canvas;
      if (!width || !height) return;
      const ratio = 'sheet' in document.documentElement.dataset ? SHEET : Math.min(devicePixelRatio || 1, 2);
      const across = Math.round(width * ratio), down = Math.round(height * ratio);
      if (canvas.width !== across || canvas.height !== down) {
        Object.assign(canvas, { width: across, height: down });
      }
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.clearRect(0, 0, width, height);
      draw(pen, width, height);
    },
  };
  new ResizeObserver(view.ask).observe(canvas);
  new IntersectionObserver((all) => {
    view.seen = all[all.length - 1].isIntersecting;
    view.ask();
  }).observe(canvas);
  document.addEventListener('theme', view.ask);
  document.addEventListener('sheet', view.paint);
  return view;
}

/**
 * Have a canvas answer a drag that begins on something, and leave all else to scrolling.
 * @template What
 * @param {HTMLCanvasElement} canvas
 * @param {(x: number, y: number) => What | null} begin  what lies there
 * @param {(what: What, x: number, y: number, done: boolean) => void} move
 */
export function dragOn(canvas, begin, move) {
  /** @type {What | null} */
  let held = null;
  const at = (/** @type {PointerEvent} */ event) => {
    const box = canvas.getBoundingClientRect();
    return /** @type {const} */ ([event.clientX - box.left, event.clientY - box.top]);
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button) return;
    held = begin(...at(event));
    if (held === null) return;
    canvas.setPointerCapture(event.pointerId);
    move(held, ...at(event), false);
    event.preventDefault();
  });
  canvas.addEventListener('pointermove', (event) => {
    if (held !== null) move(held, ...at(event), false);
    else canvas.style.cursor = begin(...at(event)) === null ? '' : 'ew-resize';
  });
  for (const name of /** @type {const} */ (['pointerup', 'pointercancel'])) {
    canvas.addEventListener(name, (event) => {
      const what = held;
      held = null;
      if (what !== null) move(what, ...at(event), true);
    });
  }
  canvas.addEventListener('touchmove', (event) => {
    if (held !== null) event.preventDefault();
  }, { passive: false });
}
