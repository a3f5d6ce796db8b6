const { runs, study } = pageData;

// Which curves the tables hold. A family is a table, or several with a group of particles behind the name; `columns` are
// regular expressions of column names, and what their curves are called.

const q = (k, run, origin = '') => {
  const table = run.tables[origin + 'wave_numbers']?.columns;
  const row = table?.index.value.indexOf(k) ?? -1;
  return row < 0 ? `q${subscript(k)}` : `q = ${shortNumber(table.q.value[row], 3)}`;
};
const time = { xSymbol: 't', xUnit: timeUnit, x: 'time', logX: true };
const decays = { range: (plot, low) => [Math.min(0, low), 1.04] };
const aroundOne = { levels: [1], range: (plot, low, high) => [Math.min(0, low), 1.06 * Math.max(1, high)] };

const families = [
  { section: 'motion', table: 'displacements', heading: 'Mean squared displacement', ...time, logY: true, slopes: true,
    columns: [[/^msd$/, () => '⟨|Δr|²⟩'], [/^msd_parallel$/, () => '⟨Δr²⟩ along the axis'],
              [/^msd_perpendicular$/, () => '⟨Δr²⟩ across the axis']], symbol: '⟨|Δr(t)|²⟩', unit: 'ab' },
  { section: 'motion', table: 'displacements', heading: 'Mean squared rotation', ...time, logY: true, slopes: true,
    columns: [[/^msr$/, () => '⟨Δθ²⟩']], symbol: '⟨Δθ(t)²⟩', unit: 'rad²',
    missing: 'All particles are round: their rotation is not modelled.' },
  { section: 'motion', table: 'displacements', heading: 'Non-Gaussian parameter', ...time, levels: [0],
    columns: [[/^non_gaussian$/, () => 'of displacements'], [/^non_gaussian_rotation$/, () => 'of rotations']],
    symbol: 'α₂(t)', unit: '' },
  { section: 'relaxation', table: 'self_scattering', heading: 'Self-intermediate scattering', ...time, ...decays,
    levels: [Math.exp(-1)], columns: [[/^fs_(\d+)$/, (match, run, origin) => q(Number(match[1]), run, origin)]], symbol: 'Fₛ(q, t)', unit: '' },
  { section: 'relaxation', table: 'orientation', heading: 'Orientational correlation', ...time, ...decays,
    levels: [Math.exp(-1)], columns: [[/^l_(\d+)$/, (match) => `L${subscript(match[1])}`]],
    symbol: 'Lₙ(t) = ⟨cos nΔθ⟩', unit: '' },
  { section: 'relaxation', table: 'collective_scattering', heading: 'Collective scattering', ...time,
    columns: [[/^f_(\d+)$/, (match, run) => q(Number(match[1]), run)]], symbol: 'F(q, t)', unit: '' },
  { section: 'relaxation', table: 'susceptibility', heading: 'Four-point susceptibility', ...time,
    columns: [[/^chi_4$/, () => 'χ₄']], symbol: 'χ₄(t)', unit: '' },
  { section: 'relaxation', table: 'susceptibility', heading: 'Overlap', ...time, ...decays,
    columns: [[/^overlap$/, () => '⟨Q⟩']], symbol: '⟨Q(t)⟩', unit: '' },
  { section: 'structure', table: 'structure_factor', heading: 'Structure factor', xSymbol: 'q', xUnit: '1/√(ab)', x: 'q', ...aroundOne,
    columns: [[/^s$/, () => 'S'], [/^s_orientation$/, () => 'S of orientations'], [/^s_(.+)_(.+)$/, (match) => `S ${match[1]}–${match[2]}`]],
    symbol: 'S(q)', unit: '' },
  { section: 'structure', table: 'pair_correlation', heading: 'Pair correlation', xSymbol: 'r', xUnit: lengthUnit, x: 'r', ...aroundOne,
    columns: [[/^g$/, () => 'g'], [/^g_(\d+)$/, (match) => `g${subscript(match[1])}`]], symbol: 'g(r)', unit: '' },
  { section: 'structure', table: 'orientation_distribution', heading: 'Orientations about the director', xSymbol: 'θ − θ of the director',
    xUnit: 'rad', x: 'angle', levels: [1 / Math.PI], range: (plot, low, high) => [0, 1.08 * Math.max(1 / Math.PI, high)],
    columns: [[/^density$/, () => 'density']], symbol: 'density', unit: '1/rad' },
];

