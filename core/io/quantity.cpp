#include "core/io/quantity.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <new>

#include "core/error.h"
#include "core/io/checked.h"

namespace vitrel {
namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

class Units {
 public:
  Units()
      : system_((ut_set_error_message_handler(ut_ignore), ut_read_xml(nullptr)), ut_free_system) {
    if (!system_)
      throw UserError("the list of units of UDUNITS-2 cannot be read; install libudunits2-data");
  }
  Unit parse(const std::string& text) const {
    Unit unit(ut_parse(system_.get(), text.c_str(), UT_UTF8), ut_free);
    if (!unit && ut_get_status() == UT_OS) throw std::bad_alloc();
    return unit;
  }

 private:
  std::unique_ptr<ut_system, decltype(&ut_free_system)> system_;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

}  // namespace

std::optional<double> quantity(const std::string& text, const std::string& unit) {
  static const Units units;
  double number = 0;
  const auto [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (trouble != std::errc() || !std::isfinite(number)) return std::nullopt;
  const Unit given = units.parse(trimmed({end, text.data() + text.size()}));
  const Unit wanted = units.parse(unit);
  if (!given || !ut_are_convertible(given.get(), wanted.get())) return std::nullopt;
  const Converter converter(obtained(ut_get_converter(given.get(), wanted.get())), cv_free);
  const auto convert = [&](double x) { return cv_convert_double(converter.get(), x); };
  // A scale with an origin of its own, or a logarithmic one, is no quantity.
  const bool is_proportional = convert(0) == 0 && std::abs(convert(2) / convert(1) - 2) < 1e-12;
  return is_proportional && std::isfinite(convert(number)) ? std::optional(convert(number))
                                                           : std::nullopt;
}

std::string quantity_text(double number, const std::string& unit) {
  return fmt::format("{} {}", number, unit);
}

}  // namespace vitrel
