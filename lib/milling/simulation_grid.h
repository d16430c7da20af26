// The times at which a simulated cut is looked at, and what its teeth touch there. README.md, "Simulation".
#pragma once

#include <array>
#include <vector>

#include "milling/cutter.h"

namespace stablecut::milling {

/// How teeth move as the tool is fed: on circles, each a feed beside the one before, or on cycloids.
enum class ToothPath { kCircle, kCycloid };

/// How fine a simulation is, and of which paths.
struct SimulationSteps {
  double longest_rad = 0;  ///< of turn; shorter where a tooth enters or leaves between two
  int discs = 1;           ///< straight ones that stand for a helical edge
  bool in_cut = false;     ///< pieces of the period in which nothing cuts are one step
  ToothPath path = ToothPath::kCircle;
};

/// One tooth's disc at a node of the grid.
struct SimulationTouch {
  int node = 0;
  int tooth = 0;  ///< in the first period; in period p the tooth (tooth + p * shift) mod teeth
  int disc = 0;
  double phi_rad = 0, sine = 0, cosine = 0;
  /// Where the disc enters or leaves: by how much the sine is larger half a step within the cut, where
  /// whether it is in contact is judged.
  double within = 0;
  int surface = 0;  ///< the surface there: `weight` times the four numbers from this one on
  std::array<double, 4> weight{};
  bool before = false, after = false;  ///< whether the disc is in cut before the node, and after it
  int write_from = 0, write_to = 0;    ///< its part of `writes`
  int leave_from = 0, leave_to = 0;    ///< numbers of the surface that later reads of this pass do not need
};

/// A number of the surface as the disc passes it, from where the disc was at the two nodes before and is now.
struct SurfaceWrite {
  int surface = 0;
  std::array<double, 3> weight{};
};

/// A period: the pitch, or the revolution where pitches differ. Every place where a disc enters or leaves is
/// a node.
struct SimulationGrid {
  double period_rad = 0;
  int shift = 0;                   ///< teeth that pass in a period and are not told apart by the grid: 1 or 0
  int passes = 1;                  ///< teeth that pass in a period
  std::vector<double> turn_rad;    ///< [steps + 1]
  std::vector<double> depth_m;     ///< [discs] of each
  std::vector<double> height_m;    ///< [discs] of each above the tip
  std::vector<double> surface_at;  ///< phi of each number of the surface, disc after disc
  std::vector<double> surface_within;    ///< the same of each number of the surface as `within` of a touch
  std::vector<int> disc_from;            ///< [discs + 1] where a disc's part of it begins
  std::vector<SimulationTouch> touches;  ///< by node
  std::vector<int> first_touch;          ///< [steps + 1] of each node of 0 ... steps - 1, and the end
  std::vector<SurfaceWrite> writes;
  std::vector<int> leaving;  ///< nodes at which the tip of a tooth leaves the cut

  int steps() const { return static_cast<int>(turn_rad.size()) - 1; }
};

/// The longest step of so many in a mean pitch, and of some in a tooth's way through the cut and in the
/// smallest pitch.
double longest_step_rad(const Cutter& cutter, int per_pitch);

SimulationGrid simulation_grid(const Cutter& cutter, double depth_m, const SimulationSteps& steps);

}  // namespace stablecut::milling
