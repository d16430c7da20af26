#include "robot/identification.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "numerics/order_statistics.h"
#include "robot/load_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

TEST_CASE("what the loads can see: 2, 4, 5 and 6 joints, each named; exact data give the true values") {
  const Robot robot = kr360();
  const Eigen::Vector3d off(0.15, 0.05, 0.21);
  const auto plane = tool_down_poses(robot, {1.6}), cube = tool_down_poses(robot, {1.2, 1.5, 1.8});
  const auto all_ways = random_poses(robot, 40, 5);
  const auto verdict = [&](const Setup& setup, const std::string& expected, int rank) {
    const Identification found = identify_stiffness(robot, samples_of(robot, setup), {});
    CHECK(identified(found) == expected);
    CHECK(found.rank == rank);
    CHECK(worst_error(found) < 1e-9);
    CHECK(found.condition_number < 200);
    CHECK(found.outliers.empty());  // residuals of exact samples are rounding
    for (int j = 0; j < kJoints; ++j) {
      if (!found.identified(j)) CHECK(found.verdict[j] == Verdict::kUnseen);
    }
  };
  // Vertical load, tool down: joints 2 and 3, on a plane and on a cube grid.
  verdict({plane, {kDown}}, "-23---", 2);
  verdict({cube, {kDown}}, "-23---", 2);
  // Both points off the axis: 4.
  verdict({cube, {kDown}, off, off}, "-2345-", 4);
  // Loads along x, y, z: all but joint 6, which a force through a coaxial tool cannot turn.
  verdict({plane, kThreeLoads}, "12345-", 5);
  verdict({all_ways, kThreeLoads}, "12345-", 5);
  // A torque about axis 6 alone, or a measurement that sees its turn alone: still 5. Both: 6.
  verdict({all_ways, kThreeLoads, off}, "12345-", 5);
  verdict({all_ways, kThreeLoads, {0, 0, 0.21}, off}, "12345-", 5);
  verdict({all_ways, kThreeLoads, off, off}, "123456", 6);
  verdict({all_ways, kThreeLoads, off, {0, 0, 0.21}, true}, "123456", 6);
  verdict({all_ways, kThreeLoads, {0, 0, 0.21}, off, false, {30, 50, 70}}, "123456", 6);
  // A vertical load never sees joint 1.
  verdict({all_ways, {kDown}, off, off}, "-23456", 5);
}

TEST_CASE("without a load no joint is seen") {
  const Robot robot = kr360();
  const Setup setup{{JointAngles::Zero()}, {Eigen::Vector3d::Zero()}};
  const Identification found = identify_stiffness(robot, samples_of(robot, setup), {});
  CHECK_FALSE(found.any_identified());
  for (const Verdict verdict : found.verdict) CHECK(verdict == Verdict::kUnseen);
}

TEST_CASE("deflections of the wrong sign move against their loads and identify nothing") {
  const Robot robot = kr360();
  auto samples = samples_of(robot, {random_poses(robot, 8, 15), kThreeLoads});
  CHECK_FALSE(identify_stiffness(robot, samples, {}).moved_against_loads);
  for (LoadSample& sample : samples) sample.deflection_m *= -1;
  const Identification found = identify_stiffness(robot, samples, {});
  CHECK(found.moved_against_loads);
  CHECK_FALSE(found.any_identified());
  for (const double compliance : found.compliance) CHECK(compliance == 0);
}

TEST_CASE("one sample cannot tell joints apart, and says so") {
  const Robot robot = kr360();
  Setup setup{{(JointAngles() << 0, -1.0, 1.2, 0, 0, 0).finished()}, {kDown}};
  const auto samples = samples_of(robot, setup);
  IdentificationOptions only_z;
  only_z.components = {false, false, true};
  const Identification found = identify_stiffness(robot, samples, only_z);
  CHECK(found.rank == 1);
  CHECK(found.verdict[1] == Verdict::kInseparable);
  CHECK_FALSE(found.any_identified());
}

