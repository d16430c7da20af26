// A cut in small steps of time: every tooth against the surface that all teeth before it have left.
// README.md, "Simulation".
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "base/units.h"
#include "milling/cutting_force.h"
#include "milling/simulation_grid.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// The end of a step, in the cut's frame.
struct SimulatedNode {
  long period = 0;
  int node = 0;                            ///< of the grid; the number of steps: node 0 of the next period
  Eigen::Vector2d tip_m;                   ///< displacement along the feed and normal to it
  ForceParts force = ForceParts::Zero();   ///< where the step ends, N
  ForceParts before = ForceParts::Zero();  ///< where it began
};

class SimulatedCut {
 public:
  /// Where the cut stands at the beginning of a period.
  struct State {
    Eigen::ArrayXcd modes;
    std::vector<double> surface;             ///< how far out the teeth have cut, m
    std::vector<double> passing;             ///< [teeth x surface] what each tooth leaves as it passes
    std::vector<double> travel;              ///< of the axis along the feed when a number was cut
    std::vector<double> one_back, two_back;  ///< [teeth x discs] how far out each was at its nodes before
    long period = 0;
  };
  /// Of the chip that a rigid tool would cut (the sum over the nodes): all, and where there was no contact.
  struct Contact {
    double expected_m = 0, missed_m = 0;
  };
  using Visit = std::function<void(const SimulatedNode&)>;

  /// A feed of 0: only small deviations can be followed.
  SimulatedCut(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
               double revolutions_per_s, double depth_m, const SimulationSteps& steps);

  const SimulationGrid& grid() const { return grid_; }
  const Cutter& cutter() const { return cutter_; }
  /// Periods after which the contact of a rigid tool repeats.
  int cycle() const { return cycle_; }
  int tooth_of(const SimulationTouch& touch, long period) const {
    return static_cast<int>((touch.tooth + period * grid_.shift) % cutter_.teeth);
  }

  /// A tool at rest on the surface that a rigid one has left, and the same a cycle later.
  const State& at_rest() const { return rest_; }
  const State& at_rest_later() const { return rest_later_; }
  /// Follows the cut for a period: a chip where a tooth is farther out than all before it, no contact
  /// elsewhere. `visit` is called at the end of every step.
  void advance(State& state, Contact& contact, const Visit& visit) const;

  /// A small deviation from a periodic motion, and its way through a period where teeth are in contact as
  /// those of a rigid tool are: a linear map.
  State no_deviation() const { return empty_state(); }
  void advance_deviation(State& state) const;
  /// The motion itself as it would be if the teeth stayed in contact as those of a rigid tool: affine.
  void advance_in_contact(State& state) const;

 private:
  enum class Kind { kReal, kInContact, kDeviation };
  struct StepOperator {
    Eigen::ArrayXcd flight;                // [modes]
    Eigen::MatrixX2cd from_start, to_end;  // [modes x 2] of the force at the step's ends
    Eigen::Matrix2d moved, hastened;       // the tip's displacement and velocity by the force at the end
  };
  // The force at a node, and how it changes with the tip's displacement and velocity.
  struct NodeForce {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    Eigen::Matrix2d by_tip = Eigen::Matrix2d::Zero(), by_speed = Eigen::Matrix2d::Zero();
    double axial = 0, along = 0;
    ForceParts parts() const { return {force.x(), force.y(), axial, along}; }
  };

  template <Kind kKind>
  NodeForce force_at(const State& state, long period, int node, bool before, const Eigen::Vector2d& tip,
                     const Eigen::Vector2d& velocity, Contact* contact) const;
  template <Kind kKind>
  double chip_of(const State& state, const SimulationTouch& touch, long period,
                 const Eigen::Vector2d& tip) const;
  // How much nearer a place lies than its number says, since the circles' centers lie apart along the feed
  // when it was cut and now. Circular paths know it of places that were cut longer than a revolution ago
  // only. On cycloids the place was passed at another angle too, and the center has moved meanwhile.
  double relief(double travel, const SimulationTouch& touch, int number, const State& state) const {
    if (!(cutter_.diameter_m > 0)) return 0;
    const bool cycloid = path_ == ToothPath::kCycloid;
    const double apart = travel - state.travel[number] - (cycloid ? 0 : feed_per_revolution_m_);
    if (!(apart > 0)) return 0;
    const double across = apart * touch.cosine;
    const double angle = cycloid ? 2 * across / cutter_.diameter_m : 0;
    return across * across / cutter_.diameter_m - angle * feed_per_revolution_m_ / kTwoPi * touch.sine;
  }
  // `leaves`: where to remember what is left.
  template <Kind kKind>
  void leave_surface(State& state, int node, const Eigen::Vector2d& tip, std::vector<char>* leaves) const;
  template <Kind kKind>
  void advance_as(State& state, Contact* contact, const Visit* visit) const;

  StepOperator operator_of(double seconds) const;
  void roll_rigid(State& state, int periods);
  State empty_state() const;
  double travel(long period, int node) const {
    return feed_per_revolution_m_ / kTwoPi *
           (static_cast<double>(period) * grid_.period_rad + grid_.turn_rad[node]);
  }
  Eigen::Vector2d tip_of(const Eigen::ArrayXcd& modes) const { return 2 * (shape_ * modes.matrix()).real(); }
  Eigen::Vector2d speed_of(const Eigen::ArrayXcd& modes) const {
    return 2 * (shape_ * (rate_ * modes).matrix()).real();
  }

  Cutter cutter_;
  CuttingLoad load_;
  SimulationGrid grid_;
  double turn_per_s_, feed_per_revolution_m_;
  ToothPath path_;
  double flank_n_s_per_m2_ = 0;  // process damping, across the cut
  Eigen::ArrayXcd rate_;         // [modes] lambda
  Eigen::Matrix2Xcd shape_, left_;
  Eigen::Matrix2d jump_;  // velocity by a force
  std::vector<StepOperator> operators_;
  std::vector<int> operator_of_step_;
  std::vector<bool> jumps_;  // [steps] whether what is in cut changes at the node
  State rest_, rest_later_;
  // Of a rigid tool, for the periods after which its chips repeat: the chip of each touch, and whether each
  // tooth leaves its number of the surface [cycle x teeth x surface]. Empty without feed.
  int cycle_ = 1;
  double grazing_m_ = 0;
  std::vector<double> rigid_chip_;
  std::vector<char> rigid_leaves_;
};

}  // namespace stablecut::milling
