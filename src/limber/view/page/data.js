// From the text in the page to results with typed arrays; src/limber/view/page_data.hpp
// describes the bytes.

const kTypes = {
  f32: Float32Array,
  f64: Float64Array,
  i16: Int16Array,
  u32: Uint32Array,
};

export async function inflate(text) {
  const packed = await (await fetch(`data:application/zlib;base64,${text}`)).arrayBuffer();
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

// Bytes are stored plane by plane.
function readArray(bytes, start, ref) {
  const values = new kTypes[ref.type](ref.count);
  const out = new Uint8Array(values.buffer);
  const size = values.BYTES_PER_ELEMENT;
  for (let b = 0; b < size; ++b) {
    const plane = start + ref.at + b * ref.count;
    for (let i = 0; i < ref.count; ++i) out[i * size + b] = bytes[plane + i];
  }
  return values;
}

// Replaces every reference {at, count, type} below `value` by its array.
function resolve(value, read) {
  if (value === null || typeof value !== 'object') return value;
  if ('at' in value && 'count' in value && 'type' in value) return read(value);
  for (const key of Object.keys(value)) value[key] = resolve(value[key], read);
  return value;
}

function unpackSurface(surface) {
  const n = surface.nodes;
  const x = new Float32Array(3 * n);
  for (let i = 0; i < 3 * n; ++i) {
    x[i] = surface.origin[i % 3] + surface.scale * surface.x[i];
  }
  surface.x = x;
  surface.shapes = surface.shapes.map(({ scale, values }) => {
    const shape = new Float32Array(3 * n);
    for (let i = 0; i < 3 * n; ++i) shape[i] = scale * values[i];
    return shape;
  });
  surface.stress = unpackStress(surface.stress);
}

function unpackStress(stress) {
  return stress?.map(({ scale, values }) => Float32Array.from(values, (value) => scale * value));
}

// The page's own, or in the frame of a playground those that it was given.
async function readBytes() {
  if (window.frameElement?.limberData) return window.frameElement.limberData;
  const element = document.getElementById('limber-data');
  const buffer = await inflate(element.textContent.trim());
  element.remove();
  return buffer;
}

/// Results, the shown one first. Lists that are empty may be absent in the file.
export async function readResults() {
  const buffer = await readBytes();
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const bytes = new Uint8Array(buffer);
  const start = 8 * Math.ceil((4 + length) / 8);
  resolve(header, (ref) => readArray(bytes, start, ref));
  for (const result of header.results) {
    result.surfaces.forEach(unpackSurface);
    for (const body of result.bodies ?? []) body.stress = unpackStress(body.stress);
    for (const list of ['bodies', 'shapes', 'marks', 'loads', 'contacts', 'events', 'probes']) {
      result[list] ??= [];
    }
  }
  return header.results;
}
