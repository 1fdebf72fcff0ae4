// SPDX-License-Identifier: BSD-3-Clause
// map_tool: looks into map files, and makes others of them (docs/fly_again.md).

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ardrone_vslam/rotation.hpp"
#include "ardrone_vslam/saved_map.hpp"
#include "maps/map_merge.hpp"
#include "maps/map_parts.hpp"
#include "maps/map_text.hpp"
#include "program/progress_line.hpp"
#include "program/tool_main.hpp"
#ifdef ARDRONE_VSLAM_WITH_CERES
#include "refine/refined_map.hpp"
#endif
#include "trajectory/metrics.hpp"
#include "trajectory/text_file.hpp"

namespace {

using namespace ardrone_vslam;

struct Options {
  std::string map;
  std::string other;
  std::string out;
  bool as_json = false;
  PruneRules rules;
  std::vector<double> from_m, to_m;
};

/// Writes the map, and says what became of the landmarks of before.
int write(const std::string& path, const SavedMap& map, std::size_t before) {
  const std::size_t written = writeMap(path, map, "map_tool " ARDRONE_VSLAM_VERSION);
  std::printf("%s: %zu landmarks of %zu, %zu anchors\n", path.c_str(), written, before,
              map.anchors.size());
  return 0;
}

/// Writes what is left of a map. @param remedy  what to do where that is nothing
int writePart(const Options& o, const SavedMap& part, std::size_t before, const char* remedy) {
  if (part.landmarks.empty())
    throw std::runtime_error(o.map + ": no landmark is left of " + std::to_string(before) +
                             ", so nothing is written; " + remedy);
  return write(o.out, part, before);
}

int info(const Options& o) {
  const nlohmann::ordered_json facts = factsOf(readMap(o.map, WithFlight::kYes));
  if (o.as_json) {
    std::cout << facts.dump(2) << '\n';
    return 0;
  }
  for (const auto& [name, value] : facts.items()) std::cout << name << ": " << value << '\n';
  return 0;
}

int verify(const Options& o) {
  const SavedMap map = readMap(o.map, WithFlight::kYes);
  std::printf("%s: sound: %zu landmarks, %zu anchors, %zu keyframes\n", o.map.c_str(),
              map.landmarks.size(), map.anchors.size(), map.flight.keyframes.size());
  return 0;
}

int exportMap(const Options& o) {
  const SavedMap map = readMap(o.map);
  const std::string ending = o.out.substr(std::min(o.out.size(), o.out.rfind('.')));
  if (ending != ".ply" && ending != ".csv")
    throw UsageError(o.out + ": must end in .ply or .csv, which says what is written");
  writeText(o.out, ending == ".ply" ? plyOf(map) : csvOf(map));
  std::printf("%s: %zu landmarks\n", o.out.c_str(), map.landmarks.size());
  return 0;
}

/// What is written has no views: in place of the map, nothing could be refined any more.
void checkOut(const Options& o) {
  for (const std::string& in : {o.map, o.other}) {
    std::error_code error;
    if (std::filesystem::equivalent(in, o.out, error))
      throw UsageError("--out " + o.out + " is the map that is read: name another file");
  }
  checkWritable(o.out);
}

int pruneMap(const Options& o) {
  checkOut(o);
  const SavedMap map = readMap(o.map);
  return writePart(o, prune(map, o.rules), map.landmarks.size(),
                   "loosen --least-seen or --most-sigma-m");
}

int crop(const Options& o) {
  checkOut(o);
  const Eigen::Map<const Eigen::Vector3d> from_m(o.from_m.data());
  const Eigen::Map<const Eigen::Vector3d> to_m(o.to_m.data());
  if ((from_m.array() >= to_m.array()).any())
    throw UsageError("--from must be less than --to along x, y and z");
  const SavedMap map = readMap(o.map);
  const SavedMap part = partOf(map, [&](const Landmark& landmark) {
    const auto& p = landmark.position_map.array();
    return (p >= from_m.array()).all() && (p <= to_m.array()).all();
  });
  return writePart(o, part, map.landmarks.size(), "map_tool info says where they are");
}

int mergeMaps(const Options& o) {
  checkOut(o);
  const SavedMap a = readMap(o.map);
  const SavedMap b = readMap(o.other);
  const std::string fault = mergeFault(a, b);
  if (!fault.empty()) throw MapFileError(o.map + " and " + o.other + ": " + fault);
  std::vector<LandmarkPair> pairs;
  {
    ProgressLine progress("map_tool: landmarks matched", a.landmarks.size());
    pairs = pairsOf(a, b, [&progress](std::size_t done) { progress.update(done); });
  }
  if (areOfOneFlight(a, b, pairs)) {
    throw MapFileError(
        o.map + " and " + o.other +
        ": one was made from the other or of the same images, so that both know the same; use the "
        "newer one");
  }
  const MapAlignment alignment = align(a, b, pairs);
  std::printf("%zu landmarks look alike, %zu of them lie in one place\n", pairs.size(),
              alignment.agreed.size());
  if (alignment.is_chance) {
    throw MapFileError(
        o.map + " and " + o.other +
        ": that many agree by chance, too, so nothing is written: they are not of one place, "
        "or share too little of it; fly through both places in one more flight");
  }
  const MergedMap merged = merge(a, b, alignment);
  const Eigen::Vector3d p = alignment.T_a_b.translation();
  std::printf("the second map's origin lies at %.2f %.2f %.2f m, turned by %.1f degrees\n", p.x(),
              p.y(), p.z(), yawOf(alignment.T_a_b.linear()) * 180 / M_PI);
  std::printf("known to %.3f m and %.2f degrees\n", merged.sigma_m, merged.sigma_rad * 180 / M_PI);
  std::printf(
      "both corrected, half of these landmarks are within %.3f m; %zu are taken for the same\n",
      merged.apart_m, merged.shared);
  return write(o.out, merged.map, a.landmarks.size() + b.landmarks.size());
}

#ifndef ARDRONE_VSLAM_WITH_CERES
int refineMap(const Options& /*o*/) {
  throw UsageError("refine: this map_tool was built without Ceres 2");
}
#else
int refineMap(const Options& o) {
  checkOut(o);
  const SavedMap map = readMap(o.map, WithFlight::kYes);
  if (map.flight.keyframes.empty())
    throw MapFileError(
        o.map +
        ": there are no views in it, so nothing can be refined: it was made by another command of "
        "map_tool or an earlier version, in a loaded map, after a click, or it was carried, or its "
        "odometry began anew");
  Refinement refinement;
  {
    constexpr std::size_t kOfOne = 100;
    ProgressLine progress("map_tool: refining", kOfOne);
    refinement = refine(map.flight, map.anchors, [&progress](double share) {
      progress.update(static_cast<std::size_t>(kOfOne * share));
    });
    progress.update(kOfOne);
  }
  const SavedMap refined = refinedMap(map, map.flight, refinement);
  std::printf("%zu keyframes, %zu points, %zu views; %zu views contradict them and are left out\n",
              refinement.T_map_base.size(), refinement.points.size(), refinement.views,
              refinement.views_left_out);
  if (refinement.extrinsics_sigma_rad) {
    const Eigen::Vector3d off_deg = 180 / M_PI * rotationVectorOf(refinement.R_base_rig.back());
    const Eigen::Vector3d sigma_deg = 180 / M_PI * *refinement.extrinsics_sigma_rad;
    std::printf("the camera is turned beside its extrinsics, in degrees about x, y, z of base:");
    for (int i = 0; i < 3; ++i) std::printf(" %.2f +- %.2f", off_deg[i], sigma_deg[i]);
    std::printf("\n");
  }
  std::vector<double> moved_m;
  for (std::size_t i = 0; i < map.landmarks.size(); ++i)
    moved_m.push_back((refined.landmarks[i].position_map - map.landmarks[i].position_map).norm());
  std::printf("half of the landmarks moved by more than %.3f m\n", quantile(moved_m, 0.5));
  if (refined.anchor_covariance.isApprox(map.anchor_covariance))
    std::printf("the map keeps the covariance of the flight\n");
  const double later_s =
      1e-9 * static_cast<double>(map.stamp_ns - map.flight.keyframes.back().stamp_ns);
  constexpr double kUsual_s = 2;
  if (later_s > kUsual_s)
    std::printf("views of the last %.0f s are missing: what was found then moves along, rigidly\n",
                later_s);
  return write(o.out, refined, map.landmarks.size());
}
#endif

/// A command with one map, which `run` answers.
CLI::App* addCommand(CLI::App& app, const std::string& name, const std::string& what, Options& o) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("map", o.map, "a map file")->required();
  return command;
}

