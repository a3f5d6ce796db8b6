const { runs, study } = pageData;

// Which curves the tables hold. A family is a table, or several with a group of particles behind the name; `columns` are
// regular expressions of column names, and what their curves are called.

const q = (k, run) => {
  const table = run.tables.wave_numbers?.columns;
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
    levels: [Math.exp(-1)], columns: [[/^fs_(\d+)$/, (match, run) => q(Number(match[1]), run)]], symbol: 'Fₛ(q, t)', unit: '' },
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
  { table: 'compressibility', heading: 'Compressibility factor', symbol: 'Z = βP/ρ', unit: '', columns: [[/^z$/, () => 'Z']] },
  { table: 'order', heading: 'Order', symbol: 'order parameter', unit: '', fromZero: true,
    columns: [[/^nematic$/, () => 'nematic'], [/^hexatic$/, () => 'hexatic']] },
  { table: 'order', heading: 'Director', symbol: 'angle of the director', unit: 'rad', columns: [[/^director$/, () => 'director']] },
];

/** [{name, label}] of the columns of this table that the family shows, in the order of the family. */
function shownColumns(table, family, run) {
  return family.columns.flatMap(([pattern, label]) => Object.keys(table.columns)
    .filter((name) => pattern.test(name)).map((name) => ({ name, label: label(name.match(pattern), run) })));
}

/** The groups of particles that some run has a table of the family for: "" if the table has no group. */
function groupsOf(family) {
  const names = runs.flatMap((run) => Object.keys(run.tables));
  if (names.includes(family.table)) return [''];
  const groups = new Set(names.filter((name) => name.startsWith(family.table + '_')).map((name) => name.slice(family.table.length)));
  return [...groups].sort((a, b) => (b === '_all') - (a === '_all'));
}

const tableOf = (run, family, group) => run.tables[family.table + group];

function curveOf(table, name, family) {
  const { value, error } = table.columns[name];
  return { x: table.columns[family.x].value, value, error };
}

/** Densities are ordered, and so are their colours. */
function runColour(run) {
  const all = runs.map((other) => other.packingFraction);
  const low = Math.min(...all), high = Math.max(...all);
  return orderedColour(high > low ? (run.packingFraction - low) / (high - low) : 0.5);
}

const groupName = (group, groups) => groups.length > 1 ? (group === '_all' ? 'all particles' : 'species ' + group.slice(1)) : '';

/** One run: its columns in one chart. */
function variantsOfOneRun(family, groups) {
  const [run] = runs;
  return groups.flatMap((group) => {
    const table = tableOf(run, family, group);
    const columns = shownColumns(table, family, run);
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
      return table ? shownColumns(table, family, run).map(({ name, label }) => [name, label]) : [];
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
  return addChart(family.section, { ...family, variants, legendOutside: runs.length > 1, file: fileName(family.heading),
    slopes: family.slopes ? slopesOf(variants) : [] });
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
  return table === 'compressibility' && summary?.compressibility ? [summary.compressibility.value[0]] : [];
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
  { column: 'compressibility', heading: 'Compressibility factor', symbol: 'Z = βP/ρ', unit: '' },
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

const kinds = [{ name: 'rotation', column: 'tau_rotation' }, { name: 'translation', column: 'tau_translation' }];

function relaxationPoints(column, name, kind) {
  const { packing_fraction: phi, verdict, [column]: tau } = study.relaxation.columns;
  const rows = phi.value.map((_, k) => k).filter((k) => tau.value[k] !== null);
  const points = (wanted, label, style) => {
    const chosen = rows.filter((k) => (verdict.value[k] === 0) === wanted);
    const pick = (values) => chosen.map((k) => values?.[k] ?? null);
    return { x: pick(phi.value), value: pick(tau.value), error: pick(tau.error), points: style, label, id: label,
             colour: () => curveColour(kind) };
  };
  return [points(true, name, 'full'), points(false, name + ', not equilibrated', 'hollow')].filter((curve) => curve.x.length);
}

const laws = [
  { name: 'power law', at: (phi, { phiC, exponent, amplitude }) => amplitude * (phiC - phi) ** -exponent },
  { name: 'Vogel–Fulcher', at: (phi, { phiC, exponent, amplitude }) => amplitude * Math.exp(exponent * phi / (phiC - phi)) },
];

/** The fits as [{curve, upright}]; curves reach over the fitted window and on towards φ_c. */
function glassFits() {
  const table = study.glass_fit?.columns;
  if (!table) return [];
  return table.kind.value.flatMap((kind, k) => {
    const fit = { phiC: table.phi_c.value[k], exponent: table.exponent.value[k], amplitude: table.amplitude.value[k] };
    const low = table.window_low.value[k], high = table.window_high.value[k];
    if (Object.values(fit).includes(null) || low === null || high === null) return [];
    const law = laws[table.law.value[k]];
    const end = high + 0.6 * (fit.phiC - high);
    const x = Array.from({ length: 80 }, (_, i) => low + (end - low) * i / 79);
    const colour = () => curveColour(kind);
    const label = `${kinds[kind].name}, ${law.name}`;
    return [{ curve: { x, value: x.map((phi) => law.at(phi, fit)), label, id: label, colour, dashed: table.law.value[k] === 1 },
              upright: { value: fit.phiC, error: table.phi_c.error?.[k], colour, label: `φc ${kinds[kind].name}` },
              law: table.law.value[k] }];
  });
}

function glassCharts() {
  byId('fits').parentElement.hidden = !study.glass_fit;
  byId('times').parentElement.hidden = !study.relaxation;
  if (!study.relaxation) return;
  const fits = glassFits();
  const curves = [...kinds.flatMap(({ column, name }, kind) => relaxationPoints(column, name, kind)), ...fits.map(({ curve }) => curve)];
  const uprights = fits.filter(({ law }) => law === 0).map(({ upright }) => upright);
  const rangeX = (plot, low, high) => density.rangeX(plot, low, Math.max(high, ...uprights.map(({ value, error }) => value + (error ?? 0))));
  addChart('glass', { heading: 'Relaxation times', ...density, rangeX, logY: true, file: 'relaxation_times.csv',
    variants: [{ symbol: 'τ', unit: timeUnit, curves, uprights }] });
  const order = relaxationPoints('nematic_order', 'nematic order', 2);
  if (order.length) addChart('glass', { heading: 'Nematic order', ...density, file: 'nematic_order.csv', range: () => [0, 1],
    variants: [{ symbol: 'S', unit: '', curves: order }] });
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
  ['motion', 'relaxation', 'structure', 'glass', 'over-density'].forEach(hideIfEmpty);
  recolour();
}

if (runs.length) start();
