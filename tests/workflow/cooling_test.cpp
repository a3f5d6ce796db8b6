#include "workflow/report/cooling.h"

#include <cmath>

#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"
#include "tests/support/scenes.h"
#include "workflow/report/run_report.h"

namespace vitrel {
namespace {

constexpr double initial = 0.8, time_scale = 7;

/// Spheres at rest on a lattice, with the energies of T = 0.8/(1 + t/7)ⁿ up to `last`; the parameters say how they
/// move.
ReportData run_of(const std::string& dynamics, double exponent, double last = 100) {
  const Configuration3 spheres = cubic_lattice(3, simple_cubic, 0.1, Ellipsoid{Vec3::Ones()});
  const Folder folder("cooling");
  const fs::path file = folder / "run.h5";
  Provenance provenance;
  provenance.parameters =
      "[system]\ndimension = 3\n[[species]]\naspect_ratio = 1\n[dynamics]\n" + dynamics;
  const std::vector<std::string> observables = {"rotational_energy", "translational_energy"};
  TrajectoryWriter writer = TrajectoryWriter::create(
      file, spheres, provenance, {.observables = observables, .overwrite = true});
  Configuration3 frame = spheres;
  const auto particles = static_cast<double>(frame.size());
  for (int k = 0; k <= 20; ++k) {
    frame.time = last * k / 20;
    const double temperature = initial / std::pow(1 + frame.time / time_scale, exponent);
    writer.write(
        frame, k,
        {{"rotational_energy", 0}, {"translational_energy", 1.5 * particles * temperature}});
  }
  writer.close();
  return report_data(analyze_run(file, {}));
}

const std::string contact = "[dynamics.contact]\n";
const std::string dashpot =
    contact + "law = \"linear_dashpot\"\nstiffness = \"10 MN/m\"\ndamping = ";
const std::string viscoelastic = contact + "law = \"viscoelastic\"\ndissipative_time = ";

TEST(Cooling, ConstantRestitutionHasTheExponentTwo) {
  for (const std::string& dynamics :
       {std::string("restitution = 0.9\n"), dashpot + "\"300 kg/s\"\n"}) {
    const ReportData data = run_of(dynamics, 2);
    ASSERT_TRUE(data.runs[0].cooling) << dynamics;
    const auto law = haff_law(*data.runs[0].cooling, data.runs[0].results, 3);
    ASSERT_TRUE(law);
    EXPECT_EQ(law->exponent, 2);
    EXPECT_NEAR(law->initial, initial, 1e-14);
    EXPECT_NEAR(law->time, time_scale, 1e-12);
    EXPECT_THAT(report_page(data), HasSubstr("T = T(0)/(1 + t/τ)<sup>2</sup> with τ = 7 "));
  }
}

TEST(Cooling, OfViscoelasticSpheresIsSlower) {
  const ReportData data = run_of(viscoelastic + "\"40 us\"\n", 5. / 3);
  const auto law = haff_law(data.runs[0].cooling.value(), data.runs[0].results, 3);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->time, time_scale, 1e-12);
  EXPECT_THAT(report_page(data), HasSubstr("T = T(0)/(1 + t/τ)<sup>5/3</sup> with τ = 7 "));
}

// T falls to T(0)/e at t = 7 (e^(1/2) − 1) = 4.54.
TEST(Cooling, WithoutOneDecayNoLawIsDrawn) {
  const ReportData data = run_of("restitution = 0.9\n", 2, 4.5);
  ASSERT_TRUE(data.runs[0].cooling);
  EXPECT_FALSE(haff_law(*data.runs[0].cooling, data.runs[0].results, 3));
  EXPECT_THAT(report_page(data), HasSubstr("is not drawn: T does not fall to T(0)/e"));
}

TEST(Cooling, IsNotShownWhereEnergyIsConservedOrComesBack) {
  const std::string brownian = "kind = \"brownian\"\n";
  for (const std::string& dynamics :
       {std::string(), dashpot + "\"0 kg/s\"\n", viscoelastic + "\"0 s\"\n",
        brownian + "restitution = 0.9\n", brownian + viscoelastic + "\"40 us\"\n"}) {
    const ReportData data = run_of(dynamics, 2);
    EXPECT_FALSE(data.runs[0].cooling) << dynamics;
    EXPECT_THAT(report_page(data), Not(HasSubstr("Haff’s law T")));
  }
}

}  // namespace
}  // namespace vitrel
