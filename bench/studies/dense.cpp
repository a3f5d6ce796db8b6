// How does one make a dense state, and what does it cost?

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "analysis/structure/contacts.h"
#include "analysis/structure/order.h"
#include "bench/studies/scratch_folder.h"
#include "bench/studies/study.h"
#include "bench/surveys/engine_speed.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/state/check.h"
#include "workflow/configuration/parameters.h"
#include "workflow/prepare/prepare.h"

namespace vitrel::bench {
namespace {

/// Particles with one species for each entry of `sizes`.
struct System {
  std::string name;
  double aspect_ratio;
  std::vector<std::string> sizes;
  std::vector<double> packing_fractions;  ///< packing fractions to be reached
};
const std::string inverse_cube = R"({ distribution = "power_law", low = 0.725, high = 1.61 })";
const std::vector<System> systems = {
    {"disks, 1 : 1.4", 1, {"1", "1.4"}, {0.6, 0.7, 0.78, 0.82, 0.83, 0.845}},
    {"κ = 1.4, 1 : 1.4", 1.4, {"1", "1.4"}, {0.7, 0.8, 0.86, 0.88, 0.89}},
    {"κ = 2", 2, {"1"}, {0.6, 0.7, 0.8, 0.85, 0.88}},
    {"κ = 6", 6, {"1"}, {0.6, 0.7, 0.76, 0.8, 0.84}},
    {"disks, σ⁻³", 1, {inverse_cube}, {0.7, 0.8, 0.84, 0.87, 0.89}},
    {"κ = 2, σ⁻³", 2, {inverse_cube}, {0.7, 0.8, 0.86, 0.88, 0.893}}};

struct Way {
  std::string name, stage;
};
const std::vector<Way> ways = {
    {"grow, rate 1e-3", "method = \"grow\"\ngrowth_rate = 1e-3"},
    {"grow, rate 1e-2", "method = \"grow\"\ngrowth_rate = 1e-2"},
    {"hybrid, rate 1e-2", "method = \"hybrid\"\ngrowth_rate = 1e-2"},
    {"hybrid with exchanges",
     "method = \"hybrid\"\ngrowth_rate = 1e-2\nmoves = \"local\"\nexchanges = 0.2"},
    {"hybrid with collective exchanges",
     "method = \"hybrid\"\ngrowth_rate = 1e-2\ncollective_exchanges = 4"},
    {"swell", "method = \"swell\""},
    {"compress, βP = 100", "method = \"compress\"\npressure = 100\nsweeps = 100000000"}};

std::string preparation_text(const System& system, int particles, double packing_fraction,
                             const std::string& stage) {
  std::string text =
      fmt::format("[system]\nparticles = {}\npacking_fraction = {}\n", particles, packing_fraction);
  for (std::size_t k = 0; k < system.sizes.size(); ++k)
    text += fmt::format("[[species]]\nname = \"{}\"\nfraction = {}\naspect_ratio = {}\nsize = {}\n",
                        static_cast<char>('A' + k), 1. / static_cast<double>(system.sizes.size()),
                        system.aspect_ratio, system.sizes[k]);
  text += "[prepare]\nquality_sweeps = 0\n";
  return text +
         "[[prepare.stage]]\nmethod = \"insert\"\npacking_fraction = 0.3\n[[prepare.stage]]\n" +
         stage + "\n";
}

/// The parameters of a preparation up to this packing fraction.
std::string preparation_text(const System& system, int particles, double packing_fraction,
                             const Way& way) {
  return preparation_text(system, particles, packing_fraction,
                          fmt::format("{}\npacking_fraction = {}", way.stage, packing_fraction));
}

/// The end of a preparation: "reached", "stuck" or "time is up".
struct End {
  std::string how;
  double seconds = 0;
  Configuration2 state;
  double reduced_pressure = NAN;

