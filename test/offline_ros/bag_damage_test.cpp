// SPDX-License-Identifier: BSD-3-Clause
// Damaged bags: read, or refused by name; rosbag's reader alone crashes on many of these.

#include "bag_damage.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/CompressedImage.h>
#include <std_msgs/String.h>

#include "bags/messages/bag_read_message.hpp"

namespace ardrone_vslam {
namespace {

/// Counts what became of a bag's damaged copies and demands that each error names the file.
class Outcomes {
 public:
  void add(const std::string& bytes, const std::string& what) {
    folder_.write("damaged.bag", bytes);
    const std::string error = readAll(folder_.file("damaged.bag"));
    (error.empty() ? read_ : refused_) += 1;
    if (!error.empty()) {
      EXPECT_NE(error.find("damaged.bag"), std::string::npos) << what << ": " << error;
    }
  }
  int read() const { return read_; }
  int refused() const { return refused_; }

 private:
  TemporaryFolder folder_;
  int read_ = 0;
  int refused_ = 0;
};

class BagDamage : public testing::TestWithParam<rosbag::CompressionType> {};

TEST_P(BagDamage, TheStructure) {
  const std::string whole = bytesOfRecipe(BagRecipe(), GetParam());
  Damage damage(1);
  Outcomes outcomes;
  outcomes.add(whole, "whole");
  ASSERT_EQ(outcomes.read(), 1);
  const std::vector<std::size_t> structure = structureOf(whole);
  ASSERT_GT(structure.size(), 1000u);
  for (std::size_t i = damage.below(4); i < structure.size(); i += 1 + damage.below(5)) {
    outcomes.add(damage.at(whole, structure[i]), "byte " + std::to_string(structure[i]));
  }
  // A time or a padding may change unseen, and now and then a byte is overwritten with itself.
  EXPECT_GT(outcomes.refused(), 3 * outcomes.read());
}

TEST_P(BagDamage, MessagesAndBlocks) {
  const std::string whole = bytesOfRecipe(BagRecipe(), GetParam());
  Damage damage(2);
  Outcomes outcomes;
  for (int i = 0; i < 250; ++i) {
    outcomes.add(damage.at(whole, damage.below(whole.size())), "case " + std::to_string(i));
    outcomes.add(damage.anywhere(whole), "blocks " + std::to_string(i));
  }
  EXPECT_GT(outcomes.refused(), 50);
  EXPECT_GT(outcomes.read(), 50);
}

template <class Message>
void expectLayout(const Message& message, const std::string& name) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  const SerialLayout& layout = serialLayout<Message>();
  EXPECT_NO_THROW(checkLengths(bytes, layout)) << name;
  // One byte less is noticed: the layout leaves nothing out.
  bytes.pop_back();
  EXPECT_THROW(checkLengths(bytes, layout), ros::Exception) << name;
}

TEST(BagReadMessage, LayoutsAreThoseOfTheMessages) {
  const BagRecipe recipe;
  expectLayout(imageMessage(recipe, 0), "Image");
  expectLayout(recipe.camera_info, "CameraInfo");
  expectLayout(recipe.odometry[0], "Odometry");
  sensor_msgs::CompressedImage compressed;
  compressed.format = "png";
  compressed.data.assign(7, 1);
  expectLayout(compressed, "CompressedImage");
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.frame_id = "map";
  expectLayout(pose, "PoseWithCovarianceStamped");
  expectLayout(geometry_msgs::PoseStamped(), "PoseStamped");
  std_msgs::String text;
  text.data = "text";
  expectLayout(text, "String");
  tf2_msgs::TFMessage tf;
  tf.transforms.resize(3);
  tf.transforms[1].child_frame_id = "camera";
  expectLayout(tf, "TFMessage");
}

TEST(BagReadMessage, AnImpossibleLengthIsRefusedBeforeMemoryIsTaken) {
  const std::vector<std::uint8_t> bytes{0xff, 0xff, 0xff, 0xff, 'a'};
  EXPECT_THROW(checkLengths(bytes, serialLayout<std_msgs::String>()), ros::Exception);
  EXPECT_THROW(checkLengths(bytes, serialLayout<tf2_msgs::TFMessage>()), ros::Exception);
  EXPECT_THROW(checkLengths({1, 0}, serialLayout<std_msgs::String>()), ros::Exception);
}

INSTANTIATE_TEST_SUITE_P(Compressions, BagDamage,
                         testing::Values(rosbag::compression::Uncompressed,
                                         rosbag::compression::LZ4, rosbag::compression::BZ2),
                         [](const auto& compression) {
                           const bool is_bz2 = compression.param == rosbag::compression::BZ2;
                           const bool is_lz4 = compression.param == rosbag::compression::LZ4;
                           return std::string(is_bz2 ? "bz2" : is_lz4 ? "lz4" : "uncompressed");
                         });

}  // namespace
}  // namespace ardrone_vslam
