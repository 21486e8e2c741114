// The cells of a plane: asked of the pool from coarse to fine, kept, and painted on a canvas.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { ClassTiles } from '../../draw/classes.mjs' */
/** @import { PlaneAxes, PlaneAxis } from './axis.mjs' */
import { axisValues } from '../../physics/tiles.mjs';
import { partOn } from './axis.mjs';

/** @typedef {Record<string, Int8Array | Uint8Array | Int16Array | Int32Array | Float64Array>} PlaneCells */

/**
 * How the cells of a plane are computed and shown.
 * @typedef {object} RasterOptions
 * @property {string} name  of its requests
 * @property {(count: number) => PlaneCells} empty  room for the results of cells, not computed
 * @property {(k: number) => number} look  of a computed cell: the number of a tile, a colour as a
 *   word of pixels, or -1 as long as there is none
 * @property {(theme: Theme, ratio: number) => ClassTiles} tiles
 * @property {(k: number) => boolean} undecided  whether a computed cell is
 * @property {(axis: PlaneAxis, count: number) => Float64Array} [values]  along an axis
 * @property {readonly number[]} [steps]  cells from one to the next, from coarse to fine
 * @property {number} [whole]  below this step only cells at borders are computed
 * @property {boolean} [rectangles]  whether a job takes columns and rows of a tile, and not cells
 * @property {number} [held]  ms for which the picture of another motion may stay
 * @property {(k: number) => void} [noted]  called for each new cell
 * @property {() => boolean} [levelled]  called after each level: whether to paint all anew
 * @property {() => void} [begun]
 * @property {() => boolean} [ready]  whether the cells of a level that is done have their looks
 */

/**
 * What is computed.
 * @typedef {object} RasterTask
 * @property {string} job
 * @property {(xs: Float64Array, ys: Float64Array, nested: boolean) => object} args
 * @property {string} cost  cells of one name take about as long
 * @property {number} ms  that a cell takes, until it is measured
 * @property {string} motion  what is computed of a place, as a text
 * @property {PlaneAxes} axes
 * @property {number} columns
 * @property {number} rows
 * @property {number} width  of the picture [px]
 * @property {number} height
 */

/** @typedef {{ canvas: HTMLCanvasElement, axes: PlaneAxes, other: boolean }} RasterPicture */

const STEPS = [8, 4, 2, 1];
const TILE_MS = 14; // of a job
const FIRST_PRIORITY = -2; // of coarse cells: before what coexists at the point
const LATER_PRIORITY = 50;

/**
 * Return the cells of a plane.
 * @param {App} app
 * @param {RasterOptions} options
 * @param {{ changed: () => void, seen: () => boolean }} panel  to be told that there is more to
 *   draw; whether the panel is on the screen
 */
