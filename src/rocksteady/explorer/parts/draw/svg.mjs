// A pen that writes SVG: what panels use of CanvasRenderingContext2D, and no more.

/**
 * What both pens can do.
 * @typedef {Pick<CanvasRenderingContext2D, 'fillStyle' | 'strokeStyle' | 'lineWidth' | 'lineCap'
 *   | 'lineJoin' | 'globalAlpha' | 'font' | 'textAlign' | 'textBaseline' | 'imageSmoothingEnabled'
 *   | 'setLineDash' | 'save' | 'restore' | 'translate' | 'rotate' | 'scale' | 'beginPath'
 *   | 'moveTo' | 'lineTo' | 'quadraticCurveTo' | 'bezierCurveTo' | 'arc' | 'rect' | 'closePath'
 *   | 'clip' | 'fill' | 'stroke' | 'fillRect' | 'strokeRect' | 'fillText' | 'strokeText'
 *   | 'measureText' | 'drawImage'>} Pen
 */

/** @typedef {{ font: string, measureText(text: string): TextMetrics }} Ruler */
/** @typedef {[number, number, number, number, number, number]} Matrix  a b c d e f of SVG */

const STATE = /** @type {const} */ (['fillStyle', 'strokeStyle', 'lineWidth', 'lineCap', 'lineJoin',
  'globalAlpha', 'font', 'textAlign', 'textBaseline', 'imageSmoothingEnabled', 'matrix', 'dash',
  'clipId']);
const FARTHEST = 1e6; // pixels: beyond, readers of SVG lose digits
// Of an em, down from the baseline of the text.
const BASELINES = { alphabetic: 0, ideographic: -0.12, bottom: -0.21, middle: 0.35, hanging: 0.8,
  top: 0.87 };
const ANCHORS = { left: 'start', start: 'start', center: 'middle', right: 'end', end: 'end' };

/**
 * Return text as XML takes it: escaped, and without the characters that XML forbids.
 * @param {unknown} text
 * @returns {string}
 */
export function escapedXml(text) {
  return String(text)
    .replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, '')
    .replace(/[\ud800-\udbff](?![\udc00-\udfff])|(?<![\ud800-\udbff])[\udc00-\udfff]/g, '\ufffd')
    .replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;');
}

/**
 * Return the width of text without a canvas, in pixels, from the usual widths of letters.
 * @param {string} text
 * @param {number} size  of the font [px]
 */
