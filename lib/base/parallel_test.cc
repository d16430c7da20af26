#include "base/parallel.h"

#include <catch2/catch.hpp>
#include <stdexcept>
#include <vector>

using stablecut::parallel_for;

TEST_CASE("every index is visited once, with any number of threads") {
  for (const int threads : {1, 2, 7}) {
    std::vector<int> visits(1000, 0);
    double last_share = 0;
    parallel_for(
        visits.size(), threads, [&](std::size_t i) { ++visits[i]; },
        [&](double share) {
          CHECK(share > last_share);
          last_share = share;
        });
    CHECK(visits == std::vector<int>(1000, 1));
    CHECK(last_share == 1.0);
  }
}

TEST_CASE("an exception in a worker reaches the caller") {
  CHECK_THROWS_AS(parallel_for(50, 2,
                               [](std::size_t i) {
                                 if (i == 20) throw std::runtime_error("20");
                               }),
                  std::runtime_error);
}

TEST_CASE("nothing to do is done") {
  parallel_for(0, 4, [](std::size_t) { FAIL("called"); });
}
