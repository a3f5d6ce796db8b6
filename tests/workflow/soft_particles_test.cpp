// From the parameter file's SI units to contacts in the units of a run.

#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>

#include "core/io/checked.h"
#include "edmd/soft/restitution.h"
#include "tests/app/end_to_end.h"
#include "workflow/configuration/soft_particles.h"

namespace vitrel {
namespace {

/// Spheres whose radii are in units of the first.
Configuration3 spheres(const std::vector<double>& radii) {
  Configuration3 c;
  c.resize(radii.size());
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.shape[i] = {Vec3::Constant(radii[i])};
    c.mass[i] = std::pow(radii[i], 3);
  }
  return c;
}

ContactParameters figure_6() {
  ContactParameters p;
  p.law = ContactParameters::Law::linear_dashpot;
  p.linear_dashpot = {2000, 3};
  p.viscoelastic = {1e7, 0.3, 1e-3};
  p.thermal_speed = 5;
  return p;
}

Parameters with_contact(const ContactParameters& contact, std::vector<std::string> species = {}) {
  Parameters p;
  p.dynamics.contact = contact;
  p.species.clear();
  for (std::string& name : species) {
    p.species.emplace_back();
    p.species.back().name = std::move(name);
  }
  return p;
}

template <ContactForce Force>
void expect_contact_in_si(const Force& force, const ContactParameters& p, SoftContact& contact,
                          double radius2, double tolerance) {
  const UnitsOfRun unit = units_of_run(p);
  const double mass2 = unit.mass * std::pow(radius2, 3);
  const ContactPair in_si = contact_pair(unit.length, unit.mass, radius2 * unit.length, mass2);
  const ContactPair in_run = contact_pair(1, 1, radius2, std::pow(radius2, 3));
  for (const double speed : {0.01, 1., 4.})
    for (const double across : {0.2, 3.}) {
      RunCounters counters;
      const Restitution found = contact.collide(in_run, speed, across, counters);
      const double to_si = unit.length / unit.time;
      const Restitution wanted =
          integrate_contact<Force>(scaled_impact(force, in_si, speed * to_si, across * to_si));
      const double duration = wanted.duration * force.scales(speed * to_si, in_si).time / unit.time;
      EXPECT_NEAR(found.distance, wanted.distance, tolerance);
      EXPECT_NEAR(found.angle / wanted.angle, 1, tolerance);
      EXPECT_NEAR(found.duration / duration, 1, tolerance);
      EXPECT_NEAR(found.rate, wanted.rate, tolerance);
    }
}

/// Tables go to a folder of the test's own.
class SoftParticles : public testing::Test {
 protected:
  SoftParticles() { checked(setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1), "setenv"); }

  /// The contact of spheres of these radii.
  std::shared_ptr<SoftContact> one_contact(const ContactParameters& contact,
                                           const std::vector<double>& radii) const {
    return soft_contact(with_contact(contact), spheres(radii), 2, say_).common();
  }

  const Folder folder_{"soft_particles"};
  std::vector<std::string> said_;
  const std::function<void(const std::string&)> say_ = [this](const std::string& line) {
    said_.push_back(line);
  };
};

// Figure 6 of mueller2013: 0.1 m, 1140 kg/m³, 5 m/s.
TEST_F(SoftParticles, TheUnitsAreThoseOfTheReferenceParticle) {
  const UnitsOfRun unit = units_of_run(figure_6());
  EXPECT_DOUBLE_EQ(unit.length, 0.1);
  EXPECT_DOUBLE_EQ(unit.time, 0.02);
  EXPECT_NEAR(unit.mass, 1140 * 4 * std::numbers::pi / 3 * 1e-3, 1e-14);
}

constexpr std::pair<ContactParameters::Coefficients, double> coefficients_with_tolerance[] = {
    {ContactParameters::Coefficients::integrated, 1e-11},
    {ContactParameters::Coefficients::tabulated, 3e-8}};

TEST_F(SoftParticles, ContactsAreThoseOfTheMaterialInSiUnits) {
  ContactParameters p = figure_6();
  for (const auto& [coefficients, tolerance] : coefficients_with_tolerance) {
    p.coefficients = coefficients;
    p.law = ContactParameters::Law::linear_dashpot;
    expect_contact_in_si(p.linear_dashpot, p, *one_contact(p, {1, 1}), 1, tolerance);
    p.law = ContactParameters::Law::viscoelastic;
    expect_contact_in_si(p.viscoelastic, p, *one_contact(p, {1, 1}), 1, tolerance);
  }
  // Unlike radii damp differently: one variable more.
  const auto contact = one_contact(p, {1, 0.9});
  for (const double radius : {1., 0.9})
    expect_contact_in_si(p.viscoelastic, p, *contact, radius, 3e-6);
}

