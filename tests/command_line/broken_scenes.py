"""Scenes that are broken in one place each, and the expected messages."""

import dataclasses

# The schema's verdict on a broken scene.
REFUSES = "refuses"
CANNOT_SEE = "cannot see"  # sums of values, names elsewhere, a stage's limits
DEPENDS = "says one or the other"  # with the version of the validator
NOT_ASKED = "is never asked"  # not TOML, or too long for Python's reader

GOOD = """\
[camera]
origin = [0, 0, -3.5]
left = [-1, 0, 0]
up = [0, 1, 0]
forward = [0, 0, 3]
size = [4, 4]

[render]
samples_per_pixel = 1
max_bounces = 2

[materials]
white = { kd = 0.8 }
lamp = { ke = [10, 9, 8] }

[[shapes]]
type = "plane"
normal = [0, 1, 0]
distance = 1
material = "white"

[[shapes]]
type = "sphere"
center = [0.5, -0.7, 0]
radius = 0.3
material = "white"

[[shapes]]
type = "rectangle"
corner = [-0.3, 0.95, -0.1]
edge_u = [0.6, 0, 0]
edge_v = [0, 0, 0.7]
material = "lamp"

[[shapes]]
type = "triangle"
vertices = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]
material = "white"
"""

POINT_LIGHT = """
[[lights]]
type = "point"
center = [0, 0, 0]
intensity = 1
"""


@dataclasses.dataclass
class Broken:
    name: str
    scene: str | bytes
    # Follows "stage1: scene.toml:". "..." leaves the end open, and "COLUMN" stands
    # for any column.
    message: str
    schema: str
    program: str = "stage1"


BROKEN = []


def broken(name, scene, message, schema, program="stage1"):
    assert name not in [other.name for other in BROKEN], name
    BROKEN.append(Broken(name, scene, message, schema, program))


def with_instead(old, new, scene=GOOD):
    assert scene.count(old) == 1, f"{old!r} is there {scene.count(old)} times"
    return scene.replace(old, new)


def edit(name, old, new, message, schema=REFUSES, program="stage1"):
    """The good scene with `new` instead of `old`."""
    broken(name, with_instead(old, new), message, schema, program)


def material(name, text, message, schema=REFUSES, program="stage1"):
    """The good scene with another material, in line 14."""
    edit(name, "lamp =", f"{text}\nlamp =", message, schema, program)


def light(name, old, new, message, schema=REFUSES):
    """The good scene with a point light, which has `new` instead of `old`."""
    text = GOOD + with_instead(old, new, POINT_LIGHT)
    broken(name, text, message, schema, "stage2")


