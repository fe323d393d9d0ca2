"""Times the lab's boxes in Mitsuba 3 and in Lightwalk, side by side.

    make bench-peers

Processor time and wall-clock time, with all threads: Mitsuba's over ours. Runs
alternate, so that other load on the machine affects all of them, and we compare
medians. First the means of the diffuse boxes' pictures must agree: being fast
with another picture does not count.
The boxes with all materials compare time only: Mitsuba has no plastic like the
course's, and its glass follows Fresnel's equations.

The LLVM variant needs libLLVM 16 or newer: the one that DRJIT_LIBLLVM_PATH names,
or else the newest of the system. Without it the scalar variant is timed, which
--scalar adds in any case.
"""

import argparse
import glob
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import mitsuba
import numpy

from tools.bench.bar import registers
from tools.tree import BUILD, SCENES, read_pfm, render

BOXES = (
    "cornell_box_point_diffuse",
    "cornell_box_ceiling_diffuse",
    "cornell_box_point",
    "cornell_box_ceiling",
)
FAR = 40  # planes are infinite here, and rectangles there


def bsdf(material):
    """A material of the course; materials that are not diffuse only look similar."""

    def color(key):
        value = material.get(key, 0)
        return value if isinstance(value, list) else [value] * 3

    def rgb(values):
        return {"type": "rgb", "value": values}

    if "kt" in material:
        return {"type": "dielectric", "int_ior": material.get("eta", 1.5)}
    diffuse = {"type": "diffuse", "reflectance": rgb(color("kd"))}
    share = max(color("ks"))
    if share == 0:
        return diffuse
    mirror = {"type": "conductor", "material": "none"}
    return {"type": "blendbsdf", "weight": share, "0": diffuse, "1": mirror}


def mitsuba_scene(mi, toml):
    """The scene as a dictionary of Mitsuba's."""
    transform = mi.ScalarTransform4f
    camera = toml["camera"]
    aim = [o + f for o, f in zip(camera["origin"], camera["forward"])]
    half_width = math.hypot(*camera["left"]) / math.hypot(*camera["forward"])
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": toml["render"].get("max_bounces", -2) + 1},
        "sensor": {
            "type": "perspective",
            "fov": 2 * math.degrees(math.atan(half_width)),
            # Mitsuba's left is at +x, the slides' at -x.
            "to_world": transform().look_at(origin=camera["origin"], target=aim, up=camera["up"])
            @ transform().scale([-1, 1, 1]),
            "film": {
                "type": "hdrfilm",
                "width": camera["size"][0],
                "height": camera["size"][1],
                "rfilter": {"type": "box"},
                "pixel_format": "rgb",
                "component_format": "float32",
            },
            "sampler": {"type": "independent"},
        },
    }
    for i, shape in enumerate(toml["shapes"]):
        material = toml["materials"][shape["material"]]
        if shape["type"] == "sphere":
            entry = {"type": "sphere", "center": shape["center"], "radius": shape["radius"]}
        else:
            normal = shape["normal"]
            at = [-shape["distance"] * n for n in normal]
            up = [0, 0, 1] if normal[2] == 0 else [0, 1, 0]
            entry = {
                "type": "rectangle",
                "to_world": transform().look_at(origin=at, target=[a + n for a, n in zip(at, normal)], up=up)
                @ transform().scale([FAR, FAR, 1]),
            }
        if "ke" in material:
            radiance = {"type": "rgb", "value": [material["ke"]] * 3}
            entry["emitter"] = {"type": "area", "radiance": radiance}
            entry["bsdf"] = bsdf({})
        else:
            entry["bsdf"] = bsdf(material)
        scene[f"shape_{i}"] = entry
    for i, light in enumerate(toml.get("lights", [])):
        scene[f"light_{i}"] = {
            "type": "point",
            "position": light["center"],
            "intensity": {"type": "rgb", "value": [light["intensity"]] * 3},
        }
    return mi.load_dict(scene)


