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

/// Laws by which times grow towards a density φ_c at which they would be infinite.
enum class GlassLaw {
  mode_coupling,  ///< τ = A (φ_c − φ)^−s: the power law of mode-coupling theory (gotze1992)
  vogel_fulcher,  ///< τ = A exp(s φ/(φ_c − φ))
};

/// The law fitted to all densities of a window.
struct GlassWindow {
  double lowest = 0, highest = 0;        ///< range of packing fractions
  std::size_t begin = 0, densities = 0;  ///< first of all densities, and number of densities
  double density;        ///< φ_c; NaN if the best one is at the upper end of its range
  double low, high;      ///< where χ² is 1 above its minimum (68 %); NaN on an open side
  double least;          ///< lower limit of φ_c with a probability of 95 %; NaN if open below
  double strength;       ///< s
  double strength_most;  ///< upper limit of s likewise; infinite if φ_c is open above
  double log_prefactor;  ///< ln A
  Eigen::Matrix3d covariance;  ///< covariance of ln A, s and φ_c, from the curvature of χ²
  double chi_square;
  std::size_t degrees;  ///< degrees of freedom: densities − 3
  double goodness;      ///< probability of a larger χ² by chance

  double error() const { return (high - low) / 2; }  ///< error of φ_c
  double strength_error() const;                     ///< error of s by the covariance
};

enum class GlassVerdict {
  found,        ///< the law holds, and φ_c has an error
  lower_bound,  ///< if the law holds, φ_c is above `window.least`, without an upper limit
  refused,      ///< the data do not support the law
};

struct GlassFit {
  GlassVerdict verdict;
  std::string reason;  ///< why the law was not found; else empty
  double scatter;  ///< factor by which times at equal density scatter more than their errors, or 1
  GlassWindow window = {};                ///< the largest one in which the law fits
  std::vector<GlassWindow> windows = {};  ///< all windows: the profile
};

/// Fits a law to relaxation times over the packing fraction, and names it only if the data single it out.
///
/// 1. Times at densities closer than 1e-4 (seeds) are combined into one: the mean of ln τ with weights 1/σ², where
///    σ = error/τ. If they scatter more than their errors say, that is, if χ² per degree of freedom over all densities
///    is S² > 1, all errors are multiplied by S.
/// 2. In a window of at least five neighbouring densities, ln τ is fitted by nonlinear least squares. For every φ_c the
///    law is linear in ln A and s ≥ 0, so χ²(φ_c) is known exactly (profile likelihood). It is followed from 1e-5 above
///    the highest density up to 1. For the power law this is the highest density of the window, since real systems
///    cross its divergence by other ways of relaxing; for Vogel and Fulcher's law it is the highest of all, since what
///    relaxes is not beyond a divergence. The interval of φ_c ends where χ² has risen by 1, and the limits of 95 % of
///    φ_c and of s are where it has risen by 1.645². A side on which it does not rise that far is open.
/// 3. The law fits a window if chance exceeds its χ² in 5 % of the cases or more. The resulting window is the largest
///    that the law fits, and among equally large ones the one with the least χ².
///
/// The law is found if all of these rules hold; otherwise the first rule that does not hold is the reason:
/// - There are at least five densities, the times grow, and they grow by a factor of ten or more, over all densities
///   and within the window: what has hardly begun to rise says nothing about a divergence, however well a law fits.
/// - The law fits some window.
/// - The exponent of the power law may be one of mode-coupling theory: its limit of 95 % is not below 1.765.
///   γ = 1/(2a) + 1/(2b) with Γ(1 − a)²/Γ(1 − 2a) = Γ(1 + b)²/Γ(1 + 2b) (gotze1992), so that a ≤ 0.395 and b ≤ 1; at
///   a = 0.395, b = 1 it is 1.765, and it grows as both become smaller.
/// - The law predicts what was left out: no density outside of the window is beyond φ_c, or more than three standard
///   errors, those of the time and of the extrapolation together, from the law.
/// - φ_c is above the highest density of all, with a probability of 95 %.
/// - φ_c does not follow the end of the window. If the law holds, χ² without the last n densities of the window, one to
///   three, is smaller by a χ² of n degrees of freedom; chance must exceed that difference in 5 % of the cases or more.
///   If φ_c moves by z errors of the shorter window, the difference is z² at least.
/// - The other law fits the window worse: its χ² is larger by 4 or more. Both laws have three parameters. If the other
///   one is true and D is what this one adds to χ² without noise, the difference is normal about −D with a standard
///   deviation of 2√D; it exceeds 4 with a probability of at most 2.3 %, at D = 4.
/// - The law survives the errors of the times: drawn anew within them forty times, from a fixed stream, they support
///   the law in the same window in at least half of the cases. These times are twice as noisy as the measured ones,
///   once by nature and once by the draw, so their errors are larger by √2.
///
/// If φ_c has no upper limit of 95 %, the last three rules do not apply: there is only a lower bound, of a law that is
/// not named. Of made-up power laws over three decades (γ = 2.4, errors of 5 %, nine densities) more than nine in ten
/// are found, and of other laws that grow as much less than one in twenty is taken for a power law
/// (tests/analysis/glass_fit_test.cpp). Departures of the size of the errors cannot be seen. A liquid that crosses over
/// from one way of relaxing to another is expected to follow no law.
///
/// φ_c remains an extrapolation. Throws UserError for a point without a positive time and a positive error, or with a
/// packing fraction outside (0, 1).
GlassFit fit_glass_law(const std::vector<GlassPoint>& points, GlassLaw law);

/// Returns ln τ by the law.
double glass_law(GlassLaw law, double log_prefactor, double strength, double density,
                 double packing_fraction);

/// The minimum number of densities of a window.
inline constexpr std::size_t min_densities = 5;
/// The minimum factor by which times must grow, over all densities and within the window.
inline constexpr double min_growth = 10;
/// The minimum exponent of the power law that mode-coupling theory allows.
inline constexpr double min_exponent = 1.765;

}  // namespace vitrel
