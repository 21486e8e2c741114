// Dragging a place along a panel.

/** @import { App, Panel } from '../../shell/app.mjs' */

/**
 * Follow the pointer from where it grasps a panel until it lets go.
 * @param {App} app
 * @param {Panel} panel
 * @param {(event: PointerEvent, settled: boolean) => void} take
 * @param {(event: PointerEvent) => boolean} [grasps]  whether a drag begins there
 */
export function followPointer(app, panel, take, grasps = () => true) {
  const { canvas } = panel;
  let held = false;
  canvas?.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !grasps(event)) return;
    held = true;
    canvas.setPointerCapture(event.pointerId);
    take(event, false);
  });
  canvas?.addEventListener('pointermove', (event) => held && take(event, false));
  canvas?.addEventListener('pointerup', (event) => {
    if (held) take(event, true);
    held = false;
  });
  canvas?.addEventListener('pointercancel', () => {
    if (held) app.set({});
    held = false;
  });
}
