// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <rosbag/message_instance.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace ardrone_vslam {

/// Fixed bytes, then an array (or a string): its length and so many elements.
struct SerialPart {
  std::uint32_t fixed_bytes;
  std::uint32_t element_bytes;  ///< 0: no array follows
};

/// How a message lies in the bag, as far as its lengths go.
struct SerialLayout {
  bool is_list;  ///< a length, and so many times the parts
  std::vector<SerialPart> parts;
};

/// For the types that are read from bags; others do not link.
template <class Message>
const SerialLayout& serialLayout();

/// ROS's deserializer makes an array as long as it is said to be before it looks whether so much is
/// there: a damaged length costs gigabytes.
/// @throws ros::serialization::StreamOverrunException when a length leads beyond the bytes
void checkLengths(const std::vector<std::uint8_t>& bytes, const SerialLayout& layout);

/// @return nothing when the message is of another type. @throws ros::Exception when it is damaged
template <class Message>
std::unique_ptr<Message> readMessage(const rosbag::MessageInstance& instance) {
  if (!instance.isType<Message>()) return nullptr;
  std::vector<std::uint8_t> bytes(instance.size());
  const auto size = static_cast<std::uint32_t>(bytes.size());
  ros::serialization::OStream out(bytes.data(), size);
  instance.write(out);
  checkLengths(bytes, serialLayout<Message>());
  auto message = std::make_unique<Message>();
  ros::serialization::IStream in(bytes.data(), size);
  ros::serialization::deserialize(in, *message);
  return message;
}

}  // namespace ardrone_vslam
