// SPDX-License-Identifier: BSD-3-Clause
#include "bags/messages/bag_open.hpp"

#include <ros/exception.h>
#include <rosbag/chunked_file.h>
#include <rosbag/view.h>
#include <yaml-cpp/exceptions.h>

#include <filesystem>
#include <limits>
#include <new>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "bags/check/bag_check.hpp"
#include "files/regular_file.hpp"

namespace ardrone_vslam {
namespace {

/// As rosbag does it when it reads a chunk.
void unpackChunk(const std::string& compression, std::vector<std::uint8_t>& packed,
                 std::vector<std::uint8_t>& content) {
  rosbag::ChunkedFile unpacker;
  unpacker.decompress(compression == "bz2" ? rosbag::compression::BZ2 : rosbag::compression::LZ4,
                      content.data(), static_cast<unsigned int>(content.size()), packed.data(),
                      static_cast<unsigned int>(packed.size()));
}

}  // namespace

void openForReading(rosbag::Bag& bag, const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw std::runtime_error(path + ": there is no such file; check the path");
  }
  requireFile(path, std::numeric_limits<std::uintmax_t>::max());
  if (std::filesystem::file_size(path) == 0) {
    throw std::runtime_error(path + ": is empty (0 bytes); record it again");
  }
  checkBag(path, unpackChunk);
  bag.open(path, rosbag::bagmode::Read);
  if (rosbag::View(bag).size() == 0) {
    throw std::runtime_error(path +
                             ": holds no message; record it again, or repair it by: rosbag "
                             "reindex " +
                             path);
  }
}

void namingTheBag(const std::string& path, const std::function<void()>& read) {
  const std::string impossible = "a length in it is impossible";
  try {
    read();
  } catch (const ros::Exception& e) {
    throw unreadableBag(path, e.what());
  } catch (const YAML::Exception& e) {
    throw unreadableBag(path, std::string("the note of its making: ") + e.what());
  } catch (const cv::Exception& e) {
    throw unreadableBag(path, e.what());
  } catch (const std::bad_alloc&) {
    throw unreadableBag(path, impossible);
  } catch (const std::length_error&) {
    throw unreadableBag(path, impossible);
  }
}

}  // namespace ardrone_vslam
