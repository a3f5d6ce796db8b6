const { runs, study } = pageData;

// Which curves the tables hold. A family is a table, or several with a group of particles behind the name; `columns` are
// regular expressions of column names, and what their curves are called; `isStoredOnly`: never measured on the fly.

/** "q = 2.41", or from the lowest to the highest where it differs from run to run. */
function rangeText(symbol, values) {
  const [low, high] = [Math.min(...values), Math.max(...values)].map((value) => shortNumber(value, 3));
  return `${symbol} = ${low === high ? low : `${low} … ${high}, varying between runs`}`;
}

/** The k-th wave number of these runs; collective functions have that of the wave vectors of the box. */
function waveNumber(k, of, origin = '', column = 'q') {
  const values = of.flatMap((run) => {
    const table = run.tables[origin + 'wave_numbers']?.columns;
    return (table?.[column] ?? table?.q)?.value[table.index.value.indexOf(k)] ?? [];
  });
  return values.length ? rangeText('q', values) : `q${subscript(k)}`;
}

const inPlane = dimension === 2;
const time = { xSymbol: 't', xUnit: timeUnit, x: 'time', logX: true };
const decays = { range: (plot, low) => [Math.min(0, low), 1.04] };

/** Seen from their own director, angles are not evenly distributed even without order: (1 + 2 S cos 2θ)/π, S = √(π/(4R)) of R particles. */
function densityByChance({ curves: [{ x }] }) {
  const counts = new Set(runs.map((run) => run.tables.summary?.columns.rotors?.value[0]).filter((rotors) => rotors > 0));
  return [...counts].map((rotors) => ({ x, value: x.map((angle) => (1 + Math.sqrt(Math.PI / rotors) * Math.cos(2 * angle)) / Math.PI),
    label: 'by chance', id: 'by chance', colour: () => cssColour('--ink'), dashed: true }));
}

const families = [
  { section: 'motion', table: 'displacements', heading: 'Mean squared displacement', ...time, logY: true, slopes: true,
    columns: [[/^msd$/, () => '⟨|Δr|²⟩'], [/^msd_parallel$/, () => '⟨Δr²⟩ along the axis'],
              [/^msd_perpendicular$/, () => '⟨Δr²⟩ across the axis']], symbol: '⟨|Δr(t)|²⟩', unit: areaUnit },
  { section: 'motion', table: 'cage_relative', isStoredOnly: true, heading: 'Mean squared displacement relative to the cage', ...time, logY: true, slopes: true,
    columns: [[/^msd$/, () => '⟨|Δr − Δr of the neighbours|²⟩']], symbol: '⟨|Δr(t)|²⟩', unit: areaUnit },
  { section: 'motion', table: 'displacements', heading: 'Mean squared rotation', ...time, logY: true, slopes: true,
    columns: [[/^msr$/, () => inPlane ? '⟨Δθ²⟩' : '⟨|Δφ|²⟩']], symbol: inPlane ? '⟨Δθ(t)²⟩' : '⟨|Δφ(t)|²⟩', unit: 'rad²',
    missing: 'All particles are round: their rotation is not modelled.' },
  { section: 'motion', table: 'displacements', heading: 'Non-Gaussian parameter', ...time, levels: [0],
    columns: [[/^non_gaussian$/, () => 'of displacements'], [/^non_gaussian_rotation$/, () => 'of rotations']],
    symbol: 'α₂(t)', unit: '' },
  { section: 'relaxation', table: 'self_scattering', heading: 'Self-intermediate scattering', ...time, ...decays,
    levels: [Math.exp(-1)], columns: [[/^fs_(\d+)$/, ([, k], of, origin) => waveNumber(Number(k), of, origin)]], symbol: 'Fₛ(q, t)', unit: '', named: true },
  { section: 'relaxation', table: 'cage_relative', isStoredOnly: true, heading: 'Self-intermediate scattering relative to the cage', ...time, ...decays,
    levels: [Math.exp(-1)], columns: [[/^fs_(\d+)$/, ([, k], of) => waveNumber(Number(k), of)]], symbol: 'Fₛ(q, t)', unit: '', named: true },
  { section: 'relaxation', table: 'orientation', heading: 'Orientational correlation', ...time, ...decays,
    levels: [Math.exp(-1)], columns: [[/^([lp])_(\d+)$/, ([, letter, order]) => letter.toUpperCase() + subscript(order)]],
    symbol: inPlane ? 'Lₙ(t) = ⟨cos nΔθ⟩' : '⟨Pₗ(u(0)·u(t))⟩', unit: '', named: true },
  { section: 'relaxation', table: 'collective_scattering', heading: 'Collective scattering', ...time,
    columns: [[/^f_(\d+)$/, ([, k], of) => waveNumber(Number(k), of, '', 'q_collective')]], symbol: 'F(q, t)', unit: '', named: true },
  { section: 'relaxation', table: 'susceptibility', heading: 'Four-point susceptibility', ...time,
    columns: [[/^chi_4$/, () => 'χ₄']], symbol: 'χ₄(t)', unit: '' },
  { section: 'relaxation', table: 'susceptibility', heading: 'Overlap', ...time, ...decays,
    columns: [[/^overlap$/, () => '⟨Q⟩']], symbol: '⟨Q(t)⟩', unit: '' },
  ...structureFamilies().map((family) => ({ section: 'structure', ...family })),
  { section: 'structure', table: 'orientation_distribution', heading: 'Orientations about the director', xSymbol: 'θ − θ of the director',
    xUnit: 'rad', x: 'angle', references: densityByChance, range: (plot, low, high) => [0, 1.08 * high],
    columns: [[/^density$/, () => 'density']], symbol: 'density', unit: '1/rad' },
  { section: 'structure', table: 'velocity_distribution', heading: 'Velocities', xSymbol: 'c = v √(m/T)', xUnit: '', x: 'component',
    references: (variant) => gaussian(variant), range: (plot, low, high) => [0, 1.08 * high],
    columns: [[/^density$/, () => 'density of components']], symbol: 'density', unit: '' },
];