TEST_CASE("95 % intervals cover the true value in 93 to 97 % of all joints and 500 runs", "[campaign]") {
  const Robot robot = kr360();
  const auto coverage = [&](const Setup& setup, double std_m, double std_rad, bool stated, bool huber) {
    std::vector<LoadSample> exact = samples_of(robot, setup);
    if (stated) {
      for (LoadSample& sample : exact) {
        sample.deflection_std_m = Eigen::Vector3d::Constant(std_m);
        if (sample.rotation_rad) sample.rotation_std_rad = Eigen::Vector3d::Constant(std_rad);
      }
    }
    int inside = 0, all = 0;
    std::mt19937_64 generator(17);
    for (int run = 0; run < 500; ++run) {
      std::vector<LoadSample> samples = exact;
      add_noise(samples, std_m, std_rad, generator);
      const Identification found = identify_stiffness(robot, samples, {huber, {true, true, true}});
      for (int j = 0; j < kJoints; ++j) {
        if (!found.identified(j)) continue;
        const double c = 1 / k_theta_2d()[j];
        inside += found.low[j] <= c && c <= found.high[j];
        ++all;
      }
    }
    CHECK(all > 900);
    // 500 runs estimate 95 % with a deviation of at most 1 %.
    return static_cast<double>(inside) / all;
  };
  const Eigen::Vector3d off(0.15, 0.05, 0.21);
  const Setup few{random_poses(robot, 5, 1), kThreeLoads},
      six{random_poses(robot, 12, 2), kThreeLoads, off, off};
  const Setup turns{random_poses(robot, 12, 3), kThreeLoads, off, off, true};
  const Setup plane{tool_down_poses(robot, {1.6}), {kDown}};
  for (const double share :
       {coverage(few, 5e-6, 0, false, false), coverage(six, 10e-6, 0, false, false),
        coverage(six, 10e-6, 0, true, false), coverage(turns, 5e-6, 2e-5, false, false),
        coverage(turns, 5e-6, 2e-5, true, false), coverage(plane, 20e-6, 0, false, false)}) {
    CHECK(share > 0.93);
    CHECK(share < 0.97);
  }
  // The robust loss, with few samples and with many, and with stated deviations.
  for (const double share : {coverage(few, 5e-6, 0, false, true), coverage(six, 10e-6, 0, false, true),
                             coverage(turns, 5e-6, 2e-5, true, true)}) {
    CHECK(share > 0.92);
    CHECK(share < 0.98);
  }
}

TEST_CASE("the robust loss with nine numbers for five unknowns still gives honest intervals") {
  const Robot robot = kr360();
  const IdentificationOptions huber{true, {true, true, true}};
  int inside = 0, all = 0, runs_reweighted = 0;
  std::mt19937_64 generator(53);
  for (int run = 0; run < 400; ++run) {
    auto samples = samples_of(robot, {random_poses(robot, 1, 300 + run), kThreeLoads});
    add_noise(samples, 20e-6, 0, generator);
    const Identification by_squares = identify_stiffness(robot, samples, {}),
                         found = identify_stiffness(robot, samples, huber);
    runs_reweighted += found.residual_rms_m != by_squares.residual_rms_m;
    for (int j = 0; j < kJoints; ++j) {
      if (!found.identified(j)) continue;
      const double c = 1 / k_theta_2d()[j];
      inside += found.low[j] <= c && c <= found.high[j];
      ++all;
    }
  }
  CHECK(runs_reweighted > 50);  // else this is a test of least squares
  CHECK(all > 1000);
  // 95 % by Huber's asymptotic covariance, which so few numbers do not reach: 91 to 95 % over five seeds.
  CHECK(static_cast<double>(inside) / all > 0.90);
  CHECK(static_cast<double>(inside) / all < 0.97);
  // With no load there is nothing to see for either loss.
  auto unloaded = samples_of(robot, {random_poses(robot, 1, 3), {Eigen::Vector3d::Zero()}});
  CHECK_FALSE(identify_stiffness(robot, unloaded, huber).any_identified());
}

TEST_CASE("stated deviations that are too small leave intervals to the residuals") {
  const Robot robot = kr360();
  const auto exact = samples_of(robot, {random_poses(robot, 4, 1), kThreeLoads});
  std::mt19937_64 generator(59);
  int inside = 0, all = 0;
  for (int run = 0; run < 500; ++run) {
    auto samples = exact;
    add_noise(samples, 10e-6, 0, generator);
    for (LoadSample& sample : samples) sample.deflection_std_m = Eigen::Vector3d::Constant(2e-6);
    const Identification found = identify_stiffness(robot, samples, {});
    for (int j = 0; j < 5; ++j) {
      if (!found.identified(j)) continue;
      const double c = 1 / k_theta_2d()[j];
      inside += found.low[j] <= c && c <= found.high[j];
      ++all;
    }
  }
  CHECK(all > 2000);
  CHECK(static_cast<double>(inside) / all > 0.93);
  CHECK(static_cast<double>(inside) / all < 0.97);
}

