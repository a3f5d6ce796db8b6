#include "app/workflow/bench/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "app/workflow/bench/svg.h"
#include "workflow/report/html.h"

namespace vitrel {
namespace {

constexpr int width = 920, height = 500, legend_width = 244;
constexpr double left = 78, top = 46, bottom = height - 56;

struct Tick {
  double value;
  std::string label;  // empty: a line only
};

/// Values of one axis, mapped to pixels.
class Scale {
 public:
  Scale(const ChartAxis& axis, std::vector<double> values, double from, double to, double floor = 0,
        const std::string& floor_label = "")
      : axis_(axis),
        floor_(axis.logarithmic ? floor : 0),
        floor_label_(floor_label),
        from_(from),
        to_(to) {
    std::erase_if(values, [&](double v) { return !std::isfinite(v) || !is_shown(v); });
    low_ = high_ = axis.logarithmic ? 1 : 0;
    if (!values.empty()) {
      const auto [least, most] = std::ranges::minmax(values);
      low_ = least, high_ = most;
      if (floor_ > 0) low_ = std::max(least, floor_), high_ = std::max(most, floor_);
    }
    if (axis.logarithmic)
      cover_decades();
    else
      cover_round_numbers();
  }

  bool is_shown(double value) const {
    return std::isfinite(value) && (!axis_.logarithmic || floor_ > 0 || value > 0);
  }
  double operator()(double value) const {
    const double clipped = axis_.logarithmic ? std::max(value, low_) : value;
    const double part = axis_.logarithmic ? std::log(clipped / low_) / std::log(high_ / low_)
                                          : (clipped - low_) / (high_ - low_);
    return from_ + part * (to_ - from_);
  }
  double low() const { return low_; }
  double high() const { return high_; }

  std::vector<Tick> ticks() const { return axis_.logarithmic ? decades() : round_numbers(); }

 private:
  void cover_decades() {
    first_ = static_cast<int>(std::floor(std::log10(low_) + 1e-9));
    last_ = static_cast<int>(std::ceil(std::log10(high_) - 1e-9));
    if (last_ == first_) ++last_;
    low_ = std::pow(10.0, first_), high_ = std::pow(10.0, last_);
  }
  void cover_round_numbers() {
    if (high_ == low_) high_ = low_ + 1;
    const double raw = (high_ - low_) / 7, decade = std::pow(10, std::floor(std::log10(raw)));
    step_ = 10 * decade;
    for (const double factor : {5.0, 2.0, 1.0})
      if (factor * decade >= raw) step_ = factor * decade;
    low_ = step_ * std::floor(low_ / step_ + 1e-9), high_ = step_ * std::ceil(high_ / step_ - 1e-9);
  }

  std::vector<Tick> decades() const {
    std::vector<Tick> ticks;
    const int room = static_cast<int>(std::abs(to_ - from_) / (is_horizontal() ? 64 : 26));
    const int every = 1 + (last_ - first_) / std::max(room, 1);
    for (int k = first_; k <= last_; ++k) {
      const bool is_floor = floor_ > 0 && k == first_ && low_ <= floor_ * 1.000001;
      const bool named = is_floor || (k - first_) % every == 0;
      ticks.push_back({std::pow(10.0, k), !named ? "" : is_floor ? floor_text() : label(k)});
    }
    return ticks;
  }
  std::vector<Tick> round_numbers() const {
    std::vector<Tick> ticks;
    const auto count = static_cast<int>(std::lround((high_ - low_) / step_));
    for (int k = 0; k <= count; ++k) {
      const double value = low_ + k * step_;
      const double clean = std::abs(value) < 1e-9 * step_ ? 0 : value;
      std::string text = fmt::format("{:.6g}", clean);
      if (text.front() == '-') text.replace(0, 1, "−");
      ticks.push_back({clean, text});
    }
    return ticks;
  }
  std::string floor_text() const {
    return floor_label_.empty() ? "≤ " + label(first_) : floor_label_;
  }
  std::string label(int exponent) const {
    if (axis_.quantity == ChartAxis::Quantity::number) return power_of_ten(exponent);
    static constexpr std::array<std::string_view, 4> units = {"ns", "µs", "ms", "s"};
    const int unit = std::clamp(exponent / 3, 0, 3);
    return fmt::format("{:g} {}", std::pow(10.0, exponent - 3 * unit),
                       units[static_cast<std::size_t>(unit)]);
  }
  bool is_horizontal() const { return to_ > from_; }

