#include "workflow/run/known_relaxation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/dynamics/relaxation.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

double relaxation_of(const CorrelatedGroup& group, const std::string& column) {
  const auto find = [&](const std::string& name) {
    return std::ranges::find(group.columns, name, &Column::name);
  };
  const auto values = find(column), time = find("time");
  if (values == group.columns.end() || time->value.empty()) return unknown;
  return relaxation_time({time->value, values->value, values->error}).value;
}

}  // namespace

bool is_time_to_look(double time, double interval, double at_most) {
  constexpr double rounding = 1e-9;
  double latest = at_most;
  while (latest > time * (1 + rounding)) latest *= 0.5;
  return latest > (time - interval) * (1 + rounding);
}

template <int Dim>
double known_relaxation(const MultipleTau<Dim>& correlator) {
  const CorrelatedGroup all = correlator.correlations().front();
  const double translation = relaxation_of(all, "fs_1");
  if (all.rotors == 0) return translation;
  const double rotation = relaxation_of(all, Dim == 2 ? "l_2" : "p_2");
  return std::isnan(translation) ? translation : std::max(rotation, translation);
}

template double known_relaxation(const MultipleTau<2>&);
template double known_relaxation(const MultipleTau<3>&);

}  // namespace vitrel
