#include "workflow/analyze/packing_tables.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <string>

#include "analysis/structure/orientation_tensor.h"

namespace vitrel {
namespace {

Column single(const char* name, const char* unit, double value) {
  return {name, unit, {value}, {}};
}

Table summary_table(const Configuration3& packing) {
  const OrientationTensor tensor = orientation_tensor(packing);
  const IsotropicRatio isotropic = isotropic_ratio(tensor.axes);
  const Vec3& box = packing.box.lengths();
  return {
      "summary",
      "The packing. orientation_ratio = lambda_max/lambda_min of the orientation tensor, and its "
      "mean and standard deviation if all rotors had independent and isotropic axes.",
      {single("packing_fraction", "1", packing_fraction(packing)),
       single("particles", "1", static_cast<double>(packing.size())),
       single("rotors", "1", static_cast<double>(tensor.axes)), single("box_x", "length", box.x()),
       single("box_y", "length", box.y()), single("box_z", "length", box.z()),
       single("orientation_ratio", "1", tensor.ratio()),
       single("isotropic_ratio", "1", isotropic.mean),
       single("isotropic_ratio_deviation", "1", isotropic.standard_deviation)}};
}

/// Columns x, y, z of these rows.
void add_columns(Table& table, const std::string& prefix, const Mat3& rows) {
  for (int k = 0; k < 3; ++k)
    table.columns.push_back({prefix + "xyz"[k], "1", {rows(0, k), rows(1, k), rows(2, k)}, {}});
}

Table orientation_table(const OrientationTensor& tensor) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(tensor.matrix);
  const Vec3& values = solver.eigenvalues();
  Table table{
      "orientation_tensor",
      fmt::format("T = <w w^T> of the axes w of the {} bodies that are not round: of symmetry, of "
                  "scalene bodies the longest. t_x, t_y, t_z: a row of T per line; beside it an "
                  "eigenvalue, ascending, and its eigenvector.",
                  tensor.axes),
      {}};
  add_columns(table, "t_", tensor.matrix);
  table.columns.push_back({"eigenvalue", "1", {values[0], values[1], values[2]}, {}});
  add_columns(table, "eigenvector_", solver.eigenvectors().transpose());
  return table;
}

Table scattering_table(const Configuration3& packing, const ShellOptions& options) {
  const StructureFactor s =
      ScatteringShells<3>(packing.box.lengths(), options).structure_factor(packing);
  Table table{
      "structure_factor",
      "Structure factors averaged over the wave vectors of a shell of wave numbers q: s = "
      "|sum_a rho_a(q)|^2/N; of species, s_A_B = Re rho_A(q) rho_B(-q)/sqrt(N_A N_B); modes is "
      "the number of wave vectors, q and -q counted once.",
      {}};
  const auto add = [&](const std::string& name, const char* unit, const std::vector<double>& all) {
    Column& column = table.columns.emplace_back(Column{name, unit, {}, {}});
    // Narrow shells of small boxes have no wave vectors.
    for (std::size_t k = 0; k < all.size(); ++k)
      if (s.modes[k] > 0) column.value.push_back(all[k]);
  };
  add("q", "1/length", s.q);
  add("s", "1", s.total);
  const std::vector<std::string> names = pair_names(packing.species_names);
  for (std::size_t k = 0; k < s.partial.size(); ++k)
    add("s_" + identifier(names[k]), "1", s.partial[k]);
  add("modes", "1", s.modes);
  return table;
}

Table pair_table(const Configuration3& packing, const PairCorrelationOptions& options) {
  const PairCorrelation pairs = pair_correlation(packing, options);
  return {
      "pair_correlation",
      fmt::format("Pair correlation by the distance r of the centres, in bins of width {:g} around "
                  "r: g is 1 in an ideal gas.",
                  options.distance_step),
      {{"r", "length", pairs.distance, {}}, {"g", "1", pairs.g, {}}}};
}

}  // namespace

std::vector<Table> packing_tables(const Configuration3& packing, const StructureOptions& options) {
  std::vector<Table> tables{summary_table(packing)};
  const OrientationTensor tensor = orientation_tensor(packing);
  if (tensor.axes > 0) tables.push_back(orientation_table(tensor));
  tables.push_back(scattering_table(packing, options.shells));
  tables.push_back(pair_table(packing, options.pairs));
  return tables;
}

}  // namespace vitrel
