/** A chart of columns of this table in its host, which is hidden if there is nothing to show. */
function tableChart(table, { x, columns, ...description }) {
  const host = byId(table), found = pageData.tables[table]?.columns;
  const names = Object.keys(found ?? {}).filter((name) => columns(name));
  host.hidden = !names.length;
  if (!names.length) return;
  new Chart(host, { ...description, file: table + '.csv', variants: [{ symbol: description.symbol, unit: '', levels: [1],
    curves: names.map((name, k) => ({ label: columns(name), id: name, x: found[x].value, value: found[name].value,
      colour: () => curveColour(k) })) }] });
}

function start() {
  const aroundOne = { range: (plot, low, high) => [Math.min(0, low), 1.06 * Math.max(1, high)] };
  const ofSpecies = (symbol, name) => name.replace(/^s_(.+)_(.+)$/, `${symbol} $1–$2`);
  tableChart('pair_correlation', { ...aroundOne, heading: 'Pair correlation', symbol: 'g(r)', x: 'r', xSymbol: 'r', xUnit: lengthUnit,
    columns: (name) => name === 'g' && 'g' });
  tableChart('structure_factor', { ...aroundOne, heading: 'Structure factor', symbol: 'S(q)', x: 'q', xSymbol: 'q', xUnit: '1/' + lengthUnit,
    columns: (name) => name === 's' ? 'S' : name.startsWith('s_') && ofSpecies('S', name) });
  new SolidView().load(pageData.scene, pageData.label);
  recolour();
}

start();