# Not TOML. The columns and the words after "this is not TOML" come from the
# library, the lines do not.
for name, line, scene in [
    ("a picture", 1, b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\1\0\0\0\1\0"),
    ("binary zeros", 1, bytes(1000)),
    ("UTF-16", 1, GOOD.encode("utf-16")),
    ("invalid UTF-8 in a name", 39, GOOD.encode() + b"a\xff = 1\n"),
    ("a byte of Latin-1 in a comment", 2, b"\n# caf\xe9\n" + GOOD.encode()),
    ("a control character", 39, GOOD + "# \x1b[2J\n"),
    ("prose", 1, "Once upon a time\n"),
    ("JSON", 1, '{ "camera": {} }\n'),
    ("half a file", 32, GOOD[: GOOD.index("0, 0.7]")]),
    ("an open string", 23, with_instead('"sphere"', '"sphere')),
    ("an open bracket", 26, with_instead("radius = 0.3", "radius = [0.3")),
    ("a missing value", 25, with_instead("radius = 0.3", "radius =")),
    ("a missing equals sign", 25, with_instead("radius =", "radius")),
    ("a decimal comma", 25, with_instead("radius = 0.3", "radius = 0,3")),
    ("a leading point", 25, with_instead("radius = 0.3", "radius = .3")),
    ("two keys in a line", 39, GOOD + "a = 1 b = 2\n"),
    ("a key twice", 26, with_instead("radius =", "radius = 1\nradius =")),
    ("a table twice", 39, GOOD + "[camera]\n"),
    ("a list and a table", 39, GOOD + "[shapes]\n"),
    ("a misspelt truth", 25, with_instead("= 0.3", "= True")),
    ("an impossible date", 25, with_instead("= 0.3", "= 2024-02-30")),
    ("an unknown escape", 23, with_instead('"sphere"', r'"\sphere"')),
    ("10 MB of brackets", 1, b"[" * 10_000_000),
    ("10 MB of braces", 1, b"{" * 10_000_000),
    ("10 MB of nested lists", 1, b"a = " + b"[" * 10_000_000),
    ("10 MB of nested tables", 1, b"a = " + b"{a = " * 2_000_000),
    ("10 MB of an open string", 1, b'a = "' + b"x" * 10_000_000),
    ("1000 nested lists", 1, "a = " + 1000 * "[" + 1000 * "]" + "\n"),
]:
    broken(name, scene, f"{line}:COLUMN: this is not TOML: ...", NOT_ASKED)

# Each part of a key is a nested table.
PARTS = " a key of more than 16 parts"
broken("a key of 5 million parts", b"a" + b".a" * 5_000_000 + b" = 1\n", "1:32:" + PARTS, NOT_ASKED)
broken("a table of 5 million parts", b"[a" + b".a" * 5_000_000 + b"]\n", "1:33:" + PARTS, NOT_ASKED)
broken("a key of 17 parts", 'a . "b.[=#" . ' + "'.'" + 14 * ".c" + " = 1\n", "1:44:" + PARTS, REFUSES)
broken("a key of 16 parts", "a" + 15 * ".c" + " = 1\n", "1:1: unknown key 'a' in the scene", REFUSES)
broken(
    "long keys behind strings",
    'a = """\n"#\\""""\nb = \'#\'\n' + "c" + 20 * ".c" + " = 1\n",
    "4:32:" + PARTS,
    REFUSES,
)
broken(
    "long keys behind five quotes",
    'a = { b = """""""", ' + "c" + 20 * ".c" + " = 1 }\n",
    "1:52:" + PARTS,
    REFUSES,
)

# Empty, or nearly empty.
broken("an empty file", "", "1:1: the scene needs 'camera'", REFUSES)
broken("only comments", "# a scene\n# to be\n", "1:1: the scene needs 'camera'", REFUSES)
broken("no shapes", GOOD[: GOOD.index("[[shapes]]")], "1:1: the scene has no [[shapes]]", REFUSES)
broken(
    "an empty list of shapes",
    "shapes = []\n" + GOOD[: GOOD.index("[[shapes]]")],
    "1:1: the scene has no [[shapes]]",
    REFUSES,
)

# Large, and TOML.
broken(
    "10 MB of a string", b'a = "' + b"x" * 10_000_000 + b'"\n', "1:1: unknown key 'a' in the scene", NOT_ASKED
)
broken(
    "10 MB of a name",
    b"x" * 10_000_000 + b" = 1\n",
    "1:1: unknown key '" + 60 * "x" + "...' in the scene",
    NOT_ASKED,
)
broken(
    "100 nested lists", "a = " + 100 * "[" + 100 * "]" + "\n", "1:1: unknown key 'a' in the scene", REFUSES
)

# Keys.
edit(
    "an unknown key",
    "distance = 1",
    "distances = 1",
    "19:1: unknown key 'distances' in a plane, did you mean 'distance'?",
)
edit(
    "a key in another language",
    "center =",
    "centre =",
    "24:1: unknown key 'centre' in a sphere, did you mean 'center'?",
)
edit(
    "a key far from all",
    "[render]",
    "[render]\nthreads_and_more = 4",
    "9:1: unknown key 'threads_and_more' in [render]",
)
edit(
    "the option as a key",
    "samples_per_pixel = 1",
    "spp = 1",
    "9:1: unknown key 'spp' in [render], did you mean 'samples_per_pixel'?",
)
edit(
    "the depth of other renderers",
    "max_bounces = 2",
    "max_depth = 2",
    "10:1: unknown key 'max_depth' in [render], did you mean 'max_bounces'?",
)
edit(
    "the size of other renderers",
    "size = [4, 4]",
    "resolution = [4, 4]",
    "6:1: unknown key 'resolution' in [camera], did you mean 'size'?",
)
edit(
    "the position of other renderers",
    "center =",
    "position =",
    "24:1: unknown key 'position' in a sphere, did you mean 'center'?",
)
edit("an empty key", "radius = 0.3", '"" = 0.3', "25:1: unknown key '' in a sphere")
edit(
    "an unknown table",
    "[render]",
    "[renders]",
    "8:2: unknown key 'renders' in the scene, did you mean 'render'?",
)
edit("an unknown table in a list", "[render]", "[[render]]", "8:1: [render] must be a table, not an array")
edit(
    "an upper-case key", "radius", "Radius", "25:1: unknown key 'Radius' in a sphere, did you mean 'radius'?"
)
edit("a key of another shape", "distance = 1", "radius = 1", "19:1: unknown key 'radius' in a plane...")
edit("a missing key", "radius = 0.3\n", "", "22:1: a sphere needs 'radius'")
edit("a missing camera vector", "up = [0, 1, 0]\n", "", "1:1: [camera] needs 'up'")
edit("a missing type", 'type = "sphere"\n', "", "22:1: a shape needs 'type'")
edit(
    "a dotted key",
    "radius = 0.3",
    "radius.outer = 0.3",
    "25:1: 'radius' of a sphere must be a number, not a table",
)
material(
    "an unknown coefficient",
    "red = { kr = 0.5 }",
    "14:9: unknown key 'kr' in material 'red', did you mean 'kd'?",
)

# Types.
edit(
    "a number as a string",
    "radius = 0.3",
    'radius = "0.3"',
    "25:10: 'radius' of a sphere must be a number, not a string",
)
edit(
    "a date as a number",
    "radius = 0.3",
    "radius = 2024-02-29",
    "25:10: 'radius' of a sphere must be a number, not a date or time",
)
edit(
    "a time as a number",
    "radius = 0.3",
    "radius = 12:30:00",
    "25:10: 'radius' of a sphere must be a number, not a date or time",
)
edit(
    "a truth as a number",
    "radius = 0.3",
    "radius = true",
    "25:10: 'radius' of a sphere must be a number, not a boolean",
)
edit(
    "a number as a vector",
    "normal = [0, 1, 0]",
    "normal = 1",
    "18:10: 'normal' of a plane must be three numbers, like [0, 1, 0], not an integer",
)
edit(
    "two numbers as a vector",
    "normal = [0, 1, 0]",
    "normal = [0, 1]",
    "18:10: 'normal' of a plane must be three numbers, like [0, 1, 0], not 2",
)
edit(
    "a string in a vector",
    "normal = [0, 1, 0]",
    'normal = [0, "1", 0]',
    "18:14: 'normal' of a plane must be a number, not a string",
)
edit(
    "a list in a vector",
    "normal = [0, 1, 0]",
    "normal = [0, [1], 0]",
    "18:14: 'normal' of a plane must be a number, not an array",
)
edit("a number as a type", '"sphere"', "1", "23:8: 'type' of a shape must be a string, not an integer")
edit(
    "a material in the shape",
    'radius = 0.3\nmaterial = "white"',
    "radius = 0.3\nmaterial = { kd = 1 }",
    "26:12: 'material' of a sphere must be a string, not a table",
)
edit(
    "a number as a material",
    "white = { kd = 0.8 }",
    "white = 0.8",
    "13:9: material 'white' must be a table, not a number",
)
edit(
    "materials in a list",
    "[materials]",
    "[[materials]]",
    "12:1: [materials] must be a table of materials, not an array",
)
edit(
    "a color as a string",
    "kd = 0.8",
    'kd = "#cccccc"',
    "13:16: 'kd' of material 'white' must be a number or [red, green, blue], not a string",
)
edit(
    "four numbers as a color",
    "kd = 0.8",
    "kd = [1, 1, 1, 1]",
    "13:16: 'kd' of material 'white' must be three numbers, like [0, 1, 0], not 4",
)
edit(
    "an unknown shape",
    '"sphere"',
    '"shpere"',
    "23:8: 'type' of a shape: 'shpere' is none of plane, sphere, rectangle, triangle",
)
light(
    "an unknown light",
    '"point"',
    '"spot"',
    "41:8: unknown light 'spot': lights are of type 'point'; surfaces emit with ke",
)
light("a missing intensity", "intensity = 1\n", "", "40:1: a light needs 'intensity'")
light(
    "a negative intensity",
    "intensity = 1",
    "intensity = [1, -1, 1]",
    "43:13: 'intensity' of a light must not be negative",
)
light(
    "a key of a shape in a light",
    "intensity = 1",
    "intensity = 1\nradius = 1",
    "44:1: unknown key 'radius' in a light",
)
light(
    "lights as a table",
    "[[lights]]",
    "[lights]",
    "40:1: 'lights' must be written [[lights]], once for each light",
)
TABLE = '[shapes]\ntype = "sphere"\nradius = 1\n'
broken(
    "shapes as a table",
    GOOD[: GOOD.index("[[shapes]]")] + TABLE,
    "16:1: 'shapes' must be written [[shapes]], once for each shape",
    REFUSES,
)
broken(
    "shapes as numbers",
    "shapes = [1, 2]\n" + GOOD[: GOOD.index("[[shapes]]")],
    "1:11: a shape must be a table, not an integer",
    REFUSES,
)

# Numbers. NaN is neither below nor above a bound, so the schema lets it pass.
edit("NaN", "radius = 0.3", "radius = nan", "25:10: 'radius' of a sphere must be finite", CANNOT_SEE)
edit(
    "NaN in a color",
    "kd = 0.8",
    "kd = [0.5, nan, 0.5]",
    "13:22: 'kd' of material 'white' must be finite",
    CANNOT_SEE,
)
edit("infinity", "distance = 1", "distance = inf", "19:12: 'distance' of a plane must be finite")
edit(
    "minus infinity in a vector",
    "origin = [0,",
    "origin = [-inf,",
    "2:11: 'origin' of [camera] must be finite",
)
edit("1e300", "radius = 0.3", "radius = 1e300", "25:10: 'radius' of a sphere must lie between -1e12 and 1e12")
for huge in ("1e300", "-1e300", "nan", "inf", "-inf", "1e19"):
    edit(
        f"{huge} as a whole number",
        "pixel = 1\n",
        f"pixel = {huge}\n",
        "9:21: 'samples_per_pixel' of [render] must be a whole number from 1 to 1000000000",
        DEPENDS if huge == "nan" else REFUSES,
    )
edit("1e400", "radius = 0.3", "radius = 1e400", "25:COLUMN: this is not TOML: ...")
edit("a huge integer", "radius = 0.3", "radius = 1" + 30 * "0", "25:COLUMN: this is not TOML: ...")
edit(
    "-1e300 in a vector",
    "center = [0.5,",
    "center = [-1e300,",
    "24:11: 'center' of a sphere must lie between -1e12 and 1e12",
)
edit(
    "the largest integer",
    "radius = 0.3",
    "radius = 9223372036854775807",
    "25:10: 'radius' of a sphere must lie between -1e12 and 1e12",
)
edit(
    "a dazzling lamp",
    "ke = [10, 9, 8]",
    "ke = 1e13",
    "14:15: 'ke' of material 'lamp' must lie between -1e12 and 1e12",
)
edit("a radius of zero", "radius = 0.3", "radius = 0", "25:10: 'radius' of a sphere must be greater than 0")
edit(
    "a negative radius", "radius = 0.3", "radius = -0.3", "25:10: 'radius' of a sphere must be greater than 0"
)
edit(
    "a radius that no float holds",
    "radius = 0.3",
    "radius = 1e-60",
    "25:10: 'radius' of a sphere must be greater than 0",
)
edit(
    "a radius whose square is zero",
    "radius = 0.3",
    "radius = 1e-25",
    "25:10: 'radius' of a sphere is smaller than 1e-12",
)

# Geometry.
edit(
    "a zero normal",
    "normal = [0, 1, 0]",
    "normal = [0, 0.0, -0.0]",
    "18:10: 'normal' of a plane must not be zero",
)
edit(
    "a tiny normal",
    "normal = [0, 1, 0]",
    "normal = [0, 1e-30, 0]",
    "18:10: 'normal' of a plane is shorter than 1e-12",
    CANNOT_SEE,
)
edit(
    "a plane beyond all numbers",
    "normal = [0, 1, 0]\ndistance = 1",
    "normal = [0, 1e-5, 0]\ndistance = 1e10",
    "16:1: the plane is more than 1e12 away from the origin",
    CANNOT_SEE,
)
edit(
    "a zero edge",
    "edge_u = [0.6, 0, 0]",
    "edge_u = [0, 0, 0]",
    "31:10: 'edge_u' of a rectangle must not be zero",
)
ONE_LINE = " lie on one line: they span no area"
edit(
    "parallel edges",
    "edge_u = [0.6, 0, 0]",
    "edge_u = [0, 0, -2]",
    "28:1: the rectangle's edges" + ONE_LINE,
    CANNOT_SEE,
)
edit(
    "edges parallel but for rounding",
    "edge_u = [0.6, 0, 0]\nedge_v = [0, 0, 0.7]",
    "edge_u = [0.1, 0.2, 0.3]\nedge_v = [0.3, 0.6, 0.9]",
    "28:1: the rectangle's edges" + ONE_LINE,
    CANNOT_SEE,
)
edit(
    "edges too long for a float",
    "edge_u = [0.6, 0, 0]\nedge_v = [0, 0, 0.7]",
    "edge_u = [1e11, 0, 0]\nedge_v = [0, 0, 1e11]",
    "28:1: the rectangle's edges span an area that is too small or too large",
    CANNOT_SEE,
)
edit(
    "vertices in a line", "[0, 1, 1]]", "[3, 0, 1]]", "37:12: the triangle's vertices" + ONE_LINE, CANNOT_SEE
)
edit("a vertex twice", "[0, 1, 1]]", "[0, 0, 1]]", "37:12: the triangle's vertices" + ONE_LINE, CANNOT_SEE)
edit(
    "two vertices",
    ", [0, 1, 1]]",
    "]",
    "37:12: 'vertices' of a triangle must be three points, like [[0, 0, 0], [1, 0, 0], [0, 1, 0]]",
)
edit(
    "a flat vertex",
    "[0, 1, 1]]",
    "[0, 1]]",
    "37:35: a vertex of a triangle must be three numbers, like [0, 1, 0], not 2",
)

# The camera and the picture.
edit(
    "a size of zero",
    "size = [4, 4]",
    "size = [4, 0]",
    "6:12: the number of rows must be a whole number from 1 to 65536",
)
edit(
    "a size over the limit",
    "size = [4, 4]",
    "size = [65537, 4]",
    "6:9: the number of columns must be a whole number from 1 to 65536",
)
edit(
    "a fractional size",
    "size = [4, 4]",
    "size = [4.5, 4]",
    "6:9: the number of columns must be a whole number from 1 to 65536",
)
# In JSON, 4.0 is a whole number; in TOML it has another type than 4.
edit(
    "a whole size with a point",
    "size = [4, 4]",
    "size = [4.0, 4]",
    "6:9: the number of columns must be a whole number from 1 to 65536",
    CANNOT_SEE,
)
edit(
    "a size of three",
    "size = [4, 4]",
    "size = [4, 4, 4]",
    "6:8: 'size' of [camera] must be [columns, rows], like [256, 256]",
)
edit(
    "a size as a string",
    "size = [4, 4]",
    'size = "4x4"',
    "6:8: 'size' of [camera] must be [columns, rows], like [256, 256]",
)
edit(
    "a camera without width",
    "left = [-1, 0, 0]",
    "left = [0, 0, 0]",
    "3:8: 'left' of [camera] must not be zero",
)
edit(
    "a camera that looks along its image",
    "forward = [0, 0, 3]",
    "forward = [1, 2, 0]",
    "1:1: 'left', 'up' and 'forward' of [camera] must not lie in one plane",
    CANNOT_SEE,
)
edit(
    "a camera without depth",
    "forward = [0, 0, 3]",
    "forward = [0, 0, 1e-20]",
    "5:11: 'forward' of [camera] is shorter than 1e-12",
    CANNOT_SEE,
)
edit(
    "no samples",
    "samples_per_pixel = 1",
    "samples_per_pixel = 0",
    "9:21: 'samples_per_pixel' of [render] must be a whole number from 1 to 1000000000",
)
edit(
    "half a bounce",
    "max_bounces = 2",
    "max_bounces = 2.5",
    "10:15: 'max_bounces' of [render] must be a whole number from 0 to 4096",
)
edit(
    "bounces without end",
    "max_bounces = 2",
    "max_bounces = 4097",
    "10:15: 'max_bounces' of [render] must be a whole number from 0 to 4096",
)
edit(
    "a negative number of bounces",
    "max_bounces = 2",
    "max_bounces = -1",
    "10:15: 'max_bounces' of [render] must be a whole number from 0 to 4096",
)

# Materials.
edit(
    "a missing material",
    'distance = 1\nmaterial = "white"',
    'distance = 1\nmaterial = "whit"',
    "20:12: there is no material 'whit', did you mean 'white'?",
    CANNOT_SEE,
)
broken(
    "a material with two letters swapped",
    with_instead(
        'distance = 1\nmaterial = "white"',
        'distance = 1\nmaterial = "rde"',
        with_instead("lamp =", "red = { kd = 0.5 }\nlamp ="),
    ),
    "21:12: there is no material 'rde', did you mean 'red'?",
    CANNOT_SEE,
)
edit(
    "no materials",
    GOOD[GOOD.index("[materials]") : GOOD.index("[[shapes]]")],
    "",
    "16:12: there is no material 'white'",
)
TOO_BRIGHT = (
    "13:9: material 'white' reflects more light than it gets: kd + ks + kt is "
    "1.250000 in the %s channel, and at most 1 is possible"
)
edit("too bright in red only", "kd = 0.8", "kd = [1.25, 0.1, 0.1]", TOO_BRIGHT % "red")
edit("too bright in blue only", "kd = 0.8", "kd = [0.1, 0.1, 1.25]", TOO_BRIGHT % "blue")
edit(
    "a negative coefficient",
    "kd = 0.8",
    "kd = [0.5, 0.5, -0.1]",
    "13:16: 'kd' of material 'white' must not be negative",
)
edit(
    "a negative emission", "ke = [10, 9, 8]", "ke = -1", "14:15: 'ke' of material 'lamp' must not be negative"
)
edit(
    "an emitter that reflects",
    "ke = [10, 9, 8]",
    "ke = [10, 9, 8], kd = 0.1",
    "14:8: material 'lamp' emits (ke), so it must not reflect or refract (kd, ks, kt)",
)

# Features of later stages.
broken(
    "a point light in stage 1",
    GOOD + POINT_LIGHT,
    "41:8: there is a point light, which stage 2 introduces",
    CANNOT_SEE,
)
LATER = ", which stage 3 introduces"
material("ks in stage 1", "mirror = { ks = 0.9 }", "14:12: material 'mirror' has ks" + LATER, CANNOT_SEE)
material(
    "kt in stage 1", "glass = { kd = 0.1, kt = 0.9 }", "14:21: material 'glass' has kt" + LATER, CANNOT_SEE
)
material("eta in stage 1", "glass = { eta = 1.5 }", "14:11: material 'glass' has eta" + LATER, CANNOT_SEE)
material(
    "kt in stage 2",
    "glass = { kd = 0.1, kt = 0.9 }",
    "14:21: material 'glass' has kt" + LATER,
    CANNOT_SEE,
    "stage2",
)
material(
    "fresnel in stage 1",
    "ice = { fresnel = true }",
    "14:9: material 'ice' has fresnel, which stage 5 introduces",
    CANNOT_SEE,
)
material(
    "fresnel in stage 2",
    "ice = { fresnel = true }",
    "14:9: material 'ice' has fresnel, which stage 5 introduces",
    CANNOT_SEE,
    "stage2",
)

# Names that would break the message's line, or the terminal.
edit(
    "line breaks in a type",
    '"sphere"',
    r'"a\n\r\tb"',
    "23:8: 'type' of a shape: 'a   b' is none of plane, sphere, rectangle, triangle",
)
edit(
    "a command to the terminal",
    '"sphere"',
    r'"\u001b[2J\u007f\u0085\u009b2J"',
    "23:8: 'type' of a shape: ' [2J     2J' is none of plane, sphere, rectangle, triangle",
)
edit(
    "a zero in a type",
    '"sphere"',
    r'"sphere\u0000"',
    "23:8: 'type' of a shape: 'sphere ' is none of plane, sphere, rectangle, triangle",
)
edit(
    "a line break in a material's name",
    'distance = 1\nmaterial = "white"',
    'distance = 1\nmaterial = "no\\nne"',
    "20:12: there is no material 'no ne'",
    CANNOT_SEE,
)
edit(
    "a line break in a key",
    "radius = 0.3",
    '"ra\\ndius" = 0.3',
    "25:1: unknown key 'ra dius' in a sphere, did you mean 'radius'?",
)
edit(
    "a text as a type",
    '"sphere"',
    '"""\n' + 1000 * "ö" + '"""',
    "23:8: 'type' of a shape: '" + 30 * "ö" + "...' is none of plane, sphere, rectangle, triangle",
)
