// SPDX-License-Identifier: BSD-3-Clause
// Bags: refused by name, or read to the last image. Bytes of a whole file, or changes of one that
// is sound: these come past lengths and indices.
#include "fuzz/fuzz_input.hpp"
#include "offline_ros/bag_damage.hpp"

namespace ardrone_vslam::fuzz {
namespace {

enum Kind : std::uint8_t { kWhole, kUncompressed, kLz4, kBz2, kKinds };

BagRecipe recipe() {
  BagRecipe recipe;
  recipe.size_px = {16, 12};
  recipe.image_stamps_s.resize(2);
  recipe.odometry.resize(3);
  recipe.camera_info.width = 16;
  recipe.camera_info.height = 12;
  recipe.camera_info.K[2] = recipe.camera_info.P[2] = 8;
  recipe.camera_info.K[5] = recipe.camera_info.P[6] = 6;
  return recipe;
}

const Bytes& soundBag(Kind kind) {
  static const std::vector<Bytes> bags = [] {
    std::vector<Bytes> all;
    for (const auto compression :
         {rosbag::compression::Uncompressed, rosbag::compression::LZ4, rosbag::compression::BZ2})
      all.push_back(bytesOf(bytesOfRecipe(recipe(), compression)));
    return all;
  }();
  return bags.at(kind == kWhole ? 0 : kind - 1U);
}

/// Places of two bytes, lengths of one, and so many bytes.
Bytes changed(Bytes bag, FuzzInput changes) {
  while (changes.left() > 2) {
    const std::size_t at = changes.take<std::uint16_t>() % bag.size();
    const Bytes bytes = changes.part(changes.take<std::uint8_t>()).rest();
    const std::size_t count = std::min(bytes.size(), bag.size() - at);
    std::copy_n(bytes.begin(), count, bag.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return bag;
}

/// How the odometry is read, and whether the ranges and the navdata's heights are.
BagReadOptions optionsOf(std::uint8_t choice) {
  BagReadOptions options;
  options.odometry_mode =
      static_cast<OdometryMode>(choice % EnumNames<OdometryMode>::kNames.size());
  options.rectified = (choice & 8U) != 0;
  return options;
}

}  // namespace

std::vector<Bytes> seeds() {
  Bytes whole{kWhole, 0};
  const Bytes& bag = soundBag(kWhole);
  whole.insert(whole.end(), bag.begin(), bag.end());
  return {whole, {kUncompressed, 0}, {kLz4, 0}, {kBz2, 0}, {kUncompressed, 8, 100, 5, 2, 1, 7}};
}

std::size_t repair(std::uint8_t* /*data*/, std::size_t size, std::size_t /*most_size*/) {
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam;
  static const TemporaryFolder folder;
  static const std::string path = folder.file("a.bag");
  fuzz::FuzzInput input(data, size);
  const auto kind = static_cast<fuzz::Kind>(input.take<std::uint8_t>() % fuzz::kKinds);
  const BagReadOptions options = fuzz::optionsOf(input.take<std::uint8_t>());
  const fuzz::Bytes bag =
      kind == fuzz::kWhole ? input.rest() : fuzz::changed(fuzz::soundBag(kind), input);
  folder.write("a.bag", {bag.begin(), bag.end()});
  const std::string error = readAll(path, options);
  fuzz::require(error.empty() || error.find(path) != std::string::npos, "errors name the bag");
  return 0;
}
