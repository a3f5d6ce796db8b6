#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/elementary.h"
#include "core/parallel.h"

/// @file
/// Piecewise Chebyshev approximation of a smooth function on a box by polynomials on panels, which are halved until
/// they meet a tolerance.
///
/// On a panel, with every variable scaled to −1 … 1, the function is Σ c_ijk T_i(x) T_j(y) T_k(z), i, j, k < Nodes,
/// which interpolates it at the zeros of T_Nodes. Steps of the construction, level by level:
///   1. Interpolate on each panel, and compare with the function at points of the grid where |T_Nodes| = 1 in every
///      variable: there the error is largest where the series converges.
///   2. If all values are within the tolerance, keep the panel. Otherwise halve it in the variable whose highest
///      coefficients are largest, unless it would become narrower than the minimum width.
///   3. Panels that still exceed the tolerance have no value.
/// The panels depend on the function and the options, not on the number of threads.
///
/// Validity: the error is not controlled between the test points; measure it (docs/validation.md).
namespace vitrel {

template <int Dim>
struct Box {
  std::array<double, Dim> low, high;

  bool contains(const std::array<double, Dim>& x) const {
    for (int axis = 0; axis < Dim; ++axis)
      if (!(x[axis] >= low[axis] && x[axis] <= high[axis])) return false;
    return true;
  }
};

struct PanelOptions {
  double tolerance = 1e-8;  ///< absolute, of each value
  double min_width = 0.02;

  bool operator==(const PanelOptions&) const = default;
};

template <int Dim, int Nodes, int Values>
class ChebyshevPanels {
 public:
  using Bounds = Box<Dim>;
  using Point = std::array<double, Dim>;
  using Value = std::array<double, Values>;
  using Function = std::function<Value(const Point&)>;

  /// The lower half of an inner node is at `next`, and the upper half follows it. A leaf has panel number `next`, or no
  /// panel if that is −1.
  struct Node {
    double middle = 0;
    std::int32_t axis = -1;
    std::int32_t next = -1;
  };
  /// The stored form: the tree with its root first, and for each panel the middle and 2/width of each side, followed by
  /// the coefficients, with the values of each polynomial term side by side.
  struct Content {
    std::vector<Node> nodes;
    std::vector<double> panels;
  };

  ChebyshevPanels(const Box<Dim>& box, const Function& function, const PanelOptions& options,
                  int threads);
  ChebyshevPanels(const Box<Dim>& box, Content content) : box_(box), content_(std::move(content)) {}

  /// Returns no value outside the box, or where the tolerance is not met.
  std::optional<Value> operator()(const Point& x) const;

  const Content& content() const { return content_; }
  std::size_t size() const { return content_.panels.size() / panel_size; }
  std::size_t bytes() const {
    return content_.panels.size() * sizeof(double) + content_.nodes.size() * sizeof(Node);
  }
  /// Returns whether the content is a valid tree; a file may contain anything.
  static bool is_valid(const Content& content);

 private:
  static constexpr int terms = power(Nodes, Dim);
  static constexpr int coefficient_count = terms * Values;
  static constexpr int row_size = Nodes * Values;  // size of all powers of the last variable
  static constexpr int head_size = 2 * Dim;        // centre and scale, before the coefficients
  static constexpr int panel_size = head_size + coefficient_count;
  static constexpr int test_points = 16 * Dim * Dim;

  struct Trial {
    std::vector<double> panel;
    bool accepted = false;
    int axis = 0;  // the variable to halve
  };
  struct Open {
    std::int32_t node;
    Box<Dim> box;
  };

  static std::array<double, Nodes> chebyshev(double x);
  static Value sum(const double* panel, const Point& x);
  static Point at(const Box<Dim>& box, const Point& scaled);
  static Trial interpolate(const Box<Dim>& box, const Function& function, double tolerance);
  static std::vector<double> sample(const Box<Dim>& box, const Function& function);
  static void transform(double* values, std::ptrdiff_t stride);
  static double tail(const std::vector<double>& coefficients, int stride);
  static bool agrees(const Box<Dim>& box, const Function& function, const double* panel,
                     double tolerance);
  void settle(const Open& open, const Trial& trial, const PanelOptions& options,
              std::vector<Open>& next);

