// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_adapter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;

constexpr double kEpoch_s = 1.7e9;
constexpr double kStart_s = 100;

/// Circles at 1 m/s, the nose along the way, in 1.5 m with the height going up and down.
OdometryState truthAt(double time_s) {
  constexpr double kRadius_m = 2;
  constexpr double kRotation_rad_s = 0.5;
  const double yaw_rad = kRotation_rad_s * time_s;
  OdometryState state;
  state.stamp_ns = std::llround((kStart_s + time_s) * 1e9);
  state.T_odom_base.linear() = (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  state.T_odom_base.translation() << kRadius_m * std::sin(yaw_rad),
      kRadius_m * (1 - std::cos(yaw_rad)), 1.5 + 0.8 * std::sin(0.4 * time_s);
  const Eigen::Vector3d velocity_odom_m_s(kRadius_m * kRotation_rad_s * std::cos(yaw_rad),
                                          kRadius_m * kRotation_rad_s * std::sin(yaw_rad),
                                          0.32 * std::cos(0.4 * time_s));
  state.twist_base.head<3>() = state.T_odom_base.linear().transpose() * velocity_odom_m_s;
  return state;
}

/// What of the driver is switched on.
struct Faults {
  bool mirrored_yaw = false;
  double epoch_at_s = -1;
  bool whole_metres = false;
  bool bursts = false;
};

constexpr double kStep_s = 0.005;

/// Where there are bursts: of twelve messages, five come with the stamp of the sixth.
void addBurst(bool are_there, int i, OdometryState& message) {
  if (are_there && i % 12 < 5) message.stamp_ns = truthAt((i - i % 12 + 5) * kStep_s).stamp_ns;
}

/// Sixty seconds at 200 Hz as the driver sends them: x and y integrated by itself.
std::vector<OdometryState> messagesOf(const Faults& faults) {
  std::vector<OdometryState> messages;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  bool has_jumped = false;
  for (int i = 0; i < 12000; ++i) {
    OdometryState message = truthAt(i * kStep_s);
    Eigen::Vector2d velocity_m_s =
        (message.T_odom_base.linear() * message.twist_base.head<3>()).head<2>();
    if (faults.mirrored_yaw) velocity_m_s.y() *= -1;  // the nose is along the way
    const bool jumps_now =
        faults.epoch_at_s >= 0 && !has_jumped && i * kStep_s >= faults.epoch_at_s;
    if (jumps_now) position_m.setZero();  // a driver that starts
    has_jumped = has_jumped || jumps_now;
    if (i > 0) position_m += velocity_m_s * (jumps_now ? kEpoch_s : kStep_s);
    message.T_odom_base.translation().head<2>() = position_m;
    double& z_m = message.T_odom_base.translation().z();
    if (faults.whole_metres) z_m = std::floor(z_m);
    addBurst(faults.bursts, i, message);
    messages.push_back(message);
  }
  return messages;
}

class OdometryAdapterTest : public ::testing::Test {
 protected:
  void feed(const std::vector<OdometryState>& messages, OdometryMode mode,
            OdometryHeight height = OdometryHeight::kPose) {
    adapter_ = std::make_unique<OdometryAdapter>(OdometryAdapterConfig{mode, height});
    states_.clear();
    refused_ = 0;
    for (const OdometryState& message : messages) {
      if (adapter_->push(message, states_) != Push::kAccepted) ++refused_;
    }
    EXPECT_EQ(adapter_->flush(states_), Push::kAccepted);
    for (std::size_t i = 1; i < states_.size(); ++i)
      ASSERT_GT(states_[i].stamp_ns, states_[i - 1].stamp_ns) << i;
  }

  static Eigen::Vector3d errorOf_m(const OdometryState& state) {
    const double time_s = static_cast<double>(state.stamp_ns) * 1e-9 - kStart_s;
    return state.T_odom_base.translation() - truthAt(time_s).T_odom_base.translation();
  }
  double worst_m() const {
    double worst = 0;
    for (const OdometryState& state : states_)
      worst = std::max(worst, errorOf_m(state).head<2>().norm());
    return worst;
  }
  double worstHeight_m() const {
    double worst = 0;
    for (const OdometryState& state : states_)
      worst = std::max(worst, std::abs(errorOf_m(state).z()));
    return worst;
  }
  std::uint64_t count(OdometryFault fault) const {
    return adapter_->faults()[static_cast<std::size_t>(fault)];
  }

  std::unique_ptr<OdometryAdapter> adapter_;
  std::vector<OdometryState> states_;
  int refused_ = 0;
};

TEST_F(OdometryAdapterTest, SoundOdometryPassesPoseModeToTheBit) {
  std::vector<OdometryState> messages = messagesOf({});
  for (OdometryState& message : messages) message.covariance = 0.1 * Matrix6d::Identity();
  feed(messages, OdometryMode::kPose);
  ASSERT_EQ(states_.size(), messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(states_[i].stamp_ns, messages[i].stamp_ns);
    EXPECT_EQ(states_[i].T_odom_base.matrix(), messages[i].T_odom_base.matrix());
    EXPECT_EQ(states_[i].covariance, messages[i].covariance);
    EXPECT_EQ(states_[i].twist_base, messages[i].twist_base);
  }
  EXPECT_EQ(adapter_->faults(), OdometryFaultCounts{});
  EXPECT_EQ(refused_, 0);
}

TEST_F(OdometryAdapterTest, APerfectTwistGivesThePoseToTheIntegrationsError) {
  // Trapezoid: chords instead of arcs, a share of (turn rate * interval)^2 / 12 of the radius.
  feed(messagesOf({}), OdometryMode::kTwist);
  EXPECT_NEAR(worst_m(), 2 * 2.0 * std::pow(0.5 * 0.005, 2) / 12, 1e-9) << "across the circle";
  EXPECT_LT(worstHeight_m(), 1e-12);
  feed(messagesOf({}), OdometryMode::kTwist, OdometryHeight::kTwist);
  EXPECT_LT(worstHeight_m(), 1e-5);
}

TEST_F(OdometryAdapterTest, AMirroredYawHarmsThePoseAndNotTheTwist) {
  const auto messages = messagesOf({/*mirrored_yaw=*/true});
  feed(messages, OdometryMode::kPose);
  EXPECT_GT(worst_m(), 5);
  feed(messages, OdometryMode::kTwist);
  EXPECT_LT(worst_m(), 0.01);
}

TEST_F(OdometryAdapterTest, AnEpochJumpIsNoMotionAndCountedOnce) {
  Faults faults;
  faults.epoch_at_s = 20;
  const auto messages = messagesOf(faults);
  ASSERT_GT(messages.back().T_odom_base.translation().norm(), 1e9);
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_LT(worst_m(), 0.02);
    EXPECT_EQ(count(OdometryFault::kJump), 1U);
    EXPECT_EQ(refused_, 1) << "the first message after it might be nonsense";
  }
}

