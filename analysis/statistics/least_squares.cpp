#include "analysis/statistics/least_squares.h"

#include <gsl/gsl_multifit_nlinear.h>

#include <memory>

#include "analysis/statistics/gsl_errors.h"
#include "core/io/checked.h"

namespace vitrel {

namespace {

constexpr std::size_t max_iterations = 200;
constexpr double smallest_step = 1e-10;

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Vector to_eigen(const gsl_vector* v) {
  Vector result(static_cast<Eigen::Index>(v->size));
  for (std::size_t k = 0; k < v->size; ++k)
    result[static_cast<Eigen::Index>(k)] = gsl_vector_get(v, k);
  return result;
}

struct Problem {
  const WeightedResiduals* residuals;
  Eigen::Index points, parameters;
};

int evaluate(const gsl_vector* p, void* data, gsl_vector* r, gsl_matrix* j) {
  const auto& problem = *static_cast<const Problem*>(data);
  Vector residual(problem.points);
  Matrix derivative(problem.points, problem.parameters);
  (*problem.residuals)(to_eigen(p), residual, derivative);
  for (Eigen::Index k = 0; k < problem.points; ++k) {
    if (r != nullptr) gsl_vector_set(r, k, residual[k]);
    for (Eigen::Index m = 0; j != nullptr && m < problem.parameters; ++m)
      gsl_matrix_set(j, k, m, derivative(k, m));
  }
  return GSL_SUCCESS;
}

int evaluate_residuals(const gsl_vector* p, void* data, gsl_vector* r) {
  return evaluate(p, data, r, nullptr);
}

int evaluate_derivatives(const gsl_vector* p, void* data, gsl_matrix* j) {
  return evaluate(p, data, nullptr, j);
}

}  // namespace

LeastSquares least_squares(std::size_t points, const Vector& start,
                           const WeightedResiduals& residuals) {
  const auto n = static_cast<std::size_t>(start.size());
  Problem problem{&residuals, static_cast<Eigen::Index>(points), start.size()};
  gsl_multifit_nlinear_fdf function{};
  function.f = evaluate_residuals;
  function.df = evaluate_derivatives;
  function.n = points;
  function.p = n;
  function.params = &problem;

  const gsl_multifit_nlinear_parameters options = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)>
      workspace(
          obtained(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &options, points, n)),
          gsl_multifit_nlinear_free);
  const gsl_vector_const_view at = gsl_vector_const_view_array(start.data(), n);
  check_gsl(gsl_multifit_nlinear_init(&at.vector, &function, workspace.get()));
  int stopped_by = 0;
  const int status = gsl_multifit_nlinear_driver(max_iterations, smallest_step, smallest_step, 0,
                                                 nullptr, nullptr, &stopped_by, workspace.get());

  RowMajor covariance(start.size(), start.size());
  gsl_matrix_view target = gsl_matrix_view_array(covariance.data(), n, n);
  check_gsl(
      gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(workspace.get()), 0, &target.matrix));
  const Vector r = to_eigen(gsl_multifit_nlinear_residual(workspace.get()));
  return {to_eigen(gsl_multifit_nlinear_position(workspace.get())), covariance, r.squaredNorm(),
          status == GSL_SUCCESS};
}

}  // namespace vitrel
