// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/mapper_nodelet.hpp"

#include <pluginlib/class_list_macros.hpp>

#include "conversions/frame_names.hpp"
#include "from_ros/params.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kTick_s = 0.05;                // how late the end of a wait may be noticed
constexpr std::uint32_t kOdometryQueue = 2000;  // 10 s at 200 Hz, while the mapper is busy

double now_s() {
  return ros::SteadyTime::now().toSec();
}

}  // namespace

void MapperNodelet::onInit() {
  readParameters();
  ros::NodeHandle& nh = getNodeHandle();
  frames_.map = withTfPrefix(tf_prefix_, node_config_.map_frame);
  outputs_ = std::make_unique<MapperOutputs>(nh, node_config_.outputs);
  status_pub_ = nh.advertise<Status>("status", 100);
  mounting_ = std::make_unique<Mounting>(nh);
  diagnostics_ =
      std::make_unique<diagnostic_updater::Updater>(nh, getPrivateNodeHandle(), getName());
  diagnostics_->setHardwareID("none");
  diagnostics_->add("mapper", this, &MapperNodelet::diagnose);
  const auto every = [&nh](double period_s, auto action) {
    return nh.createWallTimer(ros::WallDuration(period_s),
                              [action](const ros::WallTimerEvent&) { action(); });
  };
  tick_timer_ = every(kTick_s, [this] { processReady(); });
  second_timer_ = every(1.0, [this] { onSecond(); });
  map_timer_ = every(MapperOutputs::kMapPeriod_s, [this] {
    if (slam_) outputs_->publishMap(slam_->landmarks(), frames_.map);
  });
  subscribeOdometry();
  heights_ = std::make_unique<HeightTopic>(
      nh, config_.height_input, config_.odometry.buffer_s,
      [this](const std::string& topic, const std::string& fault) { warn(topic, fault); });
  features_sub_ = nh.subscribe("features", static_cast<std::uint32_t>(node_config_.queue_size),
                               &MapperNodelet::onFeatures, this);
}

void MapperNodelet::subscribeOdometry() {
  if (config_.odometry_adapter.mode != OdometryMode::kNavdata) {
    odometry_sub_ =
        getNodeHandle().subscribe("odometry", kOdometryQueue, &MapperNodelet::onOdometry, this,
                                  ros::TransportHints().tcpNoDelay());
    return;
  }
  const auto refuse = [this](const std::string& topic, const std::string& fault) {
    ++totals_.odometry_refused;
    warn(topic, fault);
  };
  navdata_ = std::make_unique<NavdataInput>(
      getNodeHandle(), config_.drone_filter,
      NavdataInput::Frames{node_config_.odom_frame, node_config_.base_frame, tf_prefix_},
      [this](const nav_msgs::OdometryConstPtr& odometry) { onOdometry(odometry); }, refuse);
  odometry_sub_ = navdata_->subscriber();
}

void MapperNodelet::readParameters() {
  ParamReader reader(getPrivateNodeHandle());
  reader.read(node_config_);
  reader.read(config_);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
    // Some faults lie between parameters: tell them now, not in mid-air.
    Slam(config_, Eigen::Isometry3d::Identity());
    adapter_ = std::make_unique<OdometryAdapter>(config_.odometry_adapter);
    matcher_ = std::make_unique<FrameMatcher>(config_.odometry, node_config_.odometry_wait_s,
                                              config_.image_time_offset_s);
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  tf_prefix_ = tfPrefixOf(getPrivateNodeHandle());
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " mapper: "
                      << reader.summary()
                      << (tf_prefix_.empty() ? "" : " tf_prefix=" + tf_prefix_));
}

void MapperNodelet::onFeatures(const FeaturesConstPtr& features) {
  has_features_ = true;
  totals_.images_dropped = features->images_dropped;
  totals_.images_dropped_queue = features->images_dropped_queue;
  totals_.images_without_camera_info = features->images_without_camera_info;
  gaps_.see(features->header.seq);
  totals_.dropped_queue = gaps_.lost();
  if (!acceptFeatures(*features)) return;
  matcher_->addFeatures(features, now_s());
  processReady();
}

