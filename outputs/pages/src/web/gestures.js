'use strict';
// Mouse and touch on the picture: one pointer turns, with Shift or the other button it moves, two move and come nearer.

const Gestures = (() => {
  const CLICK = 5; // The pixels that a pointer may move while it clicks.

  function listen(life) {
    const canvas = document.getElementById('canvas');
    const pointers = new Map();
    let far = 0;

    const middle = () => {
      const all = [...pointers.values()];
      const mean = (of) => all.reduce((sum, pointer) => sum + pointer[of], 0) / all.length;
      return {
        x: mean('x'),
        y: mean('y'),
        apart: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0,
      };
    };

    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      if (pointers.size === 0) far = 0;
      pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    });
    canvas.addEventListener('pointermove', (event) => {
      const pointer = pointers.get(event.pointerId);
      if (!pointer) return;
      const before = middle();
      [pointer.x, pointer.y] = [event.offsetX, event.offsetY];
      const now = middle();
      const [dx, dy] = [now.x - before.x, now.y - before.y];
      far += Math.abs(dx) + Math.abs(dy) + Math.abs(now.apart - before.apart);
      if (far < CLICK) return;
      const height = canvas.clientHeight;
      if (pointers.size > 1) {
        life.move(dx / height, -dy / height);
        if (before.apart > 0) life.nearer(now.apart / before.apart);
      } else if (event.shiftKey || event.buttons === 2 || event.buttons === 4) life.move(dx / height, -dy / height);
      else life.turn((-180 * dx) / height, (90 * dy) / height);
      life.render();
    });
    const ends = (event) => {
      const clicked = pointers.size === 1 && far < CLICK && event.type === 'pointerup' && event.button === 0;
      pointers.delete(event.pointerId);
      if (clicked) life.pick(event.offsetX, event.offsetY);
    };
    canvas.addEventListener('pointerup', ends);
    canvas.addEventListener('pointercancel', ends);
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        life.nearer(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)));
        life.render();
      },
      { passive: false },
    );
  }

  return { listen };
})();
