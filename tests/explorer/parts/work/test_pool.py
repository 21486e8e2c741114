"""The pool of workers: what runs first, what is dropped, what an error does."""

from tests.explorer.in_node import InNode

LINES = """
const { makePool } = await import(parts('work/pool.mjs'));
const sent = [];
class Worker {
  constructor() { Worker.made.push(this); }
  postMessage(message) { if (message.job) sent.push([this, message]); }
  terminate() { ended.push(this); }
}
Worker.made = [];
const ended = [], clock = new Map();
let timers = 0;
const laterOnes = (seconds) => {
  for (const [timer, [done, wait]] of [...clock]) {
    if (wait <= 1000 * seconds && clock.delete(timer)) done();
  }
};
globalThis.setTimeout = (done, wait = 0) => (clock.set(++timers, [done, wait]), timers);
globalThis.clearTimeout = (timer) => clock.delete(timer);
Object.assign(globalThis, { Worker });
Object.defineProperty(globalThis, 'navigator', { value: { hardwareConcurrency: 2 } });
const pool = makePool({}, '', () => 0);
const finish = (k, result) => {
  const [worker, { id }] = sent[k];
  worker.onmessage({ data: { id, result } });
};
const busy = () => sent.length;
for (let k = 0; k < Worker.made.length; k++) pool.ask('busy', k);
const full = busy();
"""


def test_the_most_urgent_runs_first_and_of_one_key_the_newest(in_node: InNode) -> None:
    lines = """
    const late = pool.ask('late', 0, { priority: 5 });
    const old = pool.ask('old', 0, { key: 'a' }), newer = pool.ask('newer', 0, { key: 'a' });
    const dropped = await old;
    for (let k = 0; k < 2; k++) finish(k, k);
    answer([full, sent.slice(full).map(([, message]) => message.job), dropped === undefined]);
    """
    full, order, dropped = in_node(LINES + lines)
    assert full >= 2
    assert order[:2] == ["newer", "late"]
    assert dropped


def test_a_dropped_job_that_runs_gives_nothing_and_its_worker_goes_on(in_node: InNode) -> None:
    lines = """
    const first = pool.ask('tile', 0, { key: 'map:1' });
    finish(0, 'busy');
    const waiting = pool.waiting('map:');
    pool.drop('map:');
    const gone = await first;
    const place = sent.length - 1;
    pool.ask('next', 0);
    finish(place, 'too late');
    answer([waiting, gone === undefined, pool.waiting('map:'), sent.at(-1)[1].job]);
    """
    assert in_node(LINES + lines) == [1, True, 0, "next"]


def test_a_job_that_runs_away_is_ended_and_another_worker_takes_its_place(in_node: InNode) -> None:
    lines = """
    const waits = pool.ask('waits', 0, { key: 'a' });
    laterOnes(29);
    const patient = ended.length;
    for (let k = 1; k < full; k++) finish(k, k);
    const held = sent.find(([, { job }]) => job === 'waits')[0];
    pool.drop('a');
    laterOnes(2);
    pool.ask('more', 0);
    answer([patient, ended.length, ended[0] === held, Worker.made.length - full,
      sent.at(-1)[1].job, (await waits) === undefined]);
    """
    assert in_node(LINES + lines) == [0, 1, True, 1, "more", True]


def test_a_job_that_takes_too_long_says_so_and_all_workers_go_on(in_node: InNode) -> None:
    lines = """
    for (let k = 0; k < full; k++) finish(k, k);
    const endless = pool.ask('endless', 0);
    laterOnes(30);
    const fault = await endless.catch((error) => error.message);
    for (let k = 0; k < full; k++) pool.ask('next', k);
    const next = sent.filter(([, { job }]) => job === 'next').map(([worker]) => worker);
    answer([fault, ended.length, new Set(next).size === full, next.includes(ended[0])]);
    """
    fault, ended, all_busy, ended_busy = in_node(LINES + lines)
    assert "undecided" in fault
    assert "30 s" in fault
    assert (ended, all_busy, ended_busy) == (1, True, False)


def test_workers_that_the_browser_does_not_start_leave_their_jobs_to_the_page(
    in_node: InNode,
) -> None:
    lines = """
    const from = Worker.made.length;
    const second = makePool({}, '', (name, args) => 2 * args);
    const twice = second.ask('twice', 21);
    for (const worker of Worker.made.slice(from)) {
      worker.onerror({ preventDefault() {}, message: 'blocked' });
    }
    laterOnes(0);
    answer([await twice, Worker.made.length - from === full]);
    """
    assert in_node(LINES + lines) == [42, True]


def test_without_workers_jobs_run_in_turn_on_the_page(in_node: InNode) -> None:
    lines = """
    const { makePool } = await import(parts('work/pool.mjs'));
    globalThis.Worker = class { constructor() { throw new Error('refused'); } };
    const order = [];
    const pool = makePool({}, '', (name, args) => {
        order.push(name);
        if (name === 'bad') throw new Error('no');
        return 2 * args;
    });
    const all = [pool.ask('b', 2, { priority: 2 }), pool.ask('a', 1), pool.ask('bad', 0)];
    const found = await Promise.allSettled(all);
    answer([order, found.map((each) => each.value ?? each.reason.message)]);
    """
    order, found = in_node(lines)
    assert order == ["a", "bad", "b"]
    assert found[:2] == [4, 2]
    assert "no" in found[2]
