"""tests/split_header.py: what a stage's header declares, and what it does."""

import subprocess
import tempfile
import unittest
from pathlib import Path

from tests import split_header
from tools.tree import BUILD, Failure, stage_headers

# A declaration with its body, and what tests see of it.
SEPARATED = {
    "inline Vec3 f(const Vec3& v) { return {v.x, 1}; }": "Vec3 f(const Vec3& v);",
    "float helper(float x)\n{\n  if (x) { return '}' ; }\n}": "float helper(float x);",
    "inline auto f(int i) -> float { return i; }": "auto f(int i) -> float;",
    "inline int f(int a = g({1, 2})) noexcept { return a; }": "int f(int a = g({1, 2})) noexcept;",
    "[[nodiscard]] inline bool operator==(const A& a, const A& b) { return true; }": (
        "[[nodiscard]] bool operator==(const A& a, const A& b);"
    ),
    "class P {\n public:\n  Vec3 radiance(Ray ray) const { return {}; }\n};": (
        "class P {\n public:\n  Vec3 radiance(Ray ray) const;\n};"
    ),
    "struct S { int x{3}; float f() { return x; } };": "struct S { int x{3}; float f(); };",
    "inline Vec3 P::radiance(Ray ray) const { return {}; }": "",
    'inline int f() { return "}\\"{"[0] + R"x(})"{)x"[1] /* } */; }  // {': "int f();",
}
# What tests have to see whole.
WHOLE = (
    "template <class T> T twice(T t) { return t + t; }",
    "constexpr int f(int i) { return i; }",
    "inline auto f(int i) { return i; }",
    "static float f() { return 1; }",
    "inline const auto f = [](Vec3 v) { return v; };",
    "inline constexpr std::array all = {1, 2};",
    "enum class Lobe { diffuse, specular };",
    "struct S { S(int a) : b{a}, c(a) {} int b, c; };",
    "struct S { S(int a) { b = a; } int b; };",
    "struct S { S() = default; friend int f(S) { return 1; } };",
    "template <class T> struct S { T f() { return {}; } };",
    "namespace { int f() { return 1; } }",
    "using F = decltype([] { return 1; });",
)


def declared(text):
    text = f"#pragma once\nnamespace a {{\n{text}\n}}\n"
    found = split_header.split(text)
    assert found.balanced, text
    lines = split_header.declared(text, found).splitlines()
    return "\n".join(lines[3:-1])


def words(text):
    return " ".join(text.split())


class Split(unittest.TestCase):
    def test_bodies_that_nobody_needs_to_see(self):
        for text, expected in SEPARATED.items():
            with self.subTest(text):
                self.assertEqual(words(declared(text)), words(expected))

    def test_bodies_that_stay(self):
        for text in WHOLE:
            with self.subTest(text):
                self.assertEqual(words(declared(text)), words(text))

    def test_another_body_or_comment_declares_the_same(self):
        for header in stage_headers()[:5]:
            text = header.read_text()
            found = split_header.split(text)
            self.assertTrue(found.balanced and len(found.functions) > 2, header)
            other = text
            for one in reversed(found.functions):
                other = f"{other[: one.body + 1]}\n  int x = '}}';  // {{\n{other[one.body + 1 :]}"
            other = "// Other words.\n" + other.replace("\n", "\r\n")
            first, second = (split_header.declared(t, split_header.split(t)) for t in (text, other))
            self.assertEqual(first, second, header)
            self.assertNotIn("open_exercise(", second)

    def test_what_does_not_close_is_left_to_the_compiler(self):
        with tempfile.TemporaryDirectory() as folder:
            header, seen, code = (Path(folder) / name for name in ("h.hpp", "d.hpp", "c.cpp"))
            header.write_bytes(b"namespace a {\ninline int f() {\n  return 1;\n}  // \xf1\n")
            split_header.main(header, seen, code)
            self.assertIn("return 1;", seen.read_text())
            self.assertTrue(code.read_bytes().startswith(b'#line 1 "'))
            self.assertTrue(code.read_bytes().endswith(b"}  // \xf1\n"))

    def test_files_that_do_not_change_are_not_written(self):
        with tempfile.TemporaryDirectory() as folder:
            header, seen, code = (Path(folder) / name for name in ("h.hpp", "d.hpp", "c.cpp"))
            header.write_text("inline int f() { return 1; }\n")
            split_header.main(header, seen, code)
            before = seen.stat().st_mtime_ns, code.stat().st_mtime_ns
            header.write_text("inline int f() { return 2; }\n")
            split_header.main(header, seen, code)
            self.assertEqual(seen.stat().st_mtime_ns, before[0])
            self.assertIn("return 2", code.read_text())

    def test_the_compiler_names_the_headers_own_lines(self):
        compiler = next(
            (
                line.split("=")[1]
                for line in (BUILD / "CMakeCache.txt").read_text().splitlines()
                if line.startswith("CMAKE_CXX_COMPILER:")
            ),
            None,
        )
        if not compiler:
            raise Failure("the build has no compiler")
        with tempfile.TemporaryDirectory() as folder:
            header, seen, code = (Path(folder) / name for name in ("h.hpp", "d.hpp", "c.cpp"))
            header.write_text(
                "#pragma once\n\ninline int f() { return 1; }\nstruct S {\n  int g() { return x; }\n};\n"
            )
            split_header.main(header, seen, code)
            done = subprocess.run([compiler, "-fsyntax-only", code], capture_output=True, text=True)
            self.assertRegex(done.stderr, r"h\.hpp:5:20: error: .*x")


if __name__ == "__main__":
    unittest.main()
