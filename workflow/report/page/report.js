const { runs, study, charts } = pageData;

// A chart shows one table, or several tables whose names differ in the group of particles at the end.

const chartsOf = (...sections) => charts.filter(({ section }) => sections.includes(section));

/** The range of the values: "q = 2.41", or from the lowest to the highest if they differ between runs. */
function rangeText(symbol, values) {
  const [low, high] = [Math.min(...values), Math.max(...values)].map((value) => shortNumber(value, 3));
  return `${symbol} = ${low === high ? low : `${low} … ${high}, varying between runs`}`;
}

/**
 * The k-th wave number or waiting time of these runs. Collective functions have that of the wave vectors of the box.
 */
function numberText(k, of, origin, { table, column, symbol }) {
  const values = of.flatMap((run) => {
    const columns = run.tables[origin + table]?.columns;
    return (columns?.[column] ?? columns?.q)?.value[columns.index.value.indexOf(k)] ?? [];
  });
  return values.length ? rangeText(symbol, values) : `${symbol}${subscript(k)}`;
}

/**
 * An axis looks the same after half a turn, so each angle is replaced by the equivalent one nearest to the angle
 * before.
 */
function unwrapped(angles) {
  let last = 0;
  return angles.map((angle) => angle === null ? null : last = angle + Math.PI * Math.round((last - angle) / Math.PI));
}

// The correlations on the fly of a group of particles have one table, which all charts share.
const onTheFly = 'on_the_fly_';
const isOnTheFly = (group) => group.startsWith(onTheFly);

/** The columns that a chart shows, with labels that hold for all these runs together. */
function shownColumns(table, { curves, numbers }, of, group = '') {
  const origin = isOnTheFly(group) ? onTheFly : '';
  return namedColumns(table.columns, curves, numbers ? (k) => numberText(Number(k), of, origin, numbers) : undefined);
}

/** The groups of particles for which some run has a table of the chart. A table without groups gives [""]. */
function groupsOf(chart) {
  const names = runs.flatMap((run) => Object.keys(run.tables));
  if (!chart.hasGroups) return names.includes(chart.table) ? [''] : [];
  const isOther = (name) => charts.some(({ table }) => table === name);  // for example orientation_distribution
  const groups = new Set(names.filter((name) => name.startsWith(chart.table + '_') && !isOther(name))
    .map((name) => name.slice(chart.table.length)));
  const others = new Set(runs.flatMap((run) => Object.keys(run.tables).filter((name) => isOnTheFly(name) &&
    run.tables[name].columns[chart.x] && shownColumns(run.tables[name], chart, runs, name).length)));
  return [...groups].sort((a, b) => (b === '_all') - (a === '_all')).concat([...others]);
}

const tableOf = (run, chart, group) => run.tables[isOnTheFly(group) ? group : chart.table + group];

const tooFewBlocks = 'too few independent blocks';
const noErrors = (run, group = '') => run.evenlySampled || isOnTheFly(group) ? tooFewBlocks : 'samples unevenly spaced in time';

/** The curve from the first known value to the last. A logarithmic axis has no place for the time 0. */
function curveOf(table, name, chart) {
  const { value, error } = table.columns[name], x = table.columns[chart.x].value;
  const known = (y, i) => y !== null && (x[i] > 0 || !chart.logX);
  const [begin, end] = [value.findIndex(known), value.findLastIndex(known) + 1];
  const shown = (values) => values?.slice(Math.max(begin, 0), end);
  return { x: shown(x), value: shown(value), error: shown(error), isCut: chart.x === 'time' && ['motion', 'relaxation'].includes(chart.section) && end < value.length };
}

/** Runs have an order, and their colours follow it. */
const runColour = (run) => orderedColour(runs.length > 1 ? runs.indexOf(run) / (runs.length - 1) : 0.5);

const particlesOf = (group) => group === '_all' ? 'all particles' : 'species ' + group.slice(1);
const groupName = (group, groups) => groups.length < 2 ? ''
  : isOnTheFly(group) ? particlesOf(group.slice(onTheFly.length - 1)) + ', on the fly' : particlesOf(group);