  ChartAxis axis_;
  double floor_;
  std::string floor_label_;
  double from_, to_;
  double low_ = 0, high_ = 1, step_ = 1;
  int first_ = 0, last_ = 1;
};

/// Corners of a marker about the origin, radius 1; empty: a circle.
std::vector<std::pair<double, double>> marker_corners(std::size_t shape) {
  const auto regular = [](int n, double turn) {
    std::vector<std::pair<double, double>> corners;
    for (int k = 0; k < n; ++k) {
      const double angle = std::numbers::pi * (turn + 2.0 * k / n);
      corners.emplace_back(1.15 * std::cos(angle), 1.15 * std::sin(angle));
    }
    return corners;
  };
  switch (shape % 9) {
    case 1:
      return regular(4, 0.25);  // square
    case 2:
      return regular(3, -0.5);  // triangle, up
    case 3:
      return regular(4, 0);  // diamond
    case 4:
      return regular(3, 0.5);  // triangle, down
    case 5:
      return {{-0.4, -1.1}, {0.4, -1.1}, {0.4, -0.4}, {1.1, -0.4}, {1.1, 0.4},   {0.4, 0.4},
              {0.4, 1.1},   {-0.4, 1.1}, {-0.4, 0.4}, {-1.1, 0.4}, {-1.1, -0.4}, {-0.4, -0.4}};
    case 6:
      return regular(3, 0);  // triangle, right
    case 7:
      return {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};  // hourglass
    case 8:
      return regular(3, 1);  // triangle, left
    default:
      return {};
  }
}

std::string marker(std::size_t series, double x, double y, bool hollow) {
  const std::string_view colour = series_colour(series);
  const std::string paint =
      hollow ? fmt::format("{} stroke=\"{}\" stroke-width=\"1.8\"", fill(Tone::ground), colour)
             : fmt::format(" fill=\"{0}\" stroke=\"{0}\" stroke-width=\"1.8\"", colour);
  constexpr double radius = 4.6;
  const auto corners = marker_corners(series);
  if (corners.empty())
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"{}/>", x, y, radius, paint);
  std::string points;
  for (const auto& [dx, dy] : corners)
    points += fmt::format("{:.1f},{:.1f} ", x + radius * dx, y + radius * dy);
  return fmt::format("<polygon points=\"{}\"{}/>", points, paint);
}

std::vector<double> all(const Chart& chart, double ChartPoint::*coordinate) {
  std::vector<double> values;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) values.push_back(point.*coordinate);
  return values;
}

/// A chart on its way to text.
class Drawing {
 public:
  explicit Drawing(const Chart& chart)
      : chart_(chart),
        right_(width - (chart.series.size() > 1 ? legend_width : 24)),
        x_(chart.x, all(chart, &ChartPoint::x), left, right_),
        y_(chart.y, all(chart, &ChartPoint::y), bottom, top, chart.floor, chart.floor_label) {}

  std::string svg() {
    text_ = svg_opening(width, height, chart_.title);
    text_ += svg_text(left, 26, chart_.title, Anchor::start, Tone::ink, 15);
    grid();
    if (chart_.zero_line) line(left, y_(0), right_, y_(0), Tone::ink, "");
    for (const ChartMark& mark : chart_.marks) draw(mark);
    for (std::size_t k = 0; k < chart_.series.size(); ++k) draw_line(k);
    for (std::size_t k = 0; k < chart_.series.size(); ++k) draw_markers(k);
    if (chart_.series.size() > 1) legend();
    return text_ + "</svg>\n";
  }

