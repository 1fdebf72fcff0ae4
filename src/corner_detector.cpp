// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/corner_detector.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

#include "corner_cells.hpp"
#include "corner_suppression.hpp"
#include "corner_thresholds.hpp"
#include "kernels/kernels.hpp"
#include "sampling_raster.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kBorderPx = kernels::kCircleRadiusPx;

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
  CornerDetectorConfig config;
  int width_px = 0;
  int height_px = 0;
  CornerCells cells;
  CornerThresholds thresholds;
  CornerSuppression suppression;
  CornersByCell by_cell;

  std::vector<std::uint8_t> row_thresholds;  ///< one for each column
  std::vector<std::uint16_t> row_hits;
  std::vector<Corner> hits;     ///< all tested pixels that are corners, in raster order
  std::vector<Corner> thinned;  ///< what suppression leaves of them

  void reset(const ImageView& image);
  void spreadThresholds(int cell_row);
  void testPixels(const ImageView& image);
  void thin(const ImageView& image);
};

CornerDetector::CornerDetector(const CornerDetectorConfig& config)
    : state_(std::make_unique<State>()) {
  state_->config = checked(config);
}

CornerDetector::~CornerDetector() = default;

void CornerDetector::detect(const ImageView& image, std::vector<Corner>& corners) {
  corners.clear();
  State& s = *state_;
  if (image.empty() || std::min(image.width_px, image.height_px) <= 2 * kBorderPx) return;
  if (image.width_px != s.width_px || image.height_px != s.height_px) s.reset(image);

  s.testPixels(image);
  s.thin(image);
  s.by_cell.group(s.thinned, s.cells);
  s.by_cell.select(s.config.features_per_frame, corners);
  s.thresholds.adapt(s.by_cell);
}

void CornerDetector::State::reset(const ImageView& image) {
  assert(std::max(image.width_px, image.height_px) <= std::numeric_limits<std::int16_t>::max() &&
         "corner positions have 16 bits");
  width_px = image.width_px;
  height_px = image.height_px;
  cells.reset(width_px, height_px, config.cell_size_px);
  thresholds.reset(config, cells.count());
  row_thresholds.resize(static_cast<std::size_t>(width_px));
  row_hits.resize(static_cast<std::size_t>(width_px));
}

void CornerDetector::State::spreadThresholds(int cell_row) {
  for (int x = 0; x < width_px; ++x) {
    const int threshold = thresholds.at(cell_row * cells.columns() + cells.columnAt(x));
    row_thresholds[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(threshold);
  }
}

void CornerDetector::State::testPixels(const ImageView& image) {
  const auto circle = kernels::fastCircle(image.stride_bytes, config.arc_length_px);
  hits.clear();
  for (int y = kBorderPx; y < height_px - kBorderPx; ++y) {
    if (y == kBorderPx || cells.rowAt(y) != cells.rowAt(y - 1)) spreadThresholds(cells.rowAt(y));
    const kernels::FastRow row{image.row(y), row_thresholds.data(), kBorderPx, width_px - kBorderPx,
                               sampledColumns(y, config.sampling_passes)};
    const int count = kernels::kernelsInUse().fast_row(row, circle, row_hits.data());
    for (int i = 0; i < count; ++i) {
      const auto x = static_cast<std::int16_t>(row_hits[static_cast<std::size_t>(i)]);
      hits.push_back({x, static_cast<std::int16_t>(y), 0});
    }
  }
}

void CornerDetector::State::thin(const ImageView& image) {
  suppression.begin(image, config.arc_length_px);
  if (config.suppression == Suppression::kStrict3x3) {
    suppression.keepStrictMaxima(hits, thinned);
    return;
  }
  suppression.climb(hits, thinned);
  // A climb may end in a neighbouring cell whose threshold is higher than the end's score.
  const auto below = [this](const Corner& c) {
    return c.score < thresholds.at(cells.cellAt(c.x_px, c.y_px));
  };
  thinned.erase(std::remove_if(thinned.begin(), thinned.end(), below), thinned.end());
}

}  // namespace ardrone_vslam
