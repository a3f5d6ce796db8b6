// Charts as the tables of the analysis describe them: observable.h

/** In the words of the page. */
const unitOf = (column) => unitNames[column.unit] ?? column.unit;

const ranges = {
  fromZero: (plot, low, high) => [0, 1.08 * high || 1],
  decay: (plot, low) => [Math.min(0, low), 1.04],
  aroundOne: (plot, low, high) => [Math.min(0, low), 1.06 * Math.max(1, high)],
};

/** Matches the names of columns that have a number for `#` or a text for `*`. */
const columnPattern = (column) => new RegExp(`^${column.replace('#', '(\\d+)').replace('*', '(.+)')}$`);
const placeholderText = (part) => /^\d+$/.test(part) ? subscript(part) : part.replace('_', '–');

/** [{name, label}] of the columns that these curves stand for, each as the first of them; `text` of what `#` and `*` stand for. */
function namedColumns(columns, curves, text = placeholderText) {
  const taken = new Set();
  return curves.flatMap(({ column, label }) => Object.keys(columns).flatMap((name) => {
    const match = name.match(columnPattern(column));
    if (!match || taken.has(name)) return [];
    taken.add(name);
    return [{ name, label: match[1] === undefined ? label : label.replace(/[#*]/, text(match[1])) }];
  }));
}

/** The frame of a chart and its variants, whose curves have the units of these columns. */
function chartDescription({ scale, ...chart }, columns, name) {
  return { ...chart, xUnit: unitOf(columns[chart.x]), unit: unitOf(columns[name]), logY: scale === 'logarithmic', range: ranges[scale] };
}

/** Charts of one configuration, in the hosts that are called after their tables. */
function stateCharts({ tables, charts }) {
  for (const chart of charts.filter(({ table }) => byId(table))) {
    const host = byId(chart.table), columns = tables[chart.table]?.columns ?? {};
    const curves = namedColumns(columns, chart.curves).map(({ name, label }, k) => ({ label, id: name, x: columns[chart.x].value,
      value: columns[name].value, colour: () => curveColour(k), noErrors: 'a single configuration' }));
    if (!curves.length) { host.remove(); continue; }
    const { symbol, levels, unit, ...description } = chartDescription(chart, columns, curves[0].id);
    new Chart(host, { ...description, file: chart.table + '.csv', variants: [{ symbol, unit, levels, curves }] });
  }
}
