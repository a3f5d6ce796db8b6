#include "mc/event_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/contact/support_gap.h"
#include "mc/disjoint.h"

namespace vitrel {

namespace {

constexpr double target_gap = 1.5;  // margins

double plus_minus_one(std::uint64_t word) {
  return static_cast<double>((static_cast<std::int64_t>(word) >> 10) | 1) * 0x1p-53;
}

std::size_t pick(std::uint64_t word, std::size_t n) {
  return static_cast<std::size_t>(static_cast<double>(word >> 11) * 0x1p-53 *
                                  static_cast<double>(n));
}

Vec2 axis_at(double angle) {
  Lanes x, y;
  directions<Lanes>({angle, angle}, x, y);
  return {x[0], y[0]};
}

template <int axis>
VITREL_INLINE Many along(const EllipseGroup& g) {
  return axis == 0 ? g.x.all() : g.y.all();
}

/// An ellipse as a chain meets it: at τ = n_y/n_x its support function over n_x is
/// √(c + (τ height + slant)²).
template <class T>
struct Profile {
  T height;  // √Σ_yy
  T slant;   // Σ_xy/height
  T waist;   // a b/height
  VITREL_INLINE Profile(const T& a, const T& b, const T& ux, const T& uy) {
    const T stretch = (a - b) * (a + b);
    using std::sqrt;
    height = sqrt(b * b + stretch * (uy * uy));
    const T inverse = 1. / height;
    slant = stretch * (ux * uy) * inverse;
    waist = a * b * inverse;
  }
};

/// Two ellipses and the line along which the first moves. With v on −1 … 1, c = √(1 − v²) and the
/// direction n = (c, (W v − B c)/H), n·d − h(n) over n_x is concave in n_y/n_x, and largest at the
/// contact. At the enclosing ellipse v = d_y/H.
template <class T>
struct Line {
  T dx, dy;
  T height, slant, waist;    // of the other
  T width, middle, inverse;  // W, B, 1/H

  struct Bound {
    T value;        // no contact before
    T slope, bend;  // dy − p_y, and its derivative by v times −H/W
    T cosine;
  };
  VITREL_INLINE Bound at(const Profile<double>& one, double enlarged, const T& v) const {
    using std::sqrt;
    Bound bound;
    const T c = sqrt(1. - v * v);
    const T ny = (width * v - middle * c) * inverse;
    const T z1 = ny * one.height + c * one.slant, z2 = ny * height + c * slant;
    const T w1 = one.waist * c, w2 = waist * c;
    const T h1 = sqrt(w1 * w1 + z1 * z1), h2 = sqrt(w2 * w2 + z2 * z2);
    const T i1 = 1. / h1, i2 = 1. / h2;
    bound.value = dx + (ny * dy - enlarged * h1 - h2) / c;
    bound.slope = dy - enlarged * one.height * z1 * i1 - height * z2 * i2;
    const double c1 = one.height * one.waist;
    const T c2 = height * waist;
    bound.bend = enlarged * c1 * c1 * (i1 * i1 * i1) + c2 * c2 * (i2 * i2 * i2);
    bound.cosine = c;
    return bound;
  }
};

double contact_alone(const Profile<double>& one, double enlarged, const Line<double>& line) {
  double low = -1, high = 1, best = -std::numeric_limits<double>::infinity();
  double v = line.dy * line.inverse;
  for (int step = 0; step < 200; ++step) {
    const auto bound = line.at(one, enlarged, v);
    if (bound.value > best) best = bound.value;
    (bound.slope > 0 ? low : high) = v;
    double next = v + bound.slope / (bound.bend * line.width * line.inverse);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == v || next == low || next == high) break;
    v = next;
  }
  return best;
}

}  // namespace

EventChain::EventChain(Configuration2& configuration, std::uint64_t seed, std::uint64_t first_sweep)
    : configuration_(configuration),
      largest_(largest_circumradius(configuration)),
      largest_swing_(0),
      margin_(hard_margin(configuration)),
      half_box_(0.5 * configuration.box.lengths()),
      all_round_(true),
      seed_(seed),
      sweep_(first_sweep) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    axis_.push_back(axis_at(configuration.angle[i]));
    all_round_ = all_round_ && configuration.shape[i].is_round();
    largest_swing_ = std::max(largest_swing_, configuration.shape[i].swing());
  }
  board_.emplace(configuration_.box, 2 * (largest_ + 2 * margin_), configuration_.size());
  arrange();
}

void EventChain::arrange() {
  const std::size_t n = configuration_.size();
  cells_.resize(board_->cells(), n);
  for (std::size_t cell = 0; cell < board_->cells(); ++cell) cells_.clear(cell);
  spare_ = cells_.spare_groups(0, n);
  for (std::size_t i = 0; i < n; ++i)
    cells_.insert(i, board_->index(board_->cell_of(configuration_.position[i])),
                  configuration_.shape[i], configuration_.position[i], axis_[i], spare_);
}

