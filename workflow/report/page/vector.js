// Records as SVG what charts draw on a canvas. The context has the methods that uPlot and the charts call.

const svgNumber = (value) => String(Math.round(100 * value) / 100);
const svgText = (text) => String(text).replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

/** A path that replaces Path2D. */
class SvgPath {
  constructor(other) { this.text = other?.text ?? ''; }

  add(command, ...numbers) { this.text += command + numbers.map(svgNumber).join(' '); }

  moveTo(x, y) { this.add('M', x, y); }
  lineTo(x, y) { this.add(this.text ? 'L' : 'M', x, y); }
  bezierCurveTo(...numbers) { this.add('C', ...numbers); }
  closePath() { this.text += 'Z'; }

  rect(x, y, width, height) {
    this.add('M', x, y);
    this.text += `h${svgNumber(width)}v${svgNumber(height)}h${svgNumber(-width)}Z`;
  }

  arc(x, y, radius, from, to) {
    const at = (angle) => [x + radius * Math.cos(angle), y + radius * Math.sin(angle)], middle = 0.5 * (from + to);
    this.lineTo(...at(from));
    for (const end of [middle, to]) this.add('A', radius, radius, 0, 0, 1, ...at(end));
  }
}

let clipPaths = 0;
const measuring = document.createElement('canvas').getContext('2d');

/** A drawing context of this size in pixels. `text()` returns everything drawn so far as SVG. */
class SvgContext {
  constructor(width, height) {
    this.canvas = { width, height };
    this.body = '';
    this.saved = [];
    this.state = { x: 0, y: 0, clip: '' };
    this.path = new SvgPath();
    this.dash = [];
    Object.assign(this, { fillStyle: '#000', strokeStyle: '#000', lineWidth: 1, globalAlpha: 1, font: '', textAlign: 'start', textBaseline: 'alphabetic',
                          lineJoin: 'miter', lineCap: 'butt' });
  }

  save() {
    const { fillStyle, strokeStyle, lineWidth, globalAlpha, font, textAlign, textBaseline, lineJoin, lineCap, dash, state } = this;
    this.saved.push({ fillStyle, strokeStyle, lineWidth, globalAlpha, font, textAlign, textBaseline, lineJoin, lineCap, dash, state });
  }

  restore() { Object.assign(this, this.saved.pop()); }
  translate(x, y) { this.state = { ...this.state, x: this.state.x + x, y: this.state.y + y }; }
  setLineDash(dash) { this.dash = dash; }
  clearRect() {}

  beginPath() { this.path = new SvgPath(); }
  moveTo(x, y) { this.path.moveTo(x, y); }
  lineTo(x, y) { this.path.lineTo(x, y); }
  rect(...numbers) { this.path.rect(...numbers); }
  arc(...numbers) { this.path.arc(...numbers); }
  closePath() { this.path.closePath(); }

  add(tag, attributes, content = '') {
    const { x, y, clip } = this.state;
    const all = { ...attributes, transform: x || y ? `translate(${svgNumber(x)} ${svgNumber(y)})` : '', opacity: this.globalAlpha };
    const text = Object.entries(all).filter(([, value]) => value !== '' && value !== undefined)
      .map(([name, value]) => ` ${name}="${svgText(value)}"`).join('');
    const drawn = `<${tag}${text}>${content}</${tag}>`;
    this.body += clip ? `<g clip-path="url(#${clip})">${drawn}</g>\n` : drawn + '\n';
  }

  stroked() {
    return { fill: 'none', stroke: this.strokeStyle, 'stroke-width': svgNumber(this.lineWidth), 'stroke-dasharray': this.dash.map(svgNumber).join(' '),
             'stroke-linejoin': this.lineJoin, 'stroke-linecap': this.lineCap };
  }

  stroke(path = this.path) { if (path.text) this.add('path', { d: path.text, ...this.stroked() }); }
  fill(path = this.path) { if (path.text) this.add('path', { d: path.text, fill: this.fillStyle }); }

  fillRect(x, y, width, height) {
    this.add('rect', { x: svgNumber(x), y: svgNumber(y), width: svgNumber(width), height: svgNumber(height), fill: this.fillStyle });
  }

  clip(path = this.path) {
    const { x, y, clip } = this.state, name = `clip-${++clipPaths}`;
    this.body += `<clipPath id="${name}"${clip ? ` clip-path="url(#${clip})"` : ''}>` +
      `<path d="${path.text}" transform="translate(${svgNumber(x)} ${svgNumber(y)})"/></clipPath>\n`;
    this.state = { ...this.state, clip: name };
  }

  write(text, x, y, style) {
    if (!text) return;
    const anchor = { center: 'middle', right: 'end', end: 'end' }[this.textAlign] ?? 'start';
    const baseline = { top: 'text-before-edge', middle: 'central', bottom: 'text-after-edge' }[this.textBaseline] ?? '';
    this.add('text', { x: svgNumber(x), y: svgNumber(y), style: `font:${this.font}`, 'text-anchor': anchor, 'dominant-baseline': baseline, ...style },
             svgText(text));
  }

  fillText(text, x, y) { this.write(text, x, y, { fill: this.fillStyle }); }
  strokeText(text, x, y) { this.write(text, x, y, this.stroked()); }

  measureText(text) {
    measuring.font = this.font;
    return measuring.measureText(text);
  }

  text(scale) {
    const { width, height } = this.canvas;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${svgNumber(width / scale)}" height="${svgNumber(height / scale)}" ` +
      `viewBox="0 0 ${svgNumber(width)} ${svgNumber(height)}">\n${this.body}</svg>\n`;
  }
}

/** Makes a plot that draws on this context instead of a canvas. */
function plotOn(context, options, data) {
  const { getContext } = HTMLCanvasElement.prototype, { Path2D } = window;
  try {
    HTMLCanvasElement.prototype.getContext = () => context;
    window.Path2D = SvgPath;
    new uPlot({ ...options, pxAlign: 0 }, data).batch(() => {});
  } finally {
    HTMLCanvasElement.prototype.getContext = getContext;
    window.Path2D = Path2D;
  }
}