const series = [
  { table: 'energies', heading: 'Energy per particle', symbol: 'E/N', unit: 'kT', fromZero: true,
    columns: [[/^translational$/, () => 'translational'], [/^rotational$/, () => 'rotational'], [/^total$/, () => 'total']] },
  { table: 'compressibility_factor', heading: 'Compressibility factor', symbol: 'Z = βP/ρ', unit: '', columns: [[/^z$/, () => 'Z']] },
  { table: 'order', heading: 'Order', symbol: 'order parameter', unit: '', fromZero: true,
    columns: [[/^nematic$/, () => 'nematic'], [/^hexatic$/, () => 'hexatic']] },
  { table: 'order', heading: 'Director', symbol: 'angle of the director', unit: 'rad', columns: [[/^director$/, () => 'director']] },
];

// Correlations measured while the run went on have one table for each group of particles, of all families together.
const onTheFly = 'on_the_fly_';
const isOnTheFly = (group) => group.startsWith(onTheFly);

/** [{name, label}] of the columns of this table that the family shows, in the order of the family. */
function shownColumns(table, family, run, group = '') {
  const origin = isOnTheFly(group) ? onTheFly : '';
  return family.columns.flatMap(([pattern, label]) => Object.keys(table.columns)
    .filter((name) => pattern.test(name)).map((name) => ({ name, label: label(name.match(pattern), run, origin) })));
}

/** The groups of particles that some run has a table of the family for: "" if the table has no group. */
function groupsOf(family) {
  const names = runs.flatMap((run) => Object.keys(run.tables));
  if (names.includes(family.table)) return [''];
  const groups = new Set(names.filter((name) => name.startsWith(family.table + '_')).map((name) => name.slice(family.table.length)));
  const others = new Set(runs.flatMap((run) => Object.keys(run.tables).filter((name) => isOnTheFly(name) &&
    run.tables[name].columns[family.x] && shownColumns(run.tables[name], family, run).length)));
  return [...groups].sort((a, b) => (b === '_all') - (a === '_all')).concat([...others]);
}

const tableOf = (run, family, group) => run.tables[isOnTheFly(group) ? group : family.table + group];

/** A time of 0 has no place on a logarithmic axis. */
function curveOf(table, name, family) {
  const { value, error } = table.columns[name];
  const x = table.columns[family.x].value, begin = family.logX && x[0] === 0 ? 1 : 0;
  return { x: x.slice(begin), value: value.slice(begin), error: error?.slice(begin) };
}

/** Densities are ordered, and so are their colours. */
function runColour(run) {
  const all = runs.map((other) => other.packingFraction);
  const low = Math.min(...all), high = Math.max(...all);
  return orderedColour(high > low ? (run.packingFraction - low) / (high - low) : 0.5);
}

const particlesOf = (group) => group === '_all' ? 'all particles' : 'species ' + group.slice(1);
const groupName = (group, groups) => groups.length < 2 ? ''
  : isOnTheFly(group) ? particlesOf(group.slice(onTheFly.length - 1)) + ', on the fly' : particlesOf(group);

/** One run: its columns in one chart. */
function variantsOfOneRun(family, groups) {
  const [run] = runs;
  return groups.flatMap((group) => {
    const table = tableOf(run, family, group);
    const columns = shownColumns(table, family, run, group);
    if (!columns.length) return [];
    return [{ label: groupName(group, groups), curves: columns.map(({ name, label }, k) =>
      ({ ...curveOf(table, name, family), label, id: name, colour: () => curveColour(k) })) }];
  });
}

/** Several runs: one column of all of them in one chart. */
function variantsOfRuns(family, groups) {
  return groups.flatMap((group) => {
    const names = new Map(runs.flatMap((run) => {
      const table = tableOf(run, family, group);
      return table ? shownColumns(table, family, run, group).map(({ name, label }) => [name, label]) : [];
    }));
    return [...names].map(([name, label]) => ({
      label: [names.size > 1 ? label : '', groupName(group, groups)].filter(Boolean).join(', '),
      curves: runs.flatMap((run, k) => {
        const table = tableOf(run, family, group);
        return table?.columns[name] ? [{ ...curveOf(table, name, family), label: run.label, id: k, colour: () => runColour(run) }] : [];
      }),
    }));
  });
}

/** In free flight at the beginning, mean squares grow as t². */
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

function familyChart(family) {
  const groups = groupsOf(family);
  const variants = (runs.length > 1 ? variantsOfRuns(family, groups) : variantsOfOneRun(family, groups))
    .map((variant) => ({ symbol: family.symbol, unit: family.unit, levels: family.levels, ...variant }));
  if (!variants.length) {
    if (groups.length && family.missing) byId(family.section).append(element('p', { class: 'note' }, family.missing));
    return null;
  }
  const stride = Math.max(...runs.flatMap((run) => groups.map((group) => tableOf(run, family, group)?.stride ?? 1)));
  return addChart(family.section, { ...family, variants, legendOutside: runs.length > 1, file: fileName(family.heading),
    hint: stride > 1 ? `Shown: one point in ${stride}.` : '', slopes: family.slopes ? slopesOf(variants) : [] });
}

