// SPDX-License-Identifier: BSD-3-Clause
// lens_correction: error over the image of the AR.Drone's front camera and time of each way to
// correct pixels, as markdown.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "lens_errors.hpp"
#include "lens_methods.hpp"
#include "program/tool_main.hpp"
#include "sequences/drone_cameras.hpp"

namespace {

using namespace ardrone_vslam;
using namespace ardrone_vslam::bench;

// Of lensMethods.
constexpr std::size_t kTableMethod = 0;
constexpr std::size_t kClosedFormMethod = 1;
constexpr std::size_t kExactMethod = 2;

void printMethods(const CameraIntrinsics& c, const std::vector<LensMethod>& methods) {
  const std::vector<double> times = times_ns(c, methods);
  std::printf(
      "\n## Lens correction\n\nCamera: %dx%d, f = %g px, k1 = %g, k2 = %g. Errors are against "
      "Newton's method to 1e-12 of the image plane, over all pixels. Times are of one pixel: "
      "medians of %d rounds in which the ways take turns, %zu pixels each.\n\n",
      c.width_px, c.height_px, c.fx_px, c.k1, c.k2, kLensRounds, kTimedPixels);
  std::printf("| way | mean error [px] | largest [px] | time [ns] | / `table`'s time |\n");
  std::printf("|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const LensErrors e = summaryOf(errors_px(c, methods[i]));
    std::printf("| %s | %.2g | %.2g | %.1f | %.2f |\n", methods[i].name.c_str(), e.mean_px,
                e.largest_px, times[i], times[i] / times[kTableMethod]);
  }
}

/// What p1 and p2 cost, which the closed form does not know.
void printTangential(CameraIntrinsics c) {
  c.p1 = 0.001;
  c.p2 = -0.0005;
  const std::vector<double> times = times_ns(c, lensMethods(c));
  std::printf("\nWith p1 = %g, p2 = %g: `table` %.1f ns, `exact` %.1f ns.\n", c.p1, c.p2, times[0],
              times[kExactMethod]);
}

/// The same lens before sensors that see more and more of it.
void printFocalLengths(CameraIntrinsics c) {
  std::printf("\n| f [px] | corner at [degrees] | 3 terms: mean, largest error [px] | `table` |\n");
  std::printf("|---|---|---|---|\n");
  for (const double focal_px : {650., 600., 570., 540., 520., 500., 470.5}) {
    c.fx_px = c.fy_px = focal_px;
    const std::vector<LensMethod> methods = lensMethods(c);
    const LensErrors table = summaryOf(errors_px(c, methods[kTableMethod]));
    const LensErrors closed = summaryOf(errors_px(c, methods[kClosedFormMethod]));
    const Eigen::Vector3d corner = *CameraModel(c).bearing({0, 0});
    std::printf("| %g | %.1f | %.2f, %.0f | %.1g, %.1g |\n", focal_px,
                std::acos(corner.z()) * 180 / M_PI, closed.mean_px, closed.largest_px,
                table.mean_px, table.largest_px);
  }
}

void writeMap(const CameraIntrinsics& c, const std::vector<LensMethod>& methods,
              const std::string& path) {
  std::ofstream out(path);
  if (!out) throw std::runtime_error(path + ": cannot be written; choose another --map");
  out << "method,mean_px,largest_px,width_px,height_px,errors_px\n";
  for (const LensMethod& method : methods) {
    if (method.key.empty()) continue;
    const std::vector<double> errors = errors_px(c, method);
    const LensErrors e = summaryOf(errors);
    out << method.key << ',' << e.mean_px << ',' << e.largest_px << ',' << c.width_px << ','
        << c.height_px << ',';
    for (const double error : errors) out << error << ' ';
    out << '\n';
  }
}

int run(const std::string& map) {
  const CameraIntrinsics camera = arDroneFrontCamera();
  const std::vector<LensMethod> methods = lensMethods(camera);
  printMethods(camera, methods);
  printTangential(camera);
  printFocalLengths(camera);
  if (!map.empty()) writeMap(camera, methods, map);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures error and time of lens corrections.", "lens_correction"};
  std::string map;
  app.add_option("--map", map, "csv of errors over the image, for plot.py");
  return runTool(app, argc, argv, [&map] { return run(map); });
}