bool MapperNodelet::acceptFeatures(const Features& features) {
  const std::string fault = faultOf(features);
  if (!fault.empty()) {
    ++totals_.dropped_bad_message;
    warn(features_sub_.getTopic(), fault);
    return false;
  }
  switch (stamps_.check(toNanoseconds(features.header.stamp))) {
    case StampGuard::Answer::kNotAfter:
      ++totals_.dropped_stamp;
      warn(features_sub_.getTopic(), "its stamp is not after the one before; stamps must ascend");
      return false;
    case StampGuard::Answer::kRestart:
      restartAt(toNanoseconds(features.header.stamp), features_sub_.getTopic());
      return true;
    case StampGuard::Answer::kAscending:
      return true;
  }
  return true;
}

void MapperNodelet::onOdometry(const nav_msgs::OdometryConstPtr& odometry) {
  const auto checked = toUnboundedState(*odometry);
  std::string fault = checked.fault;
  if (checked.value) {
    const std::int64_t back_ns = matcher_->newestObserver_ns() - checked.value->stamp_ns;
    if (back_ns >= StampGuard::kRestart_ns) {
      restartAt(checked.value->stamp_ns, odometry_sub_.getTopic());
    }
    fault = takeOdometry(*checked.value);
    noteOdometryFaults();
    if (fault.empty()) {
      takeFrameNames(*odometry);
      noteCovariance(*checked.value);
    }
    processReady();
  }
  if (fault.empty()) return;
  ++totals_.odometry_refused;
  warn(odometry_sub_.getTopic(), fault);
}

std::string MapperNodelet::takeOdometry(const OdometryState& message) {
  ready_.clear();
  std::string fault = explain(adapter_->push(message, ready_), message);
  for (const OdometryState& state : ready_) {
    const OdometryBuffer::Push answer = matcher_->addOdometry(state);
    if (answer == OdometryBuffer::Push::kAccepted) {
      noteSpeed(state);
    } else {
      fault = explain(answer, state);
    }
  }
  return fault;
}

void MapperNodelet::takeFrameNames(const nav_msgs::Odometry& odometry) {
  const auto chosen = [](const std::string& parameter, const std::string& header) -> const auto& {
    return parameter.empty() ? header : parameter;
  };
  frames_.odom =
      withTfPrefix(tf_prefix_, chosen(node_config_.odom_frame, odometry.header.frame_id));
  frames_.base = withTfPrefix(tf_prefix_, chosen(node_config_.base_frame, odometry.child_frame_id));
}

void MapperNodelet::processReady() {
  const auto can_use = [this](const Features& features) { return prepareSlam(features); };
  while (const auto frame = matcher_->next(now_s(), can_use)) processFrame(*frame);
  totals_.dropped_no_odometry = matcher_->droppedNoOdometry();
  totals_.dropped_no_extrinsics = matcher_->droppedHeld();
}

bool MapperNodelet::prepareSlam(const Features& features) {
  const CameraIdentity camera = cameraOf(features);
  if (slam_ && camera == camera_) return true;
  if (frames_.odom.empty() || frames_.base.empty()) {
    extrinsics_fault_ = odometry_sub_.getTopic() + " names no " +
                        (frames_.odom.empty() ? "frame_id; set the parameter odom_frame"
                                              : "child_frame_id; set the parameter base_frame");
    return false;
  }
  const std::string frame = withTfPrefix(tf_prefix_, camera.frame);
  const auto T_base_cam = mounting_->find(frames_.base, frame, extrinsics_fault_);
  if (!T_base_cam) return false;
  extrinsics_fault_.clear();
  useCamera(camera, *T_base_cam);
  NODELET_INFO_STREAM("frames: " << frames_.map << " -> " << frames_.odom << " -> " << frames_.base
                                 << " -> " << frame << ", camera at ("
                                 << T_base_cam->translation().transpose() << ") m");
  return true;
}

