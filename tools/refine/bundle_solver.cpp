// SPDX-License-Identifier: BSD-3-Clause
#include "refine/bundle_solver.hpp"

#include <glog/logging.h>

#include <memory>
#include <stdexcept>

namespace ardrone_vslam {
namespace {

// Where all keyframes see the same, a direct solution takes their cube.
constexpr std::size_t kMostDirect = 500;
// One camera sees no scale: a damped step would hardly move along it.
constexpr double kTrustRadius = 1e5;

class StepCallback : public ceres::IterationCallback {
 public:
  explicit StepCallback(const std::function<void()>& step) : step_(step) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    if (step_) step_();
    return ceres::SOLVER_CONTINUE;
  }

 private:
  const std::function<void()>& step_;
};

}  // namespace

void solveBundle(ceres::Problem& problem, const std::vector<double*>& points, std::size_t keyframes,
                 const std::function<void()>& step) {
  FLAGS_minloglevel = google::GLOG_ERROR;  // Ceres warns of steps that it then makes shorter
  ceres::Solver::Options options;
  options.linear_solver_type =
      keyframes > kMostDirect ? ceres::ITERATIVE_SCHUR : ceres::SPARSE_SCHUR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 20;
  options.function_tolerance = 1e-5;
  options.initial_trust_region_radius = kTrustRadius;
  const auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<double*> blocks;
  problem.GetParameterBlocks(&blocks);
  for (double* block : blocks) order->AddElementToGroup(block, 1);
  for (double* point : points) order->AddElementToGroup(point, 0);
  options.linear_solver_ordering = order;
  StepCallback callback(step);
  options.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error(summary.message);
}

}  // namespace ardrone_vslam
