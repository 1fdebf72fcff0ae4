// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include "ardrone_vslam/instruction_set.hpp"
#include "frames.hpp"
#include "rows.hpp"

int main(int argc, char** argv) {
  using namespace ardrone_vslam;
  cv::setNumThreads(1);  // the peers get one thread too
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("instruction_set", nameOf(instructionSetInUse().set));
  benchmark::AddCustomContext("opencv", CV_VERSION);
  benchmark::AddCustomContext("libbenchmark", ARDRONE_VSLAM_LIBBENCHMARK);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::AddCustomContext("frames", bench::dataFolder() ? "KITTI 03" : "rendered");
  bench::addCornerRows();
  bench::addDescriptorRows();
  bench::addMatchingRows();
  bench::addProjectionRows();
  bench::addGuidedRows();
  bench::addAlignmentRows();
  bench::addTrackerRows();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
