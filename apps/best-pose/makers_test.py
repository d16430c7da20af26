"""Robots of several makers from URDF to poses: forward kinematics, inverse kinematics and limits against a chain that is
computed here, straight from the URDF's numbers.

Lengths are those of the makers' data sheets (as the ROS-Industrial packages have them too; the KR 210's axis 1 stands off its
base link's origin as in that package). What the data sheets do not have, such as masses and shapes, is made up.
"""

import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

from jsonschema import Draft202012Validator

SOURCE = pathlib.Path(os.environ["SOURCE"])
sys.path.insert(0, str(SOURCE / "apps"))
sys.dont_write_bytecode = True
from testing import check, finish, product  # noqa: E402
MILLIMETRES = 1e-6  # documents hold lengths to 1e-9 mm and angles to 1e-9 degrees, which is 5e-8 mm on three metres
DEGREES = 1e-7

# ---- the chain: 4 x 4 matrices as lists of rows ----

def moved(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turned(axis, angle):
    """Rodrigues: 1 + sin(angle) K + (1 - cos(angle)) K^2 with the cross product matrix K of the axis."""
    size = math.sqrt(sum(v * v for v in axis))
    x, y, z = (v / size for v in axis)
    k = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    k2 = [[sum(k[i][m] * k[m][j] for m in range(3)) for j in range(3)] for i in range(3)]
    s, c = math.sin(angle), math.cos(angle)
    rows = [[(i == j) + s * k[i][j] + (1 - c) * k2[i][j] for j in range(3)] + [0] for i in range(3)]
    return rows + [[0, 0, 0, 1]]


def origin(xyz, rpy):
    frame = moved(*xyz)
    for axis, angle in (((0, 0, 1), rpy[2]), ((0, 1, 0), rpy[1]), ((1, 0, 0), rpy[0])):
        frame = product(frame, turned(axis, angle))
    return frame


def applied(frame, point):
    return [sum(frame[i][k] * p for k, p in enumerate([*point, 1])) for i in range(3)]


def apart(a, b):
    return math.dist(a, b)


HALF = math.pi / 2


class Maker:
    """A URDF as a list of joints: name, parent, child, xyz, rpy, axis (None: fixed), limits in degrees, mimic."""

    def __init__(self, name, joints, coupling=None, extra=""):
        self.name, self.joints, self.coupling, self.extra = name, joints, coupling, extra
        self.driven = [j["name"] for j in joints if j["axis"] and not j["mimic"] and not j.get("side")]

    def urdf(self):
        links = dict.fromkeys(link for j in self.joints for link in (j["parent"], j["child"]))
        text = [f'<robot name="{self.name}">']
        for link in links:
            text.append(f'<link name="{link}">{self.extra if link.startswith("link") else ""}</link>')
        for j in self.joints:
            text.append(f'<joint name="{j["name"]}" type="{"revolute" if j["axis"] else "fixed"}"><parent link="{j["parent"]}"/>'
                        f'<child link="{j["child"]}"/><origin xyz="{" ".join(map(repr, j["xyz"]))}" '
                        f'rpy="{" ".join(map(repr, j["rpy"]))}"/>')
            if j["axis"]:
                low, high = (repr(math.radians(v)) for v in j["limits"])
                text.append(f'<axis xyz="{" ".join(map(str, j["axis"]))}"/><limit lower="{low}" upper="{high}" effort="0" velocity="1"/>')
            if j["mimic"]:
                text.append('<mimic joint="{}" multiplier="{!r}" offset="{!r}"/>'.format(*j["mimic"]))
            text.append("</joint>")
        return "\n".join(text + ["</robot>"])

    def turns(self, controller):
        """The URDF's joint angles, rad, for the controller's, degrees."""
        degrees = list(controller)
        if self.coupling:
            degrees[2] += self.coupling * degrees[1]
        return dict(zip(self.driven, (math.radians(v) for v in degrees)))

    def frames(self, controller):
        """The frame of each link, m."""
        q = self.turns(controller)
        frames = {self.joints[0]["parent"]: moved(0, 0, 0)}
        for j in self.joints:
            frame = product(frames[j["parent"]], origin(j["xyz"], j["rpy"]))
            if j["axis"]:
                driver, multiplier, offset = j["mimic"] or (j["name"], 1, 0)
                frame = product(frame, turned(j["axis"], multiplier * q.get(driver, 0) + offset))
            frames[j["child"]] = frame
        return frames

    def limits(self):
        """Of the URDF's driven joints, degrees."""
        return [j["limits"] for name in self.driven for j in self.joints if j["name"] == name]


def joint(name, parent, child, xyz, axis=None, limits=None, rpy=(0, 0, 0), mimic=None, side=False):
    return dict(name=name, parent=parent, child=child, xyz=xyz, rpy=rpy, axis=axis, limits=limits, mimic=mimic, side=side)


def arm(rows, flange, base="base_link"):
    """Six joints in a row: xyz, axis, limits; then the flange: xyz, rpy."""
    links = [base] + [f"link_{i}" for i in range(1, 7)]
    joints = [joint(f"joint_{i + 1}", links[i], links[i + 1], *row) for i, row in enumerate(rows)]
    return joints + [joint("joint_6-tool0", "link_6", "tool0", flange[0], rpy=flange[1])]


Y, X, Z = (0, 1, 0), (1, 0, 0), (0, 0, 1)
KR210 = arm([((-0.00262, 0.00097586, 0.33099), Z, (-185, 185)), ((0.35277, -0.037476, 0.4192), Y, (-45, 85)),
             ((-9.8483e-05, -0.1475, 1.2499), Y, (-210, 65)), ((0.95795, 0.184, -0.055059), X, (-350, 350)),
             ((0.542, 0, 0), Y, (-125, 125)), ((0.1925, 0, 0), X, (-350, 350))], ((0.0375, 0, -0.00023924), (0, 0, 0)))
R2000 = arm([((0, 0, 0.67), Z, (-185, 185)), ((0.312, 0, 0), Y, (-60, 76)), ((0, 0, 1.075), (0, -1, 0), (-132, 180)),
             ((0, 0, 0.225), (-1, 0, 0), (-360, 360)), ((1.28, 0, 0), (0, -1, 0), (-125, 125)),
             ((0.215, 0, 0), (-1, 0, 0), (-360, 360))], ((0, 0, 0), (math.pi, -HALF, 0)))
IRB4400_ROWS = [((0, 0, 0), Z, (-165, 165)), ((0.2, 0, 0.68), Y, (-70, 95)), ((0, 0, 0.89), Y, (-60, 65)),
                ((1.38, 0, 0.15), X, (-200, 200)), ((0, 0, 0), Y, (-120, 120)), ((0, 0, 0), X, (-400, 400))]
# The parallel arm: a rod holds an elbow piece upright (mimic), against which axis 3 is measured.
IRB4400 = arm(IRB4400_ROWS, ((0.14, 0, 0), (0, HALF, 0)))
IRB4400[2:3] = [joint("rod", "link_2", "elbow", (0, 0, 0.89), Y, (-95, 70), mimic=("joint_2", -1, 0)),
                joint("joint_3", "elbow", "link_3", (0, 0, 0), Y, (-60, 65))]
TX90 = arm([((0, 0, 0.478), Z, (-180, 180)), ((0.05, 0, 0), Y, (-130, 147.5)), ((0, 0.05, 0.425), Y, (-145, 145)),
            ((0, 0, 0), Z, (-270, 270)), ((0, 0, 0.425), Y, (-115, 140)), ((0, 0, 0.1), Z, (-270, 270))],
           ((0, 0, 0), (0, 0, 0.4)))
GP225 = arm([((0, 0, 0.65), Z, (-180, 180)), ((0.325, 0, 0), Y, (-60, 76)), ((0, 0, 1.15), (0, -1, 0), (-86, 90)),
             ((1.225, 0, 0.3), (-1, 0, 0), (-360, 360)), ((0, 0, 0), (0, -1, 0), (-125, 125)),
             ((0, 0, 0), (-1, 0, 0), (-360, 360))], ((0.25, 0, 0), (math.pi, -HALF, 0)))
# The balancer of axis 2, off the chain.
GP225[2:2] = [joint("joint_1_s_2", "link_1", "balancer", (0.3989, 0, -0.2576), Y, (-60, 76), mimic=("joint_2", 0.7634, 0))]
# The same arm hung from a slanting beam, its flange turned.
SLANTED = [joint("beam", "base_link", "foot", (0.7, -1.1, 2.9), rpy=(2.6, 0.3, -1.1))] + arm(
    [((0.01, 0.02, 0.67), Z, (-185, 185))] + [(j["xyz"], j["axis"], j["limits"]) for j in R2000[1:6]],
    ((0.01, -0.02, 0.03), (0.4, 0.5, -0.6)), base="foot")
# A linkage with offsets and an axis that turns the other way.
MIRRORED = arm(IRB4400_ROWS, ((0.14, 0, 0), (0.1, 0.2, 0.3)))
MIRRORED[2:3] = [joint("rod", "link_2", "elbow", (0, 0, 0.89), (0, -1, 0), (-95, 70), mimic=("joint_2", 1, 0.2)),
                 joint("joint_3", "elbow", "link_3", (0, 0.01, 0), Y, (-60, 65))]
# What is made up: a mass and two shapes, which every link has.
BODY = ('<inertial><origin xyz="0.1 -0.2 0.3" rpy="0 0 0.5"/><mass value="12"/></inertial>'
        '<collision><origin xyz="0.05 0 0.1" rpy="0.3 0.4 0.5"/><geometry><cylinder radius="0.1" length="0.6"/></geometry></collision>'
        '<collision><geometry><box size="0.3 0.4 0.9"/></geometry></collision>')
# The controller's angle 3 against the URDF's: + for FANUC's convention, - for an arm whose axes 2 and 3 turn alike.
MAKERS = [Maker("KUKA KR 210 L150", KR210, extra=BODY), Maker("FANUC R-2000iC/165F", R2000, coupling=1),
          Maker("ABB IRB 4400/L30 by its linkage", IRB4400),
          Maker("ABB IRB 4400/L30 by --coupling", arm(IRB4400_ROWS, ((0.14, 0, 0), (0, HALF, 0))), coupling=-1),
          Maker("Staubli TX90", TX90), Maker("Yaskawa GP225", GP225),
          Maker("FANUC on a slanting beam", SLANTED, coupling=1, extra=BODY), Maker("a linkage with an offset", MIRRORED)]


def run(*command, status=0):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    check(" ".join(str(part) for part in command[:2]), done.returncode == status, f"status {done.returncode}: {done.stderr}")
    return done


def written(path, document):
    path.write_text(json.dumps(document))
    return path


def redundancy(frame):
    """Turn of the frame's x about its z from where it is nearest the base's x."""
    x, z = [frame[i][0] for i in range(3)], [frame[i][2] for i in range(3)]
    along = [(i == 0) - z[0] * z[i] for i in range(3)]
    across = [z[1] * along[2] - z[2] * along[1], z[2] * along[0] - z[0] * along[2], z[0] * along[1] - z[1] * along[0]]
    return math.degrees(math.atan2(sum(a * b for a, b in zip(x, across)), sum(a * b for a, b in zip(x, along))))


def dh_frames(robot, controller):
    """The frames of the document's links, mm, after its own words: base Rx(alpha) Tx(a) Rz(theta) Tz(d) ..."""
    names = [j["name"] for j in robot["joints"]]
    turns = dict(zip(names, controller))
    for c in robot.get("coupling", []):
        turns[c["joint"]] += c["ratio"] * controller[names.index(c["follows"])]
    frame = moved(0, 0, 0)
    if "base" in robot:
        frame = [row + [t] for row, t in zip(robot["base"]["rotation"], robot["base"]["translation_mm"])] + [[0, 0, 0, 1]]
    frames = []
    for j in robot["joints"]:
        theta = j["theta_sign"] * turns[j["name"]] + j["theta_offset_deg"]
        for step in (turned(X, math.radians(j["alpha_deg"])), moved(j["a_mm"], 0, 0), turned(Z, math.radians(theta)), moved(0, 0, j["d_mm"])):
            frame = product(frame, step)
        frames.append(frame)
    return frames


def within(maker, robot, controller):
    """True where the controller's angles hold the document's ranges, and the URDF's angles the URDF's."""
    own = all(j["min_deg"] - 1e-6 <= a <= j["max_deg"] + 1e-6 for j, a in zip(robot["joints"], controller))
    turns = [math.degrees(maker.turns(controller)[name]) for name in maker.driven]
    return own and all(low - 1e-6 <= a <= high + 1e-6 for (low, high), a in zip(maker.limits(), turns))


def random_poses(maker, count, seed):
    generator = random.Random(seed)
    poses = []
    for _ in range(count):
        turns = [generator.uniform(low, high) for low, high in maker.limits()]
        if maker.coupling:
            turns[2] -= maker.coupling * turns[1]
        poses.append(turns)
    return poses


def check_forward(maker, robot_path, k_path, folder):
    poses = random_poses(maker, 40, 1)
    listed = written(folder / "poses.json", {"format": "stablecut/pose-list/1", "poses": [{"joints_deg": p} for p in poses]})
    done = run("best-pose", "--robot", robot_path, "--evaluate", listed, "--quiet", k_path)
    worst = 0
    for pose, scored in zip(poses, json.loads(done.stdout)["evaluated"], strict=True):
        frame = maker.frames(pose)["tool0"]
        worst = max(worst, apart([1e3 * frame[i][3] for i in range(3)], scored["tcp_mm"]))
        turn = math.remainder(redundancy(frame) - scored["redundancy_deg"], 360)
        check(f"{maker.name}: turn of the tool", abs(turn) < 1e-5, turn)  # ill-defined only where z is near the base's x
        check(f"{maker.name}: inside the limits", scored["limit_margin_deg"] > -1e-6, scored["limit_margin_deg"])
    check(f"{maker.name}: forward", worst < MILLIMETRES, f"{worst} mm")
    return worst


def check_inverse(maker, robot, robot_path, k_path):
    """A search with nothing left to choose but the branch."""
    worst = solutions = 0
    for pose in random_poses(maker, 12, 2):
        frame = maker.frames(pose)["tool0"]
        point = [1e3 * frame[i][3] for i in range(3)]
        turn = redundancy(frame)
        done = run("best-pose", "--robot", robot_path, "--plane-origin=" + ",".join(map(repr, point)), "--x=0:0:1", "--y=0:0:1",
                   "--tool-axis=" + ",".join(repr(frame[i][2]) for i in range(3)), f"--redundancy={turn!r}:{turn!r}:1",
                   "--limit-margin", "0", "--singularity-margin", "0", "--keep-out-radius", "0", "--quiet", k_path)
        found = json.loads(done.stdout)
        angles = [p["joints_deg"] for p in [found["best"], *found["alternatives"]]]
        angles += [f["joints_deg"] for f in found["families"] if "joints_deg" in f]
        near = 360
        for solution in angles:
            solutions += 1
            reached = maker.frames(solution)["tool0"]
            worst = max(worst, apart(point, [1e3 * reached[i][3] for i in range(3)]))
            off = max(abs(reached[i][j] - frame[i][j]) for i in range(3) for j in range(3))
            check(f"{maker.name}: the same frame", off < 1e-9, off)
            check(f"{maker.name}: limits of the angles and of the turns", within(maker, robot, solution), solution)
            # A runner-up stands for its flipped wrist too, so that of the pose itself the arm is asked for.
            near = min(near, max(abs(math.remainder(a - b, 360)) for a, b in zip(solution[:3], pose)))
        check(f"{maker.name}: the pose's arm is among the solutions", near < DEGREES, near)
    check(f"{maker.name}: inverse", worst < MILLIMETRES, f"{worst} mm")
    check(f"{maker.name}: several branches", solutions > 12, solutions)
    return worst


def check_bodies(maker, robot):
    """Centres and capsules go where the URDF's links go; a capsule encloses its shape."""
    for pose in random_poses(maker, 5, 3):
        frames, dh = maker.frames(pose), dh_frames(robot, pose)
        for i, j in enumerate(robot["joints"]):
            link = frames[f"link_{i + 1}"]
            check(f"{maker.name}: mass", j["mass_kg"] == 12)
            center = [1e3 * v for v in applied(link, (0.1, -0.2, 0.3))]
            check(f"{maker.name}: centre", apart(center, applied(dh[i], j["center_mm"])) < MILLIMETRES)
            cylinder, box = j["capsules"]
            shape = product(link, origin((0.05, 0, 0.1), (0.3, 0.4, 0.5)))
            for end, z in (("from_mm", -0.3), ("to_mm", 0.3)):
                check(f"{maker.name}: cylinder", apart([1e3 * v for v in applied(shape, (0, 0, z))], applied(dh[i], cylinder[end])) < MILLIMETRES)
            check(f"{maker.name}: radius", cylinder["radius_mm"] == 100)
            a, b = applied(dh[i], box["from_mm"]), applied(dh[i], box["to_mm"])
            for corner in ((x, y, z) for x in (-0.15, 0.15) for y in (-0.2, 0.2) for z in (-0.45, 0.45)):
                p = [1e3 * v for v in applied(link, corner)]
                share = sum((q - s) * (e - s) for q, s, e in zip(p, a, b)) / apart(a, b) ** 2
                nearest = [s + min(1, max(0, share)) * (e - s) for s, e in zip(a, b)]
                check(f"{maker.name}: box", apart(p, nearest) < box["radius_mm"] + MILLIMETRES)


def check_coupled_limits(maker, robot_path, k_path, folder):
    """70 and 130 degrees are within what either angle may be, and 200 degrees are beyond the turn of axis 3."""
    pose = [0, 70, 130, 0, 30, 0]
    listed = written(folder / "outside.json", {"format": "stablecut/pose-list/1", "poses": [{"joints_deg": pose}]})
    done = run("best-pose", "--robot", robot_path, "--evaluate", listed, k_path)
    check("coupled range: margin", abs(json.loads(done.stdout)["evaluated"][0]["limit_margin_deg"] + 20) < 1e-9, done.stdout)
    check("coupled range: warned", "20 degrees outside the joint limits" in done.stderr, done.stderr)


def check_any_base(folder, k_path):
    """The same arm in base frames that stand and turn anyhow: axis 1 along each axis of the base, and along none."""
    generator = random.Random(4)
    turns = [(0, 0, 0), (math.pi, 0, 0), (HALF, 0, 0), (-HALF, 0, 0), (0, HALF, 0), (0, -HALF, 0), (0, 0, HALF), (0.5, 0, 0)]
    turns += [tuple(generator.uniform(-3, 3) for _ in range(3)) for _ in range(6)]
    worst = 0
    for n, turn in enumerate(turns):
        place = (0, 0, 0) if n % 2 else tuple(generator.uniform(-2, 2) for _ in range(3))
        joints = [joint("stand", "base_link", "foot", place, rpy=turn)] + arm(
            [(j["xyz"], j["axis"], j["limits"]) for j in TX90[:6]], ((0.01, 0, 0.02), (0.3, 0, 0)), base="foot")
        maker = Maker(f"TX90 turned by {turn}", joints)
        urdf, robot_path = folder / "any.urdf", folder / "any.json"
        urdf.write_text(maker.urdf())
        run(SOURCE / "scripts/import-urdf", "--base", "base_link", urdf, "-o", robot_path)
        robot = json.loads(robot_path.read_text())
        flange = [row + [t] for row, t in zip(robot["flange"]["rotation"], robot["flange"]["translation_mm"])] + [[0, 0, 0, 1]]
        for pose in random_poses(maker, 5, 5):
            expected, frame = maker.frames(pose)["tool0"], product(dh_frames(robot, pose)[5], flange)
            worst = max(worst, apart([1e3 * row[3] for row in expected[:3]], [row[3] for row in frame[:3]]))
            off = max(abs(expected[i][j] - frame[i][j]) for i in range(3) for j in range(3))
            check(f"{maker.name}: orientation", off < 1e-9, off)
        middle = [1e3 * row[3] for row in maker.frames([0, 30, 60, 0, 30, 0])["tool0"][:3]]
        run("best-pose", "--robot", robot_path, "--plane-origin=" + ",".join(map(repr, middle)), "--x=0:0:1", "--y=0:0:1",
            "--tool-axis=" + ",".join(repr(row[2]) for row in maker.frames([0, 30, 60, 0, 30, 0])["tool0"][:3]), "--quiet", k_path)
    check("any base: forward", worst < MILLIMETRES, f"{worst} mm")
    print(f"any base frame: within {worst:.1e} mm")


schema = Draft202012Validator(json.loads((SOURCE / "schemas/robot.schema.json").read_text()))
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    k_path = written(folder / "k.json", {"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": [3e6, 3e6, 2e6, 1e6, 8e5, 5e5]})
    for maker in MAKERS:
        urdf, robot_path = folder / "robot.urdf", folder / "robot.json"
        urdf.write_text(maker.urdf())
        options = ["--coupling", "fanuc"] if maker.coupling else []
        done = run(SOURCE / "scripts/import-urdf", urdf, "-o", robot_path, *options)
        check(f"{maker.name}: the tip is said", "from link base_link to link tool0" in done.stderr, done.stderr)
        robot = json.loads(robot_path.read_text())
        errors = [error.message for error in schema.iter_errors(robot)]
        check(f"{maker.name}: a robot document", not errors, errors)
        forward = check_forward(maker, robot_path, k_path, folder)
        inverse = check_inverse(maker, robot, robot_path, k_path)
        print(f"{maker.name}: forward within {forward:.1e} mm, inverse within {inverse:.1e} mm")
        if maker.extra:
            check_bodies(maker, robot)
        if maker.name == "FANUC R-2000iC/165F":
            check_coupled_limits(maker, robot_path, k_path, folder)
    check_any_base(folder, k_path)
finish()
