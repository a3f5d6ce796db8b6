const data = pageData;

// Numbers as the program's tables show them.

const countText = (count) => count === 0 ? '·' : String(count);
const errorText = (error) => error === null ? '–' : error === 0 ? '0' : error.toExponential(1);
const ratioText = (ratio) => ratio < 999.5 ? String(Number(ratio.toPrecision(3))) : ratio.toFixed(0);

function timeText(nanoseconds) {
  let value = nanoseconds, unit = 0;
  for (; value >= 999.5 && unit < 3; ++unit) value /= 1000;
  return `${value.toFixed(value < 9.995 ? 2 : value < 99.95 ? 1 : 0)} ${['ns', 'µs', 'ms', 's'][unit]}`;
}

/** A share that is not 0 is never shown as 0. */
function shareText(part, whole) {
  if (part === 0) return '·';
  const percent = 100 * part / whole;
  return `${Number(percent.toPrecision(percent >= 99.5 ? 3 : percent >= 1 ? 2 : 1))} %`;
}

// Rows

const distinct = (values) => [...new Set(values)];
const methodsOf = (rows) => distinct(rows.map((row) => row.method));
const className = (row) => `${row.class}, κ = ${row.aspect_ratio}`;
const wrong = (row) => row.pairs - row.correct;
const largest = (values) => values.reduce((most, value) => value === null ? most : Math.max(most ?? value, value), null);
/** A method that answers not one pair of a class is not made for it. */
const applies = (row) => row.not_converged < row.pairs;
const failureNames = { late: 'late', missed: 'missed', early: 'early', false: 'false', not_converged: 'no answer' };

// Tables. A cell is a text, or {text, class, title}.

function tableRow(cells) {
  const row = element('tr');
  cells.forEach((cell, k) => {
    const { text, ...attributes } = typeof cell === 'object' ? cell : { text: cell };
    row.append(k === 0 ? element('th', { scope: 'row' }, text) : element('td', attributes, text));
  });
  return row;
}

function table(headings, rows, kind = '') {
  const host = element('div', { class: 'scroll', tabindex: '0' });
  const whole = element('table', { class: kind }), head = element('thead'), body = element('tbody');
  head.append(element('tr'));
  for (const heading of headings) {
    const cell = element('th', { scope: 'col', class: heading === 'meaning' ? 'words' : '' });
    heading.split('_').forEach((part, k) => cell.append(...(k ? ['_', element('wbr'), part] : [part])));
    head.firstChild.append(cell);
  }
  body.append(...rows.map(tableRow));
  whole.append(head, body);
  host.append(whole);
  return host;
}

function details(summary, content) {
  const host = element('details');
  host.append(element('summary', {}, summary), content);
  return host;
}

/** A share of failures, coloured by how large it is. */
function failureCell(part, whole, title) {
  const share = part / whole;
  return { text: shareText(part, whole), title, class: part === 0 ? '' : share < 0.01 ? 'some' : share < 0.1 ? 'many' : 'most' };
}

function glanceTable(rows) {
  const generic = rows.filter((row) => row.class === 'generic');
  const ratios = distinct(generic.map((row) => row.aspect_ratio));
  const timeOf = (method, ratio) =>
    generic.find((row) => row.method === method && row.aspect_ratio === ratio && applies(row))?.ns_per_call;
  const methods = methodsOf(rows);
  const lines = methods.flatMap((method) => {
    const mine = rows.filter((row) => row.method === method && applies(row));
    if (!mine.length) return [];
    const sum = (key) => mine.reduce((total, row) => total + row[key], 0);
    const speeds = ratios.flatMap((ratio) => {
      const time = timeOf(method, ratio), first = timeOf(methods[0], ratio);
      return time && first ? [timeText(time), ratioText(time / first)] : ['–', '–'];
    });
    const failures = Object.keys(failureNames).map((key) => failureCell(sum(key), sum('pairs'), `${sum(key)} of ${sum('pairs')}`));
    return [[method, ...speeds, String(sum('pairs')), ...failures, errorText(largest(mine.map((row) => row.largest_error)))]];
  });
  return table(['method', ...ratios.flatMap((ratio) => [`per call, κ = ${ratio}`, '× first row']), 'pairs',
                ...Object.values(failureNames), 'largest error'], lines);
}

