// Fills of the classes of motion: on a raster, and on any area or swatch of a legend.

/** @typedef {import('./svg.mjs').Pen} Pen */
/** @typedef {import('./theme.mjs').Theme} Theme */
/** @typedef {{ left: number, top: number, width: number, height: number }} Box */

/**
 * The class of a cell, numbered as in the package's plots (`CellClass`).
 * @typedef {'rest' | 'symmetric' | 'unsymmetric' | 'subharmonic' | 'aperiodic' | 'rocking'
 *   | 'overturned' | 'undecided' | 'no-start' | 'not-computed'} MotionClass
 */

/** @type {readonly MotionClass[]} */
export const MOTION_CLASSES = ['rest', 'symmetric', 'unsymmetric', 'subharmonic', 'aperiodic',
  'rocking', 'overturned', 'undecided', 'no-start', 'not-computed'];

/** @type {Readonly<Record<MotionClass, string>>} */
export const CLASS_WORDS = { rest: 'at rest', symmetric: 'symmetric', unsymmetric: 'unsymmetric',
  subharmonic: 'subharmonic', aperiodic: 'aperiodic', rocking: 'still rocking',
  overturned: 'overturned', undecided: 'undecided', 'no-start': 'no such start',
  'not-computed': 'not computed' };

/**
 * Lines at 45 degrees (`rising`, `falling`) or dots on a square lattice, period `every` [px].
 * @typedef {{ kind: 'plain' | 'rising' | 'falling' | 'crossed' | 'dots', every: number,
 *   size: number, mark: 'light' | 'dark' | 'faint' }} ClassPattern
 */

/** @type {ClassPattern} */
const PLAIN = { kind: 'plain', every: 1, size: 0, mark: 'dark' };

/** @type {Readonly<Record<MotionClass, ClassPattern>>} */
const PATTERNS = {
  rest: PLAIN,
  symmetric: PLAIN,
  unsymmetric: PLAIN,
  subharmonic: { kind: 'dots', every: 8, size: 1.1, mark: 'light' },
  aperiodic: { kind: 'dots', every: 4, size: 0.55, mark: 'light' },
  rocking: PLAIN,
  overturned: { kind: 'rising', every: 6, size: 1, mark: 'dark' },
  undecided: { kind: 'crossed', every: 8, size: 1, mark: 'dark' },
  'no-start': { kind: 'falling', every: 8, size: 0.8, mark: 'faint' },
  'not-computed': { kind: 'rising', every: 8, size: 0.8, mark: 'faint' },
};

/**
 * Return the fill of a class; what is not a motion has that of the paper.
 * @param {Theme} theme
 * @param {MotionClass} name
 * @returns {string}
 */
export function classFill(theme, name) {
  return name === 'no-start' || name === 'not-computed' ? theme.paper : theme.fills[name];
}

/**
 * @param {Theme} theme
 * @param {MotionClass} name
 */
function classMark(theme, name) {
  const { mark } = PATTERNS[name];
  return mark === 'faint' ? theme.faint : theme.marks[mark];
}

/**
 * Fill a box with a class and its pattern; set a clip path before for any other shape.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {MotionClass} name
 * @param {Box} box
 */
export function fillClass(pen, theme, name, box) {
  const pattern = PATTERNS[name];
  pen.save();
  pen.fillStyle = classFill(theme, name);
  pen.fillRect(box.left, box.top, box.width, box.height);
  if (pattern.kind === 'dots') dotBox(pen, classMark(theme, name), pattern, box);
  else if (pattern.kind !== 'plain') {
    const { every, size } = pattern;
    const style = { colour: classMark(theme, name), every, width: size };
    if (pattern.kind !== 'falling') hatchBox(pen, box, style);
    if (pattern.kind !== 'rising') hatchBox(pen, box, { ...style, falling: true });
  }
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
  fillClass(pen, theme, name, box);
  pen.save();
  pen.strokeStyle = theme.faint;
  pen.lineWidth = 1;
  pen.strokeRect(box.left + 0.5, box.top + 0.5, box.width - 1, box.height - 1);
  pen.restore();
}

/**
 * Hatch a box with lines at 45 degrees, inside the clip path that is set; phases agree everywhere.
 * @param {Pen} pen
 * @param {Box} box
 * @param {{ colour: string, every?: number, width?: number, falling?: boolean }} style
 */
export function hatchBox(pen, box, { colour, every = 7, width = 1, falling = false }) {
  const { left, top, height } = box;
  const [right, bottom] = [left + box.width, top + height];
  pen.save();
  pen.beginPath();
  pen.rect(left, top, box.width, height);
  pen.clip();
  pen.beginPath();
  // Rising lines have x + y = k * every, falling ones x - y.
  const first = falling ? left - bottom : left + top;
  const last = falling ? right - top : right + bottom;
  for (let k = Math.floor(first / every); k <= Math.ceil(last / every); k++) {
    const at = k * every;
    pen.moveTo(falling ? at + top : at - top, top);
    pen.lineTo(falling ? at + bottom : at - bottom, bottom);
  }
  pen.setLineDash([]);
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
  pen.restore();
}

