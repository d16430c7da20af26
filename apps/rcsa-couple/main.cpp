// rcsa-couple: a tool, its holder and the joint between them in, the frequency responses at the tip out.

#include "base/parallel.h"
#include "base/units.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/assembly.h"
#include "document/frf.h"

namespace stablecut {
namespace {

class RcsaCouple : public cli::Tool {
 public:
  RcsaCouple()
      : Tool("rcsa-couple",
             "The frequency responses at the tip of a tool that nobody tapped: beams for tool and holder, "
             "and the joint "
             "between them, by receptance coupling.",
             "frf") {}

 private:
  void setup(CLI::App& app) override {
    app.add_flag("--slopes", slopes_, "Also the responses of slopes and to moments");
  }

  void run() override {
    const cli::Input input = read_main_input(true);
    const AssemblyDocument assembly = assembly_from_json(input.document, input.source);
    const auto lines = static_cast<std::size_t>(assembly.frequency_hz.size());
    std::vector<std::array<Eigen::Matrix2cd, 2>> tip(lines);
    {
      cli::ProgressBar bar("rcsa-couple: lines", !quiet());
      parallel_for(
          lines, threads(),
          [&](std::size_t i) {
            const double omega = rad_per_s_from_hz(assembly.frequency_hz[static_cast<Eigen::Index>(i)]);
            const auto in_direction = [&](std::size_t d) {
              return tip_receptance(assembly.tool, assembly.held[d], assembly.theory, omega);
            };
            tip[i][0] = in_direction(0);
            tip[i][1] = assembly.axisymmetric ? tip[i][0] : in_direction(1);
          },
          [&](double share) { bar.show(share); });
    }
    FrequencyResponse frf;
    frf.frequency_hz = assembly.frequency_hz;
    const std::array<std::string, 2> names = {"x", "y"};
    // Coordinates of a direction: the deflection, and with --slopes the slope.
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const int coordinates = slopes_ ? 2 : 1;
        for (int a = 0; a < coordinates; ++a) {
          for (int b = 0; b < coordinates; ++b) {
            FrequencyResponseEntry entry;
            entry.response = (a == 0 ? "" : "slope_") + names[i];
            entry.reference = (b == 0 ? "" : "slope_") + names[j];
            entry.h = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(lines));
            for (std::size_t k = 0; i == j && k < lines; ++k)
              entry.h[static_cast<Eigen::Index>(k)] = tip[k][i](a, b);
            frf.entries.push_back(std::move(entry));
          }
        }
      }
    }
    write_document(main_output(), frf_to_json(frf));
  }

  bool slopes_ = false;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::RcsaCouple().main(argc, argv); }
