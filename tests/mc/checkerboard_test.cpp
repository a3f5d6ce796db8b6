#include "mc/checkerboard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <variant>
#include <vector>

namespace vitrel {
namespace {

template <int Dim>
struct Scene {
  Vec<Dim> lengths;
  double reach;
  std::size_t particles;
};
template <int Dim>
void PrintTo(const Scene<Dim>& scene, std::ostream* out) {
  *out << "box " << scene.lengths.transpose() << ", reach " << scene.reach << ", "
       << scene.particles << " particles";
}

/// Checks of a checkerboard in one box.
template <int Dim>
class CheckerboardOf {
 public:
  explicit CheckerboardOf(const Scene<Dim>& scene)
      : scene_(scene), box_(scene.lengths), board_(box_, scene.reach, scene.particles) {}

  // Every image within reach of a point lies in one of the cells near its own, seen at that image's
  // place, and once only.
  void find_whoever_is_within_reach() {
    int met = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vec<Dim> one = somewhere();
      Vec<Dim> two = one + scene_.reach * random_vector();
      Shift<Dim> image = Shift<Dim>::Zero();
      box_.wrap(two, image);
      const std::size_t home = board_.index(board_.cell_of(two));
      std::vector<Vec<Dim>> seen;
      for_each_near(board_.cell_of(one), [&](std::size_t cell, const Vec<Dim>& translation) {
        if (cell == home) seen.push_back(two + translation - one);
      });
      box_.for_each_image(two - one, scene_.reach, [&](const Shift<Dim>&, const Vec<Dim>& d) {
        ++met;
        const double rounding = 1e-9 * d.norm() + 1e-12;
        const auto is_there = [&](const Vec<Dim>& at) { return (at - d).norm() < rounding; };
        ASSERT_EQ(std::ranges::count_if(seen, is_there), 1);
      });
    }
    EXPECT_GT(met, 1000);
  }

  void share_out_the_cells() {
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
  void keep_domains_of_a_colour_apart() {
    std::map<std::size_t, std::size_t> colour_of;
    for (std::size_t colour = 0; colour < board_.colours().size(); ++colour)
      for (const std::size_t domain : board_.colours()[colour]) colour_of[domain] = colour;
    for (int k = 0; k < 20; ++k) {
      board_.shift(draw_);
      std::vector<std::size_t> domain_of(board_.cells());
      for (std::size_t d = 0; d < board_.domains(); ++d)
        board_.for_each_cell(d, [&](std::size_t cell) { domain_of[cell] = d; });
      for (int trial = 0; trial < 300; ++trial) {
        const Cell cell = board_.cell_of(somewhere());
        const std::size_t domain = board_.domain_of(cell);
        for_each_near(cell, [&](std::size_t other, const Vec<Dim>&) {
          const std::size_t its_domain = domain_of[other];
          if (its_domain != domain) {
            ASSERT_NE(colour_of[its_domain], colour_of[domain]);
          }
        });
      }
    }
  }

  // Two cells side by side are in one domain most of the time, and, if there are several, sometimes in
  // two.
  void move_every_border() {
    constexpr int shifts = 400;
    const double half = 0.5 * box_.lengths().x();
    for (int k = 0; k < 20; ++k) {
      const Vec<Dim> here = somewhere();
      Vec<Dim> beside = here + scene_.reach * Vec<Dim>::UnitX();
      if (beside.x() >= half) beside.x() -= box_.lengths().x();
      if (beside.x() < -half || beside.x() >= half) return;  // a box of one cell
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

 private:
  using Cell = typename Checkerboard<Dim>::Cell;

  Vec<Dim> somewhere() { return random_vector().cwiseProduct(0.5 * box_.lengths()); }
  Vec<Dim> random_vector() {
    Vec<Dim> v;
    for (double& x : v) x = draw_.uniform(-1, 1);
    return v;
  }
  /// visit(cell index, translation) for all cells near one.
  template <class Visit>
  void for_each_near(const Cell& cell, Visit&& visit) const {
    board_.for_each_near(cell, [&](std::size_t near, const auto& translation) {
      visit(near, Vec<Dim>(translation.data()));
      return true;
    });
  }

  Stream draw_{81, Purpose::tests};
  Scene<Dim> scene_;
  PeriodicBox<Dim> box_;
  Checkerboard<Dim> board_;
};

using AnyScene = std::variant<Scene<2>, Scene<3>>;

class Checkerboards : public testing::TestWithParam<AnyScene> {
 protected:
  template <class Check>
  static void on_the_board(const Check& check) {
    const auto visit = [&]<int Dim>(const Scene<Dim>& scene) {
      CheckerboardOf<Dim> board(scene);
      check(board);
    };
    std::visit(visit, GetParam());
  }
};

TEST_P(Checkerboards, WhoeverIsWithinReachIsInANearCellOnce) {
  on_the_board([](auto& board) { board.find_whoever_is_within_reach(); });
}
TEST_P(Checkerboards, DomainsShareOutTheCells) {
  on_the_board([](auto& board) { board.share_out_the_cells(); });
}
TEST_P(Checkerboards, NoDomainIsNearAnotherOfItsColour) {
  on_the_board([](auto& board) { board.keep_domains_of_a_colour_apart(); });
}
TEST_P(Checkerboards, EveryBorderMoves) {
  on_the_board([](auto& board) { board.move_every_border(); });
}

INSTANTIATE_TEST_SUITE_P(
    Boxes, Checkerboards,
    testing::Values(Scene<2>{{80, 80}, 2.9, 1000}, Scene<2>{{80, 30}, 2.9, 400},
                    Scene<2>{{24.5, 24.5}, 3, 100}, Scene<2>{{100, 7}, 3, 100},
                    Scene<2>{{9, 50}, 3, 1000}, Scene<2>{{7, 7}, 3.4, 5}, Scene<2>{{7, 7}, 3.6, 5},
                    Scene<2>{{2.8, 2.8}, 4.9, 1}, Scene<2>{{1.1, 12}, 4.9, 2},
                    Scene<2>{{300, 300}, 3, 20}, Scene<3>{{25, 25, 25}, 2.9, 1000},
                    Scene<3>{{60, 30, 9}, 3, 400}, Scene<3>{{7, 7, 7}, 3.4, 5},
                    Scene<3>{{2.8, 3, 30}, 4.9, 2}, Scene<3>{{1.1, 12, 5}, 4.9, 2}));

}  // namespace
}  // namespace vitrel
