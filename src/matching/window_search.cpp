// SPDX-License-Identifier: BSD-3-Clause
#include "matching/window_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kNobody = -1;
constexpr float kCell_px = 24.F;  // 1,000 features of 640x480 are two a cell
/// Along one side, at most: bounds the cost for very wide lenses.
constexpr float kMostCells = 256.F;
/// By so much the square of cells is larger than the circle, so that rounding loses no entry at its
/// edge: enough for places within 100,000 px.
constexpr float kRounding_px = 0.0625F;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Of each entry in the order of the cells, and room that kernels may touch behind the last.
struct Entries {
  std::vector<Descriptor> descriptor;
  std::vector<float> x_px;
  std::vector<float> y_px;
  std::vector<std::int32_t> index;
  std::vector<std::int32_t> nearest_query;
  std::vector<std::int32_t> nearest_query_bits;

  void resize(std::size_t count) {
    const std::size_t room = count + kernels::kWindowPadding;
    descriptor.resize(room);
    x_px.resize(room);
    y_px.resize(room);
    index.resize(room);
    nearest_query.assign(room, kNobody);
    nearest_query_bits.assign(room, kNoDistance_bits);
  }
  void reserve(std::size_t count) {
    const std::size_t room = count + kernels::kWindowPadding;
    descriptor.reserve(room);
    x_px.reserve(room);
    y_px.reserve(room);
    index.reserve(room);
    nearest_query.reserve(room);
    nearest_query_bits.reserve(room);
  }
};

}  // namespace

struct WindowSearch::State {
  explicit State(InstructionSet set) : kernels(kernels::kernelsFor(set)) {}

  const kernels::Kernels kernels;
  Eigen::Vector2f lower_px = Eigen::Vector2f::Zero();  // of the box of all entries
  float cells_per_px = 1.F;
  int columns = 1;
  int rows = 1;
  std::vector<std::size_t> first;  // of each cell in `entries`, and the end of the last
  std::vector<std::size_t> fill;
  std::vector<int> position_of_entry;  // in `entries`; kNobody: left out
  Entries entries;
  std::vector<kernels::HammingRange> ranges;  // of one circle

  void layCells(const std::vector<Eigen::Vector2f>& places_px);
  /// Clamps before the conversion, so that no float (nor NaN, which goes to 0) is out of an int's
  /// range.
  static int cell(float position, int cells) {
    return static_cast<int>(std::min(std::max(0.F, position), static_cast<float>(cells - 1)));
  }
  int column(float at_px) const { return cell((at_px - lower_px.x()) * cells_per_px, columns); }
  int row(float at_px) const { return cell((at_px - lower_px.y()) * cells_per_px, rows); }
  std::size_t cellOf(const Eigen::Vector2f& place_px) const {
    return at(row(place_px.y()) * columns + column(place_px.x()));
  }
};

WindowSearch::WindowSearch(InstructionSet set) : state_(std::make_unique<State>(set)) {
  build({}, {});
}

WindowSearch::~WindowSearch() = default;

/// Cells over the box of all entries that have a position.
void WindowSearch::State::layCells(const std::vector<Eigen::Vector2f>& places_px) {
  Eigen::Vector2f upper_px = Eigen::Vector2f::Zero();
  lower_px.setZero();
  bool is_first = true;
  for (std::size_t i = 0; i < places_px.size(); ++i) {
    if (position_of_entry[i] == kNobody) continue;
    lower_px = is_first ? places_px[i] : Eigen::Vector2f(lower_px.cwiseMin(places_px[i]));
    upper_px = is_first ? places_px[i] : Eigen::Vector2f(upper_px.cwiseMax(places_px[i]));
    is_first = false;
  }
  const Eigen::Vector2f extent_px = upper_px - lower_px;
  cells_per_px = 1.F / std::max(kCell_px, extent_px.maxCoeff() / kMostCells);
  const auto cells = [this](float side_px) {
    return 1 + static_cast<int>(std::min(std::max(0.F, side_px * cells_per_px), kMostCells));
  };
  columns = cells(extent_px.x());
  rows = cells(extent_px.y());
}

