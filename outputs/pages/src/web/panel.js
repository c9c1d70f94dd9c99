'use strict';
// Everything beside the picture: counts, kinds, columns, a component's row, events and the strip above the slider.

const Panel = (() => {
  const at = (id) => document.getElementById(id);
  const SVG = 'http://www.w3.org/2000/svg';

  function make(name, words, attributes = {}) {
    const element = document.createElement(name);
    if (words !== undefined) element.textContent = words;
    Object.entries(attributes).forEach(([key, value]) => element.setAttribute(key, value));
    return element;
  }

  function draw(name, attributes) {
    const element = document.createElementNS(SVG, name);
    Object.entries(attributes).forEach(([key, value]) => element.setAttribute(key, value));
    return element;
  }

  const hex = (colour) =>
    `#${[colour & 255, (colour >> 8) & 255, (colour >> 16) & 255].map((x) => x.toString(16).padStart(2, '0')).join('')}`;

  class Side {
    constructor(scene, tell) {
      this.scene = scene;
      this.header = scene.header;
      this.tell = tell;
      this.chosen = null;
      this.countsOf = scene.plants.map(({ table }) => table.countsOfAllAges());
      this.makeKinds();
      this.makeColumns();
      this.makeFind();
      this.makeEvents();
      this.makeStrip();
      at('title').textContent = this.header.title;
      at('note').textContent =
        `${this.header.note}. Within ${Values.told(1000 * this.header.tolerance_m)} mm of the plants. phytomer ${this.header.version}.`;
    }

    // How many components of a kind all plants have at an age.
    count(kind, number) {
      return this.countsOf.reduce((sum, counts) => sum + counts[kind][number], 0);
    }

    // The number of the age at which the plants are shown first: the last with nine tenths of the most leaves and
    // flowers, else of the most of all.
    prime() {
      const { ages, kinds } = this.header;
      const counts = (chosen) =>
        ages.map((_, number) => chosen.reduce((sum, kind) => sum + this.count(kind, number), 0));
      const leafy = counts(this.present().filter((kind) => ['Leaf', 'Flower'].includes(kinds[kind][1])));
      const of = Math.max(...leafy) > 0 ? leafy : counts(this.present());
      return of.findLastIndex((count) => count >= 0.9 * Math.max(...of));
    }

    present() {
      return this.header.kinds
        .map((_, kind) => kind)
        .filter((kind) => this.countsOf.some((counts) => counts[kind].some((count) => count > 0)));
    }

    makeKinds() {
      const body = at('kinds').tBodies[0];
      this.cells = new Map();
      for (const kind of this.present()) {
        const [tag, ofClass] = this.header.kinds[kind];
        const [row, head, cell, label] = [
          make('tr'),
          make('th', undefined, { scope: 'row' }),
          make('td'),
          make('label'),
        ];
        if (ofClass === 'Bud') head.textContent = Values.words(tag);
        else {
          const box = make('input', undefined, { type: 'checkbox' });
          box.checked = true;
          box.addEventListener('change', () => {
            if (box.checked) this.scene.hidden.delete(kind);
            else this.scene.hidden.add(kind);
            this.tell('scene');
          });
          label.append(box, ` ${Values.words(tag)}`);
          head.append(label);
        }
        row.append(head, cell);
        body.append(row);
        this.cells.set(kind, cell);
      }
    }

    makeColumns() {
      const select = at('columns');
      select.append(make('option', 'what they are', { value: '' }));
      for (const column of this.header.columns) select.append(make('option', column.name, { value: column.name }));
      select.addEventListener('change', () => this.colourBy(select.value));
    }

    colourBy(name) {
      this.scene.colouring = name === '' ? null : new Values.Colouring(this.scene, name);
      at('columns').value = name;
      const colouring = this.scene.colouring;
      at('column-words').textContent = colouring
        ? colouring.column.description + (colouring.logarithmic ? ' The scale is logarithmic.' : '')
        : '';
      const entries = colouring ? colouring.legend(name === 'kind' ? new Set(this.present()) : null) : [];
      at('legend').replaceChildren(
        ...entries.map(([colour, words]) => {
          const [item, patch] = [make('li'), draw('svg', { width: 22, height: 14, 'aria-hidden': 'true' })];
          patch.append(draw('rect', { width: 22, height: 14, fill: hex(colour) }));
          item.append(patch, words);
          return item;
        }),
      );
      this.tell('scene');
    }

    makeFind() {
      const { plants } = this.scene;
      at('of-plants').hidden = plants.length < 2;
      plants.forEach(({ plant }, of) => at('plant').append(make('option', plant.name, { value: of })));
      at('find').addEventListener('submit', (event) => {
        event.preventDefault();
        this.ask(Number(at('number').value));
      });
      at('before').addEventListener('click', () => this.step(-1));
      at('after').addEventListener('click', () => this.step(1));
    }

    ask(component) {
      const of = Number(at('plant').value) || 0;
      const { table } = this.scene.plants[of];
      if (!Number.isInteger(component) || component < 0 || component >= table.length) {
        this.say(`There is no such component: their numbers are 0 to ${table.length - 1}.`);
        return;
      }
      this.choose(of, component);
    }

    // The next component that stands, in the order of their numbers.
    step(by) {
      const of = this.chosen?.of ?? (Number(at('plant').value) || 0);
      const { table } = this.scene.plants[of];
      const from = this.chosen?.component ?? (by > 0 ? -1 : table.length);
      for (let i = from + by; i >= 0 && i < table.length; i += by) {
        if (table.stands(i, this.number)) {
          this.choose(of, i);
          return;
        }
      }
    }

    say(words) {
      at('component-words').textContent = words;
      at('live').textContent = words;
    }

    choose(of, component) {
      this.chosen = { of, component };
      at('plant').value = of;
      at('number').value = component;
      at('component-part').open = true;
      this.showRow(this.number, this.share);
      this.tell('chosen');
      at('live').textContent = at('component-words').textContent;
    }

    // The row of the chosen component at the present age.
    showRow(number, share) {
      if (!this.chosen) return;
      const { of, component } = this.chosen;
      const one = this.scene.plants[of];
      const { table } = one;
      const { ages } = this.header;
      const kind = table.kinds[component];
      const name = kind >= 0 ? Values.words(this.header.kinds[kind][0]) : 'component';
      const body = at('row').tBodies[0];
      if (!table.stands(component, number)) {
        const from = table.from[component];
        const ends = table.lasts[component] > 0 ? ` to before ${ages[from + table.lasts[component]]}` : ' on';
        at('component-words').textContent =
          from < 0
            ? `Component ${component} has no row at any of these ages.`
            : `Component ${component}, a ${name}, does not stand at this age: it does from ${ages[from]}${ends}.`;
        body.replaceChildren();
        return;
      }
      at('component-words').textContent = `Component ${component}, a ${name} at ${at('caption').textContent}`;
      const drawn = this.scene.placeOf(of, component, number, share);
      body.replaceChildren(
        ...this.header.columns.map((column) => {
          const value = Values.valueOf(one, column.name, component, number, share, drawn);
          const row = make('tr', undefined, { title: column.description, 'data-column': column.name });
          row.append(make('th', column.name, { scope: 'row' }), make('td', Values.inWords(column, value)));
          if (Number.isInteger(value) && !Array.isArray(column.holds)) row.lastChild.dataset.value = value;
          return row;
        }),
      );
    }

    // What happens at which age: what first appears, and what buds do.
    makeEvents() {
      const { ages, captions, events } = this.header;
      const firsts = this.present().map((kind) => [
        ages.findIndex((_, number) => this.count(kind, number) > 0),
        `first ${Values.words(this.header.kinds[kind][0])}`,
      ]);
      const counted = events.map(([age, what, count]) => [
        ages.indexOf(age),
        `${count} ${count === 1 ? 'bud or axis' : 'buds or axes'} ${Values.words(what)}`,
        what,
      ]);
      this.marks = [
        ...firsts.filter(([number]) => number > 0),
        ...counted.filter(([, , what]) => !['grew', 'paused', 'branched'].includes(what)),
      ];
      const all = [...firsts, ...counted].filter(([number]) => number >= 0).sort(([a], [b]) => a - b);
      const byAge = new Map();
      for (const [number, words] of all) byAge.set(number, [...(byAge.get(number) ?? []), words]);
      this.byAge = byAge;
      at('events').replaceChildren(
        ...[...byAge].map(([number, words]) => {
          const [item, button] = [
            make('li'),
            make('button', `${captions[number]}: ${words.join(', ')}`, { type: 'button' }),
          ];
          button.addEventListener('click', () => this.tell('age', ages[number]));
          item.append(button);
          return item;
        }),
      );
    }

    // How many leaves, flowers and fruits there are at each age, and marks for events.
    makeStrip() {
      const { ages, kinds } = this.header;
      const [first, last] = [ages[0], ages.at(-1)];
      const x = (age) => (last > first ? (1000 * (age - first)) / (last - first) : 0);
      const strip = at('strip');
      for (const [ofClass, fill] of [
        ['Internode', '#cbb9a1'],
        ['Leaf', '#8fb57a'],
        ['Flower', '#d98cae'],
        ['Fruit', '#d8743a'],
      ]) {
        const counts = ages.map((_, number) =>
          this.present()
            .filter((kind) => kinds[kind][1] === ofClass)
            .reduce((sum, kind) => sum + this.count(kind, number), 0),
        );
        const most = Math.max(...counts);
        if (most === 0) continue;
        const share = ofClass === 'Leaf' || ofClass === 'Internode' ? 30 : 18;
        const way = counts
          .map((count, number) => `L${x(ages[number]).toFixed(1)},${(38 - (share * count) / most).toFixed(1)}`)
          .join('');
        strip.append(
          draw('path', { d: `M0,38${way}L1000,38Z`, fill, 'fill-opacity': ofClass === 'Internode' ? 0.55 : 0.75 }),
        );
      }
      const marked = [...new Set(this.marks.map(([number]) => number))].filter((number) => number >= 0);
      if (marked.length < 200)
        for (const number of marked)
          strip.append(
            draw('path', {
              d: `M${x(ages[number]).toFixed(1)},0V5`,
              stroke: '#6a6f66',
              'vector-effect': 'non-scaling-stroke',
            }),
          );
      this.now = draw('path', { stroke: '#2a2d28', 'vector-effect': 'non-scaling-stroke', class: 'now' });
      strip.append(this.now);
      this.x = x;
    }

    // Shows the counts of an age, and tells them to who listens once it rests.
    show(number, share, resting) {
      this.number = number;
      this.share = share;
      const { ages, captions, kinds } = this.header;
      const age = ages[number] + share * ((ages[number + 1] ?? ages[number]) - ages[number]);
      const told = Number(age.toFixed(Number.isInteger(ages[number]) ? 1 : 2));
      at('caption').textContent = share > 0 ? captions[number].replace(/\d+(\.\d+)?/, told) : captions[number];
      this.now.setAttribute('d', `M${this.x(age).toFixed(1)},0V40`);
      const standing = [];
      for (const [kind, cell] of this.cells) {
        const count = this.count(kind, number);
        const words = String(count);
        if (cell.textContent !== words) cell.textContent = words;
        if (count > 0) standing.push(`${words} ${Values.words(kinds[kind][0])}${count === 1 ? '' : 's'}`);
      }
      at('age').setAttribute('aria-valuetext', captions[number]);
      this.showRow(number, share);
      if (resting) {
        const happened = this.byAge.get(number);
        at('live').textContent =
          `${captions[number]}: ${standing.join(', ') || 'nothing stands'}.${happened ? ` ${happened.join(', ')}.` : ''}`;
        at('canvas').setAttribute(
          'aria-label',
          `Picture of ${this.header.title} at ${captions[number]}: ${standing.join(', ')}`,
        );
      }
    }
  }

  return { Side, at, make };
})();
