// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/mapper_nodelet.hpp"

#include <pluginlib/class_list_macros.hpp>
#include <utility>

#include "conversions/frame_names.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kTick_s = 0.05;  // how late the end of a wait may be noticed

double now_s() {
  return ros::SteadyTime::now().toSec();
}

}  // namespace

void MapperNodelet::onInit() {
  readParameters();
  outputs_ = std::make_unique<MapperOutputs>(getNodeHandle(), settings().node.outputs);
  extrinsics_ = std::make_unique<ExtrinsicsTf>(getNodeHandle());
  makeMaps();
  makeInputs();
  status_ = std::make_unique<MapperStatus>(
      getNodeHandle(), getPrivateNodeHandle(), getName(),
      MapperStatus::Parts{*features_, *odometry_, *heights_, *extrinsics_, *matcher_, *slam_,
                          *parameters_},
      warnings_);
  // Last: callbacks run at once, in another thread. In this one, which loads the tracker, too:
  // where one thread advertises while another subscribes, roscpp connects them twice.
  start();
}

void MapperNodelet::readParameters() {
  try {
    parameters_ = std::make_unique<MapperParameters>(
        getPrivateNodeHandle(), warnings_,
        [this](const std::string& read) { NODELET_INFO_STREAM(read); });
    const SlamConfig& slam = settings().slam;
    slam_ = std::make_unique<LiveSlam>(slam, warnings_);
    matcher_ = std::make_unique<FrameMatcher>(slam.odometry, settings().node.odometry_wait_s,
                                              slam_->setup().clock());
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
}

void MapperNodelet::makeMaps() {
  MapServices::Calls calls;
  calls.save = [this] { return slam_->save(); };
  calls.use = [this](std::shared_ptr<const SavedMap> map) {
    const std::string why = map ? "a map was loaded" : "reset was called";
    slam_->useMap(std::move(map));
    if (slam_->hasMap()) beginMapAnew(why);
  };
  calls.look_near = [this](const MapServices::InitialPose& pose) {
    const auto hint = toPlaceHint(pose, odometry_->frames().map);
    if (!hint.value) throw MapFileError(hint.fault);
    slam_->lookNear(*hint.value);
  };
  calls.is_fixed = [this] { return slam_->isMapFixed(); };
  maps_ = std::make_unique<MapServices>(getPrivateNodeHandle(), std::move(calls),
                                        settings().node.save_map);
  maps_->kept().setPeriod(settings().node.autosave.period_s());
  try {
    const std::string fault = faultOfMaps(settings().slam);
    if (!settings().node.save_map.empty() && !fault.empty()) throw MapFileError(fault);
    if (settings().node.map_file.empty()) return;
    slam_->useMap(MapServices::open(settings().node.map_file));
  } catch (const MapFileError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
}

void MapperNodelet::makeInputs() {
  ros::NodeHandle& nh = getNodeHandle();
  odometry_ = std::make_unique<OdometryTopic>(
      nh, *extrinsics_, settings(), *matcher_, warnings_,
      OdometryTopic::Calls{
          [this](std::int64_t stamp_ns) { restartAt(stamp_ns, odometry_->name()); },
          [this] { processReady(); }});
  heights_ =
      std::make_unique<HeightTopic>(settings().slam.height_input, settings().slam.odometry.buffer_s,
                                    [this](const std::string& topic, const std::string& fault) {
                                      warnings_.refuse(topic, fault);
                                    });
  features_ = std::make_unique<FeaturesTopic>(
      nh, warnings_,
      FeaturesTopic::Calls{
          [this](std::int64_t stamp_ns) { restartAt(stamp_ns, features_->name()); },
          [this](const FeaturesConstPtr& features) {
            matcher_->addFeatures(features, now_s());
            processReady();
          }});
}

void MapperNodelet::start() {
  ros::NodeHandle& nh = getNodeHandle();
  timers_.every(nh, kTick_s, [this] {
    maps_->serve();
    processReady();
  });
  timers_.every(nh, 1.0, [this] { onSecond(); });
  timers_.every(nh, MapperOutputs::kMapPeriod_s, [this] {
    if (slam_->hasMap()) outputs_->publishMap(slam_->slam().landmarks(), odometry_->frames().map);
  });
  timers_.every(nh, MapperOutputs::kStatePeriod_s, [this] {
    static const Landmarks kNone;
    outputs_->publishState(status_->latest(), slam_->hasMap() ? slam_->slam().landmarks() : kNone);
  });
  heights_->subscribe(nh);
  odometry_->subscribe(nh);
  features_->subscribe(nh, settings().node.queue_size);
  parameters_->offer([this](const MapperChanges& changes) {
    slam_->change(changes.landmark_map, changes.frame_budget, changes.loaded_map);
    outputs_->change(changes.outputs);
    maps_->kept().setPeriod(changes.autosave.period_s());
    if (changes.loaded_map.localise_only != slam_->isMapFixed())
      warnings_.event("localise_only counts when the map begins anew: by load_map or reset");
  });
}

void MapperNodelet::processReady() {
  const auto can_use = [this](const Features& features) { return prepareSlam(features); };
  while (const auto frame = matcher_->next(now_s(), can_use)) processFrame(*frame);
}

bool MapperNodelet::prepareSlam(const Features& features) {
  const CameraIdentity camera = cameraOf(features);
  if (slam_->hasMap() && camera == slam_->camera()) return true;
  const std::string fault = odometry_->framesFault();
  if (!fault.empty()) {
    extrinsics_->wait(fault);
    return false;
  }
  const std::string map_fault = slam_->mapFault(camera);
  if (!map_fault.empty()) {
    extrinsics_->wait("map_file: " + map_fault);
    return false;
  }
  const Frames& frames = odometry_->frames();
  const std::string frame = withTfPrefix(settings().tf_prefix, camera.frame);
  const auto T_base_cam = extrinsics_->find(frames.base, frame);
  if (!T_base_cam) return false;
  useCamera(camera, *T_base_cam, frame);
  if (warnings_.allowsEvent())
    NODELET_INFO_STREAM("frames: " << frames.map << " -> " << frames.odom << " -> " << frames.base
                                   << " -> " << frame << ", camera at ("
                                   << T_base_cam->translation().transpose() << ") m");
  return true;
}

void MapperNodelet::useCamera(const CameraIdentity& camera, const Eigen::Isometry3d& T_base_cam,
                              const std::string& frame) {
  if (slam_->hasMap()) {
    const std::string change =
        "the camera changed from " + slam_->camera().text() + " to " + camera.text();
    slam_->countCameraChange();
    if (warnings_.allowsEvent()) NODELET_INFO_STREAM(change << ": the map goes on");
    odometry_->watch().changeCamera();
  }
  slam_->useCamera(camera, T_base_cam, odometry_->frames().base, frame);
}

void MapperNodelet::processFrame(const FrameMatcher::Frame& frame) {
  OdometryState odometry = frame.odometry;
  odometry.height_m = heights_->at(odometry);
  const FrameResult& result = slam_->process(*frame.features, odometry, matcher_->odometries());
  odometry_->watch().seeStep(result.odometry_step_m);
  if (result.revisit_m > 0) warnings_.limited(explainRevisit(result.revisit_m));
  // Of a fault of the set-up its report has warned.
  if (result.state == SlamState::kDistrusted && slam_->setup().fault().empty())
    warnings_.limited(explain(result.state));
  if (result.state == SlamState::kNotFinite) {  // answered by its status alone
    warnings_.limited(explain(result.state));
    return status_->publishAnswer(result, *frame.features);
  }
  odometry_->watch().seeImage(slam_->features(), frame.odometry.T_odom_base * slam_->T_base_cam());
  const Frames& frames = odometry_->frames();
  outputs_->publishFrame(result, slam_->slam().T_map_odom(), frames, frame.odometry);
  outputs_->publishTf(result.stamp_ns, mapToOdomOfTf(result), frames);
  status_->publishAnswer(result, *frame.features);
}

/// In tf, odom -> base is the driver's own: map -> base comes out right with it.
Eigen::Isometry3d MapperNodelet::mapToOdomOfTf(const FrameResult& result) const {
  Eigen::Isometry3d T_map_odom = slam_->slam().T_map_odom();
  if (odometry_->isInDriversFrame()) return T_map_odom;
  const Frames& frames = odometry_->frames();
  const auto T_odom_base = extrinsics_->latest(frames.odom, frames.base, result.stamp_ns);
  return T_odom_base ? result.T_map_base * T_odom_base->inverse() : T_map_odom;
}

void MapperNodelet::restartAt(std::int64_t stamp_ns, const std::string& topic) {
  // Features and odometry come apart: whichever is first finds the other's old run, the second
  // only its own.
  const std::int64_t limit_ns = stamp_ns + StampGuard::kRestart_ns - 1;
  const bool was_waiting = matcher_->forgetAfter(limit_ns);
  extrinsics_->tf().clear();  // a bag without /clock: tf cannot know
  if (slam_->hasMap() && slam_->answered_ns() > limit_ns) {
    beginMapAnew("stamps on " + topic + " jumped back (a bag plays again?)");
  } else if (was_waiting) {
    warnings_.event("stamps on " + topic + " jumped back: what waited for a pose is dropped");
  }
}

void MapperNodelet::beginMapAnew(const std::string& why) {
  warnings_.event(why + ": the map begins anew");
  slam_->endMap();
  maps_->kept().beginAnew();
  odometry_->watch().beginMapAnew();
  outputs_->clear();
}

void MapperNodelet::onSecond() {
  const bool has_features = features_->endSecond();
  const bool has_answer = slam_->endSecond();
  if (has_answer && heights_->isUsed()) {
    heights_->countSecond();
    if (isReminderDue(heights_->secondsWithout())) NODELET_WARN_STREAM(heights_->missing());
  }
  odometry_->seeTf(extrinsics_->tf().core());
  status_->endSecond(has_features, has_answer);
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::MapperNodelet, nodelet::Nodelet)