TEST_F(OdometryAdapterTest, AHeightThatBeginsAnewWithTheJumpGoesOn) {
  Faults faults;
  faults.epoch_at_s = 20;
  auto messages = messagesOf(faults);
  for (std::size_t i = 4000; i < messages.size(); ++i)  // integrated from where it is started
    messages[i].T_odom_base.translation().z() -= 0.7;
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_LT(worstHeight_m(), 0.02);
    EXPECT_EQ(count(OdometryFault::kJump), 1U);
  }
}

TEST_F(OdometryAdapterTest, ATableBelowIsNoClimb) {
  // The drone's own height reaches the other floor within some tenths of a second.
  const auto messages = [](bool twist_climbs) {
    auto sent = messagesOf({});
    double below_m = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const bool above_table = i > 3000 && i < 5000;
      below_m += ((above_table ? 0.7 : 0) - below_m) * 0.05;
      sent[i].T_odom_base.translation().z() -= below_m;
      if (!twist_climbs) sent[i].twist_base[2] = 0;  // as some firmwares leave it
    }
    return sent;
  };
  feed(messages(true), OdometryMode::kPose);
  EXPECT_GT(worstHeight_m(), 0.65) << "the pose is believed";
  feed(messages(true), OdometryMode::kTwist);
  EXPECT_LT(worstHeight_m(), 0.15) << "what is seen before a step is told";
  EXPECT_LT(std::abs(errorOf_m(states_.back()).z()), 0.03);
  EXPECT_EQ(count(OdometryFault::kTableStep), 2U);
  feed(messages(false), OdometryMode::kTwist);
  EXPECT_LT(std::abs(errorOf_m(states_.back()).z()), 0.35) << "climbs during the steps are lost";
  EXPECT_EQ(count(OdometryFault::kTableStep), 2U);
}

