// SPDX-License-Identifier: BSD-3-Clause
#include "world_flight.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "world_room.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kGravity_m_s2 = 9.81;
constexpr double kDrag_per_s = 0.3;  // deceleration per speed
constexpr double kWallMargin_m = 0.5;
constexpr double kHoverBegin_s = 21.5;  // of laps_then_hover: the lap is complete

double wrapAngle(double angle_rad) {
  return std::remainder(angle_rad, 2 * M_PI);
}

/// From 0 at x = 0 to 1 at x = 1 with three continuous derivatives, so that not even the
/// attitude's rate leaps; constant outside.
double smoothStep(double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x * x * x * x * (35 + x * (-84 + x * (70 - 20 * x)));
}
/// Integral of smoothStep from 0 to x.
double smoothStepIntegral(double x) {
  if (x <= 0) return 0;
  if (x >= 1) return x - 0.5;
  const double x5 = x * x * x * x * x;
  return x5 * (7 + x * (-14 + x * (10 - 2.5 * x)));
}
double wave(double t_s, double frequency_hz, double phase_rad) {
  return std::sin(2 * M_PI * frequency_hz * t_s + phase_rad);
}

/// What the air does to a drone that holds its place: a few centimetres [m].
Eigen::Vector3d gusts(double t_s) {
  return {0.025 * wave(t_s, 0.31, 0) + 0.01 * wave(t_s, 0.77, 2),
          0.025 * wave(t_s, 0.27, 1) + 0.01 * wave(t_s, 0.83, 3), 0.02 * wave(t_s, 0.37, 2)};
}

/// Counter-clockwise laps on an ellipse, no two quite alike, the nose along the path and at times
/// turned outwards to the wall.
class Laps : public Flight {
 public:
  explicit Laps(const std::optional<FlightStart>& start) {
    start_ = start.value_or(FlightStart{kRadiusX_m, 0, M_PI / 2});
    first_phase_ = std::atan2(start_.y_m / kRadiusY_m, start_.x_m / kRadiusX_m);
    first_turn_ = wrapAngle(start_.yaw_rad - pathYaw(0));
  }

 protected:
  Eigen::Vector3d position(double t_s) const override {
    const double blend = smoothStep(t_s / kEntry_s);
    const Eigen::Vector3d start(start_.x_m, start_.y_m, kStartHeight_m);
    return start + blend * (pathPosition(t_s) - start);
  }

  double yaw(double t_s) const override {
    const double blend = smoothStep(t_s / kEntry_s);
    const double outwards = kLookOutwards_rad * (0.5 - 0.5 * std::cos(2 * M_PI * t_s / kLook_s));
    return pathYaw(t_s) - blend * outwards + (1 - blend) * first_turn_;
  }

 private:
  static constexpr double kRadiusX_m = 2.0;
  static constexpr double kRadiusY_m = 1.5;
  static constexpr double kLap_s = 17;
  static constexpr double kEntry_s = 5;  // from the start to the ellipse at full speed
  static constexpr double kStartHeight_m = 1.2;
  static constexpr double kLook_s = 11;
  static constexpr double kLookOutwards_rad = 45 * M_PI / 180;

  double phase(double t_s) const {
    return first_phase_ + 2 * M_PI * kEntry_s / kLap_s * smoothStepIntegral(t_s / kEntry_s);
  }

  Eigen::Vector3d pathPosition(double t_s) const {
    const double stretch = 1 + 0.06 * wave(t_s, 0.021, 0.4);
    const double height = 1.25 + 0.2 * wave(t_s, 0.047, 1.1);
    return Eigen::Vector3d(stretch * kRadiusX_m * std::cos(phase(t_s)),
                           stretch * kRadiusY_m * std::sin(phase(t_s)), height) +
           gusts(t_s);
  }

  /// Direction of the ellipse's tangent: that of a circle, corrected; never wraps.
  double pathYaw(double t_s) const {
    const double c = std::cos(phase(t_s)), s = std::sin(phase(t_s));
    return phase(t_s) + M_PI / 2 +
           std::atan2((kRadiusX_m - kRadiusY_m) * s * c, kRadiusX_m * s * s + kRadiusY_m * c * c);
  }

  FlightStart start_;
  double first_phase_ = 0;
  double first_turn_ = 0;
};

/// One lap, then hovering where it began: within a few centimetres and about a degree.
class LapsThenHover : public Laps {
 public:
  using Laps::Laps;

 protected:
  Eigen::Vector3d position(double t_s) const override {
    return Laps::position(lapTime(t_s)) + gusts(t_s) - gusts(lapTime(t_s));
  }
  double yaw(double t_s) const override {
    constexpr double kSway_rad = 0.02;
    return Laps::yaw(lapTime(t_s)) + kSway_rad * (wave(t_s, 0.19, 1) - wave(lapTime(t_s), 0.19, 1));
  }

 private:
  static constexpr double kBrake_s = 4;

  /// Runs on as t_s does, and stops at the end of the lap.
  static double lapTime(double t_s) {
    const double braked_s = t_s - (kHoverBegin_s - kBrake_s);
    return t_s - kBrake_s * smoothStepIntegral(braked_s / kBrake_s);
  }
};

void checkStart(const FlightStart& start) {
  const bool inside = std::abs(start.x_m) <= kRoomLength_m / 2 - kWallMargin_m &&
                      std::abs(start.y_m) <= kRoomWidth_m / 2 - kWallMargin_m &&
                      std::isfinite(start.yaw_rad);
  if (!inside) {
    throw std::invalid_argument(
        "the start must be at least 0.5 m from the walls of the room: X within -3.5 and 3.5, Y "
        "within -2.5 and 2.5 m");
  }
}

}  // namespace

Eigen::Isometry3d Flight::pose(double t_s) const {
  constexpr double h = 0.01;  // s; the error of the acceleration is about 1e-5 m/s^2
  const Eigen::Vector3d before = position(t_s - h), now = position(t_s), after = position(t_s + h);
  const Eigen::Vector3d velocity = (after - before) / (2 * h);
  const Eigen::Vector3d acceleration = (after - 2 * now + before) / (h * h);
  const Eigen::Vector3d thrust =
      acceleration + kDrag_per_s * velocity + kGravity_m_s2 * Eigen::Vector3d::UnitZ();
  const double heading = yaw(t_s);
  const Eigen::Vector3d forward(std::cos(heading), std::sin(heading), 0);
  const Eigen::Vector3d z = thrust.normalized();
  const Eigen::Vector3d y = z.cross(forward).normalized();
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.linear() << y.cross(z), y, z;
  T_world_body.translation() = now;
  return T_world_body;
}

std::vector<std::string> flightNames() {
  return {"laps", "laps_then_hover"};
}

std::optional<double> hoverBegin_s(const std::string& flight) {
  if (flight != "laps_then_hover") return std::nullopt;
  return kHoverBegin_s;
}

std::unique_ptr<Flight> makeFlight(const std::string& name,
                                   const std::optional<FlightStart>& start) {
  if (start) checkStart(*start);
  if (name == "laps") return std::make_unique<Laps>(start);
  if (name == "laps_then_hover") return std::make_unique<LapsThenHover>(start);
  std::string known;
  for (const auto& flight : flightNames()) known += (known.empty() ? "" : ", ") + flight;
  throw std::invalid_argument("there is no flight '" + name + "'; known are " + known);
}

}  // namespace ardrone_vslam
