#include "workflow/configuration/distributions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/io/number_text.h"
#include "workflow/rules.h"

namespace vitrel {
namespace {

using KindOfLaw = Distribution::Kind;

constexpr const char* distribution_names[] = {"gaussian", "lognormal", "uniform", "power_law"};

/// Allows for the rounding of shapes that were computed from ratios and sizes, and of numbers typed with ten digits.
constexpr double slack = 1e-9;

}  // namespace

Distribution constant(double value) {
  Distribution d;
  d.mean = value;
  return d;
}

Distribution example_of(double value, double minimum) {
  return {KindOfLaw::constant, value, 0.1, minimum, value, minimum};
}

void describe_distribution(const Field& field, Distribution& d, FieldVisitor& visit) {
  bool is_table = d.kind != KindOfLaw::constant;
  std::size_t kind = is_table ? static_cast<std::size_t>(d.kind) - 1 : 0;
  const auto number = [&](FieldVisitor& in) { in.field(field, d.mean); };
  visit.value_or_table(field, is_table, number, [&](FieldVisitor& in) {
    in.choice({"distribution", "",
               "Distribution from which the numbers are drawn, as a table instead of a number."},
              kind, distribution_names);
    in.when(kind < 2, "distribution = \"gaussian\" or \"lognormal\"", [&](FieldVisitor& bell) {
      bell.field({"mean", "", "Mean."}, d.mean);
      bell.field(
          {"standard_deviation", "", "Standard deviation of the values (not of their logarithms)."},
          d.standard_deviation);
    });
    in.when(kind >= 2, "distribution = \"uniform\" or \"power_law\"", [&](FieldVisitor& bounded) {
      bounded.field({"low", "", "Lower bound."}, d.low);
      bounded.field({"high", "", "Upper bound."}, d.high);
    });
    in.when(kind == 3, "distribution = \"power_law\"", [&](FieldVisitor& law) {
      law.field({"exponent", "", "Exponent of the density, ∝ x^exponent between the bounds."},
                d.exponent);
    });
    in.field({"minimum", "", "No value is smaller: there the distribution is cut off."}, d.minimum);
  });
  d.kind = static_cast<KindOfLaw>(is_table ? kind + 1 : 0);
}

void validate_distribution(const Distribution& d, double least, const std::string& key) {
  const std::string bound =
      fmt::format("must be at least {} and at most {}", show(least), show(max_draw));
  if (d.kind == KindOfLaw::constant) {
    if (!(d.mean >= least && d.mean <= max_draw))
      throw BadValue(key, fmt::format("is {}, but {}", show(d.mean), bound));
    return;
  }
  const Rules rules(key);
  const auto require_bounded = [&](double value, const char* name) {
    rules.require(value <= max_draw, name,
                  fmt::format("is {}, but must be at most {}", show(value), show(max_draw)));
  };
  rules.require(d.minimum >= least && d.minimum <= max_draw, "minimum",
                fmt::format("is {}, but {}", show(d.minimum), bound));
  if (d.is_bounded()) {
    constexpr double steepest = 100;
    const bool is_law = d.kind == KindOfLaw::power_law;
    rules.require(!is_law || d.low > 0, "low",
                  fmt::format("is {}, but must be above 0 for a power law", show(d.low)));
    rules.require(!is_law || std::abs(d.exponent) <= steepest, "exponent",
                  fmt::format("is {}, but must lie between -{} and {}", show(d.exponent),
                              show(steepest), show(steepest)));
    rules.require(d.high > d.low && std::isfinite(d.low), "high",
                  fmt::format("is {}, but must be above low = {}", show(d.high), show(d.low)));
    require_bounded(d.high, "high");
    rules.require(
        d.high > d.minimum, "high",
        fmt::format("is {}, but must be above minimum = {}", show(d.high), show(d.minimum)));
    return;
  }
  rules.positive(d.standard_deviation, "standard_deviation");
  require_bounded(d.standard_deviation, "standard_deviation");
  rules.require(
      d.mean >= d.minimum, "mean",
      fmt::format("is {}, but must be at least minimum = {}", show(d.mean), show(d.minimum)));
  require_bounded(d.mean, "mean");
}

std::string text(const Distribution& d) {
  if (d.kind == KindOfLaw::constant) return fmt::format("{}", d.mean);
  if (d.kind == KindOfLaw::uniform)
    return fmt::format("uniform from {} to {}, at least {}", d.low, d.high, d.minimum);
  if (d.kind == KindOfLaw::power_law)
    return fmt::format("∝ x^{} from {} to {}, at least {}", d.exponent, d.low, d.high, d.minimum);
  return fmt::format("{} with mean {} and standard deviation {}, at least {}",
                     d.kind == KindOfLaw::gaussian ? "gaussian" : "lognormal", d.mean,
                     d.standard_deviation, d.minimum);
}

std::string text(const std::vector<Distribution>& entries) {
  std::vector<std::string> texts;
  for (const Distribution& d : entries)
    texts.push_back(d.kind == KindOfLaw::constant ? show(d.mean) : text(d));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

bool same(const Distribution& one, const Distribution& two) {
  if (one.kind != two.kind) return false;
  if (one.kind == KindOfLaw::constant) return one.mean == two.mean;
  if (one.minimum != two.minimum) return false;
  if (one.is_bounded())
    return one.low == two.low && one.high == two.high &&
           (one.kind == KindOfLaw::uniform || one.exponent == two.exponent);
  return one.mean == two.mean && one.standard_deviation == two.standard_deviation;
}

std::optional<double> constant_product(const std::vector<Distribution>& factors) {
  double result = 1;
  for (const Distribution& factor : factors) {
    if (factor.kind != KindOfLaw::constant) return std::nullopt;
    result *= factor.mean;
  }
  return result;
}

bool agree(double given, double found, Agreement agreement) {
  const double rounding = slack * std::abs(given);
  const double digits = agreement == Agreement::digits ? half_last_digit(given) : 0;
  return std::abs(found - given) <= std::max(rounding, digits * (1 + slack));
}

bool allows(const Distribution& d, double value, Agreement agreement) {
  if (d.kind == KindOfLaw::constant) return agree(d.mean, value, agreement);
  const bool above = value >= d.minimum * (1 - slack);
  if (!d.is_bounded()) return above;
  return above && value >= d.low - slack * std::abs(d.low) && value <= d.high * (1 + slack);
}

bool allow(const std::vector<Distribution>& entries, std::vector<double> values,
           Agreement agreement) {
  const auto allowed = [agreement](const Distribution& d, double value) {
    return allows(d, value, agreement);
  };
  std::ranges::sort(values);
  do {
    if (std::ranges::equal(entries, values, allowed)) return true;
  } while (std::ranges::next_permutation(values).found);
  return false;
}

}  // namespace vitrel
