#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace vitrel::bench {

/// What Calendar might be as well: a tournament among the times. Eight of them, one line of the cache,
/// send the least to the round above, until one line is left. A change goes up only as far as it
/// changes who is least; the earliest is found from the top, the first among equals in every round.
/// Cost: O(log N) for the earliest and if it is changed, O(1) for most others. Memory: 9.2 bytes per
/// particle.
class TournamentCalendar {
 public:
  explicit TournamentCalendar(std::size_t particles) : size_(particles) {
    std::size_t lines = particles;
    do {
      lines = std::max<std::size_t>((lines + width - 1) / width, 1);
      Line empty;
      empty.time.fill(std::numeric_limits<double>::infinity());
      rounds_.emplace_back(lines, empty);
    } while (lines > 1);
  }

  std::size_t size() const { return size_; }
  double time(std::size_t particle) const {
    return rounds_[0][particle / width].time[particle % width];
  }

  std::size_t earliest() const {
    const double least = rounds_.back().front().least();
    std::size_t winner = 0;
    for (std::size_t round = rounds_.size(); round-- > 0;)
      winner = winner * width + rounds_[round][winner].first_at(least);
    return winner;
  }

  void set(std::size_t particle, double time) {
    std::size_t i = particle;
    for (std::size_t round = 0; round + 1 < rounds_.size(); ++round) {
      Line& line = rounds_[round][i / width];
      const double old = line.time[i % width];
      line.time[i % width] = time;
      i /= width;
      const double sent = rounds_[round + 1][i / width].time[i % width];
      if (time < sent) continue;
      if (old > sent) return;
      time = line.least();
      if (time == sent) return;
    }
    rounds_.back().front().time[i] = time;
  }

 private:
  static constexpr std::size_t width = 8;

  struct alignas(64) Line {
    std::array<double, width> time;

    double least() const {
      std::array<double, width> left = time;
      for (std::size_t half = width / 2; half > 0; half /= 2)
        for (std::size_t k = 0; k < half; ++k) left[k] = std::min(left[k], left[k + half]);
      return left[0];
    }
    // Without branches: nobody can foresee them.
    std::size_t first_at(double least) const {
      std::size_t first = width - 1;
      for (std::size_t k = width - 1; k-- > 0;) first = time[k] <= least ? k : first;
      return first;
    }
  };

  std::size_t size_;
  std::vector<std::vector<Line>> rounds_;
};

}  // namespace vitrel::bench
