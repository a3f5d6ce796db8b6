// Data

/**
 * All curves on one common, sorted grid of abscissas, as uPlot requires. Missing values are null. An abscissa that a
 * curve has several times appears as often in the grid.
 */
function aligned(curves) {
  const keyed = curves.map((curve) => {
    const met = new Map();
    return curve.x.map((x) => {
      met.set(x, (met.get(x) ?? 0) + 1);
      return `${x} ${met.get(x)}`;
    });
  });
  const keys = new Map();
  curves.forEach((curve, c) => curve.x.forEach((x, i) => keys.set(keyed[c][i], x)));
  const order = [...keys].sort((a, b) => a[1] - b[1]);
  const place = new Map(order.map(([key], row) => [key, row]));
  const column = (curve, c, values) => {
    const result = order.map(() => null);
    keyed[c].forEach((key, i) => { result[place.get(key)] = values[i]; });
    return result;
  };
  return { x: order.map(([, x]) => x), values: curves.map((curve, c) => column(curve, c, curve.value)),
           errors: curves.map((curve, c) => curve.error ? column(curve, c, curve.error) : null),
           notes: curves.map((curve, c) => curve.notes ? column(curve, c, curve.notes) : null) };
}

/** The part of a curve that a logarithmic axis can show. */
function atPositive(curve) {
  const kept = [...curve.x.keys()].filter((row) => curve.x[row] > 0), pick = (values) => values && kept.map((row) => values[row]);
  return { ...curve, x: pick(curve.x), value: pick(curve.value), error: pick(curve.error), notes: pick(curve.notes) };
}

function csvText(chart) {
  const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
  const { variant } = chart, data = aligned(variant.curves);
  const header = [quoted(withUnit(chart.xSymbol, chart.xUnit))];
  const columns = [chart.namesX ? data.x.map((x) => quoted(chart.namesX[x])) : data.x];
  variant.curves.forEach((curve, k) => {
    header.push(quoted(withUnit(curve.label, variant.unit)));
    columns.push(data.values[k]);
    if (data.errors[k]) {
      header.push(quoted(withUnit(curve.label + ' error', variant.unit)));
      columns.push(data.errors[k]);
    }
  });
  const rows = data.x.map((x, i) => columns.map((column) => column[i] ?? 'nan').join(','));
  return [header.join(','), ...rows].join('\n') + '\n';
}

const download = (name, address) => element('a', { href: address, download: name }).click();
const textAddress = (type, text) => `data:${type};charset=utf-8,` + encodeURIComponent(text);

// Drawing

/** Calls draw(ctx, frame of the plot) with everything clipped to the frame. */
function insideFrame(plot, draw) {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  draw(ctx, bbox);
  ctx.restore();
}

/**
 * Stretches of [x, low end, high end] of value ± error. A point without an error ends a stretch. Where value − error
 * reaches zero on a logarithmic axis, the low end is that of the frame.
 */
function errorStretches(plot, chart, k) {
  const { data } = chart;
  const { top, height } = plot.bbox;
  const stretches = [[]];
  data.x.forEach((x, i) => {
    const value = data.values[k][i], error = data.errors[k][i];
    if (value === null || (chart.logY && !(value > 0))) return;
    if (error === null) return stretches.push([]);
    const low = value > error || !chart.logY ? plot.valToPos(value - error, 'y', true) : top + height;
    stretches.at(-1).push([plot.valToPos(x, 'x', true), low, plot.valToPos(value + error, 'y', true)]);
  });
  return stretches;
}