TEST_CASE("noise that hides a joint: no number for it, no negative stiffness for any") {
  const Robot robot = kr360();
  std::mt19937_64 generator(23);
  int hidden = 0, identified = 0;
  for (int run = 0; run < 100; ++run) {
    auto samples = samples_of(robot, {random_poses(robot, 6, 100 + run), kThreeLoads});
    add_noise(samples, 150e-6, 0, generator);
    const Identification found = identify_stiffness(robot, samples, {});
    for (int j = 0; j < kJoints; ++j) {
      if (found.identified(j)) {
        CHECK(found.low[j] > 0);
        ++identified;
      } else {
        hidden += found.verdict[j] == Verdict::kUncertain;
      }
    }
  }
  CHECK(hidden > 20);
  CHECK(identified > 300);
}

TEST_CASE("outliers: named by both losses, resisted by one") {
  const Robot robot = kr360();
  auto samples = samples_of(robot, {random_poses(robot, 20, 9), kThreeLoads});
  std::mt19937_64 generator(31);
  add_noise(samples, 3e-6, 0, generator);
  samples[7].deflection_m += Eigen::Vector3d(400e-6, -300e-6, 200e-6);
  samples[41].deflection_m *= -1;
  const Identification squared = identify_stiffness(robot, samples, {});
  const Identification huber = identify_stiffness(robot, samples, {true, {true, true, true}});
  REQUIRE(huber.outliers.size() == 2);
  std::vector<int> named{huber.outliers[0].sample, huber.outliers[1].sample};
  std::sort(named.begin(), named.end());
  CHECK(named == std::vector<int>{7, 41});
  CHECK(huber.outliers[0].weight < 0.1);
  CHECK_FALSE(squared.outliers.empty());
  CHECK(identified(huber) == "12345-");
  CHECK(worst_error(huber) < 0.2 * worst_error(squared));

  // One bad component, or one bad sample among few.
  for (const int poses : {4, 7}) {
    auto few = samples_of(robot, {random_poses(robot, poses, 9), kThreeLoads});
    add_noise(few, 5e-6, 0, generator);
    CHECK(identify_stiffness(robot, few, {}).outliers.empty());
    few[5].deflection_m.y() += 1e-3;
    const Identification one = identify_stiffness(robot, few, {});
    REQUIRE(one.outliers.size() == 1);
    CHECK(one.outliers[0].sample == 5);
  }
}

TEST_CASE("a single component that is off is found though its sample as a whole hides it") {
  const Robot robot = kr360();
  const auto exact = samples_of(robot, {random_poses(robot, 7, 9), kThreeLoads});
  std::mt19937_64 generator(43);
  int found_it = 0, false_alarms = 0;
  for (int run = 0; run < 200; ++run) {
    auto samples = exact;
    add_noise(samples, 5e-6, 0, generator);
    samples[5].deflection_m.y() += 30e-6;  // 6 deviations
    for (const Outlier& outlier : identify_stiffness(robot, samples, {}).outliers)
      ++(outlier.sample == 5 ? found_it : false_alarms);
  }
  // 176 runs; 133 by the whole sample alone. Chance names a sample of these 4200 once in four such tests.
  CHECK(found_it > 160);
  CHECK(false_alarms <= 2);
}

TEST_CASE("cross-validation is what leaving out does") {
  const Robot robot = kr360();
  auto samples = samples_of(robot, {random_poses(robot, 6, 12), kThreeLoads});
  std::mt19937_64 generator(37);
  add_noise(samples, 10e-6, 0, generator);
  const Identification found = identify_stiffness(robot, samples, {});
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); i += 3) {  // the three loads of a pose
    auto others = samples;
    const auto first = others.begin() + static_cast<long>(i);
    const std::vector<LoadSample> own(first, first + 3);
    others.erase(first, first + 3);
    const Identification without = identify_stiffness(robot, others, {});
    const ComplianceEquations left = compliance_equations(robot, joint_springs(), own, {true, true, true});
    sum += (left.b - left.a * without.compliance).squaredNorm();
  }
  REQUIRE(found.cross_validation.rms_m);
  CHECK(*found.cross_validation.rms_m ==
        Approx(std::sqrt(sum / (3.0 * static_cast<double>(samples.size())))).epsilon(1e-9));
  CHECK(found.cross_validation.samples_not_predicted == 0);
  CHECK(found.residual_rms_m < *found.cross_validation.rms_m);
}