class Peer:
    def __init__(self, variant, toml):
        mitsuba.set_variant(variant)
        self.name = f"Mitsuba {mitsuba.__version__}, {variant}"
        self.variant = variant
        self.scene = mitsuba_scene(mitsuba, toml)
        self.render(1, 0)  # compiles

    def render(self, spp, seed):
        """Seconds of processor and wall-clock time, and the mean radiance."""
        mitsuba.set_variant(self.variant)
        start, cpu = time.perf_counter(), time.process_time()
        image = numpy.array(mitsuba.render(self.scene, spp=spp, seed=seed))
        return time.process_time() - cpu, time.perf_counter() - start, image.mean(axis=(0, 1))


class Ours:
    def __init__(self, program, folder, scene):
        self.name = f"{program}, {registers(folder) or 'baseline'}"
        self.program, self.scene = folder / program, scene

    def render(self, spp, seed):
        with tempfile.NamedTemporaryFile(suffix=".pfm") as file:
            report = render(self.program, self.scene, file.name, "--spp", spp, "--seed", seed)
            *_, pixels = read_pfm(file.name)
        return report["cpu_seconds"], report["seconds"], numpy.mean(pixels, axis=0)


def llvm_runs():
    """Whether Mitsuba's LLVM variant runs, and with which library."""
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        found = glob.glob("/usr/lib/*/libLLVM*1[6-9]*.so*") + glob.glob("/usr/lib/*/libLLVM.so.*")
        if found:
            os.environ["DRJIT_LIBLLVM_PATH"] = max(found)
    probe = (
        "import mitsuba as mi; mi.set_variant('llvm_ad_rgb');"
        "mi.render(mi.load_dict(mi.cornell_box()), spp=1).numpy()"
    )
    return subprocess.run([sys.executable, "-c", probe], capture_output=True).returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repetitions", default=7, type=int)
    parser.add_argument("--spp", default=64, type=int)
    parser.add_argument("--scalar", action="store_true", help="Mitsuba's scalar variant, too: slow")
    parser.add_argument(
        "--also", action="append", default=[], type=Path, help="a build for other registers", metavar="FOLDER"
    )
    options = parser.parse_args()
    variants = ["llvm_ad_rgb"] if llvm_runs() else []
    if not variants:
        print("llvm_ad_rgb does not run here: see DRJIT_LIBLLVM_PATH")
    if options.scalar or not variants:
        variants.append("scalar_rgb")
    print("| box | program | CPU s | Mitsuba takes | clock s | Mitsuba takes |")
    print("|---|---|---|---|---|---|")
    for name in BOXES:
        path = SCENES / f"{name}.toml"
        toml = tomllib.loads(path.read_text())
        programs = [Peer(variant, toml) for variant in variants]
        programs += [Ours(f"stage{n}", folder, path) for n in (5, 6) for folder in [*options.also, BUILD]]
        runs = [[] for _ in programs]
        for seed in range(options.repetitions):
            for program, done in zip(programs, runs):
                done.append(program.render(options.spp, seed + 1))
        means = [numpy.mean([mean for *_, mean in done], axis=0) for done in runs]
        if name.endswith("diffuse"):
            for mean, program in zip(means[1:], programs[1:]):
                if not numpy.allclose(mean, means[0], rtol=0.01):
                    sys.exit(f"{name}: {program.name} has the mean {mean}, and {programs[0].name} {means[0]}")
        first = None
        for program, done in zip(programs, runs):
            cpu, clock = (statistics.median(run[i] for run in done) for i in (0, 1))
            first = first or (cpu, clock)
            print(
                f"| {name} | {program.name} | {cpu:.3f} | {first[0] / cpu:.2f} times "
                f"| {clock:.3f} | {first[1] / clock:.2f} times |",
                flush=True,
            )


if __name__ == "__main__":
    main()
