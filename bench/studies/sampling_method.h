#pragma once

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/io/json.h"
#include "edmd/brownian.h"
#include "edmd/engine.h"
#include "mc/contact_pressure.h"
#include "mc/event_chain.h"
#include "mc/pressure_sampler.h"
#include "mc/sampler.h"

/// @file
/// Methods that sample a hard liquid in equilibrium at constant volume. Each has a state of its own.
namespace vitrel::bench {

inline double share_of(std::uint64_t part, std::uint64_t all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0;
}

template <int Dim>
struct SamplingMethod {
  SamplingMethod(std::string what, const Configuration<Dim>& start)
      : name(std::move(what)), state(start) {}
  virtual ~SamplingMethod() = default;
  virtual void sweep() = 0;
  virtual void tune() {}
  /// Brings `state` up to date with the method.
  virtual void write() {}
  /// βP/ρ since the last call, from the quantities that the method computes anyway.
  virtual double compressibility() = 0;
  virtual ExchangeCounts exchanges() const { return {}; }

  std::string name;
  Configuration<Dim> state;
};

/// Local moves, with Z from the contact function, which is measured every few sweeps.
template <int Dim>
struct LocalMoves : SamplingMethod<Dim> {
  LocalMoves(std::string what, const Configuration<Dim>& start,
             const ExchangeOptions& exchanges = {})
      : SamplingMethod<Dim>(std::move(what), start), sampler(this->state, 11) {
    sampler.set_exchanges(exchanges);
  }
  void sweep() override {
    constexpr int interval = 10;
    sampler.sweep();
    if (measures && ++sweeps % interval == 0) pressure.add(this->state);
  }
  void tune() override { sampler.tune(); }
  double compressibility() override {
    const double z = measures ? pressure.compressibility() : 0;
    measures = true;
    pressure.clear();
    return z;
  }
  ExchangeCounts exchanges() const override { return sampler.counts().exchanges; }

  Sampler<ParticleShape<Dim>> sampler;
  ContactPressure pressure;
  bool measures = false;
  int sweeps = 0;
};

/// Event chains, with Z from their contacts.
template <int Dim>
struct Chains : SamplingMethod<Dim> {
  Chains(std::string what, const Configuration<Dim>& start, const ExchangeOptions& exchanges = {})
      : SamplingMethod<Dim>(std::move(what), start),
        chains(this->state, {.exchanges = exchanges}, 12) {}
  void sweep() override { chains.sweep(); }
  void tune() override { chains.tune(); }
  double compressibility() override {
    const ChainCounts now = chains.counts();
    const double z = 1 + (now.ahead - before.ahead) / (now.length - before.length);
    before = now;
    return z;
  }
  ExchangeCounts exchanges() const override { return chains.counts().exchanges; }

  EventChain<ParticleShape<Dim>> chains;
  ChainCounts before;
};

/// Newton's dynamics, in steps of about as many collisions as there are particles, with Z from the virial.
template <int Dim>
struct Motion : SamplingMethod<Dim> {
  explicit Motion(const Configuration<Dim>& start)
      : SamplingMethod<Dim>("motion", start), engine(make_engine(started(), EngineOptions{})) {
    engine->load(this->state);
  }
  Configuration<Dim>& started() {
    draw_velocities(this->state, 1, Purpose::velocities, 0, Temperature::relative);
    return this->state;
  }
  void sweep() override {
    constexpr double step = 0.01;  // far shorter than any correlation
    const std::uint64_t goal = counters.collisions + this->state.size();
    while (counters.collisions < goal) {
      time += step;
      while (engine->advance(time, counters) == Engine<Dim>::Stop::block_end) {
        engine->write(this->state);
        engine->load(this->state);
      }
    }
  }
  void write() override { engine->write(this->state); }
  double compressibility() override {
    const double particles = static_cast<double>(this->state.size());
    const double z = 1 + (counters.virial - virial) / (Dim * particles * (time - begin));
    virial = counters.virial, begin = time;
    return z;
  }

  std::unique_ptr<Engine<Dim>> engine;
  RunCounters counters;
  double time = this->state.time;
  double virial = 0, begin = time;
};

/// Local moves at the constant pressure that belongs to a known Z. The mean packing fraction gives βP/ρ at the
/// packing fraction of the start: if Z^(−1/D) is linear in φ, as it nearly is in scaled-particle theory, then d ln
/// P/d ln φ = D Z^(1/D) − D + 1, which holds for disks within 2 % and for spheres within 15 %.
template <int Dim>
struct ConstantPressure : SamplingMethod<Dim> {
  ConstantPressure(const Configuration<Dim>& start, double known_z)
      : SamplingMethod<Dim>("constant pressure", start),
        z(known_z),
        volume(start.box.volume()),
        sampler(this->state, z * static_cast<double>(start.size()) / volume, BoxChange::isotropic,
                13) {}
  void sweep() override {
    sampler.sweep();
    excess += volume / this->state.box.volume() - 1, ++sweeps;
  }
  void tune() override { sampler.tune(); }
  double compressibility() override {
    const double slope = Dim * std::pow(z, 1. / Dim) - Dim + 1;
    const double found = z * (1 - slope * excess / sweeps);
    excess = sweeps = 0;
    return found;
  }

  double z, volume;
  PressureSampler<ParticleShape<Dim>> sampler;
  /// Sum of the relative excess of the density since the last call, and the number of sweeps in it.
  double excess = 0, sweeps = 0;
};

template <int Dim>
using SamplingMethods = std::vector<std::unique_ptr<SamplingMethod<Dim>>>;

}  // namespace vitrel::bench
