// Which entry of a frequency response matrix a finding is about.
#pragma once

#include <string>

namespace stablecut::modal {

/// H_ij, the response in direction i to a force in direction j, by the names of the directions.
struct EntryName {
  std::string response, reference;

  bool operator==(const EntryName&) const = default;
};

}  // namespace stablecut::modal
