// SPDX-License-Identifier: BSD-3-Clause
// lens_correction: error over the image of the AR.Drone's front camera and time of each way to
// correct pixels, as markdown.

#include <time.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "lens_methods.hpp"
#include "metrics.hpp"
#include "random_source.hpp"
#include "tool_main.hpp"
#include "world_camera.hpp"

namespace {

using namespace ardrone_vslam;
using namespace ardrone_vslam::bench;

constexpr std::size_t kTimedPixels = 600;  // of a frame
constexpr int kRounds = 301;
// Of lensMethods.
constexpr std::size_t kTableMethod = 0;
constexpr std::size_t kClosedFormMethod = 1;
constexpr std::size_t kExactMethod = 2;

struct Errors {
  double mean_px = 0;
  double largest_px = 0;
  int refused = 0;
};

Pixels wholeImage(const CameraIntrinsics& c) {
  Pixels pixels;
  for (int y = 0; y < c.height_px; ++y)
    for (int x = 0; x < c.width_px; ++x) pixels.emplace_back(x, y);
  return pixels;
}

Eigen::Vector2d onPlane_px(const CameraIntrinsics& c, const Eigen::Vector3d& direction) {
  return Eigen::Vector2d(c.fx_px * direction.x(), c.fy_px * direction.y()) / direction.z();
}

/// Distances on the plane of the undistorted image; NaN where there is no direction.
std::vector<double> errors_px(const CameraIntrinsics& c, const LensMethod& method) {
  const Pixels pixels = wholeImage(c);
  const CameraModel exact(c, UndistortMethod::kExact);
  Directions found(pixels.size());
  method.correct(pixels, found);
  std::vector<double> errors;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto truth = exact.bearing(pixels[i]);
    errors.push_back(truth ? (onPlane_px(c, found[i]) - onPlane_px(c, *truth)).norm() : NAN);
  }
  return errors;
}

Errors summaryOf(const std::vector<double>& errors) {
  Errors e;
  for (const double error : errors) {
    if (std::isnan(error)) {
      ++e.refused;
      continue;
    }
    e.mean_px += error;
    e.largest_px = std::max(e.largest_px, error);
  }
  e.mean_px /= static_cast<double>(errors.size()) - e.refused;
  return e;
}

/// The thread's own time: other work on the machine does not count.
double now_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Medians of rounds in which the methods take turns, of one pixel.
std::vector<double> times_ns(const CameraIntrinsics& c, const std::vector<LensMethod>& methods) {
  RandomSource random(1);
  Pixels pixels;
  while (pixels.size() < kTimedPixels)
    pixels.emplace_back(random.uniform(0, c.width_px - 1), random.uniform(0, c.height_px - 1));
  Directions found(pixels.size());
  std::vector<std::vector<double>> times(methods.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const double before = now_ns();
      methods[i].correct(pixels, found);
      times[i].push_back((now_ns() - before) / static_cast<double>(pixels.size()));
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& all : times) medians.push_back(quantile(std::move(all), 0.5));
  return medians;
}

void printMethods(const CameraIntrinsics& c, const std::vector<LensMethod>& methods) {
  const std::vector<double> times = times_ns(c, methods);
  std::printf(
      "\n## Lens correction\n\nCamera: %dx%d, f = %g px, k1 = %g, k2 = %g. Errors against Newton's "
      "method to 1e-12 of the "
      "image plane, over all pixels; times of one pixel, medians of %d rounds in which the ways "
      "take turns, %zu pixels each.\n\n",
      c.width_px, c.height_px, c.fx_px, c.k1, c.k2, kRounds, kTimedPixels);
  std::printf("| way | mean error [px] | largest [px] | time [ns] | / `table`'s time |\n");
  std::printf("|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Errors e = summaryOf(errors_px(c, methods[i]));
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
    const Errors table = summaryOf(errors_px(c, methods[kTableMethod]));
    const Errors closed = summaryOf(errors_px(c, methods[kClosedFormMethod]));
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
    const Errors e = summaryOf(errors);
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