TEST_F(OdometryAdapterTest, OdometryThatHasJumpedBeforeBeginsAtItsOrigin) {
  Faults faults;
  faults.epoch_at_s = 20;
  auto messages = messagesOf(faults);
  messages.erase(messages.begin(), messages.begin() + 5000);
  feed(messages, OdometryMode::kPose);
  ASSERT_GT(states_.size(), 6000U);
  EXPECT_LT(states_.front().T_odom_base.translation().head<2>().norm(), 1e-6);
  const Eigen::Vector3d start_m = errorOf_m(states_.front());
  EXPECT_LT((errorOf_m(states_.back()) - start_m).norm(), 0.02);
  EXPECT_EQ(count(OdometryFault::kJump), 1U);
}

TEST_F(OdometryAdapterTest, ALoneMessageFarAwayIsRefused) {
  auto messages = messagesOf({});
  messages[300].T_odom_base.translation().x() = 1e9;
  messages[600].T_odom_base.translation().x() = 1e300;
  messages[900].twist_base[0] = 1e4;
  messages[1200].T_odom_base.translation().y() = std::numeric_limits<double>::quiet_NaN();
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_EQ(refused_, 4);
    EXPECT_EQ(count(OdometryFault::kJump), 0U);
    EXPECT_LT(worst_m(), 0.02);
  }
}

TEST_F(OdometryAdapterTest, APositionThatBeginsAnewGoesOnAndIsCounted) {
  auto messages = messagesOf({});
  const Eigen::Vector3d place_m = messages[1000].T_odom_base.translation();
  for (std::size_t i = 1000; i < messages.size(); ++i)
    messages[i].T_odom_base.translation().head<2>() -= place_m.head<2>();
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_LT(worst_m(), 0.02);
    EXPECT_EQ(count(OdometryFault::kReset), 1U);
    EXPECT_EQ(refused_, 0);
  }
}

/// In another frame from `from` on.
void moveFrame(const Eigen::Isometry3d& T_new_old, std::size_t from,
               std::vector<OdometryState>& messages) {
  for (std::size_t i = from; i < messages.size(); ++i)
    messages[i].T_odom_base = T_new_old * messages[i].T_odom_base;
}

