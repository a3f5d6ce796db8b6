#include "edmd/contact_law.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "edmd/soft/chebyshev_panels.h"
#include "edmd/soft/restitution.h"
#include "edmd/soft/viscoelastic.h"

namespace vitrel {

namespace {

constexpr double min_damping = 1e-12, max_damping = 1e5;

/// Returns e of viscoelastic spheres as a function of ln c_dis.
double viscoelastic_restitution(double log_damping) {
  using Panels = ChebyshevPanels<1, 8, 1>;
  static const Box<1> domain{{logarithm(min_damping)}, {logarithm(max_damping)}};
  static const Panels panels(
      domain,
      [](const Panels::Point& at) {
        constexpr double any_distance = 1e6;  // l in units of X (soft/restitution.h)
        return Panels::Value{
            -integrate_contact<Viscoelastic>({any_distance, 0, exponential(at[0])}).rate};
      },
      {.tolerance = 1e-10}, 1);
  return (*panels({std::clamp(log_damping, domain.low[0], domain.high[0])}))[0];
}

/// Returns the ln c_dis at which e has this value; e falls with the damping.
double log_damping_of(double value) {
  double low = logarithm(min_damping), high = logarithm(max_damping);
  while (high - low > 1e-14 * std::abs(low)) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    (viscoelastic_restitution(middle) > value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double interpolated(const std::vector<std::pair<double, double>>& table, double speed) {
  const auto above = std::ranges::upper_bound(table, speed, {}, &std::pair<double, double>::first);
  if (above == table.begin()) return above->second;
  const auto& [u0, e0] = *std::prev(above);
  if (above == table.end()) return e0;
  return e0 + (above->second - e0) * (speed - u0) / (above->first - u0);
}

}  // namespace

NormalRestitution NormalRestitution::viscoelastic(double value, double speed) {
  return NormalRestitution(Viscoelastic{log_damping_of(value) - 0.2 * logarithm(speed)});
}

NormalRestitution NormalRestitution::tabulated(std::vector<double> speeds,
                                               std::vector<double> values) {
  Table table;
  for (std::size_t k = 0; k < speeds.size(); ++k) table.emplace_back(speeds[k], values[k]);
  return NormalRestitution(std::move(table));
}

double NormalRestitution::operator()(double speed) const {
  if (const double* constant = std::get_if<double>(&form_)) return *constant;
  if (const Table* table = std::get_if<Table>(&form_)) return interpolated(*table, speed);
  return viscoelastic_restitution(std::get<Viscoelastic>(form_).log_damping +
                                  0.2 * logarithm(std::max(speed, 1e-300)));
}

bool NormalRestitution::is_elastic() const {
  if (const double* constant = std::get_if<double>(&form_)) return *constant == 1;
  const Table* table = std::get_if<Table>(&form_);
  return table && std::ranges::all_of(*table, [](const auto& point) { return point.second == 1; });
}

bool ContactLaws::are_rough() const {
  return std::ranges::any_of(values(), &ContactLaw::is_rough);
}

bool ContactLaws::are_inelastic() const {
  return std::ranges::any_of(values(),
                             [](const ContactLaw& law) { return !law.restitution.is_elastic(); });
}

}  // namespace vitrel
