'use strict';
// Where a component is: an organ by its part, an internode and a bud by the line of their axis.

const Places = (() => {
  // The part, and the lines of the axis, of each component of a plant.
  class Finder {
    constructor({ wood, parts, table }) {
      Object.assign(this, { wood, parts, table });
      this.partOf = new Map(Array.from(parts.components, (component, i) => [component, i]));
      this.linesOf = new Map();
      wood.axes.forEach((axis, line) => this.linesOf.set(axis, [...(this.linesOf.get(axis) ?? []), line]));
    }

    // Place, heading and upper side of a component at an age, by its number; null where nothing is known of it.
    at(component, number) {
      const part = this.partOf.get(component);
      if (part !== undefined) return this.ofPart(part, number);
      const standing = (this.linesOf.get(this.table.axes[component]) ?? []).map((line) => this.points(line, number));
      const found =
        standing.find((points) => points.length > 1 && this.holds(points, component)) ??
        standing.find((points) => points.length > 1);
      if (!found) return null;
      const [tag] = this.table.header.kinds[this.table.kinds[component]];
      if (!tag.endsWith('bud')) return this.turned(this.ofInternode(found, component, number), component, number);
      // A bud has the directions of the last internode of its axis.
      const axis = this.table.internodes(this.table.axes[component]);
      const last = axis.filter((internode) => this.table.stands(internode, number)).at(-1);
      return this.turned(this.between(found, found.length - 2, 1), last, number);
    }

    // What is found of an internode, with its upper side.
    turned(found, component, number) {
      const upper = component === undefined ? null : this.table.upper(component, number, found.heading);
      return upper ? { ...found, upper } : found;
    }

    ofPart(part, number) {
      const out = new Float32Array(10);
      this.parts.evaluate(part, number, out, { key: 0, share: 0 });
      const [x, y, z, w] = out.subarray(3, 7);
      return {
        place: Array.from(out.subarray(0, 3)),
        heading: [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
        upper: [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
      };
    }

    // The points of a line that stand at an age, with their places.
    points(line, number) {
      const found = [];
      for (let i = this.wood.begin[line]; i < this.wood.begin[line + 1]; i += 1) {
        if (!this.wood.stands(i, number)) continue;
        found.push({
          i,
          at: this.wood.placeAt(i, number),
          component: this.wood.components[i],
          end: (this.wood.flags[i] & 3) !== 0,
        });
      }
      return found;
    }

    holds(points, component) {
      const rank = (point) => this.table.ranks[point.component];
      return (
        rank(points[0]) <= this.table.ranks[component] && this.table.ranks[component] <= Math.max(...points.map(rank))
      );
    }

    ofInternode(points, component, number) {
      const rank = this.table.ranks[component];
      let before = 0;
      points.forEach((point, k) => {
        if (k + 1 < points.length && !point.end && this.table.ranks[point.component] <= rank) before = k;
      });
      const all = this.table.internodes(this.table.axes[component]).filter((i) => this.table.stands(i, number));
      const first = all.indexOf(points[before].component);
      const after = points[before + 1];
      const last = after.end ? all.length : all.indexOf(after.component);
      const lengths = all
        .slice(Math.max(first, 0), Math.max(last, first + 1))
        .map((i) => [i, this.table.value('length_m', i, number, 0) ?? 0]);
      const whole = lengths.reduce((sum, [, length]) => sum + length, 0);
      let below = 0;
      for (const [i, length] of lengths) {
        if (i === component) break;
        below += length;
      }
      return this.between(points, before, whole > 0 ? below / whole : 0);
    }

    between(points, before, share) {
      const [a, b] = [points[before].at, points[before + 1].at];
      return { place: a.map((x, k) => x + share * (b[k] - x)), heading: Light.unit(a.map((x, k) => b[k] - x)) };
    }
  }

  // The share of the way along a segment at which a ray from the eye through a pixel passes it.
  function shareAlong(a, b, eye, ray) {
    const along = a.map((x, k) => b[k] - x);
    const from = a.map((x, k) => x - eye[k]);
    const [aa, ar, rr] = [Light.dot(along, along), Light.dot(along, ray), Light.dot(ray, ray)];
    const bottom = aa * rr - ar * ar;
    if (!(bottom > 0)) return 0;
    return Math.min(Math.max((ar * Light.dot(ray, from) - rr * Light.dot(along, from)) / bottom, 0), 1);
  }

  return { Finder, shareAlong };
})();
