const timeUnit = '√(m ab/kT)', lengthUnit = '√(ab)';
const margin = 0.03;  // of the box, shown beyond its edges

/** What the page carries of a run, ready to be asked for poses. Lengths in units of the box side are fractions. */
class Film {
  constructor(data) {
    Object.assign(this, data);
    this.frames = this.time.length;
    this.poses = numbersFrom(this.poses);
    this.overlapping = this.overlapping.map((particles) => new Set(particles));
    this.rotors = this.shapes.some(([a, b]) => a !== b);
    this.longest = Math.max(...this.shapes.map(([a]) => a));
  }

  boxAt(k) { return this.box[k] ?? this.box[0]; }

  /** x, y from -1/2 to 1/2, angle from 0 to π. */
  pose(k, i) {
    const at = 3 * (k * this.particles + i);
    return [this.poses[at] / 65536 - 0.5, this.poses[at + 1] / 65536 - 0.5, this.poses[at + 2] / 65536 * Math.PI];
  }

  /** Distances from the first frame, of every particle in every frame, in units of length. */
  get displacements() {
    if (this.distances) return this.distances;
    const { particles, frames, poses } = this;
    const far = new Map(this.jumps.map(([k, i, x, y]) => [k * particles + i, [x, y]]));
    const path = new Float64Array(2 * particles);
    this.distances = new Float32Array(frames * particles);
    for (let k = 1; k < frames; ++k) for (let i = 0; i < particles; ++i) {
      const now = 3 * (k * particles + i), before = now - 3 * particles;
      const jump = far.get(k * particles + i) ?? [0, 0];
      for (const axis of [0, 1]) {
        const shortest = (poses[now + axis] - poses[before + axis]) << 16 >> 16;
        path[2 * i + axis] += shortest / 65536 + jump[axis];
      }
      const [boxX, boxY] = this.boxAt(k);
      this.distances[k * particles + i] = Math.hypot(path[2 * i] * boxX, path[2 * i + 1] * boxY);
    }
    return this.distances;
  }

  /** The displacement that 2 % of the particles exceed in the last frame: where the colours end. */
  get largestDisplacement() {
    this.largest ??= this.displacements.slice(-this.particles).sort()[Math.floor(0.98 * (this.particles - 1))] || 1;
    return this.largest;
  }
}

// Colours of particles

const orientationPalette = Array.from({ length: 180 }, (_, k) => orientationColour(k * Math.PI / 180));
const displacementPalette = Array.from({ length: 256 }, (_, k) => sequential(k / 255));

function drawOrientationKey(ctx) {
  for (let k = 0; k <= 8; ++k) {
    ctx.beginPath();
    ctx.ellipse(18 + 28 * k, 14, 12, 5, -k * Math.PI / 8, 0, 2 * Math.PI);
    ctx.fillStyle = orientationColour(k * Math.PI / 8);
    ctx.fill();
    if (k % 2 === 0) keyLabel(ctx, 18 + 28 * k, `${22.5 * k}°`);
  }
}

function drawDisplacementKey(ctx, film) {
  for (let x = 0; x < 240; ++x) {
    ctx.fillStyle = sequential(x / 239);
    ctx.fillRect(8 + x, 5, 1, 18);
  }
  for (const part of [0, 0.5, 1])
    keyLabel(ctx, 14 + 228 * part, (part === 1 ? '≥ ' : '') + shortNumber(part * film.largestDisplacement, 2));
}

const colourings = {
  orientation: {
    name: 'orientation', offered: (film) => film.rotors,
    of: (film, k, i, angle) => {
      const [a, b] = film.shapes[film.shape[i]];
      return a === b ? roundGrey : orientationPalette[Math.floor(angle * 180 / Math.PI) % 180];
    },
    key: drawOrientationKey,
    text: (film) => 'angle of the major axis' + (film.shapes.some(([a, b]) => a === b) ? '; round particles are grey' : ''),
  },
  displacement: {
    name: 'displacement', offered: (film) => film.frames > 1,
    of: (film, k, i) =>
      displacementPalette[Math.min(255, Math.floor(255 * film.displacements[k * film.particles + i] / film.largestDisplacement))],
    key: drawDisplacementKey,
    text: (film) => `displacement from t = ${shortNumber(film.time[0], 4)}, in units of ${lengthUnit}`,
  },
  species: {
    name: 'species', offered: (film) => film.species || !film.rotors && film.frames === 1,
    of: (film, k, i) => curveColour(film.species?.[i] ?? 0),
    key: drawSpeciesKey,
    text: () => 'species',
  },
};

// The player

/** Frames per second. */
const speeds = [1, 3, 10, 30, 60];

class Player extends Picture {
  constructor() {
    super(colourings);
    this.playing = false;
    this.k = 0;
    this.speed = matchMedia('(prefers-reduced-motion: reduce)').matches ? 1 : 10;
    this.view = { x: 0, y: 0, zoom: 1 };
    this.listen();
  }

