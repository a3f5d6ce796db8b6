const view = { ...pageData, caption: '', missing: 'The state holds no particles.' };

/** A chart in its host, which is hidden if there is nothing to show. */
function chartOf(id, description) {
  const host = byId(id), curve = pageData[id];
  host.hidden = !curve;
  if (!curve) return null;
  const level = description.levels ? '; dashed: ' + description.levelName : '';
  return new Chart(host, { ...description, heading: description.heading + level, file: id + '.csv',
    curves: [{ label: description.symbol, ...curve }], colours: (k) => curveColours()[k] });
}

function start() {
  const decay = { xSymbol: 't', xUnit: 'sweeps', yUnit: '', logX: true };
  const charts = [
    chartOf('correlation', { heading: 'Nematic correlation', symbol: 'g₂(r) = ⟨cos 2(θᵢ − θⱼ)⟩', yUnit: '',
      xSymbol: 'r', xUnit: '√(ab)', levels: [pageData.order ** 2], levelName: 'S²' }),
    chartOf('orientation', { ...decay, heading: 'Orientations kept', symbol: 'C₂(t) = ⟨cos 2(θ(t) − θ(0))⟩',
      levels: [Math.exp(-1)], levelName: '1/e', range: (plot, low) => [Math.min(0, low), 1.02] }),
    chartOf('displacement', { ...decay, heading: 'Displacement in widths 2b', symbol: '√⟨|r(t) − r(0)|²/(2b)²⟩',
      levels: [1], levelName: '1', range: (plot, low, high) => [0, 1.08 * Math.max(1, high)] }),
  ].filter(Boolean);
  byId('correlations').parentElement.hidden = !charts.length;
  drawState(view);
  drawOrientationKey();

  watchPicture(() => drawState(view), () => {
    charts.forEach((chart) => chart.draw());
  });
}

start();
