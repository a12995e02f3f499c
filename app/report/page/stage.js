// A canvas with camera and light, that is turned with mouse, fingers or keys. Nothing is drawn without a
// change.

const FIELD_OF_VIEW = 28, BACKGROUND = 0xfbfbf9;

class Stage {
  constructor(element, size) {
    Object.assign(this, {element, onMove: () => {}, pending: false});
    this.slow = isDrawnBySoftware();
    this.renderer = new THREE.WebGLRenderer({antialias: !this.slow, preserveDrawingBuffer: true});
    this.renderer.localClippingEnabled = true;
    this.renderer.setClearColor(BACKGROUND);
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'The model in 3-D. Arrow keys turn it, plus and minus zoom.');
    this.element.appendChild(canvas);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, .01 * size, 30 * size);
    this.scene.add(this.camera, new THREE.HemisphereLight(0xffffff, 0xe2ded6, .74));
    const lamp = new THREE.DirectionalLight(0xffffff, .36);
    lamp.position.set(-.4, .6, 1);
    this.camera.add(lamp);
    this.camera.add(lamp.target);
    lamp.target.position.set(0, 0, -1);
    this.orbit = new THREE.OrbitControls(this.camera, canvas);
    this.orbit.enableKeys = false;
    this.orbit.addEventListener('change', () => this.moved());
    this.orbit.addEventListener('start', () => this.resize(this.slow ? .5 : 1));  // coarse while it turns
    this.orbit.addEventListener('end', () => this.resize());
    canvas.addEventListener('keydown', event => this.key(event));
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  // Looks from `direction` at `centre`, so that a ball of that radius fits.
  look(direction, centre, radius) {
    const half = FIELD_OF_VIEW / 2 * Math.PI / 180, narrow = Math.min(1, this.camera.aspect);
    this.orbit.target.copy(centre);
    this.camera.position.copy(direction).setLength(radius / Math.sin(half) / narrow).add(centre);
    this.orbit.update();
    this.moved();
  }

  key(event) {
    const steps = {ArrowLeft: [-.1, 0], ArrowRight: [.1, 0], ArrowUp: [0, -.1], ArrowDown: [
                     0, .1
                   ]}[event.key];
    const zoom = {'+': .9, '=': .9, '-': 1 / .9}[event.key];
    if (!steps && !zoom) return;
    event.preventDefault();
    const arm = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.orbit.target));
    arm.theta += steps ? steps[0] : 0;
    arm.phi = Math.min(Math.max(arm.phi + (steps ? steps[1] : 0), .01), Math.PI - .01);
    arm.radius *= zoom || 1;
    this.camera.position.setFromSpherical(arm).add(this.orbit.target);
    this.orbit.update();
    this.moved();
  }

  moved() {
    this.onMove(this);
    this.draw();
  }

  follow(other) {
    this.camera.position.copy(other.camera.position);
    this.orbit.target.copy(other.orbit.target);
    this.camera.lookAt(this.orbit.target);
    this.draw();
  }

  resize(fineness = 1) {
    const {clientWidth: width, clientHeight: height} = this.element;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(fineness * Math.min(window.devicePixelRatio || 1, this.slow ? 1 : 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.drawNow();
    });
  }

  drawNow() { this.renderer.render(this.scene, this.camera); }
}

// Without a graphics processor pixels are dear.
function isDrawnBySoftware() {
  const gl = document.createElement('canvas').getContext('webgl'), plain = gl.getParameter(gl.RENDERER);
  const names =
      plain === 'WebKit WebGL' && gl.getExtension('WEBGL_debug_renderer_info');  // Firefox tells it plainly
  return /swiftshader|llvmpipe|software/i.test(
      names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : plain);
}
