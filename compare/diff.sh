#!/bin/sh
# Renders and compares: A and B in the environment are stages (stage3), images
# (.pfm, .exr, .ppm), or any program with the stages' command line. SCENE is
# what they render, and OPTIONS are further options ("--spp 64").
# Each program may use LIMIT seconds of processor time, 3600 if not given.
# Exit codes: 0 the same, 1 different, 2 cannot compare.
#
# Each run has its own folder, so that no picture of an earlier or parallel run
# can be taken for this one's.
set -euf
build=${BUILD:-build}
limit=${LIMIT:-3600}

cannot() {
  printf 'diff: %s\n' "$1" >&2
  exit 2
}
[ -n "${A:-}" ] || cannot "A is missing: a stage, an image or a program"
[ -n "${B:-}" ] || cannot "B is missing: a stage, an image or a program"
case $build in /*) ;; *) build=./$build ;; esac
mkdir -p "$build/diff"
folder=$(mktemp -d "$build/diff/run.XXXXXX")
echo $$ > "$folder/running"
trap 'rm -f "$folder/running"' EXIT

# The last twenty of the earlier runs stay, and those that still run.
ls -t "$build/diff" | grep '^run\.' | tail -n +21 | while read -r old; do
  old=$build/diff/$old
  [ -f "$old/running" ] && kill -0 "$(cat "$old/running")" 2> /dev/null ||
    rm -rf "$old"
done

# image_of LETTER NAME SEED: sets `image` to the path of NAME's image, and
# renders it if NAME is not an image itself.
rendered=0
image_of() {
  case $2 in
    stage[1-9]) program=$build/$2 ;;
    /*) program=$2 ;;
    *) program=./$2 ;;
  esac
  case $2 in
    *.exr | *.pfm | *.ppm) image=$program; return ;;
  esac
  [ -f "$program" ] && [ -x "$program" ] ||
    cannot "$1: '$2' is no stage, no image and no program"
  [ -n "${SCENE:-}" ] || cannot "SCENE=... is missing"
  image=$folder/$1.pfm
  # OPTIONS are words, not patterns of file names: -f is set.
  # shellcheck disable=SC2086
  (
    ulimit -t "$limit" || exit
    exec "$program" "$SCENE" -o "$image" --seed "$3" --size 128x128 \
      ${OPTIONS:-}
  ) >&2 < /dev/null || {
    code=$?
    [ $code -lt 130 ] || code="$code (it may run for LIMIT=$limit seconds)"
    cannot "$1: '$2' ended with exit code $code"
  }
  [ -s "$image" ] || cannot "$1: '$2' wrote no image"
  rendered=$((rendered + 1))
}

image_of A "$A" 1
image_a=$image
image_of B "$B" 2
set -- "$image_a" "$image" -o "$folder/diff.png"
[ "$rendered" -lt 2 ] || set -- "$@" --other-seeds
status=0
"$build/stage-diff" "$@" || status=$?
if [ -f "$folder/diff.png" ]; then
  cp "$folder/diff.png" "$folder/last.png"
  mv -f "$folder/last.png" "$build/diff/diff.png"
  echo "A, B, difference and z: ${folder#./}/diff.png"
  echo "(the last comparison's is always ${build#./}/diff/diff.png)"
fi
exit "$status"
