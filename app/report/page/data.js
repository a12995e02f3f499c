'use strict';
// The model as app/report/pack.cpp packs it, made into arrays of numbers.

const NO_VALUE = 65535, QUANTUM_TOP = 65534;

async function inflated(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Planes of low and high bytes of the differences to `before`.
async function unpacked16(base64, before) {
  const bytes = await inflated(base64), n = bytes.length / 2, values = new Uint16Array(n);
  for (let i = 0; i < n; ++i) values[i] = (bytes[i] | bytes[n + i] << 8) + (before ? before[i] : 0);
  return values;
}

// Four planes of bytes of the differences to the number `stride` places before.
async function unpacked32(base64, stride) {
  const b = await inflated(base64), n = b.length / 4, values = new Uint32Array(n);
  for (let i = 0; i < n; ++i)
    values[i] = (b[i] | b[n + i] << 8 | b[2 * n + i] << 16 | b[3 * n + i] << 24) +
        (i < stride ? 0 : values[i - stride]);
  return values;
}

async function unpackedStates(list) {
  const states = [];
  for (const text of list) states.push(await unpacked16(text, states[states.length - 1]));
  return states;
}

function numbersOf(quanta, low, high) {
  const numbers = new Float32Array(quanta.length), scale = (high - low) / QUANTUM_TOP;
  for (let i = 0; i < quanta.length; ++i) numbers[i] = quanta[i] === NO_VALUE ? NaN : low + quanta[i] * scale;
  return numbers;
}

async function unpackedPlaces(places) {
  return (await unpackedStates(places.values)).map(quanta => numbersOf(quanta, places.low, places.high));
}

async function solidOf(packed) {
  const positions = await unpackedPlaces(packed.positions), reference = positions.pop(), fields = [];
  for (const f of packed.fields)
    fields.push(
        {...f, values: (await unpackedStates(f.values)).map(quanta => numbersOf(quanta, f.low, f.high))});
  return {
    nodes: packed.nodes,
    cells: packed.cells,
    names: packed.region_names,
    positions,
    reference,
    fields,
    regions: await unpacked32(packed.regions, 1),
    faceNodes: await unpacked32(packed.face_nodes, 4),
    faceCells: await unpacked32(packed.face_cells, 1),
    faceOthers: await unpacked32(packed.face_others, 1),  // regions beyond from 1, 0: none
    hexes: packed.hexes ? await unpacked32(packed.hexes, 8) : null
  };
}

async function bodiesOf(packed) {
  if (!packed) return null;
  return {
    names: packed.names,
    body: await unpacked32(packed.body, 1),
    triangles: await unpacked32(packed.triangles, 3),
    positions: await unpackedPlaces(packed.positions)
  };
}

async function linesOf(packed) {
  if (!packed) return null;
  const states = [];
  for (const s of packed.states)
    states.push(
        {ends: (await unpackedPlaces(s.ends))[0], group: await unpacked32(s.group, 1), force: s.force});
  return {names: packed.names, states};
}

async function modelOf(packed) {
  return {
    title: packed.title,
    frames: packed.frames,
    symmetry: packed.symmetry,
    solid: await solidOf(packed.solid),
    bodies: await bodiesOf(packed.bodies),
    lines: await linesOf(packed.lines)
  };
}

// Values of a field in a state, of cells or nodes; of the displacement its length in mm.
function fieldValues(solid, name, frame) {
  if (name === 'displacement') {
    const x = solid.positions[frame], X = solid.reference, values = new Float32Array(solid.nodes);
    for (let n = 0; n < solid.nodes; ++n)
      values[n] = Math.hypot(x[3 * n] - X[3 * n], x[3 * n + 1] - X[3 * n + 1], x[3 * n + 2] - X[3 * n + 2]);
    return {on: 'nodes', values};
  }
  const field = solid.fields.find(f => f.name === name);
  return field ? {on: field.on, values: field.values[frame]} : null;
}
