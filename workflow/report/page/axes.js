const font = '12px system-ui, sans-serif';

// Axes

// The ticks of uPlot begin at the end of the axis, wherever that is, and its labels print "0" for values under 1e-3.

const digits = [1, 2, 3, 4, 5, 6, 7, 8, 9];
/** Factors that labelled values may have besides a power of ten, from the coarsest choice to the finest. */
const labelledFactors = [[1], [1, 2, 5], digits, [1, 1.5, 2, 2.5, ...digits.slice(2)],
                         [1, 1.2, 1.4, 1.6, 1.8, 2, 2.2, 2.4, 2.6, 2.8, 3, 3.5, 4, 4.5, ...digits.slice(4)]];

function logarithmicValues(low, high, factors) {
  const first = Math.floor(Math.log10(low)), last = Math.ceil(Math.log10(high));
  return Array.from({ length: last - first + 1 }, (_, k) => factors.map((factor) => Number((factor * 10 ** (first + k)).toPrecision(3))))
    .flat().filter((value) => value >= low && value <= high);
}

/** The labels of the coarsest choice that has three or more of them. */
function labelledValues(low, high) {
  const choices = labelledFactors.map((factors) => logarithmicValues(low, high, factors));
  return choices.find((values) => values.length >= 3) ?? choices.at(-1);
}

/** The labelled values and, if there are not too many decades, 1, 2 … 9 times the powers of ten. */
function logarithmicSplits(low, high) {
  const between = high < 1e9 * low ? logarithmicValues(low, high, digits) : [];
  return [...new Set([...labelledValues(low, high), ...between])].sort((a, b) => a - b);
}

const labelledOf = (splits) => splits.length ? labelledValues(splits[0], splits.at(-1)) : [];

function logarithmicLabels(splits) {
  const labelled = labelledOf(splits);
  const plain = splits.every((value) => value > 0.0009 && value < 20000);
  return splits.map((value) => {
    if (!labelled.includes(value)) return '';
    if (plain) return String(value);
    const exponent = Math.floor(Math.log10(value) + 1e-9);
    const mantissa = Number((value / 10 ** exponent).toPrecision(3));
    return (mantissa === 1 ? '' : mantissa + '·') + '10' + superscript(exponent);
  });
}

const linearLabels = (splits) => splits.map((value) => value === null ? '' : shortNumber(value, 6));

/** The axis is as wide as its longest label. */
const labelWidth = (plot, labels) => 18 + 7 * Math.max(3, ...(labels ?? []).map((label) => label.length));

/** The range is not widened to whole decades. */
const logarithmicRange = (plot, low, high) => low > 0 ? [0.8 * low, 1.25 * high] : [0.1, 1];

/** The ends of the visible curves with their errors. On a logarithmic axis only positive values count. */
function extentOf(plot, chart, low, high) {
  chart.data.values.forEach((values, k) => {
    if (!plot.series[k + 1].show || !chart.data.errors[k]) return;
    values.forEach((value, i) => {
      const error = chart.data.errors[k][i];
      if (value === null || error === null || (chart.logY && !(value > 0))) return;
      if (value > error || !chart.logY) low = Math.min(low, value - error);
      high = Math.max(high, value + error);
    });
  });
  return [low, high];
}

/**
 * The range covers at least a thousandth of the values; in a narrower one, the rounding errors of a constant would
 * fill the chart.
 */
function linearRange(plot, low, high) {
  if (low === null) return [0, 1];
  const least = 1e-3 * Math.max(Math.abs(low), Math.abs(high)) || 1;
  const margin = Math.max(0, 0.5 * (least - (high - low)));
  return uPlot.rangeNum(low - margin, high + margin, 0.1, true);
}

function axisOptions(logarithmic, size, names) {
  const grid = { stroke: cssColour('--grid'), width: 1 };
  if (logarithmic) grid.filter = (plot, splits) => {
    const labelled = labelledOf(splits);
    return splits.map((value) => labelled.includes(value) ? value : null);
  };
  const options = {
    stroke: cssColour('--quiet'), font, size, grid, ticks: { stroke: cssColour('--line'), width: 1, size: 5 },
    values: (plot, splits) => logarithmic ? logarithmicLabels(splits) : linearLabels(splits),
  };
  if (names) return { ...options, splits: () => names.map((_, k) => k), values: () => names, grid: { show: false } };
  if (!logarithmic) return options;
  return { ...options, splits: (plot, axis, low, high) => logarithmicSplits(low, high), filter: (plot, splits) => splits };
}
