#!/usr/bin/python3
"""Deflections at the poses of Yi et al. 2025, Tables 2 and 3: numbers in apps/best-pose/poses_test.sh.

588.6 N straight down on the KR360's tool point, stiffness K_2D (eq. 13). Method: forward kinematics in
modified Denavit-Hartenberg form, T(i-1, i) = Rx(alpha) Tx(a) Rz(theta) Tz(d), theta = sign angle + offset;
axes and points from the frames; deflection = sum over joints of J_v (J_v . F) / k. Reads testdata/kr360.json
and testdata/yanshan-poses.json. Prints the lengths in um, rounded as in the test.
"""
import json
import math
import os
import sys

from source_check import ROOT, stands_in

try:
    with open(os.path.join(ROOT, "testdata/kr360.json")) as file:
        robot = json.load(file)
    with open(os.path.join(ROOT, "testdata/yanshan-poses.json")) as file:
        paper = json.load(file)
except FileNotFoundError:
    sys.exit("testdata is not here")


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def link(joint, angle_deg):
    """Lengths in mm."""
    theta = math.radians(joint["theta_sign"] * angle_deg + joint["theta_offset_deg"])
    alpha, a, d = math.radians(joint["alpha_deg"]), joint["a_mm"], joint["d_mm"]
    ct, st, ca, sa = math.cos(theta), math.sin(theta), math.cos(alpha), math.sin(alpha)
    return [[ct, -st, 0, a], [st * ca, ct * ca, -sa, -sa * d], [st * sa, ct * sa, ca, ca * d], [0, 0, 0, 1]]


def placed(frame):
    rotation, origin = frame["rotation"], frame["translation_mm"]
    return [list(map(float, rotation[i])) + [float(origin[i])] for i in range(3)] + [[0, 0, 0, 1]]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def deflection_um(angles_deg, force):
    frame, axes = [[float(i == j) for j in range(4)] for i in range(4)], []
    for joint, angle in zip(robot["joints"], angles_deg):
        frame = times(frame, link(joint, angle))
        axes.append(([row[2] for row in frame[:3]], [row[3] for row in frame[:3]]))
    tool = times(times(frame, placed(robot["flange"])), placed(robot["tool"]))
    point = [row[3] for row in tool[:3]]
    moved = [0.0] * 3
    for (axis, origin), stiffness in zip(axes, paper["k_theta_2d_n_m_per_rad"]):
        lever = cross(axis, [(p - o) / 1000 for p, o in zip(point, origin)])
        turn = sum(v * f for v, f in zip(lever, force)) / stiffness
        moved = [m + v * turn for m, v in zip(moved, lever)]
    return 1e6 * math.sqrt(sum(m * m for m in moved))


texts = []
for table in ("height_1600_mm", "height_1200_mm"):
    values = [deflection_um(pose["joints_deg"], (0, 0, -paper["load_n"])) for pose in paper[table]]
    texts.append(f"evaluate {table} '{[round(v) for v in values]}'")
    print(texts[-1], "  ", " ".join(f"{v:.2f}" for v in values))
stands_in("apps/best-pose/poses_test.sh", *texts)
