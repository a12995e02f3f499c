// Labels of a panel: each in free space, with a short leader that crosses nothing. Lengths in pixels of the
// page.

const LABEL_HEIGHT = 14, LABEL_PAD = 3, LEAST_LEADER = 9, LEAST_INK = 12;
const ADVICE = 'Choose larger panels, another close-up or other points.';

// Red, green, blue and opacity of every pixel, row by row.
function pixelsOf(canvas, width, height) {
  const small = elementOf('canvas', {width, height}), context = small.getContext('2d');
  context.drawImage(canvas, 0, 0, width, height);
  return context.getImageData(0, 0, width, height).data;
}

// 1 where the pixels differ from others; from white without.
function inkOf(pixels, others) {
  const ink = new Uint8Array(pixels.length / 4),
        away = (i, c) => Math.abs(pixels[4 * i + c] - (others ? others[4 * i + c] : 255));
  for (let i = 0; i < ink.length; ++i) ink[i] = away(i, 0) + away(i, 1) + away(i, 2) > 3 ? 1 : 0;
  return ink;
}

// Tried in turn: how far inside of its own ink, how far from other things (-1: anywhere) a leader ends.
const PLACES = [[3, 3], [1, 3], [0, 3], [2, 0], [1, 0], [0, 0], [0, -1]];

// At most 80 places of the ink.
function anchorsOf(ink, others, width, height) {
  const around = r => [0, r, -r, r * width, -r * width];
  for (const [inside, away] of PLACES) {
    const all = [];
    for (let y = 6; y < height - 6; ++y)
      for (let x = 6; x < width - 6; ++x) {
        const at = y * width + x;
        if (!around(inside).every(step => ink[at + step])) continue;
        if (away < 0 || around(away).every(step => !others.some(other => other[at + step]))) all.push([x, y]);
      }
    const every = Math.max(1, Math.floor(all.length / 80));
    if (all.length >= LEAST_INK || away < 0) return all.filter((_, i) => i % every === 0);
  }
}

function areCrossing([a, b], [c, d]) {
  const side = (p, q, r) => Math.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  return side(a, b, c) !== side(a, b, d) && side(c, d, a) !== side(c, d, b);
}

// What of a panel is still free.
class Room {
  constructor(ink, width, height) {
    Object.assign(this, {ink, width, height, boxes: [], leaders: [], edges: []});
    this.sums = new Int32Array((width + 1) * (height + 1));  // ink above and to the left
    for (let y = 0; y < height; ++y)
      for (let x = 0, row = 0; x < width; ++x) {
        row += ink[y * width + x];
        this.sums[(y + 1) * (width + 1) + x + 1] = this.sums[y * (width + 1) + x + 1] + row;
      }
  }

  isFree({x, y, w, h}) {
    const left = x - LABEL_PAD, top = y - LABEL_PAD, right = x + w + LABEL_PAD, bottom = y + h + LABEL_PAD;
    if (left < 0 || top < 0 || right > this.width || bottom > this.height) return false;
    const sum = (i, j) => this.sums[j * (this.width + 1) + i];
    if (sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top) > 0) return false;
    if (this.boxes.some(b => left < b.x + b.w && b.x < right && top < b.y + b.h && b.y < bottom))
      return false;
    const corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
    return ![...this.leaders, ...this.edges].some(
        l => corners.some((c, i) => areCrossing(l, [c, corners[(i + 1) % 4]])));
  }

  // Its length, with what it crosses of other things; infinite where it would cross a label.
  costOf([from, to], own) {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]], length = Math.hypot(dx, dy);
    if (this.leaders.some(l => areCrossing(l, [from, to]))) return Infinity;
    let crossed = 0;
    for (let t = 0; t <= 1; t += 1 / length) {
      const x = Math.round(from[0] + t * dx), y = Math.round(from[1] + t * dy), at = y * this.width + x;
      if (this.boxes.some(b => x >= b.x && x <= b.x + b.w && y >= b.y && y <= b.y + b.h)) return Infinity;
      if (this.ink[at] && !own[at]) ++crossed;
    }
    return length + 4 * crossed;
  }

  // The cheapest box of that width, its leader and cost; null if none is free.
  bestFor(w, anchors, own) {
    const h = LABEL_HEIGHT;
    let best = null;
    for (let y = LABEL_PAD; y < this.height - h; y += 4)
      for (let x = LABEL_PAD; x < this.width - w; x += 4) {
        if (!this.isFree({x, y, w, h})) continue;
        for (const [sx, sy] of [[-1, 0], [1, 0], [0, -1], [0, 1]]) {
          const from = [x + w / 2 + sx * (w / 2 + 1), y + h / 2 + sy * (h / 2 + 1)];
          for (const to of anchors) {
            const dx = to[0] - from[0], dy = to[1] - from[1];
            if (dx * sx + dy * sy < LEAST_LEADER || (best && Math.hypot(dx, dy) >= best.cost)) continue;
            const cost = this.costOf([from, to], own);
            if (cost < (best ? best.cost : Infinity)) best = {box: {x, y, w, h}, leader: [from, to], cost};
          }
        }
      }
    return best;
  }

  take(box, leader) {
    this.boxes.push(box);
    if (leader) this.leaders.push(leader);
  }

  // Labels keep clear of its edges, leaders may cross them.
  takeEdges({x, y, w, h}) {
    const corners = [[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
    corners.forEach((corner, i) => this.edges.push([corner, corners[(i + 1) % 4]]));
  }
}

function textWidth(text) {
  const context = elementOf('canvas').getContext('2d');
  context.font = LABEL_FONT;
  return Math.ceil(context.measureText(text).width);
}

// SVG of all labels; `wanted`: {text, ink}, or {text, at} for a place. The smallest things choose first.
function labelsOf(room, wanted, inks) {
  const none = new Uint8Array(room.ink.length), amount = l => l.at ? 0 : l.ink.reduce((a, b) => a + b, 0);
  return wanted.map(l => ({...l, amount: amount(l)}))
      .sort((a, b) => a.amount - b.amount)
      .map(label => {
        const anchors = label.at ?
            [label.at] :
            anchorsOf(label.ink, inks.filter(i => i !== label.ink), room.width, room.height);
        const best = room.bestFor(textWidth(label.text), anchors, label.ink || none);
        if (!best) throw new Error(`there is no room for the label '${label.text}'. ${ADVICE}`);
        room.take(best.box, best.leader);
        const {box, leader: [[x1, y1], [x2, y2]]} = best;
        return `<line x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}"/><circle cx="${x2}" cy="${y2}" r="1.6"/>` +
            `<text x="${box.x}" y="${box.y + 11}">${label.text}</text>`;
      })
      .join('');
}

// SVG of a bar of round length in a corner of the panel that is free.
function scaleBarOf(room, mmPerPixel) {
  const length = roundStep(mmPerPixel * room.width), text = `${length} mm`,
        wide = Math.round(length / mmPerPixel);
  const w = Math.max(wide, textWidth(text)), h = LABEL_HEIGHT + 6, xs = [8, room.width - w - 8],
        ys = [room.height - h - 6, 6];
  const box = ys.flatMap(y => xs.map(x => ({x, y, w, h}))).find(b => room.isFree(b));
  if (!box) throw new Error(`there is no room for the scale bar. ${ADVICE}`);
  room.take(box);
  const left = box.x + (w - wide) / 2, y = box.y + h - 2;
  return `<path class="scale" d="M${left} ${y - 3}v6m0 -3h${wide}m0 -3v6"/>` +
      `<text x="${box.x + w / 2}" y="${box.y + 11}" text-anchor="middle">${text}</text>`;
}
