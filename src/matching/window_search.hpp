// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/instruction_set.hpp"
#include "matching/match_acceptance.hpp"

namespace ardrone_vslam {

/// Descriptors at places of an image, searched by descriptor within circles about other places.
/// Buffers are kept from build to build.
///
/// The descriptors are copied in the order of square cells, row by row, so that those of a row of
/// cells that a circle touches lie one behind the other: they are compared by vector kernels.
class WindowSearch {
 public:
  /// @param set  one of supportedInstructionSets(); the results do not depend on it
  explicit WindowSearch(InstructionSet set = instructionSetInUse().set);
  ~WindowSearch();

  /// Makes room for so many entries within a box of this size, so that build() does not allocate.
  void reserve(std::size_t entries, int width_px, int height_px);

  /// Begins anew with these entries. O(entries + cells); cells are 24 px wide, or as many as 256
  /// along the longer side.
  /// @param places_px  one for each descriptor; what is not finite is never found
  /// @param left_out  marks entries that are never found; empty: none
  void build(const std::vector<Eigen::Vector2f>& places_px,
             const std::vector<Descriptor>& descriptors, const std::vector<bool>& left_out = {});

  /// Nearest and second nearest to the query among the entries within the circle, its edge
  /// included; of equally near ones the one with the lowest index is the nearest. Cost: one Hamming
  /// distance for each entry in the cells that the circle's square touches.
  /// @param number  of the query, 0 or greater and above those of the queries since build()
  BestTwo search(const DescriptorBits& query, const Eigen::Vector2f& centre_px, float radius_px,
                 int number);

  /// @return number of the query nearest to the entry of all that had it in their circle, the
  ///   lowest number of equally near ones; -1: none had
  int nearestQuery(int entry) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
