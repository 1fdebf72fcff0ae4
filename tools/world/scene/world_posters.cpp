// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_posters.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ardrone_vslam {
namespace {

cv::Point2d pointIn(Painter& painter, const cv::Rect2d& area) {
  const double x = painter.random().uniform(area.x, area.x + area.width);
  const double y = painter.random().uniform(area.y, area.y + area.height);
  return {x, y};
}

cv::Rect2d shrunk(const cv::Rect2d& area, double border_m) {
  return {area.x + border_m, area.y + border_m, area.width - 2 * border_m,
          area.height - 2 * border_m};
}

/// Unlike `other` by at least 50.
double contrasting(RandomSource& random, double other) {
  return other > 128 ? random.uniform(5, other - 50) : random.uniform(other + 50, 250);
}

/// A grid of blocks; each is plain, or holds a smaller block, or is divided again.
void paintBlocks(Painter& painter, const cv::Rect2d& area, double size_m) {
  RandomSource& random = painter.random();
  const int columns = std::max(1, static_cast<int>(std::lround(area.width / size_m)));
  const int rows = std::max(1, static_cast<int>(std::lround(area.height / size_m)));
  const cv::Size2d block(area.width / columns, area.height / rows);
  for (int i = 0; i < columns * rows; ++i) {
    const cv::Rect2d place(area.x + (i % columns) * block.width,
                           area.y + (i / columns) * block.height, block.width, block.height);
    const double grey = random.uniform(10, 245);
    painter.fill(place, grey);
    if (random.chance(0.35) && size_m > 0.05) {
      paintBlocks(painter, place, size_m / 3);
    } else if (random.chance(0.5)) {
      painter.fill(shrunk(place, size_m * random.uniform(0.15, 0.35)), contrasting(random, grey));
    }
  }
}

/// Ellipses, the large ones first. They may stick out: the frame is painted afterwards.
void paintBlobs(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  painter.fill(area, random.uniform(20, 240));
  const double largest_m = 0.16;
  for (int i = 0; i < 90; ++i) {
    const double size_m = largest_m * std::pow(0.1, i / 90.0);
    const cv::Rect2d place = shrunk(area, size_m);
    if (place.width <= 0 || place.height <= 0) continue;
    const cv::Point2d middle = pointIn(painter, place);
    const cv::Size2d half(size_m, size_m * random.uniform(0.3, 1));
    painter.ellipse(middle, half, random.uniform(0, 180), random.uniform(5, 250));
  }
}

void paintPolygons(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  painter.fill(area, random.uniform(20, 240));
  for (int i = 0; i < 70; ++i) {
    const double size_m = 0.3 * std::pow(0.08, i / 70.0);
    const cv::Point2d middle = pointIn(painter, area);
    std::vector<cv::Point2d> corners;
    const int count = random.integer(3, 5);
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * M_PI * (k + random.uniform(0, 0.8)) / count;
      const double x = middle.x + size_m * std::cos(angle), y = middle.y + size_m * std::sin(angle);
      corners.emplace_back(std::min(std::max(x, area.x), area.x + area.width),
                           std::min(std::max(y, area.y), area.y + area.height));
    }
    painter.polygon(corners, random.uniform(5, 250));
  }
}

/// A notice: a headline, then smaller lines.
void paintNotice(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  const double paper = random.chance(0.7) ? random.uniform(190, 240) : random.uniform(20, 70);
  painter.fill(area, paper);
  const cv::Rect2d text = shrunk(area, 0.03);
  double height_m = random.uniform(0.1, 0.16);
  for (double y = text.y; y + height_m < text.y + text.height;) {
    const double width_m = text.width * random.uniform(0.7, 1);
    painter.lettering({text.x, y, width_m, height_m}, contrasting(random, paper));
    y += height_m;
    height_m = random.chance(0.75) ? random.uniform(0.03, 0.06) : random.uniform(0.06, 0.12);
  }
}

/// Clouds of strong contrast with a few strokes over them: a photograph or a painting.
void paintPicture(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  painter.fill(area, random.uniform(90, 160));
  painter.noise(area, 0.2, 50, 0.7);
  for (int i = 0; i < 12; ++i) {
    const cv::Rect2d inside = shrunk(area, 0.02);
    painter.line(pointIn(painter, inside), pointIn(painter, inside), random.uniform(0.004, 0.02),
                 random.uniform(5, 250));
  }
}

