// The scene swing, alone.

import { makeSwing } from '../story/scenes/swing.mjs';
import { embed } from './embed.mjs';

/** Begin. */
export function start() {
  embed('swing', makeSwing);
}
