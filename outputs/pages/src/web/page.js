'use strict';
// The page: time, the eye, keys, mouse and touch.

const Page = (() => {
  const { at } = Panel;
  const SPEEDS = [0.5, 1, 2, 4, 8, 16, 32];

  class Life {
    constructor(data, gl) {
      this.header = data.header;
      this.ages = data.header.ages;
      this.scene = new Scenery.Scene(data);
      this.painter = gl ? new Drawing.Painter(gl, data.header) : null;
      this.age = this.ages[0];
      this.spanned = null;
      this.playing = false;
      this.id = -1;
      this.side = new Panel.Side(this.scene, (what, value) => this.told(what, value));
      this.reset();
      this.listen();
      this.setAge(this.askedAge() ?? this.ages[this.side.prime()], true);
    }

    told(what, value) {
      if (what === 'age') this.setAge(value, true);
      if (what === 'scene') this.spanned = null;
      this.render();
    }

    // The number of the last age that is not after the present one, and the share of the way to the next.
    where() {
      let number = Math.max(Records.lastUpTo(this.ages, 0, this.ages.length, this.age), 0);
      const [from, to] = [this.ages[number], this.ages[number + 1]];
      if (to === undefined) return [number, 0];
      return [number, Math.min((this.age - from) / (to - from), 1)];
    }

    setAge(age, resting = false) {
      const [first, last] = [this.ages[0], this.ages.at(-1)];
      this.age = Math.min(Math.max(age, first), last);
      at('age').value = this.age;
      const [number, share] = this.where();
      this.side.show(number, share, resting);
      if (resting) history.replaceState(null, '', `#age=${Number(this.age.toFixed(2))}`);
      this.render();
    }

    askedAge() {
      const asked = /^#age=(-?[0-9.]+)$/.exec(location.hash);
      return asked && Number.isFinite(Number(asked[1])) ? Number(asked[1]) : null;
    }

    // Steps to a neighbour among the ages.
    stepAge(by) {
      const [number, share] = this.where();
      const next = by < 0 && share > 0 ? number + by + 1 : number + by;
      this.setAge(this.ages[Math.min(Math.max(next, 0), this.ages.length - 1)], true);
    }

    play(on) {
      if (on && this.age >= this.ages.at(-1)) this.setAge(this.ages[0]);
      this.playing = on;
      at('play').setAttribute('aria-pressed', on);
      at('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
      at('play').textContent = on ? '❚❚' : '▶';
      this.before = performance.now();
      if (on) requestAnimationFrame((now) => this.tick(now));
      else this.setAge(this.age, true);
    }

    tick(now) {
      if (!this.playing) return;
      const speed = Number(at('speed').value);
      const age = this.age + (speed * Math.min(now - this.before, 250)) / 1000;
      this.before = now;
      this.setAge(age);
      if (this.age >= this.ages.at(-1)) this.play(false);
      else requestAnimationFrame((then) => this.tick(then));
    }

    reset() {
      const [low, high] = this.scene.box;
      this.reach = Math.max(...[0, 1, 2].map((k) => high[k] - low[k]));
      this.target = this.scene.middle.slice();
      this.yaw = -60;
      // What is wide is seen from a little higher.
      this.pitch = this.reach > 1.8 * (high[2] - low[2]) ? 18 : 7;
      this.zoom = 1;
      this.sun = this.sun ?? [this.yaw + 222, 48];
      at('azimuth').value = (this.sun[0] + 360) % 360;
      at('elevation').value = this.sun[1];
    }

    // What the eye sees: everything that the drawing must know of a frame.
    view() {
      const canvas = at('canvas');
      const [width, height] = [canvas.width, canvas.height];
      const axes = Light.gaze(Light.towards(this.yaw + 180, -this.pitch));
      const { box } = this.scene;
      const { middle } = this.scene;
      const away = Light.distanceFor(this.scene.outline, width / height, this.pitch) / this.zoom;
      const eye = this.target.map((x, k) => x - away * axes[2][k]);
      const near = Math.max(away - 1.2 * this.reach, away / 200);
      const lens = Light.perspective(Light.HALF, width / height, near, away + 60 * this.reach);
      const sun = Light.towards(...this.sun);
      const sunAxes = Light.gaze(sun.map((x) => -x));
      const ball = 0.5 * Math.hypot(...[0, 1, 2].map((k) => box[1][k] - box[0][k]));
      const sunCamera = Light.times(Light.parallel(ball, 1.5 * ball), Light.seenFrom(middle, sunAxes));
      return {
        camera: Light.times(lens, Light.seenFrom(eye, axes)),
        eye,
        sun,
        sunCamera,
        width,
        height,
        axes,
        away,
        texel: this.painter ? (2 * ball) / this.painter.shadowSize : 0,
        casts: at('casts').checked,
        ground: at('ground').checked,
        stained: this.scene.colouring !== null,
        chosen: this.id,
        middle: [middle[0], middle[1], 0],
        reach: this.reach,
        share: this.spanned ? this.spanned.share : 0,
      };
    }

    // Draws as soon as the browser shows a frame, once for all that has changed.
    render() {
      if (!this.painter || this.waits) return;
      this.waits = true;
      requestAnimationFrame(() => {
        this.waits = false;
        this.paint();
      });
    }

    paint() {
      this.resize();
      const [number, share] = this.where();
      if (!this.spanned || this.spanned.number !== number) {
        const next = Math.min(number + 1, this.ages.length - 1);
        this.painter.take(this.scene.span(number, next));
        // While it plays, the light of the sky follows a few times a second.
        const now = performance.now();
        if (!this.playing || !this.lightened || now - this.lightened > 400) {
          this.painter.takeSky(this.scene.crown);
          this.lightened = now;
        }
        this.spanned = { number };
      }
      this.spanned.share = share;
      this.id = this.side.chosen ? this.scene.numberOf(this.side.chosen.of, this.side.chosen.component) : -1;
      const view = this.view();
      this.painter.draw(view);
      this.showRule(view);
      document.documentElement.dataset.drawn = String(this.age);
    }

    resize() {
      const canvas = at('canvas');
      const scale = Math.min(window.devicePixelRatio || 1, 2);
      const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) =>
        Math.max(Math.round(side * scale), 1),
      );
      if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    }

    // A rule of a round length at the distance of the middle.
    showRule({ away, height }) {
      const perMetre = at('canvas').clientHeight / (2 * Light.HALF * away);
      const length = 110 / perMetre;
      const power = 10 ** Math.floor(Math.log10(length));
      const round = [5, 2, 1].map((x) => x * power).find((x) => x <= length) ?? power;
      at('rule-line').style.width = `${round * perMetre}px`;
      at('rule-text').textContent =
        round >= 1
          ? `${round} m`
          : round >= 0.01
            ? `${Number((100 * round).toPrecision(1))} cm`
            : `${Number((1000 * round).toPrecision(1))} mm`;
    }

    // The component at a place of the picture.
    pick(x, y) {
      const canvas = at('canvas');
      const scale = canvas.width / canvas.clientWidth;
      const view = this.view();
      const [px, py] = [Math.floor(x * scale), Math.floor(canvas.height - y * scale)];
      const id = this.painter.numberAt(view, px, py);
      const found = this.scene.found(id);
      if (!found) {
        this.side.chosen = null;
        at('row').tBodies[0].replaceChildren();
        at('component-words').textContent = 'Nothing stands there.';
      } else {
        const component =
          found.point === undefined
            ? found.component
            : this.scene.internodeAt(found, this.scene.shareAt(found, view, px, py));
        this.side.choose(found.of, component);
      }
      this.render();
    }

    save() {
      this.paint();
      at('canvas').toBlob((blob) => {
        const link = Panel.make('a', undefined, { download: `${this.header.run}-${Number(this.age.toFixed(2))}.png` });
        link.href = URL.createObjectURL(blob);
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 1000);
      });
    }

    listen() {
      const slider = at('age');
      [slider.min, slider.max] = [this.ages[0], this.ages.at(-1)];
      slider.addEventListener('input', () => this.setAge(this.snapped(Number(slider.value))));
      slider.addEventListener('change', () => this.setAge(this.age, true));
      slider.addEventListener('keydown', (event) => this.sliderKey(event));
      const whole = (this.ages.at(-1) - this.ages[0]) / 12;
      const usual = SPEEDS.reduce((best, speed) => (Math.abs(speed - whole) < Math.abs(best - whole) ? speed : best));
      for (const speed of SPEEDS) at('speed').append(Panel.make('option', `${speed} a second`, { value: speed }));
      at('speed').value = usual;
      at('play').addEventListener('click', () => this.play(!this.playing));
      at('reset').addEventListener('click', () => {
        this.reset();
        this.render();
      });
      at('save').addEventListener('click', () => this.save());
      for (const id of ['casts', 'ground']) at(id).addEventListener('change', () => this.render());
      ['azimuth', 'elevation'].forEach((id, k) =>
        at(id).addEventListener('input', () => {
          this.sun[k] = Number(at(id).value);
          this.render();
        }),
      );
      window.addEventListener('hashchange', () => this.setAge(this.askedAge() ?? this.age, true));
      window.addEventListener('resize', () => this.render());
      document.addEventListener('keydown', (event) => this.key(event));
      if (this.painter) Gestures.listen(this);
    }

    // Near an age the slider holds it.
    snapped(age) {
      const apart = (this.ages.at(-1) - this.ages[0]) / 400;
      const near = this.ages.find((known) => Math.abs(known - age) < apart);
      return near ?? age;
    }

    sliderKey(event) {
      const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
      if (by === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      this.stepAge(by);
    }

    key(event) {
      const { tagName, type } = event.target;
      if (event.ctrlKey || event.metaKey || event.altKey || tagName === 'SELECT') return;
      if (tagName === 'INPUT' && type !== 'range' && type !== 'checkbox') return;
      const onPicture = event.target === at('canvas');
      const turns = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 4], ArrowDown: [0, -4] };
      const moves = { a: [-1, 0], d: [1, 0], w: [0, 1], s: [0, -1] };
      const acts = {
        ',': () => this.stepAge(-1),
        '.': () => this.stepAge(1),
        PageUp: () => this.stepAge(10),
        PageDown: () => this.stepAge(-10),
        Home: () => this.setAge(this.ages[0], true),
        End: () => this.setAge(this.ages.at(-1), true),
        '+': () => this.nearer(1.15),
        '=': () => this.nearer(1.15),
        '-': () => this.nearer(1 / 1.15),
        0: () => this.reset(),
        p: () => this.save(),
      };
      if (event.key === ' ' && tagName !== 'BUTTON' && tagName !== 'SUMMARY' && type !== 'checkbox')
        this.play(!this.playing);
      else if (turns[event.key] && onPicture) this.turn(...turns[event.key]);
      else if (moves[event.key]) this.move(...moves[event.key].map((x) => 0.04 * x));
      else if (
        acts[event.key] &&
        (onPicture || !['PageUp', 'PageDown', 'Home', 'End'].includes(event.key) || event.target === document.body)
      )
        acts[event.key]();
      else return;
      event.preventDefault();
      this.render();
    }

    turn(yaw, pitch) {
      this.yaw += yaw;
      this.pitch = Math.min(Math.max(this.pitch + pitch, -30), 89);
    }

    nearer(times) {
      this.zoom = Math.min(Math.max(this.zoom * times, 0.2), 400);
    }

    // Moves the plants by shares of the height of the picture.
    move(right, up) {
      const { axes, away } = this.view();
      const scale = 2 * Light.HALF * away;
      this.target = this.target.map((x, k) => x - scale * (right * axes[0][k] + up * axes[1][k]));
    }
  }

  async function begin() {
    const canvas = at('canvas');
    const gl = canvas.getContext('webgl2', { antialias: true, alpha: false, powerPreference: 'high-performance' });
    if (!gl) {
      at('sorry').hidden = false;
      at('sorry').textContent =
        'This browser has no WebGL 2, or it is switched off, so the plants cannot be drawn here. The counts, the events and the row of each component beside this text work without it.';
      canvas.hidden = true;
    }
    const data = await Data.read(at('data'));
    at('data').remove();
    const life = new Life(data, gl);
    at('waiting').hidden = true;
    document.documentElement.dataset.ready = 'true';
    return life;
  }

  begin().catch((error) => {
    at('waiting').hidden = true;
    at('sorry').hidden = false;
    at('sorry').textContent = `The page cannot be shown: ${error.message}`;
    throw error;
  });
  return {};
})();
