// --surface and what goes with it: what stable cuts leave on the part.
#pragma once

#include <optional>
#include <string>

#include "cli/tool.h"
#include "options.h"

namespace stablecut {

class SurfaceOption {
 public:
  std::string pose_path;  ///< of --static; empty where it is not given

  /// Declares all but --static; declare_static() what comes after it.
  void declare(CLI::App& app);
  void declare_static(CLI::App& app);
  /// Throws WrongUsage where the chart or the cut is not one that a surface can be said of.
  void check(const document::CutDocument& cut, const std::string& method, bool has_whole_grid,
             std::size_t tables) const;
  /// The request, with the surfaces of the best points where any of the options is given. Reads --static.
  milling::RunRequest completed(milling::RunRequest request, const dynamics::ModalModel& model,
                                const CutOptions::Reader& read_input) const;
  /// Adds the surface to a chart, where it is asked for.
  void compute(const milling::TipStructure& structure, const document::CutDocument& cut,
               const ChartAxes& axes, const milling::RunRequest& request, int threads, bool quiet,
               document::LobesDocument& lobes) const;

 private:
  bool used() const { return wanted_ || largest_error_um_; }

  bool wanted_ = false;
  std::optional<double> largest_error_um_, static_angle_deg_;
};

}  // namespace stablecut