  Box<Dim> box_;
  Content content_;
};

template <int Dim, int Nodes, int Values>
ChebyshevPanels<Dim, Nodes, Values>::ChebyshevPanels(const Box<Dim>& box, const Function& function,
                                                     const PanelOptions& options, int threads)
    : box_(box), content_{{Node{}}, {}} {
  std::vector<Open> level{{0, box}};
  while (!level.empty()) {
    std::vector<Trial> trials(level.size());
    each_in_parallel(level.size(), threads, [&](std::size_t k) {
      trials[k] = interpolate(level[k].box, function, options.tolerance);
    });
    std::vector<Open> next;
    for (std::size_t k = 0; k < level.size(); ++k) settle(level[k], trials[k], options, next);
    level = std::move(next);
  }
}

template <int Dim, int Nodes, int Values>
void ChebyshevPanels<Dim, Nodes, Values>::settle(const Open& open, const Trial& trial,
                                                 const PanelOptions& options,
                                                 std::vector<Open>& next) {
  auto& [nodes, panels] = content_;
  if (trial.accepted) {
    nodes[open.node].next = static_cast<std::int32_t>(size());
    panels.insert(panels.end(), trial.panel.begin(), trial.panel.end());
    return;
  }
  const double low = open.box.low[trial.axis], high = open.box.high[trial.axis];
  if (high - low < 2 * options.min_width) return;
  const auto child = static_cast<std::int32_t>(nodes.size());
  nodes[open.node] = {(low + high) / 2, trial.axis, child};
  nodes.resize(nodes.size() + 2);
  next.insert(next.end(), {{child, open.box}, {child + 1, open.box}});
  next[next.size() - 2].box.high[trial.axis] = (low + high) / 2;
  next[next.size() - 1].box.low[trial.axis] = (low + high) / 2;
}

template <int Dim, int Nodes, int Values>
std::array<double, Nodes> ChebyshevPanels<Dim, Nodes, Values>::chebyshev(double x) {
  std::array<double, Nodes> t;
  t[0] = 1;
  t[1] = x;
  for (int k = 2; k < Nodes; ++k) t[k] = 2 * x * t[k - 1] - t[k - 2];
  return t;
}

template <int Dim, int Nodes, int Values>
auto ChebyshevPanels<Dim, Nodes, Values>::sum(const double* panel, const Point& x) -> Value {
  std::array<std::array<double, Nodes>, Dim> t;
  for (int axis = 0; axis < Dim; ++axis)
    t[axis] = chebyshev((x[axis] - panel[axis]) * panel[Dim + axis]);
  // All powers and values along the last variable are summed at once.
  using Row = Eigen::Matrix<double, row_size, 1>;
  const double* row = panel + head_size;
  Row rows = Row::Zero();
  for (int i = 0; i < terms / Nodes; ++i, row += row_size) {
    double weight = 1;
    if constexpr (Dim >= 2) weight = t[Dim - 2][i % Nodes];
    if constexpr (Dim == 3) weight *= t[0][i / Nodes];
    rows += weight * Eigen::Map<const Row>(row);
  }
  Value value{};
  for (int k = 0; k < Nodes; ++k)
    for (int v = 0; v < Values; ++v) value[v] += t[Dim - 1][k] * rows[k * Values + v];
  return value;
}

template <int Dim, int Nodes, int Values>
auto ChebyshevPanels<Dim, Nodes, Values>::operator()(const Point& x) const -> std::optional<Value> {
  if (!box_.contains(x)) return {};
  const Node* node = content_.nodes.data();
  while (node->axis >= 0)
    node = &content_.nodes[node->next + (x[node->axis] > node->middle ? 1 : 0)];
  if (node->next < 0) return {};
  return sum(&content_.panels[static_cast<std::size_t>(node->next) * panel_size], x);
}

template <int Dim, int Nodes, int Values>
auto ChebyshevPanels<Dim, Nodes, Values>::at(const Box<Dim>& box, const Point& scaled) -> Point {
  Point x;
  for (int axis = 0; axis < Dim; ++axis) {
    const double middle = (box.low[axis] + box.high[axis]) / 2;
    x[axis] = middle + scaled[axis] * (box.high[axis] - middle);
  }
  return x;
}

template <int Dim, int Nodes, int Values>
std::vector<double> ChebyshevPanels<Dim, Nodes, Values>::sample(const Box<Dim>& box,
                                                                const Function& function) {
  std::vector<double> values;
  values.reserve(coefficient_count);
  for (int term = 0; term < terms; ++term) {
    Point scaled;
    for (int axis = Dim - 1, rest = term; axis >= 0; --axis, rest /= Nodes)
      scaled[axis] = cosine_and_sine(std::numbers::pi * (rest % Nodes + 0.5) / Nodes).cosine;
    const Value value = function(at(box, scaled));
    values.insert(values.end(), value.begin(), value.end());
  }
  return values;
}

// Turns values at the zeros of T_Nodes, `stride` apart, into coefficients.
template <int Dim, int Nodes, int Values>
void ChebyshevPanels<Dim, Nodes, Values>::transform(double* values, std::ptrdiff_t stride) {
  std::array<double, Nodes> coefficients{};
  for (int j = 0; j < Nodes; ++j)
    for (int i = 0; i < Nodes; ++i)
      coefficients[j] += (j == 0 ? 1.0 : 2.0) / Nodes * values[i * stride] *
                         cosine_and_sine(std::numbers::pi * j * (i + 0.5) / Nodes).cosine;
  for (int j = 0; j < Nodes; ++j) values[j * stride] = coefficients[j];
}

// Returns the largest coefficient of the two highest powers of the variable whose powers are `stride` apart.
template <int Dim, int Nodes, int Values>
double ChebyshevPanels<Dim, Nodes, Values>::tail(const std::vector<double>& coefficients,
                                                 int stride) {
  double largest = 0;
  for (int k = 0; k < coefficient_count; ++k)
    if (k / stride % Nodes >= Nodes - 2) largest = std::max(largest, std::abs(coefficients[k]));
  return largest;
}

template <int Dim, int Nodes, int Values>
bool ChebyshevPanels<Dim, Nodes, Values>::agrees(const Box<Dim>& box, const Function& function,
                                                 const double* panel, double tolerance) {
  // The test points are those of a low-discrepancy lattice (Roberts's generalised golden ratio), moved to the grid.
  constexpr double ratios[] = {1.61803398874989484820, 1.32471795724474602596,
                               1.22074408460575947536};
  const double ratio = ratios[Dim - 1];
  for (int k = 1; k <= test_points; ++k) {
    Point scaled;
    for (int axis = 0; axis < Dim; ++axis) {
      const double along = k / power(ratio, 1 + axis);
      const double node = std::floor((along - std::floor(along)) * (Nodes + 1));
      scaled[axis] = cosine_and_sine(std::numbers::pi * node / Nodes).cosine;
    }
    const Point x = at(box, scaled);
    const Value expected = function(x), found = sum(panel, x);
    for (int v = 0; v < Values; ++v)
      if (!(std::abs(found[v] - expected[v]) <= tolerance)) return false;
  }
  return true;
}

template <int Dim, int Nodes, int Values>
auto ChebyshevPanels<Dim, Nodes, Values>::interpolate(const Box<Dim>& box, const Function& function,
                                                      double tolerance) -> Trial {
  std::vector<double> coefficients = sample(box, function);
  Trial trial;
  double largest_tail = 0;
  for (int stride = Values; stride < coefficient_count; stride *= Nodes)
    for (int k = 0; k < coefficient_count; ++k)
      if (k / stride % Nodes == 0) transform(&coefficients[k], stride);
  for (int axis = Dim - 1, stride = Values; axis >= 0; --axis, stride *= Nodes)
    if (const double of_axis = tail(coefficients, stride); of_axis > largest_tail) {
      largest_tail = of_axis;
      trial.axis = axis;
    }
  for (int axis = 0; axis < Dim; ++axis)
    trial.panel.push_back((box.low[axis] + box.high[axis]) / 2);
  for (int axis = 0; axis < Dim; ++axis)
    trial.panel.push_back(2 / (box.high[axis] - box.low[axis]));
  trial.panel.insert(trial.panel.end(), coefficients.begin(), coefficients.end());
  trial.accepted = agrees(box, function, trial.panel.data(), tolerance);
  return trial;
}

template <int Dim, int Nodes, int Values>
bool ChebyshevPanels<Dim, Nodes, Values>::is_valid(const Content& content) {
  const auto count = static_cast<std::int64_t>(content.nodes.size());
  const auto panels = static_cast<std::int64_t>(content.panels.size() / panel_size);
  if (count == 0 || content.panels.size() % panel_size != 0) return false;
  for (std::int64_t k = 0; k < count; ++k) {
    const Node& node = content.nodes[k];
    const bool leaf = node.axis == -1 && node.next >= -1 && node.next < panels;
    // Children come after their parent, so a traversal ends.
    const bool inner = node.axis >= 0 && node.axis < Dim && node.next > k && node.next + 1 < count;
    if (!leaf && !inner) return false;
  }
  return true;
}

}  // namespace vitrel
