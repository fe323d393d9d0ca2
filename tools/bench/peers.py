"""Times the lab's boxes in Mitsuba 3 and in stage 4, side by side.

    make bench-peers

Runs alternate, so that whatever else the machine does falls on all of them,
and medians are compared. First the means of the diffuse boxes' pictures must
agree: a fast program that paints another picture has won nothing. The boxes
of all materials are for time only: Mitsuba has no plastic like the course's,
and its glass follows Fresnel's equations.

The LLVM variant needs libLLVM 16 or newer; DRJIT_LIBLLVM_PATH says where.
Without it the scalar variant is timed alone.
"""

import argparse
import math
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib

import mitsuba
import numpy

from compare.stages import SCENES, read_pfm, render

FAR = 40  # planes are infinite here, and rectangles there


def bsdf(material):
    """A material of the course; those that are not diffuse only resemble."""

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
        self.variant = variant
        self.scene = mitsuba_scene(mitsuba, toml)
        self.render(1, 0)  # compiles

    def render(self, spp, seed):
        """Seconds, and the mean radiance."""
        mitsuba.set_variant(self.variant)
        start = time.perf_counter()
        image = numpy.array(mitsuba.render(self.scene, spp=spp, seed=seed))
        return time.perf_counter() - start, image.mean(axis=(0, 1))


class Ours:
    variant = "stage4"

    def __init__(self, scene):
        self.scene = scene

    def render(self, spp, seed):
        with tempfile.NamedTemporaryFile(suffix=".pfm") as file:
            report = render("stage4", self.scene, file.name, "--spp", spp, "--seed", seed)
            *_, pixels = read_pfm(file.name)
        return report["seconds"], numpy.mean(pixels, axis=0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repetitions", default=5, type=int)
    parser.add_argument("--spp", default=32, type=int)
    options = parser.parse_args()
    variants = ["scalar_rgb"]
    probe = subprocess.run(
        [
            sys.executable,
            "-c",
            "import mitsuba as mi; mi.set_variant('llvm_ad_rgb');"
            "mi.render(mi.load_dict(mi.cornell_box()), spp=1).numpy()",
        ],
        capture_output=True,
    )
    if probe.returncode == 0:
        variants.append("llvm_ad_rgb")
    else:
        print("llvm_ad_rgb does not run here: see DRJIT_LIBLLVM_PATH")

    print("| box | program | Msamples/s | stage 4 is faster by |")
    print("|---|---|---|---|")
    for name in (
        "cornell_box_point_diffuse",
        "cornell_box_ceiling_diffuse",
        "cornell_box_point",
        "cornell_box_ceiling",
    ):
        path = SCENES / f"{name}.toml"
        toml = tomllib.loads(path.read_text())
        programs = [Ours(path)]
        programs += [Peer(variant, toml) for variant in variants]
        times = [[] for _ in programs]
        means = [[] for _ in programs]
        for seed in range(options.repetitions):
            for i, program in enumerate(programs):
                seconds, mean = program.render(options.spp, seed + 1)
                times[i].append(seconds)
                means[i].append(mean)
        means = [numpy.mean(m, axis=0) for m in means]
        if name.endswith("diffuse"):
            for mean, program in zip(means[1:], programs[1:]):
                if not numpy.allclose(mean, means[0], rtol=0.01):
                    sys.exit(f"{name}: {program.variant} has the mean {mean} and stage 4 has {means[0]}")
        samples = math.prod(toml["camera"]["size"]) * options.spp
        medians = [statistics.median(t) for t in times]
        for program, median in zip(programs, medians):
            print(
                f"| {name} | {program.variant} | {samples / median / 1e6:.2f} | {median / medians[0]:.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
