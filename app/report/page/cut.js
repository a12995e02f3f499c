// What a plane cuts: the inside of hexahedra as triangles, the surfaces of regions as lines.

const TETRAHEDRA = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]];

// Distance of every node from the plane n·x = at.
function distances(x, plane) {
  const [a, b, c] = plane.normal, d = new Float32Array(x.length / 3);
  for (let n = 0; n < d.length; ++n) d[n] = a * x[3 * n] + b * x[3 * n + 1] + c * x[3 * n + 2] - plane.at;
  return d;
}

// Points on edges between nodes: `from`, `to` and the part of the way.
class CutPoints {
  constructor(x, d) { Object.assign(this, {x, d, from: [], to: [], part: [], cell: []}); }
  add(p, q, cell) {
    this.from.push(p);
    this.to.push(q);
    this.part.push(this.d[p] / (this.d[p] - this.d[q]));
    this.cell.push(cell);
  }
  value(i, values) {
    return values[this.from[i]] + this.part[i] * (values[this.to[i]] - values[this.from[i]]);
  }
  positions() {
    const places = new Float32Array(3 * this.from.length);
    for (let i = 0; i < this.from.length; ++i)
      for (let c = 0; c < 3; ++c) {
        const p = this.x[3 * this.from[i] + c];
        places[3 * i + c] = p + this.part[i] * (this.x[3 * this.to[i] + c] - p);
      }
    return places;
  }
}

// Of a tetrahedron one triangle, or two where two of its nodes are on either side.
function cutTetrahedron(nodes, cell, points) {
  const above = nodes.filter(n => points.d[n] > 0), below = nodes.filter(n => points.d[n] <= 0);
  const add = pairs => pairs.forEach(([p, q]) => points.add(p, q, cell));
  if (above.length === 1) add(below.map(q => [above[0], q]));
  if (below.length === 1) add(above.map(p => [p, below[0]]));
  if (above.length !== 2) return;
  const [p, r] = above, [q, s] = below;
  add([[p, q], [p, s], [r, s], [p, q], [r, s], [r, q]]);
}

function cutSolid(solid, frame, plane, isVisible) {
  const x = solid.positions[frame], points = new CutPoints(x, distances(x, plane)), d = points.d;
  for (let cell = 0; solid.hexes && cell < solid.cells; ++cell) {
    const nodes = solid.hexes.subarray(8 * cell, 8 * cell + 8);
    let above = 0;
    for (const n of nodes)
      if (d[n] > 0) ++above;
    if (above === 0 || above === 8 || !isVisible(solid.names[solid.regions[cell]])) continue;
    for (const t of TETRAHEDRA) cutTetrahedron(t.map(i => nodes[i]), cell, points);
  }
  return points;
}

// Pairs of points where the plane cuts the faces of visible regions.
function cutOutlines(solid, frame, plane, isVisible) {
  const x = solid.positions[frame], points = new CutPoints(x, distances(x, plane)), d = points.d;
  for (let f = 0; f < solid.faceCells.length; ++f) {
    const n = solid.faceNodes.subarray(4 * f, 4 * f + 4);
    if (n.every(i => d[i] > 0) || n.every(i => d[i] <= 0)) continue;
    if (!isVisible(solid.names[solid.regions[solid.faceCells[f]]])) continue;
    for (const t of [[n[0], n[1], n[2]], [n[0], n[2], n[3]]]) {
      const above = t.filter(i => d[i] > 0), below = t.filter(i => d[i] <= 0);
      const [one, two] = above.length === 1 ? [above, below] : [below, above];
      if (one.length === 1) two.forEach(q => points.add(one[0], q, solid.faceCells[f]));
    }
  }
  return points;
}
