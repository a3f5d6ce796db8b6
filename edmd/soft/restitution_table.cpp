#include "edmd/soft/restitution_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/h5.h"
#include "core/io/provenance.h"
#include "core/io/word_checksum.h"

namespace vitrel {
namespace {

/// d of a pair is the same for all its collisions up to rounding.
constexpr double same_damping = 1e-9;

bool is_slice(const RestitutionDomain& domain) {
  return !(domain.d.high - domain.d.low > same_damping);
}

Box<2> slice_of(const RestitutionDomain& domain) {
  return {{domain.g.low, domain.m.low}, {domain.g.high, domain.m.high}};
}

Box<3> box_of(const RestitutionDomain& domain) {
  return {{domain.g.low, domain.m.low, domain.d.low},
          {domain.g.high, domain.m.high, domain.d.high}};
}

struct Variables {
  double g, m, d;
};

Variables variables_of(const ForceForm& form, const ScaledImpact& impact) {
  const double tangent = impact.angular_momentum / impact.distance;
  const double size = logarithm(impact.distance);
  return {logarithm(tangent),
          size - form.length_exponent * logarithm_of_one_plus(tangent * tangent),
          logarithm(impact.damping) + form.damping_exponent * size};
}

ScaledImpact impact_of(const ForceForm& form, const Variables& at) {
  const double tangent = exponential(at.g);
  const double size = at.m + form.length_exponent * logarithm_of_one_plus(tangent * tangent);
  const double distance = exponential(size);
  return {distance, distance * tangent, exponential(at.d - form.damping_exponent * size)};
}

using Logarithms = std::array<double, 3>;

Logarithms logarithms(const ForceForm& form, const Variables& at) {
  const ScaledImpact impact = impact_of(form, at);
  const Restitution found = form.integrate(impact);
  return {logarithm(-found.rate), logarithm(found.duration),
          logarithm(found.angle * impact.distance * impact.distance / impact.angular_momentum)};
}

Restitution restitution_of(const ForceForm& form, const ScaledImpact& impact,
                           const Logarithms& of) {
  const double angle =
      exponential(of[2]) * impact.angular_momentum / (impact.distance * impact.distance);
  const double duration = exponential(of[1]);
  if (impact.damping == 0) return {1, angle, duration, -1};
  const double rate = -exponential(of[0]);
  const double s = form.elastic_inverse(-impact.damping * rate);
  return {1 - s * s / impact.distance, angle, duration, rate};
}

/// The identity of a table, stored in its file.
std::string key_of(const ForceForm& form, const RestitutionDomain& domain,
                   const PanelOptions& options) {
  return fmt::format(
      "restitution table, {} {}: {}, g {} … {}, m {} … {}, d {} … {}, tolerance {}, least width {}",
      program_version(), program_commit(), form.name, domain.g.low, domain.g.high, domain.m.low,
      domain.m.high, domain.d.low, domain.d.high, options.tolerance, options.min_width);
}

/// Returns the checksum of all numbers. A program that changes the file corrects the checksums of HDF5, but not this
/// one.
std::uint64_t checksum_of(const auto& content) {
  WordChecksum checksum;
  for (const auto& node : content.nodes) {
    checksum.add(std::bit_cast<std::uint64_t>(node.middle));
    checksum.add(static_cast<std::uint64_t>(node.axis));
    checksum.add(static_cast<std::uint64_t>(node.next));
  }
  for (const double number : content.panels) checksum.add(std::bit_cast<std::uint64_t>(number));
  return checksum.value();
}

void write_panels(h5::Group& group, const auto& panels) {
  std::vector<double> middle;
  std::vector<std::int32_t> axis, next;
  for (const auto& node : panels.content().nodes) {
    middle.push_back(node.middle);
    axis.push_back(node.axis);
    next.push_back(node.next);
  }
  group.create_array<double>("middle", {middle.size()}, middle);
  group.create_array<std::int32_t>("axis", {axis.size()}, axis);
  group.create_array<std::int32_t>("next", {next.size()}, next);
  const std::vector<double>& numbers = panels.content().panels;
  group.create_array<double>("panels", {numbers.size()}, numbers);
  group.set_attribute("checksum", checksum_of(panels.content()));
}

/// Reads the panels. Throws FileError if the file is unreadable, not a tree of panels, or not as vitrel wrote it.
template <class Panels>
Panels read_panels(const h5::Group& group, const typename Panels::Bounds& box) {
  typename Panels::Content content;
  const auto middle = group.dataset("middle").read<double>();
  const auto axis = group.dataset("axis").read<std::int32_t>();
  const auto next = group.dataset("next").read<std::int32_t>();
  if (axis.size() != middle.size() || next.size() != middle.size())
    throw FileError(group.name() + ": arrays of different size");
  for (std::size_t k = 0; k < middle.size(); ++k)
    content.nodes.push_back({middle[k], axis[k], next[k]});
  content.panels = group.dataset("panels").read<double>();
  if (!Panels::is_valid(content)) throw FileError(group.name() + ": not a tree of panels");
  if (group.number_attribute<std::uint64_t>("checksum") != checksum_of(content))
    throw FileError(group.name() + ": was changed");
  return Panels(box, std::move(content));
}

}  // namespace

RestitutionTable::RestitutionTable(const ForceForm& form, const RestitutionDomain& domain,
                                   const PanelOptions& options, int threads)
    : RestitutionTable(form, domain, options, [&]() -> Panels {
        if (is_slice(domain))
          return Slice(
              slice_of(domain),
              [&](const Slice::Point& x) {
                return logarithms(form, {x[0], x[1], domain.d.low});
              },
              options, threads);
        return Range(
            box_of(domain),
            [&](const Range::Point& x) {
              return logarithms(form, {x[0], x[1], x[2]});
            },
            options, threads);
      }()) {}

RestitutionTable::RestitutionTable(const ForceForm& form, const RestitutionDomain& domain,
                                   const PanelOptions& options, Panels panels)
    : form_(form), domain_(domain), options_(options), panels_(std::move(panels)) {}

std::optional<Restitution> RestitutionTable::operator()(const ScaledImpact& impact) const {
  const Variables at = variables_of(form_, impact);
  const double d = std::clamp(at.d, domain_.d.low, domain_.d.high);
  if (d != at.d && !(std::abs(d - at.d) < same_damping)) return {};
  const auto* slice = std::get_if<Slice>(&panels_);
  const std::optional<Logarithms> found =
      slice ? (*slice)({at.g, at.m}) : std::get<Range>(panels_)({at.g, at.m, d});
  if (!found) return {};
  return restitution_of(form_, impact, *found);
}

std::size_t RestitutionTable::panels() const {
  return std::visit([](const auto& panels) { return panels.size(); }, panels_);
}

std::size_t RestitutionTable::bytes() const {
  return std::visit([](const auto& panels) { return panels.bytes(); }, panels_);
}

void RestitutionTable::save(const std::filesystem::path& file) const {
  AtomicFile pending(file);
  h5::File out = h5::File::create(pending.partial());
  h5::Group root = out.root();
  root.set_attribute("key", key_of(form_, domain_, options_));
  std::visit([&](const auto& panels) { write_panels(root, panels); }, panels_);
  out.close();
  pending.commit();
}

std::optional<RestitutionTable> RestitutionTable::load(const std::filesystem::path& file,
                                                       const ForceForm& form,
                                                       const RestitutionDomain& domain,
                                                       const PanelOptions& options) {
  try {
    const h5::Group root = h5::File::open(file, h5::Access::read).root();
    if (root.text_attribute("key") != key_of(form, domain, options)) return {};
    if (is_slice(domain))
      return RestitutionTable(form, domain, options, read_panels<Slice>(root, slice_of(domain)));
    return RestitutionTable(form, domain, options, read_panels<Range>(root, box_of(domain)));
  } catch (const FileError&) {
    return {};
  }
}

CachedTable load_or_build_table(const std::filesystem::path& file, const ForceForm& form,
                                const RestitutionDomain& domain, const PanelOptions& options,
                                int threads) {
  if (auto loaded = RestitutionTable::load(file, form, domain, options))
    return {std::move(*loaded), true, {}};
  CachedTable kept{RestitutionTable(form, domain, options, threads), false, {}};
  try {
    kept.table.save(file);
  } catch (const FileError& error) {
    kept.save_error = error.what();
  }
  return kept;
}

}  // namespace vitrel