void EventChain::sweep() {
  Stream draw(seed_, Purpose::trial_moves, sweep_, 0);
  std::uint64_t rotations = 0;
  for (std::uint64_t k = 0; k < plan_.chains; ++k) {
    Stream::Block words;
    draw.fill({&words, 1});
    const std::size_t i = pick(words[0], configuration_.size());
    (words[3] & 1) == 0 ? run_chain<0>(i) : run_chain<1>(i);
    if (all_round_) continue;
    for (const std::uint64_t until = (k + 1) * plan_.rotations / plan_.chains; rotations < until;
         ++rotations) {
      draw.fill({&words, 1});
      rotate(pick(words[0], configuration_.size()), words[1]);
    }
  }
  ++sweep_;
}

template <int axis>
void EventChain::run_chain(std::size_t i) {
  double remaining = plan_.length;
  counts_.length += remaining;
  while (true) {
    const Path path =
        all_round_ ? free_path_round<axis>(i, remaining) : free_path<axis>(i, remaining);
    advance<axis>(i, path.length);
    remaining -= path.length;
    if (path.next != LaneCells::none) {
      ++counts_.contacts;
      counts_.virial += path.between;
      i = path.next;
    } else {
      if (!(remaining > 0)) return;
      ++counts_.crossings;
    }
  }
}

template <int axis>
VITREL_INLINE void EventChain::advance(std::size_t i, double length) {
  LaneCells::Group& group = cells_.group_of(i);
  const int lane = cells_.lane_of(i);
  Vec2& position = configuration_.position[i];
  position[axis] += length;
  if (position[axis] >= half_box_[axis]) configuration_.box.wrap(position, configuration_.image[i]);
  const std::size_t cell = board_->index(board_->cell_of(position));
  if (group.cell == cell) {
    (axis == 0 ? group.x : group.y)[lane] = position[axis];
  } else {
    const Ellipse shape = group.shape(lane);
    cells_.remove(i, spare_);
    cells_.insert(i, cell, shape, position, axis_[i], spare_);
  }
}

template <int axis>
EventChain::Path EventChain::free_path_round(std::size_t i, double remaining) const {
  constexpr int other = 1 - axis;
  const Vec2 position = configuration_.position[i];
  const Checkerboard::Cell cell = board_->cell_of(position);
  const double end = board_->corner(cell)[axis] + board_->cell_size()[axis];
  const double limit =
      end - position[axis] + 8 * std::numeric_limits<double>::epsilon() * 2 * half_box_[axis];
  const double radius = configuration_.shape[i].a + target_gap * margin_;
  const auto ahead = axis == 0 ? board_->near_column(cell.x) : board_->near_row(cell.y);
  const auto aside = axis == 0 ? board_->near_row(cell.y) : board_->near_column(cell.x);
  const Many start(std::min(limit, remaining));
  Many best = start, place(-1), between(0);
  const Many lanes = detail::lane_numbers<many>;
  const std::size_t own = cells_.group_index(i);
  const auto own_lane = static_cast<std::size_t>(cells_.lane_of(i));
  for (std::size_t k = 0; k < ahead.size(); k = k == 0 ? 1 : k + 2)
    for (const Checkerboard::Near& row : aside) {
      std::size_t at = axis == 0 ? board_->index(ahead[k].cell, row.cell)
                                 : board_->index(row.cell, ahead[k].cell);
      const double shift = ahead[k].translation - position[axis];
      const double shift_aside = row.translation - position[other];
      do {
        const LaneCells::Group& group = cells_[at];
        const Many dx = along<axis>(group) + shift, dy = along<other>(group) + shift_aside;
        const Many reach = group.a.all() + radius;
        const Many room = reach * reach - dy * dy;
        const Many s = dx - sqrt(max(room, Many(0)));
        auto hit = room > 0 && dx > 0 && s < best;
        if (at == own) hit[own_lane] = false;
        where(hit, best) = s;
        where(hit, between) = dx - s;
        where(hit, place) = lanes + static_cast<double>(at * many);
        at = group.next;
      } while (at != LaneCells::none);
    }
  const double length = hmin(best);
  const int lane = find_first_set(best == length);
  if (place[lane] < 0) return {length, LaneCells::none, 0};
  const auto found = static_cast<std::size_t>(static_cast<double>(place[lane]));
  return {std::max(length, 0.), cells_[found / many].particle[found % many], between[lane]};
}

struct EventChain::Candidates {
  static constexpr int most = 64;
  alignas(32) double dx[most], dy[most], height[most], slant[most], waist[most], width[most],
      low[most];
  LaneCells::Index who[most];
  int count = 0;
};