Eigen::Isometry3d levelFrame(double yaw_rad, double x_m, double y_m) {
  return Eigen::Translation3d(x_m, y_m, 0) *
         Eigen::Isometry3d(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

TEST_F(OdometryAdapterTest, AHeadingThatJumpsGoesOnAndIsCounted) {
  for (const double jump_rad : {-3.0, -0.5, 0.5, 1.5}) {
    for (const bool bursts : {false, true}) {
      Faults faults;
      faults.bursts = bursts;
      auto messages = messagesOf(faults);
      moveFrame(levelFrame(jump_rad, 1, -2), 6000, messages);
      for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
        if (bursts && mode == OdometryMode::kPose) continue;  // poses of a burst stay bunched
        feed(messages, mode);
        EXPECT_EQ(count(OdometryFault::kTurn), 1U) << jump_rad;
        EXPECT_LT(worst_m(), 0.06) << jump_rad << (bursts ? ", bursts" : "");
        const double turn_rad = Eigen::AngleAxisd(truthAt(59.995).T_odom_base.linear().transpose() *
                                                  states_.back().T_odom_base.linear())
                                    .angle();
        EXPECT_LT(turn_rad, 0.03) << jump_rad;
        EXPECT_EQ(states_.back().start, 0U);
      }
    }
  }
}

TEST_F(OdometryAdapterTest, AHeadingThatCatchesUpAfterAFreezeIsBelieved) {
  auto messages = messagesOf({});
  for (std::size_t i = 1000; i < 2000; ++i) {
    messages[i].T_odom_base = messages[999].T_odom_base;
    messages[i].twist_base = messages[999].twist_base;
  }
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 0U);
  EXPECT_EQ(states_.back().T_odom_base.matrix(), messages.back().T_odom_base.matrix());
}

TEST_F(OdometryAdapterTest, ASingleMessageOfNonsenseTurnsNothing) {
  auto messages = messagesOf({});
  messages[600].T_odom_base = levelFrame(2, 30, 40) * messages[600].T_odom_base;
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 2U);
  EXPECT_LT(worst_m(), 0.03);
  EXPECT_EQ(states_.back().start, 0U);
}

TEST_F(OdometryAdapterTest, TwoMessagesOfNonsenseAreNoOtherFlight) {
  auto messages = messagesOf({});
  for (const std::size_t i : {1000, 3000})
    messages[i].T_odom_base = levelFrame(2, 30, 40) * messages[i].T_odom_base;
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 4U);
  EXPECT_LT(worst_m(), 0.05);
  EXPECT_EQ(states_.back().start, 0U);
}

TEST_F(OdometryAdapterTest, NeitherWrongUnitsNorStampsThatAreNearlyEqualTurnAnything) {
  for (const double unit : {0.0, 180 / M_PI}) {
    for (const std::int64_t apart_ns : {100'000, 1'000'000}) {
      auto messages = messagesOf({});
      for (std::size_t i = 0; i < messages.size(); ++i) {
        messages[i].twist_base[5] = 0.5 * unit;
        // What came in 0.25 s is handed over at its end.
        const std::size_t end = i - i % 50 + 49;
        messages[i].stamp_ns = truthAt(static_cast<double>(end) * kStep_s).stamp_ns -
                               static_cast<std::int64_t>(end - i) * apart_ns;
      }
      feed(messages, OdometryMode::kPose);
      EXPECT_EQ(count(OdometryFault::kTurn), 0U) << unit << ", " << apart_ns;
      EXPECT_EQ(states_.back().start, 0U);
    }
  }
}

TEST_F(OdometryAdapterTest, AfterAnotherFlightsOdometryThePlaceIsUnknown) {
  auto messages = messagesOf({});
  moveFrame(levelFrame(2, 3, 4), 1000, messages);
  moveFrame(levelFrame(2, 3, 4).inverse(), 2000, messages);
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 2U);
  EXPECT_EQ(states_.front().start, 0U);
  EXPECT_EQ(states_[1999].start, 0U);
  EXPECT_EQ(states_[2000].start, 1U);
  EXPECT_EQ(states_.back().T_odom_base.matrix(), messages.back().T_odom_base.matrix());
}