/** Of the components of velocities in units of their standard deviation, in equilibrium. */
const gaussian = ({ curves: [{ x }] }) => [{ x, value: x.map((c) => Math.exp(-c * c / 2) / Math.sqrt(2 * Math.PI)), label: 'Gaussian',
  id: 'Gaussian', colour: () => cssColour('--ink'), dashed: true }];

/** An axis looks the same after half a turn: of the angles that stand for it, the nearest to the one before. */
function unwrapped(angles) {
  let last = 0;
  return angles.map((angle) => angle === null ? null : last = angle + Math.PI * Math.round((last - angle) / Math.PI));
}

const series = [
  { table: 'energies', heading: 'Energy per particle', symbol: 'E/N', unit: 'kT', fromZero: true,
    columns: [[/^translational$/, () => 'translational'], [/^rotational$/, () => 'rotational'], [/^total$/, () => 'total']] },
  { table: 'compressibility_factor', heading: 'Compressibility factor', symbol: 'Z = βP/ρ', unit: '', columns: [[/^z$/, () => 'Z']] },
  { table: 'velocities', heading: 'Second Sonine coefficient', symbol: 'a₂', unit: '', columns: [[/^a_2$/, () => 'a₂']] },
  { table: 'order', heading: 'Order', symbol: 'order parameter', unit: '', fromZero: true,
    columns: [[/^nematic$/, () => 'nematic'], [/^hexatic$/, () => 'hexatic']] },
  { table: 'order', heading: 'Director', symbol: 'angle of the director, continued beyond ±π/2', unit: 'rad', transform: unwrapped,
    columns: [[/^director$/, () => 'director']] },
  { table: 'order', heading: 'Director', symbol: 'components of the director', unit: '', columns: [[/^director_([xyz])$/, ([, axis]) => axis]] },
];

// Correlations measured while the run went on have one table for each group of particles, of all families together.
const onTheFly = 'on_the_fly_';
const isOnTheFly = (group) => group.startsWith(onTheFly);

/** Labels are for these runs together. */
const shownColumns = (table, family, of, group = '') => namedColumns(table.columns, family, of, isOnTheFly(group) ? onTheFly : '');

/** The groups of particles that some run has a table of the family for: "" if the table has no group. */
function groupsOf(family) {
  const names = runs.flatMap((run) => Object.keys(run.tables));
  if (names.includes(family.table)) return [''];
  const groups = new Set(names.filter((name) => name.startsWith(family.table + '_')).map((name) => name.slice(family.table.length)));
  const others = new Set(family.isStoredOnly ? [] : runs.flatMap((run) => Object.keys(run.tables).filter((name) => isOnTheFly(name) &&
    run.tables[name].columns[family.x] && shownColumns(run.tables[name], family, runs).length)));
  return [...groups].sort((a, b) => (b === '_all') - (a === '_all')).concat([...others]);
}

const tableOf = (run, family, group) => run.tables[isOnTheFly(group) ? group : family.table + group];

const tooFewBlocks = 'too few independent blocks';
const noErrors = (run, group = '') => run.evenlySampled || isOnTheFly(group) ? tooFewBlocks : 'samples unevenly spaced in time';

