// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_detector.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

#include "corners/corner_cells.hpp"
#include "corners/corner_climb.hpp"
#include "corners/corner_maxima.hpp"
#include "corners/corner_thresholds.hpp"
#include "corners/sampling_raster.hpp"
#include "corners/threshold_rows.hpp"
#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kBorderPx = CornerDetector::kBorder_px;
static_assert(kBorderPx == kernels::kCircleRadiusPx);
constexpr int kAllPasses = 16;
/// From so many passes on vector kernels test all pixels all the same: that costs less than to
/// score on demand those that the climbs ask for.
constexpr int kDensePasses = 4;

const CornerDetectorConfig& checked(const CornerDetectorConfig& config) {
  auto faults = rangeFaults(config);
  const auto text = [](int value) { return std::to_string(value); };
  if (config.threshold_min > config.threshold_max) {
    faults.push_back("threshold_min is " + text(config.threshold_min) +
                     " but threshold_max is only " + text(config.threshold_max) +
                     "; set threshold_min to at most threshold_max");
  } else if (config.adapt_threshold &&
             (config.threshold < config.threshold_min || config.threshold > config.threshold_max)) {
    faults.push_back("threshold is " + text(config.threshold) +
                     " but must be between threshold_min (" + text(config.threshold_min) +
                     ") and threshold_max (" + text(config.threshold_max) +
                     "); widen that range or switch adapt_threshold off");
  }
  if (!faults.empty()) throw ConfigError(faults);
  return config;
}

}  // namespace

struct CornerDetector::State {
  State(const CornerDetectorConfig& checked_config, InstructionSet set)
      : config(checked_config),
        kernels(kernels::kernelsFor(set)),
        maxima(kernels),
        climb(kernels) {}

  const CornerDetectorConfig config;
  const kernels::Kernels kernels;
  int width_px = 0;
  int height_px = 0;
  CornerCells cells;
  CornerThresholds thresholds;
  ThresholdRows threshold_rows;
  CornerMaxima maxima;
  CornerClimb climb;
  CornersByCell by_cell;

  struct Row {
    std::vector<std::uint16_t> groups;
    std::vector<std::uint16_t> columns;
    std::vector<std::uint8_t> scores;  ///< 0 between two rows
  } one_row;                           ///< kept for its memory, as the lists
  struct Lists {
    std::vector<Corner> hits;     ///< all tested pixels that are corners, in raster order
    std::vector<Corner> thinned;  ///< what suppression leaves of them
  } lists;

  void reset(const ImageView& image);
  void reserve(const ImageView& image);
  template <class NextHits, class EndRow>
  void scan(const ImageView& image, int passes, const NextHits& nextHits, const EndRow& endRow);
  void keepMaxima(const ImageView& image, CornerMaxima::Ties ties);
  void climbFromSamples(const ImageView& image);
  void listHits(int y_px, int group_count);
  void dropBelowThreshold();
};

CornerDetector::CornerDetector(const CornerDetectorConfig& config, InstructionSet set)
    : state_(std::make_unique<State>(checked(config), set)) {}

CornerDetector::~CornerDetector() = default;

void CornerDetector::detect(const ImageView& image, std::vector<Corner>& corners) {
  corners.clear();
  State& s = *state_;
  if (image.empty() || std::min(image.width_px, image.height_px) <= 2 * kBorderPx) return;
  if (image.width_px != s.width_px || image.height_px != s.height_px) s.reset(image);

  if (s.config.suppression == Suppression::kStrict3x3) {
    s.threshold_rows.begin(s.cells, s.thresholds, ThresholdRows::Reach::kOwnCell);
    s.keepMaxima(image, CornerMaxima::Ties::kBothDropped);
  } else if (s.config.sampling_passes == kAllPasses) {
    // All pixels are tested: the climbs end at the maxima.
    s.threshold_rows.begin(s.cells, s.thresholds, ThresholdRows::Reach::kCellsBeside);
    s.keepMaxima(image, CornerMaxima::Ties::kEarlierIsHigher);
    s.dropBelowThreshold();
  } else {
    s.threshold_rows.begin(s.cells, s.thresholds, ThresholdRows::Reach::kOwnCell);
    s.climbFromSamples(image);
    s.dropBelowThreshold();
  }
  corners.reserve(static_cast<std::size_t>(s.config.features_per_frame) + 1);
  s.by_cell.group(s.lists.thinned, s.cells);
  s.by_cell.select(s.config.features_per_frame, corners);
  s.thresholds.adapt(s.by_cell);
}

