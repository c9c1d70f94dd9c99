'use strict';
// The rows of `records`: which components have one at an age, and their values.

const Records = (() => {
  // The place of the last of some sorted ages that is not after an age, between two places.
  function lastUpTo(ages, first, end, age) {
    let low = first;
    let high = end;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (ages[middle] <= age) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  // The kept columns of a plant, by name.
  function readColumns(data, name, from) {
    const columns = new Map();
    const firstOf = ({ begin, values }, i) => (begin[i] < begin[i + 1] ? values[begin[i]] : -1);
    const kept = data.header.columns.filter((column) => column.kept);
    const read = (column, kinds) => {
      const stream = (of) => data.stream(`${name}.row.${kept.indexOf(column)}.${of}`);
      const begin = Data.starts(stream('counts'));
      const ages = Data.keyAges(begin, from, stream('ages'));
      const values = Data.keyValues(begin, stream('values'), column.holds === 'real' ? kinds : null);
      columns.set(column.name, { column, begin, ages, values });
    };
    read(kept.find((column) => column.name === 'kind'));
    const kinds = Int32Array.from(from, (_, i) => firstOf(columns.get('kind'), i));
    kept.filter((column) => column.name !== 'kind').forEach((column) => read(column, kinds));
    return columns;
  }

  class Table {
    constructor(data, plant, name) {
      this.header = data.header;
      this.plant = plant;
      this.from = Data.sums(data.stream(`${name}.row.from`));
      this.lasts = data.stream(`${name}.row.lasts`);
      this.columns = readColumns(data, name, this.from);
      this.kinds = this.firsts('kind');
      this.axes = this.firsts('axis_id');
      this.ranks = this.firsts('rank');
      this.ofAxis = null;
      this.rolls = this.readRolls(data, `${name}.row.roll`);
    }

    // How internodes are turned about their directions: whole numbers that hold to the next.
    readRolls(data, name) {
      const begin = Data.starts(data.stream(`${name}.counts`));
      const ages = Data.keyAges(begin, this.from, data.stream(`${name}.ages`));
      return { begin, ages, values: Data.keyValues(begin, data.stream(`${name}.values`), null) };
    }

    // The upper side of an internode that points along a unit vector, at the age of a number; null where it is not told.
    upper(component, number, [x, y, z]) {
      const { begin, ages, values } = this.rolls;
      const [first, end] = [begin[component], begin[component + 1]];
      if (first === end) return null;
      const roll = values[Math.max(lastUpTo(ages, first, end, number), first)];
      const steps = this.header.turn;
      const pole = roll < steps ? 1 : -1;
      const near = Math.max(1 + pole * z, Number.MIN_VALUE);
      // The axis x, turned as the vertical is turned into the direction along the shorter arc, and what is across both.
      const a = [1 - (x * x) / near, (-x * y) / near, -pole * x];
      const b = [y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0]];
      const turn = ((roll % steps) / steps) * 2 * Math.PI;
      return a.map((of, k) => Math.cos(turn) * of + Math.sin(turn) * b[k]);
    }

    get length() {
      return this.from.length;
    }

    // The first value of a column, of each component; −1 for none.
    firsts(name) {
      const { begin, values } = this.columns.get(name);
      return Int32Array.from(this.from, (_, i) => (begin[i] < begin[i + 1] ? values[begin[i]] : -1));
    }

    // Whether a component has a row at an age, by the number of the age.
    stands(component, number) {
      const from = this.from[component];
      const lasts = this.lasts[component];
      return from >= 0 && from <= number && (lasts === 0 || number < from + lasts);
    }

    // The value of a kept column at an age, which lies `share` of the way after that of a number; null for none.
    value(name, component, number, share) {
      const { column, begin, ages, values } = this.columns.get(name);
      const first = begin[component];
      const end = begin[component + 1];
      const key = Math.max(lastUpTo(ages, first, end, number), first);
      if (first === end || values[key] < 0) return null;
      if (column.holds !== 'real') return values[key];
      let place = values[key];
      if (key + 1 < end && place > 0 && values[key + 1] > 0) {
        const time = this.header.ages;
        const now = time[number] + share * ((time[number + 1] ?? time[number]) - time[number]);
        const part = (now - time[ages[key]]) / (time[ages[key + 1]] - time[ages[key]]);
        place += Math.min(Math.max(part, 0), 1) * (values[key + 1] - place);
      }
      return Data.measure(this.header, place);
    }

    // How many components of each kind have a row at an age.
    counts(number) {
      const counts = new Array(this.header.kinds.length).fill(0);
      for (let i = 0; i < this.length; i += 1) {
        if (this.kinds[i] >= 0 && this.stands(i, number)) counts[this.kinds[i]] += 1;
      }
      return counts;
    }

    // The same at every age: a list of counts for each kind.
    countsOfAllAges() {
      const ages = this.header.ages.length;
      const counts = this.header.kinds.map(() => new Int32Array(ages + 1));
      for (let i = 0; i < this.length; i += 1) {
        if (this.from[i] < 0 || this.kinds[i] < 0) continue;
        counts[this.kinds[i]][this.from[i]] += 1;
        if (this.lasts[i] > 0) counts[this.kinds[i]][this.from[i] + this.lasts[i]] -= 1;
      }
      return counts.map((of) => Data.sums(of).subarray(0, ages));
    }

    // The internodes of an axis, in the order of their ranks.
    internodes(axis) {
      if (this.ofAxis === null) {
        this.ofAxis = new Map();
        for (let i = 0; i < this.length; i += 1) {
          if (this.kinds[i] < 0 || this.header.kinds[this.kinds[i]][1] !== 'Internode') continue;
          const known = this.ofAxis.get(this.axes[i]);
          if (known) known.push(i);
          else this.ofAxis.set(this.axes[i], [i]);
        }
        const rank = (component) => this.ranks[component];
        this.ofAxis.forEach((list) => list.sort((a, b) => rank(a) - rank(b)));
      }
      return this.ofAxis.get(axis) ?? [];
    }

    // The least and the largest value of a kept column over the whole life.
    range(name) {
      const { column, values } = this.columns.get(name);
      let low = Infinity;
      let high = -Infinity;
      for (let i = 0; i < values.length; i += 1) {
        if (values[i] < 0) continue;
        low = Math.min(low, values[i]);
        high = Math.max(high, values[i]);
      }
      const told = (value) => (column.holds === 'real' ? Data.measure(this.header, value) : value);
      return high < low ? null : [told(low), told(high)];
    }
  }

  return { Table, lastUpTo };
})();
