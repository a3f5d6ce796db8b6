const pageData = JSON.parse(document.getElementById('data').textContent);
const darkMode = matchMedia('(prefers-color-scheme: dark)');
const byId = (id) => document.getElementById(id);
const cssColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function element(tag, attributes = {}, text = '') {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.textContent = text;
  return node;
}

// Numbers

const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';
function superscript(n) {
  return (n < 0 ? '⁻' : '') + [...String(Math.abs(n))].map((digit) => superscripts[digit]).join('');
}

function shortNumber(value, digits = 3) {
  if (value === null || !isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return mantissa + '·10' + superscript(Number(exponent));
  }
  return String(Number(value.toPrecision(digits)));
}

/** Pure numbers have no unit. */
const withUnit = (symbol, unit) => unit ? `${symbol} [${unit}]` : symbol;

/** The error with two digits, the value with as many decimals. */
function withError(value, error) {
  if (!(error > 0)) return shortNumber(value, 4);
  const decimals = Math.max(0, 1 - Math.floor(Math.log10(error)));
  if (decimals > 7) return `${shortNumber(value, 4)} ± ${shortNumber(error, 2)}`;
  return `${value.toFixed(decimals)} ± ${error.toFixed(decimals)}`;
}

const powerOfTen = (value) => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;

// uPlot's own labels print "0" for values under 1e-3.
function logarithmicLabels(splits) {
  const shown = splits.filter((value) => value > 0);
  const few = shown.filter(powerOfTen).length < 3;
  const plain = shown.every((value) => value > 0.0009 && value < 20000);
  return splits.map((value) => {
    if (!(value > 0)) return '';
    const exponent = Math.floor(Math.log10(value) + 1e-9);
    const mantissa = Math.round(value / 10 ** exponent);
    if (mantissa !== 1 && !(few && (mantissa === 2 || mantissa === 5))) return '';
    if (plain) return String(Number((mantissa * 10 ** exponent).toPrecision(1)));
    return (mantissa === 1 ? '' : mantissa + '·') + '10' + superscript(exponent);
  });
}

function linearLabels(splits) {
  return splits.map((value) => value === null ? '' : shortNumber(value, 6));
}

// Of curves in one chart.
function curveColours() {
  return darkMode.matches ? ['#56b4e9', '#f0a030', '#c3cad2'] : ['#0072b2', '#c65200', '#3c434b'];
}

// Orientations are cyclic: once around, light – orange – dark – blue – light, in the two directions
// (lightness, blue to yellow) that all eyes tell apart. Mixed in OKLab.
function orientationColour(angle) {
  const phase = 2 * angle;
  const lightness = 0.64 + 0.24 * Math.cos(phase);
  const yellow = 0.125 * Math.sin(phase), red = 0.045 * Math.sin(phase);
  const root = [[0.3963377774, 0.2158037573], [-0.1055613458, -0.0638541728], [-0.0894841775, -1.291485548]];
  const [l, m, s] = root.map(([p, q]) => (lightness + p * red + q * yellow) ** 3);
  const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                  -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                  -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
  const channel = (value) => {
    const clipped = Math.min(Math.max(value, 0), 1);
    return Math.round(255 * (clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * clipped ** (1 / 2.4) - 0.055));
  };
  return `rgb(${linear.map(channel).join(' ')})`;
}

// Charts

const font = '12px system-ui, sans-serif';

/** All curves on one common, sorted grid of times, as uPlot wants them; missing values are null. */
function aligned(curves) {
  const times = [...new Set(curves.flatMap((curve) => curve.time))].sort((a, b) => a - b);
  const column = (curve, key) => {
    const at = new Map(curve.time.map((time, k) => [time, curve[key][k]]));
    return times.map((time) => at.get(time) ?? null);
  };
  return { times, values: curves.map((curve) => column(curve, 'value')),
           errors: curves.map((curve) => curve.error ? column(curve, 'error') : null) };
}

