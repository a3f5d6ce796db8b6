#pragma once

#include <limits>
#include <string>
#include <vector>

/// Charts as SVG, each a file of its own that needs nothing beside it.
namespace vitrel {

struct ChartPoint {
  double x = 0, y = 0;
  bool hollow = false;  ///< drawn as an outline
  std::string note;     ///< shown when pointed at
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;  ///< joined in this order
  bool markers = true;
};

struct ChartAxis {
  enum class Quantity { number, nanoseconds };  ///< nanoseconds are labelled 10 ns, 1 µs, 1 ms
  std::string title;
  bool logarithmic = false;
  Quantity quantity = Quantity::number;
};

/// A place on a curve with a label and a line down to the horizontal axis.
struct ChartMark {
  double x = 0, y = 0;
  std::string label;
};

struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartSeries> series;
  std::vector<ChartMark> marks;
  std::vector<std::string> notes;  ///< lines below the legend
  /// On a logarithmic vertical axis: where 0 and whatever is smaller is drawn, labelled "≤".
  double floor = 0;
  std::string floor_label;  ///< there instead of "≤ 10⁻¹²"
  bool zero_line = false;
};

/// The axes cover all finite points: whole decades if logarithmic, else round numbers. Points that
/// are not finite are left out. With one series there is no legend.
std::string chart_svg(const Chart& chart);

/// 1e-12 as "10⁻¹²".
std::string power_of_ten(int exponent);

}  // namespace vitrel
