#!/bin/sh
# Installs what Lightwalk is built from and is not there yet: from Debian's or
# Ubuntu's packages, or from Homebrew. Asks nothing, and does nothing when
# nothing is missing. With SETUP=print it only says what it would run, and
# stops with exit code 1 if that is anything.
#
#   setup.sh         what `make` and `make test` need
#   setup.sh site    what the book needs besides
#   setup.sh live    what the book's live box needs besides: WebAssembly
#   setup.sh slides  what the slides and the browser tests need besides
#   setup.sh handout what handouts bring along besides
#   setup.sh bench   what comparing benchmarks needs besides
#   setup.sh fuzz    what `make fuzz` needs besides
#   setup.sh windows what `make test-windows` needs besides
set -eu

# has_libfuzzer COMPILER: whether it can make programs for `make fuzz`.
has_libfuzzer() {
  echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, long) { return 0; }' |
    "$1" -fsanitize=fuzzer,address -x c++ - -o /dev/null 2>/dev/null
}

debian_packages="make cmake ninja-build libglm-dev libopenimageio-dev
  openimageio-tools libcli11-dev libtomlplusplus-dev doctest-dev
  libbenchmark-dev nlohmann-json3-dev python3
  python3-jsonschema"
brew_packages="cmake ninja glm openimageio cli11 tomlplusplus doctest
  google-benchmark nlohmann-json highway"
if [ "${1:-}" = site ]; then
  debian_packages="python3-venv"
  # Other sources of node have npm in the same package.
  command -v node >/dev/null || debian_packages="$debian_packages nodejs"
  command -v npm >/dev/null || debian_packages="$debian_packages npm"
  brew_packages="node python"
elif [ "${1:-}" = live ]; then
  # Debian's and Ubuntu's alone: a Mac's LLVM comes without WASI's libraries.
  debian_packages="clang lld wasi-libc libc++-dev-wasm32 libclang-rt-dev-wasm32"
  brew_packages=
elif [ "${1:-}" = handout ]; then
  # What a handout brings along for students without OpenImageIO.
  debian_packages="libtinyexr-dev libstb-dev"
  brew_packages="stb"
elif [ "${1:-}" = bench ]; then
  debian_packages="python3-venv libbenchmark-tools"
  brew_packages="google-benchmark python"
elif [ "${1:-}" = fuzz ]; then
  # Any Clang that has libFuzzer will do, wherever it comes from.
  for clang in "${FUZZ_CXX:-clang++}" /opt/homebrew/opt/llvm/bin/clang++ \
    /usr/local/opt/llvm/bin/clang++; do
    if has_libfuzzer "$clang"; then exit 0; fi
  done
  if [ -n "${FUZZ_CXX:-}" ] || ! { command -v apt-get || command -v brew; } \
    >/dev/null; then
    echo "setup: make fuzz needs Clang with libFuzzer and the sanitizers;" \
      "FUZZ_CXX=/path/to/clang++ names one" >&2
    exit 1
  fi
  debian_packages="clang libclang-rt-dev"
  brew_packages=llvm
elif [ "${1:-}" = windows ]; then
  # Debian's and Ubuntu's alone: Homebrew has no wine that runs without a Mac's
  # own screen.
  debian_packages="g++-mingw-w64-x86-64-posix libz-mingw-w64-dev wine64
    libtinyexr-dev libstb-dev"
  brew_packages=
elif [ "${1:-}" = slides ]; then
  # Any Chromium or Chrome will do, wherever it comes from.
  for browser in chromium google-chrome chromium-browser; do
    if command -v $browser >/dev/null; then exit 0; fi
  done
  for browser in Chromium "Google Chrome"; do
    if [ -d "/Applications/$browser.app" ]; then exit 0; fi
  done
  debian_packages="chromium fonts-dejavu-core"
  brew_packages=chromium
fi

# run COMMAND: prints it, and runs it unless SETUP=print.
run() {
  echo "setup: $*" >&2
  [ "${SETUP:-install}" = print ] || "$@"
}

if command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' \
    $debian_packages g++ 2>/dev/null | sed -n 's/ installed$//p')
  missing=
  for package in $debian_packages; do
    echo "$installed" | grep -qxF "$package" || missing="$missing $package"
  done
  [ -n "${CXX:-}" ] || command -v c++ >/dev/null || missing="$missing g++"
  [ -n "$missing" ] || exit 0
  as_root=
  [ "$(id -u)" = 0 ] || as_root=sudo
  run $as_root apt-get update -q
  run $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y \
    --no-install-recommends $missing
elif command -v brew >/dev/null; then
  prefix=$(brew --prefix)
  missing=
  for package in $brew_packages; do
    [ -d "$prefix/opt/$package" ] || missing="$missing $package"
  done
  [ -n "$missing" ] || exit 0
  run brew install $missing
else
  # No package manager that this script knows: CMake says what is missing.
  if [ "${SETUP:-install}" = print ] || ! command -v cmake >/dev/null; then
    cat >&2 <<'TEXT'
setup: this system has neither apt-get nor Homebrew. Please install:
  a C++20 compiler, CMake 3.22 or newer, Ninja (optional), GLM, OpenImageIO,
  CLI11, toml++ 3, nlohmann/json, doctest, Google Benchmark, Highway (optional),
  Python 3.11 with jsonschema;
  for the book Node 20 with npm, for the slides also Chromium or Chrome.
  With vcpkg: `vcpkg install` in this folder reads vcpkg.json.
TEXT
    exit 1
  fi
  exit 0
fi
[ "${SETUP:-install}" != print ]