TEST_F(OdometryAdapterTest, AfterAGapAPoseAtTheOriginIsANewStart) {
  const auto withGap = [](double gap_s, const Eigen::Isometry3d& T_start) {
    auto messages = messagesOf({});
    const auto again = static_cast<std::size_t>(1000 + std::lround(gap_s / kStep_s));
    const Eigen::Isometry3d& there = messages[again].T_odom_base;
    Eigen::Isometry3d T_origin_odom = Eigen::Isometry3d::Identity();
    T_origin_odom.linear() =
        Eigen::AngleAxisd(-std::atan2(there(1, 0), there(0, 0)), Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    T_origin_odom.translation() = -(T_origin_odom.linear() * there.translation());
    moveFrame(T_start * T_origin_odom, again, messages);
    messages.erase(messages.begin() + 1000, messages.begin() + static_cast<std::ptrdiff_t>(again));
    return messages;
  };
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(withGap(2, levelFrame(0.01, 0.02, 0)), mode);
    EXPECT_EQ(count(OdometryFault::kStartedAgain), 1U);
    EXPECT_EQ(count(OdometryFault::kHole), 0U) << "the way in it is not lost, all is";
    EXPECT_EQ(states_[999].start, 0U);
    EXPECT_EQ(states_[1000].start, 1U);
    EXPECT_LT(states_[1000].T_odom_base.translation().head<2>().norm(), 0.021);
    EXPECT_EQ(states_.back().start, 1U);
    for (const auto& messages :
         {withGap(2, levelFrame(0, 0.1, 0)), withGap(2, levelFrame(0.1, 0, 0)),
          withGap(0.4, levelFrame(0, 0, 0))}) {
      feed(messages, mode);
      EXPECT_EQ(count(OdometryFault::kStartedAgain), 0U);
    }
  }
}

TEST_F(OdometryAdapterTest, StampsThatBeginAnewBeginANewFlight) {
  auto messages = messagesOf({});
  messages.resize(1000);
  OdometryAdapter adapter({OdometryMode::kTwist, OdometryHeight::kPose});
  std::vector<OdometryState> first;
  std::vector<OdometryState> second;
  for (const auto& message : messages) adapter.push(message, first);
  for (const auto& message : messages) EXPECT_EQ(adapter.push(message, second), Push::kAccepted);
  EXPECT_EQ(adapter.faults()[static_cast<std::size_t>(OdometryFault::kRestart)], 1U);
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(second[i].T_odom_base.matrix(), first[i].T_odom_base.matrix());
  // Less than a second back is late, not new.
  EXPECT_EQ(adapter.push(messages[900], second), Push::kBackwardStamp);
}

TEST_F(OdometryAdapterTest, WholeMetresAreToldAndSmoothedByTheTwist) {
  Faults faults;
  faults.whole_metres = true;
  auto messages = messagesOf(faults);
  for (auto& message : messages) message.covariance = 0.01 * Matrix6d::Identity();
  feed(messages, OdometryMode::kPose);
  EXPECT_GT(count(OdometryFault::kWholeMetres), 3U);
  EXPECT_EQ(states_.back().T_odom_base.matrix(), messages.back().T_odom_base.matrix());
  EXPECT_EQ(states_.front().covariance(2, 2), 0.01);
  EXPECT_NEAR(states_.back().covariance(2, 2), 0.01 + 1.0 / 12, 1e-12);
  EXPECT_EQ(states_.back().covariance(0, 0), 0.01);

  feed(messages, OdometryMode::kTwist);
  double fastest_m = 0;
  for (std::size_t i = 1; i < states_.size(); ++i) {
    const double displacement_m = std::abs(states_[i].T_odom_base.translation().z() -
                                           states_[i - 1].T_odom_base.translation().z());
    fastest_m = std::max(fastest_m, displacement_m);
  }
  EXPECT_LT(fastest_m, 0.01) << "no steps";
  double late_error_m = 0;
  for (std::size_t i = states_.size() / 2; i < states_.size(); ++i)
    late_error_m = std::max(late_error_m, std::abs(errorOf_m(states_[i]).z()));
  // They correct the metre that was not known at the beginning by at most 0.03 m/s.
  EXPECT_LT(late_error_m, 0.25) << "the crossings of whole metres tell the height";
  EXPECT_LT(std::abs(errorOf_m(states_.back()).z()), 0.5 * std::abs(errorOf_m(states_[50]).z()));
}

