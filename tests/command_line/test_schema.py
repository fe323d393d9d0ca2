"""The schema that editors use and the loader agree about every scene."""

import copy
import json
import re
import tomllib
import unittest

import jsonschema

from broken_scenes import BROKEN, DEPENDS, GOOD, NOT_ASKED, POINT_LIGHT, REFUSES
from programs import SCENES, InFolder, built_stages, run

SCHEMA = json.loads((SCENES / "scene.schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)

# Every key of the first stage, and tables with the features of later stages.
FIRST = tomllib.loads(GOOD)
LATER = [
    ("lights", tomllib.loads(POINT_LIGHT)["lights"]),
    ("glass", {"kd": 0.1, "ks": 0.1, "kt": [0.7, 0.7, 0.7], "eta": 1.4}),
    ("ice", {"ks": 0.5, "kt": 0.5, "fresnel": True}),
]
OPTIONAL = {
    *["scene.render", "scene.lights", "camera.size"],
    *["render.samples_per_pixel", "render.max_bounces"],
    *["white.kd", "lamp.ke", "glass.kd", "glass.ks", "glass.kt", "glass.eta"],
    *["ice.ks", "ice.kt", "ice.fresnel"],
}

# A pattern as a coefficient, and whether it is valid.
TWO = [[0.8, 0.8, 0.8], 0.1]
PATTERNS = [
    ({"checker": TWO}, True),
    ({"checker": TWO, "scale": 4}, True),
    ({"checker": TWO, "scale": 1e6, "over": "uv"}, True),
    ({"checker": TWO, "over": "position"}, True),
    ({"schlick": TWO}, True),
    ({}, False),
    ({"scale": 4}, False),
    ({"image": ""}, False),
    ({"image": 1}, False),
    ({"image": "a.png", "scale": 4}, False),
    ({"checker": 0.5}, False),
    ({"checker": TWO[:1]}, False),
    ({"checker": TWO + TWO}, False),
    ({"checker": [0.5, 1.5]}, False),
    ({"checker": [0.5, -0.1]}, False),
    ({"checker": TWO, "scale": 0}, False),
    ({"checker": TWO, "scale": 1.1e6}, False),
    ({"checker": TWO, "over": "xyz"}, False),
    ({"checker": TWO, "size": 1}, False),
    ({"checker": TWO, "schlick": TWO}, False),
    ({"schlick": TWO, "scale": 4}, False),
    ({"schlick": TWO, "over": "uv"}, False),
    ({"schlick": [0.5, 1.5]}, False),
]


def why_the_schema_refuses(scene):
    """The schema's complaint about a scene, or None."""
    error = jsonschema.exceptions.best_match(VALIDATOR.iter_errors(scene))
    return error and f"{list(error.path)}: {error.message}"


def patterned(patterns):
    """(name, good, scene) for each pattern as each coefficient."""
    for value, good in patterns:
        for key in ["kd", "ks", "kt"]:
            scene = copy.deepcopy(FIRST)
            scene["materials"]["pattern"] = {key: value}
            yield f"{key} = {value}", good, scene


def to_toml(value):
    """A value in one line of TOML."""
    if isinstance(value, dict):
        pairs = (f"{json.dumps(k)} = {to_toml(v)}" for k, v in value.items())
        return "{ " + ", ".join(pairs) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(to_toml, value)) + "]"
    return json.dumps(value)


def tables(scene):
    """Every table of a scene with fixed keys."""
    yield "scene", scene
    yield "camera", scene["camera"]
    yield "render", scene["render"]
    for name, material in scene["materials"].items():
        yield name, material
    for shape in scene["shapes"]:
        yield shape["type"], shape
    for light in scene.get("lights", []):
        yield "light", light


def changed(scene, change):
    """(what was changed, the scene) for each key of a scene.

    `change` gets a table and one of its keys.
    """
    for i, (name, table) in enumerate(tables(scene)):
        for key in table:
            other = copy.deepcopy(scene)
            change(list(tables(other))[i][1], key)
            yield f"{name}.{key}", other


def why_the_loader_refuses(scene, folder):
    """The newest stage's complaint about a scene, or None."""
    text = "".join(f"{key} = {to_toml(scene[key])}\n" for key in scene)
    assert tomllib.loads(text) == scene, text
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    result = run(
        built_stages()[-1], *[path, "-o", folder / "out.pfm"], *["--size=1x1", "--spp=1", "--max-bounces=1"]
    )
    assert result.returncode in [0, 1], result.stderr
    return result.stderr if result.returncode else None


class TheSchema(unittest.TestCase):
    def test_is_a_schema(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)

    def test_describes_every_key_and_allows_no_other(self):
        def check(part, place):
            if isinstance(part, list):
                for i, child in enumerate(part):
                    check(child, f"{place}/{i}")
            if not isinstance(part, dict):
                return
            if part.get("type") == "object":
                self.assertIn("additionalProperties", part, place)
                self.assertIsNot(part["additionalProperties"], True, place)
                for key, value in part.get("properties", {}).items():
                    self.assertIn("description", value, f"{place}: {key}")
            for key, child in part.items():
                check(child, f"{place}/{key}")

        check(SCHEMA, "")

    def test_accepts_every_scene_of_the_course(self):
        scenes = sorted(SCENES.glob("*.toml"))
        self.assertTrue(scenes)
        for path in scenes:
            with self.subTest(path.name):
                text = path.read_text(encoding="utf-8")
                self.assertIsNone(why_the_schema_refuses(tomllib.loads(text)))
                first = text.splitlines()[0]
                self.assertEqual(first, "#:schema scene.schema.json")

    def test_accepts_the_scene_of_the_readme(self):
        readme = (SCENES / "README.md").read_text(encoding="utf-8")
        blocks = re.findall(r"```toml\n(.*?)```", readme, re.DOTALL)
        whole, *parts = map(tomllib.loads, blocks)
        for scene in (whole, *({**whole, **part} for part in parts)):
            self.assertIsNone(why_the_schema_refuses(scene))

    def test_accepts_the_patterns_of_stage_5(self):
        image = {"image": "textures/marble.png"}
        for name, good, scene in patterned([*PATTERNS, (image, True)]):
            said = why_the_schema_refuses(scene)
            self.assertEqual(said is None, good, f"{name}: {said}")

    def test_refuses_what_it_can_see_of_the_broken_scenes(self):
        for broken in BROKEN:
            if broken.schema in (NOT_ASKED, DEPENDS):
                continue
            with self.subTest(broken.name):
                said = why_the_schema_refuses(tomllib.loads(broken.scene))
                if broken.schema == REFUSES:
                    self.assertIsNotNone(said, "the schema accepts it")
                else:
                    self.assertIsNone(said, "the schema can see it")

    def test_is_not_asked_about_what_is_no_toml(self):
        for broken in BROKEN:
            if broken.schema != NOT_ASKED or len(broken.scene) > 100_000:
                continue
            scene = broken.scene
            if isinstance(scene, bytes):
                scene = scene.decode(errors="surrogateescape")
            if re.search("[\udc80-\udcff]", scene):
                continue  # not UTF-8, so not TOML either
            with self.subTest(broken.name):
                with self.assertRaises((ValueError, RecursionError)):
                    tomllib.loads(scene)


class TheSchemaAndTheLoader(InFolder):
    def setUp(self):
        super().setUp()
        # All features of the newest stage: more with each stage of the course.
        self.scene = copy.deepcopy(FIRST)
        for name, value in LATER:
            scene = copy.deepcopy(self.scene)
            (scene if name == "lights" else scene["materials"])[name] = value
            self.assertIsNone(why_the_schema_refuses(scene))
            refused = why_the_loader_refuses(scene, self.folder)
            if refused is None:
                self.scene = scene
            else:
                self.assertRegex(refused, r", which stage \d introduces$")

    def agree(self, scenes):
        """The names of the scenes that both accept."""
        accepted = []
        for name, scene in scenes:
            with self.subTest(name):
                schema = why_the_schema_refuses(scene)
                loader = why_the_loader_refuses(scene, self.folder)
                if schema is None:
                    accepted.append(name)
                self.assertEqual(
                    schema is None,
                    loader is None,
                    f"\nthe schema says {schema or 'yes'}\nthe loader says {loader or 'yes'}",
                )
        return accepted

    def test_agree_about_the_scene_that_the_others_are_made_of(self):
        self.assertEqual(self.agree([("all", self.scene)]), ["all"])

    def test_agree_about_each_key_that_is_left_out(self):
        def leave_out(table, key):
            del table[key]

        scenes = list(changed(self.scene, leave_out))
        self.assertGreater(len(scenes), 30)
        optional = [name for name, scene in scenes if name in OPTIONAL]
        self.assertEqual(self.agree(scenes), optional)

    def test_agree_about_each_key_that_is_misspelt(self):
        def misspell(table, key):
            table[key + "s"] = table.pop(key)

        self.assertEqual(self.agree(changed(self.scene, misspell)), [])

    def test_agree_about_each_key_that_is_there_with_another_value(self):
        for value in [0.05, -1, True, "text", [], {}, [0.05, 0.05, 0.05], [1]]:

            def change(table, key):
                table[key] = copy.deepcopy(value)

            # The schema cannot know the names of the materials.
            scenes = [
                (f"{name} = {value!r}", scene)
                for name, scene in changed(self.scene, change)
                if not (value == "text" and name.endswith(".material"))
            ]
            self.agree(scenes)

    def test_agree_about_patterns(self):
        if "ice" not in self.scene["materials"]:
            self.skipTest("no stage is built that knows patterns")
        scenes = list(patterned(PATTERNS))
        self.assertEqual(
            self.agree((name, scene) for name, _, scene in scenes), [name for name, good, _ in scenes if good]
        )

    def test_agree_about_the_ends_of_every_range(self):
        def with_value(table, key, value):
            scene = copy.deepcopy(self.scene)
            dict(tables(scene))[table][key] = value
            return f"{table}.{key} = {value}", scene

        good = [
            ("camera", "size", [1, 65536]),
            ("camera", "origin", [-1e12, 0, 1e12]),
            ("render", "samples_per_pixel", 1_000_000_000),
            ("render", "max_bounces", 0),
            ("render", "max_bounces", 4096),
            ("white", "kd", 1),
            ("white", "kd", [0, 1, 0.0]),
            ("white", "ke", 0),
            ("lamp", "ke", [1e12, 0, 0]),
            ("lamp", "kd", 0),
            ("plane", "distance", -1e12),
            ("plane", "normal", [0, 0, -1e-6]),
            ("sphere", "radius", 1e-12),
            ("sphere", "radius", 1e12),
        ]
        bad = [
            ("camera", "size", [65537, 1]),
            ("camera", "origin", [0, 0, 1.1e12]),
            ("render", "samples_per_pixel", 1_000_000_001),
            ("render", "max_bounces", 4097),
            ("white", "kd", 1.01),
            ("white", "ke", [0, 0, 0.1]),
            ("lamp", "ke", 1.1e12),
            ("lamp", "kd", [0, 0, 0.1]),
            ("plane", "normal", [0, 0, 0]),
            ("sphere", "radius", 0.9e-12),
        ]
        if "lights" in self.scene:
            good.append(("light", "intensity", [0, 0, 1e12]))
            bad.append(("light", "intensity", [0, 0, -0.1]))
        if "glass" in self.scene["materials"]:
            good += [("glass", "eta", 0.1), ("glass", "eta", 10)]
            bad += [("glass", "eta", 0.09), ("glass", "eta", 10.1)]
        scenes = [with_value(*value) for value in good]
        self.assertEqual(self.agree(scenes), [name for name, _ in scenes])
        scenes = [with_value(*value) for value in bad]
        self.assertEqual(self.agree(scenes), [])


if __name__ == "__main__":
    unittest.main()
