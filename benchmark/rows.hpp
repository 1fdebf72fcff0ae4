// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ardrone_vslam::bench {

void addAlignmentRows();
void addCornerRows();
void addDescriptorRows();
void addGuidedRows();
void addMatchingRows();
void addProjectionRows();
void addTrackerRows();

}  // namespace ardrone_vslam::bench