/** The variants of a chart for a single run, in which one chart shows the columns of the run together. */
function variantsOfOneRun(chart, groups) {
  const [run] = runs;
  return groups.flatMap((group) => {
    const table = tableOf(run, chart, group);
    const columns = shownColumns(table, chart, runs, group);
    if (!columns.length) return [];
    return [{ label: groupName(group, groups), columns, name: columns.length === 1 ? columns[0].label : '',
      curves: columns.map(({ name, label }, k) => ({ ...curveOf(table, name, chart), label, id: name,
        colour: () => curveColour(k), noErrors: noErrors(run, group) })) }];
  });
}

/** The variants of a chart for several runs, each of which shows one column of all runs. */
function variantsOfRuns(chart, groups) {
  return groups.flatMap((group) => {
    const names = new Map(runs.flatMap((run) => {
      const table = tableOf(run, chart, group);
      return table ? shownColumns(table, chart, runs, group).map(({ name, label }) => [name, label]) : [];
    }));
    return [...names].map(([name, label]) => ({
      name: label, columns: [{ name }],
      label: [names.size > 1 ? label : '', groupName(group, groups)].filter(Boolean).join(', '),
      curves: runs.flatMap((run, k) => {
        const table = tableOf(run, chart, group);
        return table?.columns[name] ? [{ ...curveOf(table, name, chart), label: run.label, id: k,
          colour: () => runColour(run), noErrors: noErrors(run, group) }] : [];
      }),
    }));
  });
}

/** Mean squares that begin with free flight grow as t², which a second slope marks. */
function slopesOf(variants) {
  const steep = variants[0].curves.some(({ x, value }) => x.length > 1 && Math.log(value[1] / value[0]) > 1.6 * Math.log(x[1] / x[0]));
  return steep ? [1, 2] : [1];
}

function addChart(section, description) {
  const host = element('div', { class: 'chart' });
  byId(section).append(host);
  return new Chart(host, description);
}

const fileName = (heading) => heading.toLowerCase().replaceAll(/[^a-z]+/g, '_') + '.csv';

/** The expectations of theory, each drawn once for all runs that share it. */
function referencesOf(chart) {
  const curves = runs.flatMap((run) => {
    const table = run.tables[chart.table];
    return namedColumns(table?.columns ?? {}, chart.references).map(({ name, label }) =>
      ({ ...curveOf(table, name, chart), label, id: name, colour: () => cssColour('--ink'), dashed: true }));
  });
  return [...new Map(curves.map((curve) => [String(curve.value), curve])).values()];
}