void addOut(CLI::App* command, Options& o, const std::string& what = "the new map file") {
  command->add_option("--out", o.out, what)->required();
}

void addOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", std::string("map_tool (ardrone_vslam) " ARDRONE_VSLAM_VERSION));
  app.require_subcommand(1);
  addCommand(app, "info", "what is in it", o)->add_flag("--json", o.as_json, "as JSON");
  addCommand(app, "verify", "whether all of it is sound: exit code 0, or 1 and why not", o);
  addOut(addCommand(app, "export", "its landmarks for other programs", o), o,
         "file that ends in .ply (points for viewers) or .csv");
  CLI::App* prune = addCommand(app, "prune", "leaves out the landmarks that are worth least", o);
  prune->add_option("--least-seen", o.rules.least_seen, "keep what was seen so many times")
      ->check(CLI::Range(0, 1'000'000'000));
  prune->add_option("--most-sigma-m", o.rules.most_sigma_m, "keep what is known so well [m]")
      ->check(numberWithin(0.0, 1e9));
  prune->add_option("--most", o.rules.most, "keep so many: those that are worth most")
      ->check(CLI::Range(1, 1'000'000'000));
  addOut(prune, o);
  CLI::App* crop = addCommand(app, "crop", "keeps what lies within a box", o);
  for (const auto& [name, corner] : {std::pair("--from", &o.from_m), std::pair("--to", &o.to_m)})
    crop->add_option(name, *corner, "a corner of the box: x y z [m]")
        ->expected(3)
        ->required()
        ->check(numberWithin(-1e9, 1e9));
  addOut(crop, o);
  CLI::App* merge =
      addCommand(app, "merge", "two maps of one place as one, in the first one's frame", o);
  merge->add_option("other", o.other, "the second map file")->required();
  addOut(merge, o);
  addOut(addCommand(app, "refine", "optimises the flight that made it, all at once (Ceres)", o), o);
  app.footer("Exit code: 0 done, 1 a map cannot be read, written or merged, 2 for wrong usage.");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Looks into map files of earlier flights, and makes others of them.", "map_tool"};
  Options options;
  addOptions(app, options);
  return runTool(app, argc, argv, [&] {
    const std::string command = app.get_subcommands().front()->get_name();
    if (command == "info") return info(options);
    if (command == "verify") return verify(options);
    if (command == "export") return exportMap(options);
    if (command == "prune") return pruneMap(options);
    if (command == "crop") return crop(options);
    if (command == "refine") return refineMap(options);
    return mergeMaps(options);
  });
}
