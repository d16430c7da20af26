#!/usr/bin/python3
"""random_taps.py [--first SEED] [--taps N] [--fault FAULT] [--bin FOLDER]: simulated taps of random structures, most
with one fault, through fit-modes and sdm-lobes: which faults are named, how many sound taps are doubted, and how far the
least depth is from that of the true modes. One line for each tap that was not named or not right, then a table.

A structure has 2 to 5 soft modes of a robot (8 to 70 Hz) and 2 to 4 of a tool (180 to 2500 Hz) with damping that is not
proportional; in half of the cases the hits lie beside the sensor, so that it is not reciprocal. The accelerometer has a
floor of 50 to 80 dB, the hammer's channel 35 to 55 dB, and the force's spectrum fades. Needs python3-numpy.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess

import numpy as np

NAMES = "xy"
FAULTS = ["none", "drift", "hum", "delay", "late", "scale", "unit", "dead", "exchanged", "both-exchanged", "sign"]
RARE = ["shifted", "sensitivity"]  # drawn only where they are asked for, so that a seed stays what it was
DOUBTS = re.compile(r"comes? [-0-9.e]+ ms late|times what fits|nothing but noise|look exchanged|other sign|positive on|"
                    r"single lines|velocity|dead|natural frequencies|in all [0-9]+ modes")


def apart(rng, low, high, count, gap):
    while True:
        hz = np.sort(np.exp(rng.uniform(np.log(low), np.log(high), count)))
        if count < 2 or np.min(np.diff(np.log(hz))) > gap:
            return hz


def structure(rng, reciprocal=False):
    """Poles [modes], right and left vectors [modes x 2]."""
    soft, stiff = rng.integers(2, 6), rng.integers(2, 5)
    hz = np.r_[apart(rng, 8, 70, soft, 0.12), apart(rng, 180, 2500, stiff, 0.08)]
    damping = np.r_[np.exp(rng.uniform(np.log(0.012), np.log(0.06), soft)),
                    np.exp(rng.uniform(np.log(0.008), np.log(0.05), stiff))]
    stiffness = np.r_[np.exp(rng.uniform(np.log(0.7e6), np.log(6e6), soft)),
                      np.exp(rng.uniform(np.log(4e6), np.log(6e7), stiff))]
    omega = 2 * np.pi * hz
    n = len(hz)
    angle = rng.uniform(0, np.pi, n)
    shape = np.stack([np.cos(angle), np.sin(angle)], 1) * (omega / np.sqrt(stiffness))[:, None]
    mixed = rng.normal(0, 1, (n, 2 * n))
    mixed = mixed @ mixed.T
    size = np.sqrt(np.diag(mixed))
    own = 2 * damping * omega
    viscous = (0.6 * np.eye(n) + 0.4 * mixed / np.outer(size, size)) * np.sqrt(np.outer(own, own))
    state = np.block([[np.zeros((n, n)), np.eye(n)], [-np.diag(omega**2), -viscous]])
    poles, vectors = np.linalg.eig(state)
    inverse = np.linalg.inv(vectors)
    kept = np.argsort(np.where(poles.imag > 0, np.abs(poles), np.inf))[:n]
    hit = shape * np.exp(rng.normal(0, 0.04, shape.shape)) if rng.random() < 0.5 and not reciprocal else shape
    right, left = (shape.T @ vectors[:n, kept]).T, inverse[kept][:, n:] @ hit
    scale = np.sqrt(np.linalg.norm(left, axis=1) / np.linalg.norm(right, axis=1))[:, None]
    return poles[kept], right * scale, left / scale


def table(poles, right, left):
    def pairs(vector):
        return [[value.real, value.imag] for value in vector]
    return {"format": "stablecut/modal-table/1", "dofs": list(NAMES),
            "modes": [{"frequency_hz": abs(p) / 2 / np.pi, "damping_ratio": -p.real / abs(p), "psi_r": pairs(r), "psi_l": pairs(l)}
                      for p, r, l in zip(poles, right, left)]}


def with_fault(rng, fault, hz, s, exact, measured, noise):
    """Accelerances [2 x 2 x lines] with the fault, and the entry, and the number that mends it."""
    h, (i, j) = measured.copy(), rng.integers(2, size=2)
    entry = NAMES[i] + NAMES[j]
    delay = mends = np.exp(rng.uniform(np.log(5e-5), np.log(5e-3)))
    if fault == "drift":
        edge = rng.uniform(3, 12)
        walk = np.cumsum(rng.standard_normal(h.shape) * np.sqrt((hz[1] - hz[0]) / 2), axis=2)
        phase = np.exp(1j * (rng.uniform(0, 2 * np.pi, (2, 2, 1)) + 0.3 * walk))
        h += rng.uniform(0.5, 3) * np.abs(exact[:, :, [np.argmin(np.abs(hz - edge))]]) * (edge / hz)**2 * phase
    elif fault == "hum":
        for line in (50, 100, 150, 250):
            at = np.argmin(np.abs(hz - line))
            h[:, :, at] += rng.uniform(0.5, 5) * np.abs(exact[:, :, at]) * np.exp(2j * np.pi * rng.random((2, 2)))
    elif fault == "delay":
        h[i, j] *= np.exp(-s * delay)
    elif fault == "late":
        h *= np.exp(-s * delay)
    elif fault in ("scale", "unit"):
        mends = rng.uniform(1.02, 1.10)**rng.choice([-1, 1]) if fault == "scale" else rng.choice([1000, 0.001, 9.81, 1 / 9.81])
        h[i, j] *= mends
    elif fault == "dead":
        h[i, j] = noise[i, j]
    elif fault == "exchanged":
        h[:, j] = h[::-1, j].copy()
    elif fault == "both-exchanged":
        h = h[::-1].copy()
    elif fault == "sign":
        h[i, j] *= -1
    elif fault == "sensitivity":
        mends = rng.uniform(1.05, 1.2)**rng.choice([-1, 1])
        h[i] *= mends
        mends **= 1 - 2 * i
    return h, entry, mends


def tap(rng, modes, fault):
    poles, right, left = modes
    spacing, top = rng.choice([0.5, 1.0, 0.25]), rng.choice([2000, 3200, 4000])
    hz = np.arange(1 if rng.random() < 0.5 else int(4 / spacing), int(top / spacing) + 1) * spacing
    s = 2j * np.pi * hz
    residue = np.einsum("ki,kj->kij", right, left)

    def accelerance(at):
        return (np.einsum("kij,kl->ijl", residue, 1 / (s - at[:, None])) +
                np.einsum("kij,kl->ijl", residue.conj(), 1 / (s - at.conj()[:, None]))) * s * s
    exact = accelerance(poles)
    if fault == "shifted":
        # The sensor lies elsewhere for one force or response: poles off by one factor, or by one for each mode.
        side, of_force, shift = rng.integers(2), rng.random() < 0.5, rng.uniform(0.002, 0.01) * rng.choice([-1, 1])
        curves = (slice(None), side) if of_force else side
        exact[curves] = accelerance(poles * (1 + shift * (1 if rng.random() < 0.5 else rng.uniform(0.5, 1, len(poles)))))[curves]
    width = np.exp(rng.uniform(np.log(0.15e-3), np.log(0.5e-3)))
    force = np.maximum((np.abs(np.sinc(hz * width)) + 1 / (1 + (hz * width)**2)) / 2, 0.02)

    def normal(*shape):
        return (rng.standard_normal(shape) + 1j * rng.standard_normal(shape)) / np.sqrt(2)
    floor = 10**(-rng.uniform(50, 80) / 20) * np.sqrt(np.mean(np.abs(exact[0, 0])**2))
    noise = normal(2, 2, len(hz)) * floor / force
    hammer = 10**(-rng.uniform(35, 55) / 20) * normal(2, len(hz)) / force
    h, entry, mends = with_fault(rng, fault, hz, s, exact, exact * (1 + hammer) + noise, noise)
    if fault == "shifted":
        entry, mends = "force" if of_force else "response", (1 + shift)**(2 * side - 1)
    quantity = rng.choice(["receptance", "accelerance"])
    if quantity == "receptance":
        h = h / (s * s)
    return {"format": "stablecut/frf/1", "quantity": quantity, "frequency_hz": hz.tolist(),
            "h": [{"response": NAMES[i], "reference": NAMES[j], "re": h[i, j].real.tolist(), "im": h[i, j].imag.tolist()}
                  for i in range(2) for j in range(2)]}, entry, mends


def named(fault, entry, mends, text):
    if fault in ("scale", "unit"):
        tolerance = 0.02 if fault == "scale" else 0.05
        return any(entry in found[:2] and abs(float(found[2]) / mends - 1) < tolerance
                   for found in re.findall(r"H([xy]{2})(?: or H([xy]{2}))? is ([0-9.e+-]+) times", text))
    if fault == "sensitivity":
        found = re.search(r"Hxy is ([0-9.e+-]+) [^;]* in all", text)
        return found is not None and abs(float(found[1]) / mends - 1) < 0.02
    if fault == "shifted":
        found = re.search(r"curves of (force|response) y have natural frequencies ([0-9.]+)(?: to ([0-9.]+))? ", text)
        return found is not None and found[1] == entry and all(0.4 < (float(f) - 1) / (mends - 1) < 1.1 for f in found.groups()[1:] if f)
    patterns = {"drift": "rises towards 0", "hum": "single lines", "delay": f"H{entry}: its response comes",
                "late": "the responses come", "dead": f"H{entry}: nothing but noise", "exchanged": "look exchanged",
                "both-exchanged": "look exchanged", "sign": "with the other sign|positive on"}
    return re.search(patterns[fault], text) is not None


def doubted(modes, text):
    residue = np.einsum("ki,kj->kij", modes[1], modes[2])
    reciprocal = np.allclose(residue, residue.transpose(0, 2, 1), atol=1e-9 * np.abs(residue).max())
    return DOUBTS.search(text) is not None or (reciprocal and "not reciprocal" in text)


class Campaign:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def run(self, tool, document, *options):
        result = subprocess.run([self.folder / tool, "--threads", "1", *options], input=json.dumps(document), capture_output=True,
                                text=True, check=False)
        return json.loads(result.stdout) if result.returncode == 0 else None, result.stderr

    def least_depth(self, modes, cut):
        lobes, text = self.run("sdm-lobes", modes, "--limit-only", *cut)
        return min(row["depth_mm"] or np.inf for row in lobes["limit"]) if lobes else np.nan, text

    def judge(self, seed, fault):
        rng = np.random.default_rng(seed)
        fault = fault or FAULTS[rng.integers(len(FAULTS))]
        modes = structure(rng, fault == "sensitivity")
        cut = ["--teeth", str(rng.integers(2, 5)), "--kt", str(rng.integers(600, 1200)), "--kr", str(rng.integers(150, 400)),
               "--milling", str(rng.choice(["up", "down"])), "--immersion", f"{rng.uniform(0.2, 1):.2f}",
               "--speed", "3000:15000:4", "--depth", "0.02:30:2"]
        document, entry, mends = tap(rng, modes, fault)
        fitted, text = self.run("fit-modes", document)
        off = np.nan
        if fitted:
            depth, more = self.least_depth(fitted, cut)
            text += more
            off = depth / self.least_depth(table(*modes), cut)[0] - 1
        told = doubted(modes, text) if fault == "none" else named(fault, entry, mends, text)
        return {"seed": seed, "fault": fault, "what": f"{fault} {entry} {mends:.4g}", "told": told, "off": off,
                "right": fitted is None or bool(text) or abs(off) <= 0.05, "text": text}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--taps", type=int, default=100)
    parser.add_argument("--fault", choices=FAULTS + RARE)
    parser.add_argument("--bin", default=pathlib.Path(__file__).parents[2] / "build/bin")
    choice = parser.parse_args()
    campaign = Campaign(choice.bin)
    counts = collections.defaultdict(lambda: [0, 0, 0, 0])
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for result in pool.map(lambda seed: campaign.judge(seed, choice.fault), range(choice.first, choice.first + choice.taps)):
            count = counts[result["fault"]]
            for at, one in enumerate((1, result["told"], result["right"], abs(result["off"]) <= 0.05)):
                count[at] += bool(one)
            if result["told"] == (result["fault"] == "none") or not result["right"]:
                print(f"{result['seed']}: {result['what']}: depth off by {result['off']:.1%}", *result["text"].splitlines(), sep="\n    ")
    print(f"{'fault':16}{'taps':>6}{'named, or doubted':>19}{'depth right or warned':>23}{'depth within 5 %':>18}")
    for fault in FAULTS + RARE:
        if fault in counts:
            print(f"{fault:16}{counts[fault][0]:6}{counts[fault][1]:19}{counts[fault][2]:23}{counts[fault][3]:18}")


main()
