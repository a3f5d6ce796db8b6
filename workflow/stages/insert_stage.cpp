#include "workflow/stages/insert_stage.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/io/parameters.h"
#include "mc/insertion.h"
#include "workflow/stages/stage_fields.h"

namespace vitrel {
namespace {

/// Random insertion is quick up to these packing fractions. In three dimensions it serves as a start: later stages
/// grow all lengths.
constexpr double easy_insertion = 0.3, easy_insertion_of_solids = 0.01;

void describe_attempts(InsertStage& stage, FieldVisitor& visit) {
  visit.field({"attempts", "", "Random positions tried for one particle before the stage fails.",
               bounds::at_least_one},
              stage.attempts);
}

void describe_orientations(InsertStage& stage, FieldVisitor& visit) {
  using Orientations = InsertStage::Orientations;
  static constexpr const char* names[] = {"random", "aligned", "planar", "tensor"};
  visit.field(
      {"orientations", "",
       "Orientations before the particles move: random; aligned, all particles along x; in three "
       "dimensions planar, axes at random in the plane normal to z; or with a given orientation "
       "tensor. The axis is the axis of symmetry of a spheroid (the short one of an oblate) and "
       "the longest axis of a scalene ellipsoid, around which a particle is turned at random. "
       "Dynamics turn the particles further: to keep their orientations insert densely and grow "
       "fast."},
      stage.orientations, names);
  visit.when(stage.orientations == Orientations::tensor, "orientations = \"tensor\"",
             [&](FieldVisitor& in) {
               in.optional({"orientation_tensor", "",
                            "Mean ⟨u uᵀ⟩ over the axes u, as its diagonal or row by row, with the "
                            "sum of the diagonal 1. The axes have the angular central Gaussian "
                            "distribution."},
                           stage.orientation_tensor, std::vector<double>{0.6, 0.3, 0.1});
             });
}

using Tensor = Eigen::MatrixXd;

/// Builds the tensor from its diagonal or from all its rows. Returns nothing if there are not as many numbers.
std::optional<Tensor> full_tensor(const std::vector<double>& numbers, int dimension) {
  const auto size = static_cast<int>(numbers.size());
  if (size == dimension)
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), size).asDiagonal();
  if (size != dimension * dimension) return std::nullopt;
  return Eigen::Map<const Tensor>(numbers.data(), dimension, dimension);
}

bool is_orientation_tensor(const Tensor& a) {
  constexpr double slack = 1e-9;  // rounding of numbers written in decimal
  return a.allFinite() && (a - a.transpose()).cwiseAbs().maxCoeff() <= slack &&
         std::abs(a.trace() - 1) <= slack &&
         Eigen::SelfAdjointEigenSolver<Tensor>(a).eigenvalues().minCoeff() >= -slack;
}

/// Returns nothing if the orientations are isotropic or aligned.
std::vector<double> tensor_numbers(const InsertStage& stage, int dimension) {
  using Orientations = InsertStage::Orientations;
  if (stage.orientations == Orientations::planar) return {0.5, 0, 0, 0, 0.5, 0, 0, 0, 0};
  if (stage.orientations != Orientations::tensor) return {};
  const Tensor tensor = *full_tensor(*stage.orientation_tensor, dimension);
  return {tensor.data(), tensor.data() + tensor.size()};
}

}  // namespace

std::vector<StageField<InsertStage>> InsertStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"attempts", describe_attempts},
          {"orientations", describe_orientations}};
}

void InsertStage::validate(const Rules& rules, int dimension) const {
  rules.require(dimension == 3 || orientations != Orientations::planar, "orientations",
                "is \"planar\", which has a meaning only with dimension = 3");
  if (orientations != Orientations::tensor) return;
  rules.require(orientation_tensor.has_value(), "orientation_tensor",
                "is missing; give its diagonal, for example [0.6, 0.3, 0.1]");
  const std::optional<Tensor> tensor = full_tensor(*orientation_tensor, dimension);
  rules.require(tensor && is_orientation_tensor(*tensor), "orientation_tensor",
                fmt::format("is {}, but must be the diagonal ({} numbers, 0 or more, with the sum "
                            "1) or the rows ({}) of a symmetric tensor with such eigenvalues",
                            to_toml(std::span<const double>(*orientation_tensor)), dimension,
                            dimension * dimension));
}

double InsertStage::default_packing_fraction(const SystemParameters& system) const {
  const double easy = system.dimension == 2 ? easy_insertion : easy_insertion_of_solids;
  return std::min(easy, system.packing_fraction);
}

StageReport InsertStage::advance(NoState&, const StageContext& context) const {
  const bool aligned = orientations == Orientations::aligned;
  return context.with_configuration([&]<int Dim>(Configuration<Dim>& configuration) {
    return insert_particles(
        configuration, {context.packing_fraction, attempts, aligned, tensor_numbers(*this, Dim)},
        context.seed, context.control);
  });
}

}  // namespace vitrel