// The legend of the runs stands above every group of charts, and all of these act alike.

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

// One run in the course of time

function seriesChart(run, description) {
  const table = run.tables[description.table];
  const columns = table && table.columns.time.value.length ? shownColumns(table, description, run) : [];
  const round = table?.columns.rotational && run.tables.summary?.columns.rotors?.value[0] === 0;
  const shown = columns.filter(({ name }) => !(round && name !== 'translational'));
  if (!shown.length) return;
  const curves = shown.map(({ name, label }, k) =>
    ({ ...curveOf(table, name, { x: 'time' }), label, id: name, colour: () => curveColour(k) }));
  const hint = table.stride > 1 ? `Shown: one sample in ${table.stride}.` : '';
  const highest = Math.max(...curves.flatMap((curve) => curve.value.map((value, i) => value + (curve.error?.[i] ?? 0))));
  addChart('series', { ...description, hint, xSymbol: 't', xUnit: timeUnit, file: fileName(description.heading),
    range: description.fromZero ? () => [0, 1.08 * highest] : undefined,
    variants: [{ symbol: description.symbol, unit: description.unit, curves, levels: levelsOf(run, description) }] });
}

/** Equipartition for energies, the mean for the compressibility factor. */
function levelsOf(run, { table }) {
  const summary = run.tables.summary?.columns;
  if (table === 'energies' && summary?.rotors) {
    const rotors = summary.rotors.value[0] / summary.particles.value[0];
    return rotors ? [1, 0.5 * rotors, 1 + 0.5 * rotors] : [1];
  }
  const z = summary?.compressibility_factor;
  return table === 'compressibility_factor' && z ? [z.value[0]] : [];
}

function showSeries(run) {
  byId('series').replaceChildren();
  byId('series-run').textContent = runs.length > 1 ? `at ${run.label}` : '';
  series.forEach((description) => seriesChart(run, description));
  hideIfEmpty('series');
}

// Against the packing fraction

const density = { xSymbol: 'φ', xUnit: '', rangeX: (plot, low, high) => {
  const space = Math.max(0.06 * (high - low), 0.004);
  return [low - space, high + space];
} };

const averages = [
  { column: 'compressibility_factor', heading: 'Compressibility factor', symbol: 'Z = βP/ρ', unit: '' },
  { column: 'diffusion', heading: 'Diffusion', symbol: 'D', unit: '√(ab kT/m)', logY: true },
  { column: 'rotational_diffusion', heading: 'Rotational diffusion', symbol: 'Dᵣ', unit: '√(kT/(m ab))', logY: true },
];

function overDensity(heading, symbol, unit, logY, values) {
  const known = values.filter(({ value }) => value !== null && value !== undefined);
  if (runs.length < 2 || !known.length) return;
  const curve = { label: symbol, id: 0, points: 'full', colour: () => curveColour(0), x: known.map(({ run }) => run.packingFraction),
                  value: known.map(({ value }) => value), error: known.map(({ error }) => error ?? null) };
  addChart('over-density', { heading, ...density, logY, file: fileName(heading), variants: [{ symbol, unit, curves: [curve] }] });
}

function densityCharts() {
  averages.forEach(({ column, heading, symbol, unit, logY }) => overDensity(heading, symbol, unit, logY, runs.map((run) => {
    const values = run.tables.summary?.columns[column];
    return { run, value: values?.value[0], error: values?.error?.[0] };
  })));
  overDensity('Speed of the simulation', 'collisions per second', '1/s', false,
    runs.map((run) => ({ run, value: run.collisionsPerSecond })));
}

// Glass

const kinds = ['translation', 'rotation', 'rotation in the nematic'];
const orientations = [null, { label: 'orientations relax', kind: 1 }, { label: 'kept by nematic order', kind: 2 },
                      { label: 'orientations do not relax', kind: 6 }];
const found = 0, lowerBound = 1, notEquilibrated = ', not equilibrated';

/** These rows of the table `relaxation` that have a value, as points: full, or hollow if the run is not in equilibrium. */
function glassPoints(column, rows, label, colour) {
  const { packing_fraction: phi, [column]: { value, error } } = study.relaxation.columns;
  const verdict = study.relaxation.columns[column === 'tau_translation' ? 'verdict_translation' : 'verdict'];
  return [['full', ''], ['hollow', notEquilibrated]].map(([points, suffix]) => {
    const chosen = rows.filter((k) => value[k] !== null && (verdict.value[k] === 0) === (points === 'full'));
    const pick = (values) => chosen.map((k) => values?.[k] ?? null);
    return { x: pick(phi.value), value: pick(value), error: pick(error), points, label: label + suffix, id: label + suffix, colour };
  }).filter((curve) => curve.x.length);
}

