'use strict';
// The programs of the graphics processor. Colours and light are those of `phytomer picture`.

const Shaders = (() => {
  const HEAD = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler3D;
precision highp sampler2DShadow;
`;

  // Places of wood: a tube between two points of a line, with the points before and after for its joints.
  const WOOD = `${HEAD}
uniform mat4 camera;
uniform float share;
layout(location = 0) in vec3 corner;
layout(location = 1) in vec4 now0;
layout(location = 2) in vec4 now1;
layout(location = 3) in vec4 now2;
layout(location = 4) in vec4 now3;
layout(location = 5) in vec4 next0;
layout(location = 6) in vec4 next1;
layout(location = 7) in vec4 next2;
layout(location = 8) in vec4 next3;
layout(location = 9) in vec4 colour1;
layout(location = 10) in vec4 colour2;
layout(location = 11) in vec4 later1;
layout(location = 12) in vec4 later2;
uniform int first;
uniform bool stained;
out vec3 place;
out vec3 normal;
out vec3 colour;
flat out int id;
vec3 unit(vec3 v, vec3 other) { float l = length(v); return l > 1e-9 ? v / l : other; }
void main() {
  vec4 p0 = mix(now0, next0, share), p1 = mix(now1, next1, share);
  vec4 p2 = mix(now2, next2, share), p3 = mix(now3, next3, share);
  int joints = int(colour1.a * 255.0 + 0.5);
  vec3 along = unit(p2.xyz - p1.xyz, vec3(0.0, 0.0, 1.0));
  vec3 before = (joints & 2) != 0 ? unit(p1.xyz - p0.xyz, along) : along;
  vec3 after = (joints & 4) != 0 ? unit(p3.xyz - p2.xyz, along) : along;
  bool end = corner.z > 0.5;
  vec3 tangent = unit(end ? along + after : before + along, along);
  vec3 aside = abs(along.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
  vec3 right = normalize(cross(aside, along));
  right = unit(right - tangent * dot(right, tangent), right);
  vec3 radial = right * corner.x + cross(tangent, right) * corner.y;
  vec4 p = end ? p2 : p1;
  bool joined = (joints & 1) != 0;
  place = p.xyz + radial * (joined ? p.w : 0.0);
  float lean = (p1.w - p2.w) / max(length(p2.xyz - p1.xyz), 1e-6);
  normal = normalize(radial + tangent * clamp(lean, -2.0, 2.0));
  vec3 from = mix(colour1.rgb, later1.rgb, share), to = mix(colour2.rgb, later2.rgb, share);
  colour = end && !stained ? to : from;
  id = first + gl_InstanceID;
  gl_Position = joined ? camera * vec4(place, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
}`;

  // Places of a part: a form in its frame and of its size.
  const PART = `${HEAD}
uniform mat4 camera;
uniform float share;
uniform int scale;
uniform bool in_parts;
uniform vec3 stalk;
layout(location = 0) in vec3 at;
layout(location = 1) in vec3 across;
layout(location = 2) in vec3 facing;
layout(location = 3) in float of_stalk;
layout(location = 4) in vec3 base_now;
layout(location = 5) in vec3 base_next;
layout(location = 6) in vec4 turn_now;
layout(location = 7) in vec4 turn_next;
layout(location = 8) in vec3 size_now;
layout(location = 9) in vec3 size_next;
layout(location = 10) in float fullness;
layout(location = 11) in vec4 colour_now;
layout(location = 12) in vec4 colour_next;
layout(location = 13) in vec4 tint;
uniform int first;
out vec3 place;
out vec3 normal;
out vec3 colour;
flat out int id;
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
void main() {
  vec3 size = mix(size_now, size_next, share);
  float s = dot(turn_now, turn_next) < 0.0 ? -share : share;
  vec4 turn = normalize(turn_now * (1.0 - share) + turn_next * s);
  vec3 box = at, scales = size;
  if (scale == 3) {
    float wide = mix(size.y, size.z, at.x);
    scales = vec3(size.x, wide, wide);
  } else if (scale == 2) {
    scales = vec3(size.x);
  } else if (scale < 2) {
    float width = in_parts ? size.y : size.y * fullness;
    if (in_parts) box += across * (fullness - 1.0);
    scales = vec3(size.x, width, scale == 0 ? width : size.x);
  }
  place = mix(base_now, base_next, share) + turned(turn, box * scales);
  vec3 cofactors = scales.yxx * scales.zzy;
  vec3 n = facing * (scale == 3 ? vec3(1.0) : cofactors);
  normal = turned(turn, length(n) > 1e-20 ? normalize(n) : facing);
  vec3 own = mix(colour_now.rgb, colour_next.rgb, share);
  colour = mix(of_stalk > 0.5 && stalk.x >= 0.0 ? stalk : own, tint.rgb, tint.a);
  id = first + gl_InstanceID;
  gl_Position = camera * vec4(place, 1.0);
}`;

  // Sun, sky and what is seen of them (outputs/pictures: shade, sky, tone).
  const LIGHT = `
uniform vec3 sun;
uniform mat4 sun_camera;
uniform sampler2DShadow shadows;
uniform float texel;
uniform bool casts;
uniform sampler3D sky_light;
uniform vec3 sky_low;
uniform vec3 sky_size;
const vec3 SUN = vec3(1.62, 1.48, 1.24);
const vec3 SKY = vec3(0.62, 0.69, 0.78);
float lit(vec3 point, vec3 normal, float spread) {
  if (!casts) return 1.0;
  vec4 seen = sun_camera * vec4(point + normal * texel * 1.2, 1.0);
  vec3 at = seen.xyz * 0.5 + 0.5;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
  float sum = 0.0;
  for (int k = 0; k < 8; k++) {
    float radius = sqrt((float(k) + 0.5) / 8.0), angle = 2.399963 * float(k);
    vec2 tap = radius * vec2(cos(angle), sin(angle)) * spread;
    sum += texture(shadows, vec3(at.xy + tap, at.z - 0.0006));
  }
  return sum / 8.0;
}
vec4 sky_at(vec3 point) {
  vec4 found = texture(sky_light, (point - sky_low) / sky_size);
  return vec4(found.x, found.yzw * 2.0 - 1.0);
}
float falling_on(vec4 light, vec3 normal) { return max(light.x + dot(light.yzw, normal), 0.0); }
vec3 to_light(vec3 screen) {
  return mix(screen / 12.92, pow((screen + 0.055) / 1.055, vec3(2.4)), step(0.04045, screen));
}
vec3 to_screen(vec3 light) {
  light = clamp(light, 0.0, 1.0);
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
}
// A screen colour with noise below a step of it, so that a smooth ground shows no bands.
vec3 dithered(vec3 screen) {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return screen + (noise - 0.5) / 255.0;
}
vec3 shown(vec3 light) {
  light = max(light, 0.0) * 1.18;
  return min(light * (1.0 + light / 5.76) / (1.0 + light), 1.0);
}
`;

  const SHADE = `${HEAD}${LIGHT}
uniform vec3 eye;
uniform bool thin;
uniform bool stained;
uniform int chosen;
in vec3 place;
in vec3 normal;
in vec3 colour;
flat in int id;
out vec4 seen;
vec3 varied(vec3 own) {
  uint hash = (uint(id) * 2654435761u) >> 16u;
  float light = float(hash & 255u) / 255.0 - 0.5, warm = float((hash >> 8u) & 255u) / 255.0 - 0.5;
  return clamp(own * (1.0 + 0.16 * light) * vec3(1.0 + 0.06 * warm, 1.0, 1.0 - 0.06 * warm), 0.0, 1.0);
}
void main() {
  vec3 back = normalize(eye - place);
  vec3 n = normalize(normal);
  if (dot(n, back) < 0.0) n = -n;
  float towards = dot(n, sun);
  vec4 sky = sky_at(place);
  float near = falling_on(sky, n), far = falling_on(sky, -n);
  float open = min(2.0 * sky.x, 1.0);
  vec3 around = vec3(0.33, 0.305, 0.245) * ((0.5 - 0.5 * n.z) * (0.25 + 0.75 * open)) + vec3(0.095, 0.1, 0.088);
  vec3 base = to_light(thin && !stained ? varied(colour) : colour);
  float clear = thin || towards > 0.0 ? lit(place, towards < 0.0 ? -n : n, texel * 1.4) : 0.0;
  vec3 rays = SUN * clear;
  vec3 light;
  if (stained) {
    light = base * (0.5 + 0.45 * max(near, far) + 0.4 * clear * abs(towards));
  } else if (!thin) {
    light = base * (rays * max(towards, 0.0) + SKY * near + around);
  } else {
    float pale = min(base.r, min(base.g, base.b));
    vec3 passed = SKY * (0.5 * pale * max(1.0 - near, 0.0)) + (SUN - rays) * (0.25 * pale);
    vec3 thrown = rays * (0.78 * max(towards, 0.0)) + SKY * (0.78 * near) + around + passed;
    vec3 tint = mix(vec3(1.15, 1.12, 0.5), vec3(1.0), pale);
    vec3 through = (rays * max(-towards, 0.0) + SKY * far) * 0.5 * tint;
    float half_way = pow(max(dot(normalize(sun + back), n), 0.0), 4.0);
    light = base * (thrown + through) + (rays * pow(half_way, 3.0) + SKY * (0.5 * near)) * 0.035;
  }
  if (id == chosen) light = mix(light, vec3(1.6, 0.35, 0.02), 0.75);
  seen = vec4(to_screen(shown(light)), 1.0);
}`;

  const DEPTH = `${HEAD}
void main() {}`;

  const NUMBER = `${HEAD}
flat in int id;
out vec4 seen;
void main() { int n = id + 1; seen = vec4(n & 255, (n >> 8) & 255, (n >> 16) & 255, 255) / 255.0; }`;

  // The paper behind everything, and the ground.
  const BACK = `${HEAD}
layout(location = 0) in vec2 corner;
void main() { gl_Position = vec4(corner, 0.9999, 1.0); }`;
  const PAPER = `
uniform float height;
vec3 paper(float y) {
  float x = clamp(y / height / 0.85, 0.0, 1.0);
  vec3 zenith = sqrt(to_light(vec3(222.0, 231.0, 239.0) / 255.0)), horizon = sqrt(to_light(vec3(248.0, 247.0, 243.0) / 255.0));
  return mix(zenith, horizon, x * x * (3.0 - 2.0 * x));
}
`;
  const SKY = `${HEAD}${LIGHT}${PAPER}
out vec4 seen;
void main() { vec3 roots = paper(height - gl_FragCoord.y); seen = vec4(dithered(to_screen(roots * roots)), 1.0); }`;
  const GROUND = `${HEAD}
uniform mat4 camera;
uniform vec3 middle;
uniform float wide;
layout(location = 0) in vec2 corner;
out vec3 place;
void main() { place = vec3(middle.xy + wide * corner, 0.0); gl_Position = camera * vec4(place, 1.0); }`;
  const EARTH = `${HEAD}${LIGHT}${PAPER}
uniform vec3 middle;
uniform float reach;
in vec3 place;
out vec4 seen;
void main() {
  float far = length(place.xy - middle.xy) / max(reach, 1e-6);
  float x = clamp((far - 0.15) / 1.35, 0.0, 1.0);
  float nearness = 1.0 - x * x * (3.0 - 2.0 * x);
  vec3 earth = mix(paper(height - gl_FragCoord.y), sqrt(to_light(vec3(229.0, 224.0, 211.0) / 255.0)), nearness);
  float open = min(falling_on(sky_at(place + vec3(0.0, 0.0, 1e-4)), vec3(0.0, 0.0, 1.0)), 1.0);
  vec3 gets = SUN * (sun.z * lit(place, vec3(0.0, 0.0, 1.0), texel * 2.2)) + SKY * mix(1.0, open, nearness);
  vec3 roots = earth * sqrt(gets / (SUN * sun.z + SKY));
  seen = vec4(dithered(to_screen(roots * roots)), 1.0);
}`;

  return { WOOD, PART, SHADE, DEPTH, NUMBER, BACK, SKY, GROUND, EARTH };
})();
