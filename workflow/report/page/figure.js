// Draws the figures that figure_page.h describes.

const { columns } = pageData.table;
const isNumber = (value) => value !== null;
const extent = (values) => [Math.min(...values), Math.max(...values)];

/**
 * The range about zero. If both signs occur, it is cut off at five times the depth below zero, however large the
 * values are.
 */
const rangeAboutZero = (plot, low, high) => low < 0 && high > -5 * low ? [1.2 * low, -5 * low] : linearRange(plot, low, high);

/** These columns as CSV, from row `first` on. */
function columnsText(names, first = 0, count = Infinity) {
  const rows = names.map((name) => columns[name].value.slice(first, first + count));
  return [names, ...rows[0].map((_, i) => rows.map((row) => row[i] ?? 'nan'))].map((row) => row.join(',') + '\n').join('');
}

/** A chart whose curves are not drawn by uPlot. */
class DrawnChart extends Chart {
  canBeLogarithmic() { return false; }

  options(size) {
    const options = super.options(size);
    options.series = options.series.map((series) => ({ ...series, paths: () => null }));
    return options;
  }
}

/** A chart of lines through points in their order, with numbered marks, on equal scales. */
class PathsChart extends DrawnChart {
  csv() { return columnsText(['time', ...this.columnNames]); }

  /** The range of everything that is drawn: [low, high] of x and of y. */
  get window() {
    const { curves } = this.variant, room = 0.06;
    const along = (of, at) => extent([...curves.flatMap(of), ...this.outlines.flatMap((disk) => [at(disk) - disk.radius, at(disk) + disk.radius])])
      .map((end, k, ends) => end + (2 * k - 1) * room * (ends[1] - ends[0]));
    return [along(({ x }) => x, ({ x }) => x), along(({ value }) => value, ({ y }) => y)];
  }

  sizeFor(width) {
    const [x, y] = this.window;
    return { width, height: Math.round((width - this.besides) * (y[1] - y[0]) / (x[1] - x[0])) + 40 };
  }

  /** The part of the width, in pixels, that lies beside the frame. */
  get besides() { return 76; }

  options(size) {
    const options = super.options(size), [x, y] = this.window;
    options.scales = { x: { time: false, range: x }, y: { range: y } };
    options.axes[1].size = this.besides - 20;
    options.hooks.drawAxes = [(plot) => this.drawPaths(plot)];
    return options;
  }

  drawPaths(plot) {
    const place = (x, y) => [plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true)];
    insideFrame(plot, (ctx) => {
      ctx.strokeStyle = cssColour('--quiet');
      ctx.lineWidth = devicePixelRatio;
      ctx.setLineDash([4 * devicePixelRatio, 4 * devicePixelRatio]);
      ctx.beginPath();
      for (const { x, y, radius } of this.outlines) {
        const [right, middle] = place(x + radius, y), [centre] = place(x, y);
        ctx.moveTo(right, middle);
        ctx.arc(centre, middle, right - centre, 0, 2 * Math.PI);
      }
      ctx.stroke();
      ctx.setLineDash([]);
      this.variant.curves.filter(({ id }) => !this.hidden.has(id)).forEach((curve) => this.drawPath(ctx, curve, place));
    });
  }

  drawPath(ctx, curve, place) {
    const ratio = devicePixelRatio, points = curve.x.map((x, i) => place(x, curve.value[i]));
    ctx.strokeStyle = ctx.fillStyle = curve.colour();
    ctx.lineWidth = 1.5 * ratio;
    ctx.beginPath();
    points.forEach(([x, y], i) => i ? ctx.lineTo(x, y) : ctx.moveTo(x, y));
    ctx.stroke();
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    points.forEach(([x, y], i) => {
      if (!Number.isInteger(columns.instant.value[i])) return;
      ctx.beginPath();
      ctx.arc(x, y, 3 * ratio, 0, 2 * Math.PI);
      ctx.fill();
      ctx.fillText(columns.instant.value[i], x + (curve.first ? -16 : 7) * ratio, y + 4 * ratio);
    });
  }
}

/** A map whose colours show values on a lattice of points, with the key of the colours at the right. */
class ColourMap extends DrawnChart {
  csv() { return columnsText(this.columnNames, this.firstRow, this.side ** 2); }

  sizeFor(width) { return { width, height: Math.round(0.8 * width) }; }

  get ends() { return this.finite ??= extent(this.colours.filter(isNumber)); }

  colourOf(value) {
    const [low, high] = this.ends;
    return sequential(high > low ? (value - low) / (high - low) : 0.5);
  }

