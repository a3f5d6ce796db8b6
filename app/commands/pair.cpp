#include "app/commands/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/io/provenance.h"
#include "edmd/soft/restitution_table.h"
#include "workflow/analyze/analyze.h"
#include "workflow/report/page.h"
#include "workflow/report/pair_figures.h"
#include "workflow/rules.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

template <class Vector>
Json components(const Vector& vector) {
  return Json(std::vector<typename Vector::Scalar>(vector.begin(), vector.end()));
}

template <int Dim>
void add_gap(const PairGap<Dim>& found, Json& summary) {
  summary["gap"] = found.gap;
  summary["gap_is"] = found.overlap ? "minus the depth of the overlap" : "distance of the surfaces";
}

template <int Dim>
void add_image(const Pair<Dim>& pair, const Shift<Dim>& image, Json& summary) {
  if (pair.box) summary["image"] = components(image);
}

template <int Dim>
Json overlap_summary(const Pair<Dim>& pair) {
  const PairGap<Dim> found = gap_at(pair, 0);
  Json summary = {{"overlap", found.overlap}};
  add_gap(found, summary);
  summary["touching_scale"] = found.touching_scale;
  if constexpr (Dim == 2) {
    summary["psi"] = found.criterion.psi;
    summary["g_1"] = found.criterion.g1;
    summary["g_2"] = found.criterion.g2;
  }
  add_image(pair, found.image, summary);
  return summary;
}

template <int Dim>
Json gap_summary(const Pair<Dim>& pair) {
  const PairGap<Dim> found = gap_at(pair, 0);
  Json summary;
  add_gap(found, summary);
  if (!found.overlap) {
    summary["normal"] = components(found.normal);
    summary["point_on_1"] = components(found.point1);
    summary["point_on_2"] = components(found.point2);
  }
  add_image(pair, found.image, summary);
  return summary;
}

template <int Dim>
Json contact_summary(const Pair<Dim>& pair) {
  const PairGap<Dim> start = gap_at(pair, 0);
  const PairContact<Dim> found = first_contact(pair);
  Json summary;
  if (start.overlap || found.prediction.outcome == Outcome::overlap) {
    summary["outcome"] = start.overlap ? "overlap at the start" : "touch at the start";
    add_gap(start, summary);
    add_image(pair, start.image, summary);
  } else if (found.prediction.outcome == Outcome::none) {
    summary = {{"outcome", "no contact before the horizon"}, {"horizon", pair.horizon}};
  } else {
    summary = {{"outcome", "contact"},
               {"time", found.prediction.time},
               {"point", components(found.prediction.point)},
               {"normal", components(found.prediction.normal)}};
    add_gap(gap_at(pair, found.prediction.time), summary);
    add_image(pair, found.image, summary);
  }
  return summary;
}

template <int Dim>
Json path_summary(const Pair<Dim>& pair, double end, const Results& path, const fs::path& output) {
  Json summary = overlap_summary(pair);
  if constexpr (Dim == 2) summary["d"] = path.find("path")->find("d")->value.front();
  const std::vector<double>& contact = path.find("first_contact")->find("time")->value;
  summary["first_contact"] = contact.empty() ? Json(nullptr) : Json(contact.front());
  summary["until"] = end;
  if (!output.empty()) summary["output"] = output.string();
  return summary;
}

/// Replaces this process by vitrel-bench, which computes the pair by its methods.
[[noreturn]] void compare_methods(const PairOptions& options, const PairParameters& pair) {
  std::vector<std::string> words = {"pair", pair_text(pair)};
  for (const std::string& method : options.methods) words.insert(words.end(), {"--method", method});
  if (options.print.json) words.push_back("--json");
  if (options.print.quiet) words.push_back("--quiet");
  become_bench(words);
}

Json coefficients_json(const Restitution& of) {
  return {
      {"distance", of.distance}, {"angle", of.angle}, {"duration", of.duration}, {"rate", of.rate}};
}

Restitution difference(const Restitution& x, const Restitution& y) {
  return {x.distance - y.distance, x.angle - y.angle, x.duration - y.duration, x.rate - y.rate};
}

struct Coefficients {
  Restitution integrated;
  std::optional<Restitution> tabulated;  ///< none if the table has no value
};

Json impact_summary(const Impact& impact, const Coefficients& found) {
  const ScaledImpact scaled = impact.scaled();
  const ContactScales scales = impact.scales();
  Json summary = {{"law", law_name(impact.contact.law)},
                  {"relative_speed", impact.speed},
                  {"impact_parameter", impact.impact_parameter},
                  {"scaled_distance", scaled.distance},
                  {"scaled_angular_momentum", scaled.angular_momentum},
                  {"scaled_damping", scaled.damping},
                  {"length_scale", scales.length},
                  {"time_scale", scales.time},
                  {"contact_time", found.integrated.duration * scales.time},
                  {"integrated", coefficients_json(found.integrated)},
                  {"tabulated", nullptr},
                  {"difference", nullptr}};
  if (found.tabulated) {
    summary["tabulated"] = coefficients_json(*found.tabulated);
    summary["difference"] = coefficients_json(difference(*found.tabulated, found.integrated));
  }
  return summary;
}