const glassRows = () => study.relaxation.columns.packing_fraction.value.map((_, k) => k);

function timesOf(kind) {
  const { orientation, plateau } = study.relaxation.columns;
  const nematic = (k) => orientation.value[k] === 2 || plateau.value[k] > 0;
  const rows = glassRows().filter((k) => kind === 0 || nematic(k) === (kind === 2));
  return glassPoints(kind === 0 ? 'tau_translation' : 'tau_rotation', rows, kinds[kind], () => curveColour(kind));
}

const laws = [
  { name: 'power law', logarithm: (phi, { phiC, s, logPrefactor }) => logPrefactor - s * Math.log(phiC - phi) },
  { name: 'Vogel–Fulcher', logarithm: (phi, { phiC, s, logPrefactor }) => logPrefactor + s * phi / (phiC - phi) },
];

/** The law over the best window, and dashed a little beyond: a quarter of it, or until times are ten times as long. */
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

/** What a law makes of the times shown: curves, and φ_c as uprights. */
function fitsOf(law) {
  const columns = study.glass_fit.columns;
  const of = (column, k) => columns[column].value[k];
  const fits = columns.kind.value.map((_, k) => k)
    .filter((k) => of('law', k) === law && of('kind', k) < kinds.length && [found, lowerBound].includes(of('verdict', k)))
    .map((k) => {
      const name = kinds[of('kind', k)], colour = () => curveColour(of('kind', k));
      const fit = { low: of('window_low', k), high: of('window_high', k), phiC: of('window_phi_c', k),
                    s: of('window_exponent', k), logPrefactor: of('window_log_prefactor', k) };
      return { curves: lawCurves(name, laws[law], fit, colour), upright: markOf(name, columns, k, colour) };
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
  const variants = study.glass_fit ? laws.map(({ name }, law) => variant('with ' + name, fitsOf(law)))
                                   : [variant('', { curves: [], uprights: [] })];
  addChart('glass', { heading: 'Relaxation times', ...density, logY: true, file: 'relaxation_times.csv', variants });
}

/** The order of rotors that have none is not zero, as there are so few. */
function orderByChance() {
  const { packing_fraction: phi, nematic_by_chance: chance } = study.relaxation.columns;
  const rows = glassRows().filter((k) => chance.value[k] !== null && phi.value[k] !== phi.value[k - 1]);
  return { x: rows.map((k) => phi.value[k]), value: rows.map((k) => chance.value[k]), label: 'by chance', id: 'by chance',
           colour: () => cssColour('--quiet'), thin: true };
}

function orderChart() {
  const { orientation } = study.relaxation.columns;
  const points = orientations.flatMap((kept, code) => !kept ? [] : glassPoints('nematic_order',
    glassRows().filter((k) => orientation.value[k] === code), kept.label, () => curveColour(kept.kind)));
  if (!points.length) return;
  addChart('glass', { heading: 'Nematic order', ...density, file: 'nematic_order.csv', range: () => [0, 1],
    variants: [{ symbol: 'S', unit: '', curves: [...points, orderByChance()] }] });
}

function glassCharts() {
  byId('glass').closest('section').hidden = !study.relaxation;
  byId('fits').parentElement.hidden = !study.glass_fit;
  if (!study.relaxation) return;
  timesChart();
  orderChart();
}

// The page

function hideIfEmpty(section) {
  byId(section).closest('section').hidden = !byId(section).childElementCount;
}

function showRun(player, run) {
  const still = runs.length > 1 && run.movie?.time.length === 1
    ? ` Only the final state of this run is in the page: vitrel report ${run.name}/run.h5 makes a page with its movie.` : '';
  const dynamics = run.dynamics ? run.dynamics + '.' : '';
  player.load(run.movie, { label: run.label, note: run.movie ? dynamics + still : 'The run holds no frame.' });
  showSeries(run);
}

function start() {
  const player = new Player();
  const last = runs.length - 1;
  const marked = runs.map((run) => run.label + (run.movie?.time.length > 1 ? '' : ' (final state)'));
  if (runs.length > 1) byId('movie-run').append(selection('Run', marked, last, (k) => showRun(player, runs[k])));
  showRun(player, runs[last]);
  const charts = families.map(familyChart).filter(Boolean);
  runLegends(charts);
  densityCharts();
  glassCharts();
  ['motion', 'relaxation', 'structure', 'over-density'].forEach(hideIfEmpty);
  recolour();
}

if (runs.length) start();
