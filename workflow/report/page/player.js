/**
 * The movie of a run or a state as the page stores it, with functions that read its poses. A pose is a row of 16-bit
 * numbers, beginning with the coordinates (movie.h). Fractions are lengths in units of the sides of the box.
 */
class Film {
  constructor(data) {
    Object.assign(this, data);
    this.frames = this.time.length;
    this.poses = numbersFrom(this.poses);
    this.overlapping = this.overlapping.map((particles) => new Set(particles));
    this.rotors = this.shapes.some((axes) => !isRound(axes));
    this.longest = Math.max(...this.shapes.flat());
    this.isWhole = this.window[0] === 1;
  }

  boxAt(k) { return this.box[k] ?? this.box[0]; }

  /** The sides of the part of the box that is shown. */
  windowAt(k) { return this.boxAt(k).map((side, axis) => side * this.window[axis]); }

  /** The index at which the pose of a particle begins. */
  placeOf(k, i) { return poseSize * (k * this.particles + i); }

  axesOf(i) { return this.shapes[this.shape[i]]; }

  /** The distances of every particle in every frame from the first frame, in units of length. */
  get displacements() {
    if (this.distances) return this.distances;
    const { particles, frames, poses } = this;
    const far = new Map(this.jumps.map(([k, i, ...boxes]) => [k * particles + i, boxes]));
    const path = new Float64Array(dimension * particles);
    this.distances = new Float32Array(frames * particles);
    for (let k = 1; k < frames; ++k) for (let i = 0; i < particles; ++i) {
      const now = this.placeOf(k, i), before = this.placeOf(k - 1, i), box = this.boxAt(k);
      const jump = far.get(k * particles + i);
      let square = 0;
      for (let axis = 0; axis < dimension; ++axis) {
        const shortest = (poses[now + axis] - poses[before + axis]) << 16 >> 16;
        path[dimension * i + axis] += shortest / 65536 + (jump?.[axis] ?? 0);
        square += (path[dimension * i + axis] * box[axis]) ** 2;
      }
      this.distances[k * particles + i] = Math.sqrt(square);
    }
    return this.distances;
  }

  /** The displacement that 2 % of the particles exceed in the last frame, where the colour scale ends. */
  get largestDisplacement() {
    this.largest ??= this.displacements.slice(-this.particles).sort()[Math.floor(0.98 * (this.particles - 1))] || 1;
    return this.largest;
  }
}

const isRound = (axes) => axes.every((axis) => axis === axes[0]);

// The colourings that the plane and space share. The colouring by orientation differs and precedes them.

const displacementPalette = Array.from({ length: 256 }, (_, k) => sequential(k / 255));

function drawDisplacementKey(ctx, film) {
  for (let x = 0; x < 240; ++x) {
    ctx.fillStyle = sequential(x / 239);
    ctx.fillRect(8 + x, 5, 1, 18);
  }
  for (const part of [0, 0.5, 1])
    keyLabel(ctx, 14 + 228 * part, (part === 1 ? '≥ ' : '') + shortNumber(part * film.largestDisplacement, 2));
}

const greyIfRound = (film) => film.shapes.some(isRound) ? '; round particles are grey' : '';

const commonColourings = {
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

/** The speeds that the user can choose, in frames per second. */
const speeds = [1, 3, 10, 30, 60];

/**
 * Plays a film and shows its time and notes. A subclass draws a frame and moves the view (Picture), and has `help`,
 * its part of the explanation of the keys.
 */
class FilmPlayer extends Picture {
  constructor(colourings) {
    super(colourings);
    this.playing = false;
    this.k = 0;
    this.speed = matchMedia('(prefers-reduced-motion: reduce)').matches ? 1 : 10;
    this.listen();
  }

  get subject() { return this.film; }

  /** Shows this film, or says that there is nothing to show. `texts` has a label and a note. */
  load(data, texts) {
    this.pause();
    this.texts = texts;
    this.film = data && new Film(data);
    byId('movie').classList.toggle('empty', !this.film);
    if (!this.film) return byId('movie-note').textContent = texts.note;
    this.k = 0;
    byId('player').hidden = this.film.frames < 2;
    byId('scrub').max = this.film.frames - 1;
    this.offerColours();
    this.reset();
    byId('movie-note').textContent = this.note();
    const keys = this.film.frames > 1 ? `space plays and pauses, ${this.stepKeys} step, Home and End, ` : '';
    byId('movie-help').textContent = `Keys, with the picture in focus: ${keys}${this.help}`;
  }

  /** The part of a note that is about images; it follows the part about particles. */
  get imagesText() { return ''; }

  note() {
    const { film } = this;
    const sides = (lengths) => lengths.map((side) => shortNumber(side, 4)).join(' × ');
    const moves = film.runFrames > 1 && film.frames > 1;
    const shown = film.isWhole ? `N = ${film.runParticles} in a periodic box of ${sides(film.boxAt(0))}`
      : `The ${film.particles} of N = ${film.runParticles} particles that ${moves ? 'begin' : 'are'} in the middle of the box, ` +
        sides(film.windowAt(0));
    const frames = film.frames === film.runFrames ? `all ${film.frames} frames`
      : `${film.frames} of ${film.runFrames} frames, evenly thinned`;
    return `${shown}${this.imagesText}. ${moves ? `The page holds ${frames}. ` : ''}${this.texts.note}`;
  }

  // Time

  go(k) {
    this.k = Math.min(Math.max(k, 0), this.film.frames - 1);
    this.draw();
  }

  step(frames) {
    this.pause();
    this.go(this.k + frames);
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

  listen() {
    byId('speed').append(...speeds.map((speed) => element('option', { value: speed }, `${speed} frame${speed > 1 ? 's' : ''}/s`)));
    byId('speed').value = this.speed;
    byId('speed').addEventListener('change', () => { this.speed = Number(byId('speed').value); });
    byId('play').addEventListener('click', () => this.toggle());
    byId('scrub').addEventListener('input', () => { this.pause(); this.go(Number(byId('scrub').value)); });
  }

  timeKeys() {
    return { ' ': () => this.toggle(), Home: () => this.step(-Infinity), End: () => this.step(Infinity) };
  }

  /** Describes the present frame in words. */
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
    const host = byId('overlaps'), moves = film.frames > 1;
    const text = !bad.length
      ? `✓ No overlap${moves ? ` in any of the ${film.frames} frames shown` : ''} (exact check of the stored numbers).`
      : film.overlappingPairs[k]
        ? `✗ ${film.overlappingPairs[k]} overlapping pair(s)${moves ? ' in this frame' : ''}, in red` +
          `${film.isWhole ? '' : ' where they are shown'} (exact check of the stored numbers).`
        : `✗ Overlaps in ${bad.length} of ${film.frames} frames (exact check of the stored numbers), none in this one.`;
    if (host.firstChild?.textContent === text) return;
    host.classList.toggle('bad', bad.length > 0);
    host.replaceChildren(element('span', {}, text));
    if (!bad.length || !moves) return;
    const next = element('button', { type: 'button', class: 'link' }, 'Next one');
    next.addEventListener('click', () => { this.pause(); this.go(bad.find((frame) => frame > this.k) ?? bad[0]); });
    host.append(' ', next);
  }
}
