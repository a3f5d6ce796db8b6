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
  double lowest = 0, highest = 0;        ///< packing fractions
  std::size_t begin = 0, densities = 0;  ///< which of all densities, and how many
  double density;              ///< φ_c; NaN if the best one is at the upper end of its range
  double low, high;            ///< where χ² is 1 above its minimum (68 %); NaN on an open side
  double least;                ///< φ_c is above it with a probability of 95 %; NaN if open below
  double strength;             ///< s
  double strength_most;        ///< s is below it likewise; infinite if φ_c is open above
  double log_prefactor;        ///< ln A
  Eigen::Matrix3d covariance;  ///< of ln A, s and φ_c, from the curvature of χ²
  double chi_square;
  std::size_t degrees;  ///< of freedom: densities − 3
  double goodness;      ///< probability of a larger χ² by chance

  double error() const { return (high - low) / 2; }  ///< of φ_c
  double strength_error() const;                     ///< by the covariance
};

enum class GlassVerdict {
  found,        ///< the law holds, and φ_c has an error
  lower_bound,  ///< if the law holds, φ_c is above `window.least`, and may be anywhere beyond
  refused,      ///< the data do not support the law
};

struct GlassFit {
  GlassVerdict verdict;
  std::string reason;  ///< if not found: why
  double scatter;  ///< factor by which times at equal density scatter more than their errors, or 1
  GlassWindow window = {};                ///< the largest one in which the law fits
  std::vector<GlassWindow> windows = {};  ///< all of them: the profile
};

/// Fits a law to relaxation times over the packing fraction, and names it only if the data single it out.
///
/// 1. Times at densities closer than 1e-4 (seeds) become one: the mean of ln τ with weights 1/σ²,
///    σ = error/τ. If they scatter more than their errors say, χ² per degree of freedom being S² > 1
///    over all densities, all errors are multiplied by S.
/// 2. In a window of at least five neighbouring densities, ln τ is fitted by nonlinear least squares.
///    For every φ_c the law is linear in ln A and s ≥ 0, so χ²(φ_c) is known exactly (profile
///    likelihood). It is followed from 1e-5 above the highest density up to 1: the highest of
///    the window for the power law, which real systems cross by other ways of relaxing; the highest of
///    all for Vogel and Fulcher's, as what relaxes is not beyond a divergence. Where it rises by 1 are
///    the ends of the interval of φ_c, and where it rises by 1.645² the limits of 95 % of φ_c and of s. A side
///    where it does not rise that far is open.
/// 3. The law fits a window if chance exceeds its χ² in 5 % of the cases or more. The window of the result is
///    the largest that it fits; of equally large ones that with the least χ².
///
/// Found if all of these rules hold; the first that does not is the reason:
/// - There are at least five densities, the times grow, and they grow by a factor of ten or more, over all
///   densities and within the window: what has hardly begun to rise says nothing about a divergence, however
///   well a law fits.
/// - The law fits some window.
/// - The exponent of the power law may be one of mode-coupling theory: its limit of 95 % is not below 1.765.
///   γ = 1/(2a) + 1/(2b) with Γ(1 − a)²/Γ(1 − 2a) = Γ(1 + b)²/Γ(1 + 2b) (gotze1992), so that a ≤ 0.395 and b ≤ 1;
///   at a = 0.395, b = 1 it is 1.765, and it grows as both become smaller.
/// - φ_c is above the highest density of all, with a probability of 95 %.
/// - What was left out is predicted: no density outside of the window is beyond φ_c, or more than three
///   standard errors, those of the time and of the extrapolation together, from the law.
/// - φ_c does not follow the end of the window. Without its last n densities, one to three, χ² is smaller by as
///   much as a χ² of n degrees of freedom if the law holds; chance must exceed that difference in 5 % of the
///   cases or more. If φ_c moves by z errors of the shorter window, the difference is z² at least.
/// - The other law fits the window worse: its χ² is larger by 4 or more. Both laws have three parameters. If
///   the other one is true and D is what this one adds to χ² without noise, the difference is normal about −D
///   with a standard deviation of 2√D; it exceeds 4 with a probability of at most 2.3 %, at D = 4.
/// - It survives the errors of the times: drawn anew within them forty times, by a fixed stream, they support
///   the law in the same window in at least half of the cases. These times are twice as noisy as the measured
///   ones, once by nature and once by the draw, so their errors are larger by √2.
///
/// If φ_c has no upper limit of 95 %, the last three do not apply: there is only a lower bound, of a law that
/// is not named. Of made-up power laws over three decades (γ = 2.4, errors of 5 %, nine densities) more than
/// nine in ten are found, and of other laws of that growth less than one in twenty is taken for one
/// (tests/analysis/glass_fit_test.cpp). Departures of the size of the errors cannot be seen. That no law holds
/// is expected of a liquid that crosses over from one way of relaxing to another.
///
/// φ_c remains an extrapolation. Throws UserError for a point without a positive time and a positive error, or
/// with a packing fraction outside (0, 1).
GlassFit fit_glass_law(const std::vector<GlassPoint>& points, GlassLaw law);

/// ln τ by the law.
double glass_law(GlassLaw law, double log_prefactor, double strength, double density,
                 double packing_fraction);

/// The fewest densities of a window.
inline constexpr std::size_t min_densities = 5;
/// The least factor by which times must grow, over all densities and within the window.
inline constexpr double min_growth = 10;
/// The least exponent of the power law that mode-coupling theory allows.
inline constexpr double min_exponent = 1.765;

}  // namespace vitrel