/**
 * @param {Pen} pen
 * @param {string} colour
 * @param {ClassPattern} pattern
 * @param {Box} box
 */
function dotBox(pen, colour, { every, size }, box) {
  const [right, bottom] = [box.left + box.width, box.top + box.height];
  pen.save();
  pen.beginPath();
  pen.rect(box.left, box.top, box.width, box.height);
  pen.clip();
  pen.beginPath();
  for (let k = Math.floor(box.top / every - 0.5); (k + 0.5) * every < bottom + size; k++) {
    for (let j = Math.floor(box.left / every - 0.5); (j + 0.5) * every < right + size; j++) {
      const [x, y] = [(j + 0.5) * every, (k + 0.5) * every];
      pen.moveTo(x + size, y);
      pen.arc(x, y, size, 0, 2 * Math.PI);
    }
  }
  pen.fillStyle = colour;
  pen.fill();
  pen.restore();
}

// ------------------------------------------------------------------------------------ raster

/**
 * Tiles of pixels, one for each class by its number, all of one size.
 * @typedef {{ size: number, pixels: Uint32Array[] }} ClassTiles
 */

const TILE = 24; // [px] a multiple of all periods

/**
 * Return the pixels of all classes: red, green, blue and alpha in the order of an ImageData.
 * @param {Theme} theme
 * @param {number} [ratio]  device pixels in a pixel
 * @returns {ClassTiles}
 */
export function classTiles(theme, ratio = 1) {
  const whole = Math.max(1, Math.round(ratio));
  const size = TILE * whole;
  const pixels = MOTION_CLASSES.map((name) => {
    const [fill, mark] = [rgbOf(classFill(theme, name)), rgbOf(classMark(theme, name))];
    const tile = new Uint32Array(size * size);
    for (let y = 0; y < size; y++) {
      for (let x = 0; x < size; x++) {
        const share = markShare(PATTERNS[name], (x + 0.5) / whole, (y + 0.5) / whole, 1 / whole);
        tile[y * size + x] = mixedPixel(fill, mark, share);
      }
    }
    return tile;
  });
  return { size, pixels };
}

/**
 * Paint cells over a whole image; row 0 is the lowest, a number out of range is not computed.
 * @param {{ data: Uint8ClampedArray, width: number, height: number }} image
 * @param {ArrayLike<number>} classes  numbers in MOTION_CLASSES, row after row
 * @param {number} columns
 * @param {number} rows
 * @param {ClassTiles} tiles
 */
export function paintCells(image, classes, columns, rows, { size, pixels }) {
  const { data, width, height } = image;
  const words = new Uint32Array(data.buffer, data.byteOffset, width * height);
  const column = new Uint32Array(width);
  for (let x = 0; x < width; x++) column[x] = Math.floor(((x + 0.5) * columns) / width);
  const blank = pixels[pixels.length - 1];
  for (let y = 0; y < height; y++) {
    const row = rows - 1 - Math.floor(((y + 0.5) * rows) / height);
    const line = (y % size) * size;
    for (let x = 0; x < width; x++) {
      const tile = pixels[classes[row * columns + column[x]]] ?? blank;
      words[y * width + x] = tile[line + (x % size)];
    }
  }
}

/**
 * Return the part of a pixel that a pattern covers.
 * @param {ClassPattern} pattern
 * @param {number} x  centre of the pixel [px]
 * @param {number} y
 * @param {number} pixel  its size [px]
 */
function markShare({ kind, every, size }, x, y, pixel) {
  if (kind === 'plain') return 0;
  /** @type {(far: number) => number} */
  const covered = (far) => Math.min(1, Math.max(0, 0.5 - far / pixel));
  /** @type {(along: number) => number} */
  const offset = (along) => along - every * Math.round(along / every);
  if (kind === 'dots') {
    return covered(Math.hypot(offset(x - every / 2), offset(y - every / 2)) - size);
  }
  const rising = covered(Math.abs(offset(x + y)) * Math.SQRT1_2 - size / 2);
  const falling = covered(Math.abs(offset(x - y)) * Math.SQRT1_2 - size / 2);
  return kind === 'rising' ? rising : kind === 'falling' ? falling : Math.max(rising, falling);
}

/** Return red, green and blue. @param {string} colour  as #rrggbb */
export function rgbOf(colour) {
  return [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
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
export function wordOf([r, g, b]) {
  return (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
}
