// SPDX-License-Identifier: BSD-3-Clause
#include "linear/covariance_matrix.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "simulation/random_source.hpp"
#include "support/seeds.hpp"

namespace ardrone_vslam::test {
namespace {

/// Each coordinate is a variable by number, 0 one that is exact; two variables' covariance is told
/// by their numbers. Edits of the list are the oracle of edits of the matrix.
void expectVariables(const CovarianceMatrix& P, const std::vector<int>& variables) {
  ASSERT_EQ(P.size(), static_cast<int>(variables.size()));
  for (int row = 0; row < P.size(); ++row) {
    for (int column = 0; column < P.size(); ++column) {
      const int a = variables[static_cast<std::size_t>(row)];
      const int b = variables[static_cast<std::size_t>(column)];
      ASSERT_EQ(P.all()(row, column), a * b) << row << ' ' << column;
    }
  }
}

TEST(CovarianceMatrix, EditsKeepEachVariablesCovariances) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(seed);
    RandomSource random(seed);
    CovarianceMatrix P;
    P.reset(4);
    std::vector<int> variables(4, 0);
    for (int edit = 0; edit < 200; ++edit) {
      const int size = P.size();
      const int at = random.integer(0, size);
      const int count = random.integer(0, 3);
      if (random.chance(0.5)) {
        P.insert(at, count);
        variables.insert(variables.begin() + at, static_cast<std::size_t>(count), 0);
      } else if (at + count <= size) {
        P.remove(at, count);
        variables.erase(variables.begin() + at, variables.begin() + at + count);
      }
      if (P.size() == 0) continue;
      // One coordinate becomes a variable of its own, and another one the same as it.
      const int to = random.integer(0, P.size() - 1);
      variables[static_cast<std::size_t>(to)] = edit + 1;
      for (int i = 0; i < P.size(); ++i)
        P.all()(i, to) = P.all()(to, i) = variables[static_cast<std::size_t>(i)] * (edit + 1);
      const int same = random.integer(0, P.size() - 1);
      P.copy(to, same, 1);
      variables[static_cast<std::size_t>(same)] = edit + 1;
      expectVariables(P, variables);
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
