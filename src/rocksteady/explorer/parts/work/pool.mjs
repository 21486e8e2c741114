// Workers that run jobs: the most urgent first; of one key only the newest counts.

/** @typedef {{ ask: (job: string, args: unknown, how?: { key?: string, priority?: number }) => Promise<any>, drop: (prefix: string) => void, size: number, waiting: (prefix: string) => number }} Pool */

/**
 * @typedef {object} Asked
 * @property {number} id
 * @property {string} job
 * @property {unknown} args
 * @property {string} key
 * @property {number} priority
 * @property {(result: any) => void} resolve
 * @property {(error: Error) => void} reject
 */

/**
 * A worker, the job that it runs, and what ends it when that runs away.
 * @typedef {{ worker: Worker, asked: Asked | null, timer: number, answered: boolean }} Hand
 */

const LONGEST_JOB = 30; // seconds
const LONGEST_DROPPED = 2; // seconds that a job goes on when nobody waits for it
const TOO_LONG = `undecided, since it took longer than ${LONGEST_JOB} s`;

/**
 * Return a pool; a dropped request resolves to undefined.  A job that runs away is ended with its
 * worker, and another worker takes the place.
 * @param {WebAssembly.Module} module
 * @param {string} program  text of this script, which the workers run too
 * @param {(name: string, args: unknown) => unknown} here  runs a job where there are no workers
 * @returns {Pool}
 */
export function makePool(module, program, here) {
  const url = URL.createObjectURL(new Blob([program], { type: 'text/javascript' }));
  /** @type {Set<Hand>} */
  const hands = new Set();
  /** @type {Hand[]} */
  let idle = [];
  /** @type {Asked[]} */
  let queue = [];
  let count = 0;
  let turn = 0; // the timer of the next job on the page's own thread
  let told = false;

  const running = () => [...hands].flatMap(({ asked }) => asked ?? []);
  /** @param {Asked} asked @param {any} result @param {string} [fault] */
  const finish = (asked, result, fault) => {
    if (fault === undefined) asked.resolve(result);
    else asked.reject(new Error(fault));
  };
  const next = () => {
    while (queue.length && idle.length) {
      const asked = takenOf(queue);
      const hand = /** @type {Hand} */ (idle.pop());
      hand.asked = asked;
      watch(hand, LONGEST_JOB);
      hand.worker.postMessage({ id: asked.id, job: asked.job, args: asked.args });
    }
    if (!hands.size && queue.length) turn ||= Number(setTimeout(nextHere));
  };
  const nextHere = () => { // one a turn, so that the page answers in between
    turn = 0;
    if (!queue.length) return;
    if (!told) console.warn('no worker starts here: jobs run on the thread of the page');
    told = true;
    const asked = takenOf(queue);
    try {
      finish(asked, here(asked.job, asked.args));
    } catch (error) {
      finish(asked, undefined, String(error));
    }
    next();
  };
  /** @param {Hand} hand @param {number} seconds */
  const watch = (hand, seconds) => {
    clearTimeout(hand.timer);
    hand.timer = Number(setTimeout(() => {
      const { asked } = hand;
      end(hand);
      hire();
      if (asked) finish(asked, undefined, TOO_LONG);
      next();
    }, 1000 * seconds));
  };
  /** @param {Hand} hand */
  const end = (hand) => {
    clearTimeout(hand.timer);
    hand.worker.terminate();
    hand.asked = null;
    hands.delete(hand);
    idle = idle.filter((other) => other !== hand);
  };
  const hire = () => {
    const worker = new Worker(url);
    /** @type {Hand} */
    const hand = { worker, asked: null, timer: 0, answered: false };
    worker.onmessage = ({ data }) => {
      clearTimeout(hand.timer);
      const { asked } = hand;
      Object.assign(hand, { asked: null, answered: true });
      idle.push(hand);
      if (asked) finish(asked, data.result, data.fault);
      next();
    };
    worker.onerror = (event) => {
      event.preventDefault();
      const { asked, answered } = hand;
      end(hand);
      if (answered) hire(); // else the browser does not let it start
      if (asked && answered) finish(asked, undefined, event.message);
      else if (asked) queue.push(asked);
      next();
    };
    worker.postMessage({ module });
    hands.add(hand);
    idle.push(hand);
  };
  /** @param {(asked: Asked) => boolean} unwanted */
  const forget = (unwanted) => {
    const dropped = queue.filter(unwanted);
    if (dropped.length) queue = queue.filter((asked) => !unwanted(asked));
    for (const hand of hands) {
      if (!hand.asked || !unwanted(hand.asked)) continue;
      dropped.push(hand.asked);
      hand.asked = null;
      watch(hand, LONGEST_DROPPED);
    }
    for (const asked of dropped) finish(asked, undefined);
  };
  try {
    const wanted = Math.min(8, Math.max(2, navigator.hardwareConcurrency || 2));
    while (hands.size < wanted) hire();
  } catch {
    // A frame that allows none: jobs run in turn on the page's own thread.
  }
  return {
    size: Math.max(1, hands.size),
    ask(job, args, { key = '', priority = 0 } = {}) {
      if (key) forget((asked) => asked.key === key);
      return new Promise((resolve, reject) => {
        queue.push({ id: ++count, job, args, key, priority, resolve, reject });
        next();
      });
    },
    drop: (prefix) => forget((asked) => asked.key.startsWith(prefix)),
    waiting: (prefix) =>
      [...queue, ...running()].filter((asked) => asked.key.startsWith(prefix)).length,
  };
}

/** Take the most urgent request out of a queue. @param {Asked[]} queue */
function takenOf(queue) {
  let best = 0;
  for (let k = 1; k < queue.length; k++) if (queue[k].priority < queue[best].priority) best = k;
  return queue.splice(best, 1)[0];
}