TEST_F(SoftParticles, TheTableIsMadeOnceAndUsedWherePossible) {
  const ContactParameters p = figure_6();
  RunCounters counters;
  const ContactPair pair = contact_pair(1, 1, 1, 1);
  for (int k = 0; k < 2; ++k) {
    const auto contact = one_contact(p, {1, 1});
    contact->collide(pair, 1, 1, counters);
    EXPECT_EQ(counters.integrations, 0u);
  }
  EXPECT_EQ(said_.size(), 1u);
  const auto contact = one_contact(p, {1, 1});
  contact->collide(pair, 1e-7, 1e-7, counters);
  contact->collide(contact_pair(1, 1, 2, 8), 1, 1, counters);
  EXPECT_EQ(counters.integrations, 2u);
}

MaterialParameters steel() {
  MaterialParameters m;
  m.species = "steel";
  m.youngs_modulus = 2e11;
  m.poissons_ratio = 0.3;
  m.dissipative_time = 1e-6;
  return m;
}

// Hertz's law of two different bodies: F = 4/3 E √R_eff ξ^(3/2).
TEST_F(SoftParticles, MaterialsMixAsTheirEffectiveModulus) {
  ContactParameters p = figure_6();
  p.law = ContactParameters::Law::viscoelastic;
  p.viscoelastic = {1e7, 0.5, 1e-3};
  p.materials = {steel()};
  const double rubber = 1e7 / (1 - 0.5 * 0.5), other = 2e11 / (1 - 0.3 * 0.3);
  const double effective = 1 / (1 / rubber + 1 / other);
  const double time = effective * (1e-3 / rubber + 1e-6 / other);
  Configuration3 both = spheres({1, 1});
  both.species = {0, 1};
  for (const auto& [coefficients, tolerance] : coefficients_with_tolerance) {
    p.coefficients = coefficients;
    const auto contacts = soft_contact(with_contact(p, {"rubber", "steel"}), both, 2, say_);
    expect_contact_in_si(p.viscoelastic, p, *contacts.of(0, 0), 1, tolerance);
    expect_contact_in_si(Viscoelastic{2e11, 0.3, 1e-6}, p, *contacts.of(1, 1), 1, tolerance);
    EXPECT_EQ(contacts.of(0, 1), contacts.of(1, 0));
    const Viscoelastic mixture{effective * 2 * (1 - 0.3 * 0.3), 0.3, time};
    expect_contact_in_si(mixture, p, *contacts.of(0, 1), 1, tolerance);
  }
}

// Two springs with dashpots in series, slowly compressed by ξ at the rate ξ̇: to first order in the damping both carry the
// force k ξ + γ ξ̇.
TEST_F(SoftParticles, DashpotsMixInSeries) {
  const LinearDashpot one{2000, 3}, other{500, 0.2};
  const LinearDashpot mixture = mixed(one, other);
  const double tiny = 1e-6;
  const double rate = tiny, compression = 1;
  // One body is half of a contact of two equal ones: twice as stiff.
  const double share = other.stiffness / (one.stiffness + other.stiffness);
  const auto force = [&](const LinearDashpot& body, double part, double part_rate) {
    return 2 * (body.stiffness * part + body.damping * part_rate);
  };
  // The parts of the compression that balance the forces.
  const double imbalance =
      force(one, share, share * rate) - force(other, 1 - share, (1 - share) * rate);
  const double shift = -imbalance / (2 * (one.stiffness + other.stiffness));
  EXPECT_NEAR(force(one, share + shift, share * rate),
              mixture.force(compression, rate, contact_pair(1, 1, 1, 1)), 1e-15 * 2000);
  const LinearDashpot same = mixed(one, one);
  EXPECT_DOUBLE_EQ(same.stiffness, one.stiffness);
  EXPECT_DOUBLE_EQ(same.damping, one.damping);
}

TEST_F(SoftParticles, ASpeciesWithoutParticlesDoesNoHarm) {
  ContactParameters p = figure_6();
  p.law = ContactParameters::Law::viscoelastic;
  p.materials = {steel()};
  const auto contacts =
      soft_contact(with_contact(p, {"rubber", "steel"}), spheres({1, 1}), 2, say_);
  expect_contact_in_si(p.viscoelastic, p, *contacts.of(0, 0), 1, 3e-8);
}

TEST_F(SoftParticles, WithoutAFolderTheTableIsNotKept) {
  checked(setenv("XDG_CACHE_HOME", "/dev/null", 1), "setenv");
  const auto contact = one_contact(figure_6(), {1, 1});
  ASSERT_EQ(said_.size(), 2u);
  EXPECT_THAT(said_[1], HasSubstr("the table is not kept"));
}

}  // namespace
}  // namespace vitrel
