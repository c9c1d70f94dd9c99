'use strict';
// The values of every column of `records` for what is drawn, and their colours: those of `phytomer picture`.

const Values = (() => {
  const NOTHING = [188, 184, 178];
  const CLASSES = [
    [0, 114, 178],
    [230, 159, 0],
    [0, 158, 115],
    [213, 94, 0],
    [86, 180, 233],
    [204, 121, 167],
    [240, 228, 66],
    [96, 96, 96],
  ];
  // Lightness, chroma and hue in Oklab, evenly along the ramp.
  const RAMP = [
    [0.31, 0.135, 305],
    [0.43, 0.125, 275],
    [0.55, 0.095, 228],
    [0.67, 0.115, 172],
    [0.79, 0.155, 138],
    [0.92, 0.165, 105],
  ];
  // From this ratio of the largest to the smallest amount on the scale is logarithmic.
  const WIDE = 200;
  const PLACES = ['x_m', 'y_m', 'z_m'];
  const HEADINGS = ['dir_x', 'dir_y', 'dir_z'];
  const UPPER = ['up_x', 'up_y', 'up_z'];

  function ramp(share) {
    const place = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1);
    const first = Math.min(Math.floor(place), RAMP.length - 2);
    const [l, chroma, hue] = [0, 1, 2].map(
      (k) => RAMP[first][k] + (place - first) * (RAMP[first + 1][k] - RAMP[first][k]),
    );
    const [a, b] = [Math.cos, Math.sin].map((of) => chroma * of((hue * Math.PI) / 180));
    const [m, n, s] = [
      [0.39633778, 0.21580376],
      [-0.10556135, -0.06385417],
      [-0.08948418, -1.2914855],
    ].map(([x, y]) => (l + x * a + y * b) ** 3);
    const light = [
      4.0767417 * m - 3.3077116 * n + 0.23096994 * s,
      -1.268438 * m + 2.6097574 * n - 0.3413194 * s,
      -0.0041960863 * m - 0.70341861 * n + 1.7076147 * s,
    ];
    return light.map((x) => {
      const within = Math.min(Math.max(x, 0), 1);
      return Math.round(255 * (within <= 0.0031308 ? 12.92 * within : 1.055 * within ** (1 / 2.4) - 0.055));
    });
  }

  const packed = ([red, green, blue]) => red | (green << 8) | (blue << 16);
  const words = (text) => text.replace(/_/g, ' ');
  const STEPS = Array.from({ length: 256 }, (_, step) => packed(ramp(step / 255)));

  // A number with three digits that count.
  function told(value) {
    if (value === null || value === undefined) return '–';
    if (Number.isInteger(value)) return String(value);
    const size = Math.abs(value);
    if (size >= 1e5 || size < 1e-4) return value === 0 ? '0' : value.toExponential(2);
    return String(Number(value.toPrecision(3)));
  }

  // A way to colour by a column: what colour a value has, and a legend.
  class Colouring {
    constructor(scene, name) {
      this.scene = scene;
      this.column = scene.header.columns.find((column) => column.name === name);
      this.name = name;
      const { holds } = this.column;
      const ofPlants = scene.plants
        .map(({ plant }) => Object.fromEntries(plant.constants)[name])
        .filter((value) => value !== undefined);
      if (Array.isArray(holds)) this.classes = holds;
      else if (holds === 'truth') this.classes = ['dead', 'alive'];
      else if (ofPlants.some((value) => typeof value === 'string')) this.classes = [...new Set(ofPlants)];
      else [this.low, this.high] = this.rangeOf(ofPlants) ?? [0, 1];
      if (name === 'order') this.classes = Array.from({ length: this.high + 1 }, (_, order) => `order ${order}`);
      this.logarithmic = !this.classes && holds === 'real' && this.low > 0 && this.high / this.low > WIDE;
    }

    rangeOf(ofPlants) {
      const { scene, name } = this;
      if (ofPlants.length > 0) return [Math.min(...ofPlants), Math.max(...ofPlants)];
      const [low, high] = scene.box;
      if (PLACES.includes(name)) return [low[PLACES.indexOf(name)], high[PLACES.indexOf(name)]];
      if (HEADINGS.includes(name) || UPPER.includes(name)) return [-1, 1];
      if (name === 'tick' || name === 'age') return [scene.header.ages[0], scene.header.ages.at(-1)];
      if (name === 'component_id') return [0, Math.max(...scene.plants.map(({ table }) => table.length - 1))];
      const ranges = scene.plants.map(({ table }) => table.range(name)).filter((range) => range !== null);
      if (ranges.length === 0) return null;
      const least = Math.min(...ranges.map(([least]) => least));
      // Nothing has no place on a logarithmic scale.
      return [least, Math.max(...ranges.map(([, most]) => most))];
    }

    // The colour of a value, as three bytes.
    colour(value) {
      if (value === null || value === undefined) return packed(NOTHING);
      if (this.classes) {
        const place = typeof value === 'string' ? this.classes.indexOf(value) : value;
        return packed(CLASSES[(this.name === 'order' ? Math.max(place - 1, 0) : place) % CLASSES.length]);
      }
      const scale = this.logarithmic ? Math.log : (x) => x;
      const [low, high] = [scale(this.low), scale(this.high)];
      const share = high > low ? (scale(value) - low) / (high - low) : 0.5;
      return STEPS[Math.round(255 * Math.min(Math.max(Number.isFinite(share) ? share : 0, 0), 1))];
    }

    // The entries of the legend: colour and words.
    legend(present) {
      if (this.classes) {
        return this.classes
          .map((name, place) => [
            this.colour(
              typeof name === 'string' && this.column.holds === 'whole' && this.name !== 'order' ? name : place,
            ),
            words(name),
            place,
          ])
          .filter(([, , place]) => (this.name === 'order' ? place > 0 : !present || present.has(place)));
      }
      const scale = (share) =>
        this.logarithmic ? this.low * (this.high / this.low) ** share : this.low + share * (this.high - this.low);
      return [0, 0.25, 0.5, 0.75, 1].map((share) => [
        STEPS[Math.round(255 * share)],
        `${told(scale(share))} ${this.column.unit}`,
      ]);
    }
  }

  // The value of any column of what is drawn: `drawn` has its place, its direction and its upper side.
  function valueOf({ plant, table }, name, component, number, share, drawn) {
    const constant = plant.constants.find(([known]) => known === name);
    if (constant) return constant[1];
    if (name === 'component_id') return component;
    const { ages } = table.header;
    const now = ages[number] + share * ((ages[number + 1] ?? ages[number]) - ages[number]);
    if (name === 'tick') return Math.floor(now);
    if (name === 'age') return Math.floor(now - plant.sown);
    for (const [names, of] of [
      [PLACES, 'place'],
      [HEADINGS, 'heading'],
      [UPPER, 'upper'],
    ]) {
      const k = names.indexOf(name);
      if (k >= 0) return drawn?.[of]?.[k] ?? null;
    }
    return table.columns.has(name) ? table.value(name, component, number, share) : null;
  }

  // The same in words.
  function inWords(column, value) {
    if (value === null || value === undefined) return '–';
    if (Array.isArray(column.holds)) return words(column.holds[value] ?? '–');
    if (column.holds === 'truth') return value > 0 ? 'yes' : 'no';
    return typeof value === 'number' ? `${told(value)} ${column.unit === 'tick' ? '' : column.unit}`.trim() : value;
  }

  return { Colouring, valueOf, inWords, told, words };
})();
