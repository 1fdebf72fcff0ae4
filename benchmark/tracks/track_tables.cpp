// SPDX-License-Identifier: BSD-3-Clause
#include "track_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "robust.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kThirds = 3;

void printHead() {
  std::printf(
      "# Tracks against truth\n\n"
      "Made by `scripts/benchmark`; edit benchmark/tracks, not this page. It measures the "
      "[tracks between pixels](front_end.md#tracks-between-pixels).\n\n"
      "How far the tracks of %d features are from where the true motion allows them, on whole "
      "pixels and aligned. The deviation is 1.4826 times the median magnitude of the Sampson "
      "distance between two images [px], the bias its median with the sign. \"Truth\" takes the "
      "sequence's own poses. Recorded ones err by tenths of a pixel themselves, and rendered ones "
      "are of the middle row where the shutter rolls. \"Refined\" therefore fits the relative pose "
      "to the same tracks, robustly, from the truth on. It fits rotation, direction of travel and "
      "a "
      "turn that grows with the row, as a shutter that rolls makes it. It does so where two images "
      "have 60 tracks or more.\n\n",
      kFeatures);
}

/// "-" for what is of nothing.
std::string numberText(double value, const char* format) {
  std::array<char, 32> text{};
  if (std::isnan(value)) return "-";
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

void printDistances(const Distances& whole, const Distances& aligned) {
  constexpr const char* kFormat = "%.3f";
  std::printf("| %s | %s | %s ", numberText(sigmaOf(whole.all_px), kFormat).c_str(),
              numberText(sigmaOf(aligned.all_px), kFormat).c_str(),
              numberText(sigmaOf(aligned.aligned_px), kFormat).c_str());
}

void printBias(const Distances& whole, const Distances& aligned) {
  constexpr const char* kFormat = "%+.3f";
  std::printf("| %s, %s ", numberText(medianOf(whole.all_px), kFormat).c_str(),
              numberText(medianOf(aligned.all_px), kFormat).c_str());
}

void printSigmas(const MeasuredSequence& sequence, std::size_t k) {
  const Distances& whole = sequence.whole_pixels.own.apart[k];
  const Distances& aligned = sequence.aligned.own.apart[k];
  const Distances& whole_refined = sequence.whole_pixels.refined.apart[k];
  const Distances& aligned_refined = sequence.aligned.refined.apart[k];
  std::printf("| %s | %zu | %zu, %zu ", sequence.name.c_str(), kImagesApart[k],
              aligned.all_px.size(), aligned_refined.all_px.size());
  printDistances(whole, aligned);
  printDistances(whole_refined, aligned_refined);
  printBias(whole, aligned);
  printBias(whole_refined, aligned_refined);
  std::printf("|\n");
}

void printSigmaTable(const std::vector<MeasuredSequence>& sequences) {
  std::printf(
      "| sequence | images apart | tracks: truth, refined | truth: whole pixels | aligned | of "
      "those aligned in "
      "both "
      "images | refined: whole pixels | aligned | of those aligned in both images | bias by "
      "truth: whole pixels, aligned | refined |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const MeasuredSequence& sequence : sequences)
    for (std::size_t k = 0; k < kImagesApart.size(); ++k) printSigmas(sequence, k);
}

/// What was claimed and what was measured, of one third.
Claim summaryOf(const std::vector<Claim>& claims, std::size_t begin, std::size_t end) {
  std::vector<double> claimed_px;
  std::vector<double> measured_px;
  for (std::size_t i = begin; i < end; ++i) {
    claimed_px.push_back(claims[i].claimed_px);
    measured_px.push_back(claims[i].measured_px);
  }
  return {medianOf(std::move(claimed_px)), sigmaOf(std::move(measured_px))};
}

std::vector<Claim> thirdsOf(std::vector<Claim> claims) {
  std::sort(claims.begin(), claims.end(),
            [](const Claim& a, const Claim& b) { return a.claimed_px < b.claimed_px; });
  std::vector<Claim> thirds;
  for (std::size_t i = 0; i < kThirds; ++i)
    thirds.push_back(
        summaryOf(claims, i * claims.size() / kThirds, (i + 1) * claims.size() / kThirds));
  return thirds;
}

void printClaims(const MeasuredSequence& sequence, std::size_t k) {
  std::printf("| %s | %zu | %.3f | %zu ", sequence.name.c_str(), sequence.images,
              sequence.aligned.alignedShare(), kImagesApart[k]);
  for (const Claim& third : thirdsOf(sequence.aligned.own.apart[k].claims))
    std::printf("| %.2f ", third.measured_px / third.claimed_px);
  for (const Claim& third : thirdsOf(sequence.aligned.refined.apart[k].claims))
    std::printf("| %.3f, %.3f, **%.2f** ", third.claimed_px, third.measured_px,
                third.measured_px / third.claimed_px);
  std::printf("|\n");
}

void printClaimTable(const std::vector<MeasuredSequence>& sequences) {
  std::printf(
      "\nWhat the tracker claims of a position (its information) beside what is measured. "
      "Tracks are so many images old, and measured across their epipolar lines in the new image, "
      "by thirds of the claimed deviation. A ratio above 1: the tracker claims too much.\n\n"
      "| sequence | images | share aligned | images old | truth: measured / claimed, lowest third "
      "| middle | "
      "highest | refined: claimed, measured [px], ratio, lowest third | middle | highest |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  constexpr std::size_t kAges = 2;  // of kImagesApart: older ones are few
  for (const MeasuredSequence& sequence : sequences)
    for (std::size_t k = 0; k < kAges; ++k) printClaims(sequence, k);
}

}  // namespace

void printTracks(const std::vector<MeasuredSequence>& sequences) {
  printHead();
  printSigmaTable(sequences);
  printClaimTable(sequences);
}

}  // namespace ardrone_vslam::bench
