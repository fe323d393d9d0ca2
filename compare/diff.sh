#!/bin/sh
# diff.sh A B SCENE: renders and compares. A and B are stages (stage3), images
# (.exr, .pfm, .ppm), or any program with the stages' command line. What they
# are rendered with beyond that is in OPTIONS, such as "--spp 64".
set -eu
build=${BUILD:-build}
a=${1:?A is missing: a stage, an image or a program}
b=${2:?B is missing: a stage, an image or a program}
scene=${3:-}
mkdir -p "$build/diff"

# image_of NAME OUT SEED: prints the path of NAME's image, rendering it to OUT
# if NAME is not an image itself.
image_of() {
  case $1 in
    *.exr | *.pfm | *.ppm) echo "$1"; return ;;
    stage[1-9]) program=$build/$1 ;;
    */*) program=$1 ;;
    *) program=./$1 ;;
  esac
  [ -x "$program" ] || {
    echo "diff: '$1' is no stage, no image and no program" >&2
    exit 2
  }
  [ -n "$scene" ] || { echo "diff: SCENE=... is missing" >&2; exit 2; }
  # shellcheck disable=SC2086
  "$program" "$scene" -o "$2" --seed "$3" --size 128x128 ${OPTIONS:-} >&2 ||
    exit 2
  echo "$2"
}

image_a=$(image_of "$a" "$build/diff/a.exr" 1)
image_b=$(image_of "$b" "$build/diff/b.exr" 2)
status=0
"$build/stage-diff" "$image_a" "$image_b" -o "$build/diff/diff.png" ||
  status=$?
[ "$status" = 2 ] || echo "A, B, difference and z: $build/diff/diff.png"
exit "$status"
