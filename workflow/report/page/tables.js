// Makes charts from the tables of the analysis as observable.h describes them.

/** The unit of a column in the words of the page. */
const unitOf = (column) => unitNames[column.unit] ?? column.unit;

const ranges = {
  fromZero: (plot, low, high) => [0, 1.08 * high || 1],
  decay: (plot, low) => [Math.min(0, low), 1.04],
  aroundOne: (plot, low, high) => [Math.min(0, low), 1.06 * Math.max(1, high)],
};

/** A pattern for names of columns, in which `#` matches a number and `*` any text. */
const columnPattern = (column) => new RegExp(`^${column.replace('#', '(\\d+)').replace('*', '(.+)')}$`);
const placeholderText = (part) => /^\d+$/.test(part) ? subscript(part) : part.replace('_', '–');

/**
 * The columns that match these curves, as [{name, label}], each for the first curve that it matches. `text` turns
 * what `#` or `*` matches into text.
 */
function namedColumns(columns, curves, text = placeholderText) {
  const taken = new Set();
  return curves.flatMap(({ column, label }) => Object.keys(columns).flatMap((name) => {
    const match = name.match(columnPattern(column));
    if (!match || taken.has(name)) return [];
    taken.add(name);
    return [{ name, label: match[1] === undefined ? label : label.replace(/[#*]/, text(match[1])) }];
  }));
}

/** The frame of a chart and its variants. The curves of the variants have the units of these columns. */
function chartDescription({ scale, ...chart }, columns, name) {
  return { ...chart, xUnit: unitOf(columns[chart.x]), unit: unitOf(columns[name]), logY: scale === 'logarithmic', range: ranges[scale] };
}

/** Draws the charts of one configuration in the hosts that have the names of their tables. */
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