/** From the first known value to the last; a time of 0 has no place on a logarithmic axis. */
function curveOf(table, name, family) {
  const { value, error } = table.columns[name], x = table.columns[family.x].value;
  const known = (y, i) => y !== null && (x[i] > 0 || !family.logX);
  const [begin, end] = [value.findIndex(known), value.findLastIndex(known) + 1];
  const shown = (values) => values?.slice(Math.max(begin, 0), end);
  return { x: shown(x), value: shown(value), error: shown(error) };
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
    const columns = shownColumns(table, family, runs, group);
    if (!columns.length) return [];
    return [{ label: groupName(group, groups), name: columns.length === 1 ? columns[0].label : '',
      curves: columns.map(({ name, label }, k) => ({ ...curveOf(table, name, family), label, id: name,
        colour: () => curveColour(k), noErrors: noErrors(run, group) })) }];
  });
}

/** Several runs: one column of all of them in one chart. */
function variantsOfRuns(family, groups) {
  return groups.flatMap((group) => {
    const names = new Map(runs.flatMap((run) => {
      const table = tableOf(run, family, group);
      return table ? shownColumns(table, family, runs, group).map(({ name, label }) => [name, label]) : [];
    }));
    return [...names].map(([name, label]) => ({
      name: label,
      label: [names.size > 1 ? label : '', groupName(group, groups)].filter(Boolean).join(', '),
      curves: runs.flatMap((run, k) => {
        const table = tableOf(run, family, group);
        return table?.columns[name] ? [{ ...curveOf(table, name, family), label: run.label, id: k,
          colour: () => runColour(run), noErrors: noErrors(run, group) }] : [];
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
    .map((variant) => ({ ...variant, symbol: family.symbol + (family.named && variant.name ? `, ${variant.name}` : ''),
      unit: family.unit, levels: family.levels, curves: [...variant.curves, ...(family.references?.(variant) ?? [])] }));
  if (!variants.length) {
    if (groups.length && family.missing) byId(family.section).after(element('p', { class: 'note' }, family.missing));
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
  const columns = table && table.columns.time.value.length ? shownColumns(table, description, [run]) : [];
  const round = table?.columns.rotational && run.tables.summary?.columns.rotors?.value[0] === 0;
  const shown = columns.filter(({ name }) => !(round && name !== 'translational'));
  if (!shown.length) return;
  const { transform = (values) => values } = description;
  const curves = shown.map(({ name, label }, k) => {
    const curve = curveOf(table, name, { x: 'time' });
    return { ...curve, value: transform(curve.value), label, id: name, colour: () => curveColour(k), noErrors: 'single samples' };
  });
  const hint = table.stride > 1 ? `Shown: one sample in ${table.stride}.` : '';
  const highest = Math.max(...curves.flatMap((curve) => curve.value.map((value, i) => value + (curve.error?.[i] ?? 0))));
  addChart('series', { ...description, hint, xSymbol: 't', xUnit: timeUnit, file: fileName(description.heading),
    range: description.fromZero ? () => [0, 1.08 * highest || 1] : undefined,
    variants: [{ symbol: description.symbol, unit: description.unit, curves, levels: levelsOf(run, description) }] });
}

/** Equipartition for energies of a run that does not cool, the mean for the compressibility factor. */
function levelsOf(run, { table }) {
  const summary = run.tables.summary?.columns;
  if (table === 'energies' && summary?.rotations && !byId('cooling')) {
    const translational = dimension / 2, rotational = 0.5 * summary.rotations.value[0] / summary.particles.value[0];
    return rotational ? [translational, rotational, translational + rotational] : [translational];
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

/** Of a gas that cools, with Haff's law. */
function coolingChart({ tables: { energies }, cooling }) {
  if (!byId('cooling') || !energies) return;
  const { x, value } = curveOf(energies, 'translational', { x: 'time', logX: true });
  const begin = energies.columns.time.value[0], colour = () => curveColour(0);
  const curves = [{ x, value: value.map((energy) => 2 * energy / dimension), label: 'run', id: 'run', colour, noErrors: 'single samples' }];
  if (cooling) curves.push({ x, value: x.map((t) => cooling.initial / (1 + (t - begin) / cooling.time) ** cooling.exponent), label: 'Haff’s law',
    id: 'law', colour: () => cssColour('--ink'), dashed: true });
  addChart('cooling', { heading: 'Temperature', ...time, logY: true, file: 'cooling.csv', variants: [{ symbol: 'T', unit: 'kT', curves }] });
}

// Against the packing fraction

const density = { xSymbol: 'φ', xUnit: '', rangeX: (plot, low, high) => {
  const space = Math.max(0.06 * (high - low), 0.004);
  return [low - space, high + space];
} };

const transport = [
  { column: 'diffusion', heading: 'Diffusion', symbol: 'D', unit: `√(${areaUnit} kT/m)`, logY: true },
  { column: 'rotational_diffusion', heading: 'Rotational diffusion', symbol: 'Dᵣ', unit: `√(kT/(m ${areaUnit}))`, logY: true },
  { column: 'compressibility_factor', heading: 'Compressibility factor', symbol: 'Z = βP/ρ', unit: '' },
];
const speed = { heading: 'Speed of the simulation', symbol: 'collisions per second', unit: '1/s', reason: 'a single measurement' };

function overDensity({ heading, symbol, unit, logY, reason }, values) {
  const known = values.filter(({ value }) => value !== null && value !== undefined);
  if (!known.length) return;
  const reasons = known.filter(({ error }) => (error ?? null) === null).map(({ run }) => reason ?? noErrors(run));
  const curve = { label: symbol, id: 0, points: 'full', colour: () => curveColour(0), x: known.map(({ run }) => run.packingFraction),
                  value: known.map(({ value }) => value), error: known.map(({ error }) => error ?? null),
                  noErrors: [...new Set(reasons)].join('; ') };
  addChart('over-density', { heading, ...density, logY, file: fileName(heading), variants: [{ symbol, unit, curves: [curve] }] });
}

// Glass

const kinds = ['translation', 'rotation', 'rotation in the nematic'];
const orientations = [null, { label: 'orientations relax', kind: 1 }, { label: 'kept by nematic order', kind: 2 },
                      { label: 'orientations do not relax within the run', kind: 6 }];
const found = 0, lowerBound = 1, notEquilibrated = ', not equilibrated';

/** These rows of the table `relaxation` that have a value, as points: full, or hollow if the run is not in equilibrium. */
function glassPoints(column, rows, label, colour) {
  const { packing_fraction: phi, [column]: { value, error } } = study.relaxation.columns;
  const verdict = study.relaxation.columns[column === 'tau_translation' ? 'verdict_translation' : 'verdict'];
  return [['full', ''], ['hollow', notEquilibrated]].map(([points, suffix]) => {
    const chosen = rows.filter((k) => value[k] !== null && (verdict.value[k] === 0) === (points === 'full'));
    const pick = (values) => chosen.map((k) => values?.[k] ?? null);
    return { x: pick(phi.value), value: pick(value), error: pick(error), points,
             label: label + suffix, id: label + suffix, colour, noErrors: tooFewBlocks };
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
  addChart('over-density', { heading: 'Relaxation times', ...density, logY: true, file: 'relaxation_times.csv', variants });
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
  addChart('over-density', { heading: 'Nematic order', ...density, file: 'nematic_order.csv', range: () => [0, 1],
    variants: [{ symbol: 'S', unit: '', curves: [...points, orderByChance()] }] });
}

/** Times at different wave numbers cannot be compared. */
function tellWaveNumbers() {
  const values = (study.relaxation.columns.wave_number?.value ?? []).filter((q) => q !== null);
  if (!values.length) return;
  const same = new Set(values.map((q) => shortNumber(q, 3))).size === 1;
  byId('wave-numbers').textContent = `Translation: the time in which Fₛ(q, t) falls to 1/e at ${rangeText('q', values)}.` + (same ? ''
    : ` As q varies, these times do not show the effect of density alone. At one q for all runs: vitrel report … --set ` +
      `analysis.wave_numbers=[${shortNumber(Math.max(...values), 2)}]`);
}

function densityCharts() {
  byId('glass').hidden = !study.relaxation;
  byId('fits').parentElement.hidden = !study.glass_fit;
  if (runs.length < 2) return;
  if (study.relaxation) {
    tellWaveNumbers();
    timesChart();
  }
  transport.forEach((description) => overDensity(description, runs.map((run) => {
    const values = run.tables.summary?.columns[description.column];
    return { run, value: values?.value[0], error: values?.error?.[0] };
  })));
  if (study.relaxation) orderChart();
  overDensity(speed, runs.map((run) => ({ run, value: run.collisionsPerSecond })));
}

// The page

function showRun(player, run) {
  const still = runs.length > 1 && run.movie?.time.length === 1
    ? ` Only the final state of this run is in the page: vitrel report ${run.name}/run.h5 makes a page with its movie.` : '';
  const dynamics = run.dynamics ? run.dynamics + '.' : '';
  player.load(run.movie, { label: run.label, note: run.movie ? dynamics + still : 'The run holds no frame.' });
  showSeries(run);
}

function start() {
  const player = new Player();
  const last = runs.length - 1, course = byId('series').closest('section');
  byId('series').parentElement.open = runs.length === 1;
  if (runs.length > 1) course.before(byId('movie').closest('section'));
  const marked = runs.map((run) => run.label + (run.movie?.time.length > 1 ? '' : ' (final state)'));
  if (runs.length > 1) byId('movie-run').append(selection('Run', marked, last, (k) => showRun(player, runs[k])));
  showRun(player, runs[last]);
  coolingChart(runs[last]);
  densityCharts();
  const charts = families.map(familyChart).filter(Boolean);
  runLegends(charts);
  ['motion', 'relaxation', 'structure', 'over-density'].forEach(hideIfEmpty);
  recolour();
}

if (runs.length) start();
