// Fills of the classes of motion: on a raster, and on any area or swatch of a legend.

/** @typedef {import('./svg.mjs').Pen} Pen */
/** @typedef {import('./theme.mjs').Theme} Theme */
/** @typedef {{ left: number, top: number, width: number, height: number }} Box */
import { mixed, rgbOf } from './theme.mjs';

/**
 * The class of a cell, numbered as in the package's plots (`CellClass`).
 * @typedef {'rest' | 'symmetric' | 'unsymmetric' | 'subharmonic' | 'aperiodic' | 'rocking'
 *   | 'overturned' | 'undecided' | 'no-start' | 'not-computed'} MotionClass
 */

/** @type {readonly MotionClass[]} */
export const MOTION_CLASSES = ['rest', 'symmetric', 'unsymmetric', 'subharmonic', 'aperiodic',
  'rocking', 'overturned', 'undecided', 'no-start', 'not-computed'];

/** @typedef {'rising' | 'falling' | 'crossed' | 'level' | 'upright' | 'dots'} PatternKind */

/**
 * A fill and its pattern: lines `every` so many pixels, or dots on a square lattice.
 * @typedef {{ fill: string, mark?: string, kind?: PatternKind, every?: number, size?: number }}
 *   Look
 */

/**
 * Return how a class looks, patterns as in the package's plots (`HATCHES`).
 * @param {Theme} theme
 * @param {MotionClass} name
 * @returns {Look}
 */
export function classLook(theme, name) {
  const { paper, edge, onRocks, onFalls } = theme;
  const half = (/** @type {string} */ fill, /** @type {string} */ mark) =>
    ({ fill, mark: mixed(fill, mark, 0.5) });
  switch (name) {
    case 'unsymmetric': return { ...half(theme.unsymmetric, onRocks), kind: 'level', every: 4 };
    case 'subharmonic': return { ...half(theme.subharmonic, onRocks), kind: 'upright', every: 4 };
    case 'aperiodic':
      return { ...half(theme.aperiodic, onFalls), kind: 'dots', every: 4, size: 0.55 };
    case 'overturned': return fallLook(theme, 1, 1);
    case 'undecided': return { ...half(theme.undecided, onRocks), kind: 'crossed', every: 8 };
    case 'no-start': return { fill: paper, mark: edge, kind: 'falling', every: 8, size: 0.8 };
    case 'not-computed': return { fill: paper, mark: edge, kind: 'dots', every: 6, size: 0.6 };
    case 'rocking': return { fill: theme.rocks };
    default: return { fill: theme[name] };
  }
}

/**
 * Return how a fall looks: hatched to its side, closer with each impact before it.
 * @param {Theme} theme
 * @param {number} side  1 to the left, -1 to the right
 * @param {number} impacts
 * @returns {Look}
 */
export function fallLook({ falls, edge, quiet, dark }, side, impacts) {
  const every = [12, 6, 4][Math.min(impacts, 2)];
  return { fill: falls, mark: dark ? edge : quiet, kind: side < 0 ? 'falling' : 'rising', every };
}

/**
 * Fill a box with a class and its pattern; set a clip path before for any other shape.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {MotionClass} name
 * @param {Box} box
 */
export function fillClass(pen, theme, name, box) {
  fillLook(pen, classLook(theme, name), box);
}

/**
 * Fill a box with a colour and its pattern.
 * @param {Pen} pen
 * @param {Look} look
 * @param {Box} box
 */
export function fillLook(pen, { fill, mark = fill, kind, every = 6, size = 1 }, box) {
  pen.save();
  pen.fillStyle = fill;
  pen.fillRect(box.left, box.top, box.width, box.height);
  if (kind === 'dots') dotBox(pen, mark, every, size, box);
  else if (kind) hatchBox(pen, box, { colour: mark, every, width: size, kind });
  pen.restore();
}

/**
 * Draw a swatch of a class with an outline.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {MotionClass} name
 * @param {Box} box
 */
export function classSwatch(pen, theme, name, box) {
  lookSwatch(pen, theme, classLook(theme, name), box);
}

/**
 * Draw a swatch of a look with an outline.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {Look} look
 * @param {Box} box
 */
export function lookSwatch(pen, theme, look, box) {
  fillLook(pen, look, box);
  pen.save();
  pen.setLineDash([]);
  pen.strokeStyle = theme.edge;
  pen.lineWidth = 1;
  pen.strokeRect(box.left + 0.5, box.top + 0.5, box.width - 1, box.height - 1);
  pen.restore();
}

/**
 * Hatch a box with lines, inside the clip path that is set; phases agree everywhere.
 * @param {Pen} pen
 * @param {Box} box
 * @param {{ colour: string, every?: number, width?: number, kind?: PatternKind }} style
 */