export function makeRaster(app, options, { changed, seen }) {
  const { steps = STEPS, whole = 1, rectangles = false, held = Infinity } = options;
  /** @type {RasterTask | undefined} */
  let task;
  let ticket = 0, level = 0, outstanding = 0, done = 0, wanted = 1, undecided = 0;
  let ratio = 1, fault = '', colours = '';
  let cells = options.empty(0), known = new Uint8Array(0);
  /** @type {Float64Array[]} */
  let values = [];
  /** @type {Record<string, number>} */
  const cellMs = {};
  /** @type {ClassTiles | undefined} */
  let tiles;
  /** @type {Theme | undefined} */
  let painted;
  let now = document.createElement('canvas'), before = document.createElement('canvas');
  /** @type {{ axes: PlaneAxes, step: number, until: number, other: boolean } | undefined} */
  let earlier; // the picture in `before`: its window, its fineness, and until when it may be shown
  /** @type {ImageData | undefined} */
  let image;
  let focus = { x: 0.5, y: 0.5 }; // in parts of the window, from its lower left corner
  /** @type {{ done: number, nearest: Int32Array } | undefined} */
  let filled;

  const pen = () => /** @type {CanvasRenderingContext2D} */ (now.getContext('2d'));
  const reached = () => (level > 0 ? steps[level - 1] : Infinity);

  /**
   * Begin anew; what is known of the same motion keeps its place until there is better.
   * @param {RasterTask} next
   */
  function begin(next) {
    app.pool.drop(`${options.name}:`);
    const last = task, same = last?.motion === next.motion;
    cells = options.empty(next.columns * next.rows);
    known = new Uint8Array(next.columns * next.rows);
    if (last) keepPicture(last, next, same);
    task = next;
    ticket += 1;
    level = outstanding = done = undecided = 0;
    wanted = Math.ceil(next.columns / whole) * Math.ceil(next.rows / whole);
    [fault, filled] = ['', undefined];
    options.begun?.();
    const along = options.values ?? ((axis, count) => axisValues(app.kernels, { ...axis, count }));
    values = [along(next.axes.x, next.columns), along(next.axes.y, next.rows)];
    paper(app.theme);
    if (!same && held < Infinity) setTimeout(changed, held + 1);
    askLevel();
  }

  /**
   * Keep the picture that shows most of the next window.
   * @param {RasterTask} last
   * @param {RasterTask} next
   * @param {boolean} same
   */
  function keepPicture(last, next, same) {
    const { x, y } = last.axes;
    if (x.log !== next.axes.x.log || x.keys[0] !== next.axes.x.keys[0]) earlier = undefined;
    else if (reached() < Infinity && (options.ready?.() ?? true) && (reached() <= earlierStep(last)
      || earlier?.other || overlap(earlier?.axes, next.axes) < 0.5)) {
      [now, before] = [before, now];
      earlier = { axes: { x, y }, step: reached(), until: Infinity, other: false };
      image = undefined;
    }
    if (!earlier || same) return;
    earlier.other = true;
    earlier.until = Math.min(earlier.until, performance.now() + held);
  }

  /** Return the size of a cell of the earlier picture in a window [cells]. @param {RasterTask} at */
  function earlierStep({ axes: to }) {
    if (!earlier) return Infinity;
    const { axes: from, step } = earlier;
    return step * Math.max(lengthOf(from.x) / lengthOf(to.x), lengthOf(from.y) / lengthOf(to.y));
  }

  /** Drop the earlier picture where there is a better one. */
  function retire() {
    if (!earlier || !task || level === 0 || !(options.ready?.() ?? true)) return;
    if (earlier.other || reached() <= earlierStep(task)) earlier = undefined;
  }

  /** Make canvas and image fit the task. @param {Theme} theme */
  function paper(theme) {
    if (!task) return;
    const next = Math.min(2, Math.max(1, Math.round(devicePixelRatio || 1)));
    if (next !== ratio || painted !== theme || !tiles) tiles = options.tiles(theme, next);
    [ratio, painted] = [next, theme];
    const [width, height] = [task.width * ratio, task.height * ratio];
    if (now.width !== width || now.height !== height) [now.width, now.height] = [width, height];
    else pen().clearRect(0, 0, width, height);
    if (!image || image.width !== width || image.height !== height) {
      image = new ImageData(width, height);
    } else image.data.fill(0);
  }

  /** Ask for the cells of the present level. */
  function askLevel() {
    if (!task) return;
    const { columns, rows, cost, args, job } = task;
    const step = steps[level], nested = level > 0, borders = step < whole ? atBorders(step) : null;
    const across = Math.ceil(columns / step), up = Math.ceil(rows / step);
    // An even number of cells along each side, so that a nested tile leaves out the known ones;
    // enough tiles for all workers.
    const most = Math.min(TILE_MS / (cellMs[cost] ?? task.ms) / (nested ? 0.75 : 1),
      (across * up) / (3 * app.pool.size));
    const side = 2 * Math.max(1, Math.min(32, Math.round(Math.sqrt(most) / 2)));
    const mine = ticket, asked = [];
    for (let row = 0; row < up; row += side) {
      for (let column = 0; column < across; column += side) {
        const [wide, high] = [Math.min(side, across - column), Math.min(side, up - row)];
        const places = [], from = [];
        for (let k = 0; k < wide * high; k += 1) {
          const [i, j] = [column + (k % wide), row + Math.floor(k / wide)];
          const at = (j * columns + i) * step;
          if ((nested && i % 2 === 0 && j % 2 === 0) || (borders && !borders[at])) continue;
          from.push(rectangles ? k : places.length);
          places.push(at);
        }
        const far = Math.max(Math.abs((column + side / 2) * step - focus.x * columns),
          Math.abs((row + side / 2) * step - focus.y * rows)) / Math.max(columns, rows);
        if (places.length) asked.push({ row, column, wide, high, places, from, far });
      }
    }
    outstanding = asked.length;
    if (borders) wanted += asked.reduce((sum, { places }) => sum + places.length, 0);
    for (const { row, column, wide, high, places, from, far } of asked) {
      const xs = rectangles ? every(values[0], column, wide, step)
        : Float64Array.from(places, (at) => values[0][at % columns]);
      const ys = rectangles ? every(values[1], row, high, step)
        : Float64Array.from(places, (at) => values[1][Math.floor(at / columns)]);
      const priority = (level === 0 ? FIRST_PRIORITY : LATER_PRIORITY) + far;
      const key = `${options.name}:${level}:${row}:${column}`;
      const how = { key, priority, ahead: level === 0 };
      app.pool.ask(job, args(xs, ys, nested), how).then((found) => {
        if (found && mine === ticket) take(found, places, from, step);
      }, failed).catch(failed);
    }
    /** @param {Error} error */
    function failed(error) {
      if (mine !== ticket) return;
      fault = String(error.message ?? error);
      changed();
    }
    if (!asked.length) nextLevel();
  }

  /**
   * Return which cells of a step lie at borders of the coarser ones.
   * @param {number} step
   */
  function atBorders(step) {
    const { columns, rows } = /** @type {RasterTask} */ (task), coarse = 2 * step;
    const found = new Uint8Array(known.length), nearest = nearestCells();
    const look = (/** @type {number} */ i, /** @type {number} */ j) => options.look(nearest[
      Math.min(rows - 1, Math.max(0, j)) * columns + Math.min(columns - 1, Math.max(0, i))]);
    for (let j = 0; j < rows; j += coarse) {
      for (let i = 0; i < columns; i += coarse) {
        const own = look(i, j), around = [-coarse, 0, coarse];
        if (around.every((up) => around.every((across) => look(i + across, j + up) === own))) continue;
        for (const [across, up] of [[step, 0], [0, step], [step, step]]) {
          if (i + across < columns && j + up < rows) found[(j + up) * columns + i + across] = 1;
        }
      }
    }
    return found;
  }

  /**
   * Keep and paint cells.
   * @param {PlaneCells & { ms: number }} result
   * @param {number[]} places
   * @param {number[]} from
   * @param {number} step
   */
  function take(result, places, from, step) {
    if (!task || !image) return;
    const { columns, cost, ms } = task;
    for (const [name, room] of Object.entries(cells)) {
      places.forEach((at, k) => { room[at] = result[name][from[k]]; });
    }
    let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const at of places) {
      known[at] = 1;
      undecided += Number(options.undecided(at));
      options.noted?.(at);
      paintCell(at, step);
      const x = at % columns, y = (at - x) / columns;
      [left, right] = [Math.min(left, x), Math.max(right, x)];
      [low, high] = [Math.min(low, y), Math.max(high, y)];
    }
    done += places.length;
    if (places.length > 8) {
      const each = Math.max(1e-3, result.ms / places.length);
      cellMs[cost] = (cellMs[cost] ?? ms) + 0.3 * (each - (cellMs[cost] ?? ms));
    }
    const one = edges(left, low, step), other = edges(right, high, step);
    pen().putImageData(image, 0, 0, one.left, other.top, other.right - one.left,
      one.bottom - other.top);
    outstanding -= 1;
    if (outstanding === 0) nextLevel();
    changed();
  }

  /** End a level. */
  function nextLevel() {
    level += 1;
    if (options.levelled?.()) repaint();
    retire();
    if (level < steps.length && seen()) askLevel();
    else if (!outstanding) changed();
  }

  /**
   * Return the square about a cell [px].
   * @param {number} x
   * @param {number} y
   * @param {number} step
   */
  function edges(x, y, step) {
    const { columns, rows, width, height } = /** @type {RasterTask} */ (task), half = step >> 1;
    const across = (/** @type {number} */ at) =>
      Math.round((Math.min(columns, Math.max(0, at)) * width * ratio) / columns);
    const up = (/** @type {number} */ at) =>
      Math.round(((rows - Math.min(rows, Math.max(0, at))) * height * ratio) / rows);
    return { left: across(x - half), right: across(x + step >= columns ? columns : x - half + step),
      bottom: up(y - half), top: up(y + step >= rows ? rows : y - half + step) };
  }

  /**
   * Paint one cell.
   * @param {number} at
   * @param {number} step
   */
  function paintCell(at, step) {
    if (!task || !image || !tiles) return;
    const look = options.look(at), x = at % task.columns;
    const { size, pixels } = tiles, pattern = pixels[look];
    if (!pattern) return;
    const { left, right, bottom, top } = edges(x, (at - x) / task.columns, step);
    const words = new Uint32Array(image.data.buffer), { width } = image;
    for (let row = top; row < bottom; row += 1) {
      const line = (row % size) * size;
      for (let column = left; column < right; column += 1) {
        words[row * width + column] = pattern[line + (column % size)];
      }
    }
  }

  /** Paint all cells again, in other colours. */
  function repaint() {
    if (!task || !image) return;
    const { columns, rows } = task;
    filled = undefined;
    steps.forEach((step, k) => {
      for (let y = 0; y < rows; y += step) {
        for (let x = 0; x < columns; x += step) {
          if (k > 0 && x % (2 * step) === 0 && y % (2 * step) === 0) continue;
          if (known[y * columns + x]) paintCell(y * columns + x, step);
        }
      }
    });
    pen().putImageData(image, 0, 0);
    retire();
  }

  /** Return the computed cell nearest to a cell; -1 without one. @param {number} i @param {number} j */
  function nearestTo(i, j) {
    const { columns, rows } = /** @type {RasterTask} */ (task);
    for (let k = Math.min(level, steps.length - 1); k >= 0; k -= 1) {
      const step = steps[k];
      const near = (/** @type {number} */ along, /** @type {number} */ count) =>
        Math.min(Math.floor((count - 1) / step), Math.floor((along + (step >> 1)) / step)) * step;
      const at = near(j, rows) * columns + near(i, columns);
      if (known[at]) return at;
    }
    return -1;
  }

  /** Return the computed cell nearest to each cell. */
  function nearestCells() {
    if (filled?.done === done) return filled.nearest;
    const { columns = 1 } = task ?? {};
    const nearest = Int32Array.from(known, (_, at) =>
      nearestTo(at % columns, Math.floor(at / columns)));
    filled = { done, nearest };
    return nearest;
  }

  return {
    begin,
    /** Paint all cells again, by new tiles. */
    repaint() {
      tiles = options.tiles(app.theme, ratio);
      repaint();
    },
    nearestCells,
    /** Go on where the panel was not seen. */
    resume() {
      if (task && !outstanding && level < steps.length && !fault) askLevel();
    },
    /**
     * Paint in other colours, if those that are named are others, or the theme is.
     * @param {string} name
     */
    recolour(name) {
      if (name === colours && app.theme === painted) return;
      if (name !== colours) tiles = undefined;
      colours = name;
      earlier = undefined;
      paper(app.theme);
      repaint();
    },
    /** @param {{ x: number, y: number }} at  in parts of the window */
    lookAt(at) {
      focus = at;
    },
    /**
     * Return the pictures to draw, the coarser one first.
     * @returns {RasterPicture[]}
     */
    pictures() {
      if (!task) return [];
      const found = [{ canvas: now, axes: task.axes, other: false }];
      if (!earlier || performance.now() > earlier.until) return found;
      const finer = earlierStep(task) < Math.min(reached(), steps[0]);
      found.splice(finer ? 1 : 0, 0, { canvas: before, ...earlier });
      return found;
    },
    /** Return the results, an element a cell. */
    cells: () => cells,
    task: () => task,
    /**
     * Return the computed cell nearest to a place, and the place that it is of; null without one.
     * @param {number} x  part of the window, from 0 to 1
     * @param {number} y
     */
    cellAt(x, y) {
      if (!task || !(x >= 0 && x <= 1 && y >= 0 && y <= 1)) return null;
      const { columns, rows } = task;
      const at = nearestTo(Math.floor(x * columns), Math.floor(y * rows));
      return at < 0 ? null : { at, x: values[0][at % columns], y: values[1][Math.floor(at / columns)] };
    },
    /** Return how far the computation is. */
    progress() {
      return { done, part: done / wanted, level, fault, undecided,
        complete: level === steps.length };
    },
  };
}

/** @param {PlaneAxis} axis */
function lengthOf({ from, to, log }) {
  return log ? Math.log(to / from) : to - from;
}

/**
 * Return the part of a window that another one covers.
 * @param {PlaneAxes | undefined} over
 * @param {PlaneAxes} seen
 */
function overlap(over, seen) {
  if (!over) return 0;
  const along = (/** @type {PlaneAxis} */ axis, /** @type {PlaneAxis} */ { from, to }) =>
    Math.max(0, Math.min(1, partOn(axis, to)) - Math.max(0, partOn(axis, from)));
  return along(seen.x, over.x) * along(seen.y, over.y);
}

/**
 * Return every so many values of an axis.
 * @param {Float64Array} values
 * @param {number} first  of the values that are taken
 * @param {number} count
 * @param {number} step
 */
function every(values, first, count, step) {
  return Float64Array.from({ length: count }, (_, k) => values[(first + k) * step]);
}