template <int axis>
EventChain::Path EventChain::free_path(std::size_t i, double remaining) {
  constexpr int other = 1 - axis;
  const Vec2 position = configuration_.position[i];
  const Ellipse shape = configuration_.shape[i];
  const Checkerboard::Cell cell = board_->cell_of(position);
  const Vec2 corner = board_->corner(cell), size = board_->cell_size();
  const double limit = corner[axis] + size[axis] - position[axis] +
                       8 * std::numeric_limits<double>::epsilon() * 2 * half_box_[axis];
  const double enlarged = 1 + target_gap * margin_ / shape.b;
  const Profile<double> one(shape.a, shape.b, axis_[i][axis], axis_[i][other]);
  const double height1 = enlarged * one.height, slant1 = enlarged * one.slant,
               waist1 = enlarged * one.waist;
  const double girth1 = (slant1 * one.slant + waist1 * one.waist) / one.height;
  const double inner_to_corner = position[axis] - corner[axis],
               aside_to_corner = position[other] - corner[other];
  const bool look_back = inner_to_corner < std::abs(slant1) + largest_swing_;
  const double extent = height1 + largest_;
  const bool look_below = aside_to_corner < extent;
  const bool look_above = size[other] - aside_to_corner < extent;
  const auto ahead = axis == 0 ? board_->near_column(cell.x) : board_->near_row(cell.y);
  const auto aside = axis == 0 ? board_->near_row(cell.y) : board_->near_column(cell.x);

  const double start = std::min(limit, remaining);
  double best = start;
  Path path{start, LaneCells::none, 0};
  Candidates list;

  const auto settle = [&] {
    for (int first = 0; first < list.count;) {
      // The next four that can be the first.
      alignas(32) double dx[many], dy[many], height[many], slant[many], waist[many], width[many];
      LaneCells::Index who[many];
      int count = 0;
      for (; first < list.count && count < many; ++first) {
        if (!(list.low[first] < best)) continue;
        dx[count] = list.dx[first], dy[count] = list.dy[first];
        height[count] = list.height[first], slant[count] = list.slant[first];
        waist[count] = list.waist[first], width[count] = list.width[first];
        who[count] = list.who[first];
        ++count;
      }
      if (count == 0) break;
      for (int k = count; k < many; ++k) {
        dx[k] = dx[0], dy[k] = dy[0], height[k] = height[0], slant[k] = slant[0];
        waist[k] = waist[0], width[k] = width[0];
      }
      using std::experimental::vector_aligned;
      const Many other_height(height, vector_aligned), other_slant(slant, vector_aligned);
      const Line<Many> line{Many(dx, vector_aligned),
                            Many(dy, vector_aligned),
                            other_height,
                            other_slant,
                            Many(waist, vector_aligned),
                            Many(width, vector_aligned),
                            slant1 + other_slant,
                            1. / (height1 + other_height)};
      Many v = line.dy * line.inverse;
      Many bound(-std::numeric_limits<double>::infinity());
      Many::mask_type open(true);
      const double enough = 0.5 * margin_;  // twice a quarter
      for (int step = 0; step < 6; ++step) {
        const auto now = line.at(one, enlarged, v);
        where(now.value > bound, bound) = now.value;
        open = !(now.slope * now.slope <=
                 enough * now.bend * (now.cosine * now.cosine * now.cosine)) &&
               bound < best;
        if (none_of(open)) break;
        v = min(max(v + now.slope / (now.bend * line.width * line.inverse), 0.5 * (v - 1.)),
                0.5 * (v + 1.));
      }
      for (int lane = 0; lane < count; ++lane) {
        double found = bound[lane];
        if (!(found < best)) continue;
        if (open[lane]) {
          ++counts_.alone;
          found = std::max(found, contact_alone(one, enlarged,
                                                {dx[lane], dy[lane], height[lane], slant[lane],
                                                 waist[lane], width[lane], slant1 + slant[lane],
                                                 1 / (height1 + height[lane])}));
          if (!(found < best)) continue;
        }
        best = found;
        path = {std::max(found, 0.), who[lane], dx[lane] - std::max(found, 0.)};
      }
    }
    list.count = 0;
  };

  double least_upper = start;
  const std::size_t own = cells_.group_index(i);
  const auto own_lane = static_cast<std::size_t>(cells_.lane_of(i));
  for (std::size_t column = 0; column < ahead.size(); ++column) {
    if (ahead.size() == 3 && column == 2 && !look_back) continue;
    for (std::size_t row = 0; row < aside.size(); ++row) {
      if (aside.size() == 3 && ((row == 1 && !look_above) || (row == 2 && !look_below))) continue;
      std::size_t at = axis == 0 ? board_->index(ahead[column].cell, aside[row].cell)
                                 : board_->index(aside[row].cell, ahead[column].cell);
      const double shift = ahead[column].translation - position[axis];
      const double shift_aside = aside[row].translation - position[other];
      do {
        const LaneCells::Group& group = cells_[at];
        const Many dx = along<axis>(group) + shift, dy = along<other>(group) + shift_aside;
        const Many ux = axis == 0 ? group.ux.all() : group.uy.all();
        const Many uy = axis == 0 ? group.uy.all() : group.ux.all();
        const Profile<Many> two(group.a.all(), group.b.all(), ux, uy);
        const Many height = height1 + two.height;
        const Many inverse = 1. / height, inverse2 = 1. / two.height;
        const Many slant = slant1 + two.slant;
        const Many t = dy * inverse;
        const Many cut = 1. - t * t;
        const Many middle = slant * t;
        Many::mask_type open = cut > 0 && dx > middle;
        if (at == own) open[own_lane] = false;
        const Many girth = girth1 + (two.slant * two.slant + two.waist * two.waist) * inverse2;
        const Many width2 = max(girth * height - slant * slant, Many(0));
        const Many ahead_of_middle = dx - middle;
        const Many low = ahead_of_middle - sqrt(width2 * max(cut, Many(0)));
        open = open && low < least_upper;
        if (any_of(open)) {
          const Many upper = ahead_of_middle - (waist1 + two.waist) * sqrt(max(cut, Many(0)));
          const Many width = sqrt(width2);
          for (int lane = 0; lane < many; ++lane) {
            if (!open[lane]) continue;
            if (list.count == Candidates::most) settle();
            const int n = list.count++;
            list.dx[n] = dx[lane], list.dy[n] = dy[lane];
            list.height[n] = two.height[lane], list.slant[n] = two.slant[lane];
            list.waist[n] = two.waist[lane], list.width[n] = width[lane], list.low[n] = low[lane];
            list.who[n] = group.particle[lane];
            least_upper = std::min<double>(least_upper, upper[lane]);
          }
        }
        at = group.next;
      } while (at != LaneCells::none);
    }
  }
  // Only those whose lower bound is below everybody's upper bound can be the first.
  int kept = 0;
  for (int n = 0; n < list.count; ++n) {
    if (!(list.low[n] <= least_upper)) continue;
    list.dx[kept] = list.dx[n], list.dy[kept] = list.dy[n], list.height[kept] = list.height[n];
    list.slant[kept] = list.slant[n], list.waist[kept] = list.waist[n],
    list.width[kept] = list.width[n];
    list.low[kept] = list.low[n], list.who[kept] = list.who[n];
    ++kept;
  }
  list.count = kept;
  settle();
  return path;
}

