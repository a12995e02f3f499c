// The panel: what it says is one state, which all viewers show.

function elementOf(name, properties = {}, ...children) {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}

class Controls {
  constructor(element, legend, models, viewers) {
    Object.assign(this, {element, legend, models, viewers, playing: null});
    const [model] = models;
    this.state = {
      time: model.frames[model.frames.length - 1].time,
      colour: 'region',
      range: {low: 0, high: 1},
      hidden: new Set(),
      mirrored: false,
      cut: {on: false, axis: 'x', part: .5, flipped: false}
    };
    element.append(this.viewRow(), this.timeRow(), this.colourRow(), this.cutRow(), this.itemsRow());
    this.view('open');
  }

  change(part) {
    this.state = {...this.state, ...part};
    if (('colour' in part || 'hidden' in part) && this.state.colour !== 'region') this.setRange();
    this.viewers.forEach(viewer => viewer.show(this.state));
    this.tell();
  }

  // Rows

  viewRow() {
    const buttons = Object.entries(VIEWS).map(
        ([name, words]) =>
            elementOf('button', {type: 'button', textContent: words, onclick: () => this.view(name)}));
    return elementOf('div', {className: 'row'}, elementOf('span', {textContent: 'View'}), ...buttons);
  }

  timeRow() {
    const {frames} = this.models[0];
    this.slider = elementOf('input', {
      type: 'range',
      id: 'state',
      min: 0,
      max: frames.length - 1,
      step: 1,
      value: frames.length - 1,
      oninput: () => this.change({time: frames[this.slider.value].time})
    });
    this.label = elementOf('output', {id: 'state-label'});
    this.play = elementOf('button', {type: 'button', textContent: 'Play', onclick: () => this.togglePlay()});
    return elementOf(
        'div', {className: 'row'}, elementOf('label', {htmlFor: 'state', textContent: 'State'}), this.slider,
        this.play, this.label);
  }

  colourRow() {
    const names = ['region', ...this.models[0].solid.fields.map(f => f.name)];
    names.splice(this.models[0].solid.fields.some(f => f.name === 'mises') ? 2 : 1, 0, 'displacement');
    const options = names.map(
        name => elementOf(
            'option', {value: name, textContent: name === 'region' ? 'region' : wordsOfField(name)}));
    this.colour = elementOf(
        'select', {id: 'colour', onchange: () => this.change({colour: this.colour.value})}, ...options);
    this.logarithmic =
        elementOf('input', {type: 'checkbox', id: 'logarithmic', onchange: this.colour.onchange});
    return elementOf(
        'div', {className: 'row'}, elementOf('label', {htmlFor: 'colour', textContent: 'Colour by'}),
        this.colour, elementOf('label', {}, this.logarithmic, ' logarithmic scale'));
  }

  cutRow() {
    const changed = () => this.change({
      cut: {
        on: this.cut.checked,
        axis: this.axis.value,
        part: this.part.value / 1000,
        flipped: this.flipped.checked
      }
    });
    this.cut = elementOf('input', {type: 'checkbox', onchange: changed});
    this.axis = elementOf(
        'select', {onchange: changed, ariaLabel: 'axis'},
        ...['x', 'y', 'z'].map(axis => elementOf('option', {textContent: axis})));
    this.part = elementOf(
        'input',
        {type: 'range', min: 0, max: 1000, value: 500, oninput: changed, ariaLabel: 'place of the cut'});
    this.flipped = elementOf('input', {type: 'checkbox', onchange: changed});
    this.mirrored = elementOf(
        'input', {type: 'checkbox', onchange: () => this.change({mirrored: this.mirrored.checked})});
    const row = elementOf(
        'div', {className: 'row'}, elementOf('label', {}, this.cut, ' Cut across'), this.axis, this.part,
        elementOf('label', {}, this.flipped, ' other side'));
    if (this.models[0].symmetry.length) row.append(elementOf('label', {}, this.mirrored, ' mirrored parts'));
    return row;
  }

  itemsRow() {
    const seen = new Map();
    for (const v of this.viewers)
      for (const item of [...v.regions, ...v.bodies, ...v.lines]) seen.set(item.name, item.colour);
    const boxes = [...seen].map(([name, colour]) => {
      const box = elementOf(
          'input', {type: 'checkbox', checked: true, onchange: () => this.toggle(name, box.checked)});
      const swatch = elementOf('span', {className: 'swatch'});
      swatch.style.background = cssColour(colour);
      return elementOf('label', {}, box, swatch, name.replaceAll('_', ' '));
    });
    return elementOf('div', {className: 'row items'}, elementOf('span', {textContent: 'Show'}), ...boxes);
  }

  // What they do

  toggle(name, shown) {
    const hidden = new Set(this.state.hidden);
    shown ? hidden.delete(name) : hidden.add(name);
    this.change({hidden});
  }

  togglePlay() {
    const {frames} = this.models[0];
    if (this.playing) clearInterval(this.playing);
    this.playing = this.playing ? null : setInterval(() => {
      this.slider.value = (Number(this.slider.value) + 1) % frames.length;
      this.change({time: frames[this.slider.value].time});
    }, 600);
    this.play.textContent = this.playing ? 'Stop' : 'Play';
  }

  setRange() {
    const name = this.state.colour;
    const visible = region => !this.state.hidden.has(region);
    this.state.range = rangeOf(this.models, name, visible, this.logarithmic.checked);
  }

  tell() {
    const {colour, range} = this.state, frame = this.models[0].frames[this.slider.value];
    this.label.textContent = frame.label;
    this.legend.innerHTML =
        colour === 'region' ? '' : legendOf(wordsOfField(colour), unitOfField(this.models, colour), range);
  }

  // Views

  view(name) {
    const {symmetry} = this.models[0], half = symmetry.length === 1, inside = name === 'inside';
    const whole = name === 'whole' || inside || !half, cutAxis = inside ? 'z' : 'x',
          on = inside || (!half && name !== 'whole');
    this.mirrored.checked = whole;
    Object.assign(this.cut, {checked: on});
    Object.assign(this.axis, {value: cutAxis});
    Object.assign(this.part, {value: inside ? 720 : 500});
    this.change({
      mirrored: whole,
      cut: {on, axis: cutAxis, part: this.part.value / 1000, flipped: this.flipped.checked = false}
    });
    for (const viewer of this.viewers) viewer.look(...lookOf(name, viewer, half ? symmetry[0] : 'x'));
  }
}
