// Workers that run jobs: the most urgent first; of one key only the newest counts.

/** @typedef {{ ask: (job: string, args: unknown, how?: { key?: string, priority?: number, ahead?: boolean }) => Promise<any>, drop: (prefix: string) => void, size: number, waiting: (prefix: string) => number }} Pool */

/**
 * @typedef {object} Asked
 * @property {number} id
 * @property {string} job
 * @property {unknown} args
 * @property {string} key
 * @property {number} priority
 * @property {boolean} ahead  whether a worker may have it before it is through with one like it
 * @property {(result: any) => void} resolve
 * @property {(error: Error) => void} reject
 */

/**
 * A worker, its jobs (that which it runs first, null where nobody waits for it), and what ends it
 * when that runs away.
 * @typedef {{ worker: Worker, sent: (Asked | null)[], timer: number, answered: boolean }} Hand
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

  const running = () => [...hands].flatMap(({ sent }) => sent.flatMap((asked) => asked ?? []));
  /** @param {Asked} asked @param {any} result @param {string} [fault] */
  const finish = (asked, result, fault) => {
    if (fault === undefined) asked.resolve(result);
    else asked.reject(new Error(fault));
  };
  const next = () => {
    while (queue.length && idle.length) {
      const asked = takenOf(queue);
      const hand = /** @type {Hand} */ (idle.pop());
      watch(hand, LONGEST_JOB);
      send(hand, asked);
    }
    // While the page draws, no worker should wait for its next job.
    for (const hand of hands) {
      const one = hand.sent.length === 1 && hand.sent[0]?.ahead;
      if (one && queue[mostUrgent(queue)]?.ahead) send(hand, takenOf(queue));
    }
    if (!hands.size && queue.length) turn ||= Number(setTimeout(nextHere));
  };
  /** @param {Hand} hand @param {Asked} asked */
  const send = (hand, asked) => {
    hand.sent.push(asked);
    hand.worker.postMessage({ id: asked.id, job: asked.job, args: asked.args });
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
      const [asked, ...others] = hand.sent;
      end(hand);
      hire();
      if (asked) finish(asked, undefined, TOO_LONG);
      queue.push(...others.flatMap((other) => other ?? []));
      next();
    }, 1000 * seconds));
  };
  /** @param {Hand} hand */
  const end = (hand) => {
    clearTimeout(hand.timer);
    hand.worker.terminate();
    hands.delete(hand);
    idle = idle.filter((other) => other !== hand);
  };
  const hire = () => {
    const worker = new Worker(url);
    /** @type {Hand} */
    const hand = { worker, sent: [], timer: 0, answered: false };
    worker.onmessage = ({ data }) => {
      clearTimeout(hand.timer);
      const asked = hand.sent.shift();
      hand.answered = true;
      if (hand.sent.length) watch(hand, hand.sent[0] ? LONGEST_JOB : LONGEST_DROPPED);
      else idle.push(hand);
      if (asked) finish(asked, data.result, data.fault);
      next();
    };
    worker.onerror = (event) => {
      event.preventDefault();
      const { answered } = hand, [asked, ...others] = hand.sent;
      end(hand);
      if (answered) hire(); // else the browser does not let it start
      if (asked && answered) finish(asked, undefined, event.message);
      else if (asked) queue.push(asked);
      queue.push(...others.flatMap((other) => other ?? []));
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
      hand.sent.forEach((asked, k) => {
        if (!asked || !unwanted(asked)) return;
        dropped.push(asked);
        hand.sent[k] = null;
        if (!k) watch(hand, LONGEST_DROPPED);
      });
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
    ask(job, args, { key = '', priority = 0, ahead = false } = {}) {
      if (key) forget((asked) => asked.key === key);
      return new Promise((resolve, reject) => {
        queue.push({ id: ++count, job, args, key, priority, ahead, resolve, reject });
        next();
      });
    },
    drop: (prefix) => forget((asked) => asked.key.startsWith(prefix)),
    waiting: (prefix) =>
      [...queue, ...running()].filter((asked) => asked.key.startsWith(prefix)).length,
  };
}

/** Return the place of the most urgent request in a queue. @param {Asked[]} queue */
function mostUrgent(queue) {
  let best = 0;
  for (let k = 1; k < queue.length; k++) if (queue[k].priority < queue[best].priority) best = k;
  return best;
}

/** Take the most urgent request out of a queue. @param {Asked[]} queue */
function takenOf(queue) {
  return queue.splice(mostUrgent(queue), 1)[0];
}
