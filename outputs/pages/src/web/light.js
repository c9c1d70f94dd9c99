'use strict';
// Cameras, and the light of the sky inside the crowns.

const Light = (() => {
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => {
    const length = Math.hypot(...a) || 1;
    return a.map((x) => x / length);
  };

  // The direction of an azimuth and an elevation, degrees: from the X axis (east) to the Y axis (north), and upwards.
  function towards(azimuth, elevation) {
    const [a, e] = [azimuth, elevation].map((degrees) => (degrees * Math.PI) / 180);
    return [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
  }

  // Right, up and forward of a gaze.
  function gaze(forward) {
    const right = Math.abs(forward[2]) > 0.9999 ? [1, 0, 0] : unit(cross(forward, [0, 0, 1]));
    return [right, cross(right, forward), forward];
  }

  // The product of two matrices in columns.
  function times(a, b) {
    const product = new Float32Array(16);
    for (let column = 0; column < 4; column += 1) {
      for (let row = 0; row < 4; row += 1) {
        for (let k = 0; k < 4; k += 1) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
      }
    }
    return product;
  }

  // From places to those seen from an eye.
  function seenFrom(eye, [right, up, forward]) {
    return new Float32Array([
      right[0],
      up[0],
      -forward[0],
      0,
      right[1],
      up[1],
      -forward[1],
      0,
      right[2],
      up[2],
      -forward[2],
      0,
      -dot(right, eye),
      -dot(up, eye),
      dot(forward, eye),
      1,
    ]);
  }

  function perspective(half, aspect, near, far) {
    const depth = 1 / (near - far);
    return new Float32Array([
      1 / (half * aspect),
      0,
      0,
      0,
      0,
      1 / half,
      0,
      0,
      0,
      0,
      (far + near) * depth,
      -1,
      0,
      0,
      2 * far * near * depth,
      0,
    ]);
  }

  function parallel(half, depth) {
    return new Float32Array([1 / half, 0, 0, 0, 0, 1 / half, 0, 0, 0, 0, -1 / depth, 0, 0, 0, 0, 1]);
  }

  // The tangent of half the field of view across the height: a short telephoto lens, as in pictures.
  const HALF = Math.tan((13 * Math.PI) / 180);

  // How far from the middle of a box an eye must be to see places around it from every side, so that a turn does not
  // change the distance: of each place its distance from the upright axis through the middle, and its height over it.
  function distanceFor(places, aspect, pitch) {
    const across = Math.hypot(1, 1 / (0.92 * HALF * aspect));
    const [sin, cos] = [Math.sin, Math.cos].map((of) => Math.abs(of((pitch * Math.PI) / 180)));
    let distance = 0;
    for (const [far, high] of places) {
      const upright = (Math.abs(high) * cos + far * sin) / (0.84 * HALF) + far * cos;
      distance = Math.max(distance, far * across, upright);
    }
    return distance;
  }

  // Directions of the sky, each with its share; the low sky counts most, as in pictures.
  const SKY = (() => {
    const all = [];
    [
      [22, 8, 0.5],
      [42, 7, 0.3],
      [64, 4, 0.16],
      [90, 1, 0.04],
    ].forEach(([elevation, count, share], ring) => {
      for (let k = 0; k < count; k += 1) {
        all.push([towards((360 * (k + 0.37 * ring)) / count, elevation), share / count]);
      }
    });
    return all;
  })();
  const OPEN = SKY.reduce((sum, [direction, share]) => sum + direction[2] * share, 0);

  // The area in each cell of a grid over a box, and the light that falls through it (Beer's law).
  class Crown {
    constructor(box, cells) {
      const [low, high] = box;
      const side = Math.max(...[0, 1, 2].map((k) => high[k] - low[k]), 1e-6);
      this.cell = side / cells;
      this.low = low.map((x, k) => x - (k === 2 ? 1 : 4) * this.cell);
      this.size = [0, 1, 2].map((k) => Math.ceil((high[k] - low[k]) / this.cell) + (k === 2 ? 2 : 8));
      this.areas = new Float32Array(this.size[0] * this.size[1] * this.size[2]);
    }

    add(x, y, z, area) {
      const cell = [x, y, z].map((place, k) => Math.floor((place - this.low[k]) / this.cell));
      if (cell.some((place, k) => place < 0 || place >= this.size[k])) return;
      this.areas[(cell[2] * this.size[1] + cell[1]) * this.size[0] + cell[0]] += area / (this.cell * this.cell);
    }

    // The light in each cell: a mean and a vector towards its source, as four bytes.
    lighten() {
      const light = new Float32Array(4 * this.areas.length);
      for (const [direction, share] of SKY) this.sweep(direction, share, light);
      const bytes = new Uint8Array(light.length);
      for (let i = 0; i < light.length; i += 1) bytes[i] = 255 * (i % 4 === 0 ? light[i] : 0.5 + 0.5 * light[i]) + 0.5;
      return bytes;
    }

    // Follows the light of one direction from the top layer down; it moves by as much from each layer to the next.
    sweep(direction, share, light) {
      const [width, rows, layers] = this.size;
      const [dx, dy] = [direction[0] / direction[2], direction[1] / direction[2]];
      const [left, top] = [Math.floor(dx), Math.floor(dy)];
      const [fx, fy] = [dx - left, dy - top];
      const mean = 0.5 * share;
      const [east, north, upward] = direction.map((x) => (0.5 / OPEN) * share * x);
      // A border of open sky around each layer spares the question whether a cell is inside.
      const border = Math.max(Math.abs(left), Math.abs(top)) + 2;
      const wide = width + 2 * border;
      let above = new Float32Array(wide * (rows + 2 * border)).fill(1);
      for (let z = layers - 1; z >= 0; z -= 1) {
        const below = new Float32Array(above.length).fill(1);
        for (let y = 0; y < rows; y += 1) {
          let from = (y + top + border) * wide + left + border;
          let to = (y + border) * wide + border;
          let cell = (z * rows + y) * width;
          for (let x = 0; x < width; x += 1, from += 1, to += 1, cell += 1) {
            const upper = above[from] * (1 - fx) + above[from + 1] * fx;
            const lower = above[from + wide] * (1 - fx) + above[from + wide + 1] * fx;
            const area = this.areas[cell];
            const half = area > 0 ? Math.exp((-0.5 * area) / direction[2]) : 1;
            const arrives = (upper * (1 - fy) + lower * fy) * half;
            light[4 * cell] += arrives * mean;
            light[4 * cell + 1] += arrives * east;
            light[4 * cell + 2] += arrives * north;
            light[4 * cell + 3] += arrives * upward;
            below[to] = arrives * half;
          }
        }
        above = below;
      }
    }
  }

  return { dot, cross, unit, towards, gaze, times, seenFrom, perspective, parallel, distanceFor, HALF, Crown };
})();
