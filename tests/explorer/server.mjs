// Runs scripts one after the other, each in a thread of its own that shares nothing with another.
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { Worker } from 'node:worker_threads';

const module = await WebAssembly.compile(readFileSync(process.argv[2]));
for await (const line of createInterface({ input: process.stdin })) {
  const { script, asked } = JSON.parse(line);
  const answers = [];
  let error = '';
  const code = await new Promise(done => new Worker(new URL(script), { workerData: { module, asked } })
    .on('message', text => answers.push(text))
    .on('error', thrown => { error = thrown.stack ?? `${thrown}`; })
    .on('exit', done));
  console.log(JSON.stringify({ code, error, answers }));
}