  bool is_reached() const { return how == "reached"; }
};

/// Prepares a state within this processor time, if that is possible.
End prepared(const std::string& text, double seconds, const RunControl& control) {
  const ScratchFolder folder;
  const std::filesystem::path output = folder.partial() / "state.h5";
  const double begin = processor_seconds();
  const RunControl limited{
      [&] { return processor_seconds() - begin > seconds || control.stop_requested(); }, {}, {}};
  try {
    const Preparation<2> made =
        prepare<2>({parse_parameters(text, "the preparation"), output}, limited, {});
    if (made.complete && !made.check.clean()) throw InvariantError("overlap");
    return {made.complete ? "reached" : "time is up", processor_seconds() - begin,
            made.configuration, made.stages.empty() ? NAN : made.stages.back().reduced_pressure()};
  } catch (const UserError&) {
    const std::filesystem::path stuck = output.string() + ".stuck.h5";
    if (!std::filesystem::exists(stuck)) throw;
    return {"stuck", processor_seconds() - begin, read_state<2>(stuck)};
  }
}

void add_order(Json& row, const Configuration2& c) {
  row.update({{"reached", packing_fraction(c)},
              {"nematic_order", nematic_order(c)},
              {"hexatic_order", hexatic_order(c).global}});
}

// ---- densities --------------------------------------------------------------------------------------

Json density_row(const Way& way, const System& system, int particles, double phi, const End& end) {
  Json row = {{"method", way.name},
              {"system", system.name},
              {"particles", particles},
              {"packing_fraction", phi},
              {"end", end.how}};
  if (end.is_reached()) row["ns"] = 1e9 * end.seconds;
  add_order(row, end.state);
  return row;
}

/// A method that fails to reach a packing fraction is left out for the denser ones.
Json measure_densities(const StudyContext& context) {
  const bool quick = context.options.quick;
  const int particles = quick ? 50 : 1000;
  const double seconds = quick ? 2 : context.options.seconds;
  Json rows = Json::array();
  for (const System& system : systems) {
    std::set<std::string> failed;
    for (const double phi : system.packing_fractions)
      for (const Way& way : ways) {
        if (quick && phi > system.packing_fractions[0]) break;
        if (failed.contains(way.name)) continue;
        const End end =
            prepared(preparation_text(system, particles, phi, way), seconds, context.control);
        if (context.control.stop_requested()) return rows;
        if (!end.is_reached()) failed.insert(way.name);
        rows.push_back(density_row(way, system, particles, phi, end));
      }
  }
  return rows;
}

Json measure_sizes(const StudyContext& context) {
  const System system{"κ = 2, φ = 0.8", 2, {"1"}, {}};
  Json rows = Json::array();
  for (const int particles : {250, 1000, 4000, 16'000})
    for (const Way& way : ways) {
      if (context.options.quick && particles > 250) break;
      if (way.name.starts_with("compress")) continue;
      const End end =
          prepared(preparation_text(system, particles, 0.8, way),
                   context.options.quick ? 2 : 10 * context.options.seconds, context.control);
      if (context.control.stop_requested()) return rows;
      rows.push_back(density_row(way, system, particles, 0.8, end));
    }
  return rows;
}

// ---- up to jamming ----------------------------------------------------------------------------------

/// Adds to each row its deficit compared with the densest state of its system.
void add_deficits(Json& rows, std::size_t first) {
  double densest = 0;
  for (std::size_t k = first; k < rows.size(); ++k)
    densest = std::max(densest, rows[k]["reached"].get<double>());
  for (std::size_t k = first; k < rows.size(); ++k)
    rows[k]["deficit"] = 1 - rows[k]["reached"].get<double>() / densest;
}

Json measure_jamming(const StudyContext& context) {
  const bool quick = context.options.quick;
  const int particles = quick ? 50 : 500;
  constexpr double goal = min_jammed_pressure;
  constexpr std::array rates{1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4};
  Json rows = Json::array();
  for (const System& system : {systems[0], systems[1], systems[3]}) {
    const std::size_t first = rows.size();
    for (const char* const method : {"grow", "hybrid"})
      for (const double rate : rates) {
        if (context.control.stop_requested() || (quick && rate < 1e-2)) break;
        const std::string stage = fmt::format(
            "method = \"{}\"\ngrowth_rate = {}\nreduced_pressure = {}", method, rate, goal);
        const End end = prepared(preparation_text(system, particles, 0.8, stage),
                                 quick ? 5 : 10 * context.options.seconds, context.control);
        if (!end.is_reached()) continue;
        const JammedBackbone held = jammed_backbone(end.state, end.reduced_pressure);
        rows.push_back({{"method", method},
                        {"system", system.name},
                        {"growth_rate", rate},
                        {"ns", 1e9 * end.seconds},
                        {"reduced_pressure", end.reduced_pressure},
                        {"contact_number", held.contact_number},
                        {"isostatic_number", held.isostatic_number},
                        {"rattlers", held.rattlers}});
        add_order(rows.back(), end.state);
      }
    add_deficits(rows, first);
  }
  return rows;
}

const Column time = {"ns", "time", Shown::time};
const std::vector<Column> order = {{"end"},
                                   {"reached", "φ reached"},
                                   {"nematic_order", "nematic order"},
                                   {"hexatic_order", "hexatic order"}};

}  // namespace

Study dense_study() {
  std::vector<Column> jammed(order.begin() + 1, order.end());
  for (const Column& column :
       {Column{"reduced_pressure", "Z"}, Column{"contact_number", "contacts"},
        Column{"isostatic_number", "isostatic"}, Column{"rattlers"}})
    jammed.push_back(column);
  return {.name = "dense",
          .aliases = {{"preparation"}},
          .question = "How does one make a dense state, and what does it cost?",
          .parts =
              {{.name = "density",
                .about = "1000 particles inserted at random at φ = 0.3, and one more stage that "
                         "brings them to φ on one core. Growth at the rate 10⁻³ is the default of "
                         "parameter files. Hybrid stages make 100 Monte Carlo sweeps after "
                         "every interval of growth. Sizes σ⁻³ lie between 0.725 and 1.61. No "
                         "state has an overlap. A method that is stuck or not done in time is "
                         "left out of the denser states.",
                .measure = measure_densities,
                .cases = {{"system"}},
                .cost = time,
                .others = order,
                .varied = "packing_fraction"},
               {.name = "sizes",
                .about = "The same for more and more particles.",
                .measure = measure_sizes,
                .cases = {{"system"}},
                .cost = time,
                .others = order,
                .varied = "particles"},
               {.name = "jamming",
                .about =
                    "500 particles, grown until Z = βP/ρ is 10⁵, at several rates. The "
                    "error is how much less dense the packing is than the densest of all; one that "
                    "takes too long is left out. "
                    "Contacts are those per particle without rattlers (donev2007).",
                .measure = measure_jamming,
                .cases = {{"system"}},
                .cost = time,
                .error = {"deficit", "1 − φ/φ of the densest", Shown::error},
                .others = jammed,
                .varied = "growth_rate",
                .smallest_error = 1e-5}},
          .defaults = {.seconds = 30}};
}

}  // namespace vitrel::bench