void MapperNodelet::useCamera(const CameraIdentity& camera, const Eigen::Isometry3d& T_base_cam) {
  if (slam_) {
    const std::string change = "the camera changed from " + camera_.text() + " to " + camera.text();
    ++totals_.camera_changes;
    if (slam_->canChangeCamera()) {
      NODELET_INFO_STREAM(change << ": the map goes on");
      slam_->changeCamera(T_base_cam);
      standstill_.reset();
    } else {
      beginMapAnew(change + ", and extrinsics_sigma_deg is of one camera");
    }
  }
  if (!slam_) slam_ = std::make_unique<Slam>(config_, T_base_cam);
  if (time_offset_) {
    time_offset_->useCamera(T_base_cam);
  } else {
    time_offset_ = std::make_unique<TimeOffsetEstimator>(T_base_cam, config_.image_time_offset_s);
  }
  camera_ = camera;
  T_base_cam_ = T_base_cam;
}

void MapperNodelet::processFrame(const FrameMatcher::Frame& frame) {
  toFeatures(*frame.features, features_);
  OdometryState odometry = frame.odometry;
  odometry.height_m = heights_->at(odometry);
  odometry.stamp_ns = features_.stamp_ns;  // the pose keeps the image's stamp
  time_offset_->see(features_, matcher_->odometries());
  noteTimeOffset();
  const FrameResult& result = slam_->process(features_, odometry, stage_clock_.hook());
  if (result.height == HeightOutcome::kRejected) ++totals_.heights_rejected;
  noteStep(result.odometry_step_m);
  noteDistrust(result.state);
  has_answer_ = true;
  if (result.state == SlamState::kNotFinite) return refuseResult(result, *frame.features);
  answered_ns_ = result.stamp_ns;
  ++totals_.images;
  standstill_.see(features_, frame.odometry.T_odom_base * T_base_cam_);
  outputs_->publishFrame(result, slam_->T_map_odom(), frames_, frame.odometry);
  outputs_->publishTf(result.stamp_ns, mapToOdomOfTf(result), frames_);
  publishStatus(result, *frame.features);
}

/// In tf, odom -> base is the driver's own, which is not what was integrated anew: map -> base
/// comes out right all the same.
Eigen::Isometry3d MapperNodelet::mapToOdomOfTf(const FrameResult& result) const {
  if (config_.odometry_adapter.mode == OdometryMode::kPose) return slam_->T_map_odom();
  const auto T_odom_base = mounting_->T_odom_base(frames_.odom, frames_.base, result.stamp_ns);
  return T_odom_base ? result.T_map_base * T_odom_base->inverse() : slam_->T_map_odom();
}

void MapperNodelet::restartAt(std::int64_t stamp_ns, const std::string& topic) {
  // Features and odometry come apart: whichever is first finds the other's old run, the second
  // only its own.
  const std::int64_t limit_ns = stamp_ns + StampGuard::kRestart_ns - 1;
  const bool was_waiting = matcher_->forgetAfter(limit_ns);
  mounting_->tf().clear();  // a bag without /clock: tf cannot know
  if (slam_ && answered_ns_ > limit_ns) {
    beginMapAnew("stamps on " + topic + " jumped back (a bag plays again?)");
  } else if (was_waiting) {
    NODELET_WARN_STREAM("stamps on " << topic << " jumped back: what waited for a pose is dropped");
  }
}

void MapperNodelet::beginMapAnew(const std::string& why) {
  NODELET_WARN_STREAM(why << ": the map begins anew");
  ++totals_.restarts;
  slam_.reset();
  standstill_.reset();
  speed_ = {};
  answered_ns_ = 0;
  outputs_->clear();
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::MapperNodelet, nodelet::Nodelet)