  get subject() { return this.film; }

  /** Shows this film, or says that there is nothing to show; `texts`: label, note. */
  load(data, texts) {
    this.pause();
    this.texts = texts;
    this.film = data && new Film(data);
    byId('movie').classList.toggle('empty', !this.film);
    if (!this.film) return byId('movie-note').textContent = texts.note;
    this.k = 0;
    byId('player').hidden = byId('play-keys').hidden = this.film.frames < 2;
    byId('scrub').max = this.film.frames - 1;
    this.offerColours();
    this.reset();
    byId('movie-note').textContent = this.note();
  }

  note() {
    const { film } = this;
    const [boxX, boxY] = film.boxAt(0);
    const whole = film.window[0] === 1;
    const shown = whole ? `N = ${film.runParticles} in a periodic box of ${shortNumber(boxX, 4)} × ${shortNumber(boxY, 4)}`
      : `The ${film.particles} of N = ${film.runParticles} particles that begin in the middle of the box, ` +
        `${shortNumber(film.window[0] * boxX, 4)} × ${shortNumber(film.window[1] * boxY, 4)}`;
    const frames = film.frames === film.runFrames ? `all ${film.frames} frames`
      : `${film.frames} of ${film.runFrames} frames, evenly thinned`;
    return `${shown}. ${film.runFrames > 1 && film.frames > 1 ? `The page holds ${frames}. ` : ''}${this.texts.note}`;
  }

  // Time

  go(k) {
    this.k = Math.min(Math.max(k, 0), this.film.frames - 1);
    this.draw();
  }

