#include "mc/exchanges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrel {

namespace {

template <int Dim>
OrientedBody<Dim> with_shape(const OrientedBody<Dim>& body, const ParticleShape<Dim>& shape) {
  return {shape, axes_of(body)};
}

}  // namespace

template <int Dim>
Exchanges<Dim>::Exchanges(HardParticles<Dim>& particles, const ExchangeOptions& options)
    : particles_(particles), options_(options), by_rank_(particles.configuration().size()) {
  const auto& shapes = particles.configuration().shape;
  std::iota(by_rank_.begin(), by_rank_.end(), Index{0});
  std::ranges::stable_sort(by_rank_, {}, [&](Index i) { return shapes[i].volume(); });
  nested_ = is_nested();
  if (std::ranges::all_of(shapes, [](const auto& shape) { return shape.is_round(); }))
    for (std::size_t rank = 0; rank < by_rank_.size(); ++rank)
      radii_.push_back(shape_of_rank(rank).circumradius());
}

template <int Dim>
const ParticleShape<Dim>& Exchanges<Dim>::shape_of_rank(std::size_t rank) const {
  return particles_.configuration().shape[by_rank_[rank]];
}

template <int Dim>
bool Exchanges<Dim>::is_nested() const {
  for (std::size_t rank = 1; rank < by_rank_.size(); ++rank)
    if (!shape_of_rank(rank - 1).fits_into(shape_of_rank(rank))) return false;
  return true;
}

template <int Dim>
std::uint64_t Exchanges<Dim>::per_sweep(double per_particle) const {
  return static_cast<std::uint64_t>(
      std::llround(per_particle * static_cast<double>(by_rank_.size())));
}

template <int Dim>
void Exchanges<Dim>::rank_domains() {
  const Checkerboard<Dim>& board = particles_.board();
  domain_begin_.assign(1, 0);
  for (std::size_t domain = 0; domain < board.domains(); ++domain)
    domain_begin_.push_back(domain_begin_.back() + particles_.members(domain).size());
  std::vector<std::size_t> next(domain_begin_.begin(), domain_begin_.end() - 1);
  ranked_.resize(by_rank_.size());
  for (const Index i : by_rank_) {
    const Vec<Dim>& position = particles_.configuration().position[i];
    ranked_[next[board.domain_of(board.cell_of(position))]++] = i;
  }
}

template <int Dim>
void Exchanges<Dim>::try_two(std::span<const Index> ranked, const Words& words,
                             ExchangeCounts& counts, OverlapTestCounts& tests) {
  const std::size_t n = ranked.size();
  if (n < 2) return;
  const auto farthest = static_cast<std::size_t>(options_.partners * static_cast<double>(n / 2));
  const std::size_t first = pick(words[0], n);
  const std::size_t distance = 1 + pick(words[1], std::max<std::size_t>(1, farthest));
  const std::size_t second = (first + ((words[2] & 1) == 0 ? distance : n - distance)) % n;
  const std::size_t i = ranked[first], j = ranked[second];
  const auto& shapes = particles_.configuration().shape;
  if (shapes[i] == shapes[j]) return;
  ++counts.tried;
  counts.accepted += particles_.try_exchange(i, j, tests);
}

template <int Dim>
void Exchanges<Dim>::try_all(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests) {
  for (std::uint64_t trial = per_sweep(options_.trials); trial > 0; --trial) {
    Words words;
    draw.fill({&words, 1});
    try_two(by_rank_, words, counts, tests);
  }
}

template <int Dim>
void Exchanges<Dim>::run_chain(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests) {
  const std::uint64_t steps = per_sweep(options_.collective);
  if (steps > 0) run_chain(draw.below(by_rank_.size()), steps, counts, tests);
}

template <int Dim>
void Exchanges<Dim>::run_chain(std::size_t rank, std::uint64_t steps, ExchangeCounts& counts,
                               OverlapTestCounts& tests) {
  const std::size_t last = by_rank_.size() - 1;
  counts.steps += steps;
  guess_ = 1;
  while (steps > 0) {
    if (rank == last) {
      rank = 0;
      --steps;
      continue;
    }
    const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(steps, last - rank));
    const std::size_t sure = sure_steps(rank, most, tests);
    for (std::size_t k = 0; k < sure; ++k, ++rank)
      particles_.exchange(by_rank_[rank], by_rank_[rank + 1]);
    steps -= sure;
    counts.accepted_steps += sure;
    if (sure == most) continue;
    counts.accepted_steps += particles_.try_exchange(by_rank_[rank], by_rank_[rank + 1], tests);
    ++rank;
    --steps;
  }
}

/// A number of steps, up to `most`, that succeed one after the other.
template <int Dim>
std::size_t Exchanges<Dim>::sure_steps(std::size_t rank, std::size_t most,
                                       OverlapTestCounts& tests) {
  if (!nested_) return 0;
  if (!radii_.empty()) return sure_round_steps(rank, most);
  const std::size_t active = by_rank_[rank];
  const auto& body = particles_.bodies()[active];
  const auto succeed = [&](std::size_t steps) {
    return particles_.is_clear_as(active, with_shape<Dim>(body, shape_of_rank(rank + steps)),
                                  particles_.margin(), tests);
  };
  std::size_t sure = 0, not_sure = most + 1;
  for (std::size_t tried = std::min(guess_, most); sure < most && not_sure > most;
       tried = std::min(2 * tried, most))
    (succeed(tried) ? sure : not_sure) = tried;
  while (not_sure - sure > 1) {
    const std::size_t middle = std::midpoint(sure, not_sure);
    (succeed(middle) ? sure : not_sure) = middle;
  }
  guess_ = std::max<std::size_t>(1, sure);
  return sure;
}

template <int Dim>
std::size_t Exchanges<Dim>::sure_round_steps(std::size_t rank, std::size_t most) const {
  const auto own = radii_.begin() + static_cast<std::ptrdiff_t>(rank);
  const auto first_too_large = std::upper_bound(
      own + 1, own + 1 + static_cast<std::ptrdiff_t>(most), particles_.free_radius(by_rank_[rank]));
  return static_cast<std::size_t>(first_too_large - own) - 1;
}

template class Exchanges<2>;
template class Exchanges<3>;

}  // namespace vitrel