function stabilityTable(rows) {
  const methods = methodsOf(rows);
  const lines = distinct(rows.map(className)).map((name) => [name, ...methods.map((method) => {
    const row = rows.find((row) => row.method === method && className(row) === name);
    if (!row || !applies(row)) return '–';
    const counts = Object.entries(failureNames).map(([key, text]) => `${row[key]} ${text}`).join(', ');
    return failureCell(wrong(row), row.pairs, `${row.pairs} pairs: ${counts}`);
  })]);
  return table(['class', ...methods], lines, 'matrix');
}

function countsTable(rows) {
  const lines = rows.map((row) => [className(row), String(row.pairs), countText(row.correct),
    ...Object.keys(failureNames).map((key) => row[key] === 0 ? '·' : { text: String(row[key]), class: 10 * row[key] < row.pairs ? 'many' : 'most' }),
    countText(row.degenerate), timeText(row.ns_per_call),
    ...['largest_error', 'median_error', 'largest_gap_error'].map((key) => errorText(row[key]))]);
  return table(['class', 'pairs', 'correct', ...Object.values(failureNames), 'degenerate', 'per call', 'largest error',
                'median error', 'gap error'], lines);
}

function stability({ rows, classes }) {
  const shown = classes.filter((of) => rows.some((row) => row.class === of.class));
  return [stabilityTable(rows),
    ...methodsOf(rows).map((method) => {
      const mine = rows.filter((row) => row.method === method);
      return details(`${method}, tolerance ${shortNumber(mine[0].tolerance, 2)}`, countsTable(mine));
    }),
    details('Classes of pairs', table(['class', 'meaning'], shown.map((of) => [className(of), { text: of.meaning, class: 'words' }])))];
}

function overlapTable(rows) {
  const classes = distinct(rows.map(className));
  const lines = methodsOf(rows).map((method) => {
    const mine = rows.filter((row) => row.method === method);
    const shares = mine.map((row) => failureCell(row.wrong_overlap + row.wrong_disjoint, row.pairs,
      `${row.pairs} pairs: ${row.wrong_overlap} disjoint ones called overlapping, ${row.wrong_disjoint} overlapping ones called disjoint`));
    const gap = Math.max(...mine.map((row) => row.largest_wrong_gap));
    const timed = mine.find((row) => row.class === 'near_contact') ?? mine[0];
    return [method, ...shares, gap === 0 ? '·' : errorText(gap), timeText(timed.ns_per_call)];
  });
  return table(['criterion', ...classes, 'largest wrong gap', 'per call'], lines, 'matrix');
}

const perThousand = (run) => run.collisions === 0 ? null : 1000 * run.correction_moves / run.collisions;

function runsTable(runs) {
  const lines = runs.map((run) => [run.method, shortNumber(run.tolerance, 2),
    shortNumber(run.simulated_time, 4) + (run.stood_still ? ', then stood still' : ''), countText(run.collisions),
    { text: countText(run.correction_moves), class: run.correction_moves ? 'many' : '' },
    run.correction_moves && run.collisions ? ratioText(perThousand(run)) : run.collisions ? '·' : '–',
    run.collisions_per_second.toFixed(0), errorText(run.energy_drift), run.deepest_overlap === 0 ? '·' : errorText(run.deepest_overlap)]);
  return table(['method', 'tolerance', 'time', 'collisions', 'correction moves', 'per 1000 collisions', 'collisions per second',
                'energy drift', 'deepest overlap'], lines);
}

function sceneTable(answers) {
  const truth = answers[0].time;
  return table(['method', 'time of the first contact', 'off by'], answers.map(({ method, time }) =>
    [method, time === null ? 'no contact' : time.toFixed(15), time === null ? '–' : errorText(time - truth)]));
}

function passingTable({ contact, answers }) {
  return table(['method', 'tolerance', 'contact at', 'off by', 'steps'], answers.map(({ method, tolerance, time, steps }) =>
    [method, shortNumber(tolerance, 2), time === null ? 'none' : time.toFixed(12), time === null ? '–' : errorText(time - contact),
     String(steps)]));
}

