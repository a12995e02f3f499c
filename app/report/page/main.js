// Starts the page. `window.report` is for tests: it says when all is drawn, and draws on request.

function tellFault(words) {
  document.querySelectorAll('.canvas').forEach(canvas => canvas.textContent = words);
}

function canDraw() {
  const canvas = document.createElement('canvas');
  return typeof DecompressionStream === 'function' &&
      Boolean(canvas.getContext('webgl') || canvas.getContext('experimental-webgl'));
}

async function start() {
  if (!canDraw())
    return tellFault(
        'This browser cannot draw in 3-D: it needs WebGL, and Firefox 113, Chromium 80 or later.');
  const packed = JSON.parse(document.getElementById('models').textContent), models = [];
  for (const model of packed) models.push(await modelOf(model));
  const places = [...document.querySelectorAll('.canvas')],
        viewers = models.map((model, i) => new Viewer(places[i], model));
  viewers.forEach(viewer => viewer.resize());
  for (const viewer of viewers)
    viewer.onMove = moved => viewers.forEach(other => other !== moved && other.follow(moved));
  const controls =
      new Controls(document.getElementById('controls'), document.getElementById('legend'), models, viewers);
  const told = document.getElementById('told');
  viewers.forEach(viewer => new Picker(viewer, words => told.textContent = words));
  window.report = {viewers, controls, ready: true};
}

start().catch(fault => {
  tellFault('The model cannot be drawn: ' + fault.message);
  throw fault;
});
