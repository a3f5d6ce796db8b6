const margin = 0.03;  // width of the image around the box, in box lengths
const poseSize = 3;   // x, y and angle

const orientationPalette = Array.from({ length: 180 }, (_, k) => orientationColour(k * Math.PI / 180));

const angleOf = (film, k, i) => film.poses[film.placeOf(k, i) + 2] / 65536 * Math.PI;

function drawOrientationKey(ctx) {
  for (let k = 0; k <= 8; ++k) {
    ctx.beginPath();
    ctx.ellipse(18 + 28 * k, 14, 12, 5, -k * Math.PI / 8, 0, 2 * Math.PI);
    ctx.fillStyle = orientationColour(k * Math.PI / 8);
    ctx.fill();
    if (k % 2 === 0) keyLabel(ctx, 18 + 28 * k, `${22.5 * k}°`);
  }
}

const planeColourings = {
  orientation: {
    name: 'orientation', offered: (film) => film.rotors,
    of: (film, k, i) => isRound(film.axesOf(i)) ? roundGrey : orientationPalette[Math.floor(angleOf(film, k, i) * 180 / Math.PI) % 180],
    key: drawOrientationKey,
    text: (film) => 'angle of the major axis' + greyIfRound(film),
  },
  ...commonColourings,
};

/** A player of particles in the plane, drawn with the images of the box around it. */
class Player extends FilmPlayer {
  constructor() {
    super(planeColourings);
    this.view = { x: 0, y: 0, zoom: 1 };
  }

  // The view has its centre in fractions of the box, within its edges; the zoom is at least that of the whole box.

  look(x, y, zoom) {
    const inside = (value) => Math.min(Math.max(value, -0.5), 0.5);
    this.view = { x: inside(x), y: inside(y), zoom: Math.min(Math.max(zoom, 1), 60) };
    if (this.view.zoom === 1) this.view.x = this.view.y = 0;
    this.canvas.style.touchAction = this.view.zoom > 1 ? 'none' : 'pan-y';
    this.draw();
  }

  reset() { this.look(0, 0, 1); }

  /** The sides of the box, pixels per unit of length, and the size of the canvas in pixels. */
  geometry() {
    const border = this.film.isWhole ? 1 + 2 * margin : 1;
    const scale = this.canvas.width / (this.film.windowAt(this.k)[0] * border) * this.view.zoom;
    return { box: this.film.boxAt(this.k), scale, width: this.canvas.width, height: this.canvas.height };
  }

  /**
   * Zooms so that the point under (px, py), in pixels of the page from the corner of the canvas, stays where it is.
   */
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

  get stepKeys() { return '← →'; }

  get help() {
    return '+ − zoom, 0 shows the whole box, Shift with arrows moves the view. The wheel zooms while the picture has the focus; ' +
      'two fingers zoom, dragging moves the view.';
  }

  keys(shift) {
    const slide = (x, y) => () => this.drag(-x * 40, -y * 40);
    return shift
      ? { ArrowLeft: slide(-1, 0), ArrowRight: slide(1, 0), ArrowUp: slide(0, -1), ArrowDown: slide(0, 1) }
      : { ...this.timeKeys(), ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1) };
  }

  // Drawing

  draw() {
    const { film, canvas } = this;
    const [shownX, shownY] = film.windowAt(this.k);
    const width = canvas.clientWidth;
    const ctx = prepareCanvas(canvas, width, Math.round(width * shownY / shownX));
    const shifts = film.isWhole ? [-1, 0, 1] : [0];
    for (const sx of shifts) for (const sy of shifts) if (sx || sy) this.drawCopy(ctx, sx, sy, 0.35);
    this.drawCopy(ctx, 0, 0, 1);
    if (film.isWhole) this.drawBox(ctx);
    this.tell();
  }

  /** Functions that convert fractions of the box to pixels. */
  placing() {
    const { box, scale, width, height } = this.geometry();
    return { scale, x: (fraction) => width / 2 + (fraction - this.view.x) * box[0] * scale,
             y: (fraction) => height / 2 - (fraction - this.view.y) * box[1] * scale };
  }

  /** Draws the particles of the image of the box at (sx, sy). Particles that overlap come last, in red. */
  drawCopy(ctx, sx, sy, opacity) {
    const { film, k } = this;
    const { scale, x, y } = this.placing();
    const { width, height } = this.canvas;
    const reach = film.longest * scale;
    if (x(sx - 0.5) - reach > width || x(sx + 0.5) + reach < 0 || y(sy + 0.5) - reach > height || y(sy - 0.5) + reach < 0) return;
    const colour = this.colourings[this.colouring].of;
    const overlapping = film.overlapping[k];
    ctx.globalAlpha = opacity;
    ctx.strokeStyle = isDark() ? 'rgb(0 0 0 / 55%)' : 'rgb(20 25 30 / 60%)';
    const drawParticle = (i, fill) => {
      const at = film.placeOf(k, i);
      const px = x(film.poses[at] / 65536 - 0.5 + sx), py = y(film.poses[at + 1] / 65536 - 0.5 + sy);
      if (px + reach < 0 || px - reach > width || py + reach < 0 || py - reach > height) return;
      const [a, b] = film.axesOf(i);
      ctx.lineWidth = Math.min(1.2 * devicePixelRatio, 0.25 * b * scale);
      ctx.beginPath();
      ctx.ellipse(px, py, a * scale, b * scale, -angleOf(film, k, i), 0, 2 * Math.PI);
      ctx.fillStyle = fill ?? colour(film, k, i);
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
}