function estimatedWidth(text, size) {
  let ems = 0;
  for (const letter of text) {
    ems += /[iIjlt.,:;|'!()[\] f]/.test(letter) ? 0.32 : /[mwMW@%]/.test(letter) ? 0.88 : 0.57;
  }
  return ems * size;
}

export class SvgPen {
  /**
   * @param {number} width  [px]
   * @param {number} height  [px]
   * @param {{ title?: string, description?: string, ruler?: Ruler, prefix?: string }} [options]
   *   `ruler` measures text, as a canvas does; `prefix` of the ids inside
   */
  constructor(width, height, { title = '', description = '', ruler, prefix = 'rs' } = {}) {
    this.width = width;
    this.height = height;
    this.title = title;
    this.description = description;
    this.ruler = ruler;
    this.prefix = prefix;
    /** @type {string | CanvasGradient | CanvasPattern} */
    this.fillStyle = '#000000';
    /** @type {string | CanvasGradient | CanvasPattern} */
    this.strokeStyle = '#000000';
    this.lineWidth = 1;
    /** @type {CanvasLineCap} */
    this.lineCap = 'butt';
    /** @type {CanvasLineJoin} */
    this.lineJoin = 'miter';
    this.globalAlpha = 1;
    this.font = '10px sans-serif';
    /** @type {CanvasTextAlign} */
    this.textAlign = 'start';
    /** @type {CanvasTextBaseline} */
    this.textBaseline = 'alphabetic';
    this.imageSmoothingEnabled = true;
    /** @type {Matrix} */
    this.matrix = [1, 0, 0, 1, 0, 0];
    /** @type {number[]} */
    this.dash = [];
    this.clipId = '';
    /** @type {object[]} */
    this.saved = [];
    /** @type {string[]} */
    this.path = [];
    /** @type {string[]} */
    this.definitions = [];
    /** @type {string[]} */
    this.elements = [];
    this.openClip = '';
  }

  save() {
    this.saved.push(Object.fromEntries(STATE.map((name) => [name, this[name]])));
  }

  restore() {
    Object.assign(this, this.saved.pop());
  }

  /** @param {Iterable<number>} dash */
  setLineDash(dash) {
    this.dash = [...dash];
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  translate(x, y) {
    this.apply([1, 0, 0, 1, x, y]);
  }

  /** @param {number} angle */
  rotate(angle) {
    const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
    this.apply([cosine, sine, -sine, cosine, 0, 0]);
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  scale(x, y) {
    this.apply([x, 0, 0, y, 0, 0]);
  }

  beginPath() {
    this.path = [];
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  moveTo(x, y) {
    this.add('M', x, y);
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  lineTo(x, y) {
    this.add(this.path.length ? 'L' : 'M', x, y);
  }

  /**
   * @param {number} x1
   * @param {number} y1
   * @param {number} x
   * @param {number} y
   */
  quadraticCurveTo(x1, y1, x, y) {
    if (!this.path.length) this.add('M', x1, y1);
    this.add('Q', x1, y1, x, y);
  }

  /**
   * @param {number} x1
   * @param {number} y1
   * @param {number} x2
   * @param {number} y2
   * @param {number} x
   * @param {number} y
   */
  bezierCurveTo(x1, y1, x2, y2, x, y) {
    if (!this.path.length) this.add('M', x1, y1);
    this.add('C', x1, y1, x2, y2, x, y);
  }

  /**
   * Add an arc of a circle, as Bezier curves of at most a quarter each.
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   * @param {number} from  [rad]
   * @param {number} to  [rad]
   * @param {boolean} [backward]
   */
  arc(x, y, radius, from, to, backward = false) {
    const full = 2 * Math.PI;
    let turn = backward ? from - to : to - from;
    if (turn >= full) turn = full;
    else if (turn < 0) turn -= full * Math.floor(turn / full);
    if (backward) turn = -turn;
    const parts = Math.max(1, Math.ceil(Math.abs(turn) / (Math.PI / 2) - 1e-9));
    const handle = (4 / 3) * Math.tan(turn / parts / 4) * radius;
    this.lineTo(x + radius * Math.cos(from), y + radius * Math.sin(from));
    for (let k = 0; k < parts; k++) {
      const [a, b] = [from + (turn * k) / parts, from + (turn * (k + 1)) / parts];
      const [sa, ca, sb, cb] = [Math.sin(a), Math.cos(a), Math.sin(b), Math.cos(b)];
      this.add('C', x + radius * ca - handle * sa, y + radius * sa + handle * ca,
        x + radius * cb + handle * sb, y + radius * sb - handle * cb,
        x + radius * cb, y + radius * sb);
    }
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} width
   * @param {number} height
   */
  rect(x, y, width, height) {
    this.path.push(this.rectangle(x, y, width, height));
  }

  closePath() {
    if (this.path.length) this.path.push('Z');
  }

  clip() {
    const id = `${this.prefix}c${this.definitions.length}`;
    const inside = this.clipId ? ` clip-path="url(#${this.clipId})"` : '';
    const outline = `<path d="${this.path.join('')}"/>`;
    this.definitions.push(`<clipPath id="${id}"${inside}>${outline}</clipPath>`);
    this.clipId = id;
  }

  /** @param {unknown} [rule]  'evenodd', or nothing */
  fill(rule) {
    const how = rule === 'evenodd' ? ' fill-rule="evenodd"' : '';
    if (this.path.length) this.emit(`<path d="${this.path.join('')}"${how}${this.filled()}/>`);
  }

  stroke() {
    if (!this.path.length) return;
    this.emit(`<path d="${this.path.join('')}" fill="none"${this.stroked()}/>`);
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} width
   * @param {number} height
   */
  fillRect(x, y, width, height) {
    this.emit(`<path d="${this.rectangle(x, y, width, height)}"${this.filled()}/>`);
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} width
   * @param {number} height
   */
  strokeRect(x, y, width, height) {
    this.emit(`<path d="${this.rectangle(x, y, width, height)}" fill="none"${this.stroked()}/>`);
  }

  /**
   * @param {string} text
   * @param {number} x
   * @param {number} y
   */
  fillText(text, x, y) {
    this.write(text, x, y, this.filled());
  }

  /**
   * @param {string} text
   * @param {number} x
   * @param {number} y
   */
  strokeText(text, x, y) {
    this.write(text, x, y, ` fill="none"${this.stroked()}`);
  }

  /**
   * @param {string} text
   * @returns {TextMetrics}
   */
  measureText(text) {
    if (this.ruler) {
      this.ruler.font = this.font;
      return this.ruler.measureText(text);
    }
    const width = estimatedWidth(text, this.fontSize());
    return /** @type {TextMetrics} */ ({ width });
  }

  /**
   * Draw a canvas, or a part of it, as `drawImage` does with 3, 5 or 9 arguments.
   * @param {CanvasImageSource} image  a canvas
   * @param {...number} places
   */
  drawImage(image, ...places) {
    const canvas = /** @type {HTMLCanvasElement} */ (image);
    const whole = [0, 0, canvas.width, canvas.height];
    const [sx, sy, sw, sh] = places.length === 8 ? places : whole;
    const [dx, dy, dw = sw, dh = sh] = places.length === 8 ? places.slice(4) : places;
    const part = sx !== 0 || sy !== 0 || sw !== canvas.width || sh !== canvas.height;
    this.save();
    if (part) {
      const path = this.path;
      this.path = [this.rectangle(dx, dy, dw, dh)];
      this.clip();
      this.path = path;
    }
    this.apply([dw / sw, 0, 0, dh / sh, dx - (sx * dw) / sw, dy - (sy * dh) / sh]);
    const sharp = this.imageSmoothingEnabled ? '' : ' style="image-rendering:pixelated"';
    this.emit(`<image width="${canvas.width}" height="${canvas.height}"${this.turned()}${sharp}`
      + ` preserveAspectRatio="none"${this.faded('opacity')}`
      + ` href="${canvas.toDataURL('image/png')}"/>`);
    this.restore();
  }

  /** Return the whole as one file. */
  toString() {
    const [width, height] = [svgNumber(this.width), svgNumber(this.height)];
    const head = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" `
      + `viewBox="0 0 ${width} ${height}" role="img">`;
    const title = this.title ? `<title>${escapedXml(this.title)}</title>` : '';
    const description = this.description ? `<desc>${escapedXml(this.description)}</desc>` : '';
    const definitions = this.definitions.length ? `<defs>${this.definitions.join('')}</defs>` : '';
    const end = this.openClip ? '</g>' : '';
    return `<?xml version="1.0" encoding="UTF-8"?>\n${head}${title}${description}${definitions}\n`
      + `${this.elements.join('\n')}${end}\n</svg>\n`;
  }

  // ------------------------------------------------------------------ parts of the above

  /** @param {Matrix} by */
  apply([a, b, c, d, e, f]) {
    const [A, B, C, D, E, F] = this.matrix;
    this.matrix = [A * a + C * b, B * a + D * b, A * c + C * d, B * c + D * d,
      A * e + C * f + E, B * e + D * f + F];
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  at(x, y) {
    const [a, b, c, d, e, f] = this.matrix;
    return `${svgNumber(a * x + c * y + e)} ${svgNumber(b * x + d * y + f)}`;
  }

  /**
   * Add a command to the path, unless a coordinate is no number: as a canvas does.
   * @param {string} command
   * @param {...number} places
   */
  add(command, ...places) {
    if (!places.every(Number.isFinite)) return;
    const points = [];
    for (let k = 0; k < places.length; k += 2) points.push(this.at(places[k], places[k + 1]));
    this.path.push(command + points.join(' '));
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} width
   * @param {number} height
   */
  rectangle(x, y, width, height) {
    if (![x, y, width, height].every(Number.isFinite)) return '';
    return `M${this.at(x, y)}L${this.at(x + width, y)} ${this.at(x + width, y + height)} `
      + `${this.at(x, y + height)}Z`;
  }

  /**
   * Write an element into the group of its clip path.
   * @param {string} element
   */
  emit(element) {
    if (this.clipId !== this.openClip) {
      const close = this.openClip ? '</g>' : '';
      const open = this.clipId ? `<g clip-path="url(#${this.clipId})">` : '';
      this.elements.push(close + open);
      this.openClip = this.clipId;
    }
    this.elements.push(element);
  }

  /** @param {string} name */
  faded(name) {
    return this.globalAlpha < 1 ? ` ${name}="${svgNumber(this.globalAlpha)}"` : '';
  }

  filled() {
    return ` fill="${escapedXml(this.fillStyle)}"${this.faded('fill-opacity')}`;
  }

  stroked() {
    const [a, b, c, d] = this.matrix;
    const size = Math.sqrt(Math.abs(a * d - b * c));
    const dash = this.dash.some((part) => part > 0)
      ? ` stroke-dasharray="${this.dash.map((part) => svgNumber(part * size)).join(' ')}"` : '';
    const cap = this.lineCap === 'butt' ? '' : ` stroke-linecap="${this.lineCap}"`;
    const join = this.lineJoin === 'miter' ? '' : ` stroke-linejoin="${this.lineJoin}"`;
    const width = svgNumber(this.lineWidth * size);
    return ` stroke="${escapedXml(this.strokeStyle)}" stroke-width="${width}"`
      + `${dash}${cap}${join}${this.faded('stroke-opacity')}`;
  }

  turned() {
    return ` transform="matrix(${this.matrix.map((part) => svgNumber(part, 1e6)).join(' ')})"`;
  }

  fontSize() {
    return Number(/([\d.]+)px/.exec(this.font)?.[1] ?? 10);
  }

  /**
   * @param {string} text
   * @param {number} x
   * @param {number} y
   * @param {string} colours
   */
  write(text, x, y, colours) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    const size = this.fontSize();
    const weight = /\b(bold|[1-9]00)\b/.exec(this.font.split('px')[0]);
    const style = /\bitalic\b/.test(this.font) ? ' font-style="italic"' : '';
    const family = escapedXml(this.font.split('px')[1]?.trim() || 'sans-serif');
    const [a, b, c, d] = this.matrix;
    const straight = a === 1 && b === 0 && c === 0 && d === 1;
    const down = y + BASELINES[this.textBaseline] * size;
    const [across, along] = straight ? this.at(x, down).split(' ')
      : [svgNumber(x), svgNumber(down)];
    this.emit(`<text x="${across}" y="${along}"${straight ? '' : this.turned()}`
      + ` text-anchor="${ANCHORS[this.textAlign]}" font-family="${family}" font-size="${size}"`
      + `${weight ? ` font-weight="${weight[1]}"` : ''}${style}${colours} xml:space="preserve">`
      + `${escapedXml(text)}</text>`);
  }
}

/**
 * @param {number} value
 * @param {number} [parts]  of a pixel
 */
function svgNumber(value, parts = 100) {
  const kept = Math.min(FARTHEST, Math.max(-FARTHEST, value));
  return String(Math.round(kept * parts) / parts || 0);
}
