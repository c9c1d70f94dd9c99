'use strict';
// Draws a span of ages by WebGL 2: wood as tubes that are built here, parts as instances of their forms.

const Drawing = (() => {
  const POINT = 48; // Bytes of a point: place and radius at both ages, colours at both ages, room.
  const PART = 76; // Bytes of a part: bases, turns, sizes, fullness, colours.
  const SIDES = [3, 4, 5, 7, 10, 16, 28];
  const SCALES = { width: 0, length: 1, share: 2, tube: 3, each: 4 };

  function compile(gl, vertex, fragment) {
    const program = gl.createProgram();
    for (const [type, text] of [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment],
    ]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      const shaders = gl.getAttachedShaders(program).map((shader) => gl.getShaderInfoLog(shader));
      throw new Error([gl.getProgramInfoLog(program), ...shaders].join('\n'));
    }
    const places = new Map();
    const place = (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name);
    };
    return { program, place };
  }

  // A tube of so many sides, as a strip around it: cosine, sine, and which end.
  function tube(sides) {
    const corners = [];
    for (let k = 0; k <= sides; k += 1) {
      const angle = (2 * Math.PI * (k % sides)) / sides;
      for (const end of [0, 1]) corners.push(Math.cos(angle), Math.sin(angle), end);
    }
    return new Float32Array(corners);
  }

  // The corners of a form; all but the last of the ten numbers of each are in ten-thousandths.
  const cornersOf = (form) => Float32Array.from(form.corners, (x, i) => (i % 10 === 9 ? x : x / 1e4));

  class Painter {
    constructor(gl, header) {
      this.gl = gl;
      // Obstacles come after the forms of the plants.
      this.forms = [...header.forms, ...header.solids].map((form) => this.formOf(form));
      this.tubes = SIDES.map((sides) => ({ sides, buffer: this.buffer(tube(sides)), count: 2 * (sides + 1) }));
      this.programs = {
        wood: compile(gl, Shaders.WOOD, Shaders.SHADE),
        part: compile(gl, Shaders.PART, Shaders.SHADE),
        wood_depth: compile(gl, Shaders.WOOD, Shaders.DEPTH),
        part_depth: compile(gl, Shaders.PART, Shaders.DEPTH),
        wood_number: compile(gl, Shaders.WOOD, Shaders.NUMBER),
        part_number: compile(gl, Shaders.PART, Shaders.NUMBER),
        sky: compile(gl, Shaders.BACK, Shaders.SKY),
        ground: compile(gl, Shaders.GROUND, Shaders.EARTH),
      };
      this.square = this.buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
      this.woodBuffer = gl.createBuffer();
      this.partBuffer = gl.createBuffer();
      this.woodArray = gl.createVertexArray();
      this.partArray = gl.createVertexArray();
      this.backArray = gl.createVertexArray();
      this.classes = [];
      this.groups = [];
      this.shadowSize = Math.min(2048, gl.getParameter(gl.MAX_TEXTURE_SIZE));
      this.makeTargets();
      gl.enable(gl.DEPTH_TEST);
    }

    buffer(values, target = this.gl.ARRAY_BUFFER) {
      const buffer = this.gl.createBuffer();
      this.gl.bindBuffer(target, buffer);
      this.gl.bufferData(target, values, this.gl.STATIC_DRAW);
      return buffer;
    }

    formOf(form) {
      this.gl.bindVertexArray(null);
      return {
        thin: form.thin,
        scale: SCALES[form.scale],
        inParts: form.in_parts === true,
        stalk: form.of_internode ? [-1, 0, 0] : form.stalk.map((x) => x / 255),
        corners: this.buffer(cornersOf(form)),
        tints: form.tints ? this.buffer(Uint8Array.from(form.tints)) : null,
        faces: this.buffer(new Uint32Array(form.faces.flat()), this.gl.ELEMENT_ARRAY_BUFFER),
        count: 3 * form.faces.length,
      };
    }

    makeTargets() {
      const { gl } = this;
      this.shadow = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, this.shadow);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, this.shadowSize, this.shadowSize);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
      for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
        gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
      this.shadowTarget = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.shadow, 0);
      this.numberTarget = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.numberTarget);
      const [colour, depth] = [gl.createRenderbuffer(), gl.createRenderbuffer()];
      gl.bindRenderbuffer(gl.RENDERBUFFER, colour);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, 5, 5);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, colour);
      gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, 5, 5);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      this.sky = gl.createTexture();
    }

    // Takes the points of a span, class by class of sides, and its parts, form by form.
    take(scene) {
      const { gl } = this;
      gl.bindBuffer(gl.ARRAY_BUFFER, this.woodBuffer);
      gl.bufferData(gl.ARRAY_BUFFER, scene.wood, gl.DYNAMIC_DRAW);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.partBuffer);
      gl.bufferData(gl.ARRAY_BUFFER, scene.parts, gl.DYNAMIC_DRAW);
      this.classes = scene.classes;
      this.groups = scene.groups;
      this.woods = scene.woods;
    }

    takeSky(crown) {
      const { gl } = this;
      gl.activeTexture(gl.TEXTURE1);
      gl.bindTexture(gl.TEXTURE_3D, this.sky);
      gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
      gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA8, ...crown.size, 0, gl.RGBA, gl.UNSIGNED_BYTE, crown.lighten());
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_3D, filter, gl.LINEAR);
      for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
        gl.texParameteri(gl.TEXTURE_3D, wrap, gl.CLAMP_TO_EDGE);
      this.skyLow = crown.low;
      this.skySize = crown.size.map((cells) => cells * crown.cell);
    }

    use({ program, place }, view) {
      const { gl } = this;
      gl.useProgram(program);
      gl.uniformMatrix4fv(place('camera'), false, view.camera);
      gl.uniform1f(place('share'), view.share);
      gl.uniform3fv(place('eye'), view.eye);
      gl.uniform3fv(place('sun'), view.sun);
      gl.uniformMatrix4fv(place('sun_camera'), false, view.sunCamera);
      gl.uniform1i(place('shadows'), 0);
      gl.uniform1i(place('sky_light'), 1);
      gl.uniform1f(place('texel'), view.texel ?? 0);
      gl.uniform1i(place('casts'), view.casts ? 1 : 0);
      gl.uniform3fv(place('sky_low'), this.skyLow);
      gl.uniform3fv(place('sky_size'), this.skySize);
      gl.uniform1i(place('stained'), view.stained ? 1 : 0);
      gl.uniform1i(place('chosen'), view.chosen);
      gl.uniform1f(place('height'), view.height);
      gl.uniform3fv(place('middle'), view.middle);
      gl.uniform1f(place('wide'), view.reach * 30);
      gl.uniform1f(place('reach'), view.reach);
      return place;
    }

    attribute(location, size, type, normalised, stride, offset, divisor) {
      const { gl } = this;
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, type, normalised, stride, offset);
      gl.vertexAttribDivisor(location, divisor);
    }

    // The colours that lie over corners of a form; none where it has none.
    tint(buffer) {
      const { gl } = this;
      if (buffer === null) {
        gl.disableVertexAttribArray(13);
        gl.vertexAttrib4f(13, 0, 0, 0, 0);
        return;
      }
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      this.attribute(13, 4, gl.UNSIGNED_BYTE, true, 4, 0, 0);
    }

    drawWood(program, view) {
      const { gl } = this;
      const place = this.use(program, view);
      gl.uniform1i(place('thin'), 0);
      gl.bindVertexArray(this.woodArray);
      this.classes.forEach(({ first, count }, number) => {
        if (count === 0) return;
        const { buffer, count: corners } = this.tubes[number];
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        this.attribute(0, 3, gl.FLOAT, false, 12, 0, 0);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.woodBuffer);
        // The point before stands first: the buffer begins with one that is nothing.
        const at = first * POINT;
        for (let k = 0; k < 4; k += 1) {
          this.attribute(1 + k, 4, gl.FLOAT, false, POINT, at + k * POINT, 1);
          this.attribute(5 + k, 4, gl.FLOAT, false, POINT, at + k * POINT + 16, 1);
        }
        for (let k = 0; k < 2; k += 1) {
          this.attribute(9 + k, 4, gl.UNSIGNED_BYTE, true, POINT, at + (k + 1) * POINT + 32, 1);
          this.attribute(11 + k, 4, gl.UNSIGNED_BYTE, true, POINT, at + (k + 1) * POINT + 36, 1);
        }
        gl.uniform1i(place('first'), first);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, corners, count);
      });
    }

    drawParts(program, view) {
      const { gl } = this;
      const place = this.use(program, view);
      gl.bindVertexArray(this.partArray);
      for (const { form, first, count } of this.groups) {
        const { thin, scale, inParts, stalk, corners, tints, faces, count: indices } = this.forms[form];
        gl.uniform1i(place('thin'), thin ? 1 : 0);
        gl.uniform1i(place('scale'), scale);
        gl.uniform1i(place('in_parts'), inParts ? 1 : 0);
        gl.uniform3fv(place('stalk'), view.stained ? [-1, 0, 0] : stalk);
        gl.uniform1i(place('first'), this.woods + first);
        gl.bindBuffer(gl.ARRAY_BUFFER, corners);
        for (let k = 0; k < 3; k += 1) this.attribute(k, 3, gl.FLOAT, false, 40, 12 * k, 0);
        this.attribute(3, 1, gl.FLOAT, false, 40, 36, 0);
        this.tint(view.stained ? null : tints);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, faces);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.partBuffer);
        const at = first * PART;
        this.attribute(4, 3, gl.FLOAT, false, PART, at, 1);
        this.attribute(5, 3, gl.FLOAT, false, PART, at + 12, 1);
        this.attribute(6, 4, gl.SHORT, true, PART, at + 24, 1);
        this.attribute(7, 4, gl.SHORT, true, PART, at + 32, 1);
        this.attribute(8, 3, gl.FLOAT, false, PART, at + 40, 1);
        this.attribute(9, 3, gl.FLOAT, false, PART, at + 52, 1);
        this.attribute(10, 1, gl.FLOAT, false, PART, at + 64, 1);
        this.attribute(11, 4, gl.UNSIGNED_BYTE, true, PART, at + 68, 1);
        this.attribute(12, 4, gl.UNSIGNED_BYTE, true, PART, at + 72, 1);
        gl.drawElementsInstanced(gl.TRIANGLES, indices, gl.UNSIGNED_INT, 0, count);
      }
    }

    drawBack(program, view) {
      const { gl } = this;
      this.use(program, view);
      gl.bindVertexArray(this.backArray);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.square);
      this.attribute(0, 2, gl.FLOAT, false, 8, 0, 0);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }

    bindLight() {
      const { gl } = this;
      gl.activeTexture(gl.TEXTURE1);
      gl.bindTexture(gl.TEXTURE_3D, this.sky);
      gl.activeTexture(gl.TEXTURE0);
    }

    // What the sun sees.
    drawShadow(view) {
      const { gl } = this;
      this.bindLight();
      gl.bindTexture(gl.TEXTURE_2D, null);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
      gl.viewport(0, 0, this.shadowSize, this.shadowSize);
      gl.clear(gl.DEPTH_BUFFER_BIT);
      const seen = { ...view, camera: view.sunCamera, casts: false };
      this.drawWood(this.programs.wood_depth, seen);
      this.drawParts(this.programs.part_depth, seen);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    }

    // The picture.
    draw(view) {
      const { gl } = this;
      if (view.casts) this.drawShadow(view);
      this.bindLight();
      gl.bindTexture(gl.TEXTURE_2D, this.shadow);
      gl.viewport(0, 0, view.width, view.height);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      this.drawBack(this.programs.sky, view);
      if (view.ground) this.drawBack(this.programs.ground, view);
      this.drawWood(this.programs.wood, view);
      this.drawParts(this.programs.part, view);
    }

    // The number of what is seen at a pixel, the nearest to it within two pixels; −1 for nothing.
    numberAt(view, x, y) {
      const { gl } = this;
      const narrow = new Float32Array([
        view.width / 5,
        0,
        0,
        0,
        0,
        view.height / 5,
        0,
        0,
        0,
        0,
        1,
        0,
        (view.width - 2 * x - 1) / 5,
        (2 * y + 1 - view.height) / 5,
        0,
        1,
      ]);
      const seen = { ...view, camera: Light.times(narrow, view.camera), casts: false };
      gl.bindTexture(gl.TEXTURE_2D, null);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.numberTarget);
      gl.viewport(0, 0, 5, 5);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      this.drawWood(this.programs.wood_number, seen);
      this.drawParts(this.programs.part_number, seen);
      const pixels = new Uint8Array(100);
      gl.readPixels(0, 0, 5, 5, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      let [nearest, found] = [Infinity, -1];
      for (let i = 0; i < 25; i += 1) {
        const far = ((i % 5) - 2) ** 2 + (Math.floor(i / 5) - 2) ** 2;
        if (pixels[4 * i + 3] > 0 && far < nearest) {
          nearest = far;
          found = (pixels[4 * i] | (pixels[4 * i + 1] << 8) | (pixels[4 * i + 2] << 16)) - 1;
        }
      }
      return found;
    }
  }

  return { Painter, POINT, PART, SIDES };
})();
