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
  /// A coefficient that is the same at all speeds.
  NormalRestitution(double constant = 1) : form_(constant) {}  // NOLINT: a number is a law

  /// The coefficient of viscoelastic spheres (soft/viscoelastic.h) in the limit of short contacts, where e depends on
  /// c_dis ∝ u^(1/5) only. It equals `value`, above 0 and below 1, at `speed`, and tends to 1 as the speed vanishes.
  /// The error is 1e-9, since e comes from a table of integrated head-on impacts. Above c_dis = 1e5, where e is below
  /// 1e-4, the table uses its value at c_dis = 1e5.
  static NormalRestitution viscoelastic(double value, double speed);

  /// A coefficient that is linear between these ascending speeds, and constant outside of them.
  static NormalRestitution tabulated(std::vector<double> speeds, std::vector<double> values);

  double operator()(double speed) const;
  /// Returns whether e is 1 at all speeds.
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

/// The law that determines the relative motion of two surfaces after a collision.
struct ContactLaw {
  NormalRestitution restitution;
  /// Coulomb's friction coefficient μ; 0 means smooth.
  double friction = 0;
  /// β of a contact that does not slip: −1 (smooth) … 0 (no tangential speed is left) … 1 (tangential speed reversed).
  double tangential_restitution = 0;

  static constexpr double no_slip = std::numeric_limits<double>::infinity();  ///< μ without slip

  bool is_rough() const { return friction > 0 && tangential_restitution > -1; }
};

/// The laws of all pairs of species.
class ContactLaws : public PairsOfSpecies<ContactLaw> {
 public:
  using PairsOfSpecies::PairsOfSpecies;
  ContactLaws(double restitution)  // NOLINT: a number is a law
      : PairsOfSpecies(ContactLaw{restitution}) {}

  /// Returns whether any contact changes rotations that smooth contacts do not change.
  bool are_rough() const;
  /// Returns whether e < 1 for any pair and speed.
  bool are_inelastic() const;
};

}  // namespace vitrel
