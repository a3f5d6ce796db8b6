const data = pageData;

// Tables. A cell is a text, or {text, class, title}.

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

/** A chart of a part, whose curves get the colours of their numbers. */
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
  return [element('h3', {}, failure.method), element('p', { class: 'note' },
    `${failure.method} ${failure.caption} (class ${failure.class}, κ = ${failure.aspect_ratio}, pair ${failure.index}).`), pictures];
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
