// SPDX-License-Identifier: BSD-3-Clause
// What a map file is made of: check sums, numbers as bytes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "map_file/crc32.hpp"
#include "map_file/little_endian.hpp"
#include "unit/map_file/map_files.hpp"

namespace ardrone_vslam::test {
namespace {

std::uint32_t crcOf(const std::string& text) {
  ByteWriter bytes;
  bytes.raw(text.data(), text.size());
  Crc32 crc;
  crc.add(bytes.data(), bytes.size());
  return crc.value();
}

TEST(Crc32Test, IsTheOneOfIeee8023) {
  EXPECT_EQ(crcOf("123456789"), 0xCBF43926U);
  EXPECT_EQ(crcOf("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
  EXPECT_EQ(crcOf(""), 0U);
  EXPECT_EQ(crcOf(std::string(4, '\0')), 0x2144DF1CU);
}

TEST(Crc32Test, PiecesGiveTheSameAsTheWhole) {
  const std::string text = "a text that is longer than three steps of the sum";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    ByteWriter bytes;
    bytes.raw(text.data(), text.size());
    Crc32 crc;
    crc.add(bytes.data(), cut);
    crc.add(bytes.data() + cut, bytes.size() - cut);
    ASSERT_EQ(crc.value(), crcOf(text)) << "cut at " << cut;
  }
}

TEST(LittleEndianTest, TheLowestByteComesFirst) {
  ByteWriter out;
  out.u32(0x01020304U);
  out.i64(-2);
  out.f32(1.0F);
  out.f64(-2.0);
  out.text("ab");
  const std::string expected(
      "\x04\x03\x02\x01\xFE\xFF\xFF\xFF\xFF\xFF\xFF\xFF\0\0\x80\x3F"
      "\0\0\0\0\0\0\0\xC0\x02\0\0\0ab",
      30);
  EXPECT_EQ(bytesOf(out), expected);
  ByteReader in(out.data(), out.size());
  EXPECT_EQ(in.u32(), 0x01020304U);
  EXPECT_EQ(in.i64(), -2);
  EXPECT_EQ(in.f32(), 1.0F);
  EXPECT_EQ(in.f64(), -2.0);
  EXPECT_EQ(in.text(2), "ab");
  EXPECT_FALSE(in.isShort());
  EXPECT_EQ(in.remaining(), 0U);
}

TEST(LittleEndianTest, BehindTheEndThereIsNothing) {
  ByteWriter out;
  out.u32(7);
  ByteReader number(out.data(), 3);
  EXPECT_EQ(number.u32(), 0U);
  EXPECT_TRUE(number.isShort());
  ByteReader text(out.data(), out.size());  // of 7 characters, which are not there
  EXPECT_EQ(text.text(100), "");
  EXPECT_TRUE(text.isShort());
}

}  // namespace
}  // namespace ardrone_vslam::test
