// The scale of a field, linear or logarithmic: its range over all states, its unit, its round ticks.

const FIELD_WORDS = {
  mises: 'Mises stress',
  displacement: 'displacement',
  gap: 'gap',
  contact_pressure: 'contact pressure'
};

function wordsOfField(name) {
  const kind = Object.keys(FIELD_WORDS).find(k => name === k || name.startsWith(k + '_'));
  return kind ? FIELD_WORDS[kind] + (name === kind ? '' : ', ' + name.slice(kind.length + 1)) : name;
}

// 1, 2 or 5 times a power of ten, for four steps or so.
function roundStep(span) {
  const rough = span / 4, power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map(m => m * power).find(step => step >= rough * (1 - 1e-9));
}

// From 0 to 1 on the scale; NaN for no value.
function partOf(value, {low, high, logarithmic}) {
  if (!logarithmic) return (value - low) / (high - low);
  return Math.log(Math.max(value, low) / low) / Math.log(high / low);
}

const MOST_DECADES = 4;

// From and to a power of ten.
function decadesOf(lowest, highest) {
  const high = Math.ceil(Math.log10(highest) - 1e-9), low = Math.floor(Math.log10(lowest) + 1e-9);
  return {low: 10 ** Math.max(Math.min(low, high - 1), high - MOST_DECADES), high: 10 ** high};
}

// Nearly all values of what is visible lie in it; a hundredth may lie beyond its end. A logarithmic one
// leaves out another hundredth below, and what is not positive.
function rangeOf(models, name, isVisible, logarithmic) {
  const sample = [];
  for (const {solid} of models)
    for (let frame = 0; frame < solid.positions.length; ++frame) {
      const field = fieldValues(solid, name, frame), faces = solid.faceCells.length;
      const every = Math.max(1, Math.floor(faces * solid.positions.length / 200000));
      for (let f = 0; field && f < faces; f += every) {
        const cell = solid.faceCells[f];
        if (!isVisible(solid.names[solid.regions[cell]])) continue;
        const value = field.values[field.on === 'cells' ? cell : solid.faceNodes[4 * f]];
        if (!Number.isNaN(value)) sample.push(value);
      }
    }
  if (sample.length === 0) return {low: 0, high: 1, beyond: false};
  sample.sort((a, b) => a - b);
  const positive = logarithmic ? sample.filter(value => value > 0) : [];
  if (positive.length > 0) {
    const at = part => positive[Math.floor(part * (positive.length - 1))],
          range = decadesOf(at(.01), at(.99));
    return {...range, logarithmic, beyond: at(1) > range.high};
  }
  const top = sample[Math.floor(.99 * (sample.length - 1))], most = sample[sample.length - 1];
  const high = top > 0 ? top : most > 0 ? most : 1, step = roundStep(high);
  return {low: 0, high: step * Math.ceil(high / step - 1e-9), beyond: most > high};
}

// MPa are shown as kPa or Pa where tissues are soft.
function shownUnit(unit, high) {
  if (unit !== 'MPa' || high >= 1) return {unit, factor: 1};
  return high >= 1e-3 ? {unit: 'kPa', factor: 1e3} : {unit: 'Pa', factor: 1e6};
}

function unitOfField(models, name) {
  if (name === 'displacement') return 'mm';
  const field = models[0].solid.fields.find(f => f.name === name);
  return field ? field.unit : '';
}

function numberText(value, step) { return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))); }

// Where on the bar, from 0 to 1, and what is written there.
function ticksOf({low, high, logarithmic}, factor) {
  const ticks = [], step = roundStep(high * factor);
  if (logarithmic)
    for (let value = low; value <= high * (1 + 1e-9); value *= 10)
      ticks.push([partOf(value, {low, high, logarithmic}), numberText(value * factor, value * factor)]);
  else
    for (let value = 0; value <= high * factor * (1 + 1e-9); value += step)
      ticks.push([value / (high * factor), numberText(value, step)]);
  return ticks;
}

function legendOf(words, unit, range) {
  const shown = shownUnit(unit, range.high), stops = VIRIDIS.map(cssColour).join(',');
  const ticks =
      ticksOf(range, shown.factor).map(([part, text]) => `<span style="left:${100 * part}%">${text}</span>`);
  return `<p>${words} [${shown.unit}]</p><div class="bar" style="background:linear-gradient(to right,${
      stops})"></div>
    <div class="ticks">${ticks.join('')}</div>
    <p class="note">${
      range.beyond ? 'Up to a hundredth of the values lies beyond the end. ' : ''}Grey: no value.</p>`;
}