void WindowSearch::reserve(std::size_t entries, int width_px, int height_px) {
  State& s = *state_;
  s.position_of_entry.reserve(entries);
  s.entries.reserve(entries);
  const auto rows = at(1 + static_cast<int>(static_cast<float>(height_px) / kCell_px));
  const auto columns = at(1 + static_cast<int>(static_cast<float>(width_px) / kCell_px));
  s.first.reserve(rows * columns + 1);
  s.fill.reserve(rows * columns);
  s.ranges.reserve(rows);
}

void WindowSearch::build(const std::vector<Eigen::Vector2f>& places_px,
                         const std::vector<Descriptor>& descriptors,
                         const std::vector<bool>& left_out) {
  assert(places_px.size() == descriptors.size() && "a place for each descriptor");
  assert((left_out.empty() || left_out.size() == places_px.size()) && "a mark for each entry");
  State& s = *state_;
  s.position_of_entry.assign(places_px.size(), kNobody);
  for (std::size_t i = 0; i < places_px.size(); ++i) {
    const bool found = std::isfinite(places_px[i].x()) && std::isfinite(places_px[i].y()) &&
                       (left_out.empty() || !left_out[i]);
    if (found) s.position_of_entry[i] = 0;  // for now
  }
  s.layCells(places_px);
  s.first.assign(at(s.columns * s.rows) + 1, 0);
  for (std::size_t i = 0; i < places_px.size(); ++i) {
    if (s.position_of_entry[i] != kNobody) ++s.first[s.cellOf(places_px[i]) + 1];
  }
  for (std::size_t c = 1; c < s.first.size(); ++c) s.first[c] += s.first[c - 1];
  s.fill.assign(s.first.begin(), s.first.end() - 1);
  s.entries.resize(s.first.back());
  s.ranges.resize(at(s.rows));
  for (std::size_t i = 0; i < places_px.size(); ++i) {
    if (s.position_of_entry[i] == kNobody) continue;
    const std::size_t k = s.fill[s.cellOf(places_px[i])]++;
    s.position_of_entry[i] = static_cast<int>(k);
    s.entries.descriptor[k] = descriptors[i];
    s.entries.x_px[k] = places_px[i].x();
    s.entries.y_px[k] = places_px[i].y();
    s.entries.index[k] = static_cast<std::int32_t>(i);
  }
}

BestTwo WindowSearch::search(const DescriptorBits& query, const Eigen::Vector2f& centre_px,
                             float radius_px, int number) {
  State& s = *state_;
  const float reach_px = radius_px + kRounding_px;
  const int left = s.column(centre_px.x() - reach_px);
  const int right = s.column(centre_px.x() + reach_px);
  const int last_row = s.row(centre_px.y() + reach_px);
  int range_count = 0;
  for (int row = s.row(centre_px.y() - reach_px); row <= last_row; ++row) {
    s.ranges[at(range_count++)] = {s.first[at(row * s.columns + left)],
                                   s.first[at(row * s.columns + right) + 1]};
  }
  Entries& e = s.entries;
  kernels::HammingNearest nearest{kNobody, kNoDistance_bits, kNoDistance_bits};
  s.kernels.hamming_window(
      {e.descriptor[0].words.data(), e.x_px.data(), e.y_px.data(), e.index.data(),
       e.nearest_query_bits.data(), e.nearest_query.data()},
      {query.words.data(), centre_px.x(), centre_px.y(), radius_px * radius_px, number},
      s.ranges.data(), range_count, nearest);
  return {nearest.index, nearest.distance_bits, nearest.second_distance_bits};
}

int WindowSearch::nearestQuery(int entry) const {
  const int position = state_->position_of_entry[at(entry)];
  return position == kNobody ? kNobody : state_->entries.nearest_query[at(position)];
}

}  // namespace ardrone_vslam
