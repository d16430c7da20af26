# Poses 1, 3 and 5 of Yi et al., Table 2: nearer and farther.
{format: "stablecut/pose-list/1",
 poses: [.height_1600_mm as $p | [$p[0], "near"], [$p[2], "middle"], [$p[4], "far"] | {name: .[1], joints_deg: .[0].joints_deg}]}
