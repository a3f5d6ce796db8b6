/** Draws a chart in its host, which is removed if there is nothing to show. */
function chartOf(id, { symbol, unit, levels, levelName, heading, noErrors, ...description }) {
  const host = byId(id), curve = pageData[id];
  if (!curve) return host?.remove();
  const { time: x, ...values } = curve;
  new Chart(host, { ...description, heading: `${heading}; dashed: ${levelName}`, file: id + '.csv',
    variants: [{ symbol, unit, levels, curves: [{ label: symbol, id, x, ...values, noErrors, colour: () => curveColour(0) }] }] });
}

const decay = { xSymbol: 't', xUnit: 'sweeps', unit: '', logX: true, noErrors: 'a single sampling' };
stateCharts(pageData);
chartOf('correlation', { heading: 'Nematic correlation', symbol: 'g₂(r) = ⟨cos 2(θᵢ − θⱼ)⟩', unit: '',
  xSymbol: 'r', xUnit: lengthUnit, levels: [pageData.order ** 2], levelName: 'S²' });
chartOf('orientation', { ...decay, heading: 'Orientations kept', symbol: 'C₂(t) = ⟨cos 2(θ(t) − θ(0))⟩',
  levels: [Math.exp(-1)], levelName: '1/e', range: (plot, low) => [Math.min(0, low), 1.02] });
chartOf('displacement', { ...decay, heading: 'Displacement in widths 2b', symbol: '√⟨|r(t) − r(0)|²/(2b)²⟩',
  levels: [1], levelName: '1', range: (plot, low, high) => [0, 1.08 * Math.max(1, high)] });
if (dimension === 2) hideIfEmpty('correlations');
else byId('clock').hidden = true;  // a packing has no time
new Player().load(pageData.movie, { label: pageData.label, note: pageData.movie ? '' : 'The state holds no particles.' });
recolour();