void EventChain::rotate(std::size_t i, std::uint64_t word) {
  const Ellipse shape = configuration_.shape[i];
  if (shape.is_round()) return;
  const double angle = configuration_.angle[i] + rotation_.size() * plus_minus_one(word);
  const Vec2 axis = axis_at(angle), position = configuration_.position[i];
  ++counts_.rotations_tried;
  if (!clear_of_others(i, OverlapLook(shape, axis, margin_), position)) return;
  if (2 * half_box_.minCoeff() < 2 * shape.circumradius() + margin_ &&
      !clear_of_own_images(configuration_.box, shape, axis, margin_))
    return;
  ++counts_.rotations_accepted;
  configuration_.angle[i] = angle;
  axis_[i] = axis;
  LaneCells::Group& group = cells_.group_of(i);
  const int lane = cells_.lane_of(i);
  group.ux[lane] = axis.x();
  group.uy[lane] = axis.y();
}

bool EventChain::clear_of_others(std::size_t i, const OverlapLook& look,
                                 const Vec2& position) const {
  const std::size_t own = cells_.group_index(i);
  const OverlapLook::Asked all(true);
  OverlapLook::Asked others(true);
  others[static_cast<std::size_t>(cells_.lane_of(i))] = false;
  const Checkerboard::Cell cell = board_->cell_of(position);
  std::uint64_t alone = 0;
  for (const Checkerboard::Near& column : board_->near_column(cell.x))
    for (const Checkerboard::Near& row : board_->near_row(cell.y)) {
      const Vec2 offset = Vec2(column.translation, row.translation) - position;
      std::size_t at = board_->index(column.cell, row.cell);
      do {
        const LaneCells::Group& group = cells_[at];
        if (!look.clear_of(group, offset, at == own ? others : all, alone)) return false;
        at = group.next;
      } while (at != LaneCells::none);
    }
  return true;
}

void EventChain::tune() {
  rotation_.tune(counts_.rotations_tried, counts_.rotations_accepted, 100, std::numbers::pi / 2);
}

}  // namespace vitrel
