const overlapRed = '#f2003c';
const roundGrey = '#9aa3ad';

/** Decodes 16-bit numbers from base64, low byte first. */
function numbersFrom(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  return Uint16Array.from({ length: bytes.length / 2 }, (_, k) => bytes[2 * k] + 256 * bytes[2 * k + 1]);
}

/** Makes a canvas sharp on the screen. Returns its context, whose units are pixels of the screen. */
function prepareCanvas(canvas, width, height) {
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  canvas.style.height = height + 'px';
  return canvas.getContext('2d');
}

// Keys of colours

function keyLabel(ctx, x, text, y = 41) {
  ctx.fillStyle = cssColour('--quiet');
  ctx.font = font;
  ctx.textAlign = 'center';
  ctx.fillText(text, x, y);
}

function drawSpeciesKey(ctx, { speciesNames }) {
  speciesNames.forEach((name, k) => {
    ctx.fillStyle = curveColour(k);
    ctx.fillRect(10 + k * 250 / speciesNames.length, 6, 16, 16);
    keyLabel(ctx, 18 + k * 250 / speciesNames.length, name);
  });
}

/**
 * The picture of a page with its colours and its input. A subclass has `subject`, which is shown (null if there is
 * nothing yet), draw(), drag(dx, dy, event) and zoomAt(x, y, factor) in pixels of the page, reset(), and an object of
 * actions for keys(). A colouring is {name, offered(subject), text(subject), key(ctx, subject), keyHeight}.
 */
class Picture {
  constructor(colourings) {
    this.canvas = byId('scene');
    this.colourings = colourings;
    this.colouring = null;
    this.pointers = new Map();
    byId('zoom-in').addEventListener('click', () => this.zoomBy(1.5));
    byId('zoom-out').addEventListener('click', () => this.zoomBy(1 / 1.5));
    byId('zoom-reset').addEventListener('click', () => this.reset());
    this.canvas.addEventListener('keydown', (event) => this.press(event));
    this.canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    for (const kind of ['pointerdown', 'pointermove', 'pointerup', 'pointercancel'])
      this.canvas.addEventListener(kind, (event) => this.point(event));
    this.watch();
  }

  // Colours

  offerColours() {
    const offered = Object.entries(this.colourings).filter(([, colouring]) => colouring.offered(this.subject));
    if (!offered.some(([key]) => key === this.colouring)) this.colouring = offered[0][0];
    const host = byId('colour');
    host.hidden = offered.length < 2;
    host.querySelectorAll('label').forEach((label) => label.remove());
    offered.forEach(([key, { name }]) => {
      const label = element('label');
      const input = element('input', { type: 'radio', name: 'colour', value: key });
      input.checked = key === this.colouring;
      input.addEventListener('change', () => { this.colouring = key; this.draw(); this.drawKey(); });
      label.append(input, name);
      host.append(label);
    });
    this.drawKey();
  }

  drawKey() {
    const { key, keyHeight, text } = this.colourings[this.colouring];
    const canvas = byId('key');
    const ctx = prepareCanvas(canvas, 260, keyHeight ?? 44);
    ctx.scale(devicePixelRatio, devicePixelRatio);
    key(ctx, this.subject);
    byId('key-text').textContent = text(this.subject);
    canvas.setAttribute('aria-label', `Colours: ${text(this.subject)}`);
  }

  // Input

  zoomBy(factor) { this.zoomAt(this.canvas.clientWidth / 2, this.canvas.clientHeight / 2, factor); }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.subject) return;
    const zoom = { '+': () => this.zoomBy(1.5), '=': () => this.zoomBy(1.5), '-': () => this.zoomBy(1 / 1.5), 0: () => this.reset() };
    const action = this.keys(event.shiftKey)[event.key] ?? zoom[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** The wheel scrolls the page unless the picture has the focus or Ctrl is pressed. */
  wheel(event) {
    if (!this.subject || (document.activeElement !== this.canvas && !event.ctrlKey)) return;
    event.preventDefault();
    this.zoomAt(event.offsetX, event.offsetY, Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.002)));
  }

  /** One finger or the mouse drags the view, and two fingers zoom it. */
  point(event) {
    const spread = () => {
      const [p, q] = [...this.pointers.values()];
      return Math.hypot(p.x - q.x, p.y - q.y);
    };
    const here = { x: event.offsetX, y: event.offsetY };
    const before = this.pointers.get(event.pointerId);
    if (event.type === 'pointerdown') {
      this.pointers.set(event.pointerId, here);
      return this.canvas.setPointerCapture(event.pointerId);
    }
    if (event.type !== 'pointermove') return this.pointers.delete(event.pointerId);
    if (!before || !this.subject) return;
    if (this.pointers.size === 1) {
      this.pointers.set(event.pointerId, here);
      return this.drag(here.x - before.x, here.y - before.y, event);
    }
    const old = spread();
    this.pointers.set(event.pointerId, here);
    const [p, q] = [...this.pointers.values()];
    if (old > 0) this.zoomAt((p.x + q.x) / 2, (p.y + q.y) / 2, spread() / old);
  }

  /** Redraws when the width of the picture or the colours of the page change. */
  watch() {
    let width = this.canvas.parentElement.clientWidth;
    new ResizeObserver(() => {
      if (this.canvas.parentElement.clientWidth === width || !this.subject) return;
      width = this.canvas.parentElement.clientWidth;
      this.draw();
    }).observe(this.canvas.parentElement);
    recoloured.push(() => { if (this.subject) { this.draw(); this.drawKey(); } });
  }
}