TEST_CASE("stated deviations that are too small are noticed") {
  const Robot robot = kr360();
  auto samples = samples_of(robot, {random_poses(robot, 12, 13), kThreeLoads});
  for (LoadSample& sample : samples) sample.deflection_std_m = Eigen::Vector3d::Constant(2e-6);
  std::mt19937_64 generator(41);
  add_noise(samples, 10e-6, 0, generator);
  const Identification found = identify_stiffness(robot, samples, {});
  CHECK(found.chi_square_tail < 1e-6);
  CHECK(*found.chi_square_per_dof == Approx(25).epsilon(0.3));
}

TEST_CASE("what the others cannot predict is left out of the cross-validation") {
  const Robot robot = kr360();
  // One sample with a load along y, which alone turns joint 1: the arm is stretched, so that the point lies
  // on the axes of joints 4 and 6.
  auto samples = samples_of(robot, {tool_down_poses(robot, {1.6}), {kDown}});
  const JointAngles stretched = (JointAngles() << 0, -1.0, 1.2, 0, 0, 0).finished();
  const auto sideways = samples_of(robot, {{stretched}, {{0, 600, 0}}});
  samples.push_back(sideways.front());
  std::mt19937_64 generator(83);
  add_noise(samples, 5e-6, 0, generator);
  const Identification found = identify_stiffness(robot, samples, {});
  CHECK(found.identified(0));
  CHECK(found.cross_validation.samples_not_predicted == 1);
  REQUIRE(found.cross_validation.rms_m);
  CHECK(*found.cross_validation.rms_m < 10e-6);  // the noise, some lever added
}

TEST_CASE("the robust loss solves Huber's equations") {
  const Robot robot = kr360();
  auto samples = samples_of(robot, {random_poses(robot, 8, 19), kThreeLoads});
  std::mt19937_64 generator(89);
  add_noise(samples, 10e-6, 0, generator);
  for (std::size_t i = 0; i < samples.size(); i += 6) samples[i].deflection_m.x() += 100e-6;
  const Identification found = identify_stiffness(robot, samples, {true, {true, true, true}});
  REQUIRE(identified(found) == "12345-");
  // sum over samples of w J^T r = 0, with w = min(1, 2 / z) and z the sample's RMS residual in robust
  // deviations.
  const ComplianceEquations equations =
      compliance_equations(robot, joint_springs(), samples, {true, true, true});
  const Eigen::VectorXd r = equations.b - equations.a * found.compliance;
  std::vector<double> sizes(r.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::abs(r[i]);
  const double deviation = numerics::median(sizes) / 0.6745;
  JointAngles sum = JointAngles::Zero(), size = JointAngles::Zero();
  int down_weighted = 0;
  for (Eigen::Index s = 0; s < r.size() / 3; ++s) {
    const Eigen::Vector3d own = r.segment<3>(3 * s);
    const double z = own.norm() / (std::sqrt(3.0) * deviation), weight = z > 2 ? 2 / z : 1;
    down_weighted += weight < 1;
    const JointAngles term = weight * equations.a.middleRows<3>(3 * s).transpose() * own;
    sum += term;
    size += term.cwiseAbs();
  }
  CHECK(down_weighted >= 4);  // the four shifted samples
  for (int j = 0; j < 5; ++j) CHECK(std::abs(sum[j]) < 1e-9 * size[j]);
}

TEST_CASE("stated deviations are believed when they are right, and not when they are two thirds",
          "[campaign]") {
  const Robot robot = kr360();
  const auto exact = samples_of(robot, {random_poses(robot, 12, 13), kThreeLoads});
  std::mt19937_64 generator(97);
  int contradicted_right = 0, contradicted_small = 0;
  constexpr int kRuns = 500;
  for (int run = 0; run < kRuns; ++run) {
    auto samples = exact;
    add_noise(samples, 10e-6, 0, generator);
    for (LoadSample& sample : samples) sample.deflection_std_m = Eigen::Vector3d::Constant(10e-6);
    contradicted_right += identify_stiffness(robot, samples, {}).deviations_contradicted;
    for (LoadSample& sample : samples) sample.deflection_std_m = Eigen::Vector3d::Constant(6.7e-6);
    contradicted_small += identify_stiffness(robot, samples, {}).deviations_contradicted;
  }
  // One in a thousand by chance; 103 degrees of freedom tell a variance of 2.2 from 1.
  CHECK(contradicted_right <= 4);
  CHECK(contradicted_small > 0.99 * kRuns);
}
