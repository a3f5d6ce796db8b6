#include "mc/contact_pressure.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/contact/perram_wertheim.h"
#include "mc/disjoint.h"

namespace vitrel {

void ContactPressure::add(const Configuration2& configuration) {
  const CellGrid cells = make_cells(configuration);
  const double largest = largest_circumradius(configuration);
  particles_ += static_cast<double>(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double reach = configuration.shape[i].circumradius() + largest;
    for_each_candidate(configuration, cells, i, configuration.position[i], largest,
                       reach * widest_ / (1 - widest_),
                       [&](std::size_t j, const Shift<2>&, const Vec2& d) {
                         if (j < i) return;
                         const PerramWertheim touch =
                             perram_wertheim(configuration.shape[i], configuration.angle[i],
                                             configuration.shape[j], configuration.angle[j], d);
                         const double epsilon = 1 - 1 / std::sqrt(touch.value);
                         const int bin = static_cast<int>(epsilon / widest_ * bins);
                         // Own images are met twice, as (i, i, ±shift).
                         if (bin >= 0 && bin < bins) pairs_[bin] += i == j ? 0.5 : 1;
                       });
  }
}

double ContactPressure::compressibility() const {
  Eigen::Matrix<double, bins, 3> powers;
  Eigen::Matrix<double, bins, 1> density;
  for (int k = 0; k < bins; ++k) {
    const double x = (k + 0.5) / bins;
    powers.row(k) << 1, x, x * x;
    density[k] = pairs_[k] * bins / widest_ / particles_;
  }
  const Eigen::Vector3d parabola = powers.colPivHouseholderQr().solve(density);
  return 1 + 0.5 * parabola[0];
}

}  // namespace vitrel
