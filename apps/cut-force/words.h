// What cut-force says: the facts of lib/milling in words.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "document/kinds/cut_force_json.h"
#include "milling/force_identification.h"
#include "milling/tested_coefficients.h"

namespace stablecut {

/// Why there is no cut where Kt or Kr cannot be told from the forces; empty where they can. `fitted`: without
/// bounds.
std::string no_coefficients_text(const milling::ForceIdentification& fitted);

/// Warnings of an identification, in the order in which they are given; `source` is the table's name.
std::vector<std::string> identification_warnings(const milling::ForceIdentification& fitted,
                                                 const std::array<bool, milling::kCoefficients>& held_at_zero,
                                                 const std::string& source);

/// Warnings of simulated points; `source` is the name of their table.
std::vector<std::string> point_warnings(const std::vector<document::SimulatedPoint>& points,
                                        const std::string& source);

/// Why tested cuts are refused.
std::string contradiction_text(const milling::CoefficientPosterior& posterior,
                               const milling::PosteriorRequest& request, std::size_t cuts);
/// What should be said of an answer.
std::vector<std::string> posterior_warnings(const milling::CoefficientPosterior& posterior);

}  // namespace stablecut
