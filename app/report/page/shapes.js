// Rigid bodies, and lines drawn as thin rods.

class BodySurface {
  constructor(bodies, body) {
    this.bodies = bodies;
    this.name = bodies.names[body] || 'body ' + body;
    this.corners = [];
    bodies.body.forEach(
        (b, t) => b === body && this.corners.push(...bodies.triangles.subarray(3 * t, 3 * t + 3)));
    const nodes = [...new Set(this.corners)], number = new Map(nodes.map((n, k) => [n, k]));
    this.nodes = nodes;
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * nodes.length), 3));
    this.geometry.setIndex(this.corners.map(n => number.get(n)));
    this.colour = colourOf(this.name, body + 1);
  }
  setPositions(frame) {
    const x = this.bodies.positions[frame], to = this.geometry.attributes.position;
    this.nodes.forEach((n, k) => to.array.set(x.subarray(3 * n, 3 * n + 3), 3 * k));
    to.needsUpdate = true;
    this.geometry.computeVertexNormals();
    this.geometry.computeBoundingSphere();
    this.geometry.computeBoundingBox();
  }

  // Between the body and a point, in a state of which it is kept: a large plate is near where its corners are
  // not.
  leastDistance(frame, point) {
    if (this.measured && this.measured.frame === frame) return this.measured.distance;
    const x = this.bodies.positions[frame], triangle = new THREE.Triangle(), foot = new THREE.Vector3();
    let distance = Infinity;
    for (let k = 0; k < this.corners.length; k += 3) {
      [triangle.a, triangle.b, triangle.c].forEach((p, i) => p.fromArray(x, 3 * this.corners[k + i]));
      distance = Math.min(distance, triangle.closestPointToPoint(point, foot).distanceTo(point));
    }
    this.measured = {frame, distance};
    return distance;
  }
}

// A prism with six sides from a to b.
function addRod(a, b, radius, positions, normals) {
  const axis = b.clone().sub(a), u = new THREE.Vector3(), v = new THREE.Vector3(),
        corner = new THREE.Vector3();
  u.set(Math.abs(axis.x) < .5 * axis.length() ? 1 : 0, Math.abs(axis.x) < .5 * axis.length() ? 0 : 1, 0)
      .cross(axis)
      .normalize();
  v.copy(axis).normalize().cross(u);
  const direction = k =>
      corner.copy(u).multiplyScalar(Math.cos(k * Math.PI / 3)).addScaledVector(v, Math.sin(k * Math.PI / 3));
  const add = (end, k) => {
    normals.push(...direction(k).toArray());
    positions.push(...corner.multiplyScalar(radius).add(end).toArray());
  };
  for (let k = 0; k < 6; ++k)
    [[a, k], [b, k], [b, k + 1], [a, k], [b, k + 1], [a, k + 1]].forEach(([end, i]) => add(end, i));
}

class LineGroup {
  constructor(lines, group, size) {
    this.lines = lines;
    this.group = group;
    this.name = lines.names[group] || 'lines ' + group;
    this.geometry = new THREE.BufferGeometry();
    this.colour = colourOf(this.name, group, LINE_COLOURS);
    const most = Math.max(...lines.states.map(s => s.group.filter(g => g === group).length));
    this.radius = (most > 30 ? .0006 : .003) * size;
  }
  setPositions(frame) {
    const state = this.lines.states[frame], positions = [], normals = [];
    const end = i => new THREE.Vector3().fromArray(state.ends, 3 * i);
    state.group.forEach(
        (g, l) => g === this.group && addRod(end(2 * l), end(2 * l + 1), this.radius, positions, normals));
    this.geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    this.geometry.setAttribute('normal', new THREE.Float32BufferAttribute(normals, 3));
    this.geometry.computeBoundingSphere();
  }
}
