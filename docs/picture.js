// Replaces a page of `bulbus report` by rows of panels, a state each, from the same camera, with labels and a
// scale bar.

const LABEL_FONT = '12px Helvetica, Arial, sans-serif', LETTERS = 'abcdefghijklmnopqrstuvwxyz';
const STYLE = `body { margin: 0; background: #fff; font: ${LABEL_FONT} }
    #picture { display: inline-block; padding: 6px }
    .panels { display: flex; gap: 6px }
    figure { margin: 0; position: relative }
    figcaption { font-size: 13px; padding: 2px }
    img { display: block }
    figure svg { position: absolute; left: 0; bottom: 0; max-width: none }
    line, .scale { stroke: #222; stroke-width: .9; fill: none }
    .scale { stroke-width: 1.6 }
    text, circle { fill: #222 }
    circle { stroke: #fff; stroke-width: .6 }
    rect { stroke: #777; stroke-width: .8; stroke-dasharray: 3 2; fill: none }
    #legend { margin: 4px auto 14px }
    #legend .note { display: none }`;
const MARGINS = [1.06, 1.25, 1.5], SLAB = .1;  // mm behind the section that are drawn with it

class Picture {
  constructor(given) {
    const {viewers: [viewer], controls} = window.report;
    Object.assign(this, {given, viewer, controls, letter: 0, legend: null});
    const frames = viewer.model.frames;
    this.frames = given.panels.map(([time]) => frames.findIndex(f => Math.abs(f.time - time) < 1e-9));
    if (this.frames.includes(-1))
      throw new Error(
          `the report shows ${frames.length} states for want of room, and not all of these. Name others.`);
    viewer.renderer.setClearColor(0xffffff);
    this.flat = given.view === 'section';
  }

  resize(height) {
    this.height = height;
    this.viewer.element.style.cssText =
        `width: ${this.given.width}px; height: ${height}px; max-height: none; border: 0`;
    this.viewer.resize(4);  // finer than the picture: edges come out smooth
  }

  // Colours of a section are those of the scale, without light and shade.
  light() {
    this.viewer.scene.traverse(o => o.isHemisphereLight && o.groundColor.set(0xffffff) && (o.intensity = 1));
    this.viewer.scene.traverse(o => o.isDirectionalLight && (o.intensity = 0));
  }

  axes() {
    const axes = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    this.viewer.camera.updateMatrixWorld();
    this.viewer.camera.matrixWorld.extractBasis(...axes);
    return axes;  // to the right, upwards, towards the eye
  }

  // Centre and width, mm, of what is in its place in any of the states: [right, up, width, height].
  extent() {
    const {viewer} = this, [right, up] = this.axes(), low = [Infinity, Infinity],
          high = [-Infinity, -Infinity];
    const add = x => {
      for (let i = 0; i < x.length; i += 3)
        [right, up].forEach((axis, k) => {
          const at = axis.x * x[i] + axis.y * x[i + 1] + axis.z * x[i + 2];
          low[k] = Math.min(low[k], at), high[k] = Math.max(high[k], at);
        });
    };
    for (const frame of this.frames) {
      viewer.show(this.stateOf(frame));
      add(viewer.model.solid.positions[frame]);
      for (const body of viewer.bodies)
        if (viewer.isInPlace(body))
          for (const n of body.nodes) add(body.bodies.positions[frame].subarray(3 * n, 3 * n + 3));
    }
    return [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, high[0] - low[0], high[1] - low[1]];
  }

  // Looks straight at the section, its centre `right`, `up` in mm in the middle.
  lookAt(right, up, width) {
    const {camera, orbit} = this.viewer, [toRight, upwards, towards] = this.axes();
    orbit.target.set(0, 0, 0).addScaledVector(toRight, right).addScaledVector(upwards, up);
    const distance = width / 2 / camera.aspect / Math.tan(camera.fov / 2 * Math.PI / 180);
    camera.position.copy(orbit.target).addScaledVector(towards, distance);
    orbit.update();
    this.behind = new THREE.Plane(towards.clone(), SLAB);
    Object.assign(this, {centre: [right, up], mmPerPixel: width / this.given.width});
  }

  stateOf(frame) { return {...this.controls.state, time: this.viewer.model.frames[frame].time}; }

  pixelOf([right, up]) {
    return [
      this.given.width / 2 + (right - this.centre[0]) / this.mmPerPixel,
      this.height / 2 - (up - this.centre[1]) / this.mmPerPixel
    ];
  }

  // Draws a state as far as names are not hidden.
  draw(state) {
    this.viewer.show(state);
    if (this.flat)
      for (const material of this.viewer.materials)
        material.clippingPlanes = [...(material.clippingPlanes || []), this.behind];
    this.viewer.drawNow();
    return this.viewer.renderer.domElement;
  }

