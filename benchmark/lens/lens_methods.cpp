// SPDX-License-Identifier: BSD-3-Clause
#include "lens_methods.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <opencv2/calib3d.hpp>

#include "camera/brown_model.hpp"
#include "camera/lens_table.hpp"

namespace ardrone_vslam::bench {
namespace {

/// One call for each pixel.
LensMethod ofTheModel(const std::string& name, const std::string& key,
                      const CameraIntrinsics& camera, UndistortMethod method) {
  return {name, key, [model = CameraModel(camera, method)](const Pixels& pixels, Directions& out) {
            constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
            for (std::size_t i = 0; i < pixels.size(); ++i) {
              const auto bearing = model.bearing(pixels[i]);
              out[i] = bearing ? *bearing : Eigen::Vector3d::Constant(kNone);
            }
          }};
}

/// All pixels in one loop, no test for the fold, no p1, p2.
LensMethod tableInOneLoop(const CameraIntrinsics& c) {
  const double widest = std::min(findFoldRadius(c), kWidestRadius);
  const auto correct = [c, table = LensTable(c, widest)](const Pixels& pixels, Directions& out) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double x = (pixels[i].x() - c.cx_px) / c.fx_px;
      const double y = (pixels[i].y() - c.cy_px) / c.fy_px;
      const Eigen::Array2d found = table.at(x * x + y * y);
      out[i] = Eigen::Vector3d(x * found.x(), y * found.x(), found.y());
    }
  };
  return {"table, in one loop", "", correct};
}

/// The same of the closed form.
template <int kTerms>
LensMethod closedForm(const std::string& key, const CameraIntrinsics& c) {
  std::array<double, kTerms> terms{};
  const std::vector<double> series = inverseSeries(c, kTerms);
  std::copy(series.begin(), series.end(), terms.begin());
  const auto correct = [c, terms](const Pixels& pixels, Directions& out) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double x = (pixels[i].x() - c.cx_px) / c.fx_px;
      const double y = (pixels[i].y() - c.cy_px) / c.fy_px;
      const double r2 = x * x + y * y;
      double scale = 0;
      for (int k = kTerms; k-- > 0;) scale = r2 * (terms[static_cast<std::size_t>(k)] + scale);
      scale += 1;
      out[i] = Eigen::Vector3d(x * scale, y * scale, 1).normalized();
    }
  };
  return {"closed form, " + std::to_string(kTerms) + " terms, in one loop", key, correct};
}

LensMethod ofOpenCv(const std::string& name, const CameraIntrinsics& c,
                    const cv::TermCriteria& until) {
  const cv::Matx33d K(c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1);
  const std::vector<double> D{c.k1, c.k2, c.p1, c.p2, c.k3};
  auto from = std::make_shared<std::vector<cv::Point2d>>();
  auto to = std::make_shared<std::vector<cv::Point2d>>();
  return {name, "", [=](const Pixels& pixels, Directions& out) {
            from->resize(pixels.size());
            for (std::size_t i = 0; i < pixels.size(); ++i)
              (*from)[i] = {pixels[i].x(), pixels[i].y()};
            cv::undistortPoints(*from, *to, K, D, cv::noArray(), cv::noArray(), until);
            for (std::size_t i = 0; i < pixels.size(); ++i)
              out[i] = Eigen::Vector3d((*to)[i].x, (*to)[i].y, 1).normalized();
          }};
}

}  // namespace

std::vector<double> inverseSeries(const CameraIntrinsics& camera, int terms) {
  // With u the squared distorted radius and s the series sought: s * factor(s^2 u) = 1, whose
  // coefficient of u^n has s's own n-th term once and else only earlier ones.
  const std::array<double, 4> factor{1, camera.k1, camera.k2, camera.k3};
  const auto count = static_cast<std::size_t>(terms) + 1;
  std::vector<double> s(count);
  s[0] = 1;
  const auto product = [count](const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k + i < count; ++k) result[i + k] += a[i] * b[k];
    return result;
  };
  for (std::size_t n = 1; n < count; ++n) {
    std::vector<double> power = s;  // s^(2 i + 1)
    double sum = 0;
    for (std::size_t i = 0; i < factor.size() && i <= n; ++i) {
      sum += factor[i] * power[n - i];
      power = product(product(power, s), s);
    }
    s[n] = -sum;
  }
  s.erase(s.begin());
  return s;
}

std::vector<LensMethod> lensMethods(const CameraIntrinsics& camera) {
  using Until = cv::TermCriteria;
  return {
      ofTheModel("`table`", "table", camera, UndistortMethod::kTable),
      ofTheModel("`closed_form`: 3 terms", "closed_form_3", camera, UndistortMethod::kClosedForm),
      ofTheModel("`exact`: Newton", "", camera, UndistortMethod::kExact),
      tableInOneLoop(camera),
      closedForm<3>("", camera),
      closedForm<4>("closed_form_4", camera),
      closedForm<6>("", camera),
      closedForm<9>("closed_form_9", camera),
      closedForm<12>("", camera),
      ofOpenCv("cv::undistortPoints as it is: 5 iterations", camera, Until(Until::COUNT, 5, 0.01)),
      ofOpenCv("cv::undistortPoints until 1e-6 px", camera,
               Until(Until::COUNT | Until::EPS, 1000, 1e-6)),
  };
}

}  // namespace ardrone_vslam::bench
