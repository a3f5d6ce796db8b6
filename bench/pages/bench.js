const data = pageData;

// Tables. A cell is a text or {text, class, title}.

function tableRow(cells) {
  const row = element('tr');
  cells.forEach((cell, k) => {
    const { text, ...attributes } = typeof cell === 'object' ? cell : { text: cell };
    row.append(k === 0 ? element('th', { scope: 'row' }, text) : element('td', attributes, text));
  });
  return row;
}

function table({ head: headings, rows }) {
  const host = element('div', { class: 'scroll', tabindex: '0' });
  const whole = element('table', { class: 'matrix' }), head = element('thead'), body = element('tbody');
  head.append(element('tr'));
  for (const heading of headings) {
    const cell = element('th', { scope: 'col' });
    heading.split('_').forEach((part, k) => cell.append(...(k ? ['_', element('wbr'), part] : [part])));
    head.firstChild.append(cell);
  }
  body.append(...rows.map(tableRow));
  whole.append(head, body);
  host.append(whole);
  return host;
}

function details(summary, ...content) {
  const host = element('details');
  host.append(element('summary', {}, summary), ...content);
  return host;
}

// Parts

const looks = { line: { thin: true }, full: { points: 'full' }, hollow: { points: 'hollow' } };

/** Adds a chart of a part. The colours of its curves follow their numbers. */
function addChart(host, file, { symbol, unit, curves, ...rest }) {
  const place = element('div', { class: 'chart' });
  host.append(place);
  const coloured = curves.map(({ k, look, ...curve }) => ({ ...curve, ...looks[look], colour: () => curveColour(k),
                                                            dashed: look === 'line' && k >= curveColours().length }));
  new Chart(place, { file: `${file}.csv`, logX: true, logY: true, ...rest, variants: [{ label: '', symbol, unit, curves: coloured }] });
}

function addPart({ name, about, answer, charts, tables }) {
  const section = element('section', { id: name, 'aria-labelledby': `${name}-heading` });
  const places = element('div', { class: 'charts' });
  section.append(element('h2', { id: `${name}-heading` }, name), element('p', {}, about), element('p', { class: 'answer' }, answer), places);
  byId('parts').append(section);
  charts.forEach((chart, k) => addChart(places, `${name}-${k + 1}`, chart));
  const all = tables?.at(-1);
  for (const shown of (tables ?? []).slice(0, -1)) section.append(element('h3', {}, shown.heading), table(shown));
  if (all) section.append(tables.length > 1 ? details(all.heading, table(all)) : table(all));
}

// Failing pairs

function failingPair({ method, caption, class: name, aspect_ratio: kappa, index, command }) {
  const text = `${method} ${caption} (class ${name}, κ = ${kappa}, pair ${index}).`;
  return [element('p', {}, text), ...(command ? [element('pre', { tabindex: '0' }, command)] : [])];
}

// The page

data.parts.forEach(addPart);
if (data.more?.failures?.length) {
  byId('failures').append(...data.more.failures.flatMap(failingPair));
  byId('failures').parentElement.hidden = false;
}
byId('settled').hidden = !data.settled.length;
byId('settled').append(...data.settled.map((answer) => element('p', {}, answer)));
recolour();