/** Shades the errors of lines, and draws bars for points and for isolated points of a line that have an error. */
function drawErrors(plot, chart, k) {
  if (!chart.data.errors[k] || !plot.series[k + 1].show) return;
  const curve = chart.variant.curves[k];
  const isBar = (stretch) => curve.points || stretch.length === 1;
  const stretches = errorStretches(plot, chart, k);
  insideFrame(plot, (ctx) => {
    ctx.strokeStyle = ctx.fillStyle = curve.colour();
    ctx.lineWidth = 1.5 * devicePixelRatio;
    ctx.beginPath();
    stretches.filter(isBar).flat().forEach(([x, low, high]) => { ctx.moveTo(x, low); ctx.lineTo(x, high); });
    ctx.stroke();
    ctx.beginPath();
    stretches.filter((stretch) => !isBar(stretch)).forEach((stretch) => {
      const outline = [...stretch.map(([x, low, high]) => [x, high]), ...stretch.reverse().map(([x, low]) => [x, low])];
      outline.forEach(([x, y], i) => i ? ctx.lineTo(x, y) : ctx.moveTo(x, y));
    });
    ctx.globalAlpha = 0.2;
    ctx.fill();
  });
}

/** Sentences that say why curves end before others or lack errors that they should have; empty if none does. */
function missingNumbers(curves) {
  const measured = curves.filter((curve) => curve.noErrors), cut = measured.filter(({ isCut }) => isCut);
  const bare = measured.filter((curve) => curve.value.some((value, i) => value !== null && (curve.error?.[i] ?? null) === null));
  const some = bare.length < measured.length || bare.some((curve) => curve.error?.some((error) => error !== null));
  const missing = [cut.length && 'curves end early', bare.length && `no errors${some ? ' for some points' : ''}`].filter(Boolean).join(', ');
  const reasons = new Set([...cut, ...bare].map(({ noErrors }) => noErrors));
  return missing && `${missing[0].toUpperCase()}${missing.slice(1)}: ${[...reasons].join('; ')}.`;
}