/** Shades value ± error; where that reaches zero on a logarithmic axis, down to the frame. */
function drawBand(plot, data, k, logarithmic) {
  if (!data.errors[k] || !plot.series[k + 1].show) return;
  const { ctx } = plot;
  const { left, top, width, height } = plot.bbox;
  const upper = [], lower = [];
  data.times.forEach((time, i) => {
    const value = data.values[k][i], error = data.errors[k][i];
    if (value === null || error === null) return;
    const x = plot.valToPos(time, 'x', true);
    upper.push([x, plot.valToPos(value + error, 'y', true)]);
    lower.push([x, value > error || !logarithmic ? plot.valToPos(value - error, 'y', true) : top + height]);
  });
  if (!upper.length) return;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  ctx.beginPath();
  [...upper, ...lower.reverse()].forEach(([x, y], i) => i ? ctx.lineTo(x, y) : ctx.moveTo(x, y));
  ctx.closePath();
  ctx.globalAlpha = 0.22;
  ctx.fillStyle = plot.series[k + 1].stroke();
  ctx.fill();
  ctx.restore();
}

/** A dashed line across the frame at a height with a meaning of its own. */
function drawLevel(plot, value) {
  const { ctx } = plot;
  const { left, width, top, height } = plot.bbox;
  const y = plot.valToPos(value, 'y', true);
  if (y < top || y > top + height) return;
  ctx.save();
  ctx.strokeStyle = cssColour('--ink');
  ctx.lineWidth = 1.5 * devicePixelRatio;
  ctx.setLineDash([6 * devicePixelRatio, 5 * devicePixelRatio]);
  ctx.beginPath();
  ctx.moveTo(left, y);
  ctx.lineTo(left + width, y);
  ctx.stroke();
  ctx.restore();
}

