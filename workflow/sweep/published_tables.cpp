#include "workflow/sweep/published_tables.h"

#include <algorithm>
#include <cmath>

#include "core/special_values.h"

namespace vitrel {
namespace {

/// Adds a row to a column whose values are words.
void add_word(Column& column, const std::string& word) {
  const auto found = std::ranges::find(column.labels, word);
  column.value.push_back(static_cast<double>(found - column.labels.begin()));
  if (found == column.labels.end()) column.labels.push_back(word);
}

/// The keys of the sweep with their values in every row of the averages.
std::vector<StudyAxis> keys_of(const std::vector<SeedAverage>& averages) {
  std::vector<SweptValues> values;
  for (const SeedAverage& average : averages) values.push_back(average.values);
  return study_keys(values);
}

Table values_table(const std::vector<SeedAverage>& averages) {
  const std::vector<StudyAxis> keys = keys_of(averages);
  std::vector<Column> columns;
  for (const StudyAxis& key : keys) columns.push_back({key.column(), key.unit, {}, {}, key.labels});
  Column quantity{"quantity", "1"}, source{"source", "1"}, published{"published", "1"},
      measured{"measured", "1"};
  for (std::size_t row = 0; row < averages.size(); ++row)
    for (const Published& entry : averages[row].published) {
      if (entry.is_exponent) continue;
      const AveragedFigure found = averages[row].find(entry.quantity);
      for (std::size_t k = 0; k < keys.size(); ++k) columns[k].value.push_back(keys[k].value[row]);
      add_word(quantity, entry.quantity);
      add_word(source, entry.source);
      published.value.push_back(entry.value);
      measured.value.push_back(found.mean);
      measured.error.push_back(found.error);
    }
  columns.insert(columns.end(), {quantity, source, published, measured});
  return {"published",
          "What publications give for jobs of the sweep, and the averages of these jobs over "
          "their seeds, in the same unit.",
          std::move(columns)};
}

/// The slope of a least-squares line; unknown if all x are equal.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  double x_mean = 0, y_mean = 0, covariance = 0, variance = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    x_mean += x[k] / static_cast<double>(x.size());
    y_mean += y[k] / static_cast<double>(x.size());
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    covariance += (x[k] - x_mean) * (y[k] - y_mean);
    variance += (x[k] - x_mean) * (x[k] - x_mean);
  }
  return variance > 0 ? covariance / variance : unknown;
}

double measured_exponent(const Published& law, const std::vector<double>& abscissa,
                         const std::vector<SeedAverage>& averages) {
  std::vector<double> x, y;
  for (std::size_t row = 0; row < averages.size(); ++row) {
    const double mean = averages[row].find(law.quantity).mean;
    if (!(mean > 0 && abscissa[row] > 0) || abscissa[row] < law.from || abscissa[row] > law.to)
      continue;
    x.push_back(std::log(abscissa[row]));
    y.push_back(std::log(mean));
  }
  return slope_of(x, y);
}

Table exponents_table(const std::vector<SeedAverage>& averages, const StudyAxis& abscissa) {
  const std::vector<StudyAxis> keys = keys_of(averages);
  const std::vector<double>& places = std::ranges::find(keys, abscissa.key, &StudyAxis::key)->value;
  Column quantity{"quantity", "1"}, source{"source", "1"}, from{"from", abscissa.unit},
      to{"to", abscissa.unit}, published{"published", "1"}, measured{"measured", "1"};
  for (const Published& entry : averages.front().published) {
    if (!entry.is_exponent) continue;
    add_word(quantity, entry.quantity);
    add_word(source, entry.source);
    from.value.push_back(std::max(entry.from, *std::ranges::min_element(places)));
    to.value.push_back(std::min(entry.to, *std::ranges::max_element(places)));
    published.value.push_back(entry.value);
    measured.value.push_back(measured_exponent(entry, places, averages));
  }
  return {"published_exponents",
          "Power laws that publications give for a quantity along the abscissa between `from` and "
          "`to`, and the slope of the averages over seeds in that part, on logarithmic scales.",
          {quantity, source, from, to, published, measured}};
}

}  // namespace

std::vector<Table> published_tables(const std::vector<SeedAverage>& averages,
                                    const std::vector<StudyAxis>& axes) {
  if (axes.empty()) return {};
  std::vector<Table> tables = {values_table(averages), exponents_table(averages, axes.back())};
  std::erase_if(tables, [](const Table& table) { return table.rows() == 0; });
  return tables;
}

}  // namespace vitrel