// Charts

function addChart(hostId, description) {
  const host = element('div', { class: 'chart' });
  byId(hostId).append(host);
  const { symbol, unit = '', curves, levels, uprights, ...rest } = description;
  new Chart(host, { file: hostId + '.csv', ...rest, variants: [{ label: '', symbol, unit, curves, levels, uprights }] });
}

/**
 * One method: a thin line through its points, filled or hollow. A point: {x, value, hollow, note}. `k` is its colour,
 * `hollow` what the name of its hollow points ends with.
 */
function methodCurves(name, points, k, hollow) {
  const part = (label, chosen, look) => {
    const shown = points.filter(chosen);
    return { label, id: name, colour: () => curveColour(k), x: shown.map((p) => p.x), value: shown.map((p) => p.value),
             notes: shown.map((p) => p.note), ...look };
  };
  return [part(name, () => true, { thin: true, dashed: k >= curveColours().length }),
          part(name, (p) => !p.hollow, { points: 'full' }),
          part(`${name}, ${hollow}`, (p) => p.hollow, { points: 'hollow' })].filter((curve) => curve.x.length);
}

function curvesByMethod(rows, point, hollow) {
  return methodsOf(rows).flatMap((method, k) => methodCurves(method,
    rows.filter((row) => row.method === method).map(point).filter((p) => p.value !== null), k, hollow));
}

const timeAxis = { xSymbol: 'time per call', xUnit: 'ns', logX: true, logY: true };

/** Random pairs are the rule; a method on another class is a curve of its own. */
const curveName = (row) => row.class === 'generic' ? row.method : `${row.method}, ${row.class}`;

function speedChart(rows, which) {
  const floor = 1e-17;
  const point = (row) => ({ x: row.ns_per_call, value: row[which] === null ? null : Math.max(row[which], floor), hollow: wrong(row) > 0,
    note: `tolerance ${shortNumber(row.tolerance, 2)}, ${wrong(row)} of ${row.pairs} missing, false or off by more than 1 %` });
  addChart('speed', { heading: `Against the ${which.replace('_', ' ')}, κ = ${rows[0].aspect_ratio}`, ...timeAxis,
    symbol: `${which.replace('_', ' ')} of the time`, unit: 'horizon', curves: curvesByMethod(rows.filter(applies).map((row) => ({ ...row, method: curveName(row) })), point, 'some wrong') });
}

/** Of one aspect ratio: the time of pairs near contact, the largest wrong gap and the counts of all classes. */
function overlapChart(rows) {
  const floor = 1e-13;  // pairs closer than that are left out
  const chosen = rows.filter((row) => row.aspect_ratio === rows[0].aspect_ratio);
  const points = methodsOf(chosen).map((method) => {
    const mine = chosen.filter((row) => row.method === method);
    const count = mine.reduce((sum, row) => sum + row.wrong_overlap + row.wrong_disjoint, 0);
    const timed = mine.find((row) => row.class === 'near_contact') ?? mine[0];
    return { method: method.startsWith('polygon') ? 'polygons' : method, x: timed.ns_per_call, hollow: count > 0,
             value: Math.max(floor, ...mine.map((row) => row.largest_wrong_gap)), note: `${method}, ${count} answers wrong` };
  });
  addChart('overlap-chart', { heading: `Time per test, κ = ${rows[0].aspect_ratio}`, ...timeAxis, symbol: 'largest wrong gap',
    unit: 'semi-minor axes', curves: curvesByMethod(points, (p) => p, 'some wrong') });
}

function runsChart(runs) {
  // A power of ten below what a single correction move would be in the longest of the runs.
  const floor = 10 ** (Math.ceil(Math.log10(1000 / Math.max(1, ...runs.map((run) => run.collisions)))) - 1);
  const point = (run) => ({ x: run.collisions_per_second, value: run.collisions ? Math.max(perThousand(run), floor) : null,
    hollow: run.stood_still, note: `tolerance ${shortNumber(run.tolerance, 2)}, ${run.correction_moves} correction moves, ${run.collisions} collisions` });
  addChart('runs-chart', { heading: 'Speed against correction moves', xSymbol: 'collisions per second', xUnit: '', logX: true, logY: true,
    symbol: 'correction moves per 1000 collisions', curves: curvesByMethod(runs, point, 'stood still') });
}

