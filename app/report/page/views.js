// The views that buttons offer.

const VIEWS = {
  open: 'Section and outside',
  section: 'Section',
  detail: 'Close-up',
  whole: 'Whole model',
  inside: 'Look inside'
};

// Direction, centre and radius of a view; sections are seen from where the other half would be.
function lookOf(name, viewer, axis) {
  const {low, high, part, centre, size} = viewer.box, c = 'xyz'.indexOf(axis);
  if (name === 'inside') return [new THREE.Vector3(0, -.45, 1), centre, .32 * size];
  if (name === 'whole') return [new THREE.Vector3(.75, .4, .8), centre, .36 * size];
  const side = viewer.model.symmetry.length === 1 && part.high[c] > -part.low[c] ? -1 : 1;
  const towards = new THREE.Vector3().setComponent(c, side);
  if (name === 'open') towards.addScaledVector(new THREE.Vector3(c === 0 ? 0 : .6, .3, c === 2 ? 0 : .75), 1);
  if (name === 'detail') return [towards, mostPressed(viewer, c) || centre, .13 * size];
  return [towards, centre, .33 * size];
}

// The node of the section that contact presses most at the end; else null.
function mostPressed(viewer, c) {
  const {solid, frames} = viewer.model, last = frames.length - 1,
                pressure = fieldValues(solid, 'contact_pressure', last);
  if (!pressure) return null;
  const x = solid.positions[last];
  let best = -1;
  for (let n = 0; n < solid.nodes; ++n)
    if (pressure.values[n] > 0 &&
        Math.abs(x[3 * n + c] - viewer.box.centre.getComponent(c)) < .08 * viewer.box.size &&
        (best < 0 || pressure.values[n] > pressure.values[best]))
      best = n;
  return best < 0 ? null : new THREE.Vector3().fromArray(x, 3 * best).setComponent(c, 0);
}
