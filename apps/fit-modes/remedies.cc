#include "remedies.h"

namespace stablecut {

std::string option_of(Remedy remedy) {
  switch (remedy) {
    case Remedy::kNone:
      return "";
    case Remedy::kBand:
      return "--band";
    case Remedy::kQuantity:
      return "--quantity";
    case Remedy::kUnit:
      return "--unit";
    case Remedy::kQuantityOrUnit:
      return "--quantity or --unit";
    case Remedy::kFunctions:
      return "--functions";
    case Remedy::kNode:
      return "--node";
    case Remedy::kModes:
      return "--modes";
    case Remedy::kTaps:
      return "--taps";
    case Remedy::kSampleRate:
      return "--sample-rate";
    case Remedy::kSensitivity:
      return "--sensitivity";
  }
  return "";
}

}  // namespace stablecut