const line = (label, x, value, look = {}) => ({ label, id: label, x, value, colour: () => curveColour(0), ...look });
const upright = (value, label) => ({ value, label, colour: () => curveColour(6) });

function passingChart({ contact, eta1: { curve, scan, scan_steps: steps } }) {
  addChart('passing-chart', { heading: 'η₁ about the overlap', symbol: 'η₁', xSymbol: 't', levels: [0],
    uprights: [upright(contact, `contact, t = ${contact.toFixed(4)}`)],
    curves: [line('η₁(t)', curve.time, curve.eta1),
             line(`in ${steps} steps`, scan.time, scan.eta1, { points: 'full', colour: () => curveColour(1) })] });
}

// Pictures of failing pairs

function svgElement(tag, attributes, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

const ellipse = ({ x, y, a, b, angle }, style) => svgElement('ellipse',
  { rx: a, ry: b, transform: `translate(${x} ${y}) rotate(${180 / Math.PI * angle})`, style });
const outlined = (colour) => `fill: var(${colour}); fill-opacity: .16; stroke: var(${colour}); stroke-width: .013`;

function arrow({ x, y }, [vx, vy]) {
  const speed = Math.hypot(vx, vy);
  if (speed === 0) return [];
  const degrees = 180 / Math.PI * Math.atan2(vy, vx);
  return [svgElement('path', { d: 'M0 0H.27M.33 0L.26 .04V-.04Z', transform: `translate(${x} ${y}) rotate(${degrees})`,
                               style: 'fill: var(--ink); stroke: var(--ink); stroke-width: .013' })];
}

function picture({ title, time, ellipses: [one, two], overlap }, velocity, id) {
  const upwards = svgElement('g', { transform: 'scale(1 -1)' }, ellipse(one, outlined('--one')), ellipse(two, outlined('--two')));
  if (overlap)
    upwards.append(svgElement('clipPath', { id }, ellipse(one, '')),
      svgElement('g', { 'clip-path': `url(#${id})` }, ellipse(two, 'fill: var(--overlap); fill-opacity: .75')));
  if (time === 0) upwards.append(...arrow(two, velocity));
  const figure = element('figure'), caption = element('figcaption', {}, title);
  caption.append(element('span', {}, `t = ${Number(time.toPrecision(9))}`));
  figure.append(svgElement('svg', { viewBox: '-1 -1 2 2', role: 'img', 'aria-label': title }, upwards), caption);
  return figure;
}

function failingPair(failure) {
  const pictures = element('div', { class: 'pictures' });
  pictures.append(...failure.pictures.map((shown, k) => picture(shown, failure.relative_velocity, `${failure.method}_${k}`)));
  return [element('h3', {}, failure.method),
          element('p', { class: 'note' }, `${failure.method} ${failure.caption} (class ${className(failure)}, pair ${failure.index}).`), pictures];
}

// The page

const isEmpty = (value) => value === undefined || (Array.isArray(value) && !value.length);
for (const section of document.querySelectorAll('[data-needs]'))
  if (isEmpty(data[section.dataset.needs])) section.remove();

if (byId('glance')) {
  byId('glance').append(glanceTable(data.rows));
  byId('stability').append(...stability(data));
}
if (byId('speed')) ['median_error', 'largest_error'].forEach((which) => speedChart(data.tolerances, which));
if (byId('failures')) byId('failures').append(...data.failures.flatMap(failingPair));
if (byId('scene')) byId('scene').append(sceneTable(data.scene));
if (byId('passing')) {
  passingChart(data.passing_pair);
  byId('passing').append(passingTable(data.passing_pair));
}
if (byId('runs')) {
  runsChart(data.whole_runs);
  byId('runs').append(runsTable(data.whole_runs));
}
if (byId('overlap')) {
  overlapChart(data.overlap);
  byId('overlap').append(overlapTable(data.overlap));
}
recolour();
