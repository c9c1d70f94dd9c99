'use strict';
// What is drawn of all plants over a span of ages, as the buffers that the drawing takes, and what stands where in them.

const Scenery = (() => {
  const CELLS = 40; // Cells of the crowns along their longest side.

  class Scene {
    constructor(data) {
      this.header = data.header;
      this.plants = data.header.plants.map((plant, number) => {
        const name = String(number);
        const wood = new States.Wood(data, name);
        return { plant, wood, parts: new States.Parts(data, name, wood), table: new Records.Table(data, plant, name) };
      });
      this.box = this.boxOfAll();
      this.middle = [0, 1, 2].map((k) => 0.5 * (this.box[0][k] + this.box[1][k]));
      this.outline = this.outlineOfAll();
      this.hidden = new Set();
      this.colouring = null;
      this.fewest = this.fewestSides();
    }

    // The box of everything at all ages, with the ground below the seeds.
    boxOfAll() {
      const [low, high] = [
        [Infinity, Infinity, Infinity],
        [-Infinity, -Infinity, -Infinity],
      ];
      for (const { plant, wood, parts } of this.plants) {
        for (let k = 0; k < 3; k += 1) {
          for (const values of [wood.places[k], parts.places[k], [0]]) {
            for (let i = 0; i < values.length; i += 1) {
              low[k] = Math.min(low[k], values[i] + plant.place[k]);
              high[k] = Math.max(high[k], values[i] + plant.place[k]);
            }
          }
        }
      }
      for (const { corners } of this.header.solids) {
        for (let i = 0; i < corners.length; i += 1) {
          if (i % 10 > 2) continue;
          low[i % 10] = Math.min(low[i % 10], corners[i] / 1e4);
          high[i % 10] = Math.max(high[i % 10], corners[i] / 1e4);
        }
      }
      const room = 0.04 * Math.max(...[0, 1, 2].map((k) => high[k] - low[k]), 0.01);
      return [low.map((x, k) => (k === 2 ? Math.min(x, 0) : x - room)), high.map((x) => x + room)];
    }

    // Places around the plants at all ages, by their distance from the upright axis and their height over the middle: of
    // each height the farthest.
    outlineOfAll() {
      const [low, high] = this.box;
      const farthest = new Float32Array(65);
      const tell = (x, y, z) => {
        const place = Math.round((64 * (z - low[2])) / Math.max(high[2] - low[2], 1e-9));
        if (place < 0 || place > 64) return;
        farthest[place] = Math.max(farthest[place], Math.hypot(x - this.middle[0], y - this.middle[1]));
      };
      for (const { plant, wood, parts } of this.plants) {
        const [px, py, pz] = plant.place;
        tell(px, py, 0);
        for (const { places } of [wood, parts]) {
          for (let i = 0; i < places[0].length; i += 1) tell(places[0][i] + px, places[1][i] + py, places[2][i] + pz);
        }
      }
      for (const { corners } of this.header.solids) {
        for (let i = 0; i < corners.length; i += 10) tell(...[0, 1, 2].map((k) => corners[i + k] / 1e4));
      }
      const told = Array.from(farthest, (far, k) => [far, low[2] + (k / 64) * (high[2] - low[2]) - this.middle[2]]);
      return told.filter(([far], k) => far > 0 || k === 0 || k === 64);
    }

    // Twigs have more sides where there are few of them.
    fewestSides() {
      const points = this.plants.reduce((sum, { wood }) => sum + wood.components.length, 0);
      return points > 60000 ? 0 : points > 8000 ? 2 : 3;
    }

    classOf(radius) {
      const e = this.header.tolerance_m;
      const needed = radius > 2 * e ? Math.PI / Math.acos(1 - e / radius) : 3;
      const found = Drawing.SIDES.findIndex((sides) => sides >= needed);
      return Math.max(found < 0 ? Drawing.SIDES.length - 1 : found, this.fewest);
    }

    // The buffers of the span from an age to the next.
    span(number, next) {
      this.number = number;
      this.next = next;
      this.crown = new Light.Crown(this.box, CELLS);
      for (const { wood } of this.plants) wood.span(number, next);
      return { ...this.woodSpan(), ...this.partSpan() };
    }

    shows({ table }, component) {
      return !this.hidden.has(table.kinds[component]);
    }

    // The two colours of a component, of its own or of its values.
    colours(one, component, own, drawn) {
      if (!this.colouring) return own();
      const { name } = this.colouring;
      return [this.number, this.next].map((number) =>
        this.colouring.colour(Values.valueOf(one, name, component, number, 0, drawn)),
      );
    }

    woodSpan() {
      const lines = Drawing.SIDES.map(() => []);
      let count = 0;
      this.plants.forEach(({ wood }, of) => {
        for (let line = 0; line < wood.axes.length; line += 1) {
          let [radius, points] = [0, 0];
          for (let i = wood.begin[line]; i < wood.begin[line + 1]; i += 1) {
            if (wood.fates[i] === 0) continue;
            points += 1;
            radius = Math.max(radius, wood.next[4 * i + 3], wood.now[4 * i + 3]);
          }
          if (points < 2) continue;
          lines[this.classOf(radius)].push([of, line]);
          count += points;
        }
      });
      // A point that is nothing before the first, and two after the last.
      const buffer = new ArrayBuffer((count + 3) * Drawing.POINT);
      const writer = { floats: new Float32Array(buffer), words: new Uint32Array(buffer), at: 0 };
      this.woodOf = { plants: new Int32Array(count), points: new Int32Array(count) };
      const classes = lines.map((list) => {
        const first = writer.at;
        for (const [of, line] of list) this.writeLine(of, line, writer);
        return { first, count: writer.at - first };
      });
      this.woods = count;
      return { wood: buffer, classes, woods: count };
    }

    writeLine(of, line, writer) {
      const one = this.plants[of];
      const { wood, plant } = one;
      const standing = [];
      for (let i = wood.begin[line]; i < wood.begin[line + 1]; i += 1) if (wood.fates[i] !== 0) standing.push(i);
      const joined = standing.map((i, k) => (k + 1 < standing.length && this.shows(one, wood.components[i]) ? 1 : 0));
      standing.forEach((i, k) => {
        const at = (writer.at + 1) * (Drawing.POINT / 4);
        for (let c = 0; c < 4; c += 1) {
          const shift = c < 3 ? plant.place[c] : 0;
          writer.floats[at + c] = wood.now[4 * i + c] + shift;
          writer.floats[at + 4 + c] = wood.next[4 * i + c] + shift;
        }
        const flags = joined[k] | (k > 0 && joined[k - 1] ? 2 : 0) | (joined[k + 1] ? 4 : 0);
        const [now, next] = this.colours(
          one,
          wood.components[i],
          () => wood.colours(i, this.number, this.next),
          this.drawnPoint(one, standing, k),
        );
        writer.words[at + 8] = (now & 0xffffff) | (flags << 24);
        writer.words[at + 9] = next & 0xffffff;
        if (joined[k]) this.shade(wood, i, standing[k + 1], plant);
        this.woodOf.plants[writer.at] = of;
        this.woodOf.points[writer.at] = i;
        writer.at += 1;
      });
    }

    drawnPoint({ wood, table }, standing, k) {
      if (!this.colouring) return null;
      const [i, after] = [standing[k], standing[Math.min(k + 1, standing.length - 1)]];
      const place = [0, 1, 2].map((c) => wood.next[4 * i + c]);
      const heading = Light.unit(place.map((x, c) => wood.next[4 * after + c] - x));
      return { place, heading, upper: table.upper(wood.components[i], this.next, heading) };
    }

    // The area of a tube for the light of the sky: a quarter of its surface.
    shade(wood, i, after, plant) {
      const [a, b] = [4 * i, 4 * after];
      const length = Math.hypot(...[0, 1, 2].map((c) => wood.next[b + c] - wood.next[a + c]));
      const area = 0.25 * Math.PI * (wood.next[a + 3] + wood.next[b + 3]) * length;
      const pieces = Math.min(Math.ceil(length / this.crown.cell), 64) || 1;
      for (let piece = 0; piece < pieces; piece += 1) {
        const t = (piece + 0.5) / pieces;
        this.crown.add(
          ...[0, 1, 2].map((c) => wood.next[a + c] + t * (wood.next[b + c] - wood.next[a + c]) + plant.place[c]),
          area / pieces,
        );
      }
    }

    partSpan() {
      const chosen = [];
      this.plants.forEach((one, of) => {
        for (let i = 0; i < one.parts.components.length; i += 1) {
          const [before, after] = [one.parts.stands(i, this.number), one.parts.stands(i, this.next)];
          // What takes the place of a part stands from its own age on, and is no new part that grows.
          if (!before && one.parts.succeeds[i] === 1) continue;
          if ((before || after) && this.shows(one, one.parts.components[i])) chosen.push([of, i, before, after]);
        }
      });
      const formOf = ([of, i]) => this.plants[of].parts.forms[i];
      if (this.plants.length > 1) chosen.sort((a, b) => formOf(a) - formOf(b));
      const buffer = new ArrayBuffer(Math.max(chosen.length + this.header.solids.length, 1) * Drawing.PART);
      const writer = {
        floats: new Float32Array(buffer),
        words: new Uint32Array(buffer),
        turns: new Int16Array(buffer),
      };
      this.partOf = { plants: new Int32Array(chosen.length), parts: new Int32Array(chosen.length) };
      const groups = [];
      const poses = [new Float32Array(10), new Float32Array(10), { key: 0, share: 0 }];
      chosen.forEach((part, place) => {
        if (groups.length === 0 || groups.at(-1).form !== formOf(part))
          groups.push({ form: formOf(part), first: place, count: 0 });
        groups.at(-1).count += 1;
        this.writePart(part, place, writer, poses);
      });
      this.header.solids.forEach((solid, k) => {
        groups.push({ form: this.header.forms.length + k, first: chosen.length + k, count: 1 });
        this.writeSolid(solid, chosen.length + k, writer);
      });
      return { parts: buffer, groups };
    }

    writePart([of, i, before, after], place, writer, [now, next, found]) {
      const one = this.plants[of];
      const { parts, wood, plant } = one;
      const successor = after ? -1 : parts.successors[i];
      if (successor >= 0 && parts.stands(successor, this.next)) parts.evaluate(successor, this.next, next, found);
      else parts.evaluate(i, after ? this.next : this.number, next, found);
      if (before) parts.evaluate(i, this.number, now, found);
      else {
        now.set(next);
        const host = parts.hosts.points[i];
        const at = host >= 0 ? wood.hostAt(host, parts.hosts.shares[i]) : null;
        for (let k = 0; k < 3; k += 1) {
          if (at) now[k] = at[k];
          now[7 + k] = 0;
        }
      }
      const at = (place * Drawing.PART) / 4;
      for (let k = 0; k < 3; k += 1) {
        writer.floats[at + k] = now[k] + plant.place[k];
        writer.floats[at + 3 + k] = next[k] + plant.place[k];
        writer.floats[at + 10 + k] = now[7 + k];
        writer.floats[at + 13 + k] = next[7 + k];
      }
      for (let k = 0; k < 4; k += 1) {
        writer.turns[2 * at + 12 + k] = Math.round(32767 * now[3 + k]);
        writer.turns[2 * at + 16 + k] = Math.round(32767 * next[3 + k]);
      }
      writer.floats[at + 16] = parts.fullness[i];
      const [x, y, z, w] = next.subarray(3, 7);
      const heading = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)];
      const drawn = {
        place: next,
        heading,
        upper: [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
      };
      const [first, last] = this.colours(
        one,
        parts.components[i],
        () => parts.colours(i, this.number, this.next),
        drawn,
      );
      writer.words[at + 17] = first | 0xff000000;
      writer.words[at + 18] = last | 0xff000000;
      const [length, width] = [next[7], next[8]];
      // Half of the area of a blade, of which a form fills about two thirds.
      this.crown.add(
        ...[0, 1, 2].map((k) => next[k] + 0.5 * length * heading[k] + plant.place[k]),
        0.33 * length * width * parts.fullness[i],
      );
      this.partOf.plants[place] = of;
      this.partOf.parts[place] = i;
    }

    // An obstacle stands once, at its place and of its size.
    writeSolid({ colour: [red, green, blue] }, place, writer) {
      const at = (place * Drawing.PART) / 4;
      for (const turn of [12, 16]) writer.turns[2 * at + turn + 3] = 32767;
      for (let k = 10; k < 17; k += 1) writer.floats[at + k] = 1;
      for (const word of [17, 18]) writer.words[at + word] = red | (green << 8) | (blue << 16) | 0xff000000;
    }

    // What was drawn under a number: the plant, the component, and its point or part.
    found(id) {
      if (id < 0 || id >= this.woods + this.partOf.parts.length) return null;
      if (id >= this.woods) {
        const of = this.partOf.plants[id - this.woods];
        const part = this.partOf.parts[id - this.woods];
        return { of, component: this.plants[of].parts.components[part], part };
      }
      const [of, point] = [this.woodOf.plants[id], this.woodOf.points[id]];
      return { of, component: this.plants[of].wood.components[point], point };
    }

    // The internode of a segment at a share of its way, by the lengths of those between its points.
    internodeAt({ of, point, component }, share) {
      const { wood, table } = this.plants[of];
      const line = wood.lineOf[point];
      let after = point + 1;
      while (after < wood.begin[line + 1] && wood.fates[after] === 0) after += 1;
      const all = table
        .internodes(table.axes[component])
        .filter((i) => table.stands(i, this.number) || table.stands(i, this.next));
      const first = all.indexOf(component) + ((wood.flags[point] & 1) !== 0 ? 1 : 0);
      const last =
        after < wood.begin[line + 1] && (wood.flags[after] & 2) === 0
          ? all.indexOf(wood.components[after])
          : all.length;
      const between = all.slice(Math.max(first, 0), Math.max(last, first + 1));
      const lengths = between.map((i) => table.value('length_m', i, this.next, 0) ?? 0);
      let rest = share * lengths.reduce((sum, length) => sum + length, 0);
      for (let k = 0; k < between.length; k += 1) {
        rest -= lengths[k];
        if (rest <= 0) return between[k];
      }
      return between.at(-1) ?? component;
    }

    // The share of the way along a segment that is seen at a pixel, from below.
    shareAt({ of, point }, { eye, axes, width, height, share }, x, y) {
      const { wood, plant } = this.plants[of];
      let after = point + 1;
      while (after < wood.begin[wood.lineOf[point] + 1] && wood.fates[after] === 0) after += 1;
      const place = (i) =>
        [0, 1, 2].map(
          (k) => wood.now[4 * i + k] + share * (wood.next[4 * i + k] - wood.now[4 * i + k]) + plant.place[k],
        );
      const [right, up] = [((2 * x + 1) / width - 1) * (width / height), (2 * y + 1) / height - 1].map(
        (tangent) => tangent * Light.HALF,
      );
      const ray = [0, 1, 2].map((k) => axes[2][k] + right * axes[0][k] + up * axes[1][k]);
      return Places.shareAlong(place(point), place(after), eye, ray);
    }

    // Where a component is, between an age and the next.
    placeOf(of, component, number, share) {
      const one = this.plants[of];
      one.finder = one.finder ?? new Places.Finder(one);
      const now = one.finder.at(component, number);
      const next = share > 0 && one.table.stands(component, number + 1) ? one.finder.at(component, number + 1) : null;
      if (!now || !next) return now;
      return { ...now, place: now.place.map((x, k) => x + share * (next.place[k] - x)) };
    }

    // The number under which a component is drawn; of an internode that begins at no point, of the point before.
    numberOf(of, component) {
      const { wood, parts, table } = this.plants[of];
      for (let id = 0; id < this.partOf.parts.length; id += 1) {
        if (this.partOf.plants[id] === of && parts.components[this.partOf.parts[id]] === component)
          return this.woods + id;
      }
      let [found, rank] = [-1, -1];
      for (let id = 0; id < this.woods; id += 1) {
        const point = this.woodOf.points[id];
        if (
          this.woodOf.plants[id] !== of ||
          wood.axes[wood.lineOf[point]] !== table.axes[component] ||
          (wood.flags[point] & 2) !== 0
        )
          continue;
        const own = table.ranks[wood.components[point]];
        if (own <= table.ranks[component] && own >= rank) [found, rank] = [id, own];
      }
      return found;
    }
  }

  return { Scene };
})();
