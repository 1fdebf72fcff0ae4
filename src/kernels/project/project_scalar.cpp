// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/project/project_one.hpp"

namespace ardrone_vslam::kernels {

int projectScalar(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                  const ProjectOutput& out) {
  int visible = 0;
  for (int i = 0; i < count; ++i) visible = projectOne(columns, i, camera, out, visible);
  return visible;
}

}  // namespace ardrone_vslam::kernels
