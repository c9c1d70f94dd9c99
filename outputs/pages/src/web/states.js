'use strict';
// Where everything stands at the two ages of a span. Between them the shader goes in a straight line, as the keyframes
// do. What appears at the second age begins at its host, the place on the bearing axis, without size; what the second
// age does not have any more stands until then.

const States = (() => {
  const NOWHERE = [0, 0, 0];

  // The places of keys, metres, of their whole numbers axis by axis.
  function placesOf(step, codes) {
    return codes.map((of) => {
      const places = new Float32Array(of.length);
      for (let key = 0; key < of.length; key += 1) places[key] = step * of[key];
      return places;
    });
  }

  function coloursOf(data, name, from) {
    const begin = Data.starts(data.stream(`${name}.tints`));
    const ages = Data.keyAges(begin, from, data.stream(`${name}.tint_ages`));
    return {
      begin,
      ages,
      channels: ['red', 'green', 'blue'].map((of) => Data.keyValues(begin, data.stream(`${name}.${of}`))),
    };
  }

  // The key at or before an age, and the share of the way to the next one.
  function seek(track, time, i, number, found) {
    const { begin, ages } = track;
    const key = Math.max(Records.lastUpTo(ages, begin[i], begin[i + 1], number), begin[i]);
    found.key = key;
    found.share = 0;
    if (key + 1 < begin[i + 1] && ages[key] < number) {
      found.share = (time[number] - time[ages[key]]) / (time[ages[key + 1]] - time[ages[key]]);
    }
  }

  const mix = (values, { key, share }) =>
    share > 0 ? values[key] + share * (values[key + 1] - values[key]) : values[key];

  function colourAt(tints, time, i, number, found) {
    seek(tints, time, i, number, found);
    const [red, green, blue] = tints.channels.map((values) => Math.round(mix(values, found)));
    return red | (green << 8) | (blue << 16);
  }

  // The lines of axes.
  class Wood {
    constructor(data, name) {
      const stream = (of) => data.stream(`${name}.${of}`);
      this.time = data.header.ages;
      this.axes = Data.sums(stream('line.axis'));
      this.begin = Data.starts(stream('line.points'));
      this.hosts = hostsOf(stream('line.host'), stream('line.share'));
      this.components = Data.sums(stream('point.component'));
      this.flags = stream('point.flags');
      this.from = Data.sums(stream('point.from'));
      this.lasts = stream('point.lasts');
      const keys = Data.starts(stream('point.keys'));
      this.track = { begin: keys, ages: Data.keyAges(keys, this.from, stream('point.ages')) };
      this.lineOf = new Int32Array(this.components.length);
      for (let line = 0; line < this.axes.length; line += 1)
        this.lineOf.fill(line, this.begin[line], this.begin[line + 1]);
      this.readPlaces(data, name, keys, stream('point.radius'));
      this.tints = coloursOf(data, `${name}.point`, this.from);
      this.now = this.empty();
      this.next = this.empty();
      // 0: not in the span; 1: at both ages; 2: appears; 3: ends.
      this.fates = new Uint8Array(this.components.length);
    }

    empty() {
      return new Float32Array(4 * this.components.length);
    }

    // The first key of a line's first point differs from that of its host, of a further point from the one before.
    readPlaces(data, name, keys, radii) {
      this.codes = ['x', 'y', 'z'].map((axis) => {
        const codes = data.stream(`${name}.point.${axis}`);
        for (let i = 0; i + 1 < keys.length; i += 1) {
          const line = this.lineOf[i];
          const host = i === this.begin[line] ? this.hosts.points[line] : i - 1;
          if (host >= 0) codes[keys[i]] += codes[keys[host]];
          for (let key = keys[i] + 1; key < keys[i + 1]; key += 1) codes[key] += codes[key - 1];
        }
        return codes;
      });
      this.places = placesOf(data.header.step_m, this.codes);
      this.radii = new Float32Array(radii.length);
      let code = 0;
      for (let i = 0; i + 1 < keys.length; i += 1) {
        if (i === this.begin[this.lineOf[i]]) code = 0;
        let value = code;
        for (let key = keys[i]; key < keys[i + 1]; key += 1) {
          value += radii[key];
          this.radii[key] = Data.measure(data.header, value);
          if (key === keys[i]) code = value;
        }
      }
    }

    stands(i, number) {
      return this.from[i] <= number && (this.lasts[i] === 0 || number < this.from[i] + this.lasts[i]);
    }

    // The points at the ages of a number and of the next one.
    span(number, next) {
      const found = { key: 0, share: 0 };
      for (let i = 0; i < this.components.length; i += 1) {
        const [before, after] = [this.stands(i, number), this.stands(i, next)];
        this.fates[i] = before ? (after ? 1 : 3) : after ? 2 : 0;
        if (before) this.evaluate(this.now, i, number, found);
        if (after) this.evaluate(this.next, i, next, found);
        if (before && !after) this.evaluate(this.next, i, next, found);
      }
      for (let line = 0; line < this.axes.length; line += 1) this.beginLine(line);
    }

    evaluate(out, i, number, found) {
      seek(this.track, this.time, i, number, found);
      for (let k = 0; k < 3; k += 1) out[4 * i + k] = mix(this.places[k], found);
      out[4 * i + 3] = mix(this.radii, found);
    }

    // The place of a point at an age.
    placeAt(i, number) {
      const found = { key: 0, share: 0 };
      seek(this.track, this.time, i, number, found);
      return this.places.map((values) => mix(values, found));
    }

    // Where the points that appear in a line come from.
    beginLine(line) {
      const [start, end] = [this.begin[line], this.begin[line + 1]];
      let before = -1;
      for (let i = start; i < end; i += 1) {
        if (this.fates[i] === 1 || this.fates[i] === 3) before = i;
        if (this.fates[i] !== 2) continue;
        let after = i + 1;
        while (after < end && this.fates[after] !== 1) after += 1;
        if (before >= 0) this.between(i, before, after < end ? after : before);
        else this.fromHost(i, line);
      }
    }

    // On the way from a point to another that stood before, as far from the first as at the next age.
    between(i, before, after) {
      const { now, next } = this;
      const far = (values, a, b) => Math.hypot(...[0, 1, 2].map((k) => values[4 * a + k] - values[4 * b + k]));
      const way = far(now, after, before);
      const share = way > 0 ? Math.min(far(next, i, before) / way, 1) : 0;
      for (let k = 0; k < 4; k += 1)
        now[4 * i + k] = now[4 * before + k] + share * (now[4 * after + k] - now[4 * before + k]);
    }

    fromHost(i, line) {
      const at = this.hostAt(this.hosts.points[line], this.hosts.shares[line]);
      const first = this.begin[line];
      for (let k = 0; k < 3; k += 1) this.now[4 * i + k] = at ? at[k] : this.next[4 * this.firstOf(first, line) + k];
      this.now[4 * i + 3] = 0;
    }

    firstOf(i, line) {
      let first = i;
      while (first + 1 < this.begin[line + 1] && this.fates[first] === 0) first += 1;
      return first;
    }

    // The place of a host at the first age of the span.
    hostAt(point, share) {
      if (point < 0 || this.fates[point] === 0) return null;
      const end = this.begin[this.lineOf[point] + 1];
      let after = point + 1;
      while (after < end && this.fates[after] === 0) after += 1;
      if (after === end) after = point;
      return [0, 1, 2].map(
        (k) => this.now[4 * point + k] + share * (this.now[4 * after + k] - this.now[4 * point + k]),
      );
    }

    colours(i, number, next) {
      const found = { key: 0, share: 0 };
      return [colourAt(this.tints, this.time, i, number, found), colourAt(this.tints, this.time, i, next, found)];
    }
  }

  // Where hosts carry what they bear, in whole numbers: parts are told as the difference to it. Every step is exact to
  // the last bit in any language, so that the whole numbers are those of whoever wrote the page.
  class Carrier {
    constructor(wood) {
      this.wood = wood;
      this.here = new Float64Array(3);
      this.there = new Float64Array(3);
    }

    // Writes the place of a point at an age.
    at(i, number, out) {
      const { begin, ages } = this.wood.track;
      const { codes } = this.wood;
      const key = Math.max(Records.lastUpTo(ages, begin[i], begin[i + 1], number), begin[i]);
      const share =
        key + 1 >= begin[i + 1] || ages[key] > number ? 0 : (number - ages[key]) / (ages[key + 1] - ages[key]);
      for (let k = 0; k < 3; k += 1) {
        const low = codes[k][key];
        out[k] = share > 0 ? low + share * (codes[k][key + 1] - low) : low;
      }
    }

    // The next point of the line that stands at an age; −1 where there is none.
    after(i, number) {
      const { begin, lineOf } = this.wood;
      const end = begin[lineOf[i] + 1];
      for (let next = i + 1; next < end; next += 1) if (this.wood.stands(next, number)) return next;
      return -1;
    }

    far() {
      const [a, b] = [this.here, this.there];
      const x = b[0] - a[0];
      const y = b[1] - a[1];
      const z = b[2] - a[2];
      return Math.sqrt(x * x + y * y + z * z);
    }

    along(point, share, number) {
      const next = this.after(point, number);
      if (next < 0) return 0;
      this.at(point, number, this.here);
      this.at(next, number, this.there);
      return share * this.far();
    }

    // The place to which a host has carried what it bears, so far along from its point.
    place(point, along, number) {
      const { here, there } = this;
      let rest = along;
      this.at(point, number, here);
      for (let next = this.after(point, number); next >= 0; next = this.after(next, number)) {
        this.at(next, number, there);
        const far = this.far();
        if (far > 0 && rest <= far) {
          const share = rest / far;
          for (let k = 0; k < 3; k += 1) here[k] += share * (there[k] - here[k]);
          break;
        }
        rest -= far;
        here.set(there);
      }
      for (let k = 0; k < 3; k += 1) here[k] = Math.floor(here[k] + 0.5);
      return here;
    }
  }

  function hostsOf(points, shares) {
    const hosts = { points: Data.sums(points), shares: new Float64Array(points.length) };
    let next = 0;
    for (let i = 0; i < points.length; i += 1) {
      hosts.points[i] -= 1;
      if (hosts.points[i] >= 0) {
        hosts.shares[i] = shares[next] / 255;
        next += 1;
      }
    }
    return hosts;
  }

  // Organs, and internodes that are drawn by themselves.
  class Parts {
    constructor(data, name, wood) {
      const stream = (of) => data.stream(`${name}.part.${of}`);
      this.time = data.header.ages;
      this.wood = wood;
      this.components = Data.sums(stream('component'));
      this.forms = Data.sums(stream('form'));
      this.fullness = Float32Array.from(Data.sums(stream('fullness')), (place) => Data.measure(data.header, place));
      this.from = Data.sums(stream('from'));
      this.lasts = stream('lasts');
      this.hosts = hostsOf(stream('host'), stream('share'));
      const begin = Data.starts(stream('keys'));
      this.track = { begin, ages: Data.keyAges(begin, this.from, stream('ages')) };
      this.readPlaces(data.header.step_m, stream, begin);
      this.readSizes(data.header, stream, begin);
      this.readTurns(data.header, stream, begin);
      this.tints = coloursOf(data, `${name}.part`, this.from);
      this.findSuccessors();
    }

    // Places differ from those to which their hosts have carried them.
    readPlaces(step, stream, begin) {
      const codes = ['x', 'y', 'z'].map(stream);
      const carrier = new Carrier(this.wood);
      for (let i = 0; i + 1 < begin.length; i += 1) {
        const host = this.hosts.points[i];
        const along = host >= 0 ? carrier.along(host, this.hosts.shares[i], this.from[i]) : 0;
        const off = [0, 0, 0];
        for (let key = begin[i]; key < begin[i + 1]; key += 1) {
          const there = host >= 0 ? carrier.place(host, along, this.track.ages[key]) : NOWHERE;
          for (let k = 0; k < 3; k += 1) {
            off[k] += codes[k][key];
            codes[k][key] = there[k] + off[k];
          }
        }
      }
      this.places = placesOf(step, codes);
    }

    // Unit quaternions without their largest component, the finer the longer the part.
    readTurns(header, stream, begin) {
      const largest = stream('largest');
      const others = ['a', 'b', 'c'].map(stream);
      this.turns = new Float32Array(4 * largest.length);
      for (let i = 0; i + 1 < begin.length; i += 1) {
        const last = [0, 0, 0];
        const steps = 2 ** this.exponents[i];
        for (let key = begin[i]; key < begin[i + 1]; key += 1) {
          if (key === begin[i] || largest[key] !== largest[key - 1]) last.fill(0);
          let rest = 1;
          for (let k = 0; k < 3; k += 1) {
            last[k] += others[k][key];
            const value = last[k] / steps;
            this.turns[4 * key + (k < largest[key] ? k : k + 1)] = value;
            rest -= value * value;
          }
          this.turns[4 * key + largest[key]] = Math.sqrt(Math.max(rest, 0));
        }
      }
    }

    // Three sizes of forms that have three, two of the others.
    readSizes(header, stream, begin) {
      const three = header.forms.map((form) => form.of_internode || form.scale === 'each');
      const metric = header.forms.map((form) => form.scale !== 'share' && form.scale !== 'each');
      const streams = ['length', 'width', 'tip'].map(stream);
      const next = [0, 0, 0];
      const first = [0, 0, 0];
      this.sizes = new Float32Array(3 * begin[begin.length - 1]);
      this.exponents = new Uint8Array(this.forms.length).fill(10);
      for (let i = 0; i + 1 < begin.length; i += 1) {
        const last = first.slice();
        const told = three[this.forms[i]] ? 3 : 2;
        for (let key = begin[i]; key < begin[i + 1]; key += 1) {
          for (let k = 0; k < told; k += 1) {
            last[k] += streams[k][next[k]];
            next[k] += 1;
            this.sizes[3 * key + k] = Data.measure(header, last[k]);
          }
          if (key === begin[i]) {
            last.forEach((value, k) => {
              first[k] = value;
            });
            const octaves = Math.floor((Math.max(last[0], last[1]) - header.near) / header.octave);
            if (metric[this.forms[i]]) this.exponents[i] = Math.min(Math.max(octaves + 2, 6), 12);
          }
        }
      }
    }

    stands(i, number) {
      return this.from[i] <= number && (this.lasts[i] === 0 || number < this.from[i] + this.lasts[i]);
    }

    // Of each part the one that takes its place where a component has another form from an age on; −1 for none.
    findSuccessors() {
      const first = new Map();
      const key = (component, age) => component * (this.time.length + 1) + age;
      for (let i = 0; i < this.from.length; i += 1) first.set(key(this.components[i], this.from[i]), i);
      this.successors = new Int32Array(this.from.length).fill(-1);
      this.succeeds = new Uint8Array(this.from.length);
      for (let i = 0; i < this.from.length; i += 1) {
        const after = this.lasts[i] > 0 ? first.get(key(this.components[i], this.from[i] + this.lasts[i])) : undefined;
        if (after === undefined) continue;
        this.successors[i] = after;
        this.succeeds[after] = 1;
      }
    }

    // Writes base, quaternion and size of a part at an age.
    evaluate(i, number, out, found) {
      seek(this.track, this.time, i, number, found);
      const { key, share } = found;
      for (let k = 0; k < 3; k += 1) {
        out[k] = mix(this.places[k], found);
        out[7 + k] =
          this.sizes[3 * key + k] + (share > 0 ? share * (this.sizes[3 * key + 3 + k] - this.sizes[3 * key + k]) : 0);
      }
      turnBetween(this.turns, 4 * key, share, out, 3);
    }

    colours(i, number, next) {
      const found = { key: 0, share: 0 };
      return [colourAt(this.tints, this.time, i, number, found), colourAt(this.tints, this.time, i, next, found)];
    }
  }

  // A quaternion between two that stand one after another, the shorter way round.
  function turnBetween(turns, at, share, out, to) {
    let sign = 1;
    if (share > 0) {
      let dot = 0;
      for (let k = 0; k < 4; k += 1) dot += turns[at + k] * turns[at + 4 + k];
      sign = dot < 0 ? -1 : 1;
    }
    let square = 0;
    for (let k = 0; k < 4; k += 1) {
      out[to + k] = share > 0 ? (1 - share) * turns[at + k] + sign * share * turns[at + 4 + k] : turns[at + k];
      square += out[to + k] * out[to + k];
    }
    const scale = square > 0 ? 1 / Math.sqrt(square) : 1;
    for (let k = 0; k < 4; k += 1) out[to + k] *= scale;
  }

  return { Wood, Parts };
})();
