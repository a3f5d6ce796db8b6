#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace vitrel {

/// A relaxation time, or the inverse of a diffusion coefficient, at one packing fraction.
struct GlassPoint {
  double packing_fraction;
  double time;
  double error;  ///< standard error
};

/// How times grow towards a density φ_c at which they would be infinite.
enum class GlassLaw {
  mode_coupling,  ///< τ = A (φ_c − φ)^−s: the power law of mode-coupling theory (gotze1992)
  vogel_fulcher,  ///< τ = A exp(s φ/(φ_c − φ))
};

/// The law fitted to all densities of a window.
struct GlassWindow {
  double lowest = 0, highest = 0;  ///< packing fractions
  std::size_t densities = 0;
  double density;              ///< φ_c; NaN if the best one is at the upper end of its range
  double low, high;            ///< where χ² is 1 above its minimum (68 %); NaN on an open side
  double strength;             ///< s
  double log_prefactor;        ///< ln A
  Eigen::Matrix3d covariance;  ///< of ln A, s and φ_c, from the curvature of χ²
  double chi_square;
  std::size_t degrees;  ///< of freedom: densities − 3
  double goodness;      ///< probability of a larger χ² by chance
  double weight;        ///< of the window in the result; all weights add up to 1
};

enum class GlassVerdict {
  found,        ///< φ_c with an error
  lower_bound,  ///< φ_c is above `least`, and may be anywhere beyond
  refused,      ///< the data do not support the law
};

struct GlassFit {
  GlassVerdict verdict;
  std::string reason;  ///< if not found: why
  double density;      ///< φ_c: the median over the windows
  double low, high;    ///< between which φ_c is with a probability of 68.3 %
  double error;        ///< half of that
  double statistical;  ///< of which from the errors of the times: that of `window`
  double spread;       ///< and from the choice of the window, so that the squares add up
  double least;        ///< φ_c is above it with a probability of 95 %
  double strength;     ///< s: likewise the median
  double strength_error;
  double scatter;  ///< factor by which times at equal density scatter more than their errors, or 1
  GlassWindow window;                ///< that of the greatest weight
  std::vector<GlassWindow> windows;  ///< all of them: the profile
};

/// Fits a law to relaxation times over the packing fraction.
///
/// 1. Times at densities closer than 1e-4 (seeds) become one: the mean of ln τ with weights 1/σ²,
///    σ = error/τ. If they scatter more than their errors say, χ² per degree of freedom being S² > 1
///    over all densities, all errors are multiplied by S.
/// 2. In a window of at least five neighbouring densities, ln τ is fitted by nonlinear least squares.
///    For every φ_c the law is linear in ln A and s ≥ 0, so χ²(φ_c) is known exactly (profile
///    likelihood). It is followed from 1e-5 above the highest density up to 1: the highest of
///    the window for the power law, which real systems cross by other ways of relaxing; the highest of
///    all for Vogel and Fulcher's, as what relaxes is not beyond a divergence. Where it rises by 1 are
///    the ends of the interval of φ_c. A side where it does not rise by 1 is open.
/// 3. This is done for all windows, as nobody knows where the law begins and ends. Each has the weight
///    w ∝ exp(−χ²/2 − densities left out): Akaike's, which makes leaving out a density as dear as a
///    parameter of its own (jay2021).
/// 4. Each window says where φ_c is: on both sides of its best value by a normal distribution as wide as
///    its interval is there; beyond the range of φ_c, with half of its weight, on an open side. The sum
///    of these distributions gives the median, the interval and the bound. s is treated alike, with the
///    errors of the covariance.
///
/// Found if the interval is bounded on both sides: if windows open above weigh too much, there is only a
/// lower bound. Refused with a reason:
/// - fewer than five densities, times that do not grow, or that grow by less than a factor of ten: what
///   has hardly begun to rise says nothing about a divergence, however well a law fits;
/// - a χ² of the window of greatest weight that chance exceeds in less than 5 % of the cases;
/// - φ_c not distinct from the highest density, which is in the interval or, if that is open above, not below
///   the bound;
/// - a density outside of that window that contradicts its law: beyond φ_c, or more than three standard
///   errors, those of the time and of the extrapolation together, from the law.
///
/// The error covers departures from the law as far as the windows show them; φ_c remains an extrapolation:
/// compare the laws. Throws UserError for a point without a positive time and a positive error, or with a
/// packing fraction outside (0, 1).
GlassFit fit_glass_law(const std::vector<GlassPoint>& points, GlassLaw law);

/// ln τ by the law.
double glass_law(GlassLaw law, double log_prefactor, double strength, double density,
                 double packing_fraction);

/// The fewest densities of a window.
inline constexpr std::size_t min_densities = 5;
/// The least factor by which times must grow.
inline constexpr double min_growth = 10;

}  // namespace vitrel
