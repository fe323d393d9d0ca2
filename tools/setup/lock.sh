#!/bin/sh
# Writes what is installed from PyPI and npm, with versions and hashes of all
# that it brings along: after a change in tools/setup/*.in or tools/package.json.
# UPGRADE=1 takes newer versions where those leave it open.
set -eu
cd "$(dirname "$0")"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet uv
for list in *.in; do
  "$folder/venv/bin/uv" pip compile --quiet --universal --python-version 3.11 \
    --generate-hashes --no-emit-index-url --no-header --no-annotate \
    ${UPGRADE:+--upgrade} "$list" -o "${list%.in}.txt"
done
cp ../package*.json "$folder"
cd "$folder"
[ -z "${UPGRADE:-}" ] || rm -f package-lock.json
npm install --silent --package-lock-only --ignore-scripts --no-audit --no-fund \
  --omit-lockfile-registry-resolved
cp package-lock.json "$OLDPWD/.."