/** Draws a dashed line across the frame at a height that has a meaning of its own. */
function drawLevel(plot, value) {
  insideFrame(plot, (ctx, { left, width }) => {
    const y = plot.valToPos(value, 'y', true);
    ctx.strokeStyle = cssColour('--ink');
    ctx.lineWidth = 1.25 * devicePixelRatio;
    ctx.setLineDash([6 * devicePixelRatio, 5 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(left, y);
    ctx.lineTo(left + width, y);
    ctx.stroke();
  });
}

/** Draws an arrow from a lower bound to larger values. */
function drawArrow(ctx, x, y) {
  const length = 16 * devicePixelRatio, head = 5 * devicePixelRatio;
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x + length, y);
  ctx.moveTo(x + length - head, y - head);
  ctx.lineTo(x + length, y);
  ctx.lineTo(x + length - head, y + head);
  ctx.stroke();
}

/** Draws an abscissa with its error as a dashed vertical line in a band. A lower bound (open) has an arrow. */
function drawUpright(plot, { value, error, open, colour, label }, row) {
  insideFrame(plot, (ctx, { left, top, height }) => {
    const [low, x, high] = [-1, 0, 1].map((sign) => plot.valToPos(value + sign * (error ?? 0), 'x', true));
    const y = top + height - (10 + 17 * row) * devicePixelRatio;
    ctx.fillStyle = ctx.strokeStyle = colour();
    ctx.globalAlpha = 0.14;
    ctx.fillRect(low, top, high - low, height);
    ctx.globalAlpha = 1;
    ctx.lineWidth = 1.25 * devicePixelRatio;
    ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(x, top);
    ctx.lineTo(x, top + height);
    ctx.stroke();
    if (open) drawArrow(ctx, x, y - 4 * devicePixelRatio);
    ctx.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
    const fits = x - left > ctx.measureText(label).width + 10 * devicePixelRatio;
    const side = fits ? -5 * devicePixelRatio : 5 * devicePixelRatio;
    ctx.textAlign = fits ? 'right' : 'left';
    ctx.strokeStyle = cssColour('--card');
    ctx.lineWidth = 4 * devicePixelRatio;
    ctx.setLineDash([]);
    ctx.strokeText(label, x + side, y);
    ctx.fillText(label, x + side, y);
  });
}

/** Draws a short dashed line of slope 1 (diffusion) in the lower right corner, or 2 (free flight) in the upper left. */
function drawSlope(plot, slope) {
  const ratio = devicePixelRatio;
  insideFrame(plot, (ctx, { left, top, width, height }) => {
    const decadeX = width / Math.log10(plot.scales.x.max / plot.scales.x.min);
    const decadeY = height / Math.log10(plot.scales.y.max / plot.scales.y.min);
    const decades = Math.min(0.16 * width / decadeX, 0.22 * height / (slope * decadeY));
    const run = decades * decadeX, rise = slope * decades * decadeY;
    const x = slope === 1 ? left + width - run - 14 * ratio : left + 34 * ratio;
    const y = slope === 1 ? top + height - 14 * ratio : top + rise + 14 * ratio;
    ctx.strokeStyle = ctx.fillStyle = cssColour('--quiet');
    ctx.lineWidth = 1.25 * ratio;
    ctx.setLineDash([4 * ratio, 3 * ratio]);
    ctx.beginPath();
    ctx.moveTo(x, y);
    ctx.lineTo(x + run, y - rise);
    ctx.stroke();
    ctx.font = `${12 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = 'right';
    ctx.fillText(slope === 1 ? '∝ t' : '∝ t²', x + 0.5 * run - 4 * ratio, y - 0.5 * rise - 4 * ratio);
  });
}

function seriesOptions(curve, shown) {
  const series = { stroke: curve.colour(), width: curve.thin ? 1 : 2, spanGaps: true, points: { show: false }, show: shown };
  if (curve.dashed) series.dash = [7, 5];
  if (!curve.points) return series;
  const fill = curve.points === 'hollow' ? cssColour('--card') : curve.colour();
  return { ...series, paths: () => null, points: { show: true, size: 9, width: 2, stroke: curve.colour(), fill } };
}

// Reading

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
  const from = plot.cursor.idx ?? Math.floor(data.x.length / 2);
  const places = data.x.map((_, i) => i).filter((i) => data.values[k][i] !== null && (!along || (i - from) * along > 0));
  if (!places.length) return;
  const i = places.reduce((best, i) => Math.abs(i - from) < Math.abs(best - from) ? i : best);
  plot.setCursor({ left: plot.valToPos(data.x[i], 'x'), top: plot.valToPos(data.values[k][i], 'y') });
  // Where curves meet, the cursor would otherwise choose the first of them.
  plot.setSeries(k + 1, { focus: true });
  readOut(chart);
}

function readOut(chart) {
  const i = chart.plot?.cursor.idx, k = chart.focused;
  const value = i === null || i === undefined || k === null ? null : chart.data.values[k]?.[i];
  if (value === null || value === undefined) return chart.readout.textContent = chart.hint;
  const note = chart.data.notes[k]?.[i];
  const x = chart.data.x[i];
  chart.readout.textContent = `${chart.variant.curves[k].label}:  ${chart.xSymbol} = ${chart.namesX?.[x] ?? shortNumber(x, 4)},  ` +
    `${withError(value, chart.data.errors[k]?.[i])} ${chart.variant.unit}` + (note ? ` (${note})` : '');
}

/** Draws a sample of the curve from x on at the height y. */
function drawSwatch(context, curve, x, y) {
  const ratio = devicePixelRatio;
  context.strokeStyle = context.fillStyle = curve.colour();
  context.lineWidth = 2 * ratio;
  context.setLineDash(curve.dashed ? [4 * ratio, 3 * ratio] : []);
  context.beginPath();
  if (curve.points) {
    context.arc(x + 7 * ratio, y, 3.5 * ratio, 0, 2 * Math.PI);
  } else {
    context.moveTo(x, y);
    context.lineTo(x + 14 * ratio, y);
  }
  if (curve.points === 'full') context.fill();
  context.stroke();
  context.setLineDash([]);
}

const allCharts = [];
const printedWidth = 360;  // about half the width of a sheet

/**
 * A chart in `host`. The description has: heading; xSymbol, xUnit; namesX, the meanings of the abscissas 0, 1, 2 …;
 * logX, logY; file, the name of its CSV; range, slopes, hint; and variants, of which a select shows one: [{label,
 * symbol, unit, curves, levels, uprights, rangeX}]. A curve is {label, x, value, error, noErrors (why some errors, or
 * values at the end, are missing), isCut, notes (read out with the values), colour(), points ('full' or 'hollow',
 * instead of a line), dashed, thin, id}. The legend of the chart, or `show` from outside, switches curves off by
 * their `id`. The legend names the first curve of each id.
 */
class Chart {
  constructor(host, description) {
    Object.assign(this, { hint: '', ...description });
    this.host = host;
    this.hidden = new Set();
    this.variant = this.variants[0];
    this.wasLogX = this.logX;
    this.build();
    allCharts.push(this);
    new ResizeObserver(() => this.resize()).observe(host);
    recoloured.push(() => { if (this.host.isConnected) this.choose(this.variants.indexOf(this.variant)); });
  }

  build() {
    const head = element('div', { class: 'chart-head' });
    head.append(element('h3', {}, this.heading));
    if (this.variants.length > 1)
      head.append(selection('', this.variants.map((variant) => variant.label), 0, (k) => this.choose(k)));
    head.querySelector('select')?.setAttribute('aria-label', `${this.heading}: which`);
    this.unit = element('p', { class: 'axis-title' });
    this.frame = element('div', { class: 'plot', tabindex: '0', role: 'img' });
    this.legend = element('div', { class: 'legend small', role: 'group', 'aria-label': 'Curves shown' });
    this.remark = element('p', { class: 'note remark' });
    this.readout = element('p', { class: 'readout', role: 'status' });
    this.host.replaceChildren(head, this.unit, this.frame,
      element('p', { class: 'axis-title x' }, withUnit(this.xSymbol, this.xUnit)), this.legend, this.remark, this.readout, this.tools());
    this.frame.addEventListener('keydown', (event) => moveByKey(this, event));
    this.choose(0);
  }

  tools() {
    const row = element('div', { class: 'tools' });
    const add = (format, what, address) => {
      const button = element('button', { type: 'button', class: 'link' }, format);
      button.setAttribute('aria-label', `Save ${what} ${this.heading} as ${format}`);
      button.addEventListener('click', () => download(this.file.replace('.csv', '.' + format.toLowerCase()), address()));
      row.append(button);
    };
    add('CSV', 'the curves of', () => textAddress('text/csv', this.csv()));
    add('SVG', 'the chart', () => textAddress('image/svg+xml', this.svg()));
    add('PNG', 'the chart', () => this.png());
    row.append(...['logX', 'logY'].filter((scale) => this.canBeLogarithmic(scale)).map((scale) => this.scaleSwitch(scale)));
    return row;
  }

  canBeLogarithmic(scale) {
    const numbers = this.variants.flatMap(({ curves }) => curves.flatMap(({ x, value }) => scale === 'logY' ? value : this.namesX ? [] : x));
    return numbers.filter((number) => number > 0).length > 1 && !numbers.some((number) => number < 0);
  }

  scaleSwitch(scale) {
    const name = scale === 'logX' ? 'log x' : 'log y';
    const button = element('button', { type: 'button', class: 'link', 'aria-pressed': String(Boolean(this[scale])) }, name);
    button.setAttribute('aria-label', `${this.heading}: ${name}`);
    button.addEventListener('click', () => {
      this[scale] = !this[scale];
      button.setAttribute('aria-pressed', String(this[scale]));
      this.choose(this.variants.indexOf(this.variant));
    });
    return button;
  }

  csv() { return csvText(this); }

  /** The chart as SVG, with the titles and the legend that surround the plot on the page. */
  svg() {
    const size = this.size(), context = new SvgContext(...this.figureSize());
    this.drawFigure(context, () => plotOn(context, this.options(size), this.columns()));
    return context.text(devicePixelRatio);
  }

  png() {
    const canvas = element('canvas');
    [canvas.width, canvas.height] = this.figureSize();
    const context = canvas.getContext('2d');
    this.drawFigure(context, () => context.drawImage(this.plot.ctx.canvas, 0, 0));
    return canvas.toDataURL('image/png');
  }

  /** The curves that a legend names, which are the first of each id. */
  namedCurves() {
    return this.variant.curves.filter((curve, k, all) => all.findIndex(({ id }) => id === curve.id) === k);
  }

  /** Where a saved chart names its visible curves if there are several, in rows below the plot: [{curve, x, y}]. */
  legendPlaces() {
    const shown = this.namedCurves().filter(({ id }) => !this.hidden.has(id));
    const context = document.createElement('canvas').getContext('2d'), { width } = this.size();
    context.font = font;
    let x = 0, row = 0;
    return shown.length < 2 ? [] : shown.map((curve) => {
      const length = 34 + context.measureText(curve.label).width;
      if (x > 0 && x + length > width) { x = 0; ++row; }
      x += length;
      return { curve, x: x - length, y: 18 * row };
    });
  }

  figureSize() {
    const { width, height } = this.size(), rows = this.legendPlaces().at(-1);
    return [width, height + 48 + (rows ? rows.y + 22 : 0)].map((length) => Math.round(length * devicePixelRatio));
  }

  drawFigure(context, drawPlot) {
    const ratio = devicePixelRatio, { width, height } = this.size(), [all, below] = this.figureSize();
    const write = (text, x, y, align) => {
      context.textAlign = align;
      context.fillText(text, x * ratio, y * ratio);
    };
    context.fillStyle = cssColour('--card');
    context.fillRect(0, 0, all, below);
    context.save();
    context.translate(0, 22 * ratio);
    drawPlot();
    context.restore();
    context.font = `${12 * ratio}px system-ui, sans-serif`;
    context.fillStyle = cssColour('--ink');
    write(withUnit(this.variant.symbol, this.variant.unit), 4, 15, 'left');
    write(withUnit(this.xSymbol, this.xUnit), width - 20, height + 38, 'right');
    for (const { curve, x, y } of this.legendPlaces()) {
      drawSwatch(context, curve, (x + 4) * ratio, (height + 57 + y) * ratio);
      context.fillStyle = cssColour('--ink');
      write(curve.label, x + 22, height + 61 + y, 'left');
    }
  }

  /** Puts the plot as vector graphics beside the canvas, for printing. */
  print() {
    const size = this.sizeFor(printedWidth), context = new SvgContext(size.width * devicePixelRatio, size.height * devicePixelRatio);
    plotOn(context, this.options(size), this.columns());
    this.printed = element('div', { class: 'printed' });
    this.printed.innerHTML = context.text(devicePixelRatio);
    this.frame.append(this.printed);
  }

  choose(k) {
    this.variant = this.variants[k];
    this.focused = null;
    this.data = aligned(this.logX ? this.variant.curves.map(atPositive) : this.variant.curves);
    this.unit.textContent = withUnit(this.variant.symbol, this.variant.unit);
    this.frame.setAttribute('aria-label', `Chart: ${this.heading}, ${this.variant.symbol} against ${this.xSymbol}, ` +
      `${this.variant.curves.length} curve(s). Arrow keys read values.`);
    this.remark.textContent = missingNumbers(this.variant.curves);
    this.fillLegend();
    this.draw();
    readOut(this);
  }

  /** A single curve needs no legend, nor do curves that a legend outside the chart names. */
  fillLegend() {
    const curves = this.namedCurves();
    this.legend.hidden = this.legendOutside || curves.length < 2;
    this.legend.replaceChildren(...curves.map((curve) => legendButton(curve, !this.hidden.has(curve.id),
      (shown) => this.show(curve.id, shown))));
  }

  size() { return this.sizeFor(Math.max(200, this.frame.clientWidth)); }
  sizeFor(width) { return { width, height: Math.round(Math.min(380, Math.max(240, 0.66 * width))) }; }

  draw() {
    this.plot?.destroy();
    this.plot = new uPlot(this.options(this.size()), this.columns(), this.frame);
  }

  /** The columns in the form that uPlot requires. */
  columns() {
    return [this.data.x, ...this.data.values.map((column) => column.map((value) => this.logY && !(value > 0) ? null : value))];
  }

  options(size) {
    const { curves, levels = [], uprights = [] } = this.variant;
    const rangeX = this.logX === this.wasLogX ? this.variant.rangeX ?? this.rangeX : undefined;
    const range = this.logY ? logarithmicRange : this.range ?? linearRange;
    const scale = (logarithmic) => logarithmic ? { distr: 3, time: false } : { time: false };
    return {
      ...size,
      padding: [10, 20, 0, 0],
      scales: { x: { ...scale(this.logX), range: rangeX ?? (this.logX ? logarithmicRange : undefined) },
                y: { ...scale(this.logY), range: (plot, low, high) => range(plot, ...(low === null ? [low, high] : extentOf(plot, this, low, high))) } },
      axes: [axisOptions(this.logX, 30, this.namesX), axisOptions(this.logY, labelWidth)],
      series: [{}, ...curves.map((curve) => seriesOptions(curve, !this.hidden.has(curve.id)))],
      legend: { show: false },
      cursor: { drag: { x: true, y: true, uni: 30, dist: 8 }, focus: { prox: 1e6 }, points: { size: 7 } },
      focus: { alpha: 0.35 },
      hooks: {
        drawAxes: [(plot) => {
          curves.forEach((_, k) => drawErrors(plot, this, k));
          uprights.forEach((upright, row) => drawUpright(plot, upright, row));
          if (this.logX && this.logY) (this.slopes ?? []).forEach((slope) => drawSlope(plot, slope));
        }],
        draw: [(plot) => levels.forEach((level) => drawLevel(plot, level))],
        setSeries: [(plot, k, options) => { if (options.focus !== undefined) this.focused = k > 0 ? k - 1 : null; }],
        setCursor: [() => readOut(this)],
      },
    };
  }

  resize() {
    const { width, height } = this.size();
    if (width !== this.plot.width) this.plot.setSize({ width, height });
  }

  show(id, shown) {
    if (shown) this.hidden.delete(id); else this.hidden.add(id);
    this.variant.curves.forEach((curve, k) => { if (curve.id === id) this.plot.setSeries(k + 1, { show: shown }); });
  }
}

// Prints use the light scheme, and vector graphics instead of the canvas, which would be blurred.

addEventListener('beforeprint', () => {
  const wasDark = isDark(), scheme = root.style.colorScheme;
  if (wasDark) { root.style.colorScheme = 'light'; recolour(); }
  allCharts.filter(({ plot }) => plot).forEach((chart) => chart.print());
  addEventListener('afterprint', () => {
    allCharts.forEach(({ printed }) => printed?.remove());
    if (wasDark) { root.style.colorScheme = scheme; recolour(); }
  }, { once: true });
});

/** A button that names a curve and switches it off and on. */
function legendButton(curve, shown, toggle) {
  const button = element('button', { type: 'button', 'aria-pressed': String(shown) });
  const swatch = element('i', { class: curve.points ?? (curve.dashed ? 'dashed' : 'line') });
  swatch.style.color = curve.colour();
  button.append(swatch, curve.label);
  button.addEventListener('click', () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    toggle(on);
  });
  return button;
}
