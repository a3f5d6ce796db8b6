const pageData = JSON.parse(document.getElementById('data').textContent);
const byId = (id) => document.getElementById(id);

/** Hides the section around these charts if there are none. */
function hideIfEmpty(charts) {
  byId(charts).closest('section').hidden = !byId(charts).childElementCount;
}

function element(tag, attributes = {}, text = '') {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.textContent = text;
  return node;
}

/** A select with these labels. It calls `choose(k)` when the user selects another one. */
function selection(label, labels, chosen, choose) {
  const host = element('label', { class: 'choice' }, label);
  const select = element('select');
  labels.forEach((text, k) => select.append(element('option', { value: k }, text)));
  select.value = chosen;
  select.addEventListener('change', () => choose(Number(select.value)));
  host.append(select);
  return host;
}

// Numbers

const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';
function superscript(n) {
  return (n < 0 ? '⁻' : '') + [...String(Math.abs(n))].map((digit) => superscripts[digit]).join('');
}

const subscript = (n) => [...String(n)].map((digit) => '₀₁₂₃₄₅₆₇₈₉'[digit] ?? digit).join('');

function shortNumber(value, digits = 3) {
  if (value === null || value === undefined || !isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return Number(mantissa) + '·10' + superscript(Number(exponent));
  }
  return String(Number(value.toPrecision(digits)));
}

/** Puts the unit in brackets after the symbol. Pure numbers have no unit. */
const withUnit = (symbol, unit) => unit ? `${symbol} [${unit}]` : symbol;

/** Formats the error with two digits and the value with as many decimals as the error. */
function withError(value, error) {
  if (!(error > 0)) return shortNumber(value, 4);
  const decimals = Math.max(0, 1 - Math.floor(Math.log10(error)));
  if (decimals > 7) return `${shortNumber(value, 4)} ± ${shortNumber(error, 2)}`;
  return `${value.toFixed(decimals)} ± ${error.toFixed(decimals)}`;
}

// The colour scheme is that of the system until the user presses the button.

const systemDark = matchMedia('(prefers-color-scheme: dark)');
const root = document.documentElement;
const isDark = () => root.style.colorScheme ? root.style.colorScheme === 'dark' : systemDark.matches;
const recoloured = [];

function recolour() {
  byId('theme').textContent = isDark() ? 'Light page' : 'Dark page';
  recoloured.forEach((draw) => draw());
}

byId('theme').hidden = false;
byId('theme').addEventListener('click', () => {
  root.style.colorScheme = isDark() ? 'light' : 'dark';
  recolour();
});
systemDark.addEventListener('change', recolour);

/** The colour that a variable of the style sheet has in the present scheme. */
function cssColour(name) {
  byId('theme').style.accentColor = `var(${name})`;
  return getComputedStyle(byId('theme')).accentColor;
}

// Colours

/** Colours of curves in one chart that differ in kind. */
const curveColours = () => isDark()
  ? ['#56b4e9', '#f0a030', '#5fd0a0', '#e58fc0', '#e8dc5a', '#a99bf0', '#f07860', '#c3cad2']
  : ['#0072b2', '#c65200', '#00805c', '#b1407f', '#8a7a00', '#6a4fc4', '#a8281c', '#3c434b'];
const curveColour = (k) => curveColours()[k % curveColours().length];

// The lightness of viridis varies monotonically for every kind of colour blindness.
const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129],
                 [92, 200, 99], [170, 220, 50], [253, 231, 37]];

function sequential(x) {
  const at = Math.min(Math.max(x, 0), 1) * (viridis.length - 1);
  const k = Math.min(Math.floor(at), viridis.length - 2);
  const mixed = viridis[k].map((value, i) => Math.round(value + (at - k) * (viridis[k + 1][i] - value)));
  return `rgb(${mixed.join(' ')})`;
}

/**
 * Colours of curves that have an order, for x from 0 to 1. They leave out the end of the scale that fades into the
 * page.
 */
const orderedColour = (x) => isDark() ? sequential(1 - 0.68 * x) : sequential(0.66 * (1 - x));

// Orientations are cyclic: once around, the colours run from light through orange, dark and blue back to light, in
// the two directions (lightness, blue to yellow) that everyone can distinguish. They are mixed in OKLab.
function orientationColour(angle) {
  const phase = 2 * angle;
  const lightness = 0.64 + 0.24 * Math.cos(phase);
  const yellow = 0.125 * Math.sin(phase), red = 0.045 * Math.sin(phase);
  const mixing = [[0.3963377774, 0.2158037573], [-0.1055613458, -0.0638541728], [-0.0894841775, -1.291485548]];
  const [l, m, s] = mixing.map(([p, q]) => (lightness + p * red + q * yellow) ** 3);
  const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                  -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                  -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
  const channel = (value) => {
    const clipped = Math.min(Math.max(value, 0), 1);
    return Math.round(255 * (clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * clipped ** (1 / 2.4) - 0.055));
  };
  return `rgb(${linear.map(channel).join(' ')})`;
}
