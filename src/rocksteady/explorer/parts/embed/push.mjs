// The scene push, alone.

import { makeLanding } from '../story/landing.mjs';
import { embed } from './embed.mjs';

/** Begin. */
export function start() {
  embed('push', makeLanding);
}
