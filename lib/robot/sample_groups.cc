#include "robot/sample_groups.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr double kSamePose = radians_from_degrees(0.1);  // encoders and hands repeat a pose to less
constexpr int kMostBlocks = 10;

}  // namespace

SampleGroups groups_by_pose(const std::vector<LoadSample>& samples) {
  SampleGroups groups;
  std::map<std::array<long long, kJoints>, int> known;
  for (const LoadSample& sample : samples) {
    std::array<long long, kJoints> cell;
    for (int j = 0; j < kJoints; ++j) cell[j] = std::llround(sample.angles[j] / kSamePose);
    const auto [place, fresh] = known.try_emplace(cell, groups.count);
    if (fresh) ++groups.count;
    groups.of_sample.push_back(place->second);
  }
  return groups;
}

SampleGroups groups_by_block(const std::vector<LoadSample>& samples, const SampleGroups& poses) {
  std::vector<const JointAngles*> angles(poses.count);
  for (std::size_t s = samples.size(); s-- > 0;) angles[poses.of_sample[s]] = &samples[s].angles;
  JointAngles mean = JointAngles::Zero();
  for (const JointAngles* one : angles) mean += *one / static_cast<double>(poses.count);
  std::vector<int> block(poses.count, 0);
  std::vector<double> distance(poses.count);
  for (int p = 0; p < poses.count; ++p) distance[p] = (*angles[p] - mean).norm();
  SampleGroups blocks;
  for (; blocks.count < kMostBlocks && blocks.count < poses.count; ++blocks.count) {
    int farthest = 0;
    for (int p = 1; p < poses.count; ++p) {
      if (distance[p] > distance[farthest]) farthest = p;
    }
    const JointAngles centre = *angles[farthest];
    if (blocks.count == 0) distance.assign(poses.count, std::numeric_limits<double>::infinity());
    for (int p = 0; p < poses.count; ++p) {
      const double here = (*angles[p] - centre).norm();
      if (here >= distance[p]) continue;
      distance[p] = here;
      block[p] = blocks.count;
    }
  }
  for (const int pose : poses.of_sample) blocks.of_sample.push_back(block[pose]);
  return blocks;
}

}  // namespace stablecut::robot
