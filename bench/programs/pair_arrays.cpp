// How fast does C++ answer about pairs of ellipses that are given as arrays?
//
// Prints JSON: the best times of one processor for overlaps by the exact criterion and for first contacts by the default
// method, and what came out. scripts/validate python compares the package for Python with it, on the same pairs.

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/terminal/session.h"
#include "bench/programs/programs.h"
#include "bench/surveys/best_seconds.h"
#include "core/contact/first_contact.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/tolerances.h"
#include "workflow/pair/pair.h"

namespace vitrel::bench {
namespace {

constexpr int repeats = 5;

/// As the file has it: a body after the other.
struct Body {
  double a, b, x, y, angle, vx, vy, angular_velocity;

  Flight<Ellipse> flight() const { return {{a, b}, {{x, y}, angle}, {{vx, vy}, angular_velocity}}; }
};

std::vector<Body> read_bodies(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw FileError(path + ": cannot be read");
  std::vector<Body> bodies(static_cast<std::size_t>(file.tellg()) / sizeof(Body));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bodies.data()),
            static_cast<std::streamsize>(bodies.size() * sizeof(Body)));
  if (!file || bodies.size() % 2 != 0)
    throw FileError(path + ": must hold 8 doubles for each of an even number of bodies");
  return bodies;
}

}  // namespace

int pair_arrays(const PairArraysOptions& options) {
  const std::vector<Body> bodies = read_bodies(options.file);
  std::vector<Pair<2>> pairs;
  for (std::size_t k = 0; k < bodies.size(); k += 2)
    pairs.push_back({bodies[k].flight(), bodies[k + 1].flight(), std::nullopt, options.horizon});
  std::vector<char> overlapping(pairs.size());
  const double overlap_seconds = best_seconds(repeats, [&] {
    for (std::size_t k = 0; k < pairs.size(); ++k) overlapping[k] = overlaps(pairs[k]);
  });
  std::vector<Prediction2> contacts(pairs.size());
  const double contact_seconds = best_seconds(repeats, [&] {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Pair<2>& pair = pairs[k];
      const double reach = pair.one.body.circumradius() + pair.two.body.circumradius();
      contacts[k] = first_contact(pair.one, pair.two, pair.horizon, tolerance::contact_gap(reach));
    }
  });
  const auto touches = [](const Prediction2& found) { return found.outcome == Outcome::contact; };
  const Json found = {{"pairs", pairs.size()},
                      {"overlap_seconds", overlap_seconds},
                      {"overlaps", std::ranges::count(overlapping, 1)},
                      {"contact_seconds", contact_seconds},
                      {"contacts", std::ranges::count_if(contacts, touches)}};
  print_text(json_text(found, 2) + '\n');
  return 0;
}

}  // namespace vitrel::bench
