// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <functional>
#include <string>

namespace ardrone_vslam {

/// Opens a bag after checkBag: rosbag's reader crashes on damaged bytes.
/// @throws std::runtime_error naming the file, the fault and the remedy; also when it holds nothing
void openForReading(rosbag::Bag& bag, const std::string& path);

/// Calls `read`; turns what the libraries throw at damaged messages, which names no file, into
/// unreadableBag. @throws std::runtime_error; other exceptions pass
void namingTheBag(const std::string& path, const std::function<void()>& read);

}  // namespace ardrone_vslam
