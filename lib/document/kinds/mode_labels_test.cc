#include "document/kinds/mode_labels.h"

#include <catch2/catch.hpp>
#include <complex>

#include "document/kinds/modal_table_json.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

Json mode_at(double frequency_hz, double x, double y) {
  const Json psi = {{x, 0}, {y, 0}};
  return {{"frequency_hz", frequency_hz}, {"damping_ratio", 0.03}, {"psi_r", psi}, {"psi_l", psi}};
}

Json table(std::vector<Json> modes) {
  return {{"format", "stablecut/modal-table/1"}, {"dofs", {"x", "y"}}, {"modes", std::move(modes)}};
}

Json labelled(const Json& reference, const Json& other) {
  const Source source{"table.json", ""};
  return with_labels_of(reference, other,
                        dynamics::compare_modes(modal_table_from_json(reference, source),
                                                modal_table_from_json(other, source)));
}

}  // namespace

TEST_CASE("a mode keeps its label from table to table, and a new one gets a new label") {
  Json stand_in = mode_at(900, 1, 0);
  stand_in["out_of_band"] = true;
  const Json first = table({mode_at(100, 1, 0.1), mode_at(101, -0.1, 1), mode_at(250, 1, 1), stand_in});
  const Json second = table({mode_at(96, -0.1, 1), mode_at(99, 1, 0.1), mode_at(500, 1, 1), stand_in});
  const Json once = labelled(first, second);
  CHECK(mode_labels(once) == std::vector<std::string>{"m2", "m1", "m5", ""});
  Json third = first;
  third["modes"][1]["label"] = "of another study";
  // m5 is taken, and so are the numbers of the four modes before.
  CHECK(mode_labels(labelled(once, third)) == std::vector<std::string>{"m1", "m2", "m6", ""});
  Json named = first;
  named["modes"][0]["label"] = "spindle";
  CHECK(mode_labels(labelled(named, second)) == std::vector<std::string>{"m2", "spindle", "m5", ""});
  // The rest of the document stays.
  Json back = once;
  for (Json& mode : back["modes"]) mode.erase("label");
  CHECK(back == second);
}
