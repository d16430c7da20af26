#include "base/edit_distance.h"

#include <catch2/catch.hpp>
#include <string>

using namespace stablecut;

TEST_CASE("edits: added, taken, replaced, neighbours changed") {
  CHECK(edits_between("", "") == 0);
  CHECK(edits_between("teeth", "teeth") == 0);
  CHECK(edits_between("", "teeth") == 5);
  CHECK(edits_between("teeth", "teth") == 1);
  CHECK(edits_between("teeth", "tooth") == 2);
  CHECK(edits_between("helix_deg", "hleix_deg") == 1);
  CHECK(edits_between("ab", "ba") == 1);
  // Neighbours that were changed are not edited again.
  CHECK(edits_between("ca", "abc") == 3);
}

TEST_CASE("edits are the same both ways, and no more than letters") {
  const std::string names[] = {"frequency_hz", "frequnecy_hz", "re", "reference", "damping_ratio", "x"};
  for (const std::string& a : names) {
    for (const std::string& b : names) {
      CHECK(edits_between(a, b) == edits_between(b, a));
      CHECK(edits_between(a, b) <= std::max(a.size(), b.size()));
      CHECK((edits_between(a, b) == 0) == (a == b));
    }
  }
}
