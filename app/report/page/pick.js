// A click tells what is there: region, value of the field, place.

class Picker {
  constructor(viewer, tell) {
    Object.assign(this, {viewer, tell, down: null});
    const canvas = viewer.renderer.domElement;
    canvas.addEventListener('pointerdown', event => this.down = [event.clientX, event.clientY]);
    canvas.addEventListener('pointerup', event => {
      const still = this.down && Math.hypot(event.clientX - this.down[0], event.clientY - this.down[1]) < 4;
      if (still) this.pick(event);
    });
  }

  pick(event) {
    const {viewer} = this, box = viewer.renderer.domElement.getBoundingClientRect(),
          ray = new THREE.Raycaster();
    ray.setFromCamera(
        {
          x: 2 * (event.clientX - box.left) / box.width - 1,
          y: 1 - 2 * (event.clientY - box.top) / box.height
        },
        viewer.camera);
    const shown = mesh =>
        mesh.visible && (mesh.userData.item instanceof RegionSurface || mesh.userData.cells);
    const meshes = viewer.images.filter(image => image.group.visible)
                       .flatMap(image => image.group.children.filter(shown));
    const hit = ray.intersectObjects(meshes).find(h => this.isDrawn(h));
    if (hit) this.tell(this.words(hit));
  }

  isDrawn({point, face, object}) {
    if (object.userData.cells) return true;
    return face.materialIndex === 0 && this.viewer.clip.distanceToPoint(point) >= 0;
  }

  words({point, face, object}) {
    const {viewer} = this, {item, cells} = object.userData, {solid} = viewer.model, field = viewer.field();
    const cell = cells ? cells[face.a] : solid.faceCells[item.faces[face.a >> 2]], name = viewer.state.colour;
    const value = field &&
        (field.on === 'cells' ? field.values[cell] :
             cells            ? NaN :
                                field.values[item.corners[face.a]]);
    const unit = shownUnit(unitOfField([viewer.model], name), viewer.state.range.high);
    const told = field && !Number.isNaN(value) ?
        `, ${wordsOfField(name)} ${(value * unit.factor).toPrecision(3)} ${unit.unit}` :
        '';
    const place = point.toArray().map(x => x.toFixed(2)).join(', ');
    return `${solid.names[solid.regions[cell]].replaceAll('_', ' ')}${told}, at x, y, z = ${place} mm`;
  }
}