  play() {
    if (this.film.frames < 2) return;
    if (this.k === this.film.frames - 1) this.k = 0;
    this.playing = true;
    byId('play').textContent = 'Pause';
    let last = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      const frames = Math.floor((now - last) * this.speed / 1000);
      if (frames > 0) {
        last += frames * 1000 / this.speed;
        this.go(this.k + frames);
        if (this.k === this.film.frames - 1) return this.pause();
      }
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  pause() {
    this.playing = false;
    byId('play').textContent = 'Play';
  }

  toggle() {
    if (this.playing) this.pause(); else this.play();
  }

  // View: centre in fractions of the box, never beyond its edges; zoom at least the whole box.

  look(x, y, zoom) {
    const inside = (value) => Math.min(Math.max(value, -0.5), 0.5);
    this.view = { x: inside(x), y: inside(y), zoom: Math.min(Math.max(zoom, 1), 60) };
    if (this.view.zoom === 1) this.view.x = this.view.y = 0;
    this.canvas.style.touchAction = this.view.zoom > 1 ? 'none' : 'pan-y';
    this.draw();
  }

  reset() { this.look(0, 0, 1); }

  /** Pixels per unit of length, and the sides of what the whole view shows. */
  geometry() {
    const box = this.film.boxAt(this.k).map((side, axis) => side * this.film.window[axis]);
    const border = this.film.window[0] === 1 ? 1 + 2 * margin : 1;
    const scale = this.canvas.width / (box[0] * border) * this.view.zoom;
    return { box: this.film.boxAt(this.k), scale, width: this.canvas.width, height: this.canvas.height };
  }

  /** Zooms such that the point under (px, py), in pixels of the page from the corner of the canvas, stays. */
  zoomAt(px, py, factor) {
    const { box, scale, width, height } = this.geometry();
    const zoom = Math.min(Math.max(this.view.zoom * factor, 1), 60);
    const grown = 1 - this.view.zoom / zoom;
    const dx = (px * devicePixelRatio - width / 2) / scale / box[0];
    const dy = -(py * devicePixelRatio - height / 2) / scale / box[1];
    this.look(this.view.x + dx * grown, this.view.y + dy * grown, zoom);
  }

  drag(px, py) {
    const { box, scale } = this.geometry();
    this.look(this.view.x - px * devicePixelRatio / scale / box[0], this.view.y + py * devicePixelRatio / scale / box[1],
      this.view.zoom);
  }

  // Input

  listen() {
    byId('speed').append(...speeds.map((speed) => element('option', { value: speed }, `${speed} frame${speed > 1 ? 's' : ''}/s`)));
    byId('speed').value = this.speed;
    byId('speed').addEventListener('change', () => { this.speed = Number(byId('speed').value); });
    byId('play').addEventListener('click', () => this.toggle());
    byId('scrub').addEventListener('input', () => { this.pause(); this.go(Number(byId('scrub').value)); });
  }

  keys(shift) {
    const step = (frames) => () => { this.pause(); this.go(this.k + frames); };
    const slide = (x, y) => () => this.drag(-x * 40, -y * 40);
    return shift
      ? { ArrowLeft: slide(-1, 0), ArrowRight: slide(1, 0), ArrowUp: slide(0, -1), ArrowDown: slide(0, 1) }
      : { ' ': () => this.toggle(), ArrowLeft: step(-1), ArrowRight: step(1), Home: step(-Infinity), End: step(Infinity) };
  }

  // Drawing

  draw() {
    const { film, k, canvas } = this;
    const [boxX, boxY] = film.boxAt(k);
    const width = canvas.clientWidth;
    const height = Math.round(width * boxY * film.window[1] / (boxX * film.window[0]));
    const ctx = prepareCanvas(canvas, width, height);
    const shifts = film.window[0] === 1 ? [-1, 0, 1] : [0];
    for (const sx of shifts) for (const sy of shifts) if (sx || sy) this.drawCopy(ctx, sx, sy, 0.35);
    this.drawCopy(ctx, 0, 0, 1);
    if (shifts.length > 1) this.drawBox(ctx);
    this.tell();
  }

  /** From fractions of the box to pixels. */
  placing() {
    const { box, scale, width, height } = this.geometry();
    return { scale, x: (fraction) => width / 2 + (fraction - this.view.x) * box[0] * scale,
             y: (fraction) => height / 2 - (fraction - this.view.y) * box[1] * scale };
  }

  /** The particles of the image of the box at (sx, sy); those that overlap come last, in red. */
  drawCopy(ctx, sx, sy, opacity) {
    const { film, k } = this;
    const { scale, x, y } = this.placing();
    const { width, height } = this.canvas;
    const reach = film.longest * scale;
    if (x(sx - 0.5) - reach > width || x(sx + 0.5) + reach < 0 || y(sy + 0.5) - reach > height || y(sy - 0.5) + reach < 0) return;
    const colour = colourings[this.colouring].of;
    const overlapping = film.overlapping[k];
    ctx.globalAlpha = opacity;
    ctx.strokeStyle = isDark() ? 'rgb(0 0 0 / 55%)' : 'rgb(20 25 30 / 60%)';
    const drawParticle = (i, fill) => {
      const [fx, fy, angle] = film.pose(k, i);
      const px = x(fx + sx), py = y(fy + sy);
      if (px + reach < 0 || px - reach > width || py + reach < 0 || py - reach > height) return;
      const [a, b] = film.shapes[film.shape[i]];
      ctx.lineWidth = Math.min(1.2 * devicePixelRatio, 0.25 * b * scale);
      ctx.beginPath();
      ctx.ellipse(px, py, a * scale, b * scale, -angle, 0, 2 * Math.PI);
      ctx.fillStyle = fill ?? colour(film, k, i, angle);
      ctx.fill();
      ctx.stroke();
    };
    for (let i = 0; i < film.particles; ++i) if (!overlapping.has(i)) drawParticle(i);
    overlapping.forEach((i) => drawParticle(i, overlapRed));
    ctx.globalAlpha = 1;
  }

  drawBox(ctx) {
    const { x, y } = this.placing();
    ctx.strokeStyle = cssColour('--ink');
    ctx.lineWidth = 1.25 * devicePixelRatio;
    ctx.strokeRect(x(-0.5), y(0.5), x(0.5) - x(-0.5), y(-0.5) - y(0.5));
  }

  /** What the present frame is, in words. */
  tell() {
    const { film, k } = this;
    const time = `t = ${shortNumber(film.time[k], 5)} ${timeUnit}`;
    const frame = film.frames > 1 ? `, frame ${k + 1} of ${film.frames}` : '';
    byId('clock').textContent = time + frame;
    byId('scrub').value = k;
    byId('scrub').setAttribute('aria-valuetext', time + frame);
    this.canvas.setAttribute('aria-label', `${this.texts.label}: ${film.particles} particles, ${time}${frame}`);
    this.tellOverlaps();
  }

  tellOverlaps() {
    const { film, k } = this;
    const bad = film.overlappingPairs.map((pairs, frame) => pairs ? frame : -1).filter((frame) => frame >= 0);
    const host = byId('overlaps');
    const text = !bad.length
      ? `✓ No overlap in ${film.frames > 1 ? `any of the ${film.frames} frames shown` : 'this state'} (exact check of the stored numbers).`
      : film.overlappingPairs[k] ? `✗ ${film.overlappingPairs[k]} overlapping pair(s) in this frame, in red (exact check).`
        : `✗ Overlaps in ${bad.length} of ${film.frames} frames (exact check), none in this one.`;
    if (host.firstChild?.textContent === text) return;
    host.classList.toggle('bad', bad.length > 0);
    host.replaceChildren(element('span', {}, text));
    if (!bad.length || film.frames < 2) return;
    const next = element('button', { type: 'button', class: 'link' }, 'Next one');
    next.addEventListener('click', () => { this.pause(); this.go(bad.find((frame) => frame > this.k) ?? bad[0]); });
    host.append(' ', next);
  }
}
