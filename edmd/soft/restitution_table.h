#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "core/elementary.h"
#include "edmd/soft/chebyshev_panels.h"
#include "edmd/soft/restitution.h"

/// @file
/// The restitution matrix from a table, in a small fraction of the time of an integration.
///
/// The variables are those of the source, in which the impacts of all materials, radii and speeds of given ranges fill
/// a rectangle. Instead of ln c_dis the table uses the part of it that does not depend on the impact:
///
///     g = ln(c_φ/l) = ln(tangential speed/normal speed)     (source: ln c_φ/c_φ^min + g^min)
///     m = ln l − p ln(1 + (c_φ/l)²) = ln(l/X) at full speed    (source: ln l/l^min + m^min)
///     d = ln c_dis + q ln l                                      (of the pair alone)
///
/// with p and q of the force (contact_force.h): 1/2 and 0 for the dashpot, 2/5 and 1/4 for viscoelastic spheres. Since
/// d is given for each pair of species, particles of a few species need only two dimensions for each pair. Elastic
/// particles of any radii also need two, with d = −∞. Damped particles with radii from a range need three, and the
/// range of d is narrow.
///
/// The table contains ln(−ε_ṙ), ln ε_t and ln(ε_φ l²/c_φ) as polynomials (chebyshev_panels.h, with 8 nodes in two
/// dimensions and 6 in three); E(l (1 − ε_r)) = −c_dis ε_ṙ then gives ε_r. Elastic contacts have ε_r = 1 and ε_ṙ = −1.
/// The tolerance is the relative error of ε_ṙ and ε_t; the error of ε_φ and of 1 − ε_r is at most twice as large.
/// Measured errors are in docs/validation.md. Source: mueller2013.
namespace vitrel {

struct ValueRange {
  double low, high;

  bool operator==(const ValueRange&) const = default;
};

/// The ranges of g, m and d. If `d.low == d.high`, the table holds only this value of d; see `elastic_damping`.
struct RestitutionDomain {
  ValueRange g, m, d;

  bool operator==(const RestitutionDomain&) const = default;
};

/// The range of d for elastic contacts.
inline constexpr ValueRange elastic_damping{-std::numeric_limits<double>::infinity(),
                                            -std::numeric_limits<double>::infinity()};

/// The usual range of eccentricities, as g = ln(e/√(1 − e²)). Of the collisions of a gas, a fraction of 10⁻⁴ in three
/// dimensions, and 10⁻³ in two, lies outside.
inline constexpr ValueRange typical_obliqueness{-6.9, 4.6};

/// Returns the domain of the collisions of these pairs at relative speeds from `slowest` to `fastest` > 0, in m/s. For
/// polydisperse radii pass the pairs of a grid of radii, since m and d need not be extremal at the ends.
template <ContactForce Force>
RestitutionDomain restitution_domain(const Force& force, std::span<const ContactPair> pairs,
                                     double slowest, double fastest);

class RestitutionTable {
 public:
  /// Integrates the contacts in parallel. All ranges except that of d must be finite and not empty.
  RestitutionTable(const ForceForm& form, const RestitutionDomain& domain,
                   const PanelOptions& options, int threads);

  /// Returns no value outside the domain, or where the tolerance is not met.
  std::optional<Restitution> operator()(const ScaledImpact& impact) const;

  std::size_t panels() const;
  std::size_t bytes() const;

  /// Throws FileError.
  void save(const std::filesystem::path& file) const;
  /// Returns no table if the file is missing, damaged, or of another table or program version.
  static std::optional<RestitutionTable> load(const std::filesystem::path& file,
                                              const ForceForm& form,
                                              const RestitutionDomain& domain,
                                              const PanelOptions& options);

 private:
  using Slice = ChebyshevPanels<2, 8, 3>;
  using Range = ChebyshevPanels<3, 6, 3>;
  using Panels = std::variant<Slice, Range>;

  RestitutionTable(const ForceForm& form, const RestitutionDomain& domain,
                   const PanelOptions& options, Panels panels);

  ForceForm form_;
  RestitutionDomain domain_;
  PanelOptions options_;
  Panels panels_;
};

/// The result of `load_or_build_table`, which loads the table from the file if that exists, and otherwise builds and
/// saves it. If saving fails, the table is still valid, and `save_error` says why.
struct CachedTable {
  RestitutionTable table;
  bool loaded;
  std::string save_error;
};
CachedTable load_or_build_table(const std::filesystem::path& file, const ForceForm& form,
                                const RestitutionDomain& domain, const PanelOptions& options,
                                int threads);

/// Integrates every contact: the slow reference for TabulatedRestitution.
class IntegratedRestitution {
 public:
  explicit IntegratedRestitution(const ForceForm& form) : form_(form) {}

  Restitution operator()(const ScaledImpact& impact) {
    ++integrated_;
    return form_.integrate(impact);
  }
  std::uint64_t integrated() const { return integrated_; }

 private:
  ForceForm form_;
  std::uint64_t integrated_ = 0;
};

/// Uses the table where it has a value; otherwise integrates and counts.
class TabulatedRestitution {
 public:
  TabulatedRestitution(const ForceForm& form, RestitutionTable table)
      : table_(std::move(table)), fallback_(form) {}

  Restitution operator()(const ScaledImpact& impact) {
    const std::optional<Restitution> found = table_(impact);
    return found ? *found : fallback_(impact);
  }
  std::uint64_t integrated() const { return fallback_.integrated(); }

 private:
  RestitutionTable table_;
  IntegratedRestitution fallback_;
};

template <ContactForce Force>
RestitutionDomain restitution_domain(const Force& force, std::span<const ContactPair> pairs,
                                     double slowest, double fastest) {
  constexpr double none = std::numeric_limits<double>::infinity();
  RestitutionDomain domain{typical_obliqueness, {none, -none}, {none, -none}};
  const auto extend = [](ValueRange& interval, double value) {
    interval = {std::min(interval.low, value), std::max(interval.high, value)};
  };
  for (const ContactPair& pair : pairs) {
    for (const double speed : {slowest, fastest})
      extend(domain.m, logarithm(pair.distance / force.scales(speed, pair).length));
    const ScaledImpact impact = scaled_impact(force, pair, fastest, 0);
    extend(domain.d,
           logarithm(impact.damping) + Force::damping_exponent * logarithm(impact.distance));
  }
  return domain;
}

}  // namespace vitrel
