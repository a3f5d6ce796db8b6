#include "workflow/sweep/seed_averages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/statistics/blocking.h"
#include "core/io/number_text.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

constexpr const char* error_suffix = "_error";
constexpr double one_sigma = 0.6827;

/// Jobs whose values differ in the seed only.
struct Replicates {
  SweptValues values;
  std::vector<Published> published;
  std::vector<const Figures*> jobs;
};

std::vector<Replicates> grouped(const std::vector<JobResult>& jobs) {
  std::vector<Replicates> groups;
  for (const JobResult& job : jobs) {
    SweptValues values = job.values;
    std::erase_if(values, [](const auto& pair) { return pair.first == seed_key; });
    auto group = std::ranges::find(groups, values, &Replicates::values);
    if (group == groups.end()) group = groups.insert(group, {std::move(values), job.published, {}});
    group->jobs.push_back(&job.figures);
  }
  return groups;
}

/// Half the width of the interval of that probability; 0 if the values differ by rounding errors only.
double half_width(const MeanOfRuns& mean, double level) {
  const double width = mean.half_width(level);
  return is_rounding(width, mean.mean) ? 0 : width;
}

AveragedFigure averaged(const std::string& name, const std::vector<const Figures*>& jobs) {
  std::vector<double> values, errors;
  for (const Figures* figures : jobs) {
    values.push_back(figure(*figures, name));
    errors.push_back(figure(*figures, name + error_suffix));
  }
  const MeanOfRuns mean = mean_of_runs(values, errors);
  return {name,         mean.mean,        half_width(mean, one_sigma), half_width(mean, 0.95),
          mean.scatter, mean.is_excessive};
}

}  // namespace

std::string SeedAverage::name() const {
  std::vector<std::string> parts;
  for (const auto& [key, value] : values) parts.push_back(last_part(key) + " " + value);
  for (std::string& part : parts) std::erase(part, '"');
  return parts.empty() ? "all" : fmt::format("{}", fmt::join(parts, ", "));
}

AveragedFigure SeedAverage::find(const std::string& name) const {
  const auto found = std::ranges::find(figures, name, &AveragedFigure::name);
  return found == figures.end() ? AveragedFigure{name, unknown, unknown, unknown, unknown, false}
                                : *found;
}

std::vector<SeedAverage> seed_averages(const std::vector<JobResult>& jobs) {
  std::vector<SeedAverage> averages;
  for (const Replicates& group : grouped(jobs)) {
    SeedAverage& average =
        averages.emplace_back(SeedAverage{group.values, group.jobs.size(), {}, group.published});
    for (const auto& [name, value] : *group.jobs.front())
      if (!name.ends_with(error_suffix)) average.figures.push_back(averaged(name, group.jobs));
  }
  return averages;
}

bool has_seeds(const SweptValues& values) {
  return std::ranges::any_of(values, [](const auto& pair) { return pair.first == seed_key; });
}

}  // namespace vitrel