/// Books side by side on boards, each with a label or lettering bands.
void paintShelf(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  painter.fill(area, 35);
  const int boards = std::max(1, static_cast<int>(area.height / 0.28));
  const double board_m = area.height / boards;
  for (int board = 0; board < boards; ++board) {
    const double bottom = area.y + (board + 1) * board_m - 0.025;
    painter.fill({area.x, bottom, area.width, 0.025}, 170);
    for (double x = area.x + 0.01; x < area.x + area.width - 0.05;) {
      const double width_m = random.uniform(0.015, 0.05);
      const double height_m = (board_m - 0.03) * random.uniform(0.65, 0.95);
      const double grey = random.uniform(40, 240);
      const cv::Rect2d book(x, bottom - height_m, width_m, height_m);
      painter.fill(book, grey);
      const double label_m = height_m * random.uniform(0.1, 0.3);
      const cv::Rect2d label(x + 0.2 * width_m, book.y + height_m * random.uniform(0.1, 0.6),
                             0.6 * width_m, label_m);
      painter.fill(label, contrasting(random, grey));
      x += width_m + 0.003;
    }
  }
}

}  // namespace

void paintPoster(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  const double frame_m = 0.02;
  painter.fill(area, random.chance(0.5) ? random.uniform(10, 50) : random.uniform(210, 245));
  const cv::Rect2d inside = shrunk(area, frame_m);
  switch (random.integer(0, 5)) {
    case 0:
      paintBlocks(painter, inside, random.uniform(0.08, 0.16));
      break;
    case 1:
      paintBlobs(painter, inside);
      break;
    case 2:
      paintPolygons(painter, inside);
      break;
    case 3:
      paintNotice(painter, inside);
      break;
    case 4:
      paintPicture(painter, inside);
      break;
    default:
      paintShelf(painter, inside);
      break;
  }
}

void paintPosterOfCatalogue(Painter& painter, const cv::Rect2d& area) {
  constexpr int kPosters = 24;
  constexpr std::uint64_t kStream = 800;
  constexpr double kLargest_m = 0.5;
  const auto which = static_cast<std::uint64_t>(painter.random().integer(0, kPosters - 1));
  const RandomSource of_the_room =
      std::exchange(painter.random(), RandomSource(0, kStream + which));
  const double width_m = kLargest_m * painter.random().uniform(0.8, 1);
  const double height_m = kLargest_m * painter.random().uniform(0.8, 1);
  paintPoster(painter, {area.x, area.y, width_m, height_m});
  painter.random() = of_the_room;
}

void paintBricks(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  constexpr double kLength_m = 0.22, kHeight_m = 0.08, kMortar_m = 0.012;
  painter.fill(area, 185);
  painter.noise(area, 0.02, 8, 0.8);
  int course = 0;
  for (double y = area.y; y < area.y + area.height - kMortar_m; y += kHeight_m, ++course) {
    const double start = area.x - (course % 2) * kLength_m / 2;
    for (double x = start; x < area.x + area.width; x += kLength_m) {
      const cv::Rect2d brick =
          cv::Rect2d(x, y, kLength_m - kMortar_m, kHeight_m - kMortar_m) & area;
      painter.fill(brick, random.uniform(55, 150));
    }
  }
  painter.noise(area, 0.05, 9, 0.85);
}

void paintBoards(Painter& painter, const cv::Rect2d& area) {
  RandomSource& random = painter.random();
  constexpr double kWidth_m = 0.12, kGap_m = 0.004;
  painter.fill(area, 60);
  for (double y = area.y; y < area.y + area.height; y += kWidth_m) {
    double length_m = random.uniform(0.3, 1.2);
    for (double x = area.x; x < area.x + area.width; x += length_m + kGap_m) {
      if (x > area.x) length_m = random.uniform(0.7, 1.4);
      painter.fill(cv::Rect2d(x, y, length_m, kWidth_m - kGap_m) & area, random.uniform(95, 165));
    }
  }
  painter.noise(area, 0.03, 9, 0.8, 8);
  painter.noise(area, 0.5, 6, 0.7);
}

}  // namespace ardrone_vslam
