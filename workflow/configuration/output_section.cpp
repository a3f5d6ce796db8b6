#include "workflow/configuration/sections.h"

#include <fmt/format.h>

namespace vitrel {
namespace {

using Style = FieldVisitor::TableStyle;

constexpr const char* spacing_names[] = {"linear", "logarithmic"};
constexpr const char* precision_names[] = {"double", "single"};

void describe_samples(OutputParameters& p, FieldVisitor& visit) {
  using Spacing = OutputParameters::Spacing;
  visit.field({"spacing", "", "Spacing of the sample times."}, p.spacing, spacing_names);
  visit.when(p.spacing == Spacing::linear, "spacing = \"linear\"", [&](FieldVisitor& in) {
    in.optional(
        {"interval", "time",
         "Time between samples. By default a 200th of dynamics.duration, but at least 0.1 (or "
         "all of a shorter run).",
         bounds::time},
        p.interval, 0.1);
  });
  visit.when(p.spacing == Spacing::logarithmic, "spacing = \"logarithmic\"", [&](FieldVisitor& in) {
    in.field({"first", "time", "First sample after the one at time 0.", bounds::time}, p.first);
    in.field({"per_decade", "", "Samples per factor of ten in time.", bounds::at_least_one},
             p.per_decade);
  });
}

void describe_correlations(CorrelationParameters& p, FieldVisitor& visit) {
  visit.field(
      {"interval", "time", "Time between correlated states; this is the shortest time difference.",
       bounds::time},
      p.interval);
  visit.optional({"longest_lag", "time",
                  "Longest time difference. The default is half the duration; a run that is made "
                  "longer keeps that of its beginning.",
                  bounds::time},
                 p.longest_lag, 50.0);
  visit.field({"wave_numbers", "1/length",
               "Wave numbers q of the self-intermediate scattering functions F_s(q, t). If empty: "
               "approximately that of the main peak of the structure factor, 2π √(2ρ/√3) with the "
               "number density ρ.",
               bounds::positive},
              p.wave_numbers);
}

void validate_correlations(const CorrelationParameters& p, double duration) {
  const Rules rules("output.correlations");
  rules.require(p.interval <= duration && duration / p.interval <= 1e12, "interval",
                fmt::format("is {}, but must lie between 1e-12 of dynamics.duration = {} and all "
                            "of it",
                            show(p.interval), show(duration)));
  if (p.longest_lag)
    rules.require(*p.longest_lag >= p.interval && *p.longest_lag <= duration, "longest_lag",
                  fmt::format("is {}, but must lie between the interval {} and dynamics.duration = "
                              "{}",
                              show(*p.longest_lag), show(p.interval), show(duration)));
}

}  // namespace

void describe_output(OutputParameters& p, FieldVisitor& visit) {
  visit.table({"samples", "", "Times at which the state is written to the trajectory."},
              Style::inline_table, [&](FieldVisitor& in) { describe_samples(p, in); });
  visit.field({"velocities", "",
               "Whether the velocities of all particles are also written. Energies and pressure do "
               "not need them."},
              p.velocities);
  visit.field({"precision", "",
               "Of the positions, angles and velocities that are written. In single precision the "
               "trajectory has about half the size and serves to be looked at and analysed; "
               "particles that touch may overlap in it by rounding. The run itself, and its "
               "checkpoint, are not rounded."},
              p.precision, precision_names);
  const Field correlations{
      "correlations", "",
      "Correlations measured during the run, from states that need not be "
      "written: displacement, rotation, self-scattering and orientation, over "
      "times from the interval to half the run, or longest_lag. The file has the name of the "
      "run with the suffix .correlations.h5. By default none are measured."};
  visit.optional(correlations, p.correlations, CorrelationParameters(),
                 [&](FieldVisitor& in, CorrelationParameters& inner) {
                   in.table(correlations, Style::inline_table,
                            section_of(inner, describe_correlations));
                 });
  visit.field({"checkpoint_interval", "seconds of wall time",
               "Time between checkpoints, from which an interrupted preparation or run continues.",
               bounds::time_or_none},
              p.checkpoint_interval);
}

void validate_output(const Parameters& parameters) {
  const OutputParameters& p = parameters.output;
  const Rules samples("output.samples");
  const double duration = parameters.dynamics.duration;
  const auto within = [&](double value, const char* key) {
    samples.require(value <= duration, key,
                    fmt::format("is {}, but must not exceed dynamics.duration = {}", show(value),
                                show(duration)));
  };
  const auto are_possible = [&](double number, const char* key, const std::string& value) {
    samples.require(
        number <= 1e8, key,
        fmt::format("is {}, which makes {:.3g} samples; at most 1e8 are possible", value, number));
  };
  if (p.spacing == OutputParameters::Spacing::linear) {
    samples.require(
        p.interval || !parameters.dynamics.relaxation_times, "interval",
        "is missing; the length of a run that ends by its relaxation times is not known "
        "before, so that the interval must be given, or spacing = \"logarithmic\"");
    const double interval = sample_interval(parameters);
    within(interval, "interval");
    are_possible(duration / interval, "interval", show(interval));
  } else {
    within(p.first, "first");
    samples.require(duration / p.first <= 1e12, "first",
                    fmt::format("is {}, but must be at least 1e-12 of dynamics.duration = {}",
                                show(p.first), show(duration)));
    are_possible(static_cast<double>(sample_times(parameters).size()), "per_decade",
                 std::to_string(p.per_decade));
  }
  if (p.correlations) validate_correlations(*p.correlations, duration);
}

}  // namespace vitrel