void CornerDetector::State::reset(const ImageView& image) {
  assert(std::max(image.width_px, image.height_px) <= std::numeric_limits<std::int16_t>::max() &&
         "corner positions have 16 bits");
  width_px = 0;  // without memory for this size it stays so, and the next image tries again
  cells.reset(image.width_px, image.height_px, config.cell_size_px);
  thresholds.reset(config, cells.count());
  one_row.groups.resize(static_cast<std::size_t>(image.width_px));
  one_row.columns.resize(one_row.groups.size() + kernels::kMaximaPadding);
  one_row.scores.assign(one_row.groups.size() + kernels::kScorePadding, 0);
  reserve(image);
  width_px = image.width_px;
  height_px = image.height_px;
}

/// Room for the richest image, so that none allocates but the first of its size. What is never
/// written to costs address space only.
void CornerDetector::State::reserve(const ImageView& image) {
  const auto width = static_cast<std::size_t>(image.width_px);
  const auto height = static_cast<std::size_t>(image.height_px);
  const std::size_t maxima_at_most = (width + 1) / 2 * ((height + 1) / 2);  // no two are neighbours
  lists.thinned.reserve(maxima_at_most);
  by_cell.reserve(maxima_at_most);
  const bool climbs =
      config.suppression == Suppression::kLocalClimb && config.sampling_passes < kAllPasses;
  if (climbs) lists.hits.reserve(width * height);
}

/// Tests the pixels of the first `passes` passes, row by row from the top.
/// @param nextHits  gives the place for a row's corners
/// @param endRow  takes the row and the number of its corners
template <class NextHits, class EndRow>
void CornerDetector::State::scan(const ImageView& image, int passes, const NextHits& nextHits,
                                 const EndRow& endRow) {
  const auto circle = kernels::fastCircle(image.stride_bytes, config.arc_length_px);
  for (int y = kBorderPx; y < height_px - kBorderPx; ++y) {
    const kernels::FastRow row{image.row(y), threshold_rows.at(y), kBorderPx, width_px - kBorderPx,
                               sampledColumns(y, passes)};
    endRow(y, kernels.fast_row(row, circle, nextHits()));
  }
}

void CornerDetector::State::keepMaxima(const ImageView& image, CornerMaxima::Ties ties) {
  maxima.begin(width_px, ties, lists.thinned);
  scan(
      image, config.sampling_passes, [this] { return maxima.nextRow(); },
      [this](int y, int count) { maxima.endRow(y, count); });
  maxima.endRow(height_px - kBorderPx, 0);
}

void CornerDetector::State::climbFromSamples(const ImageView& image) {
  lists.hits.clear();
  const bool dense = kernels.fast_group_px > 1 && config.sampling_passes >= kDensePasses;
  scan(
      image, dense ? kAllPasses : config.sampling_passes,
      [this] {
        return kernels::FastScores{one_row.scores.data(), one_row.groups.data()};
      },
      [this](int y, int group_count) { listHits(y, group_count); });
  climb.climb(image, config.arc_length_px,
              {lists.hits, config.sampling_passes, dense ? &cells : nullptr, &thresholds},
              lists.thinned);
}

/// Moves the corners of a row from its scores to `hits`.
void CornerDetector::State::listHits(int y_px, int group_count) {
  const int count = kernels.fast_list(one_row.scores.data(), one_row.groups.data(), group_count,
                                      one_row.columns.data());
  for (const std::uint16_t* x = one_row.columns.data(); x != one_row.columns.data() + count; ++x) {
    lists.hits.push_back(
        {static_cast<std::int16_t>(*x), static_cast<std::int16_t>(y_px), one_row.scores[*x]});
    one_row.scores[*x] = 0;
  }
}

/// A climb may end in a neighbouring cell whose threshold is higher than the end's score.
void CornerDetector::State::dropBelowThreshold() {
  const auto below = [this](const Corner& c) {
    return c.score < thresholds.at(cells.cellAt(c.x_px, c.y_px));
  };
  lists.thinned.erase(std::remove_if(lists.thinned.begin(), lists.thinned.end(), below),
                      lists.thinned.end());
}

}  // namespace ardrone_vslam
