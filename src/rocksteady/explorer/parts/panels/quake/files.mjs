// Files of ground motions: chosen or dropped, read in a worker, refused in one line.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { ReadResult } from '../../physics/quake/recordfile.mjs' */
import { RECORD_UNITS, plainName, refusedUnread } from '../../physics/quake/recordfile.mjs';
import { make } from '../../shell/layout.mjs';

const MOST_FILES = 40;

/**
 * Make the button that opens files, the place for their units, and the line about them.
 * @param {App} app
 * @param {Panel} panel
 * @param {() => void} listed  called when a motion has come
 */
export function makeFileOpener(app, panel, listed) {
  const input = /** @type {HTMLInputElement} */ (make('input', {
    type: 'file', multiple: '', class: 'unseen', tabindex: '-1', 'aria-label': 'record files',
    accept: '.csv,.txt,.dat,.at2,.AT2,text/plain,text/csv',
  }));
  const button = make('button', { type: 'button' }, 'Open a record…');
  const unit = /** @type {HTMLSelectElement} */ (make('select', { 'aria-label': 'unit of the accelerations' },
    make('option', { value: '' }, 'choose the unit'),
    ...Object.keys(RECORD_UNITS).map((name) => make('option', { value: name }, name))));
  const line = make('p', { class: 'files', role: 'status' });
  const hint = 'Or drop files here: two columns, time and acceleration, or PEER AT2.';
  line.textContent = hint;
  unit.hidden = true;
  panel.bar?.append(button, input, unit);
  panel.note?.after(line);
  /** @type {File[]} */
  let waiting = []; // for their unit

  button.addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    read([...(input.files ?? [])]);
    input.value = '';
  });
  unit.addEventListener('change', () => {
    if (!unit.value) return;
    const files = waiting;
    waiting = [];
    unit.hidden = true;
    read(files, unit.value);
  });
  // Anywhere on the page: a browser would leave it for the file.
  document.addEventListener('dragover', (event) => {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    panel.root?.classList.add('over');
  });
  document.addEventListener('dragleave', () => panel.root?.classList.remove('over'));
  document.addEventListener('drop', (event) => {
    panel.root?.classList.remove('over');
    const files = [...(event.dataTransfer?.files ?? [])];
    if (!files.length) return;
    event.preventDefault();
    if (app.state.tab !== 'quake') app.set({ tab: 'quake' });
    read(files);
  });

  /** @param {string} text @param {boolean} [refused] */
  const tell = (text, refused = false) => {
    line.textContent = text;
    line.classList.toggle('refused', refused);
  };

  /** @param {File[]} files @param {string} [given] */
  async function read(files, given = '') {
    const refused = files.slice(MOST_FILES).length ? [`Only the first ${MOST_FILES} files are read.`] : [];
    const doubts = [];
    let first = -1;
    for (const file of files.slice(0, MOST_FILES)) {
      tell(`Reading ${plainName(file.name)}.`);
      const found = await readFile(file, given);
      if ('motion' in found) {
        const { name, dt, samples, note, doubts: own } = found.motion;
        app.motions.push({ name, dt, acceleration: samples, note });
        if (first < 0) first = app.motions.length - 1;
        if (own.length) doubts.push(`${name}: ${own.join('; ')}.`);
      } else {
        refused.push(found.refused);
        if (found.asks === 'unit') waiting.push(file);
      }
    }
    unit.hidden = waiting.length === 0;
    unit.value = '';
    tell([...refused, ...doubts].join(' ') || hint, refused.length > 0);
    if (first < 0) return;
    listed();
    app.touch('motions');
    app.set({ record: first });
  }

  /** @param {File} file @param {string} given @returns {Promise<ReadResult>} */
  async function readFile(file, given) {
    const early = refusedUnread(file.name, file.size);
    if (early) return { refused: early };
    try {
      const bytes = new Uint8Array(await file.arrayBuffer());
      const asked = { name: file.name, bytes, unit: given };
      return await app.pool.ask('recordRead', asked, { priority: 1 });
    } catch (error) {
      return { refused: `${plainName(file.name)}: it cannot be read (${error}).` };
    }
  }
}
