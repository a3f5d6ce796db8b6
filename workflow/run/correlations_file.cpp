#include "workflow/run/correlations_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/dynamics/displacement.h"
#include "analysis/dynamics/relaxation.h"
#include "core/error.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

const std::string prefix = "correlations_";

MultipleTauOptions correlator_options(const Parameters& parameters) {
  const CorrelationParameters& p = *parameters.output.correlations;
  return {p.interval, longest_lag(parameters), p.wave_numbers};
}

Table correlation_table(CorrelatedGroup group) {
  return {
      prefix + identifier(group.name),
      fmt::format("Correlations of {} particles ({}) against the time difference, measured "
                  "while the run went on: mean squared displacement and rotation, self "
                  "scattering F_s(q_k, t), orientation L_n(t) = <cos n(theta(t) - theta(0))>, in "
                  "three dimensions Legendre's P_n of the axis; "
                  "origins of time are thinned for long times.",
                  group.particles, group.name),
      std::move(group.columns)};
}

Table wave_number_table(const std::vector<double>& wave_numbers) {
  return {"wave_numbers",
          "Wave numbers q_k of the self scattering functions fs_k.",
          {index_column(wave_numbers.size()), {"q", "1/length", wave_numbers}}};
}

double relaxation_of(const CorrelatedGroup& group, const std::string& column) {
  const auto find = [&](const std::string& name) {
    return std::ranges::find(group.columns, name, &Column::name);
  };
  const auto values = find(column), time = find("time");
  if (values == group.columns.end() || time->value.empty()) return unknown;
  return relaxation_time({time->value, values->value, values->error}).value;
}

}  // namespace

fs::path correlations_path(const fs::path& run) {
  return run.string() + ".correlations.h5";
}

template <int Dim>
std::optional<MultipleTau<Dim>> correlator(const Parameters& parameters,
                                           const Configuration<Dim>& configuration) {
  if (!parameters.output.correlations) return std::nullopt;
  MultipleTauOptions options = correlator_options(parameters);
  options.wave_numbers = wave_numbers_or_main(std::move(options.wave_numbers), configuration);
  return MultipleTau<Dim>(configuration, std::move(options));
}

double correlator_bytes(const Parameters& parameters) {
  const auto bytes = parameters.system.dimension == 2 ? MultipleTau<2>::sample_bytes
                                                      : MultipleTau<3>::sample_bytes;
  return bytes(static_cast<std::size_t>(parameters.system.particles),
               correlator_options(parameters));
}

void write_correlations(const fs::path& run, const Parameters& parameters,
                        std::vector<CorrelatedGroup> groups,
                        const std::vector<double>& wave_numbers) {
  Results results;
  for (CorrelatedGroup& group : groups)
    results.tables.push_back(correlation_table(std::move(group)));
  results.tables.push_back(wave_number_table(wave_numbers));
  results.provenance.emplace_back("parameters", effective_parameters(parameters));
  write_results(correlations_path(run), results);
}

template std::optional<MultipleTau<2>> correlator(const Parameters&, const Configuration2&);
template std::optional<MultipleTau<3>> correlator(const Parameters&, const Configuration3&);

void forget_correlations(const fs::path& run) {
  std::error_code error;
  fs::remove(correlations_path(run), error);
  if (error)
    throw FileError(
        fmt::format("{}: cannot be removed: {}", correlations_path(run).string(), error.message()));
}

std::vector<Table> on_the_fly_tables(const fs::path& run) {
  if (!fs::exists(correlations_path(run))) return {};
  Results results = read_results(correlations_path(run));
  for (Table& table : results.tables) {
    if (table.name.starts_with(prefix)) table.name.erase(0, prefix.size());
    table.name = "on_the_fly_" + table.name;
  }
  return std::move(results.tables);
}

bool is_time_to_look(double time, double interval, double at_most) {
  constexpr double rounding = 1e-9;
  double latest = at_most;
  while (latest > time * (1 + rounding)) latest *= 0.5;
  return latest > (time - interval) * (1 + rounding);
}

double known_relaxation(const CorrelatedGroup& all, int dimension) {
  const double translation = relaxation_of(all, "fs_1");
  if (all.rotors == 0) return translation;
  const double rotation = relaxation_of(all, dimension == 2 ? "l_2" : "p_2");
  return std::isnan(translation) ? translation : std::max(rotation, translation);
}

}  // namespace vitrel
