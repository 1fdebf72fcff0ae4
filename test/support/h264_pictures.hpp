// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ardrone_vslam {

/// H.264 (baseline) of plain grey pictures, for tests without recorded video: IDR pictures of
/// uncompressed blocks, and pictures that repeat the one before.
class H264Pictures {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @pre width and height even
  H264Pictures(unsigned width_px, unsigned height_px)
      : width_px_(width_px),
        height_px_(height_px),
        columns_((width_px + 15) / 16),
        rows_((height_px + 15) / 16) {}

  Bytes idr(std::uint8_t luma) {
    frame_ = 0;
    Bits slice;
    slice.unsignedGolomb(0);  // first block
    slice.unsignedGolomb(7);  // I
    slice.unsignedGolomb(0);  // parameter set
    slice.put(0, 4);          // frame number
    slice.unsignedGolomb(0);  // IDR picture's number
    slice.put(0, 2);          // reference marking
    slice.unsignedGolomb(0);  // quantiser
    slice.unsignedGolomb(1);  // no deblocking
    for (unsigned i = 0; i < columns_ * rows_; ++i) {
      slice.unsignedGolomb(25);  // I_PCM
      slice.align();
      for (int k = 0; k < 256; ++k) slice.put(luma, 8);
      for (int k = 0; k < 128; ++k) slice.put(128, 8);
    }
    Bytes bytes = unit(0x67, sequenceParameters());
    append(bytes, unit(0x68, pictureParameters()));
    append(bytes, unit(0x65, slice));
    return bytes;
  }

  /// The picture before, once more.
  Bytes repeated() {
    frame_ = (frame_ + 1) % 16;
    Bits slice;
    slice.unsignedGolomb(0);
    slice.unsignedGolomb(5);  // P
    slice.unsignedGolomb(0);
    slice.put(frame_, 4);
    slice.put(0, 3);  // number of references, their order, their marking: as usual
    slice.unsignedGolomb(0);
    slice.unsignedGolomb(1);
    slice.unsignedGolomb(columns_ * rows_);  // blocks skipped
    return unit(0x41, slice);
  }

 private:
  class Bits {
   public:
    void put(unsigned value, unsigned count) {
      for (unsigned i = count; i > 0; --i) {
        if (used_ % 8 == 0) bytes_.push_back(0);
        if (((value >> (i - 1)) & 1) != 0)
          bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (0x80 >> (used_ % 8)));
        ++used_;
      }
    }
    void unsignedGolomb(unsigned value) {
      unsigned length = 0;
      while (((value + 1) >> (length + 1)) != 0) ++length;
      put(0, length);
      put(value + 1, length + 1);
    }
    void align() {
      while (used_ % 8 != 0) put(0, 1);
    }
    const Bytes& bytes() const { return bytes_; }

   private:
    Bytes bytes_;
    unsigned used_ = 0;
  };

  static void append(Bytes& bytes, const Bytes& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  }

  Bits sequenceParameters() const {
    Bits bits;
    bits.put(66, 8);  // baseline
    bits.put(0, 8);
    bits.put(30, 8);         // level 3
    bits.unsignedGolomb(0);  // number
    bits.unsignedGolomb(0);  // 4 bits of frame number
    bits.unsignedGolomb(2);  // shown in the order of coding
    bits.unsignedGolomb(1);  // one reference
    bits.put(0, 1);
    bits.unsignedGolomb(columns_ - 1);
    bits.unsignedGolomb(rows_ - 1);
    bits.put(3, 2);  // frames, direct 8x8
    bits.put(1, 1);  // cropped
    bits.unsignedGolomb(0);
    bits.unsignedGolomb((16 * columns_ - width_px_) / 2);
    bits.unsignedGolomb(0);
    bits.unsignedGolomb((16 * rows_ - height_px_) / 2);
    bits.put(0, 1);  // no more about how to show them
    return bits;
  }

  static Bits pictureParameters() {
    Bits bits;
    bits.unsignedGolomb(0);
    bits.unsignedGolomb(0);
    bits.put(0, 2);
    for (int i = 0; i < 3; ++i) bits.unsignedGolomb(0);  // slice groups, references
    bits.put(0, 3);                                      // weights
    for (int i = 0; i < 3; ++i) bits.unsignedGolomb(0);  // quantisers
    bits.put(4, 3);                                      // deblocking is told of
    return bits;
  }

  /// With start code, end bit and the bytes that keep start codes out of it.
  static Bytes unit(std::uint8_t head, Bits bits) {
    bits.put(1, 1);
    bits.align();
    Bytes bytes{0, 0, 0, 1, head};
    int zeros = 0;
    for (const std::uint8_t byte : bits.bytes()) {
      if (zeros == 2 && byte <= 3) {
        bytes.push_back(3);
        zeros = 0;
      }
      bytes.push_back(byte);
      zeros = byte == 0 ? zeros + 1 : 0;
    }
    return bytes;
  }

  unsigned width_px_;
  unsigned height_px_;
  unsigned columns_;
  unsigned rows_;
  unsigned frame_ = 0;
};

}  // namespace ardrone_vslam
