#include "edmd/soft/restitution_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <vector>

#include "core/io/h5.h"
#include "core/random/stream.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/viscoelastic.h"
#include "tests/support/files.h"
#include "tests/support/soft_particles.h"

namespace vitrel {
namespace {

constexpr double tolerance = 1e-5;
constexpr PanelOptions coarse{tolerance, 0.02};

template <class Force>
class TabulatedForce : public testing::Test {};
using Forces = testing::Types<LinearDashpot, Viscoelastic>;
TYPED_TEST_SUITE(TabulatedForce, Forces);

double uniform(const ValueRange& interval, Stream& draw) {
  return draw.uniform(interval.low, interval.high);
}

template <class Force>
ScaledImpact impact_at(double g, double m, double d) {
  const double tangent = std::exp(g);
  const double distance = std::exp(m) * std::pow(1 + tangent * tangent, Force::length_exponent);
  return {distance, distance * tangent, std::exp(d) * std::pow(distance, -Force::damping_exponent)};
}

template <class Force>
ScaledImpact random_impact(const RestitutionDomain& domain, Stream& draw) {
  const double d = domain.d.low == domain.d.high ? domain.d.low : uniform(domain.d, draw);
  const double g = uniform(domain.g, draw);
  return impact_at<Force>(g, uniform(domain.m, draw), d);
}

void expect_equal(const Restitution& found, const Restitution& expected) {
  EXPECT_EQ(found.distance, expected.distance);
  EXPECT_EQ(found.angle, expected.angle);
  EXPECT_EQ(found.duration, expected.duration);
  EXPECT_EQ(found.rate, expected.rate);
}

void expect_near(const Restitution& found, const Restitution& expected, const ScaledImpact& of) {
  SCOPED_TRACE(testing::Message() << "l = " << of.distance << ", c_φ = " << of.angular_momentum
                                  << ", c_dis = " << of.damping);
  const double most = 1.5 * tolerance;
  EXPECT_NEAR(found.rate, expected.rate, most * std::abs(expected.rate));
  EXPECT_NEAR(found.duration, expected.duration, most * expected.duration);
  EXPECT_NEAR(found.angle, expected.angle, 2 * most * expected.angle);
  EXPECT_NEAR(found.distance, expected.distance, 2 * most * (1 - expected.distance) + 1e-15);
}

template <class Force>
void expect_within_tolerance(const RestitutionDomain& domain) {
  const ForceForm form = form_of<Force>();
  const RestitutionTable table(form, domain, coarse, 2);
  Stream draw(1, Purpose::tests);
  for (int k = 0; k < 1000; ++k) {
    const ScaledImpact of = random_impact<Force>(domain, draw);
    const auto found = table(of);
    ASSERT_TRUE(found);
    expect_near(*found, form.integrate(of), of);
  }
}

TYPED_TEST(TabulatedForce, ElasticTable) {
  expect_within_tolerance<TypeParam>({typical_obliqueness, {1, 8}, elastic_damping});
}

TYPED_TEST(TabulatedForce, TableOfOnePair) {
  expect_within_tolerance<TypeParam>({typical_obliqueness, {1, 8}, {-0.7, -0.7}});
}

TYPED_TEST(TabulatedForce, TableOfManyPairs) {
  expect_within_tolerance<TypeParam>({{-2, 2}, {2, 5}, {-1.5, -0.5}});
}

TYPED_TEST(TabulatedForce, IntegratesAndCountsWhatIsOutside) {
  const RestitutionDomain domain{{-1, 1}, {2, 3}, {-0.7, -0.7}};
  const ForceForm form = form_of<TypeParam>();
  TabulatedRestitution tabulated(form, RestitutionTable(form, domain, coarse, 1));
  IntegratedRestitution integrated(form);
  EXPECT_NE(tabulated(impact_at<TypeParam>(0, 2.5, -0.7)).rate,
            integrated(impact_at<TypeParam>(0, 2.5, -0.7)).rate);
  EXPECT_EQ(tabulated.integrated(), 0);
  const std::vector<ScaledImpact> outside{impact_at<TypeParam>(1.01, 2.5, -0.7),
                                          impact_at<TypeParam>(-1.01, 2.5, -0.7),
                                          impact_at<TypeParam>(0, 1.99, -0.7),
                                          impact_at<TypeParam>(0, 3.01, -0.7),
                                          impact_at<TypeParam>(0, 2.5, -0.69999),
                                          {12, 0, impact_at<TypeParam>(0, 2.5, -0.7).damping},
                                          {12, 12, 0}};
  for (const ScaledImpact& of : outside) {
    expect_equal(tabulated(of), integrated(of));
  }
  EXPECT_EQ(tabulated.integrated(), outside.size());
}

TEST(ElasticTable, LosesNothing) {
  const RestitutionTable table(form_of<LinearDashpot>(), {{-1, 1}, {2, 3}, elastic_damping}, coarse,
                               1);
  const auto found = table({15, 10, 0});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->distance, 1);
  EXPECT_EQ(found->rate, -1);
  EXPECT_FALSE(table({15, 10, 1e-3}));
}

template <class Force>
constexpr Force soft_material() {
  if constexpr (std::is_same_v<Force, LinearDashpot>)
    return {1e4, 0.3};
  else
    return {1e8, 0.3, 1e-4};
}

ContactPair pair_of(double radius1, double radius2) {
  return contact_pair(radius1, sphere_mass(radius1), radius2, sphere_mass(radius2));
}

// What the impacts of a scene need: two dimensions for one kind of pair, three for several.
TYPED_TEST(TabulatedForce, DomainOfAScene) {
  const auto force = soft_material<TypeParam>();
  const ForceForm form = form_of<TypeParam>();
  const std::vector<ContactPair> pairs{pair_of(0.01, 0.01), pair_of(0.01, 0.011),
                                       pair_of(0.011, 0.011)};
  const RestitutionDomain all = restitution_domain(force, pairs, 0.1, 3);
  EXPECT_GT(all.d.high, all.d.low);
  const RestitutionDomain one = restitution_domain(force, std::span(pairs).first(1), 0.1, 3);
  EXPECT_EQ(one.d.high, one.d.low);
  const RestitutionTable of_all(form, all, coarse, 2), of_one(form, one, coarse, 2);
  Stream draw(2, Purpose::tests);
  for (int k = 0; k < 300; ++k) {
    const double speed = draw.uniform(0.1, 3), sine = draw.uniform(0.002, 0.999);
    const ContactPair& pair = pairs[draw.below(pairs.size())];
    const ScaledImpact of =
        scaled_impact(force, pair, speed * std::sqrt(1 - sine * sine), speed * sine);
    const auto found = of_all(of);
    ASSERT_TRUE(found);
    expect_near(*found, form.integrate(of), of);
    EXPECT_EQ(of_one(of).has_value(), &pair == &pairs.front());
  }
}

class StoredTableFile : public Files {
 protected:
  CachedTable keep(const RestitutionDomain& domain = domain_, double exact = tolerance,
                   const ForceForm& form = form_of<Viscoelastic>()) const {
    return load_or_build_table(file("table.h5"), form, domain, {exact, 0.02}, 2);
  }