void print_line(const std::string& name, const std::string& text) {
  print_text(fmt::format("{:<26} {}\n", name, text));
}

void print_coefficient(const std::string& name, double Restitution::*of,
                       const Coefficients& found) {
  const double exact = found.integrated.*of;
  if (!found.tabulated) return print_line(name, fmt::format("{:<20.12g} –", exact));
  const double other = *found.tabulated.*of;
  print_line(name, fmt::format("{:<20.12g} {:<20.12g} {:.1e}", exact, other, other - exact));
}

void print_impact(const Impact& impact, const Coefficients& found) {
  const ContactScales scales = impact.scales();
  print_line("law", law_name(impact.contact.law));
  print_line("relative speed", fmt::format("{:.8g} m/s", impact.speed));
  print_line("impact parameter", fmt::format("{:.8g}", impact.impact_parameter));
  print_line("contact time", fmt::format("{:.8g} s", found.integrated.duration * scales.time));
  print_line("time scale T", fmt::format("{:.8g} s", scales.time));
  print_line("", fmt::format("{:<20} {:<20} {}", "integrated", "from the table", "difference"));
  print_coefficient("ε_r (distance)", &Restitution::distance, found);
  print_coefficient("ε_φ (angle)", &Restitution::angle, found);
  print_coefficient("ε_t (duration/T)", &Restitution::duration, found);
  print_coefficient("ε_ṙ (rate)", &Restitution::rate, found);
}

/// Checks the output of a figure, whose ending determines the format. An empty name means no output.
void require_figure_file(const std::string& option, const fs::path& output, const fs::path& input) {
  if (output.empty()) return;
  const fs::path ending = output.extension();
  if (ending != ".h5" && ending != ".csv" && ending != ".html")
    throw UserError(
        fmt::format("{} {}: the name must end in .csv, .h5 or .html", option, output.string()));
  require_output_file(output, {input});
  if (ending == ".html") require_place_of_page(output);
}

void write_page(const fs::path& output, FigurePage page, const std::string& parameters,
                const std::string& command_line) {
  page.parameters = parameters;
  page.results.provenance = provenance_rows(current_provenance(command_line, "", 0));
  write_figures(output, page);
}

int print_answer(const PairOptions& options, const PairParameters& parameters, const auto& answer) {
  print_summary(options.print, parameters.dimension() == 2 ? answer(pair_of<2>(parameters))
                                                           : answer(pair_of<3>(parameters)));
  return success;
}

}  // namespace

int pair_overlap_command(const PairOptions& options) {
  return print_answer(options, load_pair(options.source),
                      [](const auto& pair) { return overlap_summary(pair); });
}

int pair_gap_command(const PairOptions& options) {
  return print_answer(options, load_pair(options.source),
                      [](const auto& pair) { return gap_summary(pair); });
}

int pair_contact_time_command(const PairOptions& options) {
  const PairParameters parameters = load_pair(options.source);
  if (options.all_methods || !options.methods.empty()) compare_methods(options, parameters);
  return print_answer(options, parameters, [](const auto& pair) { return contact_summary(pair); });
}

int pair_path_command(const PairOptions& options) {
  require_figure_file("-o", options.output, options.source.file);
  PairSource source = options.source;
  if (options.until) source.horizon = show(*options.until);
  const PairParameters parameters = load_pair(source);
  return print_answer(options, parameters, [&](const auto& pair) {
    const double end = options.until ? pair.horizon : usual_end(pair);
    const FigurePage page = path_of_pair(pair, end, options.points);
    if (!options.output.empty())
      write_page(options.output, page, pair_text(parameters), options.command_line);
    return path_summary(pair, end, page.results, options.output);
  });
}

int pair_restitution_command(const ImpactOptions& options) {
  const Impact impact = load_impact(options.source);
  require_figure_file("--table", options.table, options.source.file);
  require_figure_file("--scaled-table", options.scaled_table, options.source.file);
  require_figure_file("--paths", options.paths, options.source.file);
  const RestitutionTable table =
      table_of(impact, [&](const std::string& line) { remark(options.print, line); });
  const Coefficients found{integrated(impact), table(impact.scaled())};
  const auto write = [&](const fs::path& output, const auto& page) {
    if (!output.empty()) write_page(output, page(), impact_text(impact), options.command_line);
  };
  write(options.table, [&] { return coefficient_maps(impact, table); });
  write(options.scaled_table, [&] { return scaled_maps(impact.contact.law); });
  write(options.paths, [&] { return impact_paths(impact); });
  if (options.print.json)
    print_summary(options.print, impact_summary(impact, found));
  else if (!options.print.quiet)
    print_impact(impact, found);
  if (!found.tabulated)
    remark(options.print, "the impact lies outside the table; a run integrates it");
  return success;
}

}  // namespace vitrel
