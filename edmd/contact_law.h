#pragma once

#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "edmd/pairs_of_species.h"

/// @file
/// The laws by which hard particles collide (collision_rule.h), one for each pair of species.
namespace vitrel {

/// The coefficient of normal restitution e, 0 ≤ e ≤ 1, as a function of the approach speed u of the surfaces.
class NormalRestitution {
 public:
  /// The same at all speeds.
  NormalRestitution(double constant = 1) : form_(constant) {}  // NOLINT: a number is a law

  /// Viscoelastic spheres (soft/viscoelastic.h), in the limit of short contacts: e depends on c_dis ∝ u^(1/5) only. It
  /// is `value`, above 0 and below 1, at this speed; it tends to 1 as the speed vanishes. Error: 1e-9, from a table of
  /// integrated head-on impacts; e above c_dis = 1e5, where it is below 1e-4, is that of c_dis = 1e5.
  static NormalRestitution viscoelastic(double value, double speed);

  /// Linear between these speeds, which ascend, and constant outside of them.
  static NormalRestitution tabulated(std::vector<double> speeds, std::vector<double> values);

  double operator()(double speed) const;
  /// Whether it is 1 at all speeds.
  bool is_elastic() const;
  bool is_constant() const { return std::holds_alternative<double>(form_); }

 private:
  struct Viscoelastic {
    double log_damping;  ///< ln c_dis at speed 1
  };
  using Table = std::vector<std::pair<double, double>>;

  explicit NormalRestitution(std::variant<double, Viscoelastic, Table> form)
      : form_(std::move(form)) {}

  std::variant<double, Viscoelastic, Table> form_;
};

/// What a collision leaves of the relative motion of two surfaces.
struct ContactLaw {
  NormalRestitution restitution;
  /// μ, Coulomb's friction coefficient; 0: smooth.
  double friction = 0;
  /// β of a contact that does not slip, −1 (smooth) … 0 (no tangential speed is left) … 1 (reversed).
  double tangential_restitution = 0;

  static constexpr double no_slip = std::numeric_limits<double>::infinity();  ///< μ

  bool is_rough() const { return friction > 0 && tangential_restitution > -1; }
};

/// The laws of all pairs of species.
class ContactLaws : public PairsOfSpecies<ContactLaw> {
 public:
  using PairsOfSpecies::PairsOfSpecies;
  ContactLaws(double restitution)  // NOLINT: a number is a law
      : PairsOfSpecies(ContactLaw{restitution}) {}

  /// Whether any contact changes rotations that smooth ones do not.
  bool are_rough() const;
  /// Whether e < 1 for any pair and speed.
  bool are_inelastic() const;
};

}  // namespace vitrel
