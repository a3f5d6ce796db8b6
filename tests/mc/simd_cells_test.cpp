#include "mc/simd_cells.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/contact/ellipse_batch.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

using Cells = SimdCells<EllipseBatch>;
using Index = Cells::Index;

/// Particles of a cell, read group by group; every one where its place says, and no lane besides.
std::set<Index> particles_in(Cells& cells, std::size_t cell) {
  std::set<Index> found;
  std::size_t at = cell;
  while (at != Cells::none) {
    const Cells::Group& group = cells[at];
    EXPECT_EQ(group.cell, cell);
    if (group.next != Cells::none) {
      EXPECT_EQ(group.count, simd_width);
    }
    for (int lane = 0; lane < simd_width; ++lane) {
      if (lane >= group.count) {
        EXPECT_EQ(group.x[lane], EllipseBatch::far_away);
        continue;
      }
      const Index i = group.particle[lane];
      EXPECT_EQ(cells.group_index(i), at);
      EXPECT_EQ(cells.lane_of(i), lane);
      EXPECT_EQ(group.position(lane), Vec2(i, -static_cast<double>(i)));
      EXPECT_EQ(group.shape(lane).a, 2.0 + i);
      found.insert(i);
    }
    at = group.next;
  }
  return found;
}

// Two domains of particles that wander among their cells, crowding into one of them now and then:
// always where they were put last, and the free groups suffice.
TEST(SimdCells, KeepTrackOfEverybody) {
  constexpr std::size_t cells_of_domain = 5;
  const std::vector<std::size_t> begin = {0, 23, 41};
  const std::size_t n = begin.back();
  Cells cells;
  cells.resize(2 * cells_of_domain, n);
  for (std::size_t cell = 0; cell < 2 * cells_of_domain; ++cell) cells.clear(cell);
  std::vector<Cells::FreeList> free_list = {cells.free_groups(begin[0], begin[1]),
                                            cells.free_groups(begin[1], begin[2])};
  std::vector<std::size_t> cell_of(n);
  Stream draw(91, Purpose::tests);
  std::size_t crowded = 0;
  const auto put = [&](std::size_t i, std::size_t domain) {
    const bool anywhere = draw.below(3) == 0;
    cell_of[i] = domain * cells_of_domain + (anywhere ? draw.below(cells_of_domain) : crowded);
    cells.insert(i, cell_of[i], OrientedEllipse{{2.0 + static_cast<double>(i), 1}, Vec2(1, 0)},
                 Vec2(static_cast<double>(i), -static_cast<double>(i)), free_list[domain]);
  };
  for (std::size_t domain = 0; domain < 2; ++domain)
    for (std::size_t i = begin[domain]; i < begin[domain + 1]; ++i) put(i, domain);
  std::size_t fullest = 0;
  for (int move = 0; move < 20'000; ++move) {
    if (move % 300 == 0) crowded = draw.below(cells_of_domain);
    const std::size_t domain = draw.below(2);
    const std::size_t i = begin[domain] + draw.below(begin[domain + 1] - begin[domain]);
    cells.remove(i, free_list[domain]);
    put(i, domain);
    if (move % 50 != 0) continue;
    std::map<std::size_t, std::set<Index>> expected;
    for (std::size_t k = 0; k < n; ++k) expected[cell_of[k]].insert(static_cast<Index>(k));
    for (std::size_t cell = 0; cell < 2 * cells_of_domain; ++cell) {
      ASSERT_EQ(particles_in(cells, cell), expected[cell]);
      fullest = std::max(fullest, expected[cell].size());
    }
  }
  EXPECT_GT(fullest, 3u * simd_width);
}

TEST(SimdCells, ExchangePlaces) {
  Cells cells;
  cells.resize(8, 40);
  for (std::size_t cell = 0; cell < 8; ++cell) cells.clear(cell);
  Cells::FreeList free_list = cells.free_groups(0, 40);
  cells.insert(0, 0, OrientedEllipse{{3, 1}, Vec2(1, 0)}, Vec2(1, 2), free_list);
  cells.insert(1, 1, OrientedEllipse{{2, 0.5}, Vec2(0, 1)}, Vec2(5, 6), free_list);
  cells.exchange(0, 1);
  const auto expect_at = [&cells](std::size_t i, std::size_t cell, const Ellipse& shape,
                                  const Vec2& position, const Vec2& axis) {
    const Cells::Group& group = cells.group_of(i);
    const int lane = cells.lane_of(i);
    EXPECT_EQ(group.cell, cell);
    EXPECT_EQ(group.particle[lane], i);
    EXPECT_EQ(group.shape(lane).a, shape.a);
    EXPECT_EQ(group.shape(lane).b, shape.b);
    EXPECT_EQ(group.position(lane), position);
    EXPECT_EQ(group.axis(lane), axis);
  };
  expect_at(0, 1, {3, 1}, Vec2(5, 6), Vec2(0, 1));
  expect_at(1, 0, {2, 0.5}, Vec2(1, 2), Vec2(1, 0));
}

}  // namespace
}  // namespace vitrel