  options(size) {
    const options = super.options(size), { x, value } = this.variant.curves[0];
    options.padding = [10, 84, 0, 0];
    options.scales.x.range = extent(x);
    options.scales.y.range = extent(value);
    options.cursor.points = { show: false };
    options.hooks.drawAxes = [(plot) => { insideFrame(plot, (ctx) => this.drawCells(plot, ctx)); this.drawKey(plot); }];
    options.hooks.setCursor = [(plot) => this.read(plot)];
    return options;
  }

  drawCells(plot, ctx) {
    const { side, colours } = this, [{ x, value }] = this.variant.curves;
    const points = x.map((at, i) => [plot.valToPos(at, 'x', true), plot.valToPos(value[i], 'y', true)]);
    ctx.lineWidth = 1;
    for (let i = 0; i + side < points.length; ++i) {
      const corners = [i, i + 1, i + side + 1, i + side];
      if (i % side === side - 1 || !corners.every((k) => isNumber(colours[k]))) continue;
      ctx.fillStyle = ctx.strokeStyle = this.colourOf(corners.reduce((sum, k) => sum + colours[k] / 4, 0));
      ctx.beginPath();
      corners.forEach((k) => ctx.lineTo(...points[k]));
      ctx.closePath();
      ctx.fill();
      ctx.stroke();
    }
  }

  drawKey({ ctx, bbox }) {
    const ratio = devicePixelRatio, [low, high] = this.ends, steps = high > low ? 64 : 1;
    const left = bbox.left + bbox.width + 10 * ratio, at = (share) => bbox.top + bbox.height * (1 - share);
    for (let k = 0; k < steps; ++k) {
      ctx.fillStyle = this.colourOf(low + (k + 0.5) / steps * (high - low));
      ctx.fillRect(left, at((k + 1) / steps), 12 * ratio, bbox.height / steps + 1);
    }
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    ctx.fillStyle = cssColour('--quiet');
    const largest = Math.max(-low, high), digits = Math.max(2, 1 + Math.ceil(Math.log10(largest / (high - low))));
    for (const share of high > low ? [0, 0.5, 1] : [0.5]) {
      const value = low + share * (high - low);
      const text = Math.abs(value) < 1e-3 * largest ? '0' : shortNumber(value, high > low ? digits : 6);
      ctx.fillText(text, left + 16 * ratio, at(share) + (share - 0.5) * 10 * ratio);
    }
  }

  /** Reads out the lattice point nearest to the cursor. */
  read(plot) {
    const [{ x, value }] = this.variant.curves, { left, top } = plot.cursor;
    if (!(left >= 0)) return this.readout.textContent = '';
    const far = (i) => Math.hypot(plot.valToPos(x[i], 'x') - left, plot.valToPos(value[i], 'y') - top);
    const i = x.reduce((best, _, k) => far(k) < far(best) ? k : best, 0);
    this.readout.textContent = `${shortNumber(x[i])}, ${shortNumber(value[i])}: ${shortNumber(this.colours[i], 4)}`;
  }
}

function curvesOf({ curves, kind, firstRow, side }) {
  const labels = [...new Set(curves.map(({ label }) => label))];
  const rows = (name) => kind === 'map' ? columns[name].value.slice(firstRow, firstRow + side * side) : columns[name].value;
  return curves.map(({ x, y, label }) => ({ label, id: label, x: rows(x), value: rows(y), first: label === labels[0],
    colour: () => curveColour(labels.indexOf(label)) }));
}

for (const figure of pageData.figures) {
  const host = element('div', { class: 'chart' }), curves = curvesOf(figure), { mark, showsZero, firstRow, side, value } = figure;
  byId('figures').append(host);
  const [{ x, y }] = figure.curves;
  const variant = { symbol: figure.symbol, unit: unitOf(columns[y]), curves, levels: showsZero ? [0] : [],
                    uprights: mark ? [{ ...mark, colour: () => curveColour(1) }] : [] };
  const description = { heading: figure.heading, xSymbol: figure.xSymbol, xUnit: unitOf(columns[x]), file: pageData.file,
                        variants: [variant], range: showsZero ? rangeAboutZero : undefined, outlines: figure.outlines, firstRow, side,
                        logY: figure.isLogarithmic, colours: columns[value]?.value.slice(firstRow, firstRow + side * side),
                        columnNames: [...figure.curves.flatMap((curve) => [curve.x, curve.y]), ...value ? [value] : []] };
  new ({ curves: Chart, paths: PathsChart, map: ColourMap }[figure.kind])(host, description);
}
recolour();
