#include "document/measured/frf_unit.h"

#include <catch2/catch.hpp>

using namespace stablecut;
using namespace stablecut::document;

TEST_CASE("units of frequency responses as analysers write them") {
  struct Expected {
    const char* text;
    dynamics::Quantity quantity;
    double to_si;
  };
  for (const Expected& expected : {
           Expected{"m/N", dynamics::Quantity::kReceptance, 1},
           Expected{"um/N", dynamics::Quantity::kReceptance, 1e-6},
           Expected{"\xC2\xB5m/N", dynamics::Quantity::kReceptance, 1e-6},
           Expected{"\xB5m/N", dynamics::Quantity::kReceptance, 1e-6},
           Expected{"mm/kN", dynamics::Quantity::kReceptance, 1e-6},
           Expected{"in/lbf", dynamics::Quantity::kReceptance, 0.0254 / 4.4482216152605},
           Expected{"m/s/N", dynamics::Quantity::kMobility, 1},
           Expected{"(mm/s)/N", dynamics::Quantity::kMobility, 1e-3},
           Expected{"m/(N s)", dynamics::Quantity::kMobility, 1},
           Expected{"m/(N*s^2)", dynamics::Quantity::kAccelerance, 1},
           Expected{"m/s2/N", dynamics::Quantity::kAccelerance, 1},
           Expected{"(m/s**2)/N", dynamics::Quantity::kAccelerance, 1},
           Expected{"(1/N)*(m/s\xB2)", dynamics::Quantity::kAccelerance, 1},
           Expected{"[m/s\xC2\xB2]/[N]", dynamics::Quantity::kAccelerance, 1},
           Expected{"g/N", dynamics::Quantity::kAccelerance, 9.80665},
           Expected{"G/LBF", dynamics::Quantity::kAccelerance, 9.80665 / 4.4482216152605},
           Expected{"MM/N", dynamics::Quantity::kReceptance, 1e-3},
           Expected{"1/kg", dynamics::Quantity::kAccelerance, 1},
           Expected{"kg^-1", dynamics::Quantity::kAccelerance, 1},
       }) {
    INFO(expected.text);
    const auto unit = frf_unit(expected.text);
    REQUIRE(unit);
    CHECK(unit->quantity == expected.quantity);
    CHECK(unit->to_si == Approx(expected.to_si).epsilon(1e-14));
  }
  for (const char* wrong : {"", " ", "N/m", "m", "m/s^3/N", "Pa", "m/MN", "Mm/N", "m//N", "(m/N", "m/N)",
                            "m^/N", "V/V", "m^99/N", "1", "m/N 3"}) {
    INFO(wrong);
    CHECK_FALSE(frf_unit(wrong));
  }
}

TEST_CASE("units of frequencies") {
  CHECK(frequency_unit("[Hz]") == 1.0);
  CHECK(frequency_unit("kHz") == 1000.0);
  CHECK(frequency_unit("rpm") == 1.0 / 60);
  CHECK_FALSE(frequency_unit("s"));
}
