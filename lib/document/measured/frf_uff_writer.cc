#include "document/measured/frf_uff_writer.h"

#include <array>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/range.h"

namespace stablecut::document {
namespace {

// `x@3`: node 3, direction 1.
UniversalDof dof_of(const std::string& name) {
  const auto at = name.find('@');
  const std::string direction = name.substr(0, at);
  const auto node =
      at == std::string::npos ? std::optional(1) : parse_integer(std::string_view(name).substr(at + 1));
  const auto index = std::string("xyz").find(direction);
  if (direction.size() != 1 || index == std::string::npos || !node)
    throw InvalidArgument(name + ": a universal file takes the directions x, y and z");
  return {"", *node, static_cast<int>(index) + 1};
}

}  // namespace

std::string frf_to_universal_file(const dynamics::FrequencyResponse& frf, UniversalForm form) {
  using namespace universal;
  static const std::array<UniversalAxis, 3> kResponses = {{{kDisplacement, "Displacement", "m"},
                                                           {kVelocity, "Velocity", "m/s"},
                                                           {kAcceleration, "Acceleration", "m/s^2"}}};
  std::string text = universal_si_units();
  for (const auto& entry : frf.entries) {
    if (entry.response_position_m.value_or(0) != 0 || entry.reference_position_m.value_or(0) != 0)
      throw InvalidArgument(
          "entries at several distances from the tip: a universal file takes directions only");
    UniversalFunction function;
    function.id[0] = "H " + entry.response + " " + entry.reference + ": response, then force";
    function.type = kFrequencyResponse;
    function.response = dof_of(entry.response);
    function.reference = dof_of(entry.reference);
    function.abscissa = frf.frequency_hz;
    function.values = entry.h;
    function.abscissa_axis = {kFrequency, "Frequency", "Hz"};
    function.ordinate = kResponses[static_cast<std::size_t>(frf.quantity)];
    function.denominator = {kForce, "Force", "N"};
    text += universal_function(function, form);
  }
  return text;
}

}  // namespace stablecut::document