  // What is seen of every thing, under the word for it: what changes without it.
  seen(state) {
    const {viewer, given: {width}, height} = this;
    const items = [...viewer.regions, ...viewer.bodies, ...viewer.lines], inks = new Map();
    viewer.resize(2);
    const all = pixelsOf(this.draw(state), width, height);
    for (const {name} of items) {
      const ink = inkOf(all, pixelsOf(this.draw({...state, hidden: new Set([name])}), width, height));
      const word = name.startsWith('suture ') ? 'suture' : name.replaceAll('_', ' ');
      if (ink.reduce((a, b) => a + b, 0) >= LEAST_INK && !inks.has(word)) inks.set(word, ink);
    }
    viewer.resize(4);
    return inks;
  }

  panel(k, state, told, points) {
    const {width} = this.given, canvas = this.draw(state),
          image = elementOf('img', {src: canvas.toDataURL(), width, height: this.height});
    const room = new Room(inkOf(pixelsOf(canvas, width, this.height)), width, this.height),
          wanted = points.map(([text, at]) => ({text, at: this.pixelOf(at)}));
    const frame = this.inset ? this.frameOf(room, this.inset) : '';
    const bar = this.flat && k === 0 ? scaleBarOf(room, this.mmPerPixel) : '', inks = this.seen(state);
    for (const [text, ink] of inks) {
      if (!told.has(text)) wanted.push({text, ink});
      told.add(text);
    }
    const caption = elementOf('figcaption', {innerHTML: `<b>${LETTERS[this.letter++]}</b>&ensp;`});
    caption.append(this.given.panels[k][1]);
    const figure = elementOf('figure', {}, caption, image),
          labels = labelsOf(room, wanted, [...inks.values()]);
    const size = `width="${width}" height="${this.height}"`;
    figure.insertAdjacentHTML('beforeend', `<svg ${size}>${frame + bar + labels}</svg>`);
    return figure;
  }

  // Where the close-up is.
  frameOf(room, [right, up, width, height]) {
    const [x, y] = this.pixelOf([right - width / 2, up + height / 2]);
    const w = width / this.mmPerPixel, h = height / this.mmPerPixel;
    room.takeEdges({x, y, w, h});
    return `<rect x="${x}" y="${y}" width="${w}" height="${h}"/>`;
  }

  // Every name is told in the first panel of the row in which it is seen.
  row(colour, points) {
    const {controls} = this, told = new Set();
    controls.colour.value = colour;
    if (controls.colour.value !== colour) {
      const names = [...controls.colour.options].map(o => o.value).join(', ');
      throw new Error(`there is no field '${colour}'. Name one of ${names}.`);
    }
    controls.logarithmic.checked = this.given.log;
    controls.colour.onchange();
    if (colour !== 'region') this.legend = document.getElementById('legend').cloneNode(true);
    const panels =
        this.frames.map((frame, k) => this.panel(k, this.stateOf(frame), told, k === 0 ? points : []));
    return elementOf('div', {className: 'panels'}, ...panels);
  }

  // The model with so much room around it, in parts of its extent, that labels and scale bar fit.
  whole() {
    const {closeUp, width, height, colour, points} = this.given, [right, up, wide, high] = this.extent();
    for (const margin of MARGINS) try {
        this.letter = 0;
        this.resize(height || Math.round(width * high / wide + (margin - 1) * width));
        this.lookAt(right, up, margin * Math.max(wide, high * this.viewer.camera.aspect));
        return this.row(colour, closeUp ? [] : points);
      } catch (fault) {
        if (margin === MARGINS[MARGINS.length - 1]) throw fault;
      }
  }

  rows() {
    const {closeUp, width, height, colour, points, view} = this.given;
    this.resize(height || Math.round(width / 1.2));
    this.controls.view(view);
    this.inset = closeUp;
    if (this.flat) this.light();
    const rows = [this.flat ? this.whole() : this.row(colour, points)];
    if (this.legend) {
      this.legend.style.width = Math.min(320, this.frames.length * width - 50) + 'px';
      rows.push(this.legend);
    }
    if (closeUp) {
      this.inset = null;
      this.resize(Math.round(width * closeUp[3] / closeUp[2]));
      this.lookAt(...closeUp);
      rows.push(this.row('region', points));
    }
    return rows;
  }
}

// Its size in pixels.
async function compose(given) {
  const page = elementOf('div', {id: 'picture'}, ...new Picture(given).rows());
  document.body.replaceChildren(elementOf('style', {textContent: STYLE}), page);
  await Promise.all([...page.querySelectorAll('img')].map(image => image.decode()));
  const {width, height} = page.getBoundingClientRect();
  return [width, height];
}
