#include "mc/checkerboard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace vitrel {
namespace {

struct Scene {
  Vec2 lengths;
  double reach;
  std::size_t particles;
};
void PrintTo(const Scene& scene, std::ostream* out) {
  *out << "box " << scene.lengths.x() << " × " << scene.lengths.y() << ", reach " << scene.reach
       << ", " << scene.particles << " particles";
}

class CheckerboardOf : public testing::TestWithParam<Scene> {
 protected:
  CheckerboardOf()
      : box_(GetParam().lengths), board_(box_, GetParam().reach, GetParam().particles) {}

  Vec2 somewhere() {
    const Vec2 half = 0.5 * box_.lengths();
    return {draw_.uniform(-half.x(), half.x()), draw_.uniform(-half.y(), half.y())};
  }
  /// visit(cell index, translation) for all cells near one.
  template <class Visit>
  void for_each_near(const Checkerboard::Cell& cell, Visit&& visit) const {
    for (const Checkerboard::NearLine& column : board_.near_columns(cell.x))
      for (const Checkerboard::NearLine& row : board_.near_rows(cell.y))
        visit(Checkerboard::Cell{column.cell, row.cell}, Vec2(column.translation, row.translation));
  }

  Stream draw_{81, Purpose::tests};
  PeriodicBox<2> box_;
  Checkerboard board_;
};

// Every image within reach of a point lies in one of the cells near its own, seen at that image's
// place, and once only.
TEST_P(CheckerboardOf, WhoeverIsWithinReachIsInANearCellOnce) {
  int met = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec2 one = somewhere();
    Vec2 two = one + GetParam().reach * Vec2(draw_.uniform(-1, 1), draw_.uniform(-1, 1));
    Shift<2> image = Shift<2>::Zero();
    box_.wrap(two, image);
    const std::size_t home = board_.index(board_.cell_of(two));
    std::vector<Vec2> seen;
    for_each_near(board_.cell_of(one),
                  [&](const Checkerboard::Cell& cell, const Vec2& translation) {
                    if (board_.index(cell) == home) seen.push_back(two + translation - one);
                  });
    box_.for_each_image(two - one, GetParam().reach, [&](const Shift<2>&, const Vec2& d) {
      ++met;
      ASSERT_EQ(
          std::ranges::count_if(
              seen, [&](const Vec2& at) { return (at - d).norm() < 1e-9 * d.norm() + 1e-12; }),
          1);
    });
  }
  EXPECT_GT(met, 1000);
}

TEST_P(CheckerboardOf, DomainsShareOutTheCells) {
  for (int k = 0; k < 20; ++k) {
    board_.shift(draw_);
    std::vector<int> found(board_.cells(), 0);
    for (std::size_t domain = 0; domain < board_.domains(); ++domain)
      board_.for_each_cell(domain, [&](std::size_t cell) { ++found[cell]; });
    EXPECT_EQ(std::ranges::count(found, 1), static_cast<std::ptrdiff_t>(board_.cells()));
    std::set<std::size_t> coloured;
    for (const auto& colour : board_.colours()) {
      EXPECT_FALSE(colour.empty());
      coloured.insert(colour.begin(), colour.end());
    }
    EXPECT_EQ(coloured.size(), board_.domains());
  }
}

// What makes turns at the same time safe: no domain looks into another of its colour, in any image.
TEST_P(CheckerboardOf, NoDomainIsNearAnotherOfItsColour) {
  std::map<std::size_t, std::size_t> colour_of;
  for (std::size_t colour = 0; colour < board_.colours().size(); ++colour)
    for (const std::size_t domain : board_.colours()[colour]) colour_of[domain] = colour;
  for (int k = 0; k < 20; ++k) {
    board_.shift(draw_);
    for (int trial = 0; trial < 300; ++trial) {
      const Checkerboard::Cell cell = board_.cell_of(somewhere());
      const std::size_t domain = board_.domain_of(cell);
      for_each_near(cell, [&](const Checkerboard::Cell& other, const Vec2&) {
        const std::size_t its_domain = board_.domain_of(other);
        if (its_domain != domain) {
          ASSERT_NE(colour_of[its_domain], colour_of[domain]);
        }
      });
    }
  }
}

// Two cells side by side are in one domain most of the time, and, if there are several, sometimes in
// two.
TEST_P(CheckerboardOf, EveryBorderMoves) {
  constexpr int shifts = 400;
  const Vec2 half = 0.5 * box_.lengths();
  for (int k = 0; k < 20; ++k) {
    const Vec2 here = somewhere();
    Vec2 beside = here + Vec2(GetParam().reach, 0);
    if (beside.x() >= half.x()) beside.x() -= box_.lengths().x();
    if (beside.x() < -half.x() || beside.x() >= half.x()) return;  // a box of one cell
    int together = 0;
    for (int s = 0; s < shifts; ++s) {
      board_.shift(draw_);
      together +=
          board_.domain_of(board_.cell_of(here)) == board_.domain_of(board_.cell_of(beside));
    }
    EXPECT_GT(together, shifts / 2);
    if (board_.domains() == 1) {
      EXPECT_EQ(together, shifts);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, CheckerboardOf,
                         testing::Values(Scene{{80, 80}, 2.9, 1000}, Scene{{80, 30}, 2.9, 400},
                                         Scene{{24.5, 24.5}, 3, 100}, Scene{{100, 7}, 3, 100},
                                         Scene{{9, 50}, 3, 1000}, Scene{{7, 7}, 3.4, 5},
                                         Scene{{7, 7}, 3.6, 5}, Scene{{2.8, 2.8}, 4.9, 1},
                                         Scene{{1.1, 12}, 4.9, 2}, Scene{{300, 300}, 3, 20}));

}  // namespace
}  // namespace vitrel