/** The chart of a table for all runs; null if it has no curves. */
function runsChart(chart) {
  const groups = groupsOf(chart);
  const variants = runs.length > 1 ? variantsOfRuns(chart, groups) : variantsOfOneRun(chart, groups);
  if (!variants.length) {
    if (groups.length && chart.ifMissing) byId(chart.section).after(element('p', { class: 'note' }, chart.ifMissing));
    return null;
  }
  const tables = runs.flatMap((run) => groups.map((group) => tableOf(run, chart, group)).filter(Boolean));
  const stride = Math.max(...tables.map((table) => table.stride));
  const [{ name }] = variants[0].columns, { columns } = tables.find((table) => table.columns[name]);
  const { symbol, unit, levels, ...description } = chartDescription(chart, columns, name);
  const isNumbered = chart.curves.some(({ column }) => /[#*]/.test(column)), references = referencesOf(chart);
  return addChart(chart.section, { ...description, legendOutside: runs.length > 1, file: fileName(chart.heading),
    hint: stride > 1 ? `Shown: one point in ${stride}.` : '', slopes: chart.hasPowerLaws ? slopesOf(variants) : [],
    variants: variants.map((variant) => ({ ...variant, unit, levels, curves: [...variant.curves, ...references],
      symbol: symbol + (isNumbered && variant.name ? `, ${variant.name}` : '') })) });
}

// The legend of the runs stands above every group of charts. A click in one of them acts on all.

function runLegends(charts) {
  const hidden = new Set();
  const fill = () => document.querySelectorAll('.densities').forEach((host) => {
    host.hidden = runs.length < 2;
    host.replaceChildren(...runs.map((run, k) =>
      legendButton({ label: run.label, colour: () => runColour(run) }, !hidden.has(k), (shown) => {
        if (shown) hidden.delete(k); else hidden.add(k);
        charts.forEach((chart) => chart.show(k, shown));
        fill();
        host.children[k].focus();
      })));
  });
  fill();
  recoloured.push(fill);
}

// Charts of one run over time

function courseChart(run, chart) {
  const table = run.tables[chart.table], columns = table?.columns;
  if (!(columns?.[chart.x].value.length > 1)) return;
  const isRound = run.tables.summary?.columns.rotors?.value[0] === 0;
  const shown = namedColumns(columns, chart.curves.filter(({ ofRotors }) => !(isRound && ofRotors)));
  if (!shown.length) return;
  const curves = shown.map(({ name, label }, k) => {
    const curve = curveOf(table, name, chart);
    return { ...curve, value: chart.isAngleOfAxis ? unwrapped(curve.value) : curve.value, label, id: name,
             colour: () => curveColour(k), noErrors: 'single samples' };
  });
  const { symbol, unit, ...description } = chartDescription(chart, columns, shown[0].name);
  addChart('course', { ...description, hint: table.stride > 1 ? `Shown: one sample in ${table.stride}.` : '', file: fileName(chart.heading),
    variants: [{ symbol, unit, curves, levels: levelsOf[chart.levelOfRun](run.tables.summary?.columns) }] });
}

const levelsOf = {
  none: () => [],
  mean: (summary) => summary?.compressibility_factor ? [summary.compressibility_factor.value[0]] : [],
  /** There is no equipartition in a run that cools. */
  equipartition: (summary) => {
    if (!summary?.rotations || byId('cooling')) return [];
    const translational = dimension / 2, rotational = 0.5 * summary.rotations.value[0] / summary.particles.value[0];
    return rotational ? [translational, rotational, translational + rotational] : [translational];
  },
};

function showCourse(run) {
  byId('course').replaceChildren();
  byId('course-run').textContent = runs.length > 1 ? `at ${run.label}` : '';
  chartsOf('course').forEach((chart) => courseChart(run, chart));
  hideIfEmpty('course');
}

/** The chart of a gas that cools, with Haff's law. */
function coolingChart({ tables: { energies }, cooling }) {
  if (!byId('cooling') || !energies) return;
  const { x, value } = curveOf(energies, 'translational', { x: 'time', logX: true });
  const begin = energies.columns.time.value[0], colour = () => curveColour(0);
  const curves = [{ x, value: value.map((energy) => 2 * energy / dimension), label: 'run', id: 'run', colour, noErrors: 'single samples' }];
  if (cooling) curves.push({ x, value: x.map((t) => cooling.initial / (1 + (t - begin) / cooling.time) ** cooling.exponent), label: 'Haff’s law',
    id: 'law', colour: () => cssColour('--ink'), dashed: true });
  addChart('cooling', { heading: 'Temperature', xSymbol: 't', xUnit: timeUnit, logX: true, logY: true, file: 'cooling.csv', variants: [{ symbol: 'T', unit: 'kT', curves }] });
}

// Charts over the parameters of the sweep: the last axis is the abscissa, and the other axes distinguish curves.

const abscissa = study.axes.at(-1), seriesAxes = study.axes.slice(0, -1);
const isOverDensity = abscissa.column.endsWith('packing_fraction') && !seriesAxes.length;

const density = { xSymbol: 'φ', xUnit: '', rangeX: (plot, low, high) => {
  const space = Math.max(0.06 * (high - low), 0.004);
  return [low - space, high + space];
} };

/**
 * The axis of these values. Names have equal distances; numbers have a logarithmic scale if they span more than a
 * decade.
 */
function axisOf({ column, symbol }) {
  const { value, unit } = study.jobs.columns[column], xUnit = unitOf({ unit });
  if (value.some((entry) => typeof entry === 'string')) {
    const names = [...new Set(value)];
    return { xSymbol: symbol, xUnit, namesX: names, rangeX: () => [-0.5, names.length - 0.5], place: (entry) => names.indexOf(entry) };
  }
  const logX = Math.min(...value) > 0 && Math.max(...value) > 10 * Math.min(...value);
  const rangeX = (plot, low, high) => {
    if (logX) return [low / (high / low) ** 0.04, high * (high / low) ** 0.04];
    const space = 0.06 * (high - low) || 0.05 * Math.abs(high) || 1;
    return [low - space, high + space];
  };
  return { xSymbol: symbol, xUnit, logX, rangeX, place: (entry) => entry };
}

const valueText = (value) => typeof value === 'string' ? value : shortNumber(value, 6);

/** The rows of every curve, by the name of the curve. */
function seriesOf(jobs) {
  const series = new Map();
  jobs.columns[abscissa.column].value.forEach((_, row) => {
    const name = seriesAxes.map(({ column, symbol }) => `${symbol} = ${valueText(jobs.columns[column].value[row])}`).join(', ');
    series.set(name, [...series.get(name) ?? [], row]);
  });
  return series;
}

/** Whether the packing fraction is the abscissa, or the same in all jobs up to rounding errors. */
const isGivenDensity = ({ value }) => abscissa.column.endsWith('packing_fraction') || Math.max(...value) - Math.min(...value) < 1e-6;

function studyChart({ heading, symbol, scale, curves: [{ column }] }) {
  const { jobs } = study, quantity = jobs.columns[column];
  if (!quantity?.value.some((value) => value !== null) || (column === 'packing_fraction' && isGivenDensity(quantity))) return;
  const { place, ...axis } = axisOf(abscissa), logY = scale === 'logarithmic' && quantity.value.some((value) => value > 0);
  const uneven = runs.some((run) => !run.evenlySampled) ? 'samples unevenly spaced in time' : tooFewBlocks;
  const curves = [...seriesOf(jobs)].map(([name, rows], k) => {
    const known = rows.filter((row) => quantity.value[row] !== null);
    const pick = (values) => known.map((row) => values?.[row] ?? null);
    return { label: name || symbol, id: k, points: 'full', colour: () => curveColour(k), x: pick(jobs.columns[abscissa.column].value).map(place),
             value: pick(quantity.value), error: pick(quantity.error), noErrors: quantity.error ? uneven : 'single numbers' };
  }).filter(({ x }) => x.length);
  const published = [...publishedPoints(column, place), ...publishedLaws(column, curves)];
  addChart('study', { heading, ...axis, logY, range: ranges[scale], file: fileName(heading),
    variants: [{ label: 'values', symbol, unit: unitOf(quantity), curves: [...curves, ...published] }, ...ratiosOf(curves, symbol)] });
}

/** The ratios of the other curves to the first, where both have points. */
function ratiosOf([first, ...others], symbol) {
  const curves = others.map((curve) => {
    const pairs = [...curve.x.entries()].map(([row, place]) => [row, first.x.indexOf(place)]).filter(([, below]) => below >= 0 && first.value[below]);
    const value = pairs.map(([row, below]) => curve.value[row] / first.value[below]);
    const relative = ({ value, error }, row) => error[row] === null ? NaN : error[row] / value[row];
    const error = pairs.map(([row, below], k) => Math.abs(value[k]) * Math.hypot(relative(curve, row), relative(first, below)));
    return { ...curve, x: pairs.map(([row]) => curve.x[row]), value, error: error.map((width) => Number.isNaN(width) ? null : width) };
  }).filter(({ x }) => x.length);
  return curves.length ? [{ label: `over that of ${first.label}`, symbol: `${symbol}, over that of ${first.label}`, unit: '', curves }] : [];
}

// Published results of the sweep

/** The rows of a table of published results about this column. */
const rowsAbout = (table, column) => [...table?.columns.quantity.value.keys() ?? []].filter((row) => table.columns.quantity.value[row] === column);

function publishedPoints(column, place) {
  const rows = rowsAbout(study.published, column), columns = study.published?.columns;
  return [...new Set(rows.map((row) => columns.source.value[row]))].map((source, k) => {
    const pick = (name) => rows.filter((row) => columns.source.value[row] === source).map((row) => columns[name].value[row]);
    return { label: source, id: `published ${k}`, points: 'hollow', colour: () => cssColour('--ink'), noErrors: 'as published',
             x: pick(abscissa.column).map(place), value: pick('published') };
  });
}

/** Lines of the published power laws, each through the middle of the points to which it applies. */
function publishedLaws(column, curves) {
  const columns = study.published_exponents?.columns, mean = (numbers) => numbers.reduce((sum, number) => sum + number / numbers.length, 0);
  return rowsAbout(study.published_exponents, column).map((row) => {
    const [from, to, exponent, source] = ['from', 'to', 'published', 'source'].map((name) => columns[name].value[row]);
    const points = curves.flatMap(({ x, value }) => x.map((place, k) => [place, value[k]])).filter(([x, y]) => x >= from && x <= to && y > 0);
    const height = mean(points.map(([x, y]) => Math.log(y) - exponent * Math.log(x)));
    return { label: `∝ ${abscissa.symbol}^${shortNumber(exponent)}: ${source}`, id: `law ${row}`, dashed: true, colour: () => cssColour('--ink'), noErrors: 'as published',
             x: [from, to], value: [from, to].map((x) => Math.exp(height) * x ** exponent) };
  });
}

/** The table of published and measured numbers, side by side. */
function publishedTable() {
  const rows = [], heading = (column) => charts.find(({ section, curves }) => section === 'study' && curves[0].column === column).heading;
  const add = (what, columns, row, power) => rows.push([what, `${heading(columns.quantity.value[row])}${power}`, shortNumber(columns.published.value[row], 4),
    withError(columns.measured.value[row], columns.measured.error?.[row]), columns.source.value[row]]);
  const values = study.published?.columns, laws = study.published_exponents?.columns;
  values?.quantity.value.forEach((_, row) =>
    add(study.axes.map(({ column, symbol }) => `${symbol} = ${valueText(values[column].value[row])}`).join(', '), values, row, ''));
  laws?.quantity.value.forEach((_, row) =>
    add(`${abscissa.symbol} = ${shortNumber(laws.from.value[row])} … ${shortNumber(laws.to.value[row])}`, laws, row, `: power of ${abscissa.symbol}`));
  byId('published').hidden = !rows.length;
  byId('published-rows').replaceChildren(...rows.map((cells) => {
    const line = element('tr');
    line.append(...cells.map((text) => element('td', {}, text)));
    return line;
  }));
}

// Glass

const kinds = ['translation', 'rotation', 'rotation in the nematic'];
/** Labels and kinds of points by what the table says about the orientations of a run. */
const orientations = { 'relaxes': { label: 'orientations relax', kind: 1 }, 'nematic order': { label: 'kept by nematic order', kind: 2 },
                       'does not relax': { label: 'orientations do not relax within the run', kind: 6 } };
const found = 'found', lowerBound = 'lower bound only', notEquilibrated = ', not equilibrated';

/**
 * The rows of the table `relaxation` that have a value, as points: full, or hollow if the run is not in equilibrium.
 */
function glassPoints(column, rows, label, colour) {
  const { packing_fraction: phi, [column]: { value, error } } = study.relaxation.columns;
  const verdict = study.relaxation.columns[column === 'tau_translation' ? 'verdict_translation' : 'verdict'];
  return [['full', ''], ['hollow', notEquilibrated]].map(([points, suffix]) => {
    const chosen = rows.filter((k) => value[k] !== null && (verdict.value[k] === 'equilibrated') === (points === 'full'));
    const pick = (values) => chosen.map((k) => values?.[k] ?? null);
    return { x: pick(phi.value), value: pick(value), error: pick(error), points,
             label: label + suffix, id: label + suffix, colour, noErrors: tooFewBlocks };
  }).filter((curve) => curve.x.length);
}

const glassRows = () => study.relaxation.columns.packing_fraction.value.map((_, k) => k);

function timesOf(kind) {
  const { orientation, plateau } = study.relaxation.columns;
  const nematic = (k) => orientation.value[k] === 'nematic order' || plateau.value[k] > 0;
  const rows = glassRows().filter((k) => kind === 0 || nematic(k) === (kind === 2));
  return glassPoints(kind === 0 ? 'tau_translation' : 'tau_rotation', rows, kinds[kind], () => curveColour(kind));
}

const laws = [
  { name: 'power law', logarithm: (phi, { phiC, s, logPrefactor }) => logPrefactor - s * Math.log(phiC - phi) },
  { name: 'Vogel–Fulcher', logarithm: (phi, { phiC, s, logPrefactor }) => logPrefactor + s * phi / (phiC - phi) },
];

/**
 * The law over the best window, and dashed a little beyond: by a quarter of the window, or until times are ten times
 * as long.
 */
function lawCurves(name, law, fit, colour) {
  const { low, high, phiC } = fit;
  if ([low, high, phiC, fit.s, fit.logPrefactor].includes(null)) return [];
  const least = Math.min(...study.relaxation.columns.packing_fraction.value);
  const at = (phi) => Math.exp(law.logarithm(phi, fit));
  const grid = (from, to) => Array.from({ length: 41 }, (_, i) => from + (to - from) * i / 40);
  const reach = 0.25 * (high - low), id = `${name}, ${law.name}`;
  const curve = (suffix, dashed, x) => ({ x, value: x.map(at), label: id + suffix, id, colour, dashed });
  return [curve('', false, grid(low, high)),
          curve(', below its window', true, grid(Math.max(least, low - reach), low)),
          curve(', above its window', true, grid(high, Math.min(high + reach, phiC))
            .filter((phi) => phi < phiC && at(phi) <= 10 * at(high)))];
}

function markOf(name, columns, k, colour) {
  const of = (column) => columns[column].value[k];
  if (of('verdict') === found)
    return { value: of('phi_c'), error: columns.phi_c.error[k], colour, label: `φc ${name} = ${of('phi_c').toFixed(3)}` };
  const least = of('phi_c_least');
  return { value: least, open: true, colour, label: `φc ${name} > ${least.toFixed(3)}` };
}

/** The curves of a law fitted to the times shown, with φ_c as vertical lines. */
function fitsOf(law) {
  const columns = study.glass_fit.columns;
  const of = (column, k) => columns[column].value[k];
  const fits = columns.kind.value.map((_, k) => k)
    .filter((k) => of('law', k) === law.name && [found, lowerBound].includes(of('verdict', k)))
    .map((k) => {
      const name = of('kind', k).split(',')[0], colour = () => curveColour(kinds.indexOf(name));
      const fit = { low: of('window_low', k), high: of('window_high', k), phiC: of('window_phi_c', k),
                    s: of('window_exponent', k), logPrefactor: of('window_log_prefactor', k) };
      return { curves: lawCurves(name, law, fit, colour), upright: markOf(name, columns, k, colour) };
    });
  return { curves: fits.flatMap(({ curves }) => curves), uprights: fits.map(({ upright }) => upright) };
}

function timesChart() {
  const points = kinds.flatMap((_, kind) => timesOf(kind));
  if (!points.length) return;
  const variant = (label, { curves, uprights }) => {
    const reach = uprights.map(({ value, error }) => value + (error ?? 0));
    return { label, symbol: 'τ', unit: timeUnit, curves: [...points, ...curves], uprights,
             rangeX: (plot, low, high) => density.rangeX(plot, low, Math.max(high, ...reach)) };
  };
  const variants = study.glass_fit ? laws.map((law) => variant('with ' + law.name, fitsOf(law)))
                                   : [variant('', { curves: [], uprights: [] })];
  addChart('study', { heading: 'Relaxation times', ...density, logY: true, file: 'relaxation_times.csv', variants });
}

/** The nematic order that so few rotors have by chance if they have none on average. */
function orderByChance() {
  const { packing_fraction: phi, nematic_by_chance: chance } = study.relaxation.columns;
  const rows = glassRows().filter((k) => chance.value[k] !== null && phi.value[k] !== phi.value[k - 1]);
  return { x: rows.map((k) => phi.value[k]), value: rows.map((k) => chance.value[k]), label: 'by chance', id: 'by chance',
           colour: () => cssColour('--quiet'), thin: true };
}

function orderChart() {
  const { orientation } = study.relaxation.columns;
  const points = Object.entries(orientations).flatMap(([name, kept]) => glassPoints('nematic_order',
    glassRows().filter((k) => orientation.value[k] === name), kept.label, () => curveColour(kept.kind)));
  if (!points.length) return;
  addChart('study', { heading: 'Nematic order', ...density, file: 'nematic_order.csv', range: () => [0, 1],
    variants: [{ symbol: 'S', unit: '', curves: [...points, orderByChance()] }] });
}

/** Warns if the runs have different wave numbers, at which times cannot be compared. */
function tellWaveNumbers() {
  const values = (study.relaxation.columns.wave_number?.value ?? []).filter((q) => q !== null);
  if (!values.length) return;
  const same = new Set(values.map((q) => shortNumber(q, 3))).size === 1;
  byId('wave-numbers').textContent = `Translation: the time in which Fₛ(q, t) falls to 1/e at ${rangeText('q', values)}.` + (same ? ''
    : ` As q varies, these times do not show the effect of density alone. At one q for all runs: vitrel report … --set ` +
      `analysis.wave_numbers=[${shortNumber(Math.max(...values), 2)}]`);
}

/** Charts of the glass that take the place of the charts of these columns. */
const glassCharts = { tau_translation: timesChart, tau_rotation: () => {}, nematic_order: orderChart };

function studyCharts() {
  const hasGlass = study.relaxation && isOverDensity;
  byId('glass').hidden = !study.relaxation;
  byId('glass-note').hidden = !hasGlass;
  byId('fits').parentElement.hidden = !study.glass_fit?.columns.kind.value.length;
  if (runs.length < 2) return;
  if (study.relaxation) tellWaveNumbers();
  for (const chart of chartsOf('study')) {
    const ofGlass = hasGlass && glassCharts[chart.curves[0].column];
    if (ofGlass) ofGlass();
    else if (study.jobs) studyChart(chart);
  }
  publishedTable();
}

// The page

function showRun(player, run) {
  const still = runs.length > 1 && run.dynamics && run.movie?.time.length === 1
    ? ` Only the final state of this run is in the page: vitrel report ${run.name}/run.h5 makes a page with its movie.` : '';
  const dynamics = run.dynamics ? run.dynamics + '.' : '';
  player.load(run.movie, { label: run.label, note: run.movie ? dynamics + still : 'The run holds no frame.' });
  showCourse(run);
}

function start() {
  const player = new Player();
  const last = runs.length - 1, course = byId('course').closest('section');
  byId('course').parentElement.open = runs.length === 1;
  if (runs.length > 1) course.before(byId('movie').closest('section'));
  const marked = runs.map((run) => run.label + (run.movie?.time.length > 1 ? '' : ' (final state)'));
  if (runs.length > 1) byId('movie-run').append(selection('Run', marked, last, (k) => showRun(player, runs[k])));
  showRun(player, runs[last]);
  coolingChart(runs[last]);
  studyCharts();
  runLegends(chartsOf('motion', 'relaxation', 'structure').map(runsChart).filter(Boolean));
  ['motion', 'relaxation', 'structure', 'study'].forEach(hideIfEmpty);
  recolour();
}

if (runs.length) start();
