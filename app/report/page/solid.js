// The surfaces of the regions as three.js draws them: four corners of its own for every face.

// Edges between faces that meet at a larger angle than this stay sharp.
const SHARP_COSINE = Math.cos(40 * Math.PI / 180);

// Faces of a region; those in a plane of symmetry last, since mirrored halves hide them.
function facesOfRegion(model, region) {
  const {solid} = model, outside = [], inPlane = [];
  for (let f = 0; f < solid.faceCells.length; ++f)
    if (solid.regions[solid.faceCells[f]] === region) (isInPlane(model, f) ? inPlane : outside).push(f);
  return {faces: outside.concat(inPlane), outside: outside.length};
}

function isInPlane(model, face) {
  const {faceNodes, positions} = model.solid, x = positions[positions.length - 1], near = 1e-3;  // mm
  return model.symmetry.some(axis => {
    const c = 'xyz'.indexOf(axis);
    return [0, 1, 2, 3].every(i => Math.abs(x[3 * faceNodes[4 * face + i] + c]) < near);
  });
}

class RegionSurface {
  constructor(model, region) {
    this.solid = model.solid;
    Object.assign(this, facesOfRegion(model, region), {region, name: model.solid.names[region]});
    this.corners = new Uint32Array(4 * this.faces.length);
    this.faces.forEach((f, k) => this.corners.set(this.solid.faceNodes.subarray(4 * f, 4 * f + 4), 4 * k));
    this.colour = colourOf(this.name, region);
    this.geometry = this.makeGeometry();
    this.facesOfNode = this.findFacesOfNodes();
  }

  makeGeometry() {
    const geometry = new THREE.BufferGeometry(), count = this.faces.length;
    for (const name of ['position', 'normal', 'color'])
      geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(12 * count), 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(6 * count), 1));
    return geometry;
  }

  // Faces around a node, one list behind the other: those of node n from start[n] on.
  findFacesOfNodes() {
    const start = new Uint32Array(this.solid.nodes + 1), list = new Uint32Array(this.corners.length);
    for (const n of this.corners) ++start[n + 1];
    for (let n = 0; n < this.solid.nodes; ++n) start[n + 1] += start[n];
    const next = start.slice();
    this.corners.forEach((n, corner) => list[next[n]++] = corner >> 2);
    return {start, list};
  }

  setPositions(frame) {
    const x = this.solid.positions[frame], to = this.geometry.attributes.position;
    this.corners.forEach((n, c) => to.array.set(x.subarray(3 * n, 3 * n + 3), 3 * c));
    to.needsUpdate = true;
    this.setNormals(x);
    this.geometry.computeBoundingSphere();
  }

  setNormals(x) {
    const flat = this.flatNormals(x), to = this.geometry.attributes.normal, {start, list} = this.facesOfNode;
    this.corners.forEach((n, corner) => {
      const own = 3 * (corner >> 2), sum = [0, 0, 0];
      for (let k = start[n]; k < start[n + 1]; ++k) {
        const other = 3 * list[k];
        const cosine =
            flat[own] * flat[other] + flat[own + 1] * flat[other + 1] + flat[own + 2] * flat[other + 2];
        if (cosine > SHARP_COSINE)
          for (let c = 0; c < 3; ++c) sum[c] += flat[other + c];
      }
      to.array.set(sum, 3 * corner);
    });
    to.needsUpdate = true;
  }

  flatNormals(x) {
    const flat = new Float32Array(3 * this.faces.length), a = new THREE.Vector3(), b = new THREE.Vector3();
    const difference = (to, p, q) =>
        to.set(x[3 * q] - x[3 * p], x[3 * q + 1] - x[3 * p + 1], x[3 * q + 2] - x[3 * p + 2]);
    for (let k = 0; k < this.faces.length; ++k) {
      const n = this.corners.subarray(4 * k, 4 * k + 4);
      difference(a, n[0], n[2]).cross(difference(b, n[1], n[3])).normalize().toArray(flat, 3 * k);
    }
    return flat;
  }

  // `field`: of fieldValues; none: the region's own colour.
  setColours(field, range) {
    const to = this.geometry.attributes.color;
    this.corners.forEach((n, corner) => {
      const value =
          field && field.values[field.on === 'cells' ? this.solid.faceCells[this.faces[corner >> 2]] : n];
      to.array.set(field ? viridis(partOf(value, range)) : this.colour, 3 * corner);
    });
    to.needsUpdate = true;
  }

  // Faces in a plane of symmetry only where asked for, those to another region only where that is `absent`;
  // those without a value of the field (if there is one) at a corner go into a second group, which is drawn
  // faintly.
  setFaces(withPlane, absent, field) {
    const withValue = [], without = [], {solid, corners} = this;
    for (let k = 0; k < (withPlane ? this.faces.length : this.outside); ++k) {
      const other = solid.faceOthers[this.faces[k]];
      if (other > 0 && !absent(solid.names[other - 1])) continue;
      const none = field && field.on === 'nodes' &&
          [0, 1, 2, 3].some(i => Number.isNaN(field.values[corners[4 * k + i]]));
      (none ? without : withValue).push(k);
    }
    const index = this.geometry.index;
    withValue.concat(without).forEach(
        (k, at) => [0, 1, 2, 0, 2, 3].forEach((c, i) => index.array[6 * at + i] = 4 * k + c));
    index.needsUpdate = true;
    this.geometry.clearGroups();
    this.geometry.addGroup(0, 6 * withValue.length, 0);
    this.geometry.addGroup(6 * withValue.length, 6 * without.length, 1);
    this.geometry.setDrawRange(0, 6 * (withValue.length + without.length));
  }

  // Edges of one face in the plane of symmetry only: the outline of the region in the section.
  outlineInPlane() {
    const edges = new Map();
    for (let k = this.outside; k < this.faces.length; ++k)
      for (let i = 0; i < 4; ++i) {
        const a = this.corners[4 * k + i], b = this.corners[4 * k + (i + 1) % 4],
              key = Math.min(a, b) + ',' + Math.max(a, b);
        edges.set(key, edges.has(key) ? null : [a, b]);
      }
    return [...edges.values()].filter(edge => edge).flat();
  }
}
