const { runs } = pageData;

// Colours. Densities are ordered, so they take a sequential map (viridis, without the end that fades
// into the page); it keeps its order of lightness for every kind of colour blindness.

const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129],
                 [92, 200, 99], [170, 220, 50], [253, 231, 37]];

function sequential(x) {
  const at = Math.min(Math.max(x, 0), 1) * (viridis.length - 1);
  const k = Math.min(Math.floor(at), viridis.length - 2);
  const mixed = viridis[k].map((value, i) => Math.round(value + (at - k) * (viridis[k + 1][i] - value)));
  return `rgb(${mixed.join(' ')})`;
}

function densityColour(k) {
  const x = runs.length > 1 ? k / (runs.length - 1) : 0.5;
  return darkMode.matches ? sequential(1 - 0.68 * x) : sequential(0.64 * (1 - x));
}

// Motion

const timeUnit = '√(m ab/kT)';

function motionChart(id, key, description) {
  const shown = runs.map((run, k) => ({ run, k })).filter(({ run }) => run[key]);
  if (!shown.length) {
    byId(id).append(element('h3', {}, description.heading), element('p', { class: 'note' }, description.missing));
    return null;
  }
  const chart = new Chart(byId(id), { ...description, xSymbol: 't', xUnit: timeUnit, logX: true, logY: true,
    file: key + '.csv', curves: shown.map(({ run }) => ({ label: run.label, ...run[key] })), colours: (k) => densityColour(shown[k].k) });
  return { chart, toggle: (k, on) => {
    const index = shown.findIndex((entry) => entry.k === k);
    if (index >= 0) chart.show(index, on);
  } };
}

function densityLegend(charts) {
  const host = byId('density-legend');
  host.hidden = runs.length < 2;
  const off = new Set();
  const fill = () => host.replaceChildren(...runs.map((run, k) => {
    const button = element('button', { type: 'button', 'aria-pressed': String(!off.has(k)) });
    const swatch = element('i');
    swatch.style.background = densityColour(k);
    button.append(swatch, run.label);
    button.addEventListener('click', () => {
      if (!off.delete(k)) off.add(k);
      button.setAttribute('aria-pressed', String(!off.has(k)));
      charts.forEach((entry) => entry.toggle(k, !off.has(k)));
    });
    return button;
  }));
  fill();
  return fill;
}

// One density

function energyCurves(run) {
  const { time, translational, rotational, total } = run.energy;
  if (!run.rotors) return [{ label: 'translational (total)', time, value: translational }];
  return [{ label: 'translational', time, value: translational }, { label: 'rotational', time, value: rotational },
          { label: 'total', time, value: total }];
}

function energyLegend(curves, colours) {
  const list = element('ul', { class: 'small-legend' });
  curves.forEach((curve, k) => {
    const entry = element('li'), swatch = element('i');
    swatch.style.background = colours(k);
    entry.append(swatch, curve.label);
    list.append(entry);
  });
  const entry = element('li');
  entry.append(element('i', { class: 'dashed' }), 'equipartition');
  list.append(entry);
  return list;
}

function energyChart(run) {
  const host = element('div', { class: 'chart', id: 'energy' });
  byId('energy').replaceWith(host);
  if (!run.energy.time.length) {
    host.append(element('h3', {}, 'Energy per particle'), element('p', { class: 'note' }, 'Not recorded in this run.'));
    return null;
  }
  const curves = energyCurves(run);
  const colours = (k) => curveColours()[k];
  const highest = Math.max(...curves.flatMap((curve) => curve.value), 1);
  const thinned = run.energy.stride > 1 ? `, one sample in ${run.energy.stride}` : '';
  return new Chart(host, { heading: 'Energy per particle' + thinned, symbol: 'E/N', yUnit: 'kT', xSymbol: 't',
    xUnit: timeUnit, file: 'energy.csv', curves, colours, range: () => [0, 1.08 * highest],
    levels: run.rotors ? [1, 0.5 * run.rotors / run.particles] : [1], legend: () => energyLegend(curves, colours) });
}

function drawFinalState(run) {
  const dynamics = run.dynamics ? run.dynamics + '; ' : '';
  const caption = run.state ? `${dynamics}t = ${shortNumber(run.state.time, 5)}; ` : '';
  drawState({ ...run, caption, missing: 'The run holds no frame.' });
}

function runPicker(choose) {
  byId('run-picker').hidden = runs.length < 2;
  runs.forEach((run, k) => {
    const label = element('label');
    const input = element('input', { type: 'radio', name: 'run', value: k });
    input.checked = k === runs.length - 1;
    input.addEventListener('change', () => choose(k));
    label.append(input, run.label);
    byId('run-picker').append(label);
  });
}

function start() {
  const charts = [
    motionChart('msd', 'msd', { heading: 'Mean squared displacement', symbol: '⟨|r(t) − r(0)|²⟩', yUnit: 'ab',
      missing: 'Not enough frames.' }),
    motionChart('msr', 'msr', { heading: 'Mean squared rotation', symbol: '⟨(θ(t) − θ(0))²⟩', yUnit: 'rad²',
      missing: 'All particles are round: their rotation is not modelled.' }),
  ].filter(Boolean);
  const refillLegend = densityLegend(charts);

  let chosen = runs.length - 1, energy = null;
  const choose = (k) => {
    chosen = k;
    drawFinalState(runs[k]);
    energy = energyChart(runs[k]);
  };
  runPicker(choose);
  choose(chosen);
  drawOrientationKey();

  watchPicture(() => drawFinalState(runs[chosen]), () => {
    charts.forEach(({ chart }) => chart.draw());
    energy?.build();
    refillLegend();
  });
}

if (runs.length) start();