TEST_F(OdometryAdapterTest, ConstantHeightsAreNotWholeMetres) {
  auto messages = messagesOf({});
  for (auto& message : messages) message.T_odom_base.translation().z() = 0;
  feed(messages, OdometryMode::kTwist);
  EXPECT_EQ(count(OdometryFault::kWholeMetres), 0U);
}

TEST_F(OdometryAdapterTest, BurstsAreSpreadOverTheGapBefore) {
  Faults faults;
  faults.bursts = true;
  const auto sound = messagesOf({});
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messagesOf(faults), mode);
    EXPECT_EQ(count(OdometryFault::kBurst), 1000U);
    EXPECT_EQ(refused_, 0);
    // The first burst's first message is out before it is known as one.
    ASSERT_EQ(states_.size(), sound.size() - 5);
    for (std::size_t i = 1; i < states_.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(states_[i].stamp_ns - sound[i + 5].stamp_ns), 0, 5);
      if (mode == OdometryMode::kTwist) continue;
      EXPECT_EQ(states_[i].T_odom_base.matrix(), sound[i + 5].T_odom_base.matrix()) << i;
    }
  }
  EXPECT_LT(worst_m(), 0.03) << "the first burst's first message, 25 ms late";
  states_.erase(states_.begin());
  EXPECT_LT(worst_m(), 0.001) << "its way is not lost";
}

TEST_F(OdometryAdapterTest, AMessageSentTwiceIsRefusedAndIsNoBurst) {
  auto messages = messagesOf({});
  messages.insert(messages.begin() + 10, messages[9]);
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(refused_, 1);
  EXPECT_EQ(count(OdometryFault::kBurst), 0U);
}

TEST_F(OdometryAdapterTest, SilenceAndATwistOfZerosAreNamed) {
  auto messages = messagesOf({});
  messages.erase(messages.begin() + 1000, messages.begin() + 1400);
  feed(messages, OdometryMode::kTwist);
  EXPECT_EQ(count(OdometryFault::kHole), 1U);
  for (auto& message : messages) message.twist_base.setZero();
  feed(messages, OdometryMode::kTwist);
  EXPECT_GE(count(OdometryFault::kNoTwist), 40U);
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kNoTwist), 0U) << "nobody needs it";
}

TEST_F(OdometryAdapterTest, ZeroCovariancesAreCountedAndNotWarnedOf) {
  const auto messages = messagesOf({});
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kNoCovariance), messages.size());
  EXPECT_FALSE(positionVariance_m2(states_.back()));
  EXPECT_FALSE(isWorthWarning(OdometryFault::kNoCovariance));
}

TEST_F(OdometryAdapterTest, AllFaultsTogether) {
  Faults faults;
  faults.mirrored_yaw = true;
  faults.epoch_at_s = 20;
  faults.whole_metres = true;
  faults.bursts = true;
  const auto messages = messagesOf(faults);
  feed(messages, OdometryMode::kPose);
  EXPECT_GT(worst_m(), 3);
  feed(messages, OdometryMode::kTwist);
  EXPECT_LT(worst_m(), 0.05);
  EXPECT_EQ(count(OdometryFault::kJump), 1U);
  EXPECT_GT(count(OdometryFault::kBurst), 900U);
  EXPECT_GT(count(OdometryFault::kWholeMetres), 3U);
  EXPECT_EQ(count(OdometryFault::kReset) + count(OdometryFault::kHole), 0U);
}

TEST(OdometryFaults, EachHasASentence) {
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i)
    EXPECT_GT(std::string(explain(static_cast<OdometryFault>(i))).size(), 30U) << i;
}

}  // namespace
}  // namespace ardrone_vslam
