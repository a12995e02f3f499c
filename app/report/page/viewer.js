// One model on one canvas. `show(state)` draws what the controls say.

class Viewer extends Stage {
  constructor(element, model) {
    const box = boxOf(model.solid.positions[model.frames.length - 1], model.symmetry);
    super(element, box.size);
    Object.assign(this, {model, box, materials: []});
    const {solid, bodies, lines} = model;
    this.regions = solid.names.map((_, r) => new RegionSurface(model, r)).filter(r => r.faces.length > 0);
    this.bodies = bodies ? bodies.names.map((_, b) => new BodySurface(bodies, b)) : [];
    this.lines = lines ? lines.names.map((_, g) => new LineGroup(lines, g, this.box.size)) : [];
    this.clip = new THREE.Plane();
    this.images = imagesOf(model.symmetry).map(signs => this.makeImage(signs));
    this.outline = this.makeOutline();
  }

  // All that is drawn, mirrored by the signs of the axes.
  makeImage(signs) {
    const group = new THREE.Group();
    group.scale.set(...signs);
    this.scene.add(group);
    const add = (item, material) => {
      const mesh = new THREE.Mesh(item.geometry, material);
      mesh.userData.item = item;
      group.add(mesh);
      return mesh;
    };
    const lambert = options => {
      const behindEdges = {polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2};
      this.materials.push(
          new THREE.MeshLambertMaterial({side: THREE.DoubleSide, ...behindEdges, ...options}));
      return this.materials[this.materials.length - 1];
    };
    const faint = options => lambert({...options, transparent: true, opacity: .13, depthWrite: false});
    for (const region of this.regions)
      add(region, [lambert({vertexColors: THREE.VertexColors}), faint({vertexColors: THREE.VertexColors})]);
    for (const body of this.bodies) {
      const color = new THREE.Color(...body.colour), mesh = add(body, lambert({color}));
      mesh.userData.materials = [mesh.material, faint({color})];
    }
    for (const line of this.lines) add(line, lambert({color: new THREE.Color(...line.colour)}));
    const flat = {
      side: THREE.DoubleSide,
      vertexColors: THREE.VertexColors,
      polygonOffset: true,
      polygonOffsetUnits: 2
    };
    const cut = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial(flat));
    const edges =
        new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: 0x333333}));
    group.add(cut, edges);
    return {group, signs, cut, edges};
  }

  // Of the regions in the plane of symmetry.
  makeOutline() {
    const lines =
        new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: 0x333333}));
    this.scene.add(lines);
    return lines;
  }

  show(state) {
    const before = this.state || {};
    this.state = state;
    const frame = this.frameAt(state.time), moved = frame !== this.frame;
    this.frame = frame;
    if (moved)
      for (const item of [...this.regions, ...this.bodies, ...this.lines]) item.setPositions(frame);
    if (moved || state.colour !== before.colour || state.range !== before.range) this.setColours();
    this.setFaces();
    this.setVisible();
    this.setCut();
    this.draw();
  }

  frameAt(time) {
    const away = this.model.frames.map(f => Math.abs(f.time - time));
    return away.indexOf(Math.min(...away));
  }

  field() {
    return this.state.colour === 'region' ? null :
                                            fieldValues(this.model.solid, this.state.colour, this.frame);
  }

  setColours() {
    const field = this.field();
    for (const region of this.regions) region.setColours(field, this.state.range);
  }

  // Bodies are drawn faintly, too, where a field has values on some surfaces only.
  setFaces() {
    const field = this.field(), {mirrored, cut} = this.state, open = cut.on && !this.model.solid.hexes;
    for (const region of this.regions)
      region.setFaces(!mirrored, name => open || !this.isVisible(name), field);
    const sparse = field && field.values.some(Number.isNaN);
    for (const {group} of this.images)
      for (const mesh of group.children)
        if (mesh.userData.materials) mesh.material = mesh.userData.materials[sparse ? 1 : 0];
  }

  isVisible(name) { return !this.state.hidden.has(name); }

  // Bodies that wait far away, single or in parts all around, are left out.
  isInPlace(item) {
    return !(item instanceof BodySurface) ||
        item.leastDistance(this.frame, this.box.centre) < .75 * this.box.size;
  }

  setVisible() {
    const {mirrored, cut} = this.state;
    this.images.forEach(({group}, i) => {
      group.visible = i === 0 || mirrored;
      for (const mesh of group.children)
        if (mesh.userData.item)
          mesh.visible = this.isVisible(mesh.userData.item.name) && this.isInPlace(mesh.userData.item);
    });
    this.outline.visible = !mirrored && !cut.on;
    if (!this.outline.visible) return;
    const x = this.model.solid.positions[this.frame], places = [];
    for (const region of this.regions)
      if (this.isVisible(region.name))
        for (const n of region.outlineInPlane()) places.push(x[3 * n], x[3 * n + 1], x[3 * n + 2]);
    this.outline.geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
    this.outline.geometry.computeBoundingSphere();
  }

  setCut() {
    const {cut} = this.state, c = 'xyz'.indexOf(cut.axis), sign = cut.flipped ? -1 : 1;
    const at = this.box.low[c] + cut.part * (this.box.high[c] - this.box.low[c]) + 1e-4 * this.box.size;
    const normal = [0, 1, 2].map(i => i === c ? -sign : 0);
    this.clip.set(new THREE.Vector3(...normal), cut.on ? sign * at : 1e9);
    for (const material of this.materials) material.clippingPlanes = cut.on ? [this.clip] : null;
    for (const image of this.images) {
      image.cut.visible = image.edges.visible = cut.on;
      if (cut.on && image.group.visible)
        this.cutImage(image, {normal: [0, 1, 2].map(i => i === c ? image.signs[c] : 0), at});
    }
  }

  cutImage(image, plane) {
    const {solid} = this.model, visible = name => this.isVisible(name), field = this.field(),
          {range} = this.state;
    const points = cutSolid(solid, this.frame, plane, visible),
          colours = new Float32Array(3 * points.from.length);
    points.cell.forEach((cell, i) => {
      const value = field && (field.on === 'cells' ? field.values[cell] : points.value(i, field.values));
      const own = field ? viridis(partOf(value, range)) :
                          colourOf(solid.names[solid.regions[cell]], solid.regions[cell]);
      colours.set(own, 3 * i);
    });
    image.cut.userData.cells = points.cell;
    image.cut.geometry.setAttribute('position', new THREE.BufferAttribute(points.positions(), 3));
    image.cut.geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
    image.cut.geometry.computeBoundingSphere();
    const lines = cutOutlines(solid, this.frame, plane, visible).positions();
    image.edges.geometry.setAttribute('position', new THREE.BufferAttribute(lines, 3));
    image.edges.geometry.computeBoundingSphere();
  }
}

// The box of positions with their images; `low`, `high` of the drawn part and its images.
function boxOf(x, symmetry) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < x.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], x[i]);
    high[i % 3] = Math.max(high[i % 3], x[i]);
  }
  const part = {low: low.slice(), high: high.slice()};
  for (const axis of symmetry) {
    const c = 'xyz'.indexOf(axis), far = Math.max(-low[c], high[c]);
    low[c] = -far;
    high[c] = far;
  }
  const centre = new THREE.Vector3(...low.map((l, c) => (l + high[c]) / 2));
  return {low, high, part, centre, size: Math.hypot(...low.map((l, c) => high[c] - l))};
}

// The signs of the axes of all images; the first is the drawn part.
function imagesOf(symmetry) {
  let images = [[1, 1, 1]];
  for (const axis of symmetry)
    images = images.concat(images.map(signs => signs.map((s, c) => c === 'xyz'.indexOf(axis) ? -s : s)));
  return images;
}
