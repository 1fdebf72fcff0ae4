// SPDX-License-Identifier: BSD-3-Clause
// ROS messages as the bytes that come over the network.
#pragma once

#include <ros/serialization.h>

#include <optional>

#include "bags/messages/bag_read_message.hpp"
#include "fuzz/fuzz_input.hpp"

namespace ardrone_vslam::fuzz {

template <class Message>
Bytes serialized(const Message& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  return bytes;
}

/// @return nothing where the bytes end before the message does
template <class Message>
std::optional<Message> deserialized(Bytes bytes, const SerialLayout& layout) {
  Message message;
  try {
    // By the lengths alone roscpp takes memory: nothing that this package could hinder.
    checkLengths(bytes, layout);
    ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::deserialize(in, message);
  } catch (const ros::Exception&) {
    return std::nullopt;
  }
  return message;
}
template <class Message>
std::optional<Message> deserialized(const Bytes& bytes) {
  return deserialized<Message>(bytes, serialLayout<Message>());
}

}  // namespace ardrone_vslam::fuzz