export function hatchBox(pen, box, { colour, every = 7, width = 1, kind = 'rising' }) {
  const { left, top } = box;
  const [right, bottom] = [left + box.width, top + box.height];
  pen.save();
  pen.beginPath();
  pen.rect(left, top, box.width, box.height);
  pen.clip();
  pen.beginPath();
  /** @type {(first: number, last: number, line: (at: number) => number[]) => void} */
  const lines = (first, last, line) => {
    for (let k = Math.floor(first / every); k <= Math.ceil(last / every); k++) {
      const [x0, y0, x1, y1] = line(k * every);
      pen.moveTo(x0, y0);
      pen.lineTo(x1, y1);
    }
  };
  // Rising lines have x + y = k * every, falling ones x - y.
  if (kind === 'rising' || kind === 'crossed') {
    lines(left + top, right + bottom, (at) => [at - top, top, at - bottom, bottom]);
  }
  if (kind === 'falling' || kind === 'crossed') {
    lines(left - bottom, right - top, (at) => [at + top, top, at + bottom, bottom]);
  }
  if (kind === 'level') lines(top, bottom, (at) => [left, at + 0.5, right, at + 0.5]);
  if (kind === 'upright') lines(left, right, (at) => [at + 0.5, top, at + 0.5, bottom]);
  pen.setLineDash([]);
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
  pen.restore();
}

/**
 * @param {Pen} pen
 * @param {string} colour
 * @param {number} every
 * @param {number} size
 * @param {Box} box
 */
function dotBox(pen, colour, every, size, box) {
  const [right, bottom] = [box.left + box.width, box.top + box.height], side = size * Math.sqrt(Math.PI);
  pen.save();
  pen.beginPath();
  pen.rect(box.left, box.top, box.width, box.height);
  pen.clip();
  pen.beginPath();
  for (let k = Math.floor(box.top / every - 0.5); (k + 0.5) * every < bottom + size; k++) {
    for (let j = Math.floor(box.left / every - 0.5); (j + 0.5) * every < right + size; j++) {
      // A square as large as the dot, of which thousands take no time.
      pen.rect((j + 0.5) * every - side / 2, (k + 0.5) * every - side / 2, side, side);
    }
  }
  pen.fillStyle = colour;
  pen.fill();
  pen.restore();
}

// ------------------------------------------------------------------------------------ raster

/**
 * Tiles of pixels, one for each look by its number, all of one size.
 * @typedef {{ size: number, pixels: Uint32Array[] }} ClassTiles
 */

const TILE = 24; // [px] a multiple of all periods

/**
 * Return the pixels of looks: red, green, blue and alpha in the order of an ImageData.
 * @param {Look[]} looks
 * @param {number} [ratio]  device pixels in a pixel
 * @returns {ClassTiles}
 */
export function lookTiles(looks, ratio = 1) {
  const whole = Math.max(1, Math.round(ratio));
  const size = TILE * whole;
  const pixels = looks.map((look) => {
    const [fill, mark] = [rgbOf(look.fill), rgbOf(look.mark ?? look.fill)];
    const tile = new Uint32Array(size * size).fill(wordOf(fill));
    for (let at = 0; look.kind && at < tile.length; at++) {
      const x = ((at % size) + 0.5) / whole, y = (Math.floor(at / size) + 0.5) / whole;
      const share = markShare(look, x, y, 1 / whole);
      if (share > 0) tile[at] = mixedPixel(fill, mark, share);
    }
    return tile;
  });
  return { size, pixels };
}

/**
 * Return the part of a pixel that a pattern covers.
 * @param {Look} look
 * @param {number} x  centre of the pixel [px]
 * @param {number} y
 * @param {number} pixel  its size [px]
 */
function markShare({ kind, every = 6, size = 1 }, x, y, pixel) {
  /** @type {(far: number) => number} */
  const covered = (far) => Math.min(1, Math.max(0, 0.5 - far / pixel));
  /** @type {(along: number) => number} */
  const offset = (along) => along - every * Math.round(along / every);
  if (kind === 'dots') {
    return covered(Math.hypot(offset(x - every / 2), offset(y - every / 2)) - size);
  }
  const line = (/** @type {number} */ far) => covered(Math.abs(far) - size / 2);
  if (kind === 'level') return line(offset(y - 0.5));
  if (kind === 'upright') return line(offset(x - 0.5));
  const rising = line(offset(x + y) * Math.SQRT1_2), falling = line(offset(x - y) * Math.SQRT1_2);
  return kind === 'rising' ? rising : kind === 'falling' ? falling : Math.max(rising, falling);
}

/**
 * @param {number[]} fill
 * @param {number[]} mark
 * @param {number} share
 */
function mixedPixel(fill, mark, share) {
  return wordOf(fill.map((part, k) => Math.round(part + share * (mark[k] - part))));
}

/** Return a pixel of an ImageData. @param {number[]} rgb */
function wordOf([r, g, b]) {
  return (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
}
