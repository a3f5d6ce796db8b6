#include "mc/sampler.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <numbers>
#include <numeric>
#include <span>

#include "core/parallel.h"
#include "core/state/typical_scales.h"

namespace vitrel {

template <int Dim>
Sampler<Dim>::Sampler(Configuration<Dim>& configuration, std::uint64_t seed,
                      const SweepState& state, int threads)
    : particles_(configuration), threads_(threads), seed_(seed), state_(state) {
  constexpr double first_step = 0.1;
  if (state_.translation.size == 0)
    state_.translation.size = first_step * typical_length(configuration);
}

template <int Dim>
void Sampler<Dim>::set_steps(double translation, double rotation) {
  state_.translation.size = translation;
  state_.rotation.size = rotation;
}

template <int Dim>
void Sampler<Dim>::set_exchanges(const ExchangeOptions& options) {
  if (options.any())
    exchanges_.emplace(particles_, options);
  else
    exchanges_.reset();
}

template <int Dim>
void Sampler<Dim>::sweep() {
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, 0);
  particles_.board().shift(draw);
  particles_.arrange_by_domain(threads_);
  if (exchange_share() > 0) exchanges_->rank_domains();
  const auto colours = particles_.board().colours();
  std::vector<std::size_t> order(colours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[draw.below(k)]);
  for (const std::size_t colour : order) sweep_domains(colours[colour]);
  if (exchanges_) exchanges_->run_chain(draw, state_.counts.exchanges, overlap_tests_);
  ++state_.next_sweep;
  ++state_.sweeps;
}

template <int Dim>
void Sampler<Dim>::sweep_domains(const std::vector<std::size_t>& domains) {
  std::mutex adding;
  in_parallel(domains.size(), threads_, [&](std::size_t begin, std::size_t end) {
    Tally mine;
    for (std::size_t k = begin; k < end; ++k) sweep_domain(domains[k], mine);
    const std::lock_guard lock(adding);
    add(mine);
  });
}

template <int Dim>
void Sampler<Dim>::sweep_domain(std::size_t domain, Tally& tally) {
  const auto members = particles_.members(domain);
  const double exchange_share = this->exchange_share();
  const auto ranked = exchange_share > 0 ? exchanges_->ranked_members(domain) : members;
  const auto& shapes = particles_.configuration().shape;
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, domain + 1);
  // Draws several blocks at a time, so that independent evaluations of the generator overlap.
  std::array<Words, 16> drawn;
  for (std::size_t done = 0; done < members.size(); done += drawn.size()) {
    const std::span trials(drawn.data(), std::min(drawn.size(), members.size() - done));
    draw.fill(trials);
    for (const Words& words : trials) {
      if (static_cast<double>(words[3] >> 11) * 0x1p-53 < exchange_share) {
        exchanges_->try_two(ranked, words, tally.counts.exchanges, tally.overlap_tests);
        continue;
      }
      const std::size_t i = members[pick(words[0], members.size())];
      if (!shapes[i].is_round() && (words[3] & 1) == 1)
        rotate(i, words, tally);
      else
        translate(i, words, domain, tally);
    }
  }
}

/// The direction and share of a translation or rotation: each component is between −1 and 1, symmetric about 0.
template <int Dim>
Vec<Dim> Sampler<Dim>::step(const Words& words) const {
  if constexpr (Dim == 2)
    return {plus_minus_one(words[1]), plus_minus_one(words[2])};
  else
    return {plus_minus_one(words[1]), plus_minus_one(words[2]),
            share_above(words[3], exchange_share())};
}

template <int Dim>
void Sampler<Dim>::translate(std::size_t i, const Words& words, std::size_t domain, Tally& tally) {
  const auto& group = particles_.cells().group_of(i);
  Vec<Dim> position =
      group.position(particles_.cells().lane_of(i)) + state_.translation.size * step(words);
  Shift<Dim> crossed = Shift<Dim>::Zero();
  if ((position.array().abs() >= particles_.half_box().array()).any())
    particles_.configuration().box.wrap(position, crossed);
  ++tally.counts.translations_tried;
  const auto& board = particles_.board();
  const auto cell = board.cell_of(position);
  if (board.domain_of(cell) != domain) return;
  if (!particles_.is_clear_at(i, position, cell, tally.overlap_tests)) return;
  ++tally.counts.translations_accepted;
  particles_.move(i, position, crossed, board.index(cell), particles_.free_list(domain));
}

template <int Dim>
void Sampler<Dim>::rotate(std::size_t i, const Words& words, Tally& tally) {
  ++tally.counts.rotations_tried;
  tally.counts.rotations_accepted +=
      particles_.try_turn(i, state_.rotation.size * step(words), tally.overlap_tests);
}

template <int Dim>
void Sampler<Dim>::add(const Tally& tally) {
  const TrialCounts& more = tally.counts;
  state_.counts.add(more);
  state_.translation.count(more.translations_tried, more.translations_accepted);
  state_.rotation.count(more.rotations_tried, more.rotations_accepted);
  overlap_tests_.add(tally.overlap_tests);
}

template <int Dim>
void Sampler<Dim>::tune() {
  constexpr std::uint64_t enough = 100;  // acceptance to about 0.05
  state_.translation.tune(enough, particles_.half_box().minCoeff());
  state_.rotation.tune(enough, std::numbers::pi / 2);
}

template class Sampler<2>;
template class Sampler<3>;

}  // namespace vitrel