/** A short dashed line of slope 1, the mark of diffusion, in the lower right corner. */
function drawDiffusionGuide(plot) {
  const { ctx } = plot;
  const { left, top, width, height } = plot.bbox;
  const ratio = devicePixelRatio;
  const decadeX = width / Math.log10(plot.scales.x.max / plot.scales.x.min);
  const decadeY = height / Math.log10(plot.scales.y.max / plot.scales.y.min);
  const decades = Math.min(0.16 * width / decadeX, 0.22 * height / decadeY);
  const x = left + width - decades * decadeX - 14 * ratio, y = top + height - 14 * ratio;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = cssColour('--quiet');
  ctx.lineWidth = 1.25 * ratio;
  ctx.setLineDash([4 * ratio, 3 * ratio]);
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x + decades * decadeX, y - decades * decadeY);
  ctx.stroke();
  ctx.font = `${12 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = 'right';
  ctx.fillText('∝ t', x + 0.5 * decades * decadeX - 4 * ratio, y - 0.5 * decades * decadeY - 4 * ratio);
  ctx.restore();
}

function axisOptions(logarithmic, size) {
  const grid = { stroke: cssColour('--grid'), width: 1 };
  if (logarithmic) grid.filter = (plot, splits) => splits.map((value) => powerOfTen(value) ? value : null);
  const options = {
    stroke: cssColour('--quiet'), font, size, grid, ticks: { stroke: cssColour('--line'), width: 1, size: 5 },
    values: (plot, splits) => logarithmic ? logarithmicLabels(splits) : linearLabels(splits),
  };
  if (logarithmic) options.filter = (plot, splits) => splits;
  return options;
}

function csvText(chart) {
  const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
  const header = [quoted(withUnit(chart.xSymbol, chart.xUnit))];
  const columns = [chart.data.times];
  chart.curves.forEach((curve, k) => {
    header.push(quoted(withUnit(curve.label, chart.yUnit)));
    columns.push(chart.data.values[k]);
    if (chart.data.errors[k]) {
      header.push(quoted(withUnit(curve.label + ' error', chart.yUnit)));
      columns.push(chart.data.errors[k]);
    }
  });
  const rows = chart.data.times.map((time, i) => columns.map((column) => column[i] ?? 'nan').join(','));
  return [header.join(','), ...rows].join('\n') + '\n';
}

function download(name, text) {
  const link = element('a', { href: 'data:text/csv;charset=utf-8,' + encodeURIComponent(text), download: name });
  link.click();
}

/** Arrow keys move the cursor: left and right along a curve, up and down from curve to curve. */
function moveByKey(chart, event) {
  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  if (event.key === 'Escape') return chart.plot.setCursor({ left: -10, top: -10 });
  if (!steps[event.key]) return;
  event.preventDefault();
  const [along, across] = steps[event.key];
  const { plot, data } = chart;
  const shown = data.values.map((_, k) => k).filter((k) => plot.series[k + 1].show);
  if (!shown.length) return;
  const place = Math.max(0, shown.indexOf(chart.focused));
  const k = shown[(place + across + shown.length) % shown.length];
  let i = plot.cursor.idx ?? Math.floor(data.times.length / 2);
  do i += along; while (along && i >= 0 && i < data.times.length && data.values[k][i] === null);
  if (i < 0 || i >= data.times.length || data.values[k][i] === null) return;
  chart.focused = k;
  plot.setCursor({ left: plot.valToPos(data.times[i], 'x'), top: plot.valToPos(data.values[k][i], 'y') });
}

function readOut(chart) {
  const i = chart.plot.cursor.idx, k = chart.focused;
  const value = i === null || i === undefined || k === null ? null : chart.data.values[k][i];
  if (value === null || value === undefined) return chart.readout.textContent = '';
  const error = chart.data.errors[k]?.[i];
  chart.readout.textContent = `${chart.curves[k].label}:  ${chart.xSymbol} = ${shortNumber(chart.data.times[i], 4)},  ` +
    `${chart.symbol} = ${withError(value, error)} ${chart.yUnit}`;
}

/**
 * One chart in `host`: heading, unit of the ordinate, plot, unit of the abscissa, reading, download.
 * `description`: heading, symbol, xSymbol, xUnit, yUnit, file, logX, logY (logarithmic axes), curves [{label, time,
 * value, error}] (time: the abscissa),
 * colours(k), levels [values marked by a dashed line], legend [nodes].
 */
class Chart {
  constructor(host, description) {
    Object.assign(this, description);
    this.host = host;
    this.focused = null;
    this.hidden = new Set();
    this.data = aligned(this.curves);
    this.build();
    new ResizeObserver(() => this.resize()).observe(host);
  }

  build() {
    this.host.replaceChildren(element('h3', {}, this.heading));
    this.host.append(element('p', { class: 'axis-title' }, withUnit(this.symbol, this.yUnit)));
    this.frame = element('div', { class: 'plot', tabindex: '0', role: 'img', 'aria-label':
      `Chart: ${this.heading} against ${this.xSymbol}, ${this.curves.length} curve(s). Arrow keys read values.` });
    this.readout = element('p', { class: 'readout', role: 'status' });
    this.host.append(this.frame, element('p', { class: 'axis-title x' }, withUnit(this.xSymbol, this.xUnit)));
    if (this.legend) this.host.append(this.legend());
    this.host.append(this.readout, this.tools());
    this.frame.addEventListener('keydown', (event) => moveByKey(this, event));
    this.draw();
  }

  tools() {
    const row = element('div', { class: 'tools' });
    const button = element('button', { type: 'button' }, 'Save these curves as CSV');
    button.addEventListener('click', () => download(this.file, csvText(this)));
    row.append(button);
    return row;
  }

  size() {
    const width = Math.max(200, this.frame.clientWidth);
    return { width, height: Math.round(Math.min(400, Math.max(250, 0.7 * width))) };
  }

  draw() {
    this.plot?.destroy();
    const scale = (logarithmic) => logarithmic ? { distr: 3, time: false } : { time: false };
    const range = this.range ? { range: this.range } : {};
    this.plot = new uPlot({
      ...this.size(),
      padding: [10, 20, 0, 0],
      scales: { x: scale(this.logX), y: { ...scale(this.logY), ...range } },
      axes: [axisOptions(this.logX, 30), axisOptions(this.logY, 52)],
      series: [{}, ...this.curves.map((curve, k) => ({
        stroke: this.colours(k), width: 2, spanGaps: true, points: { show: false }, show: !this.hidden.has(k) }))],
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, focus: { prox: 1e6 }, points: { size: 7 } },
      focus: { alpha: 0.35 },
      hooks: {
        draw: [(plot) => {
          (this.levels ?? []).forEach((level) => drawLevel(plot, level));
          this.curves.forEach((_, k) => drawBand(plot, this.data, k, this.logY));
          if (this.logX && this.logY) drawDiffusionGuide(plot);
        }],
        setSeries: [(plot, k, options) => { if (options.focus !== undefined) this.focused = k > 0 ? k - 1 : null; }],
        setCursor: [() => readOut(this)],
      },
    }, [this.data.times, ...this.data.values.map((column) => column.map((value) =>
      this.logY && !(value > 0) ? null : value))], this.frame);
  }

  resize() {
    const { width, height } = this.size();
    if (width !== this.plot.width) this.plot.setSize({ width, height });
  }

  show(k, shown) {
    if (shown) this.hidden.delete(k); else this.hidden.add(k);
    this.plot.setSeries(k + 1, { show: shown });
  }
}

// Pictures

function prepareCanvas(canvas, width, height) {
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  canvas.style.height = height + 'px';
  return canvas.getContext('2d');
}

const outlineColour = () => darkMode.matches ? 'rgb(255 255 255 / 40%)' : 'rgb(20 25 30 / 55%)';

function drawEllipse(ctx, x, y, angle, a, b) {
  ctx.beginPath();
  ctx.ellipse(x, y, a, b, -angle, 0, 2 * Math.PI);
  ctx.fillStyle = a === b ? '#9aa3ad' : orientationColour(angle);
  ctx.fill();
  ctx.stroke();
}

/**
 * Every particle of `view` {state, particles, rotors, label, caption, missing}, and its images where it reaches over the
 * border of the box.
 */
function drawState(view) {
  const canvas = byId('state');
  const { state } = view;
  canvas.hidden = !state;
  byId('orientation-key').parentElement.hidden = !view.rotors;
  if (!state) return byId('state-note').textContent = view.missing;
  const [boxX, boxY] = state.window;
  const width = canvas.clientWidth - 2, height = Math.round(width * boxY / boxX);
  const ctx = prepareCanvas(canvas, width, height);
  const scale = width * devicePixelRatio / boxX;
  ctx.strokeStyle = outlineColour();
  const { particles } = state;
  for (let i = 0; i < particles.length; i += 5) {
    const [x, y, angle, a, b] = particles.slice(i, i + 5);
    ctx.lineWidth = Math.min(1.2 * devicePixelRatio, 0.25 * b * scale);
    for (const dx of [-boxX, 0, boxX]) for (const dy of [-boxY, 0, boxY]) {
      if (!state.periodic && (dx || dy)) continue;
      if (Math.abs(x + dx) > boxX / 2 + a || Math.abs(y + dy) > boxY / 2 + a) continue;
      drawEllipse(ctx, (x + dx + boxX / 2) * scale, (boxY / 2 - y - dy) * scale, angle, a * scale, b * scale);
    }
  }
  canvas.setAttribute('aria-label', `State at ${view.label}: ${particles.length / 5} particles in a periodic box`);
  byId('state-note').textContent = view.caption + (state.periodic
    ? `N = ${view.particles} in a periodic box of ${shortNumber(boxX, 4)} × ${shortNumber(boxY, 4)}.`
    : `the central ${shortNumber(boxX, 4)} × ${shortNumber(boxY, 4)} of the box, ${particles.length / 5} of N = ${view.particles} particles.`);
}

// Calls draw when the picture has another width, and recolour when the colours change.
function watchPicture(draw, recolour) {
  let width = byId('state').clientWidth;
  new ResizeObserver(() => {
    if (byId('state').clientWidth === width) return;
    width = byId('state').clientWidth;
    draw();
  }).observe(byId('state'));
  darkMode.addEventListener('change', () => {
    recolour();
    draw();
    drawOrientationKey();
  });
}

function drawOrientationKey() {
  const canvas = byId('orientation-key');
  const ctx = prepareCanvas(canvas, 260, 44);
  ctx.scale(devicePixelRatio, devicePixelRatio);
  ctx.strokeStyle = outlineColour();
  const text = cssColour('--quiet');
  for (let k = 0; k <= 8; ++k) {
    const x = 18 + 28 * k;
    drawEllipse(ctx, x, 14, k * Math.PI / 8, 12, 6);
    if (k % 2 === 0) {
      ctx.fillStyle = text;
      ctx.font = font;
      ctx.textAlign = 'center';
      ctx.fillText(`${22.5 * k}°`, x, 41);
    }
  }
}

