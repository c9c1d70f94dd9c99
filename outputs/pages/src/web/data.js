'use strict';
// The data of the page: unpacked by the browser, and read as streams of whole numbers (docs/view.md has the format).

const Data = (() => {
  // Base64 to bytes, and gzip to bytes.
  async function unpack(text) {
    const letters = atob(text.replace(/\s+/g, ''));
    const packed = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; i += 1) packed[i] = letters.charCodeAt(i);
    const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Uint8Array(await new Response(plain).arrayBuffer());
  }

  // The numbers of a stream: groups of seven bits, the lowest first, zigzagged.
  function numbers(bytes) {
    let count = 0;
    for (let i = 0; i < bytes.length; i += 1) count += bytes[i] < 128 ? 1 : 0;
    const found = new Int32Array(count);
    let place = 0;
    let value = 0;
    let scale = 1;
    for (let i = 0; i < bytes.length; i += 1) {
      value += (bytes[i] & 127) * scale;
      scale *= 128;
      if (bytes[i] < 128) {
        found[place] = value % 2 === 1 ? -(value + 1) / 2 : value / 2;
        place += 1;
        value = 0;
        scale = 1;
      }
    }
    return found;
  }

  // What the differences add up to.
  function sums(differences) {
    let sum = 0;
    for (let i = 0; i < differences.length; i += 1) {
      sum += differences[i];
      differences[i] = sum;
    }
    return differences;
  }

  // Where the entries of each of some lists begin, and at the end where the last one ends.
  function starts(counts) {
    const found = new Int32Array(counts.length + 1);
    for (let i = 0; i < counts.length; i += 1) found[i + 1] = found[i] + counts[i];
    return found;
  }

  // The ages of keys: the first of each list is `from`, and the steps lead on.
  function keyAges(begin, from, steps) {
    const ages = new Int32Array(begin[begin.length - 1]);
    let next = 0;
    for (let i = 0; i < from.length; i += 1) {
      let age = from[i];
      for (let key = begin[i]; key < begin[i + 1]; key += 1) {
        if (key > begin[i]) {
          age += steps[next];
          next += 1;
        }
        ages[key] = age;
      }
    }
    return ages;
  }

  // Values of keys: the first of a list differs from the first of the list before (of that of the same kind, where there
  // are kinds), the others from the key before.
  function keyValues(begin, steps, kinds) {
    const values = new Int32Array(steps.length);
    const firsts = new Map();
    for (let i = 0; i + 1 < begin.length; i += 1) {
      const kind = kinds ? kinds[i] : 0;
      let value = firsts.get(kind) ?? 0;
      for (let key = begin[i]; key < begin[i + 1]; key += 1) {
        value += steps[key];
        values[key] = value;
        if (key === begin[i]) firsts.set(kind, value);
      }
    }
    return values;
  }

  async function read(element) {
    const bytes = await unpack(element.textContent);
    const length = new DataView(bytes.buffer).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
    const streams = new Map();
    let at = 4 + length;
    for (const [name, size] of header.streams) {
      streams.set(name, bytes.subarray(at, at + size));
      at += size;
    }
    return { header, stream: (name) => numbers(streams.get(name)) };
  }

  // A measure of the logarithmic scale; those that were asked for are remembered.
  const measures = [0];
  function measure(header, place) {
    if (place <= 0) return 0;
    if (place !== Math.floor(place)) return header.least * 2 ** ((place - 1) / header.octave);
    for (let next = measures.length; next <= place; next += 1)
      measures.push(header.least * 2 ** ((next - 1) / header.octave));
    return measures[place];
  }

  return { read, sums, starts, keyAges, keyValues, measure };
})();