  static constexpr RestitutionDomain domain_{{-1, 1}, {2, 3}, {-0.7, -0.7}};
};

void expect_equal(const RestitutionTable& one, const RestitutionTable& two) {
  Stream draw(3, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    const double g = draw.uniform(-1, 1);
    const ScaledImpact of = impact_at<Viscoelastic>(g, draw.uniform(2, 3), -0.7);
    const auto first = one(of), second = two(of);
    ASSERT_TRUE(first && second);
    expect_equal(*first, *second);
  }
}

TEST_F(StoredTableFile, IsBuiltOnce) {
  const CachedTable first = keep(), second = keep();
  EXPECT_FALSE(first.loaded);
  EXPECT_EQ(first.save_error, "");
  EXPECT_TRUE(second.loaded);
  expect_equal(first.table, second.table);
  EXPECT_EQ(first.table.bytes(), second.table.bytes());
  const RestitutionTable alone(form_of<Viscoelastic>(), domain_, coarse, 1);
  expect_equal(first.table, alone);
}

TEST_F(StoredTableFile, ARangeIsKeptToo) {
  const RestitutionDomain range{{-1, 1}, {2, 3}, {-0.8, -0.6}};
  const CachedTable first = keep(range), second = keep(range);
  EXPECT_TRUE(second.loaded);
  expect_equal(first.table, second.table);
}

TEST_F(StoredTableFile, IsBuiltAgainForAnythingElse) {
  keep();
  RestitutionDomain other = domain_;
  other.m.high = 3.1;
  EXPECT_FALSE(keep(other).loaded);
  EXPECT_FALSE(keep().loaded);
  EXPECT_FALSE(keep(domain_, 2 * tolerance).loaded);
  EXPECT_FALSE(keep(domain_, 2 * tolerance, form_of<LinearDashpot>()).loaded);
  EXPECT_TRUE(keep(domain_, 2 * tolerance, form_of<LinearDashpot>()).loaded);
}

// Cut short anywhere, or with any byte changed, the file is replaced, or what it says is the same.
TEST_F(StoredTableFile, IsBuiltAgainIfDamaged) {
  const CachedTable whole = keep();
  const std::filesystem::path path = file("table.h5");
  const auto size = file_size(path);
  int rebuilt = 0;
  for (std::uintmax_t byte = 0; byte < size; byte += 97) {
    {
      std::fstream bytes(path, std::ios::binary | std::ios::in | std::ios::out);
      bytes.seekg(static_cast<std::streamoff>(byte));
      const auto old = static_cast<char>(bytes.get());
      bytes.seekp(static_cast<std::streamoff>(byte));
      bytes.put(static_cast<char>(~old));
    }
    const CachedTable again = keep();
    expect_equal(whole.table, again.table);
    rebuilt += !again.loaded;
    EXPECT_TRUE(keep().loaded);
  }
  EXPECT_GT(rebuilt, 3);
  resize_file(path, size / 2);
  EXPECT_FALSE(keep().loaded);
  resize_file(path, 0);
  EXPECT_FALSE(keep().loaded);
  EXPECT_TRUE(keep().loaded);
}

// By another program, which keeps the checksums of HDF5 right.
TEST_F(StoredTableFile, IsBuiltAgainIfItWasChanged) {
  const CachedTable whole = keep();
  for (const char* name : {"middle", "panels"}) {
    {
      h5::File opened = h5::File::open(file("table.h5"), h5::Access::write);
      h5::Dataset stored = opened.root().dataset(name);
      std::vector<double> numbers = stored.read<double>();
      numbers.at(numbers.size() / 2) += 1e-9;
      stored.write<double>(numbers);
      opened.close();
    }
    const CachedTable again = keep();
    EXPECT_FALSE(again.loaded) << name;
    expect_equal(whole.table, again.table);
    EXPECT_TRUE(keep().loaded);
  }
}

TEST_F(StoredTableFile, WithoutAPlaceItIsAsGood) {
  const auto kept =
      load_or_build_table(file("missing/table.h5"), form_of<Viscoelastic>(), domain_, coarse, 1);
  EXPECT_NE(kept.save_error.find("missing"), std::string::npos);
  expect_equal(kept.table, keep().table);
}

}  // namespace
}  // namespace vitrel