 private:
  void line(double x1, double y1, double x2, double y2, Tone tone, const char* extra) {
    text_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"{}{}/>\n",
                         x1, y1, x2, y2, stroke(tone), extra);
  }

  void grid() {
    for (const Tick& tick : x_.ticks()) {
      const double x = x_(tick.value);
      line(x, top, x, bottom, Tone::grid, "");
      text_ += svg_text(x, bottom + 19, tick.label, Anchor::middle, Tone::quiet);
    }
    for (const Tick& tick : y_.ticks()) {
      const double y = y_(tick.value);
      line(left, y, right_, y, Tone::grid, "");
      text_ += svg_text(left - 8, y + 4.5, tick.label, Anchor::end, Tone::quiet);
    }
    line(left, bottom, right_, bottom, Tone::quiet, "");
    line(left, top, left, bottom, Tone::quiet, "");
    text_ += svg_text(0.5 * (left + right_), height - 12, chart_.x.title, Anchor::middle);
    text_ += fmt::format("<g transform=\"translate(18 {:.1f}) rotate(-90)\">{}</g>\n",
                         0.5 * (top + bottom), svg_text(0, 0, chart_.y.title, Anchor::middle));
  }

  void draw(const ChartMark& mark) {
    const double x = x_(mark.x);
    line(x, top, x, bottom, Tone::quiet, " stroke-dasharray=\"3 4\"");
    text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"{} stroke-width=\"1.6\"{}/>\n",
                         x, y_(mark.y), stroke(Tone::ink), " fill=\"none\"");
    text_ += svg_text(x + 7, top + 14, mark.label);
  }

  bool is_shown(const ChartPoint& point) const {
    return x_.is_shown(point.x) && y_.is_shown(point.y);
  }

  void draw_line(std::size_t k) {
    const ChartSeries& series = chart_.series[k];
    std::string points;
    for (const ChartPoint& point : series.points)
      if (is_shown(point)) points += fmt::format("{:.2f},{:.2f} ", x_(point.x), y_(point.y));
    text_ += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-linejoin=\"round\"/>\n",
        points, series_colour(k), series.markers ? "1.4\" stroke-opacity=\"0.6" : "2.2");
  }

  void draw_markers(std::size_t k) {
    if (!chart_.series[k].markers) return;
    for (const ChartPoint& point : chart_.series[k].points)
      if (is_shown(point))
        text_ +=
            fmt::format("<g>{}<title>{}</title></g>\n",
                        marker(k, x_(point.x), y_(point.y), point.hollow), escaped(point.note));
  }

  void legend() {
    double y = top + 8;
    const double x = right_ + 22;
    for (std::size_t k = 0; k < chart_.series.size(); ++k, y += 23) {
      text_ += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\" stroke=\"{3}\" "
          "stroke-width=\"1.6\"/>\n",
          x - 8, y, x + 16, series_colour(k));
      if (chart_.series[k].markers) text_ += marker(k, x + 4, y, false) + "\n";
      text_ += svg_text(x + 24, y + 4.5, chart_.series[k].name);
    }
    y += 10;
    for (const std::string& note : chart_.notes) {
      text_ += svg_text(x - 8, y, note, Anchor::start, Tone::quiet, 12);
      y += 17;
    }
  }

  const Chart& chart_;
  double right_;
  Scale x_, y_;
  std::string text_;
};

}  // namespace

std::string chart_svg(const Chart& chart) {
  return Drawing(chart).svg();
}

std::string power_of_ten(int exponent) {
  static constexpr std::array<std::string_view, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                              "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent == 0) return "1";
  if (exponent == 1) return "10";
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
    text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace vitrel
