// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "world/scene/world_paint.hpp"

namespace ardrone_vslam {

/// Paints something with contrast at scales from a centimetre to half a metre into the area [m]: a
/// poster of blocks, blobs, lettering, polygons or a picture, or a shelf of books. No two are
/// alike.
void paintPoster(Painter& painter, const cv::Rect2d& area);

/// One of two dozen posters, each with a size of its own. They are the same whatever the painter's
/// seed, which decides only which of them it is.
void paintPosterOfCatalogue(Painter& painter, const cv::Rect2d& area);

/// One of these two.
using PosterPaint = std::function<void(Painter& painter, const cv::Rect2d& area)>;

/// Bricks of 21 x 7 cm with their mortar, each of its own grey.
void paintBricks(Painter& painter, const cv::Rect2d& area);

/// Boards along x, 12 cm wide, with grain.
void paintBoards(Painter& painter, const cv::Rect2d& area);

}  // namespace ardrone_vslam
