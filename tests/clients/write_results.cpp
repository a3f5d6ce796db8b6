#include <cmath>

#include "analysis/results.h"
#include "core/special_values.h"

/// Writes results with every table that an analysis makes, and the odd ones among them: unknown numbers
/// and errors, errors larger than the value, equal values, nothing known, nothing that a logarithmic axis
/// can show, one row: write_results <path>.
namespace {

using namespace vitrel;

std::vector<double> logarithmic_times() {
  std::vector<double> times;
  for (int k = 0; k < 60; ++k) times.push_back(1e-3 * std::pow(10, 0.1 * k));
  return times;
}

std::vector<double> grid(double first, double step, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(first + step * k);
  return values;
}

template <class Function>
std::vector<double> each(const std::vector<double>& x, Function&& function) {
  std::vector<double> values;
  for (const double value : x) values.push_back(function(value));
  return values;
}

std::vector<double> equal(const std::vector<double>& x, double value) {
  return each(x, [&](double) { return value; });
}

/// Unknown for the last ones.
std::vector<double> errors(const std::vector<double>& values, double share) {
  std::vector<double> result = each(values, [&](double v) { return share * std::abs(v) + 1e-6; });
  for (std::size_t k = result.size() - 5; k < result.size(); ++k) result[k] = unknown;
  return result;
}

Column with_errors(const char* name, const char* unit, std::vector<double> values, double share) {
  std::vector<double> error = errors(values, share);
  return {name, unit, std::move(values), std::move(error)};
}

Table displacements() {
  const std::vector<double> t = logarithmic_times();
  const auto msd = each(t, [](double x) { return 4 * x * x / (1 + 3 * x); });
  const auto msr = each(t, [](double x) { return 2 * x * x / (1 + 3 * x); });
  return {"displacements_all",
          "Mean squared displacement against the time difference.",
          {{"time", "time", t, {}},
           with_errors("msd", "length^2", msd, 0.1),
           with_errors("msd_parallel", "length^2", msd, 1.5),
           with_errors("quartic", "length^4", each(msd, [](double x) { return 2 * x * x; }), 0.2),
           with_errors("non_gaussian", "1",
                       each(t, [](double x) { return x * std::exp(-x) - 0.1; }), 0.3),
           with_errors("msr", "rad^2", msr, 0.1),
           {"quartic_rotation", "rad^4", equal(t, 0), {}},
           {"non_gaussian_rotation", "1", equal(t, unknown), equal(t, unknown)},
           {"origins", "1", each(t, [](double x) { return std::floor(1e5 / x); }), {}}}};
}

Table scattering(const char* name, const char* curve) {
  std::vector<double> t = logarithmic_times();
  t.insert(t.begin(), 0);
  Table table{name, "Scattering functions.", {{"time", "time", t, {}}}};
  for (int k = 1; k <= 3; ++k)
    table.columns.push_back(with_errors((curve + std::to_string(k)).c_str(), "1",
                                        each(t, [&](double x) { return std::exp(-k * k * x); }),
                                        0.05));
  return table;
}

Table susceptibility() {
  const std::vector<double> t = logarithmic_times();
  return {"susceptibility",
          "Overlap.",
          {{"time", "time", t, {}},
           with_errors("overlap", "1", each(t, [](double x) { return std::exp(-x); }), 0.02),
           with_errors("chi_4", "1", each(t, [](double x) { return x * std::exp(-x); }), 0.2)}};
}

Table structure_factor() {
  const std::vector<double> q = grid(0.2, 0.05, 300);
  const auto s = each(q, [](double x) { return 1 + std::sin(3 * x) / x; });
  return {"structure_factor",
          "Static structure factor.",
          {{"q", "1/length", q, {}},
           with_errors("s", "1", s, 0.1),
           {"s_A_B", "1", each(q, [](double x) { return std::cos(x) / x; }), {}},
           {"modes", "1", each(q, [](double x) { return std::ceil(100 * x); }), {}}}};
}

Table pair_correlation() {
  const std::vector<double> r = grid(0.01, 0.02, 400);
  return {"pair_correlation",
          "Pair correlation.",
          {{"r", "length", r, {}},
           {"g", "1", each(r, [](double x) { return x < 1 ? 0 : 1 + std::exp(-x); }), {}},
           {"g_2", "1", each(r, [](double x) { return std::exp(-x); }), {}}}};
}

Table orientations() {
  const std::vector<double> angle = grid(-1.5, 0.1, 31);
  return {"orientation_distribution",
          "Orientations.",
          {{"angle", "rad", angle, {}}, {"density", "1/rad", equal(angle, 0.25), {}}}};
}

Table energies() {
  const std::vector<double> t = grid(0, 0.5, 200);
  return {"energies",
          "Energies.",
          {{"time", "time", t, {}},
           {"rotational", "kT", each(t, [](double x) { return 0.5 + 0.01 * std::sin(x); }), {}},
           {"total", "kT", equal(t, 1.5), {}}}};
}

Table runs() {
  const std::vector<double> phi = {0.5, 0.7, 0.6, 0.5};
  return {"runs",
          "One run per row.",
          {{"packing_fraction", "1", phi, {}},
           {"particles", "1", equal(phi, 500), {}},
           {"duration", "time", equal(phi, 100), {}},
           {"compressibility_factor", "1", {4, 9, 6, 4.1}, {0.1, unknown, 0.2, 0.1}},
           {"diffusion", "length^2/time", {0.1, unknown, 0.01, 0.11}, {0.01, unknown, 0.02, 0.01}},
           {"rotational_diffusion", "rad^2/time", equal(phi, 0.25), {}}}};
}

Results results() {
  return {{{"summary",
            "Averages.",
            {{"packing_fraction", "1", {0.5}, {}}, {"compressibility_factor", "1", {4.5}, {0.1}}}},
           displacements(),
           scattering("self_scattering_all", "fs_"),
           scattering("collective_scattering", "f_"),
           {"wave_numbers",
            "Wave numbers.",
            {{"index", "1", {1, 2, 3}, {}}, {"q", "1/length", {1.5, 3.25, 6.125}, {}}}},
           susceptibility(),
           structure_factor(),
           pair_correlation(),
           orientations(),
           energies(),
           runs()},
          {{"source", "run.h5"}, {"command_line", "vitrel run\n-o run.h5"}}};
}

}  // namespace

int main(int, char** arguments) {
  write_results(arguments[1], results());
}
