#include "analysis/observables/energy_tables.h"

namespace vitrel {
namespace {

Table energy_table(const EnergySeries& energy) {
  return {"energies",
          "Energies per particle at the sample times, in kT; translational + rotational = total.",
          {{"time", "time", energy.time},
           {"translational", "kT", energy.translational},
           {"rotational", "kT", energy.rotational},
           {"total", "kT", energy.total}}};
}

Table compressibility_table(const CompressibilitySeries& series) {
  return {"compressibility_factor",
          "Compressibility factor Z = P/(rho kT) from the virial of the collisions between two "
          "samples.",
          {{"time", "time", series.time}, {"z", "1", series.value}}};
}

}  // namespace

std::vector<Table> energy_tables(const EnergySeries& energy, const CompressibilitySeries& z) {
  std::vector<Table> tables;
  if (energy.time.size() > 1) tables.push_back(energy_table(energy));
  if (!z.value.empty()) tables.push_back(compressibility_table(z));
  return tables;
}

std::vector<Observable> energy_observables() {
  const Chart energy{.section = Chart::Section::course,
                     .heading = "Energy per particle",
                     .symbol = "E/N",
                     .curves = {{"translational", "translational"},
                                {"rotational", "rotational", true},
                                {"total", "total", true}},
                     .scale = Chart::Scale::from_zero,
                     .level_of_run = Chart::Level::equipartition};
  const Chart z{.section = Chart::Section::course,
                .heading = "Compressibility factor",
                .symbol = "Z = βP/ρ",
                .curves = {{"z", "Z"}},
                .level_of_run = Chart::Level::mean};
  return {{.table = "energies",
           .what = "Translational, rotational and total energy per particle.",
           .columns = {frame_time_column(),
                       {"translational", "kT", "Σ m v²/(2N)"},
                       {"rotational", "kT", "Σ ω·I ω/(2N)"},
                       {"total", "kT", "their sum"}},
           .charts = {energy}},
          {.table = "compressibility_factor",
           .what = "Compressibility factor from the virial of the collisions between two samples.",
           .columns = {{"time", "time", "middle of the interval between two samples"},
                       {"z", "1", "Z = PV/(N kT), of the virial since the sample before"}},
           .needs = {.motion = true},
           .charts = {z}}};
}

}  // namespace vitrel
