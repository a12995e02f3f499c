// Colours of tissues, bodies and lines, and the scale of the fields (viridis: even steps to the eye, also in
// grey).

const KNOWN_COLOURS = {
  cornea: '#8ecbe6',
  sclera: '#efe6d2',
  ciliary_body: '#8a6a55',
  choroid: '#a33f35',
  retina: '#f0a04b',
  optic_nerve: '#e3cf7d',
  lens: '#bfe3dc',
  band: '#3d78b8',
  tire: '#6a51a3',
  zonules: '#8fa3ad'
};
const OTHER_COLOURS =
    ['#d9c7a8', '#7fa7c9', '#c98b7f', '#9cc28f', '#b79ac8', '#cfc36b', '#8fbdb8', '#c7a0b0'];
const LINE_COLOURS = ['#1b7f3b', '#0b5f8a', '#8a3d0b', '#5b2a86'];
const NO_VALUE_COLOUR = [.8, .8, .78];
const VIRIDIS = [
  '#440154', '#482475', '#414487', '#355f8d', '#2a788e', '#21918c', '#22a884', '#44bf70', '#7ad151',
  '#bddf26', '#fde725'
].map(rgbOf);

function rgbOf(hex) { return [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16) / 255); }

function colourOf(name, number, others = OTHER_COLOURS) {
  return rgbOf(KNOWN_COLOURS[name] || others[number % others.length]);
}

// `part` from 0 to 1; what is beyond has the colour of the end.
function viridis(part) {
  if (Number.isNaN(part)) return NO_VALUE_COLOUR;
  const at = Math.min(Math.max(part, 0), 1) * (VIRIDIS.length - 1),
        i = Math.min(Math.floor(at), VIRIDIS.length - 2);
  return VIRIDIS[i].map((low, c) => low + (at - i) * (VIRIDIS[i + 1][c] - low));
}

function cssColour(rgb) { return 'rgb(' + rgb.map(c => Math.round(255 * c)).join(',') + ')'; }
